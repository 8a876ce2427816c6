!> The processes that work on a run together. They are called ranks, as in MPI, and are numbered from zero.
!>
!> All ranks run the same program on the same decks. They exchange what they share by the procedures of this module,
!> which all ranks must call in the same order. The serial program is one rank: its procedures return at once, and
!> nothing of it depends on MPI. The parallel program calls `use_communicator` first.
!>
!> Few modules use this one: wavycon_grid_slab, through which the solvers exchange, wavycon_work_sharing for the steps
!> of a run, and one module of each room that reads or writes files.
module wavycon_ranks
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, fatal_error
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: communicator, use_communicator
   public :: this_rank, rank_count, ranks_at_work, is_first_rank, work_alone, ranks_on_this_machine
   public :: add_over_ranks, add_integers_over_ranks, largest_over_ranks, any_rank
   public :: share_error, share_text, end_ranks

   !> What the ranks exchange; the parallel program extends the type and does it by MPI. Columns are exchanged by the
   !> procedures of `comm`, only where there is more than one rank; all else by the procedures of this module.
   type, abstract :: communicator
      integer :: rank = 0                     !! the number of this process, from 0
      integer :: ranks = 1                    !! the number of processes
      integer :: ranks_on_machine = 1         !! those that share this machine's memory
      character(:), allocatable :: library    !! name and version of what exchanges the data
   contains
      procedure(combine_reals), deferred, nopass :: add_reals
      procedure(add_whole_numbers), deferred, nopass :: add_integers
      procedure(combine_reals), deferred, nopass :: largest
      procedure(move_blocks), deferred :: move
      procedure(exchange_rows_and_columns), deferred :: exchange_rows
      procedure(end_run), deferred :: finish
   end type communicator

   abstract interface
      subroutine combine_reals(values)
         import :: dp
         real(dp), intent(inout), contiguous :: values(:)
      end subroutine combine_reals

      subroutine add_whole_numbers(values)
         import :: int64
         integer(int64), intent(inout), contiguous :: values(:)
      end subroutine add_whole_numbers

      !> Moves columns of a matrix from the ranks that have them to those that want them.
      !>
      !> N.B. Every rank knows what all others have and want, so that only the columns are sent.
      subroutine move_blocks(self, column_bytes, have, own, want, wanted)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: column_bytes               !! of a column
         !> First and last column of each rank, shape (2, ranks); last < first: none. No rank has a column of another,
         !> but several may want the same.
         integer, intent(in) :: have(:, 0:), want(:, 0:)
         type(*), intent(in), target :: own(*)             !! the own columns
         type(*), intent(inout), target :: wanted(*)       !! what this rank wants
      end subroutine move_blocks

      !> Exchanges a matrix whose columns are distributed over the ranks for the same matrix with its rows distributed,
      !> or back. In both the elements of a column follow each other.
      subroutine exchange_rows_and_columns(self, bytes, columns, rows, by_columns, by_rows, to_rows)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: bytes                              !! of an element
         integer, intent(in) :: columns(:, 0:), rows(:, 0:)        !! of each rank, as `have` of `move`
         type(*), intent(inout), target :: by_columns(*)           !! shape (all rows, own columns)
         type(*), intent(inout), target :: by_rows(*)              !! shape (own rows, all columns)
         logical, intent(in) :: to_rows                            !! or from rows to columns
      end subroutine exchange_rows_and_columns

      subroutine end_run(self, status)
         import :: communicator
         class(communicator), intent(in) :: self
         integer, intent(in) :: status
      end subroutine end_run
   end interface

   !> The sums of arrays over the ranks, element by element, in place. Real sums do not depend on the number of ranks if
   !> each element is zero on all ranks but one.
   interface add_over_ranks
      procedure :: add_reals_over_ranks, add_integers_over_ranks
   end interface add_over_ranks

   class(communicator), allocatable, protected, public :: comm   !! not allocated: this process is the only one
   logical :: is_alone = .false.           !! whether each rank works on something else, see work_alone

contains

   !> Sets the processes of a parallel program.
   subroutine use_communicator(new)
      class(communicator), allocatable, intent(inout) :: new   !! not allocated afterwards

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

   !> The number of processes that share the present work: one while each has work of its own.
   integer function ranks_at_work()
      ranks_at_work = 1
      if (.not. is_alone) ranks_at_work = rank_count()
   end function ranks_at_work

   !> Whether this process writes the log and the tables.
   logical function is_first_rank()
      is_first_rank = this_rank() == 0
   end function is_first_rank

   !> The processes that share the memory of this machine.
   integer function ranks_on_this_machine() result(number)
      number = 1
      if (allocated(comm)) number = comm%ranks_on_machine
   end function ranks_on_this_machine

   !> From now on each rank works on something else: no grid is distributed, and nothing is exchanged until the ranks
   !> work together again.
   subroutine work_alone(alone)
      logical, intent(in) :: alone

      is_alone = alone
   end subroutine work_alone

   subroutine add_reals_over_ranks(values)
      real(dp), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%add_reals(values)
   end subroutine add_reals_over_ranks

   subroutine add_integers_over_ranks(values)
      integer(int64), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%add_integers(values)
   end subroutine add_integers_over_ranks

   !> The largest over the ranks, element by element, in place.
   subroutine largest_over_ranks(values)
      real(dp), intent(inout), contiguous :: values(:)

      if (ranks_at_work() > 1) call comm%largest(values)
   end subroutine largest_over_ranks

   !> Whether something is true on any rank.
   logical function any_rank(mine)
      logical, intent(in) :: mine

      integer(int64) :: number(1)

      number = merge(1, 0, mine)
      call add_over_ranks(number)
      any_rank = number(1) > 0
   end function any_rank

   !> Reports an error of any rank to all ranks, with the message of the lowest rank that has one. Without errors
   !> nothing happens.
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
      integer, intent(in) :: from                              !! the rank
      character(:), allocatable, intent(inout) :: text         !! allocated

      integer(int64) :: length(1)
      integer(int64), allocatable :: codes(:)
      integer :: i

      if (ranks_at_work() == 1) return
      length = merge(len(text), 0, this_rank() == from)
      call add_over_ranks(length)
      allocate (codes(length(1)), source=0_int64)
      if (this_rank() == from) codes(:) = [(ichar(text(i:i)), i=1, len(text))]
      call add_over_ranks(codes)
      text = repeat(' ', size(codes))
      do i = 1, size(codes)
         text(i:i) = char(codes(i))
      end do
   end subroutine share_text

   !> Ends the work of all ranks, before the program ends; it need not be called by all of them.
   subroutine end_ranks(status)
      integer, intent(in) :: status   !! exit status

      if (allocated(comm)) call comm%finish(status)
   end subroutine end_ranks

end module wavycon_ranks
