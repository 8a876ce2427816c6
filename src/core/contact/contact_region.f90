!> The points of a grid in and near the contact, and vectors of their values.
!>
!> A vector lists the values of a field at the points of the region, column by column. Its length is the number of these
!> points: what is computed with vectors costs nothing where there is no contact.
!>
!> Vectors are computed chunk by chunk: a chunk has at most `longest_chunk` numbers, so that several sums and changes of
!> it take them from the cache, and threads share the chunks. Each strip of a slab begins a new chunk: its sums do not
!> depend on what other slabs have.
module wavycon_contact_region
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_grid_slab, only: grid_slab, strip_columns
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: add_neighbours, contact_region

   !> Numbers of a chunk. It bounds the rounding of sums in single precision.
   integer, parameter, public :: longest_chunk = 4096

   type :: contact_region
      integer :: points = 0                    !! of the region
      logical, allocatable :: columns(:)       !! whether a column of the grid has points of the region, shape (N)
      integer :: threads = 1                   !! for loops over its points
      integer :: chunks = 0
      integer, allocatable :: chunk(:)         !! place in vectors where each chunk begins, and one more, (chunks+1)
      !> Runs of adjacent points of one column and one chunk: the points first to last, and the place of the first of
      !> them in vectors.
      integer, allocatable, private :: column(:), first(:), last(:), place(:)
      integer, allocatable, private :: chunk_run(:)      !! first run of each chunk, and one more, shape (chunks+1)
      integer, allocatable, private :: strip_chunk(:)    !! first chunk of each strip, and one more, shape (strips+1)
   contains
      procedure :: start
      procedure :: gather_scaled
      procedure :: take_chunk
      procedure :: put_chunk
      procedure :: convolve_chunk
      procedure :: strip_places
      procedure :: strip_sums
      procedure :: correct
      procedure :: clear_outside
   end type contact_region

contains

   !> Starts a region of the points of a slab.
   subroutine start(self, inside)
      class(contact_region), intent(out) :: self
      real(sp), intent(in) :: inside(:, :)   !! > 0 at its points, 0 at others, shape (M, N), N the own columns

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
         allocate (self%column(most_runs), self%first(most_runs), self%last(most_runs), self%place(most_runs))
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
               self%place(r) = self%points
               in_run = .true.
            end if
            self%last(r) = i
         end do
      end do
      self%chunk(self%chunks + 1) = self%points + 1
      self%chunk_run(self%chunks + 1) = r + 1
      self%strip_chunk(strips + 1) = self%chunks + 1
   end subroutine start

   !> The values of a field in double precision at the points of the region, divided by a scale.
   subroutine gather_scaled(self, field, scale, vector)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! shape (M, N)
      real(dp), intent(in) :: scale           !! > 0
      real(sp), intent(out) :: vector(:)      !! shape (points)

      integer :: r

      !$omp parallel do num_threads(self%threads)
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         associate (a => self%first(r), b => self%last(r), k => self%place(r))
            vector(k:k + b - a) = real(field(a:b, self%column(r))/scale, sp)
         end associate
      end do
   end subroutine gather_scaled

   !> The values of a field at the points of a chunk.
   pure subroutine take_chunk(self, c, field, values)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                            !! the chunk
      real(sp), intent(in) :: field(:, :)                 !! shape (M, N)
      real(sp), intent(inout), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more

      integer :: i, j, r, shift

      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         j = self%column(r)
         shift = self%place(r) - self%chunk(c) + 1 - self%first(r)
         do i = self%first(r), self%last(r)
            values(i + shift) = field(i, j)
         end do
      end do
   end subroutine take_chunk

   !> Writes values to the points of a chunk.
   pure subroutine put_chunk(self, c, values, field)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                         !! the chunk
      real(sp), intent(in), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more
      real(sp), intent(inout) :: field(:, :)           !! shape (M, N)

      integer :: i, j, r, shift

      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         j = self%column(r)
         shift = self%place(r) - self%chunk(c) + 1 - self%first(r)
         do i = self%first(r), self%last(r)
            field(i, j) = values(i + shift)
         end do
      end do
   end subroutine put_chunk

   !> Sums over the neighbours of each point of a chunk, with weights: of point (i, j) the sum of weights(k, l)
   !> field(i + k, j + l).
   pure subroutine convolve_chunk(self, c, weights, field, values)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                            !! the chunk
      real(sp), intent(in) :: weights(:, :)               !! shape (2R + 1, 2R + 1)
      real(sp), intent(in), contiguous :: field(:, :)     !! with its neighbours beyond the grid, shape (M + 2R, N + 2R)
      real(sp), intent(inout), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more

      integer :: i, k, l, r, shift

      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         shift = self%place(r) - self%chunk(c) + 1 - self%first(r)
         values(self%first(r) + shift:self%last(r) + shift) = 0.0_sp
         do l = 1, size(weights, 2)
            do k = 1, size(weights, 1)
               if (abs(weights(k, l)) <= 0.0_sp) cycle
               do i = self%first(r), self%last(r)
                  values(i + shift) = values(i + shift) + weights(k, l)*field(i + k - 1, self%column(r) + l - 1)
               end do
            end do
         end do
      end do
   end subroutine convolve_chunk

   !> The places in vectors where each strip begins, and one more than the last of all, shape (strips + 1).
   pure function strip_places(self) result(places)
      class(contact_region), intent(in) :: self
      integer :: places(size(self%strip_chunk))

      places = self%chunk(self%strip_chunk)
   end function strip_places

   !> The sums of each strip from those of the chunks, as `grid_slab%strip_totals` takes them.
   pure function strip_sums(self, sums) result(parts)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: sums(:, :)    !! shape (any, chunks)
      real(dp) :: parts(size(sums, 1), size(self%strip_chunk) - 1)

      integer :: s

      do s = 1, size(parts, 2)
         parts(:, s) = sum(sums(:, self%strip_chunk(s):self%strip_chunk(s + 1) - 1), dim=2)
      end do
   end function strip_sums

   !> Adds changes times a scale to a pressure at the free points, but keeps it between zero and an upper bound. At the
   !> other points of the region it becomes one of the two.
   subroutine correct(self, change, contact, at_bound, scale, bound, pressure)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: change(:)            !! shape (points)
      real(sp), intent(in) :: contact(:)           !! 1 at free points, 0 at others, shape (points)
      logical(c_bool), intent(in) :: at_bound(:)   !! of the other points: whether at the upper bound, shape (points)
      real(dp), intent(in) :: scale
      real(dp), intent(in) :: bound                !! of the pressure, > 0
      real(dp), intent(inout) :: pressure(:, :)    !! shape (M, N)

      integer :: i, k, r

      !$omp parallel do num_threads(self%threads) private(i, k)
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         associate (p => pressure(:, self%column(r)))
            do i = self%first(r), self%last(r)
               k = self%place(r) + i - self%first(r)
               p(i) = merge(min(bound, max(0.0_dp, p(i) + scale*change(k))), merge(bound, 0.0_dp, at_bound(k)), &
                            contact(k) > 0.0_sp)
            end do
         end associate
      end do
   end subroutine correct

   !> In columns with points of the region, sets the field to zero at the other points.
   pure subroutine clear_outside(self, field)
      class(contact_region), intent(in) :: self
      real(sp), intent(inout) :: field(:, :)   !! shape (M, N)

      integer :: column, last, r

      column = 0
      last = 0
      do r = 1, self%chunk_run(self%chunks + 1) - 1
         if (self%column(r) /= column) then
            if (column > 0) field(last + 1:, column) = 0.0_sp
            column = self%column(r)
            last = 0
         end if
         field(last + 1:self%first(r) - 1, column) = 0.0_sp
         last = self%last(r)
      end do
      if (column > 0) field(last + 1:, column) = 0.0_sp
   end subroutine clear_outside

   !> Adds to a field at each point the sum over its four neighbours, in 1-D its two.
   subroutine add_neighbours(slab, even, field)
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even              !! whether mirror images continue the grid, or periods
      real(sp), intent(inout) :: field(:, :)   !! own columns, shape (M, slab%columns())

      real(sp), dimension(size(field, 1), 1) :: high, low
      real(sp) :: beside(size(field, 1)), here(0:size(field, 1) + 1)
      integer :: j, m

      m = size(field, 1)
      low = 0.0_sp
      high = 0.0_sp
      if (slab%points(2) > 1) call slab%halo(field, even, low, high)
      beside = low(:, 1)
      do j = 1, size(field, 2)
         here(1:m) = field(:, j)
         here(0) = merge(here(1), here(m), even)
         here(m + 1) = merge(here(m), here(1), even)
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
