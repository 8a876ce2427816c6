!> Reads height maps in gnuplot's binary matrix format, numbers of single precision:
!>
!>     M   x_1     ...  x_M
!>     y_1 z_11    ...  z_M1
!>     ...
!>
!> gnuplot draws such a file by `splot 'file' binary matrix`; `help matrix nonuniform` describes it.
module wavycon_gnuplot_map
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_binary_file, only: binary_file
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: check_map_size, check_room, most_points
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: integer_text
   use wavycon_point_map, only: find_step
   implicit none (type, external)
   private

   public :: is_gnuplot, read_gnuplot_map

   integer, parameter :: number_bytes = 4

contains

   !> Whether a file can be a binary matrix: its first number is a number of columns that its length is a multiple of,
   !> and the next ones are equidistant.
   logical function is_gnuplot(file)
      type(binary_file), intent(inout) :: file   !! open

      real(dp) :: step
      real(dp), allocatable :: x(:)

      call find_columns(file, x)
      is_gnuplot = size(x) > 1
      if (is_gnuplot) call find_step(x, step, is_gnuplot)
   end function is_gnuplot

   !> Reads a map. Errors: exit_bad_input, exit_file_trouble.
   subroutine read_gnuplot_map(file, map, error)
      type(binary_file), intent(inout) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      real(dp), allocatable :: numbers(:), x(:), y(:)
      integer :: infinite, j, m, n
      logical :: is_regular

      call find_columns(file, x)
      m = size(x)
      if (m == 0) then
         call file%refuse('this is no binary matrix of gnuplot: the first number must be that of the columns, and '// &
                          'all rows must be complete', error)
         return
      end if
      n = int(file%bytes/(number_bytes*(m + 1))) - 1
      call check_map_size(file%path, [m, n], error)
      if (.not. allocated(error)) call check_room(file%path, [m, n], error)
      if (.not. allocated(error)) call file%go_to(int(number_bytes*(m + 1), int64), error)
      if (allocated(error)) return
      allocate (map%height(m, n), numbers(m + 1), y(n))
      do j = 1, n
         call file%read_numbers(numbers, infinite, error)
         if (allocated(error)) return
         if (infinite > 0) then
            call file%refuse('number '//integer_text(infinite)//' of row '//integer_text(j + 1)// &
                             ' is infinite: make it nan if it is a missing height', error)
            return
         end if
         y(j) = numbers(1)
         map%height(:, j) = numbers(2:)
      end do
      call find_step(x, map%step(1), is_regular)
      if (.not. is_regular) then
         call file%refuse('the x of its first row are not equidistant: interpolate the heights to a regular grid', &
                          error)
         return
      end if
      if (n > 1) call find_step(y, map%step(2), is_regular)
      if (.not. is_regular) then
         call file%refuse('the y of its first column are not equidistant: interpolate the heights to a regular grid', &
                          error)
         return
      end if
      ! x and y of the map rise.
      if (map%step(1) < 0.0_dp) map%height = map%height(m:1:-1, :)
      if (map%step(2) < 0.0_dp) map%height = map%height(:, n:1:-1)
      map%step = abs(map%step)
   end subroutine read_gnuplot_map

   !> The x of a file, in the byte order in which the first number is the number of columns. None if there is no such
   !> order or the rows are not complete.
   subroutine find_columns(file, x)
      type(binary_file), intent(inout) :: file
      real(dp), allocatable, intent(out) :: x(:)

      type(error_type), allocatable :: error
      integer :: columns, infinite, order
      real(dp) :: first(1)

      allocate (x(0))
      file%number_bytes = number_bytes
      if (file%bytes < 2*number_bytes) return
      do order = 1, 2
         file%big_end_first = order == 2
         call file%go_to(0_int64, error)
         if (.not. allocated(error)) call file%read_numbers(first, infinite, error)
         if (allocated(error)) return
         if (ieee_is_nan(first(1))) cycle
         if (.not. (first(1) >= 1.0_dp .and. first(1) <= most_points)) cycle
         columns = nint(first(1))
         if (abs(first(1) - columns) > 0.0_dp) cycle
         if (modulo(file%bytes, int(number_bytes*(columns + 1), int64)) /= 0) cycle
         if (file%bytes < 2*number_bytes*(columns + 1)) cycle
         deallocate (x)
         allocate (x(columns))
         call file%read_numbers(x, infinite, error)
         if (allocated(error)) deallocate (x)
         if (allocated(error)) allocate (x(0))
         return
      end do
   end subroutine find_columns

end module wavycon_gnuplot_map
