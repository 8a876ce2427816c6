!> Fields and stresses of the C interface, in arrays of the caller. wavycon.h documents each procedure.
module wavycon_c_arrays
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_c_handles, only: begin_call, check_pointers, close_call, find_object, handle_type, text_at
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_session_fields, only: fields_at, fields_on_grid, most_points, stresses_at, stresses_on_plane
   use wavycon_stress_tensor, only: largest_shear, principal_stresses, von_mises
   implicit none (type, external)
   private

contains

   integer(c_int) function get_fields(error, solution, points, x, y, pressure, gap, displacement) &
      bind(c, name='wavycon_get_fields')
      type(c_ptr), value :: error, solution, x, y, pressure, gap, displacement
      integer(c_int), value :: points

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_object(solution, 'solution', contents, trouble)
      call check_pointers([c_associated(x), c_associated(y)], trouble)
      call check_number(points, trouble)
      if (.not. allocated(trouble)) &
         call fields_at(contents%owner%scene, contents%solution, int(points), array(x, points), array(y, points), &
                        trouble, array(pressure, points), array(gap, points), array(displacement, points))
      get_fields = close_call(error, trouble)
   end function get_fields

   integer(c_int) function get_grid(error, solution, points_x, points_y, offset, pressure, gap, displacement) &
      bind(c, name='wavycon_get_grid')
      type(c_ptr), value :: error, solution, offset, pressure, gap, displacement
      integer(c_int), value :: points_x, points_y

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_object(solution, 'solution', contents, trouble)
      if (.not. allocated(trouble)) &
         call fields_on_grid(contents%owner%scene, contents%solution, [points_x, points_y], offset_at(offset), &
                             trouble, grid(pressure, points_x, points_y), grid(gap, points_x, points_y), &
                             grid(displacement, points_x, points_y))
      get_grid = close_call(error, trouble)
   end function get_grid

   integer(c_int) function get_stresses(error, solution, points, x, y, depth, nu, lateral, stress, stress_error) &
      bind(c, name='wavycon_get_stresses')
      type(c_ptr), value :: error, solution, x, y, depth, lateral, stress, stress_error
      integer(c_int), value :: points
      real(c_double), value :: nu

      character(:), allocatable :: word
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_object(solution, 'solution', contents, trouble)
      call text_at(lateral, word, trouble)
      call check_pointers([c_associated(x), c_associated(y), c_associated(depth), c_associated(stress)], trouble)
      call check_number(points, trouble)
      if (.not. allocated(trouble)) &
         call stresses_at(contents%owner%scene, contents%solution, int(points), array(x, points), array(y, points), &
                          array(depth, points), nu, word, grid(stress, 6, points), trouble, array(stress_error, points))
      get_stresses = close_call(error, trouble)
   end function get_stresses

   integer(c_int) function get_stress_plane(error, solution, points_x, points_y, offset, depth, nu, lateral, stress, &
      stress_error) bind(c, name='wavycon_get_stress_plane')
      type(c_ptr), value :: error, solution, offset, lateral, stress, stress_error
      integer(c_int), value :: points_x, points_y
      real(c_double), value :: depth, nu

      character(:), allocatable :: word
      real(c_double), pointer, contiguous :: plane(:, :, :)
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_object(solution, 'solution', contents, trouble)
      call text_at(lateral, word, trouble)
      call check_pointers([c_associated(stress)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(stress, plane, [6, sides(points_x, points_y)])
         call stresses_on_plane(contents%owner%scene, contents%solution, [points_x, points_y], offset_at(offset), &
                                depth, nu, word, plane, trouble, grid(stress_error, points_x, points_y))
      end if
      get_stress_plane = close_call(error, trouble)
   end function get_stress_plane

   integer(c_int) function get_invariants(error, points, stress, to_von_mises, to_shear, to_principal) &
      bind(c, name='wavycon_get_invariants')
      type(c_ptr), value :: error, stress, to_von_mises, to_shear, to_principal
      integer(c_int), value :: points

      real(c_double), pointer, contiguous :: from(:, :), principal(:, :), shear(:), yielding(:)
      type(error_type), allocatable :: trouble
      integer :: i

      call begin_call()
      call check_pointers([c_associated(stress)], trouble)
      call check_number(points, trouble)
      if (.not. allocated(trouble)) then
         from => grid(stress, 6, points)
         yielding => array(to_von_mises, points)
         shear => array(to_shear, points)
         principal => grid(to_principal, 3, points)
         do i = 1, points
            if (associated(yielding)) yielding(i) = von_mises(from(:, i))
            if (associated(shear)) shear(i) = largest_shear(from(:, i))
            if (associated(principal)) principal(:, i) = principal_stresses(from(:, i))
         end do
      end if
      get_invariants = close_call(error, trouble)
   end function get_invariants

   !> An array of C; null if the pointer is, which makes an optional argument absent.
   function array(address, points)
      type(c_ptr), intent(in) :: address
      integer(c_int), intent(in) :: points
      real(c_double), pointer, contiguous :: array(:)

      nullify (array)
      if (c_associated(address)) call c_f_pointer(address, array, [points])
   end function array

   !> The same of an array [points_y][points_x].
   function grid(address, points_x, points_y)
      type(c_ptr), intent(in) :: address
      integer(c_int), intent(in) :: points_x, points_y
      real(c_double), pointer, contiguous :: grid(:, :)

      nullify (grid)
      if (c_associated(address)) call c_f_pointer(address, grid, sides(points_x, points_y))
   end function grid

   !> Its sides; zeros for points out of range, which are an error later.
   pure function sides(points_x, points_y)
      integer(c_int), intent(in) :: points_x, points_y
      integer :: sides(2)

      sides = [points_x, points_y]
      if (any(sides < 1) .or. product(int(sides, int64)) > 6*most_points) sides = 0
   end function sides

   !> An offset from C; zeros if the pointer is null.
   function offset_at(address) result(offset)
      type(c_ptr), intent(in) :: address
      real(dp) :: offset(2)

      real(c_double), pointer :: from(:)

      offset = 0.0_dp
      if (.not. c_associated(address)) return
      call c_f_pointer(address, from, [2])
      offset = from
   end function offset_at

   !> Errors: exit_bad_input for a number of points below 1, or above that of a plane.
   subroutine check_number(points, error)
      integer(c_int), intent(in) :: points
      type(error_type), allocatable, intent(inout) :: error   !! nothing is checked if it is allocated

      if (allocated(error)) return
      if (points < 1 .or. points > most_points) call fatal_error(error, exit_bad_input, &
                                                                 'points must be from 1 to 8192*8192')
   end subroutine check_number

end module wavycon_c_arrays
