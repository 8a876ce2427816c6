!> The points of a grid in and near the contact, and vectors of their values.
!>
!> A vector lists the values of a field at the points of the region, column by column. Its length is the number of these
!> points: what is computed with vectors costs nothing where there is no contact. `gather` takes a vector from a field,
!> `scatter` writes it back.
!>
!> Vectors are computed chunk by chunk: a chunk has at most `longest_chunk` numbers, so that several sums and changes of
!> it take them from the cache, and threads share the chunks. Each strip of a slab begins a new chunk: its sums do not
!> depend on what other slabs have.
module wavycon_contact_region
   use, intrinsic :: iso_c_binding, only: c_bool
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_grid_slab, only: strip_columns
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: contact_region

   !> Numbers of a chunk. It bounds the rounding of sums in single precision.
   integer, parameter, public :: longest_chunk = 4096

   type :: contact_region
      integer :: points = 0                    !! of the region
      logical, allocatable :: columns(:)       !! whether a column of the grid has points of the region, shape (N)
      integer :: threads = 1                   !! for loops over its points
      integer :: chunks = 0
      integer, allocatable :: chunk(:)         !! place in vectors where each chunk begins, and one more, (chunks+1)
      integer, allocatable :: strip(:)         !! where each strip of columns begins in vectors, shape (strips+1)
      !> Runs of adjacent points: run r has the points first(r) to last(r) of its column, and point i of it has the
      !> place i + offset(r) in vectors. A run belongs to one chunk.
      integer, allocatable, private :: first(:), last(:), offset(:)
      integer, allocatable, private :: run(:)  !! first run of each column, then last run + 1, shape (N+1)
      integer, allocatable, private :: chunk_run(:)      !! first run of each chunk, and one more, shape (chunks+1)
      integer, allocatable, private :: chunk_column(:)   !! column of that run, shape (chunks)
      integer, allocatable, private :: strip_chunk(:)    !! first chunk of each strip, and one more, shape (strips+1)
   contains
      procedure :: start
      procedure :: gather
      procedure :: gather_scaled
      procedure :: scatter
      procedure :: take_chunk
      procedure :: put_chunk
      procedure :: strip_sums
      procedure :: correct
      procedure :: clear_outside
      procedure :: convolve
   end type contact_region

contains

   !> Starts a region of the points of a slab.
   subroutine start(self, inside)
      class(contact_region), intent(out) :: self
      logical(c_bool), intent(in) :: inside(:, :)   !! whether a point belongs to it, shape (M, N), N the own columns

      integer :: counts(size(inside, 2)), points(size(inside, 2))
      integer :: begin, finish, j, m, most_chunks, n, r, strips

      m = size(inside, 1)
      n = size(inside, 2)
      strips = (n + strip_columns - 1)/strip_columns
      !$omp parallel do num_threads(threads_for(size(inside)))
      do j = 1, n
         points(j) = count(inside(:, j))
         counts(j) = count(inside(2:, j) .and. .not. inside(:m - 1, j))
         if (inside(1, j)) counts(j) = counts(j) + 1
         ! Runs that would be longer than a chunk are split.
         counts(j) = counts(j) + points(j)/longest_chunk
      end do
      ! Two adjacent chunks of a strip together have more numbers than one chunk can hold.
      most_chunks = 2*(sum(points)/longest_chunk) + strips
      allocate (self%run(n + 1), self%first(sum(counts)), self%last(sum(counts)), self%offset(sum(counts)))
      allocate (self%chunk(most_chunks + 1), self%chunk_run(most_chunks + 1), self%chunk_column(most_chunks))
      allocate (self%strip(strips + 1), self%strip_chunk(strips + 1))
      self%columns = points > 0
      self%threads = threads_for(sum(points))
      r = 0
      do j = 1, n
         if (modulo(j - 1, strip_columns) == 0) then
            self%strip((j - 1)/strip_columns + 1) = self%points + 1
            self%strip_chunk((j - 1)/strip_columns + 1) = self%chunks + 1
         end if
         self%run(j) = r + 1
         finish = 0
         do while (points(j) > 0)
            begin = finish + 1
            do while (.not. inside(begin, j))
               begin = begin + 1
            end do
            finish = begin
            do while (finish < min(m, begin + longest_chunk - 1))
               if (.not. inside(finish + 1, j)) exit
               finish = finish + 1
            end do
            call add_run()
            points(j) = points(j) - (finish - begin + 1)
         end do
      end do
      self%run(n + 1) = r + 1
      self%chunk = [self%chunk(:self%chunks), self%points + 1]
      self%chunk_run = [self%chunk_run(:self%chunks), r + 1]
      self%strip(strips + 1) = self%points + 1
      self%strip_chunk(strips + 1) = self%chunks + 1

   contains

      !> Adds the points begin to finish of column j, to the last chunk if there is room and it is of the same strip.
      subroutine add_run()
         logical :: fits

         r = r + 1
         self%first(r) = begin
         self%last(r) = finish
         self%offset(r) = self%points - begin + 1
         fits = self%strip_chunk((j - 1)/strip_columns + 1) <= self%chunks
         if (fits) fits = self%points + finish - begin + 2 - self%chunk(self%chunks) <= longest_chunk
         if (.not. fits) then
            self%chunks = self%chunks + 1
            self%chunk(self%chunks) = self%points + 1
            self%chunk_run(self%chunks) = r
            self%chunk_column(self%chunks) = j
         end if
         self%points = self%points + finish - begin + 1
      end subroutine add_run

   end subroutine start

   !> The values of a field at the points of the region.
   subroutine gather(self, field, vector)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: field(:, :)                 !! shape (M, N)
      real(sp), intent(inout), contiguous :: vector(:)    !! shape (points)

      integer :: c

      !$omp parallel do num_threads(self%threads)
      do c = 1, self%chunks
         call self%take_chunk(c, field, vector(self%chunk(c):self%chunk(c + 1) - 1))
      end do
   end subroutine gather

   !> The values of a field in double precision at the points of the region, divided by a scale.
   subroutine gather_scaled(self, field, scale, vector)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! shape (M, N)
      real(dp), intent(in) :: scale           !! > 0
      real(sp), intent(out) :: vector(:)      !! shape (points)

      integer :: j, r

      !$omp parallel do num_threads(self%threads) private(r)
      do j = 1, size(field, 2)
         do r = self%run(j), self%run(j + 1) - 1
            associate (a => self%first(r), b => self%last(r), o => self%offset(r))
               vector(a + o:b + o) = real(field(a:b, j)/scale, sp)
            end associate
         end do
      end do
   end subroutine gather_scaled

   !> Writes values to the points of the region. Other points keep theirs.
   subroutine scatter(self, vector, field)
      class(contact_region), intent(in) :: self
      real(sp), intent(in), contiguous :: vector(:)   !! shape (points)
      real(sp), intent(inout) :: field(:, :)          !! shape (M, N)

      integer :: c

      !$omp parallel do num_threads(self%threads)
      do c = 1, self%chunks
         call self%put_chunk(c, vector(self%chunk(c):self%chunk(c + 1) - 1), field)
      end do
   end subroutine scatter

   !> The values of a field at the points of a chunk.
   pure subroutine take_chunk(self, c, field, values)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                            !! the chunk
      real(sp), intent(in) :: field(:, :)                 !! shape (M, N)
      real(sp), intent(inout), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more

      integer :: i, j, o, r

      j = self%chunk_column(c)
      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         do while (self%run(j + 1) <= r)
            j = j + 1
         end do
         o = self%offset(r) - self%chunk(c) + 1
         do i = self%first(r), self%last(r)
            values(i + o) = field(i, j)
         end do
      end do
   end subroutine take_chunk

   !> Writes values to the points of a chunk.
   pure subroutine put_chunk(self, c, values, field)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: c                         !! the chunk
      real(sp), intent(in), contiguous :: values(:)    !! shape (chunk(c+1) - chunk(c)) or more
      real(sp), intent(inout) :: field(:, :)           !! shape (M, N)

      integer :: i, j, o, r

      j = self%chunk_column(c)
      do r = self%chunk_run(c), self%chunk_run(c + 1) - 1
         do while (self%run(j + 1) <= r)
            j = j + 1
         end do
         o = self%offset(r) - self%chunk(c) + 1
         do i = self%first(r), self%last(r)
            field(i, j) = values(i + o)
         end do
      end do
   end subroutine put_chunk

   !> The sums of each strip from those of the chunks, as `grid_slab%strip_totals` takes them.
   pure function strip_sums(self, sums) result(parts)
      class(contact_region), intent(in) :: self
      real(dp), intent(in) :: sums(:, :)    !! shape (any, chunks)
      real(dp) :: parts(size(sums, 1), size(self%strip) - 1)

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
      integer(int8), intent(in) :: contact(:)      !! 1 at free points, 0 at others, shape (points)
      logical(c_bool), intent(in) :: at_bound(:)   !! of the other points: whether at the upper bound, shape (points)
      real(dp), intent(in) :: scale
      real(dp), intent(in) :: bound                !! of the pressure, > 0
      real(dp), intent(inout) :: pressure(:, :)    !! shape (M, N)

      integer :: i, j, r

      !$omp parallel do num_threads(self%threads) private(i, r)
      do j = 1, size(pressure, 2)
         do r = self%run(j), self%run(j + 1) - 1
            do i = self%first(r), self%last(r)
               associate (k => i + self%offset(r))
                  pressure(i, j) = merge(min(bound, max(0.0_dp, pressure(i, j) + scale*change(k))), &
                                         merge(bound, 0.0_dp, at_bound(k)), contact(k) > 0)
               end associate
            end do
         end do
      end do
   end subroutine correct

   !> In columns with points of the region, sets the field to zero at the other points.
   subroutine clear_outside(self, field)
      class(contact_region), intent(in) :: self
      real(sp), intent(inout) :: field(:, :)   !! shape (M, N)

      integer :: j, last, r

      !$omp parallel do num_threads(threads_for(size(field))) private(last, r)
      do j = 1, size(field, 2)
         if (.not. self%columns(j)) cycle
         last = 0
         do r = self%run(j), self%run(j + 1) - 1
            field(last + 1:self%first(r) - 1, j) = 0.0_sp
            last = self%last(r)
         end do
         field(last + 1:, j) = 0.0_sp
      end do
   end subroutine clear_outside

   !> Sums over the neighbours of each point of the region, with weights: vector(i, j) = sum of weights(k, l)
   !> field(i + k, j + l).
   subroutine convolve(self, weights, reach, field, vector)
      class(contact_region), intent(in) :: self
      integer, intent(in) :: reach                      !! R >= 0
      real(sp), intent(in) :: weights(-reach:, -reach:) !! shape (2R + 1, 2R + 1)
      real(sp), intent(in) :: field(1 - reach:, 1 - reach:)   !! with its neighbours beyond the grid, shape (M+2R, N+2R)
      real(sp), intent(out) :: vector(:)                !! shape (points)

      integer :: i, j, k, l, r

      !$omp parallel do num_threads(self%threads) private(i, k, l, r) schedule(dynamic, 16)
      do j = 1, size(self%columns)
         do r = self%run(j), self%run(j + 1) - 1
            associate (a => self%first(r), b => self%last(r), o => self%offset(r))
               vector(a + o:b + o) = 0.0_sp
               do l = -reach, reach
                  do k = -reach, reach
                     if (abs(weights(k, l)) <= 0.0_sp) cycle
                     do i = a, b
                        vector(i + o) = vector(i + o) + weights(k, l)*field(i + k, j + l)
                     end do
                  end do
               end do
            end associate
         end do
      end do
   end subroutine convolve

end module wavycon_contact_region
