!> The result of collocation fitted to the edge for one load.
module wavycon_fitted_answer
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: quantities
   implicit none (type, external)
   private

   public :: fitted_answer

   !> Statuses of a solution.
   integer, parameter, public :: fitted_solved = 0
      !! The estimated errors are within the accuracy.
   integer, parameter, public :: fitted_less_exact = 1
      !! There is a solution; its estimated errors are larger than the accuracy.
   integer, parameter, public :: fitted_merged = 2
      !! Neither separate spots nor separate pools were found: only load and status are set.
   integer, parameter, public :: fitted_bad_input = 3
      !! The load is not between 0 and the closing pressure, or the accuracy is not > 0: only load and status are set.
   integer, parameter, public :: fitted_failed = 4
      !! No solution was found: only load and status are set.

   !> Expansions of lower degrees that are kept at most.
   integer, parameter, public :: most_previous = 2

   !> The quantities that it has are mean gap, area fraction, peak pressure, energy, here half the integral of p u per
   !> cell, [Delta s^2], perimeter and degree. Lengths in the cell's shorter side s, pressures in pi E* Delta/s, gaps
   !> and displacements in Delta.
   type, extends(quantities) :: fitted_answer
      integer :: status = fitted_failed
      real(dp) :: pbar_over_pstar = 0.0_dp            !! P, given or, with adhesion, found
      real(dp) :: load_error = 0.0_dp                 !! of a load that is found
      real(dp) :: area_slopes(2) = 0.0_dp
         !! with adhesion: dP and d(approach) over d(area of the spot or pool) [pi E* Delta/s^3, Delta/s^2]
      real(dp) :: area_slope_errors(2) = 0.0_dp       !! of area_slopes
      real(dp), allocatable :: area_change(:)         !! the same of all unknowns of the solution, README.md (F70)
      real(dp) :: residual = huge(1.0_dp)             !! largest of the equations [Delta], a pool's [p*]
      real(dp) :: misfit_decay(2) = 1.0_dp            !! chi_n and chi_(n-1) of README.md (F43)
      real(dp) :: merging_ratio = 0.0_dp              !! of the shape: 0 for a point, 1 where neighbours touch
      integer :: iterations = 0                       !! Gauss-Newton steps of all degrees
      logical :: pool = .false.                     !! above merging: the expansion is a pool's gap
      type(expansion) :: solution
      !> Solutions of the lower degrees that the estimates are from, the last one first, shape (1..most_previous).
      type(expansion), allocatable :: previous(:)
   end type fitted_answer

end module wavycon_fitted_answer
