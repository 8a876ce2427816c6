!> Tapers the borders of a height map: (M5) of README.md in this directory.
module wavycon_window
   use wavycon_constants, only: pi
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: taper_borders

contains

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

end module wavycon_window
