!> What the boundary-fitted solver hands back for one load.
module wavycon_fitted_answer
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: fitted_answer, fitted_status_text

   !> Statuses of a solution.
   integer, parameter, public :: fitted_solved = 0        !! to the accuracy asked for
   integer, parameter, public :: fitted_less_exact = 1    !! all is set; by its estimates less exact
   integer, parameter, public :: fitted_merged = 2        !! neither spots nor islands: nothing is set
   integer, parameter, public :: fitted_bad_input = 3     !! load not between 0 and what closes the troughs, or accuracy not > 0
   integer, parameter, public :: fitted_failed = 4        !! no solution was found: nothing is set

   integer, parameter, public :: expansions_before = 3

   !> Lengths in the cell's shorter side s, pressures in pi E* Delta/s, gaps and displacements in Delta.
   type :: fitted_answer
      integer :: status = fitted_failed
      real(dp) :: pbar_over_pstar = 0.0_dp
      real(dp) :: mean_gap = 0.0_dp             !! G
      real(dp) :: area_fraction = 0.0_dp        !! A_real/A_0
      real(dp) :: peak_pressure = 0.0_dp        !! at a crest
      real(dp) :: energy = 0.0_dp               !! 1/2 integral of p u, per cell [Delta s^2]
      real(dp) :: perimeter = 0.0_dp            !! of a spot or an island
      real(dp) :: mean_gap_error = huge(1.0_dp)       !! estimates of the errors of the above
      real(dp) :: area_error = huge(1.0_dp)
      real(dp) :: peak_error = huge(1.0_dp)
      real(dp) :: energy_error = huge(1.0_dp)
      real(dp) :: perimeter_error = huge(1.0_dp)
      real(dp) :: residual = huge(1.0_dp)       !! largest violation of the equations [Delta], an island's [p*]
      real(dp) :: reach = 0.0_dp                !! of the edge, in half ways to the next spot or island
      integer :: degree = 0                     !! of the polynomials
      integer :: iterations = 0                 !! Gauss-Newton steps of all degrees
      logical :: island = .false.               !! above merging: the expansion is an island's gap
      type(expansion) :: solution
      !> Of the degrees before that the estimates are from, the last one first, shape (1..expansions_before).
      type(expansion), allocatable :: before(:)
   end type fitted_answer

contains

   !> A status in words.
   pure function fitted_status_text(status) result(text)
      integer, intent(in) :: status  !! one of the above
      character(:), allocatable :: text

      select case (status)
      case (fitted_solved)
         text = 'solved'
      case (fitted_less_exact)
         text = 'solved, less exactly than asked for'
      case (fitted_merged)
         text = 'neither separate spots nor separate islands'
      case (fitted_bad_input)
         text = 'load or accuracy out of range'
      case default
         text = 'no solution found'
      end select
   end function fitted_status_text

end module wavycon_fitted_answer
