!> Estimates of the errors of values from expansions of rising degree.
module wavycon_error_estimate
   use wavycon_fitted_tuning, only: error_safety, fastest_decay, least_relative_share, previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: error_estimate

contains

   !> Errors of values from the differences of the last degrees.
   !>
   !> README.md (F43) and, but for its last term, (F44). With the differences d of the last two degrees and d' of the
   !> two before, the error is taken for the larger of
   !>
   !>     d times the root of d/d', not less than fastest_decay nor more than 1, and
   !>     d' times the root of the decay from d'' to d', not more than previous_difference_share,
   !>
   !> and, if there is no d', for d; all that times error_safety. The second one holds where d is small by chance, as
   !> happens at degrees whose new terms hardly matter. Rounding and the values' largest relative error, times
   !> least_relative_share, are lower limits: integrals such as the mean gap converge faster, but not by more.
   !>
   !> N.B. These are estimates, no bounds. They hold for hundreds of loads; those of the perimeter of a rhombic
   !> lattice's spots are too small now and then.
   pure subroutine error_estimate(difference, previous_difference, previous_decay, value, error)
      real(dp), intent(in) :: difference(:)            !! d >= 0
      real(dp), intent(in) :: previous_difference(:)   !! d' >= 0; huge if there is none
      real(dp), intent(in) :: previous_decay(:)        !! d'/d'' <= 1; 1 if it is not to be used
      real(dp), intent(in) :: value(:)                 !! > 0, at the last degree
      real(dp), intent(out) :: error(:)

      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)   !! relative

      where (previous_difference < huge(1.0_dp))
         error = min(max(sqrt(difference/max(previous_difference, tiny(1.0_dp))), fastest_decay), 1.0_dp)*difference
         error = max(error, min(previous_difference_share, sqrt(previous_decay))*previous_difference)
      elsewhere
         error = difference
      end where
      error = max(error_safety*error, rounding*value)
      error = max(error, least_relative_share*value*maxval(error/value))
   end subroutine error_estimate

end module wavycon_error_estimate
