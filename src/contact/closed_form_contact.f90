!> The 1-D wave in closed form: Westergaard's solution. Fields are its exact Fourier series, cut far out.
module wavycon_closed_form_contact
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_state, only: by_closed_form, closed_form, contact_state
   use wavycon_fourier_series, only: fourier_series
   use wavycon_dundurs, only: dundurs_coefficients
   use wavycon_edge_curves, only: edge_curve, strip_ends
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov, only: kuznetsov_mean_gap_over_amplitude
   use wavycon_series_contact, only: series_contact
   use wavycon_surface, only: surface_type
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   implicit none (type, external)
   private

   public :: closed_form_contact

   !> Terms of the fields' series. The pressure's fall as the power -3/2: it is then within 1e-5 p* almost
   !> everywhere.
   integer, parameter :: field_terms = 2000

   type, extends(series_contact) :: closed_form_contact
   contains
      procedure :: start
      procedure :: solve
      procedure :: solved_pressure
      procedure :: solved_edge_curves
      procedure :: describe
   end type closed_form_contact

contains

   subroutine start(self, surface)
      class(closed_form_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! the 1-D wave of the paper

      self%surface = surface
   end subroutine start

   subroutine solve(self, pbar_over_pstar, state)
      class(closed_form_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(contact_state), intent(out) :: state

      logical :: settled

      call self%settle(pbar_over_pstar, state, settled)
      if (settled) return
      state%status = closed_form
      state%solver = by_closed_form
      state%measures = contact_measures( &
                       mean_gap_over_amplitude=kuznetsov_mean_gap_over_amplitude(pbar_over_pstar), &
                       approach_over_amplitude=1.0_dp - kuznetsov_mean_gap_over_amplitude(pbar_over_pstar), &
                       contact_area_fraction=westergaard_contact_area_fraction(pbar_over_pstar), &
                       peak_pressure_over_pstar=westergaard_peak_pressure_over_pstar(pbar_over_pstar), &
                       min_pressure_over_pstar=0.0_dp)
   end subroutine solve

   function solved_pressure(self, state) result(field)
      class(closed_form_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(fourier_series) :: field

      associate (unused => self); end associate
      allocate (field%c(0:field_terms, 0:0))
      field%c(0, 0) = state%pbar_over_pstar
      field%c(1:, 0) = dundurs_coefficients(state%pbar_over_pstar, field_terms)
   end function solved_pressure

   subroutine solved_edge_curves(self, state, curves)
      class(closed_form_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      associate (unused => self); end associate
      call strip_ends([pi*state%measures%contact_area_fraction], .true., curves)
   end subroutine solved_edge_curves

   pure function describe(self) result(words)
      class(closed_form_contact), intent(in) :: self
      character(:), allocatable :: words

      associate (unused => self); end associate
      words = "closed form (Westergaard's solution)"
   end function describe

end module wavycon_closed_form_contact
