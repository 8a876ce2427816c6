!> Tuned constants of the curve of adhesive contacts: numbers that no theory gives, each with its reason. README.md,
!> section 5, has what half and twice each value does (scripts/constants).
module wavycon_beyond_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   !> Largest step of the radius of a spot or pool: over the radius of a circle as large as its cell, and over the
   !> radius itself.
   real(dp), parameter, public :: radius_step = 0.025_dp
   real(dp), parameter, public :: radius_growth = 0.2_dp
   !> Largest growth of the merging ratio (1 where spots touch) in a step, over 1 less the ratio. With 0.2 the last
   !> extreme of the pools of the square wave with w' = 0.05 is lost at the accuracy 1e-3.
   real(dp), parameter, public :: ratio_growth = 0.12_dp
   !> The first radius over that of pull-off of a spot, or of the largest load of a pool. The curve starts before both.
   real(dp), parameter, public :: first_over_critical = 0.4_dp
   !> The branch ends where the approach falls at a merging ratio above this. The last extremes are at 0.83 and more.
   real(dp), parameter, public :: ratio_of_extremes = 0.6_dp
   !> The branch also ends if there is no solution even after a step of this part of the largest step.
   real(dp), parameter, public :: least_step = 0.02_dp
   !> Largest error of a point over the accuracy. Near the end of a branch points are less accurate than asked for.
   real(dp), parameter, public :: worst_error = 10.0_dp
   !> Factor on the accuracy of a point at which the sign of the slope is not sure.
   real(dp), parameter, public :: finer_by = 0.2_dp
   !> Largest accuracy that `finer_by` multiplies. With 0.01 the slopes of the last points of pools have no errors at
   !> the accuracy 0.01, and their last extremes are lost.
   real(dp), parameter, public :: sign_accuracy = 1e-3_dp
   !> Step towards the last extreme of the approach, over the distance that is extrapolated from the last slopes.
   real(dp), parameter, public :: beyond_extreme = 1.3_dp

end module wavycon_beyond_tuning
