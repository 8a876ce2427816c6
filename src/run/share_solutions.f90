!> What the ranks tell each other of the loads that each has solved.
!>
!> Numbers travel as 8-byte words: sums of words of which all but one are zero are exact, of real numbers those of NaN
!> and of -0 are not.
module wavycon_share_solutions
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_largest_stress, only: largest_stress
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: record_of_words, record_words, words_of_record
   use wavycon_work_sharing, only: work_sharing
   implicit none (type, external)
   private

   public :: share_solutions, share_stresses

contains

   !> Gives all ranks the measures of all loads. A rank keeps the solutions of its own loads as they are.
   subroutine share_solutions(results)
      type(results_type), intent(inout) :: results   !! with solutions of the own loads

      integer :: load
      integer(int64), allocatable :: words(:)

      allocate (words(record_words*size(results%loads)), source=0_int64)
      do load = 1, size(results%loads)
         if (results%sharing%is_own_load(load)) &
            words((load - 1)*record_words + 1:load*record_words) = words_of_record(results%loads(load))
      end do
      call results%sharing%add(words)
      do load = 1, size(results%loads)
         if (.not. results%sharing%is_own_load(load)) &
            results%loads(load)%solution_record = record_of_words(words((load - 1)*record_words + 1:load*record_words))
      end do
   end subroutine share_solutions

   !> Gives all ranks the largest stresses of all loads.
   subroutine share_stresses(sharing, stresses)
      type(work_sharing), intent(in) :: sharing
      type(largest_stress), intent(inout) :: stresses(:, :)   !! shape (bodies, loads); of the own loads

      integer :: load, n
      integer(int64) :: words(size(stresses)*storage_size(stresses)/storage_size(0_int64))

      words = transfer(stresses, words)
      n = size(words)/size(stresses, 2)
      do load = 1, size(stresses, 2)
         if (.not. sharing%is_own_load(load)) words((load - 1)*n + 1:load*n) = 0
      end do
      call sharing%add(words)
      stresses = reshape(transfer(words, stresses), shape(stresses))
   end subroutine share_stresses

end module wavycon_share_solutions
