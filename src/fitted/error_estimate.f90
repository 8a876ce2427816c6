!> Estimates of the errors of values from expansions of rising degree.
module wavycon_error_estimate
   use wavycon_fitted_tuning, only: error_safety, first_error_factor, least_relative_share, previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: error_estimate

contains

   !> Errors of values from those of the lower degrees: README.md (F43) and, but for its last term, (F44).
   !>
   !> A difference of two degrees is about the error of the lower one. That of the higher one is smaller by the decay of
   !> the misfit, which is measured at all points of collocation and is hardly ever small by chance, as differences of
   !> single values are. The difference before, carried on by the decays since, is a lower limit for the same reason.
   !> Other limits are rounding and a share of the values' largest relative error: integrals such as the mean gap
   !> converge faster than the shape, but not by much.
   !>
   !> N.B. These are estimates, no bounds. They hold for thousands of loads; those of the perimeter of a rhombic
   !> lattice's spots are too small now and then.
   pure function error_estimate(values, decay, scale) result(error)
      real(dp), intent(in) :: values(:, 0:)   !! at the last two or three degrees, the highest one first, shape (n, 0:.)
      real(dp), intent(in) :: decay(2)        !! r_n and r_(n-1) <= 1, of the misfit
      real(dp), intent(in) :: scale(:)        !! > 0, what rounding and shares are relative to, shape (n)
      real(dp) :: error(size(scale))

      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)   !! relative

      if (ubound(values, 2) == 1) then
         error = first_error_factor*decay(1)*abs(values(:, 0) - values(:, 1))
      else
         error = decay(1)*max(abs(values(:, 0) - values(:, 1)), &
                              previous_difference_share*decay(2)*abs(values(:, 1) - values(:, 2)))
      end if
      error = max(error_safety*error, rounding*scale)
      error = max(error, least_relative_share*scale*maxval(error/scale))
   end function error_estimate

end module wavycon_error_estimate
