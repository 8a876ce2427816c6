!> The statistics of a height map, with its size, its format, and what was done to it.
module wavycon_map_statistics
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_map_tuning, only: border_ratio
   use wavycon_prepare_map, only: map_changes
   implicit none (type, external)
   private

   public :: map_statistics, statistics_of

   type :: map_statistics
      integer :: points(2) = 0                                      !! numbers of points along x and y
      character(7) :: format = ''                                   !! component of the same name of measured_map
      real(dp) :: lowest = 0.0_dp, highest = 0.0_dp, rms = 0.0_dp   !! of the heights less their mean [length]
      real(dp) :: skewness = 0.0_dp, kurtosis = 0.0_dp              !! eq. (M20); 0 for a flat map
      !> Differences between neighbours along x and along y: for each line between two rows or columns of points their
      !> root mean square is taken, and this is the largest one within the map [length].
      real(dp) :: largest_step(2) = 0.0_dp
      !> Root mean square of the differences between the last points and the first ones, which are neighbours if the map
      !> is continued periodically [length].
      real(dp) :: border_step(2) = 0.0_dp
      !> Along x and along y: the sum of the squared second differences about the first points, over that about the
      !> second ones; about 1 for smooth heights, 1 where the border is flat. Those about the first points have the last
      !> points in them, which are beyond the border.
      real(dp) :: border_bend(2) = 1.0_dp
      !> Along x and along y: whether the heights one point from the border are equal on both sides. Along y this is not
      !> known of a map that is distributed over processes, and counts as true.
      logical :: border_is_even(2) = .true.
      !> Root mean squares of slope and curvature by differences between neighbours, eq. (M25) [-, 1/length].
      real(dp) :: slope_by_differences = 0.0_dp, curvature_by_differences = 0.0_dp
      integer :: spikes = 0                        !! number of spikes, if the map was searched for them
      !> Number of heights of the file that equal the lowest or highest one, if it seems to stand for a missing height.
      integer :: placeholders = 0
      real(dp) :: placeholder = 0.0_dp             !! that height, in the unit of the file
      logical :: lacks_missing_value = .false.     !! whether the deck gives a missing_value that no height has
      logical :: has_sides = .true.                !! whether the file or the deck gives the sides
      character(:), allocatable :: assumed_sides   !! sides that neither deck nor file gives, in words; empty if none
      character(:), allocatable :: length_unit     !! unit of length that the file names, or the deck in its place
      !> Name of the one of two maps whose file names no unit while the other's does; not allocated if there is none.
      character(:), allocatable :: without_unit
      logical :: scales_unit = .false.             !! whether the deck scales heights whose file names their unit
      type(map_changes) :: changes                 !! what was done to the measured map
      character(:), allocatable :: path            !! absolute path of the file; empty if there is no file
   contains
      procedure :: is_broken_along, repeats_ends_along
   end type map_statistics

   !> Differences below this part of the heights are rounding.
   real(dp), parameter :: rounding = 1e-12_dp

contains

   !> Computes the statistics of a map, the moments by eq. (M20). The last digit of largest_step(1) may depend on how
   !> the map is distributed over processes.
   type(map_statistics) function statistics_of(height, file_format, points, step, repeats) result(statistics)
      real(dp), intent(in) :: height(:, :)      !! less the mean [length], shape (M, N) or (M, columns of the slab)
      character(*), intent(in) :: file_format   !! component `format` of measured_map
      integer, intent(in) :: points(2)          !! M, N of the map, which may be distributed
      real(dp), intent(in) :: step(2)           !! steps between the points along x and y [length]
      logical, intent(in) :: repeats            !! whether opposite borders are neighbours, as in a periodic map

      type(grid_slab) :: slab
      real(dp) :: extremes(2), unit

      statistics%points = points
      statistics%format = file_format
      statistics%path = ''
      statistics%assumed_sides = ''
      call slab%start(points)
      extremes = slab%extremes(height)
      statistics%lowest = -extremes(2)
      statistics%highest = extremes(1)
      unit = maxval(extremes)
      if (unit > 0.0_dp) call take_sums(slab, height, unit, step, repeats, statistics)
   end function statistics_of

   !> Computes the moments of the heights, the differences between neighbours, and from these slope and curvature, in
   !> one pass over the columns.
   subroutine take_sums(slab, height, unit, step, repeats, statistics)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: height(:, :)                  !! the own columns [length]
      real(dp), intent(in) :: unit                          !! the largest |height|, > 0 [length]
      real(dp), intent(in) :: step(2)                       !! as of statistics_of
      logical, intent(in) :: repeats                        !! as of statistics_of
      type(map_statistics), intent(inout) :: statistics

      real(dp), dimension(size(height, 1), 1) :: behind, next
      real(dp), dimension(size(height, 1)) :: ahead, bend, here, here_squared, to_last, to_next
      !> Sums over a column of the squared differences to the next column: the largest within the map; across its
      !> border; of the squared second differences about the first column and about the second one.
      real(dp) :: across(4)
      real(dp) :: moments(2:4), over_step(2), squares(size(height, 1)), numbers(3), x_steps(0:size(height, 1))
      !> For each column: 1, 2: sums of the squared differences along x, along y; 3: sum of the squared curvature; 4:
      !> squared difference between the last point along x and the first; 5 to 7: sums of the heights' powers 2 to 4; 8,
      !> 9: squared second differences about the first point along x and about the second one; 10: squared difference
      !> between the last but one point along x and the second one.
      real(dp) :: column_sums(10, size(height, 2)), totals(10)
      integer :: first, j, last

      ! Heights are divided by the largest one, steps by the least one: their powers do not overflow.
      over_step = minval(step)/step
      call slab%halo(height, .false., behind, next)
      ahead = height(:, 1)/unit
      to_next = ahead - behind(:, 1)/unit
      squares = 0.0_dp
      across = 0.0_dp
      column_sums = 0.0_dp
      associate (m => slab%points(1), n => slab%points(2))
         first = merge(1, 2, repeats)
         last = merge(m, m - 1, repeats)
         numbers = real(m, dp)*n
         if (.not. repeats) numbers = [real(m - 1, dp)*n, real(m, dp)*(n - 1), real(m - 2, dp)*max(n - 2, 1)]
         do j = 1, size(height, 2)
            here = ahead
            to_last = to_next
            if (j < size(height, 2)) then
               ahead = height(:, j + 1)/unit
            else
               ahead = next(:, 1)/unit
            end if
            to_next = ahead - here
            x_steps(1:m - 1) = here(2:) - here(:m - 1)
            x_steps(m) = here(1) - here(m)
            x_steps(0) = x_steps(m)
            squares = squares + x_steps(1:)**2
            column_sums(1, j) = inner_product(x_steps(1:last), x_steps(1:last))
            column_sums(4, j) = x_steps(m)**2
            column_sums(8:9, j) = (x_steps([1, min(2, m)]) - x_steps([0, 1]))**2
            column_sums(10, j) = (here(max(1, m - 1)) - here(min(2, m)))**2
            here_squared = here**2
            column_sums(5:7, j) = [inner_product(here, here), inner_product(here_squared, here), &
                             inner_product(here_squared, here_squared)]
            associate (column => slab%first - 1 + j, y_squares => inner_product(to_next, to_next))
               if (column < n) across(1) = max(across(1), y_squares)
               if (column == n) across(2) = y_squares
               if (any(column == [1, 2])) across(2 + column) = sum((to_next - to_last)**2)
               if (column < n .or. repeats) column_sums(2, j) = y_squares
               if (n > 1 .and. .not. repeats .and. any(column == [1, n])) cycle
            end associate
            bend = over_step(1)**2*(x_steps(1:) - x_steps(:m - 1))
            if (n > 1) bend = 0.5_dp*(bend + over_step(2)**2*(to_next - to_last))
            column_sums(3, j) = inner_product(bend(first:last), bend(first:last))
         end do
         squares = slab%total(squares)
         across = slab%largest(across)
         totals = slab%column_totals(column_sums)
         statistics%largest_step = unit*sqrt([maxval(squares(:m - 1))/n, across(1)/m])
         statistics%border_step = unit*sqrt([totals(4)/n, across(2)/m])
         moments = totals(5:7)/(real(m, dp)*n)
         where ([totals(8), across(3)] > 0.0_dp) &
            statistics%border_bend = [totals(8), across(3)]/max([totals(9), across(4)], epsilon(unit))
      end associate
      statistics%border_is_even(1) = totals(10) <= (rounding*size(height, 1))**2
      if (size(height, 2) == slab%points(2)) statistics%border_is_even(2) = all( &
         abs(height(:, max(1, slab%points(2) - 1)) - height(:, min(2, slab%points(2)))) <= rounding*unit)
      statistics%rms = unit*sqrt(moments(2))
      statistics%skewness = moments(3)/(moments(2)*sqrt(moments(2)))
      statistics%kurtosis = moments(4)/moments(2)**2
      totals(:3) = totals(:3)/max(numbers, 1.0_dp)
      statistics%slope_by_differences = unit/minval(step)*norm2(over_step*sqrt(totals(:2)))
      statistics%curvature_by_differences = unit/minval(step)**2*sqrt(totals(3))
   end subroutine take_sums

   !> The scalar product of two vectors, by the vector instructions of the processor.
   pure real(dp) function inner_product(a, b) result(total)
      real(dp), intent(in), contiguous :: a(:), b(:)

      integer :: i

      total = 0.0_dp
      !$omp simd reduction(+:total)
      do i = 1, size(a)
         total = total + a(i)*b(i)
      end do
   end function inner_product

   !> Whether the map jumps at its borders: whether the differences across the border are much larger than those across
   !> any line inside. In a periodic map they are like the others, in a tilted or cut patch as large as the heights. A
   !> map that is mirrored or has free edges has no differences across its border.
   elemental logical function is_broken_along(self, direction)
      class(map_statistics), intent(in) :: self
      integer, intent(in) :: direction   !! 1 or 2: along x or y

      is_broken_along = all(self%changes%edges /= ['mirror', 'free  ']) .and. &
                        self%border_step(direction) > border_ratio*self%largest_step(direction)
   end function is_broken_along

   !> Whether the last points seem to be the first ones once more. Their heights are equal, and then the map is not even
   !> about its border, or it bends there a quarter as much as beside. A periodic map ends a step before. An even map
   !> whose points are half a step from the border has equal heights too: smooth ones bend there as beside, white
   !> noise a third as much.
   elemental logical function repeats_ends_along(self, direction)
      class(map_statistics), intent(in) :: self
      integer, intent(in) :: direction   !! 1 or 2: along x or y

      real(dp), parameter :: least_bend = 0.29_dp

      repeats_ends_along = self%changes%edges == 'periodic' .and. self%largest_step(direction) > 0.0_dp .and. &
                           self%border_step(direction) <= rounding*self%largest_step(direction) .and. &
                           .not. (self%border_is_even(direction) .and. self%border_bend(direction) > least_bend)
   end function repeats_ends_along

end module wavycon_map_statistics
