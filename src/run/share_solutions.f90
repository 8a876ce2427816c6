!> What the ranks tell each other of the loads that each has solved.
!>
!> Numbers travel as 8-byte words: sums of words of which all but one are zero are exact, of real numbers those of NaN
!> and of -0 are not.
module wavycon_share_solutions
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: largest_stress
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: record_of_words, record_words, words_of_record
   use wavycon_work_sharing, only: work_sharing
   implicit none (type, external)
   private

   public :: share_solutions, share_stresses

   !> Words of a stress: its value, its error and its place.
   integer, parameter :: stress_words = 5

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

      integer :: body, k, load
      integer(int64), allocatable :: words(:)
      real(dp) :: numbers(stress_words)

      allocate (words(stress_words*size(stresses)), source=0_int64)
      k = 0
      do load = 1, size(stresses, 2)
         do body = 1, size(stresses, 1)
            associate (stress => stresses(body, load))
               if (sharing%is_own_load(load)) &
                  words(k + 1:k + stress_words) = transfer([stress%value, stress%error, stress%place], words)
            end associate
            k = k + stress_words
         end do
      end do
      call sharing%add(words)
      k = 0
      do load = 1, size(stresses, 2)
         do body = 1, size(stresses, 1)
            numbers = transfer(words(k + 1:k + stress_words), numbers)
            stresses(body, load) = largest_stress(numbers(1), numbers(2), numbers(3:))
            k = k + stress_words
         end do
      end do
   end subroutine share_stresses

end module wavycon_share_solutions
