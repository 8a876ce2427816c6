!> Leaves short waves out of a height map.
module wavycon_low_pass
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: leave_out_short_waves

contains

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
      real(dp) :: length(2), squares(1)
      integer :: k, l

      length = merge(2, 1, mirrored)*sides
      call transform%start(points, even=mirrored)
      call transform%series(height, waves)
      do l = 0, ubound(waves%c, 2)
         do k = lbound(waves%c, 1), ubound(waves%c, 1)
            if (shortest*hypot(k/length(1), l/length(2)) <= 1 + rounding) cycle
            waves%c(k, l) = 0.0_dp
            if (waves%is_even()) cycle
            waves%cs(k, l) = 0.0_dp
            waves%sc(k, l) = 0.0_dp
            waves%ss(k, l) = 0.0_dp
         end do
      end do
      allocate (smooth, mold=height)
      call transform%sample(waves, smooth)
      squares = transform%slab%column_totals(reshape(sum((height - smooth)**2, dim=1), [1, size(height, 2)]))
      removed = sqrt(squares(1)/product(real(points, dp)))
      height = smooth
   end subroutine leave_out_short_waves

end module wavycon_low_pass
