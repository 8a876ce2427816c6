!> <case>.interface.dat: contact stiffness and resistance, and how mean gap and contact area change with the load.
module wavycon_interface_table
   use wavycon_contact_measures, only: is_known, or_nan
   use wavycon_contact_status, only: no_load
   use wavycon_kinds, only: dp
   use wavycon_load_derivatives, only: load_derivatives
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: interface_table

   character(48), parameter :: columns(*) = [character(48) :: &
      'load[-]', 'pbar_over_pstar[-]', 'mean_pressure[pressure]', &
      'contact_stiffness[pressure/length]', 'contact_stiffness_error[pressure/length]', &
      'contact_stiffness_normalised[-]', 'contact_stiffness_normalised_error[-]', &
      'contact_area_slope[-]', 'contact_area_slope_error[-]', &
      'mean_gap_curvature[-]', 'mean_gap_curvature_error[-]', &
      'contact_resistance[resistivity*length]', 'contact_resistance_error[resistivity*length]', &
      'status_code[-]', 'status[-]']

contains

   type(table_type) function interface_table() result(table)
      table%file = 'interface'
      table%group = 'interface'
      table%meaning = 'Contact stiffness and resistance of each load, and how gap and area change with it.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%put_load => put_interface
   end function interface_table

   !> The stiffness is -1/G' [p*/Delta]: zero without load, infinite in full contact, which the table has as NaN. The
   !> resistance of a nominal area follows from it (I8).
   subroutine put_interface(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(load_derivatives) :: slopes
      real(dp) :: resistance(2), stiffness(2)

      associate (solution => results%loads(load), surface => results%solver%surface, scene => results%scene)
         stiffness = not_a_number()
         resistance = not_a_number()
         if (solution%status == no_load) then
            stiffness = 0.0_dp
         else if (solution%is_good() .or. allocated(solution%source)) then
            call solution%derivatives(surface, slopes)
            if (slopes%gap_slope < 0.0_dp) stiffness = [-1.0_dp, or_nan(slopes%gap_slope_error)/slopes%gap_slope] &
                                                       /slopes%gap_slope
            associate (length => 0.5_dp*scene%e_star/scene%p_star*surface%amplitude)
               if (scene%interface_setting%resistivity > 0.0_dp .and. is_known(slopes%gap_slope)) &
                  resistance = scene%interface_setting%resistivity*length &
                               *[abs(slopes%gap_slope), or_nan(slopes%gap_slope_error)]
            end associate
         end if
         call file%add(load)
         call file%add([results%in_p_star(solution%pbar_over_pstar), results%mean_pressure(load), &
                        stiffness*scene%p_star/surface%amplitude, results%in_p_star([stiffness, &
                        or_nan(slopes%area_slope), or_nan(slopes%area_slope_error), &
                        or_nan(slopes%gap_curvature), or_nan(slopes%gap_curvature_error)]), resistance])
      end associate
      call results%end_row(file, load)
   end subroutine put_interface

end module wavycon_interface_table
