!> The solver for surfaces with a closed form: the 1-D wave by Westergaard's solution, and a ball with free edges by
!> Hertz's (`ball_source`).
module wavycon_closed_form_contact
   use wavycon_ball_source, only: solve_ball
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, default_accuracy, solver_traits
   use wavycon_contact_contours, only: contact_contour, make_strips
   use wavycon_field_source, only: field_source
   use wavycon_free_edges, only: is_ball
   use wavycon_kinds, only: dp, pi
   use wavycon_paper_wave, only: is_paper_wave
   use wavycon_quantities, only: approach, area_slope, contact_area, elastic_energy, gap_curvature, gap_slope, &
      mean_gap, peak_pressure, quantities
   use wavycon_solution_record, only: by_closed_form, closed_form, no_solution, not_found
   use wavycon_westergaard, only: kuznetsov_mean_gap_over_amplitude, westergaard_contact_area_fraction, &
      westergaard_displacement_over_amplitude, westergaard_gap_over_amplitude, westergaard_peak_pressure_over_pstar, &
      westergaard_pressure_over_pstar
   use wavycon_westergaard_stress, only: westergaard_stress
   use wavycon_stress_fields, only: start_point, stress_fields
   use wavycon_stress_tensor, only: elastic_body
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: closed_form_contact, closed_form_exists, closed_form_source, closed_form_stress_fields

   type, extends(contact_solver) :: closed_form_contact
      real(dp) :: accuracy = default_accuracy   !! of the grids for the stresses below a ball of unequal radii
   contains
      procedure :: start, solve_partial_contact, traits
   end type closed_form_contact

   type, extends(field_source) :: closed_form_source
      !> T >= 0 [p*], the mean tension of adhesion. The contact is as large as that under the load P + T without
      !> adhesion.
      real(dp) :: tension = 0.0_dp
   contains
      procedure :: fields, contact_contours, stresses, derivatives
   end type closed_form_source

   type, extends(contact_fields) :: closed_form_fields
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P + T, the load whose contact without adhesion is as large
      real(dp) :: tension = 0.0_dp            !! T, as in closed_form_source
   contains
      procedure :: at
   end type closed_form_fields

   type, extends(stress_fields) :: closed_form_stress_fields
      real(dp) :: tension = 0.0_dp            !! T, as in closed_form_source; pbar_over_pstar is P
   contains
      procedure :: at => stress_at
      procedure :: start_points
   end type closed_form_stress_fields

contains

   !> Whether a surface is the 1-D wave of the paper without a hardness, or a ball with free edges.
   pure logical function closed_form_exists(surface)
      type(surface_type), intent(in) :: surface

      closed_form_exists = is_ball(surface) .or. &
         (surface%dimension == 1 .and. is_paper_wave(surface) .and. .not. surface%has_hardness())
   end function closed_form_exists

   !> Starts the solver. Afterwards `is_started` tells whether the surface has a closed form.
   subroutine start(self, surface)
      class(closed_form_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! any surface; only a ball may have a hardness

      self%surface = surface
      self%is_started = closed_form_exists(surface)
   end subroutine start

   !> The traits; no load depends on the load before.
   type(solver_traits) function traits(self)
      class(closed_form_contact), intent(in) :: self

      associate (unused => self); end associate
      traits = solver_traits(solver=by_closed_form)
   end function traits

   !> Solves a load by Westergaard's equations, eqs. (4), (7) and (20) of the paper, or by Hertz's for a ball. The
   !> status is not_found if the contact of a ball reaches the border, or its peak pressure the hardness.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(closed_form_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      logical :: solved

      if (is_ball(self%surface)) then
         call solve_ball(self%surface, pbar_over_pstar, self%accuracy, solution, solved)
         if (.not. solved) solution%solution_record = no_solution(pbar_over_pstar, by_closed_form, not_found)
         return
      end if
      allocate (closed_form_source :: solution%source)
      solution%pbar_over_pstar = pbar_over_pstar
      solution%status = closed_form
      solution%solver = by_closed_form
      solution%value(mean_gap) = kuznetsov_mean_gap_over_amplitude(pbar_over_pstar)
      ! 1 - gap, without cancellation at light loads.
      solution%value(approach) = pbar_over_pstar*(1.0_dp - log(pbar_over_pstar))
      solution%value(contact_area) = westergaard_contact_area_fraction(pbar_over_pstar)
      solution%value(peak_pressure) = westergaard_peak_pressure_over_pstar(pbar_over_pstar)
      ! The elastic energy per nominal area [p* Delta] is the integral of P d(approach), -P ln P dP by (20).
      solution%value(elastic_energy) = pbar_over_pstar**2*(0.25_dp - 0.5_dp*log(pbar_over_pstar))
      solution%error(elastic_energy) = 0.0_dp
   end subroutine solve_partial_contact

   !> Makes the fields (`at`) of Westergaard's solution.
   subroutine fields(self, surface, answer)
      class(closed_form_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      associate (unused => surface); end associate
      allocate (answer, source=closed_form_fields(pbar_over_pstar=self%record%pbar_over_pstar + self%tension, &
                                                  tension=self%tension))
   end subroutine fields

   !> Pressure (4) and displacement (5) of the paper, whose angle psi is X/2. With adhesion the fields of a flat punch
   !> under the tension are subtracted: (I22) of src/beyond.
   subroutine at(self, x, y, pressure, displacement, gap)
      class(closed_form_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      real(dp) :: inside, opening

      associate (unused => y); end associate
      pressure = westergaard_pressure_over_pstar(x/2, self%pbar_over_pstar)
      displacement = westergaard_displacement_over_amplitude(x/2, self%pbar_over_pstar)
      gap = westergaard_gap_over_amplitude(x/2, self%pbar_over_pstar)
      if (self%tension <= 0.0_dp) return
      associate (s => abs(sin(x/2)), edge => sqrt(self%pbar_over_pstar))
         inside = (edge - s)*(edge + s)
         if (inside > 0.0_dp) pressure = pressure - self%tension*abs(cos(x/2))/sqrt(inside)
         opening = 2*self%tension*acosh(max(s/edge, 1.0_dp))
      end associate
      gap = gap + opening
      displacement = displacement + opening + self%tension*log(self%pbar_over_pstar)
   end subroutine at

   !> The edge of contact: both ends of the only strip, X = -pi A and pi A, which carries the whole load.
   subroutine contact_contours(self, surface, curves)
      class(closed_form_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)

      associate (unused => surface); end associate
      call make_strips([pi*self%record%value(contact_area)], .true., .true., curves)
      curves%load = 1.0_dp
   end subroutine contact_contours

   !> Makes the stresses (`stress_at`) below Westergaard's pressure.
   subroutine stresses(self, surface, answer)
      class(closed_form_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      associate (unused => surface); end associate
      allocate (answer, source=closed_form_stress_fields(pbar_over_pstar=self%record%pbar_over_pstar, dimension=1, &
                                                         tension=self%tension))
   end subroutine stresses

   !> The stresses below Westergaard's pressure, with adhesion less those of flat punches: (I24) of src/beyond.
   subroutine stress_at(self, x, y, depth, nu_terms, error)
      class(closed_form_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: nu_terms(6, 2)
      real(dp), intent(out), optional :: error

      !> Error of the stresses relative to the peak pressure.
      real(dp), parameter :: rounding = 1e-14_dp
      real(dp) :: load   ! P + T

      associate (unused => y); end associate
      load = self%pbar_over_pstar + self%tension
      call westergaard_stress(x, depth, load, nu_terms, self%tension)
      if (.not. present(error)) return
      error = rounding*westergaard_peak_pressure_over_pstar(load)
      ! Next to the edge the stresses of the tension change with the distance from it.
      if (self%tension > 0.0_dp) error = error + rounding*maxval(abs(nu_terms)) &
         /max(hypot(abs(modulo(x + pi, 2*pi) - pi) - pi*westergaard_contact_area_fraction(load), depth), epsilon(x))
   end subroutine stress_at

   !> Places at which searches for the largest stress start: some across half of the contact and a little beyond it, at
   !> depths from the surface down to 1.2 half widths.
   subroutine start_points(self, body, places)
      class(closed_form_stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)

      !> Distances from the middle of the contact, and depths, over the half width of the contact.
      real(dp), parameter :: across(*) = [0.0_dp, 0.3_dp, 0.6_dp, 0.9_dp, 1.0_dp, 1.1_dp], &
                             below(*) = [0.0_dp, 0.1_dp, 0.2_dp, 0.4_dp, 0.8_dp, 1.2_dp]
      real(dp) :: half_width
      integer :: i, k

      half_width = pi*westergaard_contact_area_fraction(self%pbar_over_pstar)
      places = [((start_point(half_width*[across(i), 0.0_dp, below(k)], 0.5_dp*half_width), i=1, size(across)), &
                 k=1, size(below))]
      call self%set_stresses(body, places)
   end subroutine start_points

   !> Derivatives with respect to the load: of the mean gap (20), and of the area A = 2 psi/pi with P = sin^2 psi (7).
   subroutine derivatives(self, surface, answer)
      class(closed_form_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(quantities), intent(out) :: answer

      associate (unused => surface, record => self%record, p => self%record%pbar_over_pstar)
         answer%value(gap_slope) = log(p)
         answer%value(area_slope) = 1.0_dp/(pi*sqrt(p*(1.0_dp - p)))
         answer%value(gap_curvature) = 1.0_dp/p
         answer%error([gap_slope, area_slope, gap_curvature]) = 0.0_dp
      end associate
   end subroutine derivatives

end module wavycon_closed_form_contact
