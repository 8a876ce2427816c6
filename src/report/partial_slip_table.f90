!> <case>.partial_slip.dat: stick area, displacement and energy a cycle of each load and tangential load; and
!> <case>.slip_loop.dat: a block of each with the tangential load against the displacement.
module wavycon_partial_slip_table
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_status, only: status_code, status_name
   use wavycon_kinds, only: dp
   use wavycon_load_derivatives, only: load_derivatives
   use wavycon_output_file, only: output_file
   use wavycon_partial_slip, only: cycle_energy, relative_displacement, slip_loop
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_results, only: not_a_number, results_type
   use wavycon_scene, only: scene_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: partial_slip_table, slip_loop_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'tangential[-]', 'mean_pressure[pressure]', 'tangential_load[pressure]', &
      'tangential_over_limit[-]', 'stick_pbar_over_pstar[-]', 'contact_area_fraction[-]', &
      'stick_area_fraction[-]', 'stick_area_error[-]', 'displacement[length]', 'displacement_error[length]', &
      'least_displacement[length]', 'most_displacement[length]', 'tangential_stiffness[pressure/length]', &
      'cycle_energy[pressure*length]', 'cycle_energy_error[pressure*length]', &
      'status_code[-]', 'status[-]']
   character(40), parameter :: loop_columns(*) = [character(40) :: &
      'load[-]', 'tangential[-]', 'branch[-]', 'tangential_load[pressure]', 'displacement[length]']

contains

   type(table_type) function partial_slip_table() result(table)
      table%file = 'partial_slip'
      table%group = 'interface'
      table%meaning = 'Stick area, displacement and energy a cycle of each tangential load.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%requested => has_friction
      table%put_load => put_slip
   end function partial_slip_table

   type(table_type) function slip_loop_table() result(table)
      table%file = 'slip_loop'
      table%key = 'slip_loop'
      table%group = 'interface'
      table%meaning = 'Tangential load against displacement: loading, and a cycle between +Q and -Q.'
      call table%set_columns(loop_columns)
      table%put_load => put_loop
   end function slip_loop_table

   logical function has_friction(scene)
      type(scene_type), intent(in) :: scene

      has_friction = scene%interface_setting%friction > 0.0_dp
   end function has_friction

   !> The tangential stiffness is that of the next increase of the load.
   subroutine put_slip(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(load_derivatives) :: slopes
      integer :: i
      real(dp) :: displacement(2), energy(2), of_stick(3), stiffness

      associate (solution => results%loads(load), setting => results%scene%interface_setting, &
                 p_star => results%scene%p_star, amplitude => results%solver%surface%amplitude)
         do i = 1, size(results%slip, 1)
            associate (slip => results%slip(i, load), stick => results%slip(i, load)%stick)
               stiffness = not_a_number()
               displacement = not_a_number()
               energy = not_a_number()
               of_stick = not_a_number()
               if (stick%is_good()) then
                  of_stick = [results%in_p_star(stick%pbar_over_pstar), stick%measures%contact_area_fraction, &
                              or_nan(stick%measures%contact_area_error)]
                  displacement = setting%friction*amplitude*or_nan(relative_displacement(solution, stick))
                  if (results%traits%has_errors) then
                     energy = setting%kappa(1)*setting%friction**2*p_star*amplitude* &
                              or_nan(cycle_energy(solution, stick))
                  else
                     of_stick(3) = not_a_number()
                     displacement(2) = not_a_number()
                  end if
                  call stick%derivatives(results%solver%surface, slopes)
                  if (slopes%gap_slope < 0.0_dp) stiffness = -p_star/(setting%kappa(1)*amplitude*slopes%gap_slope)
               end if
               call file%add([load, i])
               call file%add([results%mean_pressure(load), p_star*slip%tangential, &
                              slip%tangential/(setting%friction*solution%pbar_over_pstar), &
                              of_stick(1), solution%measures%contact_area_fraction, of_stick(2:), &
                              setting%kappa(1)*displacement, setting%kappa(2:)*displacement(1), stiffness, energy])
               call file%add(status_code(stick%status))
               call file%add(trim(status_name(stick%status)))
               call file%end_row()
            end associate
         end do
      end associate
   end subroutine put_slip

   subroutine put_loop(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      integer :: i, k
      integer, allocatable :: branch(:)
      real(dp), allocatable :: displacement(:), tangential(:)

      associate (setting => results%scene%interface_setting, p_star => results%scene%p_star, &
                 amplitude => results%solver%surface%amplitude)
         do i = 1, size(results%slip, 1)
            associate (slip => results%slip(i, load))
               call slip_loop(slip, branch, tangential, displacement)
               call file%begin_block('load '//integer_text(load)//', tangential load '//integer_text(i)//': '// &
                                     exact_number(p_star*slip%tangential))
               do k = 1, size(branch)
                  call file%add([load, i, branch(k)])
                  call file%add([p_star*tangential(k), &
                                 setting%kappa(1)*setting%friction*amplitude*displacement(k)])
                  call file%end_row()
               end do
            end associate
         end do
      end associate
   end subroutine put_loop

end module wavycon_partial_slip_table
