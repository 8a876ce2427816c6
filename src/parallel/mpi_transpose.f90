!> Transposes matrices that are spread over the ranks, by FFTW's MPI library.
module wavycon_mpi_transpose
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_float, c_int, c_int32_t, c_intptr_t, c_loc, &
      c_null_ptr, c_ptr, c_size_t
   use mpi_f08, only: mpi_comm_world
   use wavycon_fftw, only: fftw_alloc_real, fftw_destroy_plan, FFTW_ESTIMATE, fftw_free, fftwf_alloc_real, &
      fftwf_destroy_plan, fftwf_free
   use wavycon_fftw_mpi, only: fftw_mpi_execute_r2r, fftw_mpi_init, fftw_mpi_plan_many_transpose, &
      fftwf_mpi_execute_r2r, fftwf_mpi_init, fftwf_mpi_plan_many_transpose
   use wavycon_kinds, only: dp
   use wavycon_ranks, only: rank_transpose
   implicit none (type, external)
   private

   public :: start_mpi_transposes, start_mpi_transpose

   type, extends(rank_transpose) :: mpi_transpose
      private
      integer :: numbers = 1             !! of an element
      logical :: is_double = .true.
      type(c_ptr) :: forward = c_null_ptr, backward = c_null_ptr
   contains
      procedure :: to_rows
      procedure :: to_columns
      final :: destroy
   end type mpi_transpose

contains

   !> Starts FFTW's MPI library, after MPI.
   subroutine start_mpi_transposes()
      call fftw_mpi_init()
      call fftwf_mpi_init()
   end subroutine start_mpi_transposes

   !> Plans a transposition. The rows too are spread in blocks of the same size.
   subroutine start_mpi_transpose(rank, ranks, columns, rows, width, numbers, precision, transpose)
      integer, intent(in) :: rank, ranks     !! of this process; of all
      integer, intent(in) :: columns, rows, width, numbers, precision   !! as of new_transpose
      class(rank_transpose), allocatable, intent(out) :: transpose

      type(mpi_transpose), allocatable :: own
      integer :: rows_of_rank

      allocate (own)
      own%columns = columns
      own%rows = rows
      own%numbers = numbers
      own%is_double = precision == dp
      rows_of_rank = (rows - 1)/ranks + 1
      own%own_columns = max(0, min(columns - rank*width, width))
      own%first_row = min(rank*rows_of_rank, rows) + 1
      own%own_rows = max(0, min(rows - rank*rows_of_rank, rows_of_rank))
      call make_plans(own, int(width, c_intptr_t), int(rows_of_rank, c_intptr_t))
      call move_alloc(own, transpose)
   end subroutine start_mpi_transpose

   !> N.B. FFTW_ESTIMATE leaves the arrays of a plan as they are; they only tell it that input and output differ and how
   !> they are aligned. FFTW's arrays are aligned as those of `allocate` are.
   subroutine make_plans(own, width, rows_of_rank)
      type(mpi_transpose), intent(inout) :: own
      integer(c_intptr_t), intent(in) :: width, rows_of_rank

      integer(c_intptr_t) :: columns, numbers, rows
      integer(c_int32_t) :: world
      integer(c_int), parameter :: flags = FFTW_ESTIMATE
      real(c_double), pointer, contiguous :: from(:), to(:)
      real(c_float), pointer, contiguous :: from_single(:), to_single(:)
      type(c_ptr) :: one, other

      columns = own%columns
      rows = own%rows
      numbers = own%numbers
      world = mpi_comm_world%mpi_val
      ! The planner reads no array: one element of each is enough.
      if (own%is_double) then
         one = fftw_alloc_real(2_c_size_t)
         other = fftw_alloc_real(2_c_size_t)
         call c_f_pointer(one, from, [2])
         call c_f_pointer(other, to, [2])
         own%forward = fftw_mpi_plan_many_transpose(columns, rows, numbers, width, rows_of_rank, from, to, world, flags)
         own%backward = fftw_mpi_plan_many_transpose(rows, columns, numbers, rows_of_rank, width, from, to, world, flags)
         call fftw_free(one)
         call fftw_free(other)
      else
         one = fftwf_alloc_real(2_c_size_t)
         other = fftwf_alloc_real(2_c_size_t)
         call c_f_pointer(one, from_single, [2])
         call c_f_pointer(other, to_single, [2])
         own%forward = fftwf_mpi_plan_many_transpose(columns, rows, numbers, width, rows_of_rank, from_single, &
                                                     to_single, world, flags)
         own%backward = fftwf_mpi_plan_many_transpose(rows, columns, numbers, rows_of_rank, width, from_single, &
                                                      to_single, world, flags)
         call fftwf_free(one)
         call fftwf_free(other)
      end if
   end subroutine make_plans

   subroutine to_rows(self, from, to)
      class(mpi_transpose), intent(inout) :: self
      type(*), intent(inout), target :: from(*)
      type(*), intent(inout), target :: to(*)

      call execute(self, self%forward, c_loc(from), c_loc(to))
   end subroutine to_rows

   subroutine to_columns(self, from, to)
      class(mpi_transpose), intent(inout) :: self
      type(*), intent(inout), target :: from(*)
      type(*), intent(inout), target :: to(*)

      call execute(self, self%backward, c_loc(from), c_loc(to))
   end subroutine to_columns

   subroutine execute(self, plan, from, to)
      type(mpi_transpose), intent(in) :: self
      type(c_ptr), intent(in) :: plan, from, to

      real(c_double), pointer, contiguous :: source(:), target(:)
      real(c_float), pointer, contiguous :: single_source(:), single_target(:)

      if (self%is_double) then
         call c_f_pointer(from, source, [1])
         call c_f_pointer(to, target, [1])
         call fftw_mpi_execute_r2r(plan, source, target)
      else
         call c_f_pointer(from, single_source, [1])
         call c_f_pointer(to, single_target, [1])
         call fftwf_mpi_execute_r2r(plan, single_source, single_target)
      end if
   end subroutine execute

   impure elemental subroutine destroy(self)
      type(mpi_transpose), intent(inout) :: self

      if (self%is_double) then
         call fftw_destroy_plan(self%forward)
         call fftw_destroy_plan(self%backward)
      else
         call fftwf_destroy_plan(self%forward)
         call fftwf_destroy_plan(self%backward)
      end if
   end subroutine destroy

end module wavycon_mpi_transpose
