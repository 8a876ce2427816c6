!> The stresses of the C interface. wavycon.h documents each procedure.
module wavycon_c_stresses
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr
   use wavycon_c_handles, only: begin_call, check_pointers, close_call, handle_type, text_at
   use wavycon_c_solutions, only: find_solution
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_solution_stress, only: wavy_largest_stress
   use wavycon_stress_tensor, only: largest_shear, principal_stresses, von_mises
   implicit none (type, external)
   private

contains

   integer(c_int) function get_stress(error, solution, points, x, y, depth, nu, lateral, stress, stress_error) &
      bind(c, name='wavycon_get_stress')
      type(c_ptr), value :: error, solution, x, y, depth, lateral, stress, stress_error
      integer(c_int), value :: points
      real(c_double), value :: nu

      character(:), allocatable :: lateral_text
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      real(c_double), pointer, contiguous :: from_depth(:), from_x(:), from_y(:), to_error(:), to_stress(:, :)
      real(dp), allocatable :: errors(:), stresses(:, :)

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(x), c_associated(y), c_associated(depth), c_associated(lateral), &
                           c_associated(stress)], trouble)
      call check_number(points, trouble)
      if (.not. allocated(trouble)) then
         call text_at(lateral, lateral_text)
         call c_f_pointer(x, from_x, [points])
         call c_f_pointer(y, from_y, [points])
         call c_f_pointer(depth, from_depth, [points])
         call contents%solution%stress(from_x, from_y, from_depth, nu, lateral_text, stresses, trouble, errors)
      end if
      if (.not. allocated(trouble)) then
         call c_f_pointer(stress, to_stress, [6, int(points)])
         to_stress = stresses
         if (c_associated(stress_error)) then
            call c_f_pointer(stress_error, to_error, [points])
            to_error = errors
         end if
      end if
      get_stress = close_call(error, trouble)
   end function get_stress

   integer(c_int) function get_stress_plane(error, solution, points_x, points_y, offset, depth, nu, lateral, stress, &
      stress_error) bind(c, name='wavycon_get_stress_plane')
      type(c_ptr), value :: error, solution, offset, lateral, stress, stress_error
      integer(c_int), value :: points_x, points_y
      real(c_double), value :: depth, nu

      character(:), allocatable :: lateral_text
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      real(c_double), pointer, contiguous :: from_offset(:), to_error(:, :), to_stress(:, :, :)
      real(dp), allocatable :: errors(:, :), stresses(:, :, :)
      real(dp) :: first(2)

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(lateral), c_associated(stress)], trouble)
      if (.not. allocated(trouble)) then
         call text_at(lateral, lateral_text)
         first = 0.0_dp
         if (c_associated(offset)) then
            call c_f_pointer(offset, from_offset, [2])
            first = from_offset
         end if
         call contents%solution%stress_plane([int(points_x), int(points_y)], depth, nu, lateral_text, stresses, &
                                             trouble, errors, first)
      end if
      if (.not. allocated(trouble)) then
         call c_f_pointer(stress, to_stress, shape(stresses))
         to_stress = stresses
         if (c_associated(stress_error)) then
            call c_f_pointer(stress_error, to_error, shape(errors))
            to_error = errors
         end if
      end if
      get_stress_plane = close_call(error, trouble)
   end function get_stress_plane

   integer(c_int) function get_largest_stress(error, solution, nu, lateral, largest) &
      bind(c, name='wavycon_get_largest_stress')
      type(c_ptr), value :: error, solution, lateral, largest
      real(c_double), value :: nu

      type(wavy_largest_stress), pointer :: answer
      character(:), allocatable :: lateral_text
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      type(wavy_largest_stress) :: found

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(lateral), c_associated(largest)], trouble)
      if (.not. allocated(trouble)) then
         call text_at(lateral, lateral_text)
         call contents%solution%largest_stress(nu, lateral_text, found, trouble)
      end if
      if (.not. allocated(trouble)) then
         call c_f_pointer(largest, answer)
         answer = found
      end if
      get_largest_stress = close_call(error, trouble)
   end function get_largest_stress

   integer(c_int) function get_invariants(error, points, stress, to_von_mises, to_shear, to_principal) &
      bind(c, name='wavycon_get_invariants')
      type(c_ptr), value :: error, stress, to_von_mises, to_shear, to_principal
      integer(c_int), value :: points

      type(error_type), allocatable :: trouble
      real(c_double), pointer, contiguous :: from(:, :), principal(:, :), shear(:), yielding(:)
      integer :: i

      call begin_call()
      call check_pointers([c_associated(stress)], trouble)
      call check_number(points, trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(stress, from, [6, int(points)])
         if (c_associated(to_von_mises)) then
            call c_f_pointer(to_von_mises, yielding, [points])
            do i = 1, points
               yielding(i) = von_mises(from(:, i))
            end do
         end if
         if (c_associated(to_shear)) then
            call c_f_pointer(to_shear, shear, [points])
            do i = 1, points
               shear(i) = largest_shear(from(:, i))
            end do
         end if
         if (c_associated(to_principal)) then
            call c_f_pointer(to_principal, principal, [3, int(points)])
            do i = 1, points
               principal(:, i) = principal_stresses(from(:, i))
            end do
         end if
      end if
      get_invariants = close_call(error, trouble)
   end function get_invariants

   !> Errors: exit_bad_input for a number of points below 1.
   subroutine check_number(points, error)
      integer(c_int), intent(in) :: points
      type(error_type), allocatable, intent(inout) :: error   !! nothing is checked if it is allocated

      if (allocated(error)) return
      if (points < 1) call fatal_error(error, exit_bad_input, 'points must be 1 or more')
   end subroutine check_number

end module wavycon_c_stresses
