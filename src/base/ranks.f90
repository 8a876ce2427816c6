!> The processes that work on a run together. They are called ranks, as in MPI, and are numbered from zero.
!>
!> All ranks run the same program on the same decks. They exchange data by the procedures of this module, which all
!> ranks must call in the same order. The serial program is one rank: there the procedures return at once, and nothing
!> depends on MPI. The parallel program calls `use_communicator` first.
!>
!> Few modules use this one: wavycon_grid_slab, through which the solvers exchange data, wavycon_work_sharing for the
!> steps of a run, and one module of each directory that reads or writes files.
module wavycon_ranks
   use wavycon_error, only: error_type, fatal_error
   use wavycon_kinds, only: dp, int64
   implicit none (type, external)
   private

   public :: communicator, use_communicator
   public :: this_rank, rank_count, ranks_at_work, is_first_rank, work_alone, ranks_on_this_machine
   public :: add_over_ranks, add_integers_over_ranks, largest_over_ranks, any_rank
   public :: share_error, share_text, end_ranks

   !> The exchange of data between the ranks. The parallel program extends the type by one that uses MPI. If there is
   !> more than one rank, columns of grids are exchanged by the procedures `move` and `exchange_rows` of `comm`; all
   !> else goes through the procedures of this module.
   type, abstract :: communicator
      integer :: rank = 0                     !! number of this process, from 0
      integer :: ranks = 1                    !! number of processes
      integer :: ranks_on_machine = 1         !! number of processes that share this machine's memory
      character(:), allocatable :: library    !! name and version of the library that exchanges the data
   contains
      procedure(combine_reals), deferred, nopass :: add_reals
      procedure(add_whole_numbers), deferred, nopass :: add_integers
      procedure(combine_reals), deferred, nopass :: largest
      procedure(move_blocks), deferred :: move
      procedure(exchange_rows_and_columns), deferred :: exchange_rows
      procedure(end_run), deferred :: finish
   end type communicator

   abstract interface
      !> `add_reals`, `largest`: sums, or largest values, over the ranks, element by element, in place.
      subroutine combine_reals(values)
         import :: dp
         real(dp), intent(inout), contiguous :: values(:)
      end subroutine combine_reals

      !> `add_integers`: sums over the ranks, element by element, in place.
      subroutine add_whole_numbers(values)
         import :: int64
         integer(int64), intent(inout), contiguous :: values(:)
      end subroutine add_whole_numbers

      !> `move`: moves columns of a matrix from the ranks that have them to the ranks that want them.
      !>
      !> N.B. Every rank knows which columns all others have and want, so that only the columns are sent.
      subroutine move_blocks(self, column_bytes, have, own, want, wanted)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: column_bytes               !! size of a column
         !> First and last column that each rank has, and wants, shape (2, ranks); last < first: none. A column is on
         !> one rank, but several ranks may want it.
         integer, intent(in) :: have(:, 0:), want(:, 0:)
         type(*), intent(in), target :: own(*)             !! the columns that this rank has
         type(*), intent(inout), target :: wanted(*)       !! gets the columns that this rank wants
      end subroutine move_blocks

      !> `exchange_rows`: exchanges a matrix whose columns are distributed over the ranks for the same matrix with its
      !> rows distributed, or back. In both forms the elements of a column follow each other in memory.
      subroutine exchange_rows_and_columns(self, bytes, columns, rows, by_columns, by_rows, to_rows)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: bytes                              !! size of an element
         integer, intent(in) :: columns(:, 0:), rows(:, 0:)        !! first and last of each rank, as `have` of `move`
         type(*), intent(inout), target :: by_columns(*)           !! shape (all rows, own columns)
         type(*), intent(inout), target :: by_rows(*)              !! shape (own rows, all columns)
         logical, intent(in) :: to_rows                            !! .true.: from columns to rows; .false.: back
      end subroutine exchange_rows_and_columns

      !> `finish`: ends the exchange before the program ends.
      subroutine end_run(self, status)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: status   !! exit status of the program
      end subroutine end_run
   end interface

   !> Sums arrays over the ranks, element by element, in place. Sums of real numbers depend on the number of ranks in
   !> their last digits, unless each element is zero on all ranks but one.
   interface add_over_ranks
      procedure :: add_reals_over_ranks, add_integers_over_ranks
   end interface add_over_ranks

   class(communicator), allocatable, protected, public :: comm   !! not allocated: this process is the only one
   logical :: is_alone = .false.           !! whether each rank works by itself, see work_alone

contains

   !> Sets the communicator of a parallel program.
   subroutine use_communicator(new)
      class(communicator), allocatable, intent(inout) :: new   !! moved to `comm`: not allocated afterwards

      call move_alloc(new, comm)
   end subroutine use_communicator

   !> The number of this process, from zero.
   integer function this_rank()
      this_rank = 0
      if (allocated(comm)) this_rank = comm%rank
   end function this_rank

   !> The number of processes.
   integer function rank_count()
      rank_count = 1
      if (allocated(comm)) rank_count = comm%ranks
   end function rank_count

   !> The number of processes that share the present work: 1 while each rank works by itself (work_alone).
   integer function ranks_at_work()
      ranks_at_work = 1
      if (.not. is_alone) ranks_at_work = rank_count()
   end function ranks_at_work

   !> Whether this process writes the log and the tables.
   logical function is_first_rank()
      is_first_rank = this_rank() == 0
   end function is_first_rank

   !> The number of processes that share the memory of this machine.
   integer function ranks_on_this_machine() result(number)
      number = 1
      if (allocated(comm)) number = comm%ranks_on_machine
   end function ranks_on_this_machine

   !> Begins or ends a time in which each rank works by itself: no grid is distributed, and nothing is exchanged.
   subroutine work_alone(alone)
      logical, intent(in) :: alone   !! .true. begins this time, .false. ends it

      is_alone = alone
   end subroutine work_alone

   !> The sum of real numbers of `add_over_ranks`.
   subroutine add_reals_over_ranks(values)
      real(dp), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%add_reals(values)
   end subroutine add_reals_over_ranks

   !> The sum of integers of `add_over_ranks`.
   subroutine add_integers_over_ranks(values)
      integer(int64), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%add_integers(values)
   end subroutine add_integers_over_ranks

   !> The largest values over the ranks, element by element, in place.
   subroutine largest_over_ranks(values)
      real(dp), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%largest(values)
   end subroutine largest_over_ranks

   !> Whether a condition holds on any rank.
   logical function any_rank(mine)
      logical, intent(in) :: mine   !! whether the condition holds on this rank

      integer(int64) :: number(1)

      number = 0
      if (mine) number = 1
      call add_over_ranks(number)
      any_rank = number(1) > 0
   end function any_rank

   !> Gives all ranks the error of the lowest rank that has one. If no rank has an error nothing happens.
   subroutine share_error(error)
      type(error_type), allocatable, intent(inout) :: error

      character(:), allocatable :: status_and_message   ! the status is the code of the first character
      integer(int64), allocatable :: failed(:)
      integer :: first

      if (ranks_at_work() == 1) return
      allocate (failed(0:rank_count() - 1), source=0_int64)
      if (allocated(error)) failed(this_rank()) = 1
      call add_over_ranks(failed)
      if (all(failed == 0)) return
      first = findloc(failed > 0, .true., dim=1) - 1
      status_and_message = ''
      if (this_rank() == first) status_and_message = achar(error%status)//error%message
      call share_text(first, status_and_message)
      call fatal_error(error, iachar(status_and_message(1:1)), status_and_message(2:))
   end subroutine share_error

   !> Sends a text of one rank to all others.
   subroutine share_text(from, text)
      integer, intent(in) :: from                              !! the rank whose text is sent
      character(:), allocatable, intent(inout) :: text         !! allocated on all ranks on entry

      integer(int64) :: length(1)
      integer(int64), allocatable :: codes(:)
      integer :: i

      if (ranks_at_work() == 1) return
      length = 0
      if (this_rank() == from) length = len(text)
      call add_over_ranks(length)
      allocate (codes(length(1)), source=0_int64)
      if (this_rank() == from) codes(:) = [(ichar(text(i:i)), i=1, len(text))]
      call add_over_ranks(codes)
      text = repeat(' ', size(codes))
      do i = 1, size(codes)
         text(i:i) = char(codes(i))
      end do
   end subroutine share_text

   !> Ends the work of all ranks, before the program ends. After an error a single rank may call this procedure.
   subroutine end_ranks(status)
      integer, intent(in) :: status   !! exit status

      if (allocated(comm)) call comm%finish(status)
   end subroutine end_ranks

end module wavycon_ranks
