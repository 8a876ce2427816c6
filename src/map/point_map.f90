!> Makes height maps from lines of x, y and z.
module wavycon_point_map
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: smallest_number
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: check_map_size, check_room, laid_along_x
   use wavycon_measured_map, only: measured_map
   use wavycon_number_table, only: number_table
   use wavycon_plain_text, only: escaped, integer_text, short_number
   implicit none (type, external)
   private

   public :: take_points

   !> Largest deviation of a point from the grid, in steps: coordinates in files are often rounded.
   real(dp), parameter, public :: tolerance = 0.01_dp

   !> Equidistant coordinates.
   type :: axis_type
      real(dp) :: first = 0.0_dp   !! the least
      real(dp) :: step = 0.0_dp    !! >= 0; 0 if there is one coordinate
      integer :: number = 1
   end type axis_type

contains

   !> Makes a map from points in any order; heights of points without a line are NaN. x and y of the map rise. Errors:
   !> exit_bad_input if the points do not form a regular grid.
   subroutine take_points(table, map, error)
      type(number_table), intent(in) :: table
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      !> So few points are more likely points without a grid.
      integer, parameter :: least_percentage = 10
      type(axis_type) :: axis(2)
      character(:), allocatable :: grid_words
      logical, allocatable :: is_there(:, :)
      integer :: k, place(2), points(2)

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
      axis = [axis_of(table%values(1, :)), axis_of(table%values(2, :))]
      points = axis%number
      grid_words = integer_text(points(1))//' x '//integer_text(points(2))//' points'
      call check_map_size(table%path, laid_along_x(points), error)
      if (allocated(error)) return
      if (int(least_percentage, int64)*product(int(points, int64)) > 100*int(size(table%line), int64)) then
         call fatal_error(error, exit_bad_input, escaped(table%path)//': the grid of these points has '//grid_words// &
                          ' and only '//integer_text(size(table%line))//' of them are there: interpolate the '// &
                          'heights to a regular grid')
         return
      end if
      call check_room(table%path, points, error)
      if (allocated(error)) return
      allocate (map%height(points(1), points(2)), source=ieee_value(0.0_dp, ieee_quiet_nan))
      allocate (is_there(points(1), points(2)), source=.false.)
      do k = 1, size(table%line)
         associate (point => table%values(:, k))
            place = index_on(axis, point(:2))
            if (.not. all(is_on(axis, point(:2)))) then
               call refuse(' is out of step: the points must form a regular grid, of '//grid_words// &
                           ' as it seems. Interpolate the heights to one')
               return
            else if (is_there(place(1), place(2))) then
               call refuse(' is a point of a line before')
               return
            end if
            is_there(place(1), place(2)) = .true.
            map%height(place(1), place(2)) = point(3)
         end associate
      end do
      map%step = axis%step

   contains

      subroutine refuse(words)
         character(*), intent(in) :: words

         call table%refuse(k, 'x = '//short_number(table%values(1, k))//', y = '//short_number(table%values(2, k))// &
                           words, error)
      end subroutine refuse

   end subroutine take_points

   !> The equidistant coordinates that points have, if they have such.
   !>
   !> The range is divided into bins, four to the least step. The gaps between the bins that hold coordinates are steps,
   !> multiples of steps where whole rows are missing, or rounding errors, which are smaller than all of these.
   pure type(axis_type) function axis_of(coordinate) result(axis)
      real(dp), intent(in) :: coordinate(:)   !! at least one

      !> Four to a step of 65536 points, more than texts have along a side.
      integer, parameter :: bins = 262144
      real(dp), allocatable :: lowest(:)
      logical, allocatable :: is_filled(:)
      real(dp) :: extent, gap, largest, last, step, steps
      integer :: b, k, number, pass

      axis%first = minval(coordinate)
      extent = maxval(coordinate) - axis%first
      if (.not. extent > smallest_number) return
      allocate (lowest(0:bins), source=0.0_dp)
      allocate (is_filled(0:bins), source=.false.)
      do k = 1, size(coordinate)
         b = int((coordinate(k) - axis%first)/extent*bins)
         if (is_filled(b)) then
            lowest(b) = min(lowest(b), coordinate(k))
         else
            lowest(b) = coordinate(k)
            is_filled(b) = .true.
         end if
      end do
      largest = 0.0_dp
      last = axis%first
      do b = 1, bins
         if (.not. is_filled(b)) cycle
         largest = max(largest, lowest(b) - last)
         last = lowest(b)
      end do
      ! First the least step, then the mean of the equal steps, whose rounding error is smaller.
      step = extent
      do pass = 1, 2
         number = 0
         steps = 0.0_dp
         last = axis%first
         do b = 1, bins
            if (.not. is_filled(b)) cycle
            gap = lowest(b) - last
            if (gap <= max(2*extent/bins, 2*tolerance*largest)) cycle
            last = lowest(b)
            if (pass == 1) step = min(step, gap)
            if (pass == 1 .or. gap > 1.5_dp*step) cycle
            number = number + 1
            steps = steps + gap
         end do
      end do
      ! Without a gap that large there are more coordinates than a map can have.
      if (number > 0) axis%number = nint(extent/(steps/number)) + 1
      if (number == 0) axis%number = bins + 1
      axis%step = extent/(axis%number - 1)
   end function axis_of

   !> The number of the coordinate of an axis that is closest to a value, from 1 on.
   elemental integer function index_on(axis, coordinate)
      type(axis_type), intent(in) :: axis
      real(dp), intent(in) :: coordinate

      index_on = 1
      if (axis%number > 1) index_on = 1 + nint((coordinate - axis%first)/axis%step)
   end function index_on

   !> Whether a value is a coordinate of an axis.
   elemental logical function is_on(axis, coordinate)
      type(axis_type), intent(in) :: axis
      real(dp), intent(in) :: coordinate

      is_on = abs(coordinate - axis%first - (index_on(axis, coordinate) - 1)*axis%step) <= tolerance*axis%step
   end function is_on

end module wavycon_point_map
