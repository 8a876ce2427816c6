!> The columns of a grid that one rank has.
!>
!> Large grids are spread over the ranks: each has a slab of adjacent columns, all rows of them. Small grids are whole on
!> each rank, and each computes all of it: then nothing is exchanged. In the serial program every grid is whole. Code
!> that works on a slab and takes its sums and neighbours by the procedures here does not ask which of the two it is.
!>
!> Sums do not depend on the number of ranks to the last digit: each rank sums its columns, or strips of
!> `strip_columns` columns, and the sums of all columns or strips are added in the order of the grid.
module wavycon_grid_slab
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_grid_transform, only: image_of_point
   use wavycon_kinds, only: dp, sp
   use wavycon_ranks, only: add_over_ranks, exchange_columns, gather_columns, largest_over_ranks, ranks_at_work, &
      this_rank
   implicit none (type, external)
   private

   public :: grid_slab

   !> Columns of a strip. Slabs begin with a strip, so that sums over strips are the same however a grid is spread, and
   !> means of 2, 4, ... 32 columns have all of them on one rank.
   integer, parameter, public :: strip_columns = 32

   !> Columns that a neighbour may need, and that each rank with columns therefore has at least.
   integer, parameter, public :: most_reach = 8

   !> Grids with fewer points are whole on each rank.
   integer(int64), parameter, public :: least_spread_points = 65536_int64

   type :: grid_slab
      integer :: points(2) = 0          !! M, N of the grid
      logical :: is_spread = .false.    !! whether other ranks have the other columns
      integer :: width = 0              !! columns of each rank but the last ones, a multiple of strip_columns
      integer :: first = 1, last = 0    !! the own columns; last = first - 1: none
   contains
      procedure :: start
      procedure :: columns
      procedure :: strips
      procedure :: owner
      procedure :: columns_of_ranks
      procedure :: blocks
      procedure :: coarser
      procedure :: column_totals
      procedure :: strip_totals
      !> Adds numbers over the ranks that have different columns, element by element: reals do not depend on the number
      !> of ranks if each is zero on all but one.
      generic :: add => add_reals, add_integers
      procedure :: largest
      procedure :: find_largest
      !> Columns beside the own ones.
      generic :: halo => halo_dp, halo_sp
      !> The whole grid, on every rank.
      generic :: gather => gather_whole_dp, gather_whole_sp
      procedure, private :: add_reals, add_integers, halo_dp, halo_sp, gather_whole_dp, gather_whole_sp
   end type grid_slab

contains

   !> Spreads a grid over the ranks that are at work. The result depends on nothing but the arguments and the number of
   !> these ranks.
   subroutine start(self, points)
      class(grid_slab), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N >= 1

      integer :: ranks, width

      self%points = points
      self%width = points(2)
      self%last = points(2)
      ranks = ranks_at_work()
      if (ranks == 1 .or. product(int(points, int64)) < least_spread_points) return
      width = strip_columns*(((points(2) - 1)/strip_columns)/ranks + 1)
      ! The last rank with columns has enough of them for its neighbours.
      do while (modulo(points(2) - 1, width) + 1 < most_reach)
         width = width + strip_columns
      end do
      if (width >= points(2)) return
      self%is_spread = .true.
      self%width = width
      self%first = min(this_rank()*self%width, points(2)) + 1
      self%last = min((this_rank() + 1)*self%width, points(2))
   end subroutine start

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

   !> The rank that has a column of a grid that is spread.
   pure integer function owner(self, column)
      class(grid_slab), intent(in) :: self
      integer, intent(in) :: column   !! 1 .. N

      owner = (column - 1)/self%width
   end function owner

   !> The numbers of columns of all ranks.
   function columns_of_ranks(self) result(columns)
      class(grid_slab), intent(in) :: self
      integer, allocatable :: columns(:)

      integer :: rank

      allocate (columns(0:ranks_at_work() - 1))
      columns = [(max(0, min(self%points(2) - rank*self%width, self%width)), rank=0, ranks_at_work() - 1)]
   end function columns_of_ranks

   !> The first and last columns of all ranks, shape (2, ranks), of a grid that is spread; last = first - 1: none.
   function blocks(self)
      class(grid_slab), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      integer :: rank

      allocate (blocks(2, 0:ranks_at_work() - 1))
      do rank = 0, ranks_at_work() - 1
         blocks(:, rank) = [min(rank*self%width, self%points(2)) + 1, min((rank + 1)*self%width, self%points(2))]
      end do
   end function blocks

   !> The grid of half the points each way, on the ranks as this one: each has the means of its own columns. A rank may
   !> have as little as one column for its neighbours.
   pure type(grid_slab) function coarser(self)
      class(grid_slab), intent(in) :: self   !! of even numbers of points, but N may be 1, and of even width if spread

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

      if (.not. slab%is_spread) then
         totals = sum(parts, dim=2)
         return
      end if
      sums = size(parts, 1)
      allocate (every(sums*number), source=0.0_dp)
      if (size(parts) > 0) every(sums*before + 1:sums*(before + size(parts, 2))) = reshape(parts, [size(parts)])
      call add_over_ranks(every)
      totals = sum(reshape(every, [sums, number]), dim=2)
   end function totals_of

   subroutine add_reals(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(inout), contiguous :: values(:)

      if (self%is_spread) call add_over_ranks(values)
   end subroutine add_reals

   subroutine add_integers(self, values)
      class(grid_slab), intent(in) :: self
      integer(int64), intent(inout), contiguous :: values(:)

      if (self%is_spread) call add_over_ranks(values)
   end subroutine add_integers

   !> The largest over the ranks that have different columns, element by element, in place.
   subroutine largest(self, values)
      class(grid_slab), intent(in) :: self
      real(dp), intent(inout), contiguous :: values(:)

      if (self%is_spread) call largest_over_ranks(values)
   end subroutine largest

   !> The largest number of a field and the first of the points that have it, over the whole grid.
   subroutine find_largest(self, field, value, point)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: field(:, :)     !! shape (M, columns())
      real(dp), intent(out) :: value
      integer, intent(out) :: point(2)        !! from 1

      real(dp) :: most(1), place(1)

      most = maxval(field)
      call self%largest(most)
      value = most(1)
      ! Numbers of points are whole in a real number up to 2^53.
      place = -huge(place)
      associate (m => self%points(1))
         if (any(field >= value)) then
            point = maxloc(field)
            place = -(point(1) - 1.0_dp + real(m, dp)*(self%first + point(2) - 2))
         end if
         call self%largest(place)
         point(2) = int(-place(1)/m)
         point(1) = nint(-place(1) - real(m, dp)*point(2))
         if (point(1) < 0) point = point + [m, -1]
      end associate
      point = point + 1
   end subroutine find_largest

   !> The columns before and after the own ones: columns of other ranks, or at the rim of the grid the images that
   !> continue it. A rank without columns gets none.
   subroutine halo_dp(self, field, even, low, high)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in) :: field(:, :)                        !! shape (any, columns())
      logical, intent(in) :: even                                !! whether mirror images continue the grid, or periods
      real(dp), intent(inout), contiguous :: low(:, :)           !! columns first - R to first - 1, shape (any, R)
      real(dp), intent(inout), contiguous :: high(:, :)          !! columns last + 1 to last + R; R <= most_reach

      real(dp), allocatable :: first_columns(:, :), last_columns(:, :)
      integer :: before, behind, k, reach

      reach = size(low, 2)
      if (self%columns() < 1) return
      if (self%is_spread) then
         call find_neighbours(self, even, before, behind)
         allocate (first_columns, source=field(:, :reach))
         allocate (last_columns, source=field(:, self%columns() - reach + 1:))
         call exchange_columns(before, behind, first_columns, last_columns, low, high)
      end if
      do k = 1, reach
         if (has_image(self, even, self%first - k)) low(:, reach + 1 - k) = field(:, image(self, even, self%first - k))
         if (has_image(self, even, self%last + k)) high(:, k) = field(:, image(self, even, self%last + k))
      end do
   end subroutine halo_dp

   !> As halo_dp.
   subroutine halo_sp(self, field, even, low, high)
      class(grid_slab), intent(in) :: self
      real(sp), intent(in) :: field(:, :)
      logical, intent(in) :: even
      real(sp), intent(inout), contiguous :: low(:, :), high(:, :)

      real(sp), allocatable :: first_columns(:, :), last_columns(:, :)
      integer :: before, behind, k, reach

      reach = size(low, 2)
      if (self%columns() < 1) return
      if (self%is_spread) then
         call find_neighbours(self, even, before, behind)
         allocate (first_columns, source=field(:, :reach))
         allocate (last_columns, source=field(:, self%columns() - reach + 1:))
         call exchange_columns(before, behind, first_columns, last_columns, low, high)
      end if
      do k = 1, reach
         if (has_image(self, even, self%first - k)) low(:, reach + 1 - k) = field(:, image(self, even, self%first - k))
         if (has_image(self, even, self%last + k)) high(:, k) = field(:, image(self, even, self%last + k))
      end do
   end subroutine halo_sp

   !> The ranks that have the columns before and behind the own ones; -1 beyond a rim that mirrors the grid.
   subroutine find_neighbours(slab, even, before, behind)
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even
      integer, intent(out) :: before, behind

      before = this_rank() - 1
      if (before < 0 .and. .not. even) before = slab%owner(slab%points(2))
      behind = this_rank() + 1
      if (slab%last == slab%points(2)) behind = merge(-1, 0, even)
   end subroutine find_neighbours

   !> Whether a column beside the own ones is an image of one of these, and not a column of another rank.
   pure logical function has_image(slab, even, column)
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even
      integer, intent(in) :: column   !! of the grid or its continuation

      has_image = .not. slab%is_spread .or. (even .and. (column < 1 .or. column > slab%points(2)))
   end function has_image

   !> The place among the own columns of that whose image a column is.
   pure integer function image(slab, even, column)
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even
      integer, intent(in) :: column   !! has_image

      image = image_of_point(column, slab%points(2), even) - slab%first + 1
   end function image

   subroutine gather_whole_dp(self, own, whole)
      class(grid_slab), intent(in) :: self
      real(dp), intent(in), contiguous :: own(:, :)         !! shape (any, columns())
      real(dp), intent(inout), contiguous :: whole(:, :)    !! shape (any, N)

      if (self%is_spread) then
         call gather_columns(self%columns_of_ranks(), own, whole, first_only=.false.)
      else
         whole = own
      end if
   end subroutine gather_whole_dp

   subroutine gather_whole_sp(self, own, whole)
      class(grid_slab), intent(in) :: self
      real(sp), intent(in), contiguous :: own(:, :)
      real(sp), intent(inout), contiguous :: whole(:, :)

      if (self%is_spread) then
         call gather_columns(self%columns_of_ranks(), own, whole, first_only=.false.)
      else
         whole = own
      end if
   end subroutine gather_whole_sp

end module wavycon_grid_slab
