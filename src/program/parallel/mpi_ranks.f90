!> The exchange between the ranks, the processes of the parallel program, by MPI. src/base/ranks.f90 describes the
!> procedures and their arguments.
module wavycon_mpi_ranks
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mpi_f08, only: mpi_abort, mpi_address_kind, mpi_allreduce, mpi_alltoallv, mpi_alltoallw, mpi_byte, mpi_comm, &
      mpi_comm_free, mpi_comm_rank, mpi_comm_size, mpi_comm_split_type, mpi_comm_type_shared, mpi_comm_world, &
      mpi_datatype, mpi_double_precision, mpi_finalize, mpi_get_library_version, mpi_ibarrier, mpi_in_place, &
      mpi_info_null, mpi_init_thread, mpi_integer8, mpi_max, mpi_max_library_version_string, mpi_request, &
      mpi_status_ignore, mpi_sum, mpi_test, mpi_thread_funneled, mpi_type_commit, mpi_type_contiguous, &
      mpi_type_create_hindexed_block, mpi_type_free, mpi_type_vector
   use wavycon_error, only: exit_bad_input, exit_file_trouble
   use wavycon_kinds, only: dp, int64
   use wavycon_ranks, only: communicator, use_communicator
   implicit none (type, external)
   private

   public :: start_mpi

   !> The communicator of all processes that mpirun has started.
   type, extends(communicator) :: mpi_communicator
   contains
      procedure, nopass :: add_reals, add_integers, largest
      procedure :: move, exchange_rows, finish
   end type mpi_communicator

contains

   !> Starts MPI and makes its processes the ranks of the program. Threads within a rank do not call MPI.
   subroutine start_mpi()
      class(communicator), allocatable :: comm
      type(mpi_communicator), allocatable :: own
      character(mpi_max_library_version_string) :: library
      type(mpi_comm) :: machine
      integer :: length, provided

      allocate (own)
      call mpi_init_thread(mpi_thread_funneled, provided)
      if (provided < mpi_thread_funneled) then
         write (error_unit, '(a)') 'wavycon: this MPI library does not allow threads in its processes'
         call mpi_abort(mpi_comm_world, 1)
      end if
      call mpi_comm_rank(mpi_comm_world, own%rank)
      call mpi_comm_size(mpi_comm_world, own%ranks)
      call mpi_comm_split_type(mpi_comm_world, mpi_comm_type_shared, 0, mpi_info_null, machine)
      call mpi_comm_size(machine, own%ranks_on_machine)
      call mpi_comm_free(machine)
      call mpi_get_library_version(library, length)
      ! The library's description of itself, up to the first comma or the end of the line.
      own%library = trim(library(:scan(library(:length)//new_line('a'), ','//new_line('a')) - 1))
      call move_alloc(own, comm)
      call use_communicator(comm)
   end subroutine start_mpi

   !> Sums over the ranks, element by element, in place.
   subroutine add_reals(values)
      real(dp), intent(inout), contiguous :: values(:)

      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_sum, mpi_comm_world)
   end subroutine add_reals

   !> Sums over the ranks, element by element, in place.
   subroutine add_integers(values)
      integer(int64), intent(inout), contiguous :: values(:)

      call mpi_allreduce(mpi_in_place, values, size(values), mpi_integer8, mpi_sum, mpi_comm_world)
   end subroutine add_integers

   !> Largest values over the ranks, element by element, in place.
   subroutine largest(values)
      real(dp), intent(inout), contiguous :: values(:)

      call mpi_allreduce(mpi_in_place, values, size(values), mpi_double_precision, mpi_max, mpi_comm_world)
   end subroutine largest

   !> Moves columns of a matrix from the ranks that have them to the ranks that want them.
   !>
   !> N.B. The unit of the messages is a column, because numbers of bytes may exceed the integers of MPI.
   subroutine move(self, column_bytes, have, own, want, wanted)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: column_bytes, have(:, 0:), want(:, 0:)
      type(*), intent(in), target :: own(*)
      type(*), intent(inout), target :: wanted(*)

      !> Columns received from and sent to each rank: their number, and the number of columns before them in the array.
      integer, dimension(0:self%ranks - 1) :: received, received_at, sent, sent_at
      type(mpi_datatype) :: column

      associate (mine => self%rank)
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

   !> Exchanges a matrix with distributed columns for the same matrix with distributed rows, or back.
   !>
   !> The messages are described to MPI as they lie in the arrays, so that no copies are made before or afterwards.
   subroutine exchange_rows(self, bytes, columns, rows, by_columns, by_rows, to_rows)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: bytes, columns(:, 0:), rows(:, 0:)
      type(*), intent(inout), target :: by_columns(*), by_rows(*)
      logical, intent(in) :: to_rows

      !> For each other rank: where its rows lie in the own columns, and where its columns lie in the own rows.
      type(mpi_datatype), dimension(0:self%ranks - 1) :: in_columns, in_rows
      !> Number of messages to or from each rank, 1 or 0, and their offsets, which are in the datatypes.
      integer, dimension(0:self%ranks - 1) :: number_of_columns, number_of_rows, nowhere
      integer :: columns_of(0:self%ranks - 1), i, own_columns, own_rows, rows_of(0:self%ranks - 1)

      columns_of = columns(2, :) - columns(1, :) + 1
      rows_of = rows(2, :) - rows(1, :) + 1
      own_columns = columns_of(self%rank)
      own_rows = rows_of(self%rank)
      nowhere = 0
      number_of_columns = merge(1, 0, rows_of > 0 .and. own_columns > 0)
      number_of_rows = merge(1, 0, columns_of > 0 .and. own_rows > 0)
      do i = 0, self%ranks - 1
         in_columns(i) = part_of(bytes, own_columns, rows_of(i), sum(rows_of), &
                                 int(sum(rows_of(:i - 1)), mpi_address_kind))
         in_rows(i) = part_of(bytes, columns_of(i), own_rows, own_rows, &
                              int(own_rows, mpi_address_kind)*sum(columns_of(:i - 1)))
      end do
      if (to_rows) then
         call mpi_alltoallw(by_columns, number_of_columns, nowhere, in_columns, by_rows, number_of_rows, nowhere, &
                            in_rows, mpi_comm_world)
      else
         call mpi_alltoallw(by_rows, number_of_rows, nowhere, in_rows, by_columns, number_of_columns, nowhere, &
                            in_columns, mpi_comm_world)
      end if
      do i = 0, self%ranks - 1
         call mpi_type_free(in_columns(i))
         call mpi_type_free(in_rows(i))
      end do
   end subroutine exchange_rows

   !> The MPI datatype of a part of a matrix: runs of elements, which begin at equal distances.
   type(mpi_datatype) function part_of(bytes, runs, length, distance, first) result(part)
      integer, intent(in) :: bytes              !! size of an element
      integer, intent(in) :: runs               !! number of runs
      integer, intent(in) :: length, distance   !! length of a run; distance of the starts of two runs [elements]
      !> Number of elements before the first run. It may exceed the integers that mpi_alltoallw takes as offsets.
      integer(mpi_address_kind), intent(in) :: first

      type(mpi_datatype) :: all_runs, element

      call mpi_type_contiguous(bytes, mpi_byte, element)
      call mpi_type_vector(runs, length, distance, element, all_runs)
      call mpi_type_create_hindexed_block(1, 1, [first*bytes], all_runs, part)
      call mpi_type_commit(part)
      call mpi_type_free(all_runs)
      call mpi_type_free(element)
   end function part_of

   !> Ends MPI on all ranks. If a rank ends by an error of which the other ranks do not know, it would wait for them in
   !> mpi_finalize, and they for its next message. Such a rank therefore ends all ranks after a while.
   subroutine finish(self, status)
      class(mpi_communicator), intent(in) :: self
      integer, intent(in) :: status

      !> How long to wait for the other ranks [s]. Ranks that know of the same error arrive here at the same time.
      integer(int64), parameter :: patience = 10
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
            write (error_unit, '(a, i0, a)') 'wavycon: process ', self%rank, ' ends by an error of its own'
            call mpi_abort(mpi_comm_world, status)
         end do
      end if
      call mpi_finalize()
   end subroutine finish

end module wavycon_mpi_ranks
