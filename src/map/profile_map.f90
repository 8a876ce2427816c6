!> Makes profiles from lines of x and z.
module wavycon_profile_map
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_c_binding, only: c_int, c_null_ptr, c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_gsl, only: gsl_interp_alloc, gsl_interp_eval, gsl_interp_free, gsl_interp_init, gsl_interp_steffen, &
      return_gsl_errors
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: check_map_size
   use wavycon_measured_map, only: measured_map
   use wavycon_number_table, only: number_table
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_point_map, only: tolerance
   implicit none (type, external)
   private

   public :: take_profile, resample_profile

contains

   !> Makes a profile, whose x rise; missing heights are NaN. If the steps of x are not equal it has these in `x` and is
   !> to be resampled. Errors: exit_bad_input for lines that have not two numbers, and for x that neither rise nor fall.
   subroutine take_profile(table, map, error)
      type(number_table), intent(in) :: table
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      real(dp), allocatable :: x(:)
      integer :: i, k, n

      n = size(table%line)
      if (size(table%values, 1) /= 2) then
         call table%refuse(1, 'this line has '//integer_text(size(table%values, 1))// &
                           " numbers: file_format = 'xz' needs x and z", error)
         return
      end if
      call check_map_size(table%path, [n, 1], error)
      if (allocated(error)) return
      x = table%values(1, :)
      k = findloc(ieee_is_nan(x), .true., dim=1)
      if (k > 0) then
         call table%refuse(k, 'x must be a number; a missing height is nan, or its line is left out', error)
         return
      end if
      do k = 2, n
         if ((x(k) - x(k - 1))*(x(n) - x(1)) > 0.0_dp) cycle
         call table%refuse(k, 'x = '//short_number(x(k))//' after '//short_number(x(k - 1))// &
                           ': from line to line x must rise, or fall', error)
         return
      end do
      map%height = reshape(table%values(2, :), [n, 1])
      if (x(n) < x(1)) then
         x = x(n:1:-1)
         map%height(:, 1) = map%height(n:1:-1, 1)
      end if
      map%step(1) = (x(n) - x(1))/(n - 1)
      if (any(abs(x - x(1) - map%step(1)*[(i, i=0, n - 1)]) > tolerance*map%step(1))) call move_alloc(x, map%x)
   end subroutine take_profile

   !> Replaces the heights of a profile whose steps are not equal by those at as many points that are equally far apart,
   !> from its first x to its last: (M7) of README.md in this directory. A point next to a missing height is missing.
   !> Errors: exit_bad_input if there are fewer than three heights.
   subroutine resample_profile(path, map, error)
      character(*), intent(in) :: path           !! of the map, for messages
      type(measured_map), intent(inout) :: map   !! with x; then without
      type(error_type), allocatable, intent(out) :: error

      integer(c_size_t), parameter :: fewest = 3
      logical, allocatable :: missing(:)
      real(dp), allocatable :: x(:), z(:)
      real(dp) :: place
      type(c_ptr) :: curve
      integer :: i, k, n
      integer(c_int) :: ignored

      n = size(map%x)
      allocate (missing(n), source=.false.)
      if (allocated(map%missing)) missing = map%missing(:, 1)
      x = pack(map%x, .not. missing)
      z = pack(map%height(:, 1), .not. missing)
      if (size(x) < fewest) then
         call fatal_error(error, exit_bad_input, escaped(path)//': its x are not equally far apart, and '// &
                          integer_text(size(x))//' heights are too few to resample it')
         return
      end if
      call return_gsl_errors()
      curve = gsl_interp_alloc(gsl_interp_steffen, size(x, kind=c_size_t))
      ignored = gsl_interp_init(curve, x, z, size(x, kind=c_size_t))
      k = 1
      do i = 1, n
         place = map%x(1) + (i - 1)*map%step(1)
         do while (k < n - 1 .and. map%x(k + 1) < place)
            k = k + 1
         end do
         if (allocated(map%missing)) map%missing(i, 1) = any(missing(k:k + 1))
         map%height(i, 1) = gsl_interp_eval(curve, x, z, min(max(place, x(1)), x(size(x))), c_null_ptr)
      end do
      call gsl_interp_free(curve)
      if (allocated(map%missing)) where (map%missing) map%height = 0.0_dp
      map%uneven_steps = [minval(map%x(2:) - map%x(:n - 1)), maxval(map%x(2:) - map%x(:n - 1))]
      deallocate (map%x)
   end subroutine resample_profile

end module wavycon_profile_map
