!> Estimates of the errors of values from expansions of rising degree.
module wavycon_error_estimate
   use wavycon_fitted_tuning, only: error_safety, fastest_decay_at_point, first_error_factor, least_relative_share, &
      previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: at_point, error_estimate

contains

   !> Errors of values from the differences of the last degrees: README.md (F43) and, but for its last term, (F44).
   !>
   !> A difference of two degrees is about the error of the lower one. That of the higher one is smaller by the decay of
   !> the misfit, which is measured at all points of collocation and is hardly ever small by chance, as differences of
   !> single values are. The difference before, carried on by the decays since, is a lower limit for the same reason.
   !> Other limits are rounding and a share of the values' largest relative error: integrals such as the mean gap
   !> converge faster than the shape, but not by much.
   !>
   !> N.B. These are estimates, no bounds. They hold for thousands of loads; those of the perimeter of a rhombic
   !> lattice's spots are too small now and then.
   pure subroutine error_estimate(difference, previous_difference, decay, value, error)
      real(dp), intent(in) :: difference(:)            !! d_n >= 0, of the last two degrees
      real(dp), intent(in) :: previous_difference(:)   !! d_(n-1), of the two before; huge if there is none
      real(dp), intent(in) :: decay(2)                 !! r_n and r_(n-1) <= 1, of the misfit
      real(dp), intent(in) :: value(:)                 !! > 0, at the last degree
      real(dp), intent(out) :: error(:)

      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)   !! relative

      where (previous_difference < huge(1.0_dp))
         error = decay(1)*max(difference, previous_difference_share*decay(2)*previous_difference)
      elsewhere
         error = first_error_factor*decay(1)*difference
      end where
      error = max(error_safety*error, rounding*value)
      error = max(error, least_relative_share*value*maxval(error/value))
   end subroutine error_estimate

   !> The decay of the misfit as it counts for the value of an expansion at a point, which converges later than
   !> integrals of it do.
   elemental real(dp) function at_point(decay)
      real(dp), intent(in) :: decay   !! of the misfit, <= 1

      at_point = max(decay, fastest_decay_at_point)
   end function at_point

end module wavycon_error_estimate
