!> How the ranks share the work of a scene: what each does, and what they tell each other between the steps of a run.
module wavycon_work_sharing
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_solver, only: solver_traits
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_ranks, only: add_integers_over_ranks, any_rank, rank_count, ranks_on_this_machine, share_error, &
      this_rank, work_alone
   use wavycon_system, only: available_memory
   implicit none (type, external)
   private

   public :: work_sharing, choose_sharing

   !> All ranks work on each load: those of grids that are distributed have their columns, all else is computed by each.
   integer, parameter, public :: distributed_grids = 1
   !> Each rank solves loads of its own.
   integer, parameter, public :: distributed_loads = 2
   !> The first rank works, the others wait.
   integer, parameter, public :: first_rank_only = 3

   !> Given grids of so many points are distributed even where loads could be: a grid on each rank takes too much
   !> memory.
   integer(int64), parameter :: large_grid = 2_int64**22

   type :: work_sharing
      integer :: kind = first_rank_only   !! one of the names above
      integer :: ranks = 1                !! their number
      integer :: rank = 0                 !! the number of this one, from 0
      logical :: is_first = .true.        !! whether this one writes log and tables
      logical :: is_shared = .false.      !! whether more than one rank works
      integer, allocatable, private :: rank_of_load(:)   !! the rank that solves each load, if these are distributed
   contains
      procedure :: memory_of_each
      procedure :: words
      procedure :: deal_loads
      procedure :: is_own_load
      procedure :: share_loads
      procedure, nopass :: share_numbers
      !> Says whether each rank works on something else from now on, without exchange.
      procedure, nopass :: work_alone
      !> Adds words of all ranks, one by one.
      procedure, nopass :: add => add_integers_over_ranks
      !> Whether something is true on any rank.
      procedure, nopass :: any => any_rank
      !> Makes an error of any rank that of all.
      procedure, nopass :: share_error
   end type work_sharing

contains

   !> Decides how the ranks share the work. The decision depends on the deck and the number of ranks alone.
   type(work_sharing) function choose_sharing(traits, loads, need_fields, need_stresses) result(sharing)
      type(solver_traits), intent(in) :: traits     !! of the started solver
      integer, intent(in) :: loads                  !! their number
      logical, intent(in) :: need_fields            !! whether tables need fields, edges or details of all loads
      logical, intent(in) :: need_stresses          !! whether loads are found by stresses, or the interface is computed

      logical :: can_distribute_loads, is_large
      type(grid_slab) :: slab

      sharing%ranks = rank_count()
      sharing%rank = this_rank()
      sharing%is_first = sharing%rank == 0
      if (sharing%ranks == 1) return
      call slab%start(max(traits%finest_grid, 1))
      can_distribute_loads = loads >= sharing%ranks .and. .not. need_fields
      is_large = product(int(traits%given_grid, int64)) >= large_grid
      if (slab%is_distributed .and. .not. (need_stresses .or. traits%needs_whole_grids) .and. &
          (is_large .or. .not. can_distribute_loads)) then
         sharing%kind = distributed_grids
      else if (can_distribute_loads) then
         sharing%kind = distributed_loads
      end if
      sharing%is_shared = sharing%kind /= first_rank_only
   end function choose_sharing

   !> The memory that is available to each rank that works, on this machine [byte]; -1: unknown.
   integer(int64) function memory_of_each(self) result(bytes)
      class(work_sharing), intent(in) :: self

      bytes = available_memory()
      if (self%is_shared .and. bytes >= 0) bytes = bytes/ranks_on_this_machine()
   end function memory_of_each

   !> Deals the loads to the ranks in blocks, if they are distributed: the digits do not depend on the number of ranks
   !> where each block is solved by itself.
   subroutine deal_loads(self, order, block)
      class(work_sharing), intent(inout) :: self
      integer, intent(in) :: order(:)   !! the loads in the order in which they are solved
      integer, intent(in) :: block      !! loads of a block, >= 1

      integer :: i

      if (self%kind /= distributed_loads) return
      allocate (self%rank_of_load(size(order)))
      self%rank_of_load(order) = [(mod((i - 1)/block, self%ranks), i=1, size(order))]
   end subroutine deal_loads

   !> Whether this rank solves a load.
   pure logical function is_own_load(self, load)
      class(work_sharing), intent(in) :: self
      integer, intent(in) :: load

      is_own_load = .true.
      if (allocated(self%rank_of_load)) is_own_load = self%rank_of_load(load) == self%rank
   end function is_own_load

   !> Gives all ranks what each has of its own loads.
   !>
   !> It travels as 8-byte words: sums of words of which all but one are zero are exact, of real numbers those of NaN
   !> and of -0 are not.
   subroutine share_loads(self, words)
      class(work_sharing), intent(in) :: self   !! after deal_loads, with distributed loads
      integer(int64), intent(inout), contiguous :: words(:)   !! equally many of each load

      integer :: load, n

      n = size(words)/size(self%rank_of_load)
      do load = 1, size(self%rank_of_load)
         if (.not. self%is_own_load(load)) words((load - 1)*n + 1:load*n) = 0
      end do
      call add_integers_over_ranks(words)
   end subroutine share_loads

   !> Gives all ranks the numbers that one of them has, bit by bit.
   subroutine share_numbers(is_own, numbers)
      logical, intent(in) :: is_own   !! on one rank
      real(dp), intent(inout), contiguous :: numbers(:, :)

      integer(int64), allocatable :: words(:)

      allocate (words(size(numbers)), source=0_int64)
      if (is_own) words = transfer(numbers, words)
      call add_integers_over_ranks(words)
      numbers = reshape(transfer(words, numbers), shape(numbers))
   end subroutine share_numbers

   !> The decision for the log; empty for one rank.
   function words(self)
      class(work_sharing), intent(in) :: self
      character(:), allocatable :: words

      words = ''
      if (self%ranks == 1) return
      select case (self%kind)
      case (distributed_grids)
         words = ', the columns of large grids are distributed over them'
      case (distributed_loads)
         words = ', the loads are distributed over them'
      case default
         words = ', the first one works alone: there is nothing to share'
      end select
      words = integer_text(self%ranks)//words
   end function words

end module wavycon_work_sharing
