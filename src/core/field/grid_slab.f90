!> The own columns of a grid that may be distributed over processes, its ranks. Code that solves contacts knows this
!> type and not the ranks.
!>
!> Large grids are distributed over the ranks: each has a slab of adjacent columns, all rows of them. Small grids are
!> whole on each rank, and each computes all of it: then nothing is exchanged. In the serial program every grid is
!> whole. Code that works on a slab and takes its sums, neighbours and columns by the procedures here does not ask which
!> of the two it is. All ranks that work on a grid call them in the same order.
!>
!> Sums do not depend on the number of ranks to the last digit: each rank sums its columns, or strips of
!> `strip_columns` columns, and the sums of all columns or strips are added in the order of the grid.
module wavycon_grid_slab
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_grid_points, only: image_of_point
   use wavycon_kinds, only: dp, sp
   use wavycon_ranks, only: add_over_ranks, any_rank, comm, largest_over_ranks, ranks_at_work, ranks_on_this_machine, &
      share_error, this_rank
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: grid_slab

   !> Columns of a strip. Slabs begin with a strip, so that sums over strips are the same however a grid is distributed,
   !> and means of 2, 4, ... 32 columns have all of them on one rank.
   integer, parameter, public :: strip_columns = 32

   !> Columns that a neighbour may need, and that each rank with columns therefore has at least.
   integer, parameter, public :: most_reach = 8

   !> Grids with fewer points are whole on each rank.
   integer(int64), parameter, public :: least_distributed_points = 65536_int64

   type :: grid_slab
      integer :: points(2) = 0          !! M, N of the grid
      logical :: is_distributed = .false.    !! whether other ranks have the other columns
      integer :: width = 0              !! columns of each rank but the last ones, a multiple of strip_columns
      integer :: first = 1, last = 0    !! the own columns; last = first - 1: none
   contains
      procedure :: start
      procedure :: divide
      procedure :: columns
      procedure :: strips
      procedure :: has_memory
      procedure :: blocks
      procedure :: coarser
      procedure :: column_totals
      procedure :: strip_totals
      procedure :: total
      procedure :: total_count
      procedure :: largest
      procedure :: sum_of
      procedure :: extremes
      procedure :: find_largest
      !> Whether something is true on any rank at work, also if each has the whole grid.
      procedure, nopass :: any => any_rank
      !> Reports an error of any rank at work to all, also if each has the whole grid.
      procedure, nopass :: share_error
      !> Columns beside the own ones.
      generic :: halo => halo_dp, halo_sp
      procedure :: fetch
      procedure :: gather
      procedure :: gather_whole
      procedure :: exchange_rows
      procedure, private :: halo_dp, halo_sp
   end type grid_slab

contains

   !> Distributes a grid over the ranks that are at work. The result depends on nothing but the arguments and the number
   !> of these ranks.
   subroutine start(self, points, whole)
      class(grid_slab), intent(out) :: self
      integer, intent(in) :: points(2)         !! M, N >= 1
      logical, intent(in), optional :: whole   !! whether no grid, however large, is distributed; .false. if absent

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

   !> Divides a grid of any size: all ranks at work but the last ones have the same number of columns. Only for uses
   !> without neighbours and strips.
   subroutine divide(self, points)
      class(grid_slab), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N >= 1

      call self%start(points, whole=.true.)
      if (ranks_at_work() > 1) call set_width(self, (points(2) - 1)/ranks_at_work() + 1)
   end subroutine divide

   !> Distributes a grid in slabs of a given width.
   subroutine set_width(self, width)
      class(grid_slab), intent(inout) :: self
      integer, intent(in) :: width

      self%is_distributed = .true.
      self%width = width
      self%first = min(this_rank()*width, self%points(2)) + 1
      self%last = min((this_rank() + 1)*width, self%points(2))
   end subroutine set_width

   !> The first and last columns of all ranks, shape (2, ranks), of a grid that is distributed; last = first - 1: none.
   function blocks(self)
      class(grid_slab), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      integer :: rank

      allocate (blocks(2, 0:ranks_at_work() - 1))
      do rank = 0, ranks_at_work() - 1
         blocks(:, rank) = [min(rank*self%width, self%points(2)) + 1, min((rank + 1)*self%width, self%points(2))]
      end do
   end function blocks

   !> The number of the own columns.
   pure integer function columns(self)
      class(grid_slab), intent(in) :: self

      columns = self%last - self%first + 1
   end function columns

   !> The number of the own strips. Strip s has the own columns (s - 1)*strip_columns + 1 to min(s*strip_columns,
   !> columns()).
   pure integer function strips(self)
      class(grid_slab), intent(in) :: self

      strips = (self%columns() + strip_columns - 1)/strip_columns
   end function strips

   !> Whether this machine has the memory for so many real numbers at each point of the slabs of all its ranks.
   logical function has_memory(self, numbers)
      class(grid_slab), intent(in) :: self
      integer, intent(in) :: numbers   !! of each point

      has_memory = has_memory_for(int(self%points(1), int64)*self%width*numbers*ranks_on_this_machine())
   end function has_memory

   !> The grid of half the points each way, distributed like this one: each rank has the means of its own columns. It
   !> may have as little as one column for its neighbours.
   pure type(grid_slab) function coarser(self)
      class(grid_slab), intent(in) :: self   !! even numbers of points, but N may be 1; even width if distributed

      coarser = self
      coarser%points = max(self%points/2, 1)
      if (self%points(2) == 1) return
      coarser%width = self%width/2
      coarser%first = (self%first + 1)/2
      coarser%last = self%last/2
   end function coarser

   !> Sums over the grid from those of the own columns.
   function column_totals(self, parts) result(totals)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: parts(:, :)    !! shape (sums, columns())
      real(dp) :: totals(size(parts, 1))

      totals = totals_of(self, parts, self%first - 1, self%points(2))
   end function column_totals

   !> Sums over the grid from those of the own strips.
   function strip_totals(self, parts) result(totals)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: parts(:, :)    !! shape (sums, strips())
      real(dp) :: totals(size(parts, 1))

      totals = totals_of(self, parts, (self%first - 1)/strip_columns, (self%points(2) - 1)/strip_columns + 1)
   end function strip_totals

   !> Adds the parts of all ranks in their order.
   function totals_of(slab, parts, before, number) result(totals)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: parts(:, :)
      integer, intent(in) :: before      !! number of the parts of lower ranks
      integer, intent(in) :: number      !! of all parts
      real(dp) :: totals(size(parts, 1))

      real(dp), allocatable :: every(:)
      integer :: sums

      if (.not. slab%is_distributed) then
         totals = sum(parts, dim=2)
         return
      end if
      sums = size(parts, 1)
      allocate (every(sums*number), source=0.0_dp)
      if (size(parts) > 0) every(sums*before + 1:sums*(before + size(parts, 2))) = reshape(parts, [size(parts)])
      call add_over_ranks(every)
      totals = sum(reshape(every, [sums, number]), dim=2)
   end function totals_of

   !> The sums over the ranks that have different columns, element by element. They do not depend on the number of ranks
   !> if each number is zero on all but one.
   function total(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: values(:)
      real(dp) :: total(size(values))

      total = values
      if (self%is_distributed) call add_over_ranks(total)
   end function total

   !> The number of points of the grid that have a property, from that of the own columns.
   integer(int64) function total_count(self, own)
      class(grid_slab), intent(in) :: self
      integer(int64), intent(in) :: own

      integer(int64) :: every(1)

      every = own
      if (self%is_distributed) call add_over_ranks(every)
      total_count = every(1)
   end function total_count

   !> The largest over the ranks that have different columns, element by element.
   function largest(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: values(:)
      real(dp) :: largest(size(values))

      largest = values
      if (self%is_distributed) call largest_over_ranks(largest)
   end function largest

   !> Sum of a field over the grid.
   real(dp) function sum_of(self, field) result(total)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)   !! shape (M, columns())

      real(dp) :: parts(1, size(field, 2)), totals(1)
      real(dp) :: column
      integer :: i, j

      do j = 1, size(field, 2)
         column = 0.0_dp
         !$omp simd reduction(+:column)
         do i = 1, size(field, 1)
            column = column + field(i, j)
         end do
         parts(1, j) = column
      end do
      totals = self%column_totals(parts)
      total = totals(1)
   end function sum_of

   !> The largest number of a field and minus the least one, over the whole grid.
   function extremes(self, field)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)   !! shape (M, columns()), without NaN
      real(dp) :: extremes(2)

      real(dp) :: highest, lowest
      integer :: i, j

      ! Intrinsic functions look for NaN, and take twice as long on 1024 x 1024 points.
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

   !> The largest number of a field and the first of the points that have it, over the whole grid.
   subroutine find_largest(self, field, value, point)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! shape (M, columns())
      real(dp), intent(out) :: value
      integer, intent(out) :: point(2)        !! from 1

      real(dp) :: column, columns(size(field, 2)), most(1), place(1)
      integer :: i, j

      do j = 1, size(field, 2)
         column = -huge(column)
         !$omp simd reduction(max:column)
         do i = 1, size(field, 1)
            column = max(column, field(i, j))
         end do
         columns(j) = column
      end do
      most = self%largest([maxval(columns)])
      value = most(1)
      ! Numbers of points are whole in a real number up to 2^53.
      place = -huge(place)
      associate (m => self%points(1))
         j = findloc(columns >= value, .true., dim=1)
         if (j > 0) then
            i = findloc(field(:, j) >= value, .true., dim=1)
            place = -(i - 1.0_dp + real(m, dp)*(self%first + j - 2))
         end if
         place = self%largest(place)
         point(2) = int(-place(1)/m)
         point(1) = nint(-place(1) - real(m, dp)*point(2))
         if (point(1) < 0) point = point + [m, -1]
      end associate
      point = point + 1
   end subroutine find_largest

   !> The columns before and after the own ones: columns of other ranks, or at the border of the grid the images that
   !> continue it. A rank without columns gets none.
   subroutine halo_dp(self, field, even, low, high)
      integer, parameter :: wp = dp

      include 'halo.inc'
   end subroutine halo_dp

   subroutine halo_sp(self, field, even, low, high)
      integer, parameter :: wp = sp

      include 'halo.inc'
   end subroutine halo_sp

   !> Adjacent columns, of which other ranks may have some or all: each rank asks for those that it wants.
   subroutine fetch(self, field, even, first, wanted)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: field(:, :)             !! shape (any, columns())
      logical, intent(in) :: even                                 !! whether mirror images continue the grid, or periods
      integer, intent(in) :: first                                !! of the columns, >= 0; 0: the image before column 1
      real(dp), intent(inout), contiguous :: wanted(:, first:)    !! up to N + 1 at most, its image; may have no columns

      integer(int64), allocatable :: every(:)
      integer, allocatable, dimension(:, :) :: bounds, have   ! first and last columns of each rank
      integer :: column_bytes, j, last

      last = ubound(wanted, 2)
      associate (n => self%points(2), rank => this_rank())
         if (.not. self%is_distributed) then
            do j = first, last
               wanted(:, j) = field(:, image_of_point(j, n, even))
            end do
            return
         end if
         have = self%blocks()
         allocate (every(size(have)), source=0_int64)
         every(2*rank + 1:2*rank + 2) = [first, last]
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

      !> First and last column of each rank that wants the image of a column of the grid: this column, or none.
      function images_for_ranks(column) result(images)
         integer, intent(in) :: column   !! of the continuation
         integer :: images(2, size(bounds, 2))

         integer :: i

         do i = 1, size(images, 2)
            images(:, i) = [1, 0]
            if (bounds(1, i) <= column .and. column <= bounds(2, i)) &
               images(:, i) = image_of_point(column, self%points(2), even)
         end do
      end function images_for_ranks

   end subroutine fetch

   !> The whole grid on the rank that writes the log and the tables, or on all.
   subroutine gather_whole(self, own, whole, first_only)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: own(:, :)   !! shape (any, columns())
      !> Shape (any, N); not allocated on ranks that do not want it if the grid is distributed.
      real(dp), allocatable, intent(out) :: whole(:, :)
      logical, intent(in) :: first_only

      if (self%is_distributed) then
         allocate (whole(size(own, 1), merge(0, self%points(2), first_only .and. this_rank() > 0)))
         call self%gather(size(own, 1)*storage_size(own)/8, own, whole, first_only)
         if (size(whole, 2) == 0) deallocate (whole)
      else
         allocate (whole, source=own)
      end if
   end subroutine gather_whole

   !> The whole of a distributed grid, on every rank or on the first.
   subroutine gather(self, column_bytes, own, whole, first_only)
      class(grid_slab), intent(in) :: self
      integer, intent(in) :: column_bytes
      type(*), intent(in), target :: own(*)          !! the own columns
      type(*), intent(inout), target :: whole(*)     !! all columns, where they are wanted
      logical, intent(in) :: first_only              !! whether rank 0 alone wants the grid

      integer, allocatable :: have(:, :), want(:, :)

      allocate (have, source=self%blocks())
      allocate (want, source=spread([1, self%points(2)], 2, size(have, 2)))
      if (first_only) want(2, 2:) = 0
      call comm%move(column_bytes, have, own, want, whole)
   end subroutine gather

   !> Exchanges the own columns of a distributed matrix for own rows, or back. It has the columns of this grid; its
   !> elements may be complex numbers, and their number in a column need not be M.
   subroutine exchange_rows(self, rows, bytes, by_columns, by_rows, to_rows)
      class(grid_slab), intent(in) :: self
      class(grid_slab), intent(in) :: rows                  !! of the matrix, as columns: divided
      integer, intent(in) :: bytes                          !! of an element
      type(*), intent(inout), target :: by_columns(*)       !! shape (rows, columns())
      type(*), intent(inout), target :: by_rows(*)          !! shape (own rows, N)
      logical, intent(in) :: to_rows                        !! or from rows to columns

      call comm%exchange_rows(bytes, self%blocks(), rows%blocks(), by_columns, by_rows, to_rows)
   end subroutine exchange_rows

end module wavycon_grid_slab
