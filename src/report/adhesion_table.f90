!> <case>.adhesion.dat: the contact with adhesion. Blocks: the curve of pressure against area and approach; pull-off and
!> jump into full contact; the loads.
module wavycon_adhesion_table
   use wavycon_adhesive_curve, only: adhesive_point, point_names
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_scene, only: scene_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: adhesion_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'pbar1_over_pstar[-]', 'pbar_over_pstar[-]', 'pbar_over_pstar_error[-]', 'mean_pressure[pressure]', &
      'force[force]', 'mean_gap_over_amplitude[-]', 'mean_gap_over_amplitude_error[-]', 'approach[length]', &
      'contact_area_fraction[-]', 'contact_area_fraction_error[-]', 'contact_area[area]', 'least_release_over_w[-]', &
      'most_release_over_w[-]', 'point[-]']

contains

   type(table_type) function adhesion_table() result(table)
      table%file = 'adhesion'
      table%group = 'interface'
      table%meaning = 'The contact with adhesion: its curve, pull-off and jump, and the loads.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%requested => requested
      table%write_all => write_adhesion
   end function adhesion_table

   logical function requested(scene)
      type(scene_type), intent(in) :: scene

      requested = scene%interface_setting%work > 0.0_dp
   end function requested

   !> Errors: exit_file_trouble.
   subroutine write_adhesion(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file

      call results%open_table('adhesion', columns, file)
      associate (curve => results%adhesion)
         call put_block('the curve, by the pressure P1 of the contact without adhesion', curve%points)
         call put_block('pull-off and jump into full contact', curve%critical)
         call put_block('the loads: stable and unstable points', curve%at_loads)
      end associate
      call file%finish(error)

   contains

      subroutine put_block(title, points)
         character(*), intent(in) :: title
         type(adhesive_point), intent(in) :: points(:)

         integer :: i

         call file%begin_block(title)
         do i = 1, size(points)
            call put_point(results, file, points(i))
         end do
      end subroutine put_block

   end subroutine write_adhesion

   subroutine put_point(results, file, point)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      type(adhesive_point), intent(in) :: point

      real(dp) :: gap(2)

      associate (surface => results%solver%surface, mean_pressure => results%scene%p_star*point%load)
         gap = results%in_p_star([1.0_dp - point%approach, point%approach_error])
         call file%add(point%number)
         if (point%exists) then
            call file%add([results%in_p_star([point%p1, point%load, point%load_error]), mean_pressure, &
                           mean_pressure*surface%nominal_area(), gap, surface%amplitude*point%approach, point%area, &
                           point%area_error, surface%nominal_area()*point%area, point%release_range])
         else
            call file%add([results%in_p_star(point%p1), spread(not_a_number(), 1, size(columns) - 3)])
         end if
         call file%add(trim(merge(point_names(point%kind), 'none                ', point%exists)))
      end associate
      call file%end_row()
   end subroutine put_point

end module wavycon_adhesion_table
