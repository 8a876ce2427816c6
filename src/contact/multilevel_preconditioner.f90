!> Continues a field from the contact to the points outside it, over grids of ever larger steps, and the adjoint of
!> that: equations (C4a) to (C4c) of README.md in this directory.
!>
!> The multilevel preconditioner uses it. A point of each coarser grid has the mean of two by two points of the finer
!> one; the sequence ends where a number of points is odd. If the grid is distributed, so are the large ones of the
!> coarser grids; small ones are whole.
module wavycon_multilevel_preconditioner
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_tuning, only: decay_alone, decay_growth
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab, least_distributed_points
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: multilevel_preconditioner

   !> The coarsest grid has at least this many points each way.
   integer, parameter :: least_points = 4

   type :: coarse_grid
      type(grid_slab) :: slab                  !! the columns of the arrays
      type(grid_slab) :: part                  !! the columns whose means are taken from the finer slab: all or some
      real(sp), allocatable :: contact(:, :)   !! part of a point's area that is in contact, 0 to 1
      real(sp), allocatable :: values(:, :)
   end type coarse_grid

   type :: multilevel_preconditioner
      private
      logical :: even = .false.                !! whether the field is mirrored at the borders; otherwise it is periodic
      real(sp) :: decay = 1.0_sp               !! factor of a value for each doubling of the distance from the contact
      type(grid_slab) :: slab
      type(coarse_grid), allocatable :: grids(:)
   contains
      procedure :: start
      procedure :: set_contact
      procedure :: extend
      procedure :: collect
   end type multilevel_preconditioner

contains

   !> Allocates the coarser grids of a grid.
   subroutine start(self, points, even)
      class(multilevel_preconditioner), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N of the whole grid; N = 1 in 1-D
      logical, intent(in) :: even        !! whether the points are those of a quarter of an even field's cell

      type(grid_slab) :: finer
      integer :: grid(2), k, levels

      self%even = even
      call self%slab%start(points)
      grid = points
      levels = 0
      do while (all((mod(grid, 2) == 0 .and. grid >= 2*least_points) .or. grid == 1))
         grid = max(grid/2, 1)
         levels = levels + 1
      end do
      allocate (self%grids(levels))
      finer = self%slab
      do k = 1, levels
         associate (grid_k => self%grids(k))
            grid_k%part = finer%coarser()
            grid_k%slab = distributed_or_whole(grid_k%part)
            allocate (grid_k%contact(grid_k%slab%points(1), grid_k%slab%columns()))
            allocate (grid_k%values, mold=grid_k%contact)
            finer = grid_k%slab
         end associate
      end do
   end subroutine start

   !> The own columns of a coarser grid: those whose means are taken here, or all of them if the grid is small or some
   !> means of the next one would need columns of two slabs.
   pure type(grid_slab) function distributed_or_whole(part) result(slab)
      type(grid_slab), intent(in) :: part

      slab = part
      if (mod(part%width, 2) /= 0 .or. product(int(part%points, int64)) < least_distributed_points) &
         slab = grid_slab(points=part%points, width=part%points(2), last=part%points(2))
   end function distributed_or_whole

   !> Sets the points in contact.
   subroutine set_contact(self, contact)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(in), contiguous :: contact(:, :)   !! 1 in contact, 0 outside, own columns, shape (M, columns)

      real(dp) :: total(1)
      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call average(contact, self%grids(1)%part, self%grids(1)%slab, self%grids(1)%contact)
      do k = 2, levels
         call average(self%grids(k - 1)%contact, self%grids(k)%part, self%grids(k)%slab, self%grids(k)%contact)
      end do
      associate (coarsest => self%grids(levels))
         total = coarsest%slab%column_totals( &
            reshape(sum(real(coarsest%contact, dp), dim=1), [1, coarsest%slab%columns()]))
         self%decay = real(min(1.0_dp, decay_alone &
                                       + decay_growth*sqrt(total(1)/product(real(coarsest%slab%points, dp)))), sp)
      end associate
   end subroutine set_contact

   !> Continues a field to the points outside the contact.
   subroutine extend(self, contact, field)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(in), contiguous :: contact(:, :)    !! that of `set_contact`
      real(sp), intent(inout), contiguous :: field(:, :)   !! zero outside the contact, own columns, shape (M, columns)

      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call average(field, self%grids(1)%part, self%grids(1)%slab, self%grids(1)%values)
      do k = 2, levels
         call average(self%grids(k - 1)%values, self%grids(k)%part, self%grids(k)%slab, self%grids(k)%values)
      end do
      call normalise(self%grids(levels))
      do k = levels - 1, 1, -1
         call fill(self, self%grids(k + 1), self%grids(k)%contact, self%grids(k)%values)
      end do
      call fill(self, self%grids(1), contact, field)
   end subroutine extend

   !> The adjoint of `extend`: adds to the values in contact the values outside, with the weights that `extend` uses.
   subroutine collect(self, contact, field)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(in), contiguous :: contact(:, :)    !! that of `set_contact`
      real(sp), intent(inout), contiguous :: field(:, :)   !! own columns, shape (M, columns); its values outside the
                                                           !! contact are of no use afterwards

      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call adjoint_fill(self, self%slab, field, contact, self%grids(1))
      do k = 2, levels
         call adjoint_fill(self, self%grids(k - 1)%slab, self%grids(k - 1)%values, self%grids(k - 1)%contact, &
                           self%grids(k))
      end do
      call normalise(self%grids(levels))
      do k = levels - 1, 1, -1
         call adjoint_average(self%grids(k + 1), self%grids(k)%values)
      end do
      call adjoint_average(self%grids(1), field)
   end subroutine collect

   !> Divides each value by the part of its area in contact; points without contact get zero.
   pure subroutine normalise(grid)
      type(coarse_grid), intent(inout) :: grid

      where (grid%contact > 0.0_sp)
         grid%values = grid%values/grid%contact
      elsewhere
         grid%values = 0.0_sp
      end where
   end subroutine normalise

   !> Means of two by two points; in 1-D of two.
   subroutine average(fine, part, slab, coarse)
      real(sp), intent(in), contiguous :: fine(:, :)        !! own columns
      type(grid_slab), intent(in) :: part, slab             !! of the coarser grid
      real(sp), intent(inout), contiguous :: coarse(:, :)   !! shape (any, slab%columns())

      integer :: before, i, j

      if (slab%points(2) == 1) then
         coarse(:, 1) = 0.5_sp*(fine(1::2, 1) + fine(2::2, 1))
         return
      end if
      before = part%first - slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, part%columns()
         do i = 1, size(coarse, 1)
            coarse(i, before + j) = 0.25_sp*((fine(2*i - 1, 2*j - 1) + fine(2*i, 2*j - 1)) &
                                             + (fine(2*i - 1, 2*j) + fine(2*i, 2*j)))
         end do
      end do
      call complete(part, slab, coarse)
   end subroutine average

   !> Gathers the columns of the other slabs where a whole grid follows a distributed one.
   subroutine complete(part, slab, coarse)
      type(grid_slab), intent(in) :: part, slab
      real(sp), intent(inout), contiguous :: coarse(:, :)

      if (part%is_distributed .and. .not. slab%is_distributed) &
         call part%gather(4*size(coarse, 1), (coarse(:, part%first:part%last)), coarse, first_only=.false.)
   end subroutine complete

   !> The adjoint of `average`, added to a field.
   subroutine adjoint_average(coarse, fine)
      type(coarse_grid), intent(in) :: coarse
      real(sp), intent(inout), contiguous :: fine(:, :)   !! own columns

      integer :: before, i, j
      real(sp) :: part

      part = 0.25_sp
      if (coarse%slab%points(2) == 1) part = 0.5_sp
      before = coarse%part%first - coarse%slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(fine, 2)
         do i = 1, size(coarse%values, 1)
            fine(2*i - 1, j) = fine(2*i - 1, j) + part*coarse%values(i, before + (j + 1)/2)
            fine(2*i, j) = fine(2*i, j) + part*coarse%values(i, before + (j + 1)/2)
         end do
      end do
   end subroutine adjoint_average

   !> Adds to a field, outside the contact, the decayed values of the coarser grid, linear between its points.
   subroutine fill(self, coarse, contact, fine)
      type(multilevel_preconditioner), intent(in) :: self
      type(coarse_grid), intent(in) :: coarse
      real(sp), intent(in), contiguous :: contact(:, :)   !! own columns
      real(sp), intent(inout), contiguous :: fine(:, :)   !! own columns

      real(sp) :: column(0:size(coarse%values, 1) + 1)
      real(sp) :: beside(size(coarse%values, 1), 2)   !! the columns before and after those of the coarser grid
      real(sp) :: a, b
      integer :: before, i, j, m

      m = size(coarse%values, 1)
      before = coarse%part%first - coarse%slab%first
      a = 0.75_sp*self%decay
      b = 0.25_sp*self%decay
      call coarse%slab%halo(coarse%values, self%even, beside(:, :1), beside(:, 2:))
      !$omp parallel do num_threads(threads_for(size(fine))) private(column, i)
      do j = 1, size(fine, 2)
         associate (near => before + (j + 1)/2, other => before + (j + 1)/2 + merge(-1, 1, mod(j, 2) == 1))
            if (coarse%slab%points(2) == 1) then
               column(1:m) = self%decay*coarse%values(:, near)
            else if (other < 1) then
               column(1:m) = a*coarse%values(:, near) + b*beside(:, 1)
            else if (other > size(coarse%values, 2)) then
               column(1:m) = a*coarse%values(:, near) + b*beside(:, 2)
            else
               column(1:m) = a*coarse%values(:, near) + b*coarse%values(:, other)
            end if
         end associate
         column(0) = column(image_of_point(0, m, self%even))
         column(m + 1) = column(image_of_point(m + 1, m, self%even))
         do i = 1, m
            fine(2*i - 1, j) = fine(2*i - 1, j) + (1.0_sp - contact(2*i - 1, j)) &
               *(0.75_sp*column(i) + 0.25_sp*column(i - 1))
            fine(2*i, j) = fine(2*i, j) + (1.0_sp - contact(2*i, j))*(0.75_sp*column(i) + 0.25_sp*column(i + 1))
         end do
      end do
   end subroutine fill

   !> The adjoint of `fill` without the field itself.
   subroutine adjoint_fill(self, slab, fine, contact, coarse)
      type(multilevel_preconditioner), intent(in) :: self
      type(grid_slab), intent(in) :: slab                             !! of the finer grid
      real(sp), intent(in), contiguous :: fine(:, :), contact(:, :)   !! own columns
      type(coarse_grid), intent(inout) :: coarse

      !> The columns before and after the own ones.
      real(sp), dimension(size(fine, 1), 2) :: contact_beside, fine_beside
      real(sp) :: open_part(0:size(fine, 1) + 1)
      real(sp) :: near, far
      integer :: before, i, j, m, n

      m = size(fine, 1)/2
      n = coarse%part%columns()
      before = coarse%part%first - coarse%slab%first
      near = 0.75_sp*self%decay
      far = 0.25_sp*self%decay
      call slab%halo(fine, self%even, fine_beside(:, :1), fine_beside(:, 2:))
      call slab%halo(contact, self%even, contact_beside(:, :1), contact_beside(:, 2:))
      !$omp parallel do num_threads(threads_for(size(fine))) private(open_part, i)
      do j = 1, n
         open_part = 0.0_sp
         if (slab%points(2) == 1) then
            call add_open(self%decay, contact(:, j), fine(:, j), open_part(1:2*m))
         else
            call add_open(near, contact(:, 2*j - 1), fine(:, 2*j - 1), open_part(1:2*m))
            call add_open(near, contact(:, 2*j), fine(:, 2*j), open_part(1:2*m))
            if (j > 1) then
               call add_open(far, contact(:, 2*j - 2), fine(:, 2*j - 2), open_part(1:2*m))
            else
               call add_open(far, contact_beside(:, 1), fine_beside(:, 1), open_part(1:2*m))
            end if
            if (j < n) then
               call add_open(far, contact(:, 2*j + 1), fine(:, 2*j + 1), open_part(1:2*m))
            else
               call add_open(far, contact_beside(:, 2), fine_beside(:, 2), open_part(1:2*m))
            end if
         end if
         open_part(0) = open_part(image_of_point(0, 2*m, self%even))
         open_part(2*m + 1) = open_part(image_of_point(2*m + 1, 2*m, self%even))
         do i = 1, m
            coarse%values(i, before + j) = 0.75_sp*(open_part(2*i - 1) + open_part(2*i)) &
               + 0.25_sp*(open_part(2*i - 2) + open_part(2*i + 1))
         end do
      end do
      call complete(coarse%part, coarse%slab, coarse%values)
   end subroutine adjoint_fill

   !> Adds the open part of a column times a factor.
   pure subroutine add_open(factor, contact, column, total)
      real(sp), intent(in) :: factor
      real(sp), intent(in), contiguous :: contact(:), column(:)
      real(sp), intent(inout), contiguous :: total(:)

      total = total + factor*(1.0_sp - contact)*column
   end subroutine add_open

end module wavycon_multilevel_preconditioner
