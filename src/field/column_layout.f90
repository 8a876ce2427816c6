!> Which columns of a grid each rank has.
module wavycon_column_layout
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_grid_points, only: image_of_point
   use wavycon_ranks, only: ranks_at_work, ranks_on_this_machine, this_rank
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: column_layout

   !> Columns of a strip. Slabs begin with a strip, so that sums over strips are the same however a grid is distributed,
   !> and means of 2, 4, ... 32 columns have all of them on one rank.
   integer, parameter, public :: strip_columns = 32

   !> Columns that a neighbour may need, and that each rank with columns therefore has at least.
   integer, parameter, public :: most_reach = 8

   !> Grids with fewer points are whole on each rank.
   integer(int64), parameter, public :: least_distributed_points = 65536_int64

   type :: column_layout
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
      procedure :: find_neighbours
      procedure :: place_of_image
   end type column_layout

contains

   !> Distributes a grid over the ranks that are at work. The result depends on nothing but the arguments and the number
   !> of these ranks.
   subroutine start(self, points, whole)
      class(column_layout), intent(out) :: self
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
      class(column_layout), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N >= 1

      call self%start(points, whole=.true.)
      if (ranks_at_work() > 1) call set_width(self, (points(2) - 1)/ranks_at_work() + 1)
   end subroutine divide

   !> Distributes a grid in slabs of a given width.
   subroutine set_width(self, width)
      class(column_layout), intent(inout) :: self
      integer, intent(in) :: width

      self%is_distributed = .true.
      self%width = width
      self%first = min(this_rank()*width, self%points(2)) + 1
      self%last = min((this_rank() + 1)*width, self%points(2))
   end subroutine set_width

   !> The first and last columns of all ranks, shape (2, ranks), of a grid that is distributed; last = first - 1: none.
   function blocks(self)
      class(column_layout), intent(in) :: self
      integer, allocatable :: blocks(:, :)

      integer :: rank

      allocate (blocks(2, 0:ranks_at_work() - 1))
      do rank = 0, ranks_at_work() - 1
         blocks(:, rank) = [min(rank*self%width, self%points(2)) + 1, min((rank + 1)*self%width, self%points(2))]
      end do
   end function blocks

   !> The number of the own columns.
   pure integer function columns(self)
      class(column_layout), intent(in) :: self

      columns = self%last - self%first + 1
   end function columns

   !> The number of the own strips. Strip s has the own columns (s - 1)*strip_columns + 1 to min(s*strip_columns,
   !> columns()).
   pure integer function strips(self)
      class(column_layout), intent(in) :: self

      strips = (self%columns() + strip_columns - 1)/strip_columns
   end function strips

   !> Whether this machine has the memory for so many real numbers at each point of the slabs of all its ranks.
   logical function has_memory(self, numbers)
      class(column_layout), intent(in) :: self
      integer, intent(in) :: numbers   !! of each point

      has_memory = has_memory_for(int(self%points(1), int64)*self%width*numbers*ranks_on_this_machine())
   end function has_memory

   !> The ranks that have the columns before and behind the own ones; -1 beyond a border that mirrors the grid.
   subroutine find_neighbours(self, even, before, behind)
      class(column_layout), intent(in) :: self
      logical, intent(in) :: even
      integer, intent(out) :: before, behind

      before = this_rank() - 1
      if (before < 0 .and. .not. even) before = (self%points(2) - 1)/self%width
      behind = this_rank() + 1
      if (self%last == self%points(2)) behind = merge(-1, 0, even)
   end subroutine find_neighbours

   !> For a column beside the own ones: the place, among the own columns, of the column whose image it is; 0 if another
   !> rank has it.
   pure integer function place_of_image(self, even, column) result(place)
      class(column_layout), intent(in) :: self
      logical, intent(in) :: even
      integer, intent(in) :: column   !! of the grid or its continuation

      place = 0
      if (.not. self%is_distributed .or. (even .and. (column < 1 .or. column > self%points(2)))) &
         place = image_of_point(column, self%points(2), even) - self%first + 1
   end function place_of_image

end module wavycon_column_layout
