!> Filters of height maps: removal of spikes by a median rule, (M8), taper of the borders, (M5), and removal of short
!> or long waves, (M9). The equations are those of README.md in this directory.
module wavycon_map_filters
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, pi
   use wavycon_map_tuning, only: reach_of_spike
   implicit none (type, external)
   private

   public :: find_spikes, leave_out_waves, taper_borders

   !> The neighbours of a height are the points at most so many steps away: in each direction of a map; along a profile.
   integer, parameter :: reach_in_map = 2, reach_in_profile = 6

contains

   !> Counts the spikes of a map, (M8), and replaces each by the median of its neighbours on demand. A spike is a height
   !> that differs from this median by more than a multiple of the neighbours' range, and of the mean of this range over
   !> the heights that are there.
   subroutine find_spikes(height, missing, number, replace)
      real(dp), intent(inout) :: height(:, :)                 !! shape (M, N), a whole map; N = 1 for a profile
      logical, allocatable, intent(in) :: missing(:, :)       !! shape of height; not allocated if none is missing
      integer, intent(out) :: number                          !! number of spikes
      logical, intent(in) :: replace                          !! whether spikes are replaced; if not only counted

      real(dp) :: mean_range, median, range_of_neighbours
      logical, allocatable :: is_there(:, :)
      real(dp), allocatable :: original(:, :)
      integer :: i, j, pass   ! pass 1 finds the mean range, pass 2 the spikes

      allocate (original, source=height)
      allocate (is_there(size(height, 1), size(height, 2)), source=.true.)
      if (allocated(missing)) is_there = .not. missing
      number = 0
      mean_range = 0.0_dp
      do pass = 1, 2
         do j = 1, size(height, 2)
            do i = 1, size(height, 1)
               if (.not. is_there(i, j)) cycle
               call compare_neighbours(i, j, median, range_of_neighbours)
               if (pass == 1) mean_range = mean_range + range_of_neighbours
               if (pass == 1) cycle
               if (.not. abs(original(i, j) - median) > reach_of_spike*max(range_of_neighbours, mean_range)) cycle
               number = number + 1
               if (replace) height(i, j) = median
            end do
         end do
         if (pass == 1) mean_range = mean_range/max(count(is_there), 1)
      end do

   contains

      !> Finds the median and the range of the neighbours of a height that are not missing. The range leaves out a sixth
      !> of the neighbours at either end, which may be parts of the same spike. With fewer than six neighbours the
      !> median is the height itself, and the range 0.
      pure subroutine compare_neighbours(i, j, median, width)
         integer, intent(in) :: i, j                !! the point
         real(dp), intent(out) :: median, width     !! median and range

         real(dp) :: sorted((2*reach_in_map + 1)**2)
         integer :: reach(2), k, l, m, n

         reach = reach_in_map
         if (size(height, 2) == 1) reach = [reach_in_profile, 0]
         n = 0
         do l = max(1, j - reach(2)), min(size(height, 2), j + reach(2))
            do k = max(1, i - reach(1)), min(size(height, 1), i + reach(1))
               if ((k == i .and. l == j) .or. .not. is_there(k, l)) cycle
               n = n + 1
               do m = n, 2, -1
                  if (sorted(m - 1) <= original(k, l)) exit
                  sorted(m) = sorted(m - 1)
               end do
               sorted(m) = original(k, l)
            end do
         end do
         median = original(i, j)
         width = 0.0_dp
         if (n < 6) return
         median = 0.5_dp*(sorted((n + 1)/2) + sorted(n/2 + 1))
         width = sorted(n - n/6) - sorted(1 + n/6)
      end subroutine compare_neighbours

   end subroutine find_spikes

   !> Subtracts the mean of the heights and multiplies them by Tukey's window, (M5), along x and along y. So the heights
   !> vanish at the borders.
   subroutine taper_borders(width, slab, height, changed)
      real(dp), intent(in) :: width             !! width of the taper at each border over the side, 0 < width <= 1/2
      type(grid_slab), intent(in) :: slab       !! which columns of the map `height` has; N = 1 for a profile
      real(dp), intent(inout) :: height(:, :)   !! shape (M, slab%columns())
      real(dp), intent(out) :: changed          !! part of the points at which the window is below 1

      real(dp) :: along_x(slab%points(1)), along_y(slab%points(2)), mean(1)
      integer :: j

      along_x = window(slab%points(1), width)
      along_y = window(slab%points(2), width)
      ! The second pass removes the rounding error of the first one, which is large if the mean is.
      do j = 1, 2
         mean = slab%column_totals(reshape(sum(height, dim=1), [1, size(height, 2)]))/product(real(slab%points, dp))
         height = height - mean(1)
      end do
      do j = 1, size(height, 2)
         height(:, j) = along_y(slab%first - 1 + j)*along_x*height(:, j)
      end do
      changed = 1.0_dp - real(count(along_x >= 1.0_dp), dp)*count(along_y >= 1.0_dp)/product(real(slab%points, dp))
   end subroutine taper_borders

   !> The window (M5) at the points of one direction. For a single point, a profile's direction y, the window is 1.
   pure function window(points, width) result(values)
      integer, intent(in) :: points       !! number of points in this direction
      real(dp), intent(in) :: width       !! v of (M5)
      real(dp) :: values(points)

      real(dp) :: distance   ! of the point from the nearer border, over the side
      integer :: i

      values = 1.0_dp
      if (points == 1) return
      do i = 1, points
         distance = (min(i, points + 1 - i) - 0.5_dp)/points
         if (distance < width) values(i) = sin(0.5_dp*pi*distance/width)**2
      end do
   end function window

   !> Removes the short or the long waves of the map's Fourier series, in whatever direction they run: sharply those
   !> that are shorter or longer than the cut-off, or all waves in part, as the Gaussian filter (M9) does. The mean
   !> stays.
   subroutine leave_out_waves(points, sides, mirrored, which, filter, cut_off, height, removed)
      integer, intent(in) :: points(2)                     !! M, N of the map
      real(dp), intent(in) :: sides(2)                     !! sides of the map along x and y, in one unit, > 0
      logical, intent(in) :: mirrored                      !! whether mirror images continue the map
      character(*), intent(in) :: which                    !! 'shorter' or 'longer'
      character(*), intent(in) :: filter                   !! 'sharp' or 'gaussian'
      real(dp), intent(in) :: cut_off                      !! cut-off wavelength, in the same unit, > 0
      real(dp), intent(inout), contiguous :: height(:, :)  !! shape (M, N), or the own columns of the grid's slab
      real(dp), intent(out) :: removed                     !! root mean square of what was removed [height]

      !> A wave whose length differs from the cut-off by rounding stays.
      real(dp), parameter :: rounding = 1e-12_dp
      type(fourier_series) :: waves
      type(grid_transform) :: transform
      real(dp), allocatable :: factor(:, :), ratio(:, :), smooth(:, :)   ! ratio: of the cut-off to the wavelength
      real(dp) :: periods(2), squares(1)

      periods = merge(2, 1, mirrored)*sides
      call transform%start(points, even=mirrored)
      call transform%series(height, waves)
      ratio = cut_off*waves%frequencies(periods)
      if (filter == 'gaussian') then
         factor = exp(-log(2.0_dp)*ratio**2)
         if (which == 'longer') factor = 1.0_dp - factor
      else if (which == 'longer') then
         factor = merge(1.0_dp, 0.0_dp, ratio >= 1 - rounding)
      else
         factor = merge(1.0_dp, 0.0_dp, ratio <= 1 + rounding)
      end if
      where (ratio <= 0.0_dp) factor = 1.0_dp
      call waves%multiply(factor)
      allocate (smooth, mold=height)
      call transform%sample(waves, smooth)
      squares = transform%slab%column_totals(reshape(sum((height - smooth)**2, dim=1), [1, size(height, 2)]))
      removed = sqrt(squares(1)/product(real(points, dp)))
      height = smooth
   end subroutine leave_out_waves

end module wavycon_map_filters
