!> A region of a grid, which has the points in and near the contact, and vectors of values at these points.
!>
!> A vector lists the values of a field at the points of the region, column by column. Its length is the number of these
!> points. So operations on vectors cost nothing where there is no contact.
!>
!> Vectors are divided into chunks of at most `longest_chunk` numbers. A chunk fits the processor's cache, so that
!> several operations on it read the memory once, and threads share the chunks. Each strip of columns (`grid_slab`)
!> begins a new chunk. So the sum over a strip does not depend on how strips are distributed over processes.
module wavycon_contact_region
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab, strip_columns
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: add_neighbours, contact_region

   !> Largest number of values in a chunk. It limits the rounding error of sums in single precision.
   integer, parameter, public :: longest_chunk = 4096

   !> In the three lists of first elements the last entry is one more than the last element, so that list i ends before
   !> entry i + 1.
   type :: contact_region
      integer :: points = 0                    !! number of points in the region
      logical, allocatable :: columns(:)       !! whether a column of the grid has points of the region, shape (N)
      integer :: threads = 1                   !! number of threads for loops over the points
      integer :: chunks = 0                    !! number of chunks
      integer, allocatable :: chunk(:)         !! index in vectors at which each chunk begins, shape (chunks+1)
      !> Runs of adjacent points in one column and one chunk: the column, the rows `first` to `last`, and the index of
      !> the first point in vectors, shape (number of runs or more).
      integer, allocatable, private :: column(:), first(:), last(:), position(:)
      integer, allocatable, private :: chunk_run(:)      !! first run of each chunk, shape (chunks+1)
      integer, allocatable :: strip_chunk(:)             !! first chunk of each strip, shape (strips+1)
   contains
      procedure :: start, gather_scaled, take_chunk, put_chunk, convolve, strip_sums, correct
   end type contact_region

contains

   !> Makes the region of the points at which a field is positive. One pass counts points and runs of each column, a
   !> second one lists the runs; a run ends with its chunk.
   subroutine start(self, inside)
      class(contact_region), intent(out) :: self
      !> > 0 at the points of the region, 0 at the others; the columns of this process, shape (M, slab%columns()).
      real(sp), intent(in) :: inside(:, :)

      integer :: counts(2, size(inside, 2)), filled, i, j, m, n, r, strips
      logical :: in_run

      m = size(inside, 1)
      n = size(inside, 2)
      !$omp parallel do num_threads(threads_for(size(inside)))
      do j = 1, n
         counts(:, j) = [count(inside(:, j) > 0.0_sp), &
                         count(inside(2:, j) > 0.0_sp .and. inside(:m - 1, j) <= 0.0_sp) + 1]
      end do
      self%columns = counts(1, :) > 0
      self%threads = threads_for(sum(counts(1, :)))
      strips = (n + strip_columns - 1)/strip_columns
      allocate (self%chunk(sum(counts(1, :))/longest_chunk + strips + 1), self%strip_chunk(strips + 1))
      allocate (self%chunk_run, mold=self%chunk)
      associate (most_runs => sum(counts(2, :), self%columns) + size(self%chunk))
         allocate (self%column(most_runs), self%first(most_runs), self%last(most_runs), self%position(most_runs))
      end associate
      r = 0
      filled = 0
      do j = 1, n
         if (modulo(j - 1, strip_columns) == 0) then
            self%strip_chunk((j - 1)/strip_columns + 1) = self%chunks + 1
            filled = longest_chunk
         end if
         if (.not. self%columns(j)) cycle
         in_run = .false.
         do i = 1, m
            if (inside(i, j) <= 0.0_sp) then
               in_run = .false.
               cycle
            end if
            if (filled == longest_chunk) then
               self%chunks = self%chunks + 1
               self%chunk(self%chunks) = self%points + 1
               self%chunk_run(self%chunks) = r + 1
               filled = 0
               in_run = .false.
            end if
            self%points = self%points + 1
            filled = filled + 1
            if (.not. in_run) then
               r = r + 1
               self%column(r) = j
               self%first(r) = i
               self%position(r) = self%points
               in_run = .true.
            end if
            self%last(r) = i
         end do
      end do
      self%chunk(self%chunks + 1) = self%points + 1
      self%chunk_run(self%chunks + 1) = r + 1
      self%strip_chunk(strips + 1) = self%chunks + 1
   end subroutine start

   !> Copies the values of a field at the points of the region to a vector, divided by a unit.
   subroutine gather_scaled(self, field, unit, vector)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! field in double precision, shape (M, slab%columns())
      real(dp), intent(in) :: unit            !! unit of the vector, > 0
      real(sp), intent(out) :: vector(:)      !! field/unit, shape (points)

      integer :: r

      !$omp parallel do num_threads(self%threads)
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         associate (a => self%first(r), b => self%last(r), k => self%position(r))
            vector(k:k + b - a) = real(field(a:b, self%column(r))/unit, sp)
         end associate
      end do
   end subroutine gather_scaled

   !> Copies the values of a field at the points of a chunk to a vector.
   pure subroutine take_chunk(self, c, field, values)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                            !! number of the chunk
      real(sp), intent(in) :: field(:, :)                 !! shape (M, slab%columns())
      real(sp), intent(inout), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more

      integer :: r

      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         associate (a => self%first(r), b => self%last(r), k => self%position(r) - self%chunk(c) + 1)
            values(k:k + b - a) = field(a:b, self%column(r))
         end associate
      end do
   end subroutine take_chunk

   !> Writes a vector of values to the points of a chunk in a field. Other points of the field do not change.
   pure subroutine put_chunk(self, c, values, field)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                         !! number of the chunk
      real(sp), intent(in), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more
      real(sp), intent(inout) :: field(:, :)           !! shape (M, slab%columns())

      integer :: r

      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         associate (a => self%first(r), b => self%last(r), k => self%position(r) - self%chunk(c) + 1)
            field(a:b, self%column(r)) = values(k:k + b - a)
         end associate
      end do
   end subroutine put_chunk

   !> Convolves a field with a stencil at the points of the region: the result at point (i, j) is the sum of
   !> weights(k, l) field(i + k, j + l) over k, l = -R .. R.
   subroutine convolve(self, weights, field, values)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: weights(:, :)        !! stencil of the reach R, shape (2R + 1, 2R + 1)
      !> The field and R more rows and columns on each side, shape (M + 2R, slab%columns() + 2R).
      real(sp), intent(in), contiguous :: field(:, :)
      real(sp), intent(inout) :: values(:, :)      !! result; does not change elsewhere, shape (M, slab%columns())

      integer :: i, k, l, r

      !$omp parallel do num_threads(self%threads) private(i, k, l)
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         associate (j => self%column(r))
            values(self%first(r):self%last(r), j) = 0.0_sp
            do l = 1, size(weights, 2)
               do k = 1, size(weights, 1)
                  if (abs(weights(k, l)) <= 0.0_sp) cycle
                  do i = self%first(r), self%last(r)
                     values(i, j) = values(i, j) + weights(k, l)*field(i + k - 1, j + l - 1)
                  end do
               end do
            end do
         end associate
      end do
   end subroutine convolve

   !> Adds sums over chunks to sums over strips, which `grid_slab%strip_totals` adds to sums over the grid.
   pure function strip_sums(self, chunk_sums) result(sums)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: chunk_sums(:, :)    !! shape (number of different sums, chunks)
      real(dp) :: sums(size(chunk_sums, 1), size(self%strip_chunk) - 1)

      integer :: s

      do s = 1, size(sums, 2)
         sums(:, s) = sum(chunk_sums(:, self%strip_chunk(s):self%strip_chunk(s + 1) - 1), dim=2)
      end do
   end function strip_sums

   !> Adds changes to the pressure at the free points and keeps it between zero and an upper bound. At the other points
   !> of the region, which are at a bound but for rounding, the pressure becomes this bound.
   subroutine correct(self, change, contact, unit, bound, pressure)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: change(:)            !! changes of the pressure over `unit`, shape (points)
      real(sp), intent(in) :: contact(:)           !! 1 at free points, 0 at others, shape (points)
      real(dp), intent(in) :: unit                 !! unit of the changes
      real(dp), intent(in) :: bound                !! upper bound of the pressure, > 0
      real(dp), intent(inout) :: pressure(:, :)    !! shape (M, slab%columns())

      integer :: i, k, r

      !$omp parallel do num_threads(self%threads) private(i, k)
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         associate (p => pressure(:, self%column(r)))
            do i = self%first(r), self%last(r)
               k = self%position(r) + i - self%first(r)
               p(i) = min(bound, max(0.0_dp, p(i) + unit*change(k)))
               if (contact(k) <= 0.0_sp) p(i) = merge(0.0_dp, bound, p(i) < 0.5_dp*bound)
            end do
         end associate
      end do
   end subroutine correct

   !> Adds to the value at each point the values at its four neighbours, in 1-D at its two. Applied to a field that is
   !> positive in a region and zero elsewhere it widens the region by one step.
   subroutine add_neighbours(slab, even, field)
      type(grid_slab), intent(in) :: slab      !! columns of the grid that this process has
      logical, intent(in) :: even              !! whether the grid continues by mirror images, otherwise periodically
      real(sp), intent(inout) :: field(:, :)   !! shape (M, slab%columns())

      real(sp), dimension(size(field, 1), 1) :: high, low
      real(sp) :: beside(size(field, 1)), here(0:size(field, 1) + 1)   ! both columns beside the present one; this one
      integer :: j, m

      m = size(field, 1)
      low = 0.0_sp
      high = 0.0_sp
      if (slab%points(2) > 1) call slab%halo(field, even, low, high)
      beside = low(:, 1)
      do j = 1, size(field, 2)
         here(1:m) = field(:, j)
         here([0, m + 1]) = here(image_of_point([0, m + 1], m, even))
         if (j < size(field, 2)) then
            beside = beside + field(:, j + 1)
         else
            beside = beside + high(:, 1)
         end if
         field(:, j) = here(1:m) + beside + (here(:m - 1) + here(2:))
         beside = here(1:m)
      end do
   end subroutine add_neighbours

end module wavycon_contact_region
