!> Interpolates a pressure to a grid of half the step, linearly between the points of the coarser grid.
module wavycon_grid_refinement
   use wavycon_grid_transform, only: image_of_point
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

      real(dp) :: half_way(size(coarse, 1)), part
      integer :: columns, j, k, m, n

      m = size(coarse, 1)
      n = size(coarse, 2)
      columns = merge(1, 2, n == 1)
      allocate (fine(2*m, columns*n))
      do j = 1, n
         do k = 1, columns
            part = parts(k, even)
            half_way = coarse(:, j)
            if (n > 1) half_way = part*coarse(:, j) + (1.0_dp - part)*coarse(:, image_of_point(j + merge(-1, 1, k == 1), n, even))
            associate (line => fine(:, columns*(j - 1) + k))
               if (.not. any(half_way > 0.0_dp)) then
                  line = 0.0_dp
                  cycle
               end if
               line(1::2) = parts(1, even)*half_way
               line(3::2) = line(3::2) + (1.0_dp - parts(1, even))*half_way(:m - 1)
               line(1) = line(1) + (1.0_dp - parts(1, even))*half_way(image_of_point(0, m, even))
               line(2::2) = parts(2, even)*half_way
               line(2:2*m - 2:2) = line(2:2*m - 2:2) + (1.0_dp - parts(2, even))*half_way(2:)
               line(2*m) = line(2*m) + (1.0_dp - parts(2, even))*half_way(image_of_point(m + 1, m, even))
            end associate
         end do
      end do
   end subroutine refine_pressure

   !> The part of the nearest coarse point in the first or second of its fine points: on a quarter of the cell it lies
   !> midway between both, on a whole cell at the first.
   pure real(dp) function parts(k, even)
      integer, intent(in) :: k
      logical, intent(in) :: even

      parts = 0.75_dp
      if (.not. even) parts = merge(1.0_dp, 0.5_dp, k == 1)
   end function parts

end module wavycon_grid_refinement
