!> The points of a grid in and near the contact, and vectors of their values.
!>
!> A vector lists the values of a field at the points of the region, column by column. Its length is the number of these
!> points: what is computed with vectors costs nothing where there is no contact. `gather` takes a vector from a field,
!> `scatter` writes it back.
module wavycon_contact_region
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: contact_region

   type :: contact_region
      integer :: points = 0                    !! of the region
      logical, allocatable :: columns(:)       !! whether a column of the grid has points of the region, shape (N)
      integer :: threads = 1                   !! for loops over columns
      !> Runs of adjacent points: run r has the points first(r) to last(r) of its column, and point i of it has the
      !> place i + offset(r) in vectors.
      integer, allocatable, private :: first(:), last(:), offset(:)
      integer, allocatable, private :: run(:)  !! first run of each column, and one more than the last of all, shape (N+1)
   contains
      procedure :: start
      procedure :: gather
      procedure :: gather_scaled
      procedure :: scatter
      procedure :: correct
      procedure :: clear
      procedure :: convolve
   end type contact_region

contains

   !> Starts a region.
   subroutine start(self, inside)
      class(contact_region), intent(out) :: self
      logical(c_bool), intent(in) :: inside(:, :)   !! whether a point of the grid belongs to it, shape (M, N)

      integer :: i, j, m, n, r, begin
      integer :: counts(size(inside, 2))

      m = size(inside, 1)
      n = size(inside, 2)
      self%threads = threads_for(size(inside))
      !$omp parallel do num_threads(self%threads)
      do j = 1, n
         counts(j) = count(inside(2:, j) .and. .not. inside(:m - 1, j))
         if (inside(1, j)) counts(j) = counts(j) + 1
      end do
      allocate (self%run(n + 1), self%first(sum(counts)), self%last(sum(counts)), self%offset(sum(counts)))
      self%columns = counts > 0
      r = 0
      do j = 1, n
         self%run(j) = r + 1
         i = 1
         do while (r + 1 - self%run(j) < counts(j))
            do while (.not. inside(i, j))
               i = i + 1
            end do
            begin = i
            do while (i < m .and. inside(min(i + 1, m), j))
               i = i + 1
            end do
            r = r + 1
            self%first(r) = begin
            self%last(r) = i
            self%offset(r) = self%points - begin + 1
            self%points = self%points + i - begin + 1
            i = i + 1
         end do
      end do
      self%run(n + 1) = r + 1
   end subroutine start

   !> The values of a field at the points of the region.
   subroutine gather(self, field, vector)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: field(:, :)     !! shape (M, N)
      real(sp), intent(out) :: vector(:)      !! shape (points)

      integer :: j, r

      !$omp parallel do num_threads(self%threads) private(r)
      do j = 1, size(field, 2)
         do r = self%run(j), self%run(j + 1) - 1
            associate (a => self%first(r), b => self%last(r), o => self%offset(r))
               vector(a + o:b + o) = field(a:b, j)
            end associate
         end do
      end do
   end subroutine gather

   !> Likewise of a field in double precision, over a scale.
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
      real(sp), intent(in) :: vector(:)       !! shape (points)
      real(sp), intent(inout) :: field(:, :)  !! shape (M, N)

      integer :: j, r

      !$omp parallel do num_threads(self%threads) private(r)
      do j = 1, size(field, 2)
         do r = self%run(j), self%run(j + 1) - 1
            associate (a => self%first(r), b => self%last(r), o => self%offset(r))
               field(a:b, j) = vector(a + o:b + o)
            end associate
         end do
      end do
   end subroutine scatter

   !> Adds changes times a scale to a pressure at the free points, but keeps it between zero and an upper bound. At the
   !> other points of the region it becomes one of the two.
   subroutine correct(self, change, contact, at_bound, scale, bound, pressure)
      class(contact_region), intent(in) :: self
      real(sp), intent(in) :: change(:)            !! shape (points)
      real(sp), intent(in) :: contact(:)           !! 1 at free points, 0 at others, shape (points)
      logical, intent(in) :: at_bound(:)           !! of the other points: whether at the upper bound, shape (points)
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
                                         merge(bound, 0.0_dp, at_bound(k)), contact(k) > 0.0_sp)
               end associate
            end do
         end do
      end do
   end subroutine correct

   !> Sets the columns that have points of the region to zero.
   subroutine clear(self, field)
      class(contact_region), intent(in) :: self
      real(sp), intent(inout) :: field(:, :)   !! shape (M, N)

      integer :: j

      !$omp parallel do num_threads(self%threads)
      do j = 1, size(field, 2)
         if (self%columns(j)) field(:, j) = 0.0_sp
      end do
   end subroutine clear

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
