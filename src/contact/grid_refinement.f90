!> Interpolates a pressure to a grid of half the step, linearly between the points of the coarser grid.
module wavycon_grid_refinement
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: refine_pressure

contains

   !> The points are those of wavycon_grid_points. The mean of the pressure does not change.
   subroutine refine_pressure(coarse, coarse_slab, even, fine_slab, fine)
      real(dp), intent(in), contiguous :: coarse(:, :)   !! own columns, shape (M, coarse_slab%columns())
      type(grid_slab), intent(in) :: coarse_slab         !! of M x N points; N = 1 in 1-D
      logical, intent(in) :: even                        !! whether the points are those of a quarter of the cell
      type(grid_slab), intent(in) :: fine_slab           !! of 2M x 2N or 2M x 1 points; distributed if coarse_slab is
      real(dp), allocatable, intent(out) :: fine(:, :)   !! own columns, shape (2M, fine_slab%columns())

      real(dp), allocatable :: needed(:, :)
      integer :: first, last, side

      allocate (fine(fine_slab%points(1), fine_slab%columns()))
      if (fine_slab%points(2) == 1) then
         call refine_line(coarse(:, 1), even, fine(:, 1))
         return
      end if
      ! The coarse columns of the own fine ones, and one more on each side: the next column or its image.
      side = merge(1, 0, fine_slab%columns() > 0)
      first = (fine_slab%first + 1)/2 - side
      last = fine_slab%last/2 + side
      allocate (needed(coarse_slab%points(1), first:last))
      call coarse_slab%fetch(coarse, even, first, needed)
      call refine_columns(needed, first, even, fine_slab, fine)
   end subroutine refine_pressure

   !> The own fine columns from the coarse columns that they need.
   pure subroutine refine_columns(coarse, start, even, fine_slab, fine)
      integer, intent(in) :: start                  !! the first of the coarse columns; 0: an image
      real(dp), intent(in) :: coarse(:, start:)
      logical, intent(in) :: even
      type(grid_slab), intent(in) :: fine_slab
      real(dp), intent(inout) :: fine(:, :)

      integer :: j, near, other
      real(dp) :: part

      do j = fine_slab%first, fine_slab%last
         near = (j + 1)/2
         other = near + merge(1, -1, mod(j, 2) == 0)
         part = parts(2 - mod(j, 2), even)
         call refine_line(part*coarse(:, near) + (1.0_dp - part)*coarse(:, other), even, &
                          fine(:, j - fine_slab%first + 1))
      end do
   end subroutine refine_columns

   !> Twice as many points along a line.
   pure subroutine refine_line(coarse, even, fine)
      real(dp), intent(in) :: coarse(:)    !! shape (M)
      logical, intent(in) :: even
      real(dp), intent(out) :: fine(:)     !! shape (2M)

      integer :: m

      m = size(coarse)
      if (.not. any(coarse > 0.0_dp)) then
         fine = 0.0_dp
         return
      end if
      fine(1::2) = parts(1, even)*coarse
      fine(3::2) = fine(3::2) + (1.0_dp - parts(1, even))*coarse(:m - 1)
      fine(1) = fine(1) + (1.0_dp - parts(1, even))*coarse(image_of_point(0, m, even))
      fine(2::2) = parts(2, even)*coarse
      fine(2:2*m - 2:2) = fine(2:2*m - 2:2) + (1.0_dp - parts(2, even))*coarse(2:)
      fine(2*m) = fine(2*m) + (1.0_dp - parts(2, even))*coarse(image_of_point(m + 1, m, even))
   end subroutine refine_line

   !> The weight of the nearest coarse point in the first or second of its two fine points: on a quarter of the cell it
   !> lies midway between both, on a whole cell at the first.
   pure real(dp) function parts(k, even)
      integer, intent(in) :: k
      logical, intent(in) :: even

      parts = 0.75_dp
      if (.not. even) parts = merge(1.0_dp, 0.5_dp, k == 1)
   end function parts

end module wavycon_grid_refinement
