!> Errors of what expansions of rising degree give.
module wavycon_error_estimate
   use wavycon_fitted_tuning, only: error_safety, fastest_decay, least_relative_share, previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: error_estimate

contains

   !> Errors from the last difference of two degrees and the ones before.
   pure subroutine error_estimate(difference, last_difference, last_decay, value, error)
      real(dp), intent(in) :: difference(:)       !! >= 0
      real(dp), intent(in) :: last_difference(:)  !! the one before; huge if there is none
      real(dp), intent(in) :: last_decay(:)       !! of that one over the one before it; 1 if no guide
      real(dp), intent(in) :: value(:)
      real(dp), intent(out) :: error(:)

      !> In units of the last place.
      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)

      where (last_difference < huge(1.0_dp))
         error = min(max(sqrt(difference/max(last_difference, tiny(1.0_dp))), fastest_decay), 1.0_dp) &
            *difference
         error = max(error, min(previous_difference_share, sqrt(last_decay))*last_difference)
      elsewhere
         error = difference
      end where
      error = max(error_safety*error, rounding*value)
      error = max(error, least_relative_share*value*maxval(error/value))
   end subroutine error_estimate

end module wavycon_error_estimate
