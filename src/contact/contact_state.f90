!> The answer at one load.
module wavycon_contact_state
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_state

   !> The status of an answer that needed no optimiser.
   character(*), parameter, public :: full_contact = 'full_contact', no_load = 'no_load'
   !> The status of a good answer of an optimiser.
   character(*), parameter, public :: converged = 'converged'

   type :: contact_state
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      real(dp), allocatable :: x(:)           !! amplitudes of the Fourier terms of (p - pbar)/p*
      integer :: active_constraints = 0       !! points at which the pressure is held at zero
      integer :: pivots = 0                   !! exchanges of variables since the load solved before
      real(dp) :: kkt_residual = 0.0_dp       !! relative
      character(16) :: status = ''            !! one of the above, or why it is not good
   contains
      procedure :: is_good
   end type contact_state

contains

   !> Whether the numbers can be relied on.
   elemental logical function is_good(self)
      class(contact_state), intent(in) :: self

      is_good = self%status == full_contact .or. self%status == no_load .or. self%status == converged
   end function is_good

end module wavycon_contact_state
