!> Fields and stresses of the C interface, in arrays of the caller. wavycon.h documents each procedure.
module wavycon_c_arrays
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_ptr
   use wavycon_c_handles, only: begin_call, check_arguments, close_call, handle_type, lock, text_at
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_session_fields, only: check_number, fields_at, fields_on_grid, stresses_at, stresses_on_plane
   use wavycon_stress_tensor, only: largest_shear, principal_stresses, von_mises
   implicit none (type, external)
   private

contains

   integer(c_int) function get_fields(error, solution, points, x, y, pressure, gap, displacement) &
      bind(c, name='wavycon_get_fields')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: x(*), y(*)
      real(c_double), intent(inout), optional :: pressure(*), gap(*), displacement(*)

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call(solution, 'solution', contents, trouble)
      call check_arguments([present(x), present(y)], trouble)
      if (.not. allocated(trouble)) &
         call fields_at(contents%owner%scene, contents%solution, int(points), x, y, trouble, pressure, gap, displacement)
      get_fields = close_call(error, trouble)
   end function get_fields

   integer(c_int) function get_grid(error, solution, points_x, points_y, offset, pressure, gap, displacement) &
      bind(c, name='wavycon_get_grid')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points_x, points_y
      real(c_double), intent(in), optional :: offset(2)
      real(c_double), intent(inout), optional :: pressure(*), gap(*), displacement(*)

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call(solution, 'solution', contents, trouble)
      if (.not. allocated(trouble)) &
         call fields_on_grid(contents%owner%scene, contents%solution, [points_x, points_y], offset_or_none(offset), &
                             trouble, pressure, gap, displacement)
      get_grid = close_call(error, trouble)
   end function get_grid

   integer(c_int) function get_stresses(error, solution, points, x, y, depth, nu, lateral, stress, stress_error) &
      bind(c, name='wavycon_get_stresses')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: x(*), y(*), depth(*)
      real(c_double), value :: nu
      character(kind=c_char), intent(in), optional :: lateral(*)
      real(c_double), intent(inout), optional :: stress(6, *), stress_error(*)

      character(:), allocatable :: word
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call(solution, 'solution', contents, trouble)
      call text_at(lateral, word, trouble)
      call check_arguments([present(x), present(y), present(depth), present(stress)], trouble)
      if (.not. allocated(trouble)) &
         call stresses_at(contents%owner%scene, contents%solution, int(points), x, y, depth, nu, word, stress, trouble, &
                          stress_error)
      get_stresses = close_call(error, trouble)
   end function get_stresses

   integer(c_int) function get_stress_plane(error, solution, points_x, points_y, offset, depth, nu, lateral, stress, &
      stress_error) bind(c, name='wavycon_get_stress_plane')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points_x, points_y
      real(c_double), intent(in), optional :: offset(2)
      real(c_double), value :: depth, nu
      character(kind=c_char), intent(in), optional :: lateral(*)
      real(c_double), intent(inout), optional :: stress(*), stress_error(*)

      character(:), allocatable :: word
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call(solution, 'solution', contents, trouble)
      call text_at(lateral, word, trouble)
      call check_arguments([present(stress)], trouble)
      if (.not. allocated(trouble)) &
         call stresses_on_plane(contents%owner%scene, contents%solution, [points_x, points_y], offset_or_none(offset), &
                                depth, nu, word, stress, trouble, stress_error)
      get_stress_plane = close_call(error, trouble)
   end function get_stress_plane

   integer(c_int) function get_invariants(error, points, stress, to_von_mises, to_shear, to_principal) &
      bind(c, name='wavycon_get_invariants')
      type(c_ptr), value :: error
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: stress(6, *)
      real(c_double), intent(inout), optional :: to_von_mises(*), to_shear(*), to_principal(3, *)

      type(error_type), allocatable :: trouble
      integer :: i

      call lock()
      call check_arguments([present(stress)], trouble)
      if (.not. allocated(trouble)) call check_number(int(points), trouble)
      if (.not. allocated(trouble)) then
         do i = 1, points
            if (present(to_von_mises)) to_von_mises(i) = von_mises(stress(:, i))
            if (present(to_shear)) to_shear(i) = largest_shear(stress(:, i))
            if (present(to_principal)) to_principal(:, i) = principal_stresses(stress(:, i))
         end do
      end if
      get_invariants = close_call(error, trouble)
   end function get_invariants

   !> An offset; zeros without one.
   pure function offset_or_none(offset) result(given)
      real(c_double), intent(in), optional :: offset(2)
      real(dp) :: given(2)

      given = 0.0_dp
      if (present(offset)) given = offset
   end function offset_or_none

end module wavycon_c_arrays
