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

   type :: multilevel_preconditioner
      logical, private :: even = .false.       !! whether the field is mirrored at the borders; otherwise it is periodic
      real(sp), private :: decay = 1.0_sp      !! factor of a value for each doubling of the distance from the contact
      real(dp), private :: reach = 0.0_dp      !! as of `start`, in steps of this grid
      type(grid_slab), private :: slab         !! the columns of the grid
      !> Part of a point's area that is in contact, on the finest grid 1 or 0; own columns, shape (M, columns).
      !> Allocated by `start`.
      real(sp), allocatable :: contact(:, :)
      type(multilevel_preconditioner), allocatable, private :: coarser   !! of half the points, unless this is coarsest
      type(grid_slab), private :: part         !! its columns whose means are taken from these: all or some
      real(sp), allocatable, private :: values(:, :)   !! of its slab, with a column before and one after
   contains
      procedure :: start
      procedure :: average_contact
      procedure :: extend
      procedure :: collect
   end type multilevel_preconditioner

contains

   !> Allocates a grid and the coarser ones; no point is in contact.
   subroutine start(self, points, even, reach)
      class(multilevel_preconditioner), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N of the whole grid; N = 1 in 1-D
      logical, intent(in) :: even        !! whether the points are those of a quarter of an even field's cell
      !> Steps beyond which no displacement reaches, the thickness of a layer; 0 or absent: there is no limit.
      real(dp), intent(in), optional :: reach

      type(grid_slab) :: slab

      call slab%start(points)
      if (present(reach)) self%reach = reach
      call start_on(slab, even, self)
   end subroutine start

   recursive subroutine start_on(slab, even, grid)
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even
      class(multilevel_preconditioner), intent(inout) :: grid

      grid%even = even
      grid%slab = slab
      allocate (grid%contact(slab%points(1), slab%columns()), source=0.0_sp)
      if (.not. all((mod(slab%points, 2) == 0 .and. slab%points >= 2*least_points) .or. slab%points == 1)) return
      grid%part = slab%coarser()
      allocate (grid%coarser)
      grid%coarser%reach = 0.5_dp*grid%reach
      call start_on(distributed_or_whole(grid%part), even, grid%coarser)
      allocate (grid%values(grid%part%points(1), 0:grid%coarser%slab%columns() + 1))
   end subroutine start_on

   !> The own columns of a coarser grid: those whose means are taken here, or all of them if the grid is small or some
   !> means of the next one would need columns of two slabs.
   pure type(grid_slab) function distributed_or_whole(part) result(slab)
      type(grid_slab), intent(in) :: part

      slab = part
      if (mod(part%width, 2) /= 0 .or. product(int(part%points, int64)) < least_distributed_points) &
         slab = grid_slab(points=part%points, width=part%points(2), last=part%points(2))
   end function distributed_or_whole

   !> Takes over a change of the points in contact.
   recursive subroutine average_contact(self)
      class(multilevel_preconditioner), intent(inout) :: self

      real(dp) :: total(1)

      if (allocated(self%coarser)) then
         call average(self%contact, self%part, self%coarser%slab, self%coarser%contact)
         call self%coarser%average_contact()
         self%decay = self%coarser%decay
         if (self%reach > 0.0_dp) self%decay = self%decay* &
            real(min(1.0_dp, self%reach)/min(1.0_dp, self%coarser%reach), sp)
      else
         total = self%slab%column_totals(reshape(sum(real(self%contact, dp), dim=1), [1, self%slab%columns()]))
         self%decay = real(min(1.0_dp, decay_alone &
                                       + decay_growth*sqrt(total(1)/product(real(self%slab%points, dp)))), sp)
         if (self%reach > 0.0_dp) self%decay = self%decay*real(min(1.0_dp, self%reach), sp)
      end if
   end subroutine average_contact

   !> Continues a field to the points outside the contact: a point without contact about it has the value of the next
   !> coarser grid.
   recursive subroutine extend(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      !> Zero outside the contact, own columns, shape (M, columns); on coarser grids means over the area in contact
      !> times it.
      real(sp), intent(inout), contiguous :: field(:, :)

      if (allocated(self%coarser)) then
         associate (coarse => self%values(:, 1:self%coarser%slab%columns()))
            call average(field, self%part, self%coarser%slab, coarse)
            call self%coarser%extend(coarse)
         end associate
         call fill(self, field)
      else
         call normalise(self%contact, field)
      end if
   end subroutine extend

   !> The adjoint of `extend`: adds to the values in contact the values outside, with the weights that `extend` uses.
   recursive subroutine collect(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! own columns, shape (M, columns); its values outside the
                                                           !! contact are of no use afterwards

      if (allocated(self%coarser)) then
         call adjoint_fill(self, field)
         call self%coarser%collect(self%values(:, 1:self%coarser%slab%columns()))
         call adjoint_average(self, field)
      else
         call normalise(self%contact, field)
      end if
   end subroutine collect

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
   subroutine adjoint_average(grid, fine)
      class(multilevel_preconditioner), intent(in) :: grid
      real(sp), intent(inout), contiguous :: fine(:, :)   !! own columns

      integer :: before, i, j

      before = grid%part%first - grid%coarser%slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(fine, 2)
         do i = 1, size(grid%values, 1)
            fine(2*i - 1, j) = fine(2*i - 1, j) + 0.25_sp*grid%values(i, before + (j + 1)/2)
            fine(2*i, j) = fine(2*i, j) + 0.25_sp*grid%values(i, before + (j + 1)/2)
         end do
      end do
   end subroutine adjoint_average

   !> Adds to a field, outside the contact, the decayed values of the coarser grid, linear between its points.
   subroutine fill(grid, fine)
      class(multilevel_preconditioner), intent(inout) :: grid
      real(sp), intent(inout), contiguous :: fine(:, :)   !! own columns

      real(sp) :: line(0:size(grid%values, 1) + 1)
      integer :: before, i, j, m

      m = size(grid%values, 1)
      before = grid%part%first - grid%coarser%slab%first
      associate (values => grid%values, n => grid%coarser%slab%columns())
         call grid%coarser%slab%halo(values(:, 1:n), grid%even, values(:, 0:0), values(:, n + 1:n + 1))
      end associate
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, line)
      do j = 1, size(fine, 2)
         associate (values => grid%values, near => before + (j + 1)/2, other => before + (j + 1)/2 + 1 - 2*mod(j, 2))
            line(1:m) = grid%decay*(0.75_sp*values(:, near) + 0.25_sp*values(:, other))
         end associate
         line(0) = line(image_of_point(0, m, grid%even))
         line(m + 1) = line(image_of_point(m + 1, m, grid%even))
         associate (contact => grid%contact(:, j))
            do i = 1, m
               fine(2*i - 1, j) = fine(2*i - 1, j) + (1.0_sp - contact(2*i - 1))*(0.75_sp*line(i) + 0.25_sp*line(i - 1))
               fine(2*i, j) = fine(2*i, j) + (1.0_sp - contact(2*i))*(0.75_sp*line(i) + 0.25_sp*line(i + 1))
            end do
         end associate
      end do
   end subroutine fill

   !> The adjoint of `fill` without the field itself.
   subroutine adjoint_fill(grid, fine)
      class(multilevel_preconditioner), intent(inout) :: grid
      real(sp), intent(in), contiguous :: fine(:, :)   !! own columns

      !> The columns beside the own ones.
      real(sp), dimension(size(fine, 1), 1) :: contact_high, contact_low, high, low
      real(sp) :: line(0:size(fine, 1) + 1)
      !> Parts of the columns before, of and after a column of the coarser grid.
      real(sp), parameter :: parts(4) = [0.25_sp, 0.75_sp, 0.75_sp, 0.25_sp]
      integer :: before, i, j, k, m

      m = size(fine, 1)
      before = grid%part%first - grid%coarser%slab%first
      call grid%slab%halo(fine, grid%even, low, high)
      call grid%slab%halo(grid%contact, grid%even, contact_low, contact_high)
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, k, line)
      do j = 1, grid%part%columns()
         line = 0.0_sp
         do k = 2*j - 2, 2*j + 1
            associate (part => parts(k - 2*j + 3))
               if (k < 1) then
                  line(1:m) = line(1:m) + part*(1.0_sp - contact_low(:, 1))*low(:, 1)
               else if (k > size(fine, 2)) then
                  line(1:m) = line(1:m) + part*(1.0_sp - contact_high(:, 1))*high(:, 1)
               else
                  line(1:m) = line(1:m) + part*(1.0_sp - grid%contact(:, k))*fine(:, k)
               end if
            end associate
         end do
         line(0) = line(image_of_point(0, m, grid%even))
         line(m + 1) = line(image_of_point(m + 1, m, grid%even))
         do i = 1, m/2
            grid%values(i, before + j) = grid%decay*(0.75_sp*(line(2*i - 1) + line(2*i)) &
                                                     + 0.25_sp*(line(2*i - 2) + line(2*i + 1)))
         end do
      end do
      call complete(grid%part, grid%coarser%slab, grid%values(:, 1:grid%coarser%slab%columns()))
   end subroutine adjoint_fill

end module wavycon_multilevel_preconditioner
