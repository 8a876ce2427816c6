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
      type(grid_slab) :: finer                 !! the columns of the finer grid
      type(grid_slab) :: part                  !! the columns whose means are taken from these: all or some
      type(grid_slab) :: slab                  !! the columns of the arrays
      real(sp), allocatable :: contact(:, :)   !! part of a point's area that is in contact, 0 to 1
      real(sp), allocatable :: values(:, :)    !! with a column before and one after those of the slab
   end type coarse_grid

   type :: multilevel_preconditioner
      logical, private :: even = .false.       !! whether the field is mirrored at the borders; otherwise it is periodic
      real(sp), private :: decay = 1.0_sp      !! factor of a value for each doubling of the distance from the contact
      !> 1 in contact, 0 outside, own columns of the grid, shape (M, columns); allocated by `start`.
      real(sp), allocatable :: contact(:, :)
      type(coarse_grid), allocatable, private :: grids(:)
   contains
      procedure :: start
      procedure :: average_contact
      procedure :: extend
      procedure :: collect
   end type multilevel_preconditioner

contains

   !> Allocates the coarser grids of a grid; no point is in contact.
   subroutine start(self, points, even)
      class(multilevel_preconditioner), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N of the whole grid; N = 1 in 1-D
      logical, intent(in) :: even        !! whether the points are those of a quarter of an even field's cell

      type(grid_slab) :: finer
      integer :: grid(2), k, levels

      self%even = even
      call finer%start(points)
      allocate (self%contact(points(1), finer%columns()), source=0.0_sp)
      grid = points
      levels = 0
      do while (all((mod(grid, 2) == 0 .and. grid >= 2*least_points) .or. grid == 1))
         grid = max(grid/2, 1)
         levels = levels + 1
      end do
      allocate (self%grids(levels))
      do k = 1, levels
         associate (grid_k => self%grids(k))
            grid_k%finer = finer
            grid_k%part = finer%coarser()
            grid_k%slab = distributed_or_whole(grid_k%part)
            associate (m => grid_k%slab%points(1), n => grid_k%slab%columns())
               allocate (grid_k%contact(m, n), grid_k%values(m, 0:n + 1))
            end associate
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

   !> Takes over a change of the points in contact.
   subroutine average_contact(self)
      class(multilevel_preconditioner), intent(inout) :: self

      real(dp) :: total(1)
      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call average(self%contact, self%grids(1)%part, self%grids(1)%slab, self%grids(1)%contact)
      do k = 2, levels
         call average(self%grids(k - 1)%contact, self%grids(k)%part, self%grids(k)%slab, self%grids(k)%contact)
      end do
      associate (coarsest => self%grids(levels))
         total = coarsest%slab%column_totals( &
            reshape(sum(real(coarsest%contact, dp), dim=1), [1, coarsest%slab%columns()]))
         self%decay = real(min(1.0_dp, decay_alone &
                                       + decay_growth*sqrt(total(1)/product(real(coarsest%slab%points, dp)))), sp)
      end associate
   end subroutine average_contact

   !> Continues a field to the points outside the contact.
   subroutine extend(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! zero outside the contact, own columns, shape (M, columns)

      call extend_on(self%grids, self%even, self%decay, self%contact, field)
   end subroutine extend

   !> `extend` on a grid and all coarser ones: a point without contact about it has the value of the next coarser grid.
   recursive subroutine extend_on(grids, even, decay, contact, values)
      type(coarse_grid), intent(inout) :: grids(:)            !! the coarser ones
      logical, intent(in) :: even
      real(sp), intent(in) :: decay
      real(sp), intent(in), contiguous :: contact(:, :)       !! own columns
      real(sp), intent(inout), contiguous :: values(:, :)     !! own columns: means over the area in contact times it

      if (size(grids) == 0) then
         call normalise(contact, values)
         return
      end if
      associate (coarse => grids(1)%values(:, 1:grids(1)%slab%columns()))
         call average(values, grids(1)%part, grids(1)%slab, coarse)
         call extend_on(grids(2:), even, decay, grids(1)%contact, coarse)
      end associate
      call fill(grids(1), even, decay, contact, values)
   end subroutine extend_on

   !> The adjoint of `extend`: adds to the values in contact the values outside, with the weights that `extend` uses.
   subroutine collect(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! own columns, shape (M, columns); its values outside the
                                                           !! contact are of no use afterwards

      call collect_on(self%grids, self%even, self%decay, self%contact, field)
   end subroutine collect

   recursive subroutine collect_on(grids, even, decay, contact, values)
      type(coarse_grid), intent(inout) :: grids(:)            !! these as of `extend_on`
      logical, intent(in) :: even
      real(sp), intent(in) :: decay
      real(sp), intent(in), contiguous :: contact(:, :)
      real(sp), intent(inout), contiguous :: values(:, :)

      if (size(grids) == 0) then
         call normalise(contact, values)
         return
      end if
      call adjoint_fill(grids(1), even, decay, contact, values)
      call collect_on(grids(2:), even, decay, grids(1)%contact, grids(1)%values(:, 1:grids(1)%slab%columns()))
      call adjoint_average(grids(1), values)
   end subroutine collect_on

   !> Divides each value by the part of its area in contact; points without contact get zero.
   pure subroutine normalise(contact, values)
      real(sp), intent(in), contiguous :: contact(:, :)
      real(sp), intent(inout), contiguous :: values(:, :)

      where (contact > 0.0_sp)
         values = values/contact
      elsewhere
         values = 0.0_sp
      end where
   end subroutine normalise

   !> Means of two by two points. In 1-D the only column counts twice, here and in the following procedures.
   subroutine average(fine, part, slab, coarse)
      real(sp), intent(in), contiguous :: fine(:, :)        !! own columns
      type(grid_slab), intent(in) :: part, slab             !! of the coarser grid
      real(sp), intent(inout), contiguous :: coarse(:, :)   !! shape (any, slab%columns())

      integer :: before, i, j

      before = part%first - slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, part%columns()
         associate (other => min(2*j, size(fine, 2)))
            do i = 1, size(coarse, 1)
               coarse(i, before + j) = 0.25_sp*((fine(2*i - 1, 2*j - 1) + fine(2*i, 2*j - 1)) &
                                                + (fine(2*i - 1, other) + fine(2*i, other)))
            end do
         end associate
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

      before = coarse%part%first - coarse%slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(fine, 2)
         do i = 1, size(coarse%values, 1)
            fine(2*i - 1, j) = fine(2*i - 1, j) + 0.25_sp*coarse%values(i, before + (j + 1)/2)
            fine(2*i, j) = fine(2*i, j) + 0.25_sp*coarse%values(i, before + (j + 1)/2)
         end do
      end do
   end subroutine adjoint_average

   !> Adds to a field, outside the contact, the decayed values of the coarser grid, linear between its points.
   subroutine fill(coarse, even, decay, contact, fine)
      type(coarse_grid), intent(inout) :: coarse
      logical, intent(in) :: even
      real(sp), intent(in) :: decay
      real(sp), intent(in), contiguous :: contact(:, :)   !! own columns
      real(sp), intent(inout), contiguous :: fine(:, :)   !! own columns

      real(sp) :: line(0:size(coarse%values, 1) + 1)
      integer :: before, i, j, m

      m = size(coarse%values, 1)
      before = coarse%part%first - coarse%slab%first
      associate (values => coarse%values, n => coarse%slab%columns())
         call coarse%slab%halo(values(:, 1:n), even, values(:, 0:0), values(:, n + 1:n + 1))
      end associate
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, line)
      do j = 1, size(fine, 2)
         associate (values => coarse%values, near => before + (j + 1)/2, other => before + (j + 1)/2 + 1 - 2*mod(j, 2))
            line(1:m) = decay*(0.75_sp*values(:, near) + 0.25_sp*values(:, other))
         end associate
         line(0) = line(image_of_point(0, m, even))
         line(m + 1) = line(image_of_point(m + 1, m, even))
         do i = 1, m
            fine(2*i - 1, j) = fine(2*i - 1, j) + (1.0_sp - contact(2*i - 1, j))*(0.75_sp*line(i) + 0.25_sp*line(i - 1))
            fine(2*i, j) = fine(2*i, j) + (1.0_sp - contact(2*i, j))*(0.75_sp*line(i) + 0.25_sp*line(i + 1))
         end do
      end do
   end subroutine fill

   !> The adjoint of `fill` without the field itself.
   subroutine adjoint_fill(coarse, even, decay, contact, fine)
      type(coarse_grid), intent(inout) :: coarse
      logical, intent(in) :: even
      real(sp), intent(in) :: decay
      real(sp), intent(in), contiguous :: contact(:, :), fine(:, :)   !! own columns

      !> The columns beside the own ones.
      real(sp), dimension(size(fine, 1), 1) :: contact_high, contact_low, high, low
      real(sp) :: line(0:size(fine, 1) + 1)
      !> Parts of the columns before, of and after a column of the coarser grid.
      real(sp), parameter :: parts(4) = [0.25_sp, 0.75_sp, 0.75_sp, 0.25_sp]
      integer :: before, i, j, k, m

      m = size(fine, 1)
      before = coarse%part%first - coarse%slab%first
      call coarse%finer%halo(fine, even, low, high)
      call coarse%finer%halo(contact, even, contact_low, contact_high)
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, k, line)
      do j = 1, coarse%part%columns()
         line = 0.0_sp
         do k = 2*j - 2, 2*j + 1
            associate (part => parts(k - 2*j + 3))
               if (k < 1) then
                  line(1:m) = line(1:m) + part*(1.0_sp - contact_low(:, 1))*low(:, 1)
               else if (k > size(fine, 2)) then
                  line(1:m) = line(1:m) + part*(1.0_sp - contact_high(:, 1))*high(:, 1)
               else
                  line(1:m) = line(1:m) + part*(1.0_sp - contact(:, k))*fine(:, k)
               end if
            end associate
         end do
         line(0) = line(image_of_point(0, m, even))
         line(m + 1) = line(image_of_point(m + 1, m, even))
         do i = 1, m/2
            coarse%values(i, before + j) = decay*(0.75_sp*(line(2*i - 1) + line(2*i)) &
                                                  + 0.25_sp*(line(2*i - 2) + line(2*i + 1)))
         end do
      end do
      call complete(coarse%part, coarse%slab, coarse%values(:, 1:coarse%slab%columns()))
   end subroutine adjoint_fill

end module wavycon_multilevel_preconditioner
