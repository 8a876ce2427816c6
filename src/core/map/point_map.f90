!> Makes height maps from lines of x, y and z, and profiles from lines of x and z; says whether numbers may be a matrix
!> of heights. README.md in this directory, "Points and tables", has the rules.
module wavycon_point_map
   use, intrinsic :: iso_c_binding, only: c_int, c_null_ptr, c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_gsl, only: gsl_interp_alloc, gsl_interp_eval, gsl_interp_free, gsl_interp_init, gsl_interp_steffen, &
      return_gsl_errors
   use wavycon_kinds, only: dp, ieee_is_nan, int64, not_a_number, smallest_number
   use wavycon_measured_map, only: check_map_size, check_room, laid_along_x, measured_map
   use wavycon_number_table, only: number_table
   use wavycon_plain_text, only: escaped, integer_text, short_number
   implicit none (type, external)
   private

   public :: check_matrix, resample_profile, take_points, take_profile

   !> Largest distance of a coordinate from the grid, in steps. Files round coordinates by up to a hundredth of a step.
   !> So do the outermost points, through which the grid is laid, and a point between may be off by twice as much.
   real(dp), parameter :: tolerance = 0.0201_dp

   !> Equidistant coordinates along x or y.
   type :: axis_type
      real(dp) :: first = 0.0_dp   !! the least coordinate
      real(dp) :: step = 0.0_dp    !! >= 0; 0 if there is only one coordinate
      integer :: number = 1        !! number of coordinates
   end type axis_type

contains

   !> Checks that a table is a matrix of heights. Errors: exit_bad_input if the first row or column seems to have
   !> coordinates or numbers of lines, and if the lines seem to be points x, y, z with further values behind z.
   subroutine check_matrix(table, error)
      type(number_table), intent(in) :: table
      type(error_type), allocatable, intent(out) :: error

      !> A first row or column with equal steps is not one of heights if the slope of the next one differs and if there
      !> are at least so many numbers: in one of them, and in both together. Fewer may have equal steps by chance:
      !> README.md of this directory.
      integer, parameter :: least_numbers = 5, least_of_both = 7
      !> A table with more columns is not one of points, and fewer lines may form a grid by chance.
      integer, parameter :: most_columns = 8, least_points = 9
      character(*), parameter :: advice = ": leave out what is no height, or give file_format = 'matrix' if all are"
      type(measured_map) :: map
      type(number_table) :: points
      type(error_type), allocatable :: trouble
      logical :: is_axis(2)   ! whether the first column, and the first row, may be coordinates

      associate (v => table%values, columns => size(table%values, 1), rows => size(table%values, 2))
         if (min(columns, rows) < 4) return
         is_axis = [are_coordinates(v(1, 2:), v(2, 2:)), are_coordinates(v(2:, 1), v(2:, 2))]
         if (any(is_axis .and. [rows, columns] > least_numbers) .or. &
             (all(is_axis) .and. rows + columns - 2 >= least_of_both)) then
            call table%refuse(1, 'the first '//trim(merge('column', 'row   ', is_axis(1)))//' has numbers in equal '// &
                              'steps, as coordinates or numbers of lines are'//advice, error)
         else if (columns <= most_columns .and. rows >= least_points) then
            points = table
            points%values = v(:3, :)
            call take_points(points, map, trouble)
            if (.not. allocated(trouble)) call table%refuse(1, 'columns 1 and 2 are x and y of a grid'//advice, error)
         end if
      end associate
   end subroutine check_matrix

   !> Makes a map from lines of x, y and z in any order. The height is NaN at points of the grid that have no line. x
   !> and y of the map rise. Errors: exit_bad_input if the points do not form a regular grid, and if they seem to be
   !> those of a profile with the numbers of its lines.
   subroutine take_points(table, map, error)
      type(number_table), intent(in) :: table    !! of three columns
      type(measured_map), intent(inout) :: map   !! gets heights and steps
      type(error_type), allocatable, intent(out) :: error

      !> If less than this percentage of the grid's points is there, the points are probably not those of a grid.
      integer, parameter :: least_percentage = 10
      type(axis_type) :: axis(2)
      character(:), allocatable :: grid_words
      logical, allocatable :: is_there(:, :)
      real(dp) :: steps(2)   ! a point's distance from the first coordinates, in steps
      integer :: k, node(2), points(2)

      if (size(table%values, 1) /= 3) then
         call table%refuse(1, 'this line has '//integer_text(size(table%values, 1))// &
                           " numbers: file_format = 'xyz' needs x, y and z", error)
         return
      end if
      k = findloc(any(ieee_is_nan(table%values(:2, :)), dim=1), .true., dim=1)
      if (k > 0) then
         call table%refuse(k, 'x and y must be numbers; a missing height is nan, or its line is left out', error)
         return
      end if
      if (is_numbered_profile(table%values)) then
         call table%refuse(1, 'the first column seems to number the lines of a profile: leave it out, so that each '// &
                           'line has x and z', error)
         return
      end if
      axis = [axis_of(table%values(1, :)), axis_of(table%values(2, :))]
      points = axis%number
      grid_words = integer_text(points(1))//' x '//integer_text(points(2))//' points'
      call check_map_size(table%path, laid_along_x(points), error)
      if (allocated(error)) return
      if (int(least_percentage, int64)*product(int(points, int64)) > 100*int(size(table%line), int64)) then
         call fatal_error(error, exit_bad_input, escaped(table%path)//': the grid of these points has '//grid_words// &
                          ' and only '//integer_text(size(table%line))//' of them are there: each line must '// &
                          'have x, y and z in this order; otherwise interpolate the heights to a regular grid')
         return
      end if
      call check_room(table%path, points, error)
      if (allocated(error)) return
      allocate (map%height(points(1), points(2)), source=not_a_number())
      allocate (is_there(points(1), points(2)), source=.false.)
      do k = 1, size(table%line)
         associate (point => table%values(:, k))
            steps = (point(:2) - axis%first)/merge(axis%step, 1.0_dp, points > 1)
            node = 1 + nint(steps)
            if (any(abs(steps - nint(steps)) > tolerance)) then
               call refuse(' is out of step: the points must form a regular grid, of '//grid_words//' as it seems, '// &
                           'and each line x, y and z in this order. Otherwise interpolate the heights to one')
               return
            else if (is_there(node(1), node(2))) then
               call refuse(' is a point of a line before')
               return
            end if
            is_there(node(1), node(2)) = .true.
            map%height(node(1), node(2)) = point(3)
         end associate
      end do
      map%step = axis%step

   contains

      !> Makes an error of the point k.
      subroutine refuse(words)
         character(*), intent(in) :: words

         call table%refuse(k, 'x = '//short_number(table%values(1, k))//', y = '//short_number(table%values(2, k))// &
                           words, error)
      end subroutine refuse

   end subroutine take_points

   !> Whether the first column has the numbers of the lines, from 0 or 1, and the second one rises or falls from line to
   !> line, as x of a profile does. No two points share a coordinate then, so that they are no map.
   pure logical function is_numbered_profile(values)
      real(dp), intent(in) :: values(:, :)   !! of three columns, shape (3, lines)

      integer :: k

      associate (v => values, n => size(values, 2))
         is_numbered_profile = n > 1 .and. any(abs(v(1, 1) - [0.0_dp, 1.0_dp]) <= 0.0_dp) .and. &
                               all(abs(v(1, :) - v(1, 1) - [(k, k=0, n - 1)]) <= 0.0_dp) .and. &
                               (all(v(2, 2:) > v(2, :n - 1)) .or. all(v(2, 2:) < v(2, :n - 1)))
      end associate
   end function is_numbered_profile

   !> The equidistant coordinates that the points may have. Whether all points are on them is for the caller to check.
   !>
   !> The range is divided into bins, four to the least possible step, and the lowest coordinate of each bin is kept.
   !> The gaps between these are steps, multiples of steps where whole rows are missing, or rounding errors. A gap below
   !> 1.25*tolerance of the step is a rounding error. The step is at first taken as the largest gap, and then again and
   !> again as the least gap that is no rounding error, until this does not change.
   pure type(axis_type) function axis_of(coordinate) result(axis)
      real(dp), intent(in) :: coordinate(:)   !! at least one

      !> Four bins to a step if there are 65536 points along a side, which is more than texts have.
      integer, parameter :: bins = 262144
      real(dp), allocatable :: lowest(:)   ! lowest coordinate of each bin, then only of the bins that have any
      real(dp) :: extent, gap, largest, last, step
      real(dp) :: steps                    ! sum of the gaps of one step
      integer :: b, k, number              ! number: how many gaps have one step

      axis%first = minval(coordinate)
      extent = maxval(coordinate) - axis%first
      if (.not. extent > smallest_number) return
      allocate (lowest(bins + 1), source=huge(1.0_dp))
      do k = 1, size(coordinate)
         b = 1 + int((coordinate(k) - axis%first)/extent*bins)
         lowest(b) = min(lowest(b), coordinate(k))
      end do
      lowest = pack(lowest, lowest < huge(1.0_dp))
      step = maxval(lowest(2:) - lowest(:size(lowest) - 1))
      do
         ! The mean of all gaps of one step has a smaller rounding error than the least of them.
         largest = step
         number = 0
         steps = 0.0_dp
         last = axis%first
         do b = 2, size(lowest)
            gap = lowest(b) - last
            if (gap <= max(2*extent/bins, 1.25_dp*tolerance*largest)) cycle
            last = lowest(b)
            step = min(step, gap)
            if (gap > 1.5_dp*largest) cycle
            number = number + 1
            steps = steps + gap
         end do
         if (.not. step < largest) exit
      end do
      ! If all gaps are below two bins, there are more coordinates than a map can have.
      if (number > 0) axis%number = nint(extent/(steps/number)) + 1
      if (number == 0) axis%number = bins + 1
      axis%step = extent/(axis%number - 1)
   end function axis_of

   !> Makes a profile from lines of x and z, in the order of rising x; missing heights are NaN. If the steps of x are
   !> not equal, the component `x` of the map is set, and the profile must be resampled. Errors: exit_bad_input if lines
   !> do not have two numbers, and if x neither rises nor falls from line to line.
   subroutine take_profile(table, map, error)
      type(number_table), intent(in) :: table    !! of two columns
      type(measured_map), intent(inout) :: map   !! gets heights and the mean step along x
      type(error_type), allocatable, intent(out) :: error

      real(dp), allocatable :: x(:)
      integer :: k, n

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
      if (k > 0) call table%refuse(k, 'x must be a number; a missing height is nan, or its line is left out', error)
      if (allocated(error)) return
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
      if (.not. rises_evenly(x)) call move_alloc(x, map%x)
   end subroutine take_profile

   !> Whether the numbers of the first row or column have equal steps, while the slope of the next row or column
   !> differs: by least squares it is less than half or more than twice as large. On a tilted plane both slopes are
   !> equal.
   pure logical function are_coordinates(values, next)
      real(dp), intent(in) :: values(:), next(:)   !! the two rows or columns, of equal size

      logical :: is_there(size(next))
      real(dp) :: from_mean(size(values)), squares

      is_there = .not. ieee_is_nan(next)
      from_mean = values - sum(values, mask=is_there)/max(1, count(is_there))
      squares = sum(from_mean**2, mask=is_there)
      are_coordinates = rises_evenly(values) .and. &
                        abs(2*sum(from_mean*next, mask=is_there) - 2.5_dp*squares) > 1.5_dp*squares
   end function are_coordinates

   !> Whether numbers rise, or fall, in equal steps.
   pure logical function rises_evenly(x)
      real(dp), intent(in) :: x(:)   !! three or more

      real(dp) :: step
      integer :: i

      step = (x(size(x)) - x(1))/(size(x) - 1)
      rises_evenly = abs(step) > 0.0_dp .and. all(abs(x - x(1) - step*[(i, i=0, size(x) - 1)]) <= tolerance*abs(step))
   end function rises_evenly

   !> Resamples a profile of unequal steps: interpolates the heights at as many points with equal steps, from the first
   !> x to the last, by (M7) of README.md in this directory. A new point is missing if one of the old points beside it
   !> is. Errors: exit_bad_input if there are fewer than three heights.
   subroutine resample_profile(path, map, error)
      character(*), intent(in) :: path           !! path of the map's file, for messages
      type(measured_map), intent(inout) :: map   !! its component `x` is allocated on entry, and not on exit
      type(error_type), allocatable, intent(out) :: error

      integer(c_size_t), parameter :: fewest = 3
      logical, allocatable :: missing(:)
      real(dp), allocatable :: x(:), z(:)
      real(dp) :: position
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
         position = map%x(1) + (i - 1)*map%step(1)
         do while (k < n - 1 .and. map%x(k + 1) < position)
            k = k + 1
         end do
         if (allocated(map%missing)) map%missing(i, 1) = any(missing(k:k + 1))
         map%height(i, 1) = gsl_interp_eval(curve, x, z, min(max(position, x(1)), x(size(x))), c_null_ptr)
      end do
      call gsl_interp_free(curve)
      if (allocated(map%missing)) where (map%missing) map%height = 0.0_dp
      map%uneven_steps = [minval(map%x(2:) - map%x(:n - 1)), maxval(map%x(2:) - map%x(:n - 1))]
      deallocate (map%x)
   end subroutine resample_profile

end module wavycon_point_map
