!> The solution of one load by collocation fitted to the edge.
module wavycon_fitted_answer
   use wavycon_fitted_function, only: fitted_function
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: quantities
   implicit none (type, external)
   private

   public :: fitted_answer

   !> Statuses of a solution.
   integer, parameter, public :: fitted_solved = 0
      !! The estimated errors are within the accuracy.
   integer, parameter, public :: fitted_less_exact = 1
      !! There is a solution, but its estimated errors are larger than the accuracy.
   integer, parameter, public :: fitted_merged = 2
      !! Neither separate spots nor separate pools were found: only load and status have a meaning.
   integer, parameter, public :: fitted_bad_input = 3
      !! The load is not between 0 and the closing pressure, or the accuracy is not > 0: only load and status are set.
   integer, parameter, public :: fitted_failed = 4
      !! No solution was found: only load and status have a meaning.

   !> The largest number of fitted functions of lower degrees that are kept.
   integer, parameter, public :: most_previous = 2

   !> The quantities that are set are mean gap, approach, area fraction, peak pressure, energy, perimeter and degree.
   !> The energy is half the integral of p u over a cell [Delta s^2]. Lengths are in s, pressures in pi E* Delta/s, gaps
   !> and displacements in Delta.
   type, extends(quantities) :: fitted_answer
      integer :: status = fitted_failed               !! one of the statuses above
      real(dp) :: pbar_over_pstar = 0.0_dp            !! mean pressure P: given or, with adhesion, found
      real(dp) :: load_error = 0.0_dp                 !! error estimate of a load that is found
      real(dp) :: area_slopes(2) = 0.0_dp
         !! with adhesion: derivatives of P and approach by the spot's or pool's area [pi E* Delta/s^3, Delta/s^2]
      real(dp) :: area_slope_errors(2) = 0.0_dp       !! estimates of their errors; unknown where there is none
      real(dp), allocatable :: area_change(:)         !! derivatives of all unknowns by the area, README.md (F70)
      real(dp) :: residual = huge(1.0_dp)             !! largest residual [Delta], for a pool [pi E* Delta/s]
      real(dp) :: misfit_decay(2) = 1.0_dp            !! chi_n and chi_(n-1) of README.md (F43)
      real(dp) :: merging_ratio = 0.0_dp              !! merging ratio: 0 for a point, 1 where neighbours touch
      integer :: iterations = 0                       !! number of Gauss-Newton steps of all degrees
      logical :: pool = .false.                       !! true: the solution is a pool's gap; false: a spot's pressure
      type(fitted_function) :: solution
      !> Solutions of lower degrees, from which errors are estimated, the last one first, shape (1..most_previous).
      type(fitted_function), allocatable :: previous(:)
   end type fitted_answer

end module wavycon_fitted_answer
