!> Exchanges own columns and own rows of a matrix by MPI.
module wavycon_mpi_rows
   use mpi_f08, only: mpi_address_kind, mpi_alltoallw, mpi_comm_world, mpi_datatype, mpi_double_precision, mpi_real, &
      mpi_type_commit, mpi_type_create_hindexed_block, mpi_type_free, mpi_type_vector
   use wavycon_kinds, only: dp
   use wavycon_ranks, only: row_exchange
   implicit none (type, external)
   private

   public :: start_mpi_rows

   !> Messages are described to MPI as they lie in the arrays: nothing is copied before or after.
   type, extends(row_exchange) :: mpi_rows
      private
      integer, allocatable :: number_of_columns(:), number_of_rows(:)   !! messages to and from each rank: 1 or 0
      !> The part of the own columns that is a rank's rows, and the part of the own rows that is its columns.
      type(mpi_datatype), allocatable :: in_columns(:), in_rows(:)
   contains
      procedure :: to_rows
      procedure :: to_columns
      final :: free_types
   end type mpi_rows

contains

   !> Prepares the exchange. The rows too are distributed in blocks of the same size.
   subroutine start_mpi_rows(rank, ranks, columns, rows, width, numbers, precision, exchange)
      integer, intent(in) :: rank, ranks     !! of this process; of all
      integer, intent(in) :: columns, rows, width, numbers, precision   !! as of new_row_exchange
      class(row_exchange), allocatable, intent(out) :: exchange

      integer :: block, columns_of(0:ranks - 1), i, rows_of(0:ranks - 1)
      integer(mpi_address_kind) :: bytes
      type(mpi_datatype) :: number
      type(mpi_rows), allocatable :: own

      allocate (own)
      block = (rows - 1)/ranks + 1
      columns_of = [(max(0, min(columns - i*width, width)), i=0, ranks - 1)]
      rows_of = [(max(0, min(rows - i*block, block)), i=0, ranks - 1)]
      own%columns = columns
      own%rows = rows
      own%own_columns = columns_of(rank)
      own%first_row = min(rank*block, rows) + 1
      own%own_rows = rows_of(rank)
      number = mpi_real
      bytes = 4*numbers
      if (precision == dp) then
         number = mpi_double_precision
         bytes = 8*numbers
      end if
      allocate (own%number_of_columns(0:ranks - 1), own%number_of_rows(0:ranks - 1), own%in_columns(0:ranks - 1), &
                own%in_rows(0:ranks - 1))
      own%number_of_columns = merge(1, 0, rows_of > 0 .and. own%own_columns > 0)
      own%number_of_rows = merge(1, 0, columns_of > 0 .and. own%own_rows > 0)
      do i = 0, ranks - 1
         own%in_columns(i) = part_of(number, own%own_columns, numbers*rows_of(i), numbers*rows, &
                                      bytes*sum(rows_of(:i - 1)))
         own%in_rows(i) = part_of(number, columns_of(i), numbers*own%own_rows, numbers*own%own_rows, &
                                  bytes*own%own_rows*sum(columns_of(:i - 1)))
      end do
      call move_alloc(own, exchange)
   end subroutine start_mpi_rows

   !> The type of runs of numbers at equal distances from a place on.
   type(mpi_datatype) function part_of(number, runs, length, distance, start) result(part)
      type(mpi_datatype), intent(in) :: number
      integer, intent(in) :: runs, length, distance      !! the last two in numbers
      integer(mpi_address_kind), intent(in) :: start     !! [byte]: may exceed the integers of mpi_alltoallw

      type(mpi_datatype) :: all_runs

      call mpi_type_vector(runs, length, distance, number, all_runs)
      call mpi_type_create_hindexed_block(1, 1, [start], all_runs, part)
      call mpi_type_commit(part)
      call mpi_type_free(all_runs)
   end function part_of

   subroutine to_rows(self, from, to)
      class(mpi_rows), intent(inout) :: self
      type(*), intent(in), target :: from(*)
      type(*), intent(inout), target :: to(*)

      integer :: nowhere(size(self%in_rows))

      nowhere = 0
      call mpi_alltoallw(from, self%number_of_columns, nowhere, self%in_columns, to, self%number_of_rows, nowhere, &
                         self%in_rows, mpi_comm_world)
   end subroutine to_rows

   subroutine to_columns(self, from, to)
      class(mpi_rows), intent(inout) :: self
      type(*), intent(in), target :: from(*)
      type(*), intent(inout), target :: to(*)

      integer :: nowhere(size(self%in_rows))

      nowhere = 0
      call mpi_alltoallw(from, self%number_of_rows, nowhere, self%in_rows, to, self%number_of_columns, nowhere, &
                         self%in_columns, mpi_comm_world)
   end subroutine to_columns

   impure elemental subroutine free_types(self)
      type(mpi_rows), intent(inout) :: self

      integer :: i

      if (.not. allocated(self%in_rows)) return
      do i = lbound(self%in_rows, 1), ubound(self%in_rows, 1)
         call mpi_type_free(self%in_columns(i))
         call mpi_type_free(self%in_rows(i))
      end do
   end subroutine free_types

end module wavycon_mpi_rows
