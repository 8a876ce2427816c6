!> A slab of a grid: the columns that this process has of a grid that may be distributed over processes. The processes
!> are called ranks, as in MPI. The columns of a slab are called own columns. Code that solves contacts knows slabs
!> only, not ranks.
!>
!> Large grids are distributed: each rank has a slab of adjacent columns with all their rows. Small grids are whole:
!> each rank has all columns and computes them all, and nothing is exchanged. In the serial program every grid is whole.
!> Code that takes sums, neighbours and columns by the procedures of this module works for both cases alike. All ranks
!> that work on a grid must call these procedures in the same order.
!>
!> Sums are the same to the last digit for any number of ranks. Each rank sums over its columns, or over strips of
!> `strip_columns` columns, and the sums of all columns or strips are added in the order of the grid.
module wavycon_grid_slab
   use wavycon_grid_points, only: image_of_point
   use wavycon_kinds, only: dp, int64, sp
   use wavycon_ranks, only: add_over_ranks, any_rank, comm, largest_over_ranks, ranks_at_work, ranks_on_this_machine, &
      share_error, this_rank
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: grid_slab

   !> Number of columns in a strip. A slab begins with a strip. So sums over strips do not depend on how a grid is
   !> distributed, and the 2, 4, ... 32 columns of a mean on a coarser grid are on one rank.
   integer, parameter, public :: strip_columns = 32

   !> Largest number of columns that a neighbour may need. Each rank with columns has at least this number of them.
   integer, parameter, public :: most_reach = 8

   !> Grids with fewer points are whole on each rank.
   integer(int64), parameter, public :: least_distributed_points = 65536_int64

   type :: grid_slab
      integer :: points(2) = 0          !! M, N, rows and columns of the grid
      logical :: is_distributed = .false.    !! whether other ranks have the other columns
      integer :: width = 0              !! number of columns of each rank but the last ones
      integer :: first = 1, last = 0    !! first and last own column; last = first - 1 if there is none
   contains
      procedure :: start, divide, columns, strips, has_memory, blocks, coarser, column_totals
      procedure :: strip_totals, total, total_count, largest, sum_of, extremes, find_largest, first_point
      !> Whether a condition is true on any rank at work, also if each rank has the whole grid.
      procedure, nopass :: any => any_rank
      !> Reports an error of any rank at work to all ranks, also if each rank has the whole grid.
      procedure, nopass :: share_error
      !> Gets the columns before and after the own ones.
      generic :: halo => halo_dp, halo_sp
      procedure :: fetch, gather, gather_whole, exchange_rows
      procedure, private :: halo_dp, halo_sp
   end type grid_slab

contains

   !> Distributes a grid over the ranks that are at work, if it is large enough. The result depends only on the
   !> arguments and the number of these ranks.
   subroutine start(self, points, whole)
      class(grid_slab), intent(out) :: self
      integer, intent(in) :: points(2)         !! M, N >= 1
      logical, intent(in), optional :: whole   !! whether the grid stays whole, however large it is; default: .false.

      integer :: ranks, width

      self%points = points
      self%width = points(2)
      self%last = points(2)
      if (present(whole)) then
         if (whole) return
      end if
      ranks = ranks_at_work()
      if (ranks == 1 .or. product(int(points, int64)) < least_distributed_points) return
      width = strip_columns*(((points(2) - 1)/strip_columns)/ranks + 1)
      ! The last rank with columns has enough of them for its neighbours.
      do while (modulo(points(2) - 1, width) + 1 < most_reach)
         width = width + strip_columns
      end do
      if (width < points(2)) call set_width(self, width)
   end subroutine start

   !> Distributes a grid of any size, so that all ranks at work but the last ones have the same number of columns. Slabs
   !> need not begin with a strip and may be narrow, so that halo and strip sums must not be used.
   subroutine divide(self, points)
      class(grid_slab), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N >= 1

      call self%start(points, whole=.true.)
      if (ranks_at_work() > 1) call set_width(self, (points(2) - 1)/ranks_at_work() + 1)
   end subroutine divide

   !> Distributes a grid in slabs of a given number of columns.
   subroutine set_width(self, width)
      class(grid_slab), intent(inout) :: self
      integer, intent(in) :: width

      self%is_distributed = .true.
      self%width = width
      self%first = min(this_rank()*width, self%points(2)) + 1
      self%last = min((this_rank() + 1)*width, self%points(2))
   end subroutine set_width

   !> The first and last columns of all ranks of a distributed grid, shape (2, ranks); last = first - 1 if a rank has
   !> none.
   function blocks(self)
      class(grid_slab), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      integer :: r

      associate (ends => min([(r*self%width, r=0, ranks_at_work())], self%points(2)))
         blocks = reshape([ends(:size(ends) - 1) + 1, ends(2:)], [2, size(ends) - 1], order=[2, 1])
      end associate
   end function blocks

   !> The number of own columns.
   pure integer function columns(self)
      class(grid_slab), intent(in) :: self

      columns = self%last - self%first + 1
   end function columns

   !> The number of own strips. Strip s consists of the own columns (s - 1)*strip_columns + 1 to min(s*strip_columns,
   !> columns()), counted from 1.
   pure integer function strips(self)
      class(grid_slab), intent(in) :: self

      strips = (self%columns() + strip_columns - 1)/strip_columns
   end function strips

   !> Whether the available memory of this machine is enough for the slabs of all its ranks.
   logical function has_memory(self, numbers)
      class(grid_slab), intent(in) :: self
      integer, intent(in) :: numbers   !! real numbers in double precision for each point

      has_memory = has_memory_for(int(self%points(1), int64)*self%width*numbers*ranks_on_this_machine())
   end function has_memory

   !> The slab of the grid with half the points each way, distributed in the same way: each rank has the means of its
   !> own columns. A slab may have as little as one column, so that `halo` must not ask for more.
   pure type(grid_slab) function coarser(self)
      !> Slab with even numbers of points, but N may be 1; its width is even if the grid is distributed.
      class(grid_slab), intent(in) :: self

      coarser = self
      coarser%points = max(self%points/2, 1)
      if (self%points(2) == 1) return
      coarser%width = self%width/2
      coarser%first = (self%first + 1)/2
      coarser%last = self%last/2
   end function coarser

   !> Adds sums over the own columns to sums over the grid.
   function column_totals(self, own_sums) result(totals)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: own_sums(:, :)    !! shape (number of different sums, columns())
      real(dp) :: totals(size(own_sums, 1))

      totals = totals_of(self, own_sums, self%first - 1, self%points(2))
   end function column_totals

   !> Adds sums over the own strips to sums over the grid.
   function strip_totals(self, own_sums) result(totals)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: own_sums(:, :)    !! shape (number of different sums, strips())
      real(dp) :: totals(size(own_sums, 1))

      totals = totals_of(self, own_sums, (self%first - 1)/strip_columns, (self%points(2) - 1)/strip_columns + 1)
   end function strip_totals

   !> Adds the sums of all ranks in the order of the grid. Each rank puts its sums into an array for all columns or
   !> strips that is zero elsewhere; adding zeros does not round, and so the digits do not depend on the ranks.
   function totals_of(slab, own_sums, before, number) result(totals)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: own_sums(:, :)   !! shape (number of different sums, own columns or strips)
      integer, intent(in) :: before            !! number of columns or strips on lower ranks
      integer, intent(in) :: number            !! number of columns or strips of the grid
      real(dp) :: totals(size(own_sums, 1))

      real(dp), allocatable :: every(:)
      integer :: sums

      if (.not. slab%is_distributed) then
         totals = sum(own_sums, dim=2)
         return
      end if
      sums = size(own_sums, 1)
      allocate (every(sums*number), source=0.0_dp)
      if (size(own_sums) > 0) &
         every(sums*before + 1:sums*(before + size(own_sums, 2))) = reshape(own_sums, [size(own_sums)])
      call add_over_ranks(every)
      totals = sum(reshape(every, [sums, number]), dim=2)
   end function totals_of

   !> Adds arrays over the ranks, element by element, if the grid is distributed. The digits do not depend on the number
   !> of ranks if each element is zero on all ranks but one.
   function total(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: values(:)
      real(dp) :: total(size(values))

      total = values
      if (self%is_distributed) call add_over_ranks(total)
   end function total

   !> Adds a count of points in the own columns to the count on the grid.
   integer(int64) function total_count(self, own)
      class(grid_slab), intent(in) :: self
      integer(int64), intent(in) :: own   !! count in the own columns

      integer(int64) :: every(1)

      every = own
      if (self%is_distributed) call add_over_ranks(every)
      total_count = every(1)
   end function total_count

   !> The largest value over the ranks, element by element, if the grid is distributed.
   function largest(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: values(:)
      real(dp) :: largest(size(values))

      largest = values
      if (self%is_distributed) call largest_over_ranks(largest)
   end function largest

   !> The sum of a field over the grid.
   real(dp) function sum_of(self, field) result(total)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)   !! shape (M, columns())

      real(dp) :: column_sums(1, size(field, 2)), column
      integer :: i, j

      do j = 1, size(field, 2)
         column = 0.0_dp
         !$omp simd reduction(+:column)
         do i = 1, size(field, 1)
            column = column + field(i, j)
         end do
         column_sums(1, j) = column
      end do
      total = sum(self%column_totals(column_sums))
   end function sum_of

   !> The largest value of a field over the grid, and minus the least value.
   function extremes(self, field)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)   !! shape (M, columns()), without NaN
      real(dp) :: extremes(2)

      real(dp) :: highest, lowest
      integer :: i, j

      ! maxval and minval check for NaN and take twice as long on 1024 x 1024 points.
      highest = -huge(highest)
      lowest = huge(lowest)
      do j = 1, size(field, 2)
         !$omp simd reduction(max:highest) reduction(min:lowest)
         do i = 1, size(field, 1)
            highest = max(highest, field(i, j))
            lowest = min(lowest, field(i, j))
         end do
      end do
      extremes = self%largest([highest, -lowest])
   end function extremes

   !> The largest value of a field over the grid, and the first point that has this value.
   subroutine find_largest(self, field, value, point)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! shape (M, columns())
      real(dp), intent(out) :: value
      integer, intent(out) :: point(2)        !! row and column, from 1

      real(dp) :: column, columns(size(field, 2))
      integer :: i, j

      do j = 1, size(field, 2)
         column = -huge(column)
         !$omp simd reduction(max:column)
         do i = 1, size(field, 1)
            column = max(column, field(i, j))
         end do
         columns(j) = column
      end do
      value = maxval(self%largest([maxval(columns)]))
      i = 0
      j = findloc(columns >= value, .true., dim=1)
      if (j > 0) i = findloc(field(:, j) >= value, .true., dim=1)
      point = self%first_point(j > 0, [i, self%first - 1 + j])
   end subroutine find_largest

   !> The first point, in the order of the grid, of those that the ranks give.
   function first_point(self, gives, point) result(first)
      class(grid_slab), intent(in) :: self
      logical, intent(in) :: gives      !! whether this rank gives a point; at least one rank must
      integer, intent(in) :: point(2)   !! its row and column, from 1
      integer :: first(2)

      !> Minus the number of the point, from 0. A real number holds a whole number exactly up to 2^53.
      real(dp) :: minus_number(1)

      minus_number = -huge(minus_number)
      if (gives) minus_number = -(point(1) - 1 + real(self%points(1), dp)*(point(2) - 1))
      minus_number = self%largest(minus_number)
      associate (number => int(-minus_number(1), int64), m => self%points(1))
         first = 1 + int([modulo(number, int(m, int64)), number/m])
      end associate
   end function first_point

   !> Gets the columns before and after the own ones. These are columns of other ranks, or at the border of the grid the
   !> images that continue the grid. A rank without columns gets none.
   subroutine halo_dp(self, field, even, low, high)
      integer, parameter :: wp = dp

      include 'halo.inc'
   end subroutine halo_dp

   subroutine halo_sp(self, field, even, low, high)
      integer, parameter :: wp = sp

      include 'halo.inc'
   end subroutine halo_sp

   !> Gets adjacent columns of the grid. Other ranks may have some or all of these columns, and each rank asks for other
   !> ones.
   subroutine fetch(self, field, even, first, wanted)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)             !! own columns, shape (any, columns())
      logical, intent(in) :: even    !! whether the grid continues by mirror images, otherwise periodically
      integer, intent(in) :: first   !! first column, >= 0; column 0 is the image before column 1
      !> The columns, at most up to N + 1, the image after column N. The array may have no columns.
      real(dp), intent(inout), contiguous :: wanted(:, first:)

      integer(int64), allocatable :: every(:)
      integer, allocatable, dimension(:, :) :: bounds, have   ! first and last columns that each rank wants, and has
      integer :: column_bytes, j, last

      last = ubound(wanted, 2)
      associate (n => self%points(2), this => this_rank())
         if (.not. self%is_distributed) then
            do j = first, last
               wanted(:, j) = field(:, image_of_point(j, n, even))
            end do
            return
         end if
         have = self%blocks()
         allocate (every(size(have)), source=0_int64)
         every(2*this + 1:2*this + 2) = [first, last]
         call add_over_ranks(every)
         bounds = int(reshape(every, shape(have)))
         column_bytes = size(field, 1)*storage_size(field)/8
         call comm%move(column_bytes, have, field, images_for_ranks(0), wanted(:, first:min(last, 0)))
         call comm%move(column_bytes, have, field, &
                        reshape([max(bounds(1, :), 1), min(bounds(2, :), n)], shape(have), order=[2, 1]), &
                        wanted(:, max(first, 1):min(last, n)))
         call comm%move(column_bytes, have, field, images_for_ranks(n + 1), wanted(:, max(first, n + 1):last))
      end associate

   contains

      !> Which column each rank needs as the image of a column beyond the grid.
      function images_for_ranks(column) result(images)
         integer, intent(in) :: column   !! column of the continuation, 0 or N + 1
         integer :: images(2, size(bounds, 2))   !! first and last column; last = first - 1 if the rank needs none

         integer :: i

         do i = 1, size(images, 2)
            images(:, i) = [1, 0]
            if (bounds(1, i) <= column .and. column <= bounds(2, i)) &
               images(:, i) = image_of_point(column, self%points(2), even)
         end do
      end function images_for_ranks

   end subroutine fetch

   !> Gathers the columns of all ranks on rank 0, which writes log and tables, or on all ranks.
   subroutine gather_whole(self, own, whole, first_only)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: own(:, :)   !! own columns, shape (any, columns())
      !> All columns, shape (any, N). If the grid is distributed and rank 0 alone wants the columns, the array is not
      !> allocated on the other ranks.
      real(dp), allocatable, intent(out) :: whole(:, :)
      logical, intent(in) :: first_only               !! whether rank 0 alone wants the columns

      if (self%is_distributed) then
         allocate (whole(size(own, 1), merge(0, self%points(2), first_only .and. this_rank() > 0)))
         call self%gather(size(own, 1)*storage_size(own)/8, own, whole, first_only)
         if (size(whole, 2) == 0) deallocate (whole)
      else
         allocate (whole, source=own)
      end if
   end subroutine gather_whole

   !> Gathers the columns of a distributed grid, of numbers of any type, on rank 0 or on all ranks.
   subroutine gather(self, column_bytes, own, whole, first_only)
      class(grid_slab), intent(in) :: self
      integer, intent(in) :: column_bytes            !! size of a column [byte]
      type(*), intent(in), target :: own(*)          !! own columns
      type(*), intent(inout), target :: whole(*)     !! all columns, on ranks that want them
      logical, intent(in) :: first_only              !! whether rank 0 alone wants the columns

      integer, allocatable :: have(:, :), want(:, :)

      allocate (have, source=self%blocks())
      allocate (want, source=spread([1, self%points(2)], 2, size(have, 2)))
      if (first_only) want(2, 2:) = 0
      call comm%move(column_bytes, have, own, want, whole)
   end subroutine gather

   !> Exchanges a matrix that is distributed by columns for the same matrix distributed by rows, or back. The columns
   !> are distributed like those of this grid. The elements may be complex numbers, and a column need not have M of
   !> them.
   subroutine exchange_rows(self, rows, bytes, by_columns, by_rows, to_rows)
      class(grid_slab), intent(in) :: self
      !> Distribution of the rows of the matrix, made by `divide` as if they were columns.
      class(grid_slab), intent(in) :: rows
      integer, intent(in) :: bytes                          !! size of an element [byte]
      type(*), intent(inout), target :: by_columns(*)       !! own columns, shape (number of rows, columns())
      type(*), intent(inout), target :: by_rows(*)          !! own rows, shape (rows%columns(), N)
      logical, intent(in) :: to_rows                        !! whether columns are given and rows wanted; or the reverse

      call comm%exchange_rows(bytes, self%blocks(), rows%blocks(), by_columns, by_rows, to_rows)
   end subroutine exchange_rows

end module wavycon_grid_slab
