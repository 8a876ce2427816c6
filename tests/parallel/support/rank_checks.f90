!> The checks of a program that several ranks run: a check counts as passed if it holds on all of them.
module rank_checks
   use, intrinsic :: iso_fortran_env, only: int64, output_unit
   use wavycon_kinds, only: dp
   use wavycon_ranks, only: any_rank, end_ranks, is_first_rank
   implicit none (type, external)
   private

   public :: check, end_checks, report, same

   logical :: failed = .false.   !! whether a check of a reported subject does not hold
   logical :: good = .true.      !! whether all checks of the present one hold on this rank

contains

   subroutine check(holds)
      logical, intent(in) :: holds

      good = good .and. holds
   end subroutine check

   !> Prints whether all checks of a subject hold, on all ranks.
   subroutine report(subject)
      character(*), intent(in) :: subject

      good = .not. any_rank(.not. good)
      if (is_first_rank()) write (output_unit, '(a, 1x, a)') merge('passed', 'FAILED', good), subject
      failed = failed .or. .not. good
      good = .true.
   end subroutine report

   !> Whether numbers are equal to the last bit.
   pure logical function same(a, b)
      real(dp), intent(in) :: a(:), b(:)

      same = size(a) == size(b)
      if (same) same = all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
   end function same

   !> Ends the program on all ranks, with status 1 if a check does not hold.
   subroutine end_checks()
      failed = any_rank(.not. good) .or. failed
      call end_ranks(merge(1, 0, failed))
      if (failed) error stop 1
   end subroutine end_checks

end module rank_checks
