!> solver = 'closed_form': Westergaard's solution of the 1-D wave. Its fields are its Fourier series, truncated.
module wavycon_closed_form_contact
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: closed_form
   use wavycon_contact_tuning, only: field_terms
   use wavycon_fourier_series, only: fourier_series
   use wavycon_dundurs, only: dundurs_coefficients
   use wavycon_edge_curves, only: edge_curve, strip_ends
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov, only: kuznetsov_mean_gap_over_amplitude
   use wavycon_series_solution, only: series_solution
   use wavycon_surface, only: surface_type
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   implicit none (type, external)
   private

   public :: closed_form_contact, closed_form_exists

   character(*), parameter :: solver_name = 'closed_form'

   type, extends(contact_solver) :: closed_form_contact
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: refusal
      procedure :: start_from_keys
      procedure :: describe
      procedure :: start
      procedure :: solve_partial_contact
   end type closed_form_contact

   type, extends(series_solution) :: closed_form_solution
   contains
      procedure :: pressure
      procedure :: edge_curves
   end type closed_form_solution

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = solver_name
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = "Westergaard's solution of the 1-D wave"
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      allocate (rows(0))
   end function keys

   function refusal(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = ''
      if (.not. closed_form_exists(surface)) words = 'is for the 1-D wave'
   end function refusal

   !> Whether a surface is the 1-D wave of the paper.
   pure logical function closed_form_exists(surface)
      type(surface_type), intent(in) :: surface

      closed_form_exists = surface%dimension == 1 .and. surface%is_paper_wave()
   end function closed_form_exists

   subroutine start_from_keys(self, surface, values, keep_fields)
      class(closed_form_contact), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      type(group_values), intent(in) :: values
      logical, intent(in) :: keep_fields

      associate (there_are_none => values, fields_need_no_memory => keep_fields); end associate
      call self%start(surface)
   end subroutine start_from_keys

   !> Starts the solver.
   subroutine start(self, surface)
      class(closed_form_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! the 1-D wave of the paper

      self%surface = surface
   end subroutine start

   !> Westergaard's solution: eqs. (4), (7), and (20) of the paper.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(closed_form_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      class(contact_solution), allocatable, intent(out) :: solution

      associate (unused => self, gap => kuznetsov_mean_gap_over_amplitude(pbar_over_pstar))
         allocate (closed_form_solution :: solution)
         solution%pbar_over_pstar = pbar_over_pstar
         solution%status = closed_form
         solution%solver = solver_name
         solution%measures = contact_measures( &
                             mean_gap_over_amplitude=gap, approach_over_amplitude=1.0_dp - gap, &
                             contact_area_fraction=westergaard_contact_area_fraction(pbar_over_pstar), &
                             peak_pressure_over_pstar=westergaard_peak_pressure_over_pstar(pbar_over_pstar), &
                             min_pressure_over_pstar=0.0_dp)
      end associate
   end subroutine solve_partial_contact

   subroutine pressure(self, series)
      class(closed_form_solution), intent(in) :: self
      type(fourier_series), intent(out) :: series

      allocate (series%c(0:field_terms, 0:0))
      series%c(0, 0) = self%pbar_over_pstar
      series%c(1:, 0) = dundurs_coefficients(self%pbar_over_pstar, field_terms)
   end subroutine pressure

   subroutine edge_curves(self, surface, curves)
      class(closed_form_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)

      associate (unused => surface); end associate
      call strip_ends([pi*self%measures%contact_area_fraction], .true., curves)
   end subroutine edge_curves

   pure function describe(self) result(words)
      class(closed_form_contact), intent(in) :: self
      character(:), allocatable :: words

      associate (unused => self); end associate
      words = "closed form (Westergaard's solution)"
   end function describe

end module wavycon_closed_form_contact
