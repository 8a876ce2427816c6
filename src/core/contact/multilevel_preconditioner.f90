!> The multilevel preconditioner: the continuation J of a field from the contact to the points outside, and its adjoint
!> J', equations (C4a) to (C4f) of README.md in this directory. `precondition` of pressure_correction applies J' T J.
!>
!> The continuation uses a sequence of grids, each with half the points of the one before in each direction. A point of
!> a coarser grid has the mean of two by two points of the finer one. The sequence ends where a number of points is odd
!> or too small. If the grid is distributed over processes, large coarser grids are distributed too; on small ones every
!> process has all columns.
module wavycon_multilevel_preconditioner
   use wavycon_contact_tuning, only: decay_alone, decay_growth
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab, least_distributed_points
   use wavycon_kinds, only: dp, int64, sp
   use wavycon_threads, only: threads_for
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: multilevel_preconditioner

   !> The coarsest grid has at least this many points each way.
   integer, parameter :: least_points = 4

   !> One grid of the sequence, with all coarser ones in its component `coarser`.
   type :: multilevel_preconditioner
      logical, private :: even = .false.       !! whether the grid continues by mirror images, otherwise periodically
      !> c of (C4c) without (C4e), the factor for each doubling of the distance from the contact.
      real(sp), private :: decay = 1.0_sp
      real(sp), private :: reach = 1.0_sp      !! max(0, -n_j), the factor of c in (C4e)
      real(sp), private :: factor = 1.0_sp     !! of the values that the next grid fills in: c, or 1 of (C4f)
      logical, private :: is_balance = .false.   !! whether the field is q_j of (C4f), which becomes s_j
      !> Of (C4f): -b_j, and the weights of q and of I s, each a + b w_j for the numbers (a, b).
      real(sp), private :: own = 1.0_sp, taken(2) = [1.0_sp, 0.0_sp], filled(2) = [1.0_sp, -1.0_sp]
      type(grid_slab), private :: slab         !! columns of this grid that this process has
      !> w_j of (C4b): the part of a point's area that is in contact, on the finest grid 1 or 0, shape (M,
      !> slab%columns()). `start` allocates this array; the caller sets it on the finest grid.
      real(sp), allocatable :: contact(:, :)
      type(multilevel_preconditioner), allocatable, private :: coarser   !! the next grid, if there is one
      !> Columns of the next grid that are means of columns of this process. The next grid itself has either these
      !> columns or all.
      type(grid_slab), private :: averaged
      !> A field on the next grid, in the columns 1 .. coarser%slab%columns(), with one more column on each side.
      real(sp), allocatable, private :: values(:, :)
   contains
      procedure :: start, average_contact, extend, collect
   end type multilevel_preconditioner

contains

   !> Allocates a grid and, if it can be halved, all coarser ones, without any point in contact.
   recursive subroutine start(self, slab, even, kernel, frequency)
      class(multilevel_preconditioner), intent(inout) :: self   !! with its default values, but for `is_balance`
      type(grid_slab), intent(in) :: slab   !! columns of the grid that this process has; one column in 1-D
      logical, intent(in) :: even           !! whether the points are those of a quarter of an even field's cell
      type(wave_stiffness), intent(in) :: kernel   !! of the bodies
      !> Of the wave whose wave number is one over a step, > 0: one over 2 pi steps, in the kernel's unit.
      real(dp), intent(in) :: frequency

      real(sp) :: order   ! n_j

      self%even = even
      self%slab = slab
      order = real(kernel%order(frequency), sp)
      self%reach = max(0.0_sp, -order)
      if (self%is_balance) then
         self%own = -min(1.0_sp, max(0.0_sp, 0.5_sp*order))
         self%taken = [1.0_sp + self%own, -self%own]
         self%filled = [1.0_sp, 0.0_sp]
      end if
      allocate (self%contact(slab%points(1), slab%columns()), source=0.0_sp)
      if (.not. all((mod(slab%points, 2) == 0 .and. slab%points >= 2*least_points) .or. slab%points == 1)) return
      self%averaged = slab%coarser()
      allocate (self%coarser)
      self%coarser%is_balance = self%is_balance .or. order > 0.0_sp
      call self%coarser%start(distributed_or_whole(self%averaged), even, kernel, 0.5_dp*frequency)
      allocate (self%values(self%averaged%points(1), 0:self%coarser%slab%columns() + 1))
   end subroutine start

   !> The columns of a coarser grid that this process has: those that are means of its columns of the finer grid, or all
   !> columns. It has all if the grid is small, or if some means of the next grid would need columns of two processes.
   pure type(grid_slab) function distributed_or_whole(averaged) result(slab)
      type(grid_slab), intent(in) :: averaged   !! columns that are means of columns of this process

      slab = averaged
      if (mod(averaged%width, 2) /= 0 .or. product(int(averaged%points, int64)) < least_distributed_points) &
         slab = grid_slab(points=averaged%points, width=averaged%points(2), last=averaged%points(2))
   end function distributed_or_whole

   !> Computes `contact` of all coarser grids and the decay, after the caller has changed `contact` of the finest grid.
   recursive subroutine average_contact(self)
      class(multilevel_preconditioner), intent(inout) :: self

      if (allocated(self%coarser)) then
         call average(self%contact, self%averaged, self%coarser%slab, self%coarser%contact)
         call self%coarser%average_contact()
         self%decay = self%coarser%decay
         self%factor = min(1.0_sp, self%decay*self%reach)
         if (self%coarser%is_balance) self%factor = 1.0_sp
      else
         self%decay = real(min(1.0_dp, decay_alone + decay_growth*sqrt(self%slab%sum_of(real(self%contact, dp)) &
                                                                       /product(real(self%slab%points, dp)))), sp)
      end if
   end subroutine average_contact

   !> Applies J: continues a field to the points outside the contact (C4b), (C4c). The field is averaged over the grids,
   !> from fine to coarse, divided by the contact on the last grid, and filled in from coarse to fine. Where the
   !> compliance rises with the wave number, both are done by (C4f) on this grid and all coarser ones.
   recursive subroutine extend(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      !> On entry r, zero outside the contact; on return J r; shape (M, slab%columns()). In the recursion this is r_j,
      !> the mean over the contact times the part in contact, and then v_j.
      real(sp), intent(inout), contiguous :: field(:, :)

      if (allocated(self%coarser)) then
         associate (coarse => self%values(:, 1:self%coarser%slab%columns()))
            if (self%coarser%is_balance) then
               call adjoint_fill(self, self%taken, 0.25_sp, field)
            else
               call average(field, self%averaged, self%coarser%slab, coarse)
            end if
            call self%coarser%extend(coarse)
         end associate
      end if
      call keep_own(self, field)
      if (allocated(self%coarser)) call fill(self, self%filled, self%factor, field)
   end subroutine extend

   !> Applies J', the adjoint of `extend`: adds the values outside the contact to those in contact, with the weights of
   !> `extend`, by the transposed operators in reverse order.
   recursive subroutine collect(self, field)
      class(multilevel_preconditioner), intent(inout) :: self
      !> A field, on return J' of it; shape (M, slab%columns()). Values outside the contact are not used afterwards.
      real(sp), intent(inout), contiguous :: field(:, :)

      if (allocated(self%coarser)) then
         call adjoint_fill(self, self%filled, self%factor, field)
         call self%coarser%collect(self%values(:, 1:self%coarser%slab%columns()))
      end if
      call keep_own(self, field)
      if (.not. allocated(self%coarser)) return
      if (self%coarser%is_balance) then
         call fill(self, self%taken, 0.25_sp, field)
      else
         call adjoint_average(self, field)
      end if
   end subroutine collect

   !> What a grid itself adds to J and J': the field, on the last grid over the part of each point's area that is in
   !> contact, in balances times -b_j.
   subroutine keep_own(grid, field)
      class(multilevel_preconditioner), intent(in) :: grid
      real(sp), intent(inout), contiguous :: field(:, :)

      if (grid%is_balance) then
         field = grid%own*field
      else if (.not. allocated(grid%coarser)) then
         where (grid%contact > 0.0_sp)
            field = field/grid%contact
         elsewhere
            field = 0.0_sp
         end where
      end if
   end subroutine keep_own

   !> Applies R of (C4b), the means of two by two points. In 1-D the only column counts twice, here and in the following
   !> procedures.
   subroutine average(fine, averaged, slab, coarse)
      real(sp), intent(in), contiguous :: fine(:, :)        !! field on the finer grid, columns of this process
      !> Columns of the coarser grid: those that are computed here, and those that `coarse` has.
      type(grid_slab), intent(in) :: averaged, slab
      real(sp), intent(inout), contiguous :: coarse(:, :)   !! field on the coarser grid, shape (M/2, slab%columns())

      integer :: before, i, j   ! before: columns of `coarse` before those that are computed here

      before = averaged%first - slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, averaged%columns()
         associate (other => min(2*j, size(fine, 2)))
            do i = 1, size(coarse, 1)
               coarse(i, before + j) = 0.25_sp*((fine(2*i - 1, 2*j - 1) + fine(2*i, 2*j - 1)) &
                                                + (fine(2*i - 1, other) + fine(2*i, other)))
            end do
         end associate
      end do
      call complete(averaged, slab, coarse)
   end subroutine average

   !> Gathers the columns that other processes have computed, if this grid is whole and the finer one is distributed.
   subroutine complete(averaged, slab, coarse)
      type(grid_slab), intent(in) :: averaged, slab         !! as in `average`
      real(sp), intent(inout), contiguous :: coarse(:, :)   !! shape (M/2, slab%columns())

      if (averaged%is_distributed .and. .not. slab%is_distributed) &
         call averaged%gather(4*size(coarse, 1), (coarse(:, averaged%first:averaged%last)), coarse, first_only=.false.)
   end subroutine complete

   !> Adds the adjoint of `average`, applied to the values on the coarser grid, to a field.
   subroutine adjoint_average(grid, fine)
      class(multilevel_preconditioner), intent(in) :: grid
      real(sp), intent(inout), contiguous :: fine(:, :)   !! shape (M, slab%columns())

      integer :: before, i, j

      before = grid%averaged%first - grid%coarser%slab%first
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(fine, 2)
         do i = 1, size(grid%values, 1)
            fine(2*i - 1, j) = fine(2*i - 1, j) + 0.25_sp*grid%values(i, before + (j + 1)/2)
            fine(2*i, j) = fine(2*i, j) + 0.25_sp*grid%values(i, before + (j + 1)/2)
         end do
      end do
   end subroutine adjoint_average

   !> Adds the second term of (C4c) to a field: the values of the coarser grid times a factor, interpolated linearly by
   !> I and weighted, by (C4c) with the open part of each point, 1 - w_j.
   subroutine fill(grid, weight, factor, fine)
      class(multilevel_preconditioner), intent(inout) :: grid
      real(sp), intent(in) :: weight(2), factor           !! a and b of the weight a + b w_j; factor of the values
      real(sp), intent(inout), contiguous :: fine(:, :)   !! shape (M, slab%columns())

      real(sp) :: line(0:size(grid%values, 1) + 1)
      integer :: before, i, j, m

      m = size(grid%values, 1)
      before = grid%averaged%first - grid%coarser%slab%first
      associate (values => grid%values, n => grid%coarser%slab%columns())
         call grid%coarser%slab%halo(values(:, 1:n), grid%even, values(:, 0:0), values(:, n + 1:n + 1))
      end associate
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, line)
      do j = 1, size(fine, 2)
         associate (values => grid%values, near => before + (j + 1)/2, other => before + (j + 1)/2 + 1 - 2*mod(j, 2))
            line(1:m) = factor*(0.75_sp*values(:, near) + 0.25_sp*values(:, other))
         end associate
         line([0, m + 1]) = line(image_of_point([0, m + 1], m, grid%even))
         associate (contact => grid%contact(:, j))
            do i = 1, m
               fine(2*i - 1, j) = fine(2*i - 1, j) + (weight(1) + weight(2)*contact(2*i - 1)) &
                                                     *(0.75_sp*line(i) + 0.25_sp*line(i - 1))
               fine(2*i, j) = fine(2*i, j) + (weight(1) + weight(2)*contact(2*i)) &
                                             *(0.75_sp*line(i) + 0.25_sp*line(i + 1))
            end do
         end associate
      end do
   end subroutine fill

   !> Sets the values on the coarser grid to the adjoint of the term that `fill` adds, applied to a field.
   subroutine adjoint_fill(grid, weight, factor, fine)
      class(multilevel_preconditioner), intent(inout) :: grid
      real(sp), intent(in) :: weight(2), factor       !! as in `fill`
      real(sp), intent(in), contiguous :: fine(:, :)   !! shape (M, slab%columns())

      !> The neighbouring columns of `contact` and `fine`: after and before those of this process.
      real(sp), dimension(size(fine, 1), 1) :: contact_high, contact_low, high, low
      real(sp) :: line(0:size(fine, 1) + 1)
      !> Parts of a coarse column in the four fine columns that it is interpolated to.
      real(sp), parameter :: parts(4) = [0.25_sp, 0.75_sp, 0.75_sp, 0.25_sp]
      integer :: before, i, j, k, m

      m = size(fine, 1)
      before = grid%averaged%first - grid%coarser%slab%first
      call grid%slab%halo(fine, grid%even, low, high)
      call grid%slab%halo(grid%contact, grid%even, contact_low, contact_high)
      !$omp parallel do num_threads(threads_for(size(fine))) private(i, k, line)
      do j = 1, grid%averaged%columns()
         line = 0.0_sp
         do k = 2*j - 2, 2*j + 1
            associate (part => parts(k - 2*j + 3))
               if (k < 1) then
                  line(1:m) = line(1:m) + part*(weight(1) + weight(2)*contact_low(:, 1))*low(:, 1)
               else if (k > size(fine, 2)) then
                  line(1:m) = line(1:m) + part*(weight(1) + weight(2)*contact_high(:, 1))*high(:, 1)
               else
                  line(1:m) = line(1:m) + part*(weight(1) + weight(2)*grid%contact(:, k))*fine(:, k)
               end if
            end associate
         end do
         line([0, m + 1]) = line(image_of_point([0, m + 1], m, grid%even))
         do i = 1, m/2
            grid%values(i, before + j) = factor*(0.75_sp*(line(2*i - 1) + line(2*i)) &
                                                     + 0.25_sp*(line(2*i - 2) + line(2*i + 1)))
         end do
      end do
      call complete(grid%averaged, grid%coarser%slab, grid%values(:, 1:grid%coarser%slab%columns()))
   end subroutine adjoint_fill

end module wavycon_multilevel_preconditioner
