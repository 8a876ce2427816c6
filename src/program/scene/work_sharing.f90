!> How the ranks, the processes of the parallel program, share the work of a scene, and what they exchange between the
!> steps of a run.
module wavycon_work_sharing
   use wavycon_contact_solver, only: solver_traits
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, int64
   use wavycon_plain_text, only: integer_text
   use wavycon_ranks, only: add_integers_over_ranks, any_rank, rank_count, ranks_on_this_machine, share_error, &
      this_rank, work_alone
   use wavycon_system, only: available_memory
   implicit none (type, external)
   private

   public :: work_sharing, choose_sharing

   !> All ranks work on each load: each has its columns of distributed grids, and each does all other work itself.
   integer, parameter, public :: distributed_grids = 1
   !> Each rank solves loads of its own.
   integer, parameter, public :: distributed_loads = 2
   !> The first rank works alone, and the others wait.
   integer, parameter, public :: first_rank_only = 3

   !> If the deck gives a grid of at least so many points, the grid is distributed even if the loads could be: one grid
   !> on each rank would take too much memory.
   integer(int64), parameter :: large_grid = 2_int64**22

   type :: work_sharing
      integer :: kind = first_rank_only   !! one of the names above
      integer :: ranks = 1                !! number of ranks
      integer :: rank = 0                 !! number of this rank, from 0
      logical :: is_first = .true.        !! whether this rank writes log and tables
      logical :: is_shared = .false.      !! whether more than one rank works
      integer, allocatable, private :: rank_of_load(:)   !! the rank that solves each load, if loads are distributed
   contains
      procedure :: memory_of_each, words, deal_loads, is_own_load, share_loads
      procedure, nopass :: share_numbers
      !> Begins or ends a time in which each rank works by itself, without exchange.
      procedure, nopass :: work_alone
      !> Sums arrays of integers over the ranks, element by element.
      procedure, nopass :: add => add_integers_over_ranks
      !> Whether a condition holds on any rank.
      procedure, nopass :: any => any_rank
      !> Returns an error of any rank on all ranks.
      procedure, nopass :: share_error
   end type work_sharing

contains

   !> Decides how the ranks share the work. The decision depends only on the deck and on the number of ranks.
   type(work_sharing) function choose_sharing(traits, loads, need_fields, need_whole_grids) result(sharing)
      type(solver_traits), intent(in) :: traits     !! traits of the started solver
      integer, intent(in) :: loads                  !! number of loads
      logical, intent(in) :: need_fields            !! whether tables need fields, edges or details of all loads
      !> Whether loads are found by stresses or spots, the interface is computed, or the surface has free edges.
      logical, intent(in) :: need_whole_grids

      logical :: can_distribute_loads, is_large
      type(grid_slab) :: slab

      sharing%ranks = rank_count()
      sharing%rank = this_rank()
      sharing%is_first = sharing%rank == 0
      if (sharing%ranks == 1) return
      call slab%start(max(traits%finest_grid, 1))
      can_distribute_loads = loads >= sharing%ranks .and. .not. need_fields
      is_large = product(int(traits%given_grid, int64)) >= large_grid
      if (slab%is_distributed .and. .not. need_whole_grids .and. &
          (is_large .or. .not. can_distribute_loads)) then
         sharing%kind = distributed_grids
      else if (can_distribute_loads) then
         sharing%kind = distributed_loads
      end if
      sharing%is_shared = sharing%kind /= first_rank_only
   end function choose_sharing

   !> The memory of this machine that is available to each rank that works on it [byte]; -1 if unknown.
   integer(int64) function memory_of_each(self) result(bytes)
      class(work_sharing), intent(in) :: self

      bytes = available_memory()
      if (self%is_shared .and. bytes >= 0) bytes = bytes/ranks_on_this_machine()
   end function memory_of_each

   !> Assigns the loads to the ranks in blocks, if loads are distributed. If each block is solved without the solutions
   !> of other blocks, the digits do not depend on the number of ranks.
   subroutine deal_loads(self, order, block)
      class(work_sharing), intent(inout) :: self
      integer, intent(in) :: order(:)   !! numbers of the loads in the order of their solution
      integer, intent(in) :: block      !! number of loads of a block, >= 1

      integer :: i

      if (self%kind /= distributed_loads) return
      allocate (self%rank_of_load(size(order)))
      self%rank_of_load(order) = [(mod((i - 1)/block, self%ranks), i=1, size(order))]
   end subroutine deal_loads

   !> Whether this rank solves a load.
   pure logical function is_own_load(self, load)
      class(work_sharing), intent(in) :: self
      integer, intent(in) :: load   !! number of the load in the deck's order

      is_own_load = .true.
      if (allocated(self%rank_of_load)) is_own_load = self%rank_of_load(load) == self%rank
   end function is_own_load

   !> Gives all ranks the data that each rank has of its own loads. On return the data of all loads are the same on all
   !> ranks.
   !>
   !> The data are sent as 8-byte integers and summed, with zeros for the loads of other ranks: such sums are exact.
   !> Sums of real numbers would change NaN and -0.
   subroutine share_loads(self, words)
      class(work_sharing), intent(in) :: self   !! after deal_loads, with distributed loads
      integer(int64), intent(inout), contiguous :: words(:)   !! data of the loads, as many words for each load

      integer :: load, n

      n = size(words)/size(self%rank_of_load)
      do load = 1, size(self%rank_of_load)
         if (.not. self%is_own_load(load)) words((load - 1)*n + 1:load*n) = 0
      end do
      call add_integers_over_ranks(words)
   end subroutine share_loads

   !> Gives all ranks the numbers that one rank has, exactly, also NaN and -0.
   subroutine share_numbers(is_own, numbers)
      logical, intent(in) :: is_own   !! whether this rank has the numbers: .true. on one rank
      real(dp), intent(inout), contiguous :: numbers(:, :)   !! the same shape on all ranks

      integer(int64), allocatable :: words(:)

      allocate (words(size(numbers)), source=0_int64)
      if (is_own) words = transfer(numbers, words)
      call add_integers_over_ranks(words)
      numbers = reshape(transfer(words, numbers), shape(numbers))
   end subroutine share_numbers

   !> How the ranks share the work, in words for the log; empty if there is one rank.
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
