!> Interpolates a pressure to a grid of half the step, linearly between the points of the coarser grid.
module wavycon_grid_refinement
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: image_of_point
   use wavycon_kinds, only: dp
   use wavycon_ranks, only: move_columns, ranks_at_work, this_rank
   implicit none (type, external)
   private

   public :: refine_pressure

contains

   !> The points are those of wavycon_grid_transform. The mean of the pressure does not change.
   subroutine refine_pressure(coarse, coarse_slab, even, fine_slab, fine)
      real(dp), intent(in), contiguous :: coarse(:, :)   !! own columns, shape (M, coarse_slab%columns())
      type(grid_slab), intent(in) :: coarse_slab         !! of M x N points; N = 1 in 1-D
      logical, intent(in) :: even                        !! whether the points are those of a quarter of the cell
      type(grid_slab), intent(in) :: fine_slab           !! of 2M x 2N or 2M x 1 points; spread if coarse_slab is
      real(dp), allocatable, intent(out) :: fine(:, :)   !! own columns, shape (2M, fine_slab%columns())

      real(dp), allocatable :: fetched(:, :)
      integer :: first, last

      allocate (fine(fine_slab%points(1), fine_slab%columns()))
      if (fine_slab%points(2) == 1) then
         call refine_line(coarse(:, 1), even, fine(:, 1))
      else if (coarse_slab%is_spread) then
         first = (fine_slab%first + 1)/2
         last = fine_slab%last/2
         allocate (fetched(coarse_slab%points(1), first - 1:last + 1))
         call fetch_columns(coarse, coarse_slab, even, fine_slab, first - 1, fetched)
         call refine_columns(fetched, first - 1, even, fine_slab, fine)
      else
         call refine_columns(coarse, 1, even, fine_slab, fine)
      end if
   end subroutine refine_pressure

   !> Takes the coarse columns of the own fine ones from the ranks that have them, and one more on each side: the next
   !> column or, at the rim of the grid, its image.
   subroutine fetch_columns(coarse, coarse_slab, even, fine_slab, start, fetched)
      real(dp), intent(in), contiguous :: coarse(:, :)
      type(grid_slab), intent(in) :: coarse_slab, fine_slab
      logical, intent(in) :: even
      integer, intent(in) :: start                                  !! the first column to fetch; 0: an image
      real(dp), intent(inout), contiguous :: fetched(:, start:)

      integer, parameter :: no_columns(2) = [1, 0]
      integer, allocatable, dimension(:, :) :: have, images, want   ! first and last column of each rank
      integer :: last_rank, place(2), rank

      allocate (have(2, 0:ranks_at_work() - 1))
      allocate (images, want, mold=have)
      have = coarse_slab%blocks()
      want = fine_slab%blocks()
      images = spread(no_columns, 2, size(images, 2))
      last_rank = fine_slab%owner(fine_slab%points(2))
      associate (n => coarse_slab%points(2))
         do rank = 0, ubound(want, 2)
            want(:, rank) = merge([max((want(1, rank) + 1)/2 - 1, 1), min(want(2, rank)/2 + 1, n)], no_columns, &
                                  want(1, rank) <= want(2, rank))
         end do
         images(:, 0) = image_of_point(0, n, even)
         images(:, last_rank) = image_of_point(n + 1, n, even)
         place = no_columns
         if (this_rank() == 0) place = 0
         if (this_rank() == last_rank) place = n + 1
      end associate
      call move_columns(have, coarse, want, fetched(:, want(1, this_rank()):want(2, this_rank())))
      call move_columns(have, coarse, images, fetched(:, place(1):place(2)))
   end subroutine fetch_columns

   !> The own fine columns from all coarse columns, or from those that they need.
   pure subroutine refine_columns(coarse, start, even, fine_slab, fine)
      integer, intent(in) :: start                  !! the first of the coarse columns
      real(dp), intent(in) :: coarse(:, start:)
      logical, intent(in) :: even
      type(grid_slab), intent(in) :: fine_slab
      real(dp), intent(inout) :: fine(:, :)

      integer :: j, near, other
      real(dp) :: part

      do j = fine_slab%first, fine_slab%last
         near = (j + 1)/2
         other = near + merge(1, -1, mod(j, 2) == 0)
         if (other < start .or. other > ubound(coarse, 2)) other = image_of_point(other, fine_slab%points(2)/2, even)
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

   !> The part of the nearest coarse point in the first or second of its fine points: on a quarter of the cell it lies
   !> midway between both, on a whole cell at the first.
   pure real(dp) function parts(k, even)
      integer, intent(in) :: k
      logical, intent(in) :: even

      parts = 0.75_dp
      if (.not. even) parts = merge(1.0_dp, 0.5_dp, k == 1)
   end function parts

end module wavycon_grid_refinement
