!> Interpolates a pressure to a grid of half the step, linearly between the points of the coarser grid.
module wavycon_grid_refinement
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: refine_pressure

contains

   !> The points are those of wavycon_grid_transform. The mean of the pressure does not change.
   pure subroutine refine_pressure(coarse, even, fine)
      real(dp), intent(in) :: coarse(:, :)                 !! shape (M, N); N = 1 in 1-D
      logical, intent(in) :: even                          !! whether the points are those of a quarter of the cell
      real(dp), allocatable, intent(out) :: fine(:, :)     !! shape (2M, 2N) or (2M, 1)

      real(dp), allocatable :: half_way(:, :)
      integer :: m, n, i

      m = size(coarse, 1)
      n = size(coarse, 2)
      allocate (half_way(2*m, n))
      if (even) then
         ! Each coarse point lies midway between two fine ones. The neighbour of the first point is its own mirror
         ! image, and so is that of the last point.
         half_way(1::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(max(i - 1, 1), i=1, m)], :)
         half_way(2::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(min(i + 1, m), i=1, m)], :)
      else
         half_way(1::2, :) = coarse
         half_way(2::2, :) = 0.5_dp*(coarse + coarse([(mod(i, m) + 1, i=1, m)], :))
      end if
      if (n == 1) then
         call move_alloc(half_way, fine)
         return
      end if
      allocate (fine(2*m, 2*n))
      if (even) then
         fine(:, 1::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(max(i - 1, 1), i=1, n)])
         fine(:, 2::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(min(i + 1, n), i=1, n)])
      else
         fine(:, 1::2) = half_way
         fine(:, 2::2) = 0.5_dp*(half_way + half_way(:, [(mod(i, n) + 1, i=1, n)]))
      end if
   end subroutine refine_pressure

end module wavycon_grid_refinement
