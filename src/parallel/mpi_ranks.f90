!> The ranks of the parallel program, by MPI.
module wavycon_mpi_ranks
   use, intrinsic :: iso_fortran_env, only: error_unit, int64
   use mpi_f08, only: mpi_abort, mpi_allgatherv, mpi_allreduce, mpi_alltoallv, mpi_bcast, mpi_byte, mpi_character, &
      mpi_comm, mpi_comm_free, mpi_comm_rank, mpi_comm_size, mpi_comm_split_type, mpi_comm_type_shared, &
      mpi_comm_world, mpi_datatype, mpi_double_precision, mpi_finalize, mpi_gatherv, mpi_get_library_version, &
      mpi_ibarrier, mpi_in_place, mpi_info_null, mpi_init_thread, mpi_integer, mpi_integer8, mpi_irecv, mpi_isend, &
      mpi_max, mpi_max_library_version_string, mpi_request, mpi_status_ignore, mpi_statuses_ignore, &
      mpi_sum, mpi_test, mpi_thread_funneled, mpi_type_commit, mpi_type_contiguous, mpi_type_free, mpi_waitall
   use wavycon_error, only: exit_bad_input, exit_file_trouble
   use wavycon_kinds, only: dp
   use wavycon_mpi_rows, only: start_mpi_rows
   use wavycon_ranks, only: communicator, row_exchange, use_communicator
   implicit none (type, external)
   private

   public :: start_mpi

   type, extends(communicator) :: mpi_communicator
      integer :: this = 0, number = 1, on_machine = 1
   contains
      procedure :: rank => own_rank
      procedure :: ranks
      procedure :: ranks_on_machine
      procedure :: add_reals
      procedure :: add_integers
      procedure :: largest
      procedure :: exchange
      procedure :: gather
      procedure :: move
      procedure :: new_row_exchange
      procedure :: share_text
      procedure :: finish
      procedure :: library
   end type mpi_communicator

contains

   !> Starts MPI and makes its processes the ranks of the program. Threads within a rank do not call MPI.
   subroutine start_mpi()
      class(communicator), allocatable :: comm
      type(mpi_communicator), allocatable :: own
      type(mpi_comm) :: machine
      integer :: provided

      allocate (own)
      call mpi_init_thread(mpi_thread_funneled, provided)
      if (provided < mpi_thread_funneled) then
         write (error_unit, '(a)') 'wavycon: this MPI library does not allow threads in its processes'
         call mpi_abort(mpi_comm_world, 1)
      end if
      call mpi_comm_rank(mpi_comm_world, own%this)
      call mpi_comm_size(mpi_comm_world, own%number)
      call mpi_comm_split_type(mpi_comm_world, mpi_comm_type_shared, 0, mpi_info_null, machine)
      call mpi_comm_size(machine, own%on_machine)
      call mpi_comm_free(machine)
      call move_alloc(own, comm)
      call use_communicator(comm)
   end subroutine start_mpi

   pure integer function own_rank(self)
      class(mpi_communicator), intent(in) :: self

      own_rank = self%this
   end function own_rank

   pure integer function ranks(self)
      class(mpi_communicator), intent(in) :: self

      ranks = self%number
   end function ranks

   pure integer function ranks_on_machine(self)
      class(mpi_communicator), intent(in) :: self

      ranks_on_machine = self%on_machine
   end function ranks_on_machine

   subroutine add_reals(self, values)
      class(mpi_communicator), intent(in) :: self
      real(dp), intent(inout), contiguous :: values(:)

      associate (unused => self); end associate
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_sum, mpi_comm_world)
   end subroutine add_reals

   subroutine add_integers(self, values)
      class(mpi_communicator), intent(in) :: self
      integer(int64), intent(inout), contiguous :: values(:)

      associate (unused => self); end associate
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_integer8, mpi_sum, mpi_comm_world)
   end subroutine add_integers

   subroutine largest(self, values)
      class(mpi_communicator), intent(in) :: self
      real(dp), intent(inout), contiguous :: values(:)

      associate (unused => self); end associate
      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_max, mpi_comm_world)
   end subroutine largest

   subroutine exchange(self, low, high, bytes, to_low, to_high, from_low, from_high)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: low, high, bytes
      type(*), intent(in), target :: to_low(*), to_high(*)
      type(*), intent(inout), target :: from_low(*), from_high(*)

      !> Two ranks may be neighbours on both sides: the tag tells which block a message is.
      integer, parameter :: downwards = 1, upwards = 2
      type(mpi_request) :: requests(4)
      integer :: number

      associate (unused => self); end associate
      number = 0
      if (low >= 0) then
         call mpi_irecv(from_low, bytes, mpi_byte, low, upwards, mpi_comm_world, requests(number + 1))
         call mpi_isend(to_low, bytes, mpi_byte, low, downwards, mpi_comm_world, requests(number + 2))
         number = number + 2
      end if
      if (high >= 0) then
         call mpi_irecv(from_high, bytes, mpi_byte, high, downwards, mpi_comm_world, requests(number + 1))
         call mpi_isend(to_high, bytes, mpi_byte, high, upwards, mpi_comm_world, requests(number + 2))
         number = number + 2
      end if
      call mpi_waitall(number, requests, mpi_statuses_ignore)
   end subroutine exchange

   !> N.B. Counts are numbers of columns: numbers of bytes may exceed the integers of MPI.
   subroutine gather(self, column_bytes, columns, own, whole, first_only)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: column_bytes
      integer, intent(in) :: columns(0:)
      type(*), intent(in), target :: own(*)
      type(*), intent(inout), target :: whole(*)
      logical, intent(in) :: first_only

      integer :: i, places(0:size(columns) - 1)
      type(mpi_datatype) :: column

      places = [(sum(columns(0:i - 1)), i=0, size(columns) - 1)]
      call mpi_type_contiguous(column_bytes, mpi_byte, column)
      call mpi_type_commit(column)
      if (first_only) then
         call mpi_gatherv(own, columns(self%this), column, whole, columns, places, column, 0, mpi_comm_world)
      else
         call mpi_allgatherv(own, columns(self%this), column, whole, columns, places, column, mpi_comm_world)
      end if
      call mpi_type_free(column)
   end subroutine gather

   !> N.B. Counts are numbers of columns, as in `gather`.
   subroutine move(self, column_bytes, have, own, want, wanted)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: column_bytes
      integer, intent(in) :: have(:, 0:), want(:, 0:)
      type(*), intent(in), target :: own(*)
      type(*), intent(inout), target :: wanted(*)

      integer, dimension(0:self%number - 1) :: received, received_at, sent, sent_at
      type(mpi_datatype) :: column

      associate (mine => self%this)
         sent_at = max(have(1, mine), want(1, :)) - have(1, mine)
         sent = max(0, min(have(2, mine), want(2, :)) - have(1, mine) + 1 - sent_at)
         received_at = max(have(1, :), want(1, mine)) - want(1, mine)
         received = max(0, min(have(2, :), want(2, mine)) - want(1, mine) + 1 - received_at)
      end associate
      call mpi_type_contiguous(column_bytes, mpi_byte, column)
      call mpi_type_commit(column)
      call mpi_alltoallv(own, sent, sent_at, column, wanted, received, received_at, column, mpi_comm_world)
      call mpi_type_free(column)
   end subroutine move

   subroutine new_row_exchange(self, columns, rows, width, numbers, precision, exchange)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: columns, rows, width, numbers, precision
      class(row_exchange), allocatable, intent(out) :: exchange

      call start_mpi_rows(self%this, self%number, columns, rows, width, numbers, precision, exchange)
   end subroutine new_row_exchange

   subroutine share_text(self, from, text)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: from
      character(:), allocatable, intent(inout) :: text

      integer :: length

      length = len(text)
      call mpi_bcast(length, 1, mpi_integer, from, mpi_comm_world)
      if (self%this /= from) then
         deallocate (text)
         allocate (character(length) :: text)
      end if
      call mpi_bcast(text, length, mpi_character, from, mpi_comm_world)
   end subroutine share_text

   !> Ends MPI on all ranks. A rank that ends by an error which the others do not know of would wait for them, as they
   !> do for it: after a while it ends them too.
   subroutine finish(self, status)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: status

      integer(int64), parameter :: patience = 10   !! ranks that know of an error end at the same time [s]
      integer(int64) :: begun, now, rate
      logical :: all_are_here
      type(mpi_request) :: request

      if (status == exit_bad_input .or. status == exit_file_trouble) then
         call mpi_ibarrier(mpi_comm_world, request)
         call system_clock(begun, rate)
         do
            call mpi_test(request, all_are_here, mpi_status_ignore)
            if (all_are_here) exit
            call system_clock(now)
            if (now - begun <= patience*rate) cycle
            write (error_unit, '(a, i0, a)') 'wavycon: process ', self%this, ' ends by an error of its own'
            call mpi_abort(mpi_comm_world, status)
         end do
      end if
      call mpi_finalize()
   end subroutine finish

   !> The library of MPI, as it calls itself up to the first comma or line.
   function library(self) result(text)
      class(mpi_communicator), intent(in) :: self
      character(:), allocatable :: text

      character(mpi_max_library_version_string) :: buffer
      integer :: length

      associate (unused => self); end associate
      call mpi_get_library_version(buffer, length)
      text = trim(buffer(:scan(buffer(:length)//new_line('a'), ','//new_line('a')) - 1))
   end function library

end module wavycon_mpi_ranks
