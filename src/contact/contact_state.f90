!> The answer at one load.
module wavycon_contact_state
   use wavycon_contact_measures, only: contact_measures
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_state

   !> The statuses of good answers: of an optimiser, and those that need none.
   character(*), parameter, public :: converged = 'converged', full_contact = 'full_contact', no_load = 'no_load', &
                                      closed_form = 'closed_form'
   !> The load is no number; the error estimate is larger than was asked for; the solver has no answer, as that of
   !> fitted expansions where spots of a lattice have merged.
   character(*), parameter, public :: not_finite = 'not_finite', not_accurate = 'not_accurate', &
      not_found = 'not_found'

   !> There is not the memory for a grid as fine as was asked for; the numbers, if any, are those of a coarser one.
   character(*), parameter, public :: no_memory = 'no_memory'

   !> Which solver an answer is from.
   character(*), parameter, public :: by_beale = 'beale', by_closed_form = 'closed_form', by_fitted = 'fitted', &
                                      by_grid = 'grid'

   type :: contact_state
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      type(contact_measures) :: measures
      real(dp), allocatable :: x(:)           !! amplitudes of the Fourier terms of (p - pbar)/p*, of a series
      type(grid_edge), allocatable :: edge    !! pressure and gap on the points of a grid, of a solution there
      type(fitted_answer), allocatable :: fitted   !! of an expansion
      character(12) :: solver = 'none'        !! one of the above; 'none' if none was needed
      integer :: active_constraints = 0       !! points at which the pressure is held at zero
      integer :: pivots = 0                   !! exchanges of variables since the load before; iterations on grids
      real(dp) :: kkt_residual = 0.0_dp       !! relative
      character(16) :: status = ''            !! one of the above, or why it is not good
   contains
      procedure :: is_good
   end type contact_state

contains

   !> Whether the numbers can be relied on.
   elemental logical function is_good(self)
      class(contact_state), intent(in) :: self

      is_good = self%status == full_contact .or. self%status == no_load .or. self%status == converged .or. &
                self%status == closed_form
   end function is_good

end module wavycon_contact_state
