!> The 1-D wave in closed form: Westergaard's solution. Fields are its exact Fourier series, cut far out.
module wavycon_closed_form_contact
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_solver, only: contact_solver, settle_without_solver
   use wavycon_contact_state, only: closed_form, contact_state, full_contact
   use wavycon_cosine_series, only: cosine_series
   use wavycon_dundurs, only: dundurs_coefficients
   use wavycon_edge_curves, only: edge_curve, strip_ends
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov, only: kuznetsov_mean_gap_over_amplitude
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   implicit none (type, external)
   private

   public :: closed_form_contact

   !> Terms of the fields' series. The pressure's fall as the power -3/2: it is then within 1e-5 p* almost everywhere.
   integer, parameter :: field_terms = 2000

   type, extends(contact_solver) :: closed_form_contact
   contains
      procedure :: solve
      procedure :: pressure
      procedure :: displacement
      procedure :: edge_curves
      procedure :: describe
   end type closed_form_contact

contains

   subroutine solve(self, pbar_over_pstar, state)
      class(closed_form_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(contact_state), intent(out) :: state

      logical :: settled

      associate (unused => self); end associate
      call settle_without_solver(pbar_over_pstar, state, settled)
      if (settled) return
      state%status = closed_form
      state%measures = contact_measures( &
                       mean_gap_over_amplitude=kuznetsov_mean_gap_over_amplitude(pbar_over_pstar), &
                       approach_over_amplitude=1.0_dp - kuznetsov_mean_gap_over_amplitude(pbar_over_pstar), &
                       contact_area_fraction=westergaard_contact_area_fraction(pbar_over_pstar), &
                       peak_pressure_over_pstar=westergaard_peak_pressure_over_pstar(pbar_over_pstar), &
                       min_pressure_over_pstar=0.0_dp)
   end subroutine solve

   function pressure(self, state) result(field)
      class(closed_form_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      integer :: i

      field = self%displacement(state)
      do i = 1, ubound(field%c, 1)
         field%c(i, 0) = i*field%c(i, 0)
      end do
      field%c(0, 0) = state%pbar_over_pstar
   end function pressure

   function displacement(self, state) result(field)
      class(closed_form_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      integer :: i

      associate (unused => self); end associate
      allocate (field%c(0:field_terms, 0:0), source=0.0_dp)
      if (state%status == full_contact) then
         field%c(1, 0) = 1.0_dp
      else if (state%status == closed_form) then
         field%c(1:, 0) = dundurs_coefficients(state%pbar_over_pstar, field_terms)/[(i, i=1, field_terms)]
      end if
   end function displacement

   subroutine edge_curves(self, state, curves)
      class(closed_form_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      associate (unused => self); end associate
      if (state%status == closed_form) then
         call strip_ends([pi*state%measures%contact_area_fraction], .true., curves)
      else
         allocate (curves(0))
      end if
   end subroutine edge_curves

   pure function describe(self) result(words)
      class(closed_form_contact), intent(in) :: self
      character(:), allocatable :: words

      associate (unused => self); end associate
      words = "closed form (Westergaard's solution)"
   end function describe

end module wavycon_closed_form_contact
