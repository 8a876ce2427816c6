!> Filters of height maps: spikes by a median rule (M8), tapered borders (M5), short waves.
module wavycon_map_filters
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_map_tuning, only: reach_of_spike
   implicit none (type, external)
   private

   public :: find_spikes, leave_out_short_waves, taper_borders

   !> Neighbours of a height: those up to so many points away, in each direction of a map, along a profile.
   integer, parameter :: around_in_map = 2, around_in_profile = 6

contains

   !> Counts the heights that differ from the median of their neighbours by more than a multiple of what these differ
   !> among themselves, here and on the average over the map, and replaces them by this median on demand.
   subroutine find_spikes(height, missing, number, replace)
      real(dp), intent(inout) :: height(:, :)                 !! shape (M, N), a whole map; N = 1 for a profile
      logical, allocatable, intent(in) :: missing(:, :)       !! shape of height; not allocated if none is missing
      integer, intent(out) :: number                          !! of spikes
      logical, intent(in) :: replace                          !! by the median of the neighbours; their number only

      real(dp) :: median, spread, spreads
      logical, allocatable :: there(:, :)
      real(dp), allocatable :: was(:, :)
      integer :: i, j, pass

      allocate (was, source=height)
      allocate (there(size(height, 1), size(height, 2)), source=.true.)
      if (allocated(missing)) there = .not. missing
      number = 0
      spreads = 0.0_dp
      do pass = 1, 2
         do j = 1, size(height, 2)
            do i = 1, size(height, 1)
               if (.not. there(i, j)) cycle
               call look_around(i, j, median, spread)
               if (pass == 1) spreads = spreads + spread
               if (pass == 1) cycle
               if (.not. abs(was(i, j) - median) > reach_of_spike*max(spread, spreads/size(height))) cycle
               number = number + 1
               if (replace) height(i, j) = median
            end do
         end do
      end do

   contains

      !> The median of the neighbours of a height that are there, and by how much they differ without the sixth of them
      !> at either end, which may be parts of the same spike. With fewer than six a height is its own median.
      pure subroutine look_around(i, j, median, spread)
         integer, intent(in) :: i, j
         real(dp), intent(out) :: median, spread

         real(dp) :: sorted((2*around_in_map + 1)**2)
         integer :: around(2), k, l, m, n

         around = around_in_map
         if (size(height, 2) == 1) around = [around_in_profile, 0]
         n = 0
         do l = max(1, j - around(2)), min(size(height, 2), j + around(2))
            do k = max(1, i - around(1)), min(size(height, 1), i + around(1))
               if ((k == i .and. l == j) .or. .not. there(k, l)) cycle
               n = n + 1
               do m = n, 2, -1
                  if (sorted(m - 1) <= was(k, l)) exit
                  sorted(m) = sorted(m - 1)
               end do
               sorted(m) = was(k, l)
            end do
         end do
         median = was(i, j)
         spread = 0.0_dp
         if (n < 6) return
         median = 0.5_dp*(sorted((n + 1)/2) + sorted(n/2 + 1))
         spread = sorted(n - n/6) - sorted(1 + n/6)
      end subroutine look_around

   end subroutine find_spikes

   !> Multiplies the heights over their mean by Tukey's window along x and along y, so that they vanish at the borders.
   subroutine taper_borders(width, slab, height, changed)
      real(dp), intent(in) :: width             !! of the taper at each border, over the side, 0 < width <= 1/2
      type(grid_slab), intent(in) :: slab       !! the columns of the map, N = 1 for a profile
      real(dp), intent(inout) :: height(:, :)   !! shape (M, slab%columns()); then over the mean
      real(dp), intent(out) :: changed          !! part of the points at which the window is below 1

      real(dp) :: along_x(slab%points(1)), along_y(slab%points(2)), mean(1)
      integer :: j

      along_x = window(slab%points(1), width)
      along_y = window(slab%points(2), width)
      ! The second pass removes what rounding left of a large mean in the first.
      do j = 1, 2
         mean = slab%column_totals(reshape(sum(height, dim=1), [1, size(height, 2)]))/product(real(slab%points, dp))
         height = height - mean(1)
      end do
      do j = 1, size(height, 2)
         height(:, j) = along_y(slab%first - 1 + j)*along_x*height(:, j)
      end do
      changed = 1.0_dp - real(count(along_x >= 1.0_dp), dp)*count(along_y >= 1.0_dp)/product(real(slab%points, dp))
   end subroutine taper_borders

   !> The window (M5) at the points of one direction; 1 for a single point, which has no border.
   pure function window(points, width) result(values)
      integer, intent(in) :: points
      real(dp), intent(in) :: width
      real(dp) :: values(points)

      real(dp) :: distance   ! from the nearer border, over the side
      integer :: i

      values = 1.0_dp
      if (points == 1) return
      do i = 1, points
         distance = (min(i, points + 1 - i) - 0.5_dp)/points
         if (distance < width) values(i) = sin(0.5_dp*pi*distance/width)**2
      end do
   end function window

   !> Removes the waves of the map's Fourier series that are shorter than a wavelength, in any direction.
   subroutine leave_out_short_waves(points, sides, mirrored, shortest, height, removed)
      integer, intent(in) :: points(2)                     !! M, N of the map
      real(dp), intent(in) :: sides(2)                     !! of the map along x and y, in one unit, > 0
      logical, intent(in) :: mirrored                      !! whether mirror images continue it
      real(dp), intent(in) :: shortest                     !! wavelength that stays, in the same unit, > 0
      real(dp), intent(inout), contiguous :: height(:, :)  !! shape (M, N), or own columns of the grid's slab
      real(dp), intent(out) :: removed                     !! root mean square of what was removed [height]

      !> A wave whose length differs from the shortest by rounding stays.
      real(dp), parameter :: rounding = 1e-12_dp
      type(fourier_series) :: waves
      type(grid_transform) :: transform
      real(dp), allocatable :: smooth(:, :)
      real(dp) :: squares(1)

      call transform%start(points, even=mirrored)
      call transform%series(height, waves)
      call waves%multiply(merge(1.0_dp, 0.0_dp, &
                                shortest*waves%frequencies(merge(2, 1, mirrored)*sides) <= 1 + rounding))
      allocate (smooth, mold=height)
      call transform%sample(waves, smooth)
      squares = transform%slab%column_totals(reshape(sum((height - smooth)**2, dim=1), [1, size(height, 2)]))
      removed = sqrt(squares(1)/product(real(points, dp)))
      height = smooth
   end subroutine leave_out_short_waves

end module wavycon_map_filters
