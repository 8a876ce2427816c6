!> The contact with adhesion, in the limit of Johnson, Kendall & Roberts (JKR), that has a given contact area. Equations
!> (I..) are those of README.md in this directory.
!>
!> The 1-D wave and the round ball have closed forms. Waves on a lattice are solved by fitted functions with a singular
!> edge, on two branches: one of separate contact spots and one of separate pools of gap.
module wavycon_adhesive_contact
   use wavycon_ball_source, only: ball_source
   use wavycon_closed_form_contact, only: closed_form_source
   use wavycon_contact_solution, only: contact_solution
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fitted_solver, only: solve_adhesive
   use wavycon_fitted_source, only: fitted_source
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: approach, contact_area, elastic_energy, is_known, mean_gap, or_nan, &
      scaled, unknown
   use wavycon_solution_record, only: converged, full_contact, no_solution, no_solver, not_accurate, not_found
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: adhesive_point, adhesive_problem, start_adhesive_problem

   !> The kinds of points of the curve of contacts, (I19) and the table of section 4. A contact is stable under a given
   !> load if P rises with the area, and stable at a given approach if the approach does.
   integer, parameter, public :: unstable_point = 0, stable_point = 1, approach_stable = 2, pull_off_point = 3, &
      jump_to_spots = 4, jump_to_pools = 5, jump_to_full = 6, approach_pull_off = 7, approach_jump = 8, &
      end_of_branch = 9, separated = 10, closed = 11, not_solved = 12, jump_to_bands = 13
   character(22), parameter, public :: point_names(0:13) = [character(22) :: 'unstable', 'stable', &
      'stable_by_approach', 'pull_off', 'jump_to_spots', 'jump_to_pools', 'jump_to_full_contact', &
      'pull_off_by_approach', 'jump_by_approach', 'end_of_branch', 'separated', 'full_contact', 'not_solved', &
      'jump_to_bands']

   !> Positions in the component `value` of a point: P [p*], the approach [Delta], and the derivatives of both by the
   !> contact area fraction. The curve searches for points at which one of these has a given value.
   integer, parameter, public :: at_load = 1, at_approach = 2
   integer, parameter :: load_slope = 3, approach_slope = 4

   !> One contact: a point of the curve.
   type :: adhesive_point
      logical :: exists = .false.             !! whether there is a solution
      integer :: kind = unstable_point        !! one of the kinds above
      integer :: number = 0                   !! number of the deck's load that the point belongs to, from 1; 0 if none
      logical :: pools = .false.              !! true: on the branch of separate pools; false: of separate spots
      real(dp) :: area = 0.0_dp               !! contact area fraction
      real(dp) :: area_error = 0.0_dp         !! error estimate of the area fraction
      real(dp) :: value(4) = unknown          !! P, approach, dP/dA, d approach/dA [p*, Delta]
      real(dp) :: slope_error(2) = 0.0_dp     !! error estimates of the two derivatives; unknown if there is none
      real(dp) :: error(2) = unknown          !! error estimates of P [p*] and approach [Delta]
      real(dp) :: energy = unknown            !! elastic energy [p* Delta]: the mean of p u/2
      real(dp) :: energy_error = unknown      !! error estimate of the energy [p* Delta]
      integer :: status = converged           !! a status of wavycon_solution_record
      !> The solution by fitted functions, from which other points start. Only of waves on a lattice.
      type(fitted_answer), allocatable :: answer
   end type adhesive_point

   !> A surface with a work of adhesion.
   type :: adhesive_problem
      type(surface_type) :: surface
      logical :: has_closed_form = .true.   !! true for the 1-D wave and the ball, false for waves on a lattice
      type(fitted_frame) :: frame           !! units and lattice of a wave on a lattice
      real(dp) :: pull = 0.0_dp             !! of a ball: pull-off force F_c over p* A_0, (I17)
      real(dp) :: work = 0.0_dp             !! work of adhesion w' > 0 [p* Delta]
      real(dp) :: accuracy = 0.0_dp         !! largest allowed error of P [p*] and of the approach [Delta], > 0
   contains
      procedure :: find_point
      procedure :: make_solution
   end type adhesive_problem

contains

   !> Prepares the contacts of a surface with a work of adhesion.
   subroutine start_adhesive_problem(problem, surface, work, accuracy)
      type(adhesive_problem), intent(out) :: problem
      type(surface_type), intent(in) :: surface   !! a 1-D wave, a round ball, or a wave on a lattice (find_frame)
      real(dp), intent(in) :: work                !! work of adhesion w' > 0 [p* Delta]
      real(dp), intent(in) :: accuracy            !! largest allowed error of P [p*] and of the approach [Delta], > 0

      problem%surface = surface
      problem%work = work
      problem%accuracy = accuracy
      problem%has_closed_form = is_ball(surface) .or. surface%dimension == 1
      if (.not. problem%has_closed_form) call find_frame(surface, problem%frame)
      if (is_ball(surface)) &
         problem%pull = 1.5_dp*pi*work*surface%amplitude*maxval(ball_radii(surface))/surface%nominal_area()
   end subroutine start_adhesive_problem

   !> Finds the point of a branch with a given contact area. point%exists is .false. if no solution was found.
   subroutine find_point(self, pools, area, point, start, finest)
      class(adhesive_problem), intent(in) :: self
      logical, intent(in) :: pools                          !! the branch: true of pools, false of spots
      real(dp), intent(in) :: area                          !! contact area fraction, 0 < area < 1
      type(adhesive_point), intent(out) :: point
      type(fitted_answer), intent(in), optional :: start    !! solution of another area of the branch, to start from
      real(dp), intent(in), optional :: finest              !! as of solve_adhesive

      point%pools = pools
      point%area = area
      if (is_ball(self%surface)) then
         call find_point_of_ball(self, point)
      else if (self%surface%dimension == 1) then
         call find_point_of_line_wave(self, point)
      else
         call find_point_of_lattice(self, point, start, finest)
      end if
      if (.not. point%exists) return
      if (point%value(approach_slope) > 0.0_dp) point%kind = approach_stable
      if (point%value(load_slope) > 0.0_dp) point%kind = stable_point
      if (.not. maxval(point%error) <= self%accuracy) point%status = not_accurate
   end subroutine find_point

   !> The contact of a round ball, by (I17), (I18). Its load is that of Hertz's contact of the same area, P1, less the
   !> tension T = 2 sqrt(F_c P1).
   subroutine find_point_of_ball(self, point)
      class(adhesive_problem), intent(in) :: self
      type(adhesive_point), intent(inout) :: point   !! on entry with its area

      real(dp) :: delta, p1, tension
      type(hertz_ball) :: contact

      associate (surface => self%surface)
         contact = hertz_contact(ball_radii(surface), 1.0_dp, area=point%area*surface%nominal_area())
         p1 = contact%force/(surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
         delta = contact%approach/surface%amplitude
      end associate
      tension = 2*sqrt(self%pull*p1)
      point%exists = .true.
      ! For the derivatives: P1 is proportional to A^(3/2), T to A^(3/4), and Hertz's approach to A.
      point%value = [p1 - tension, delta*(1.0_dp - 2*tension/(3*p1)), (1.5_dp*p1 - 0.75_dp*tension)/point%area, &
                     delta*(1.0_dp - tension/(6*p1))/point%area]
      point%error = 0.0_dp
      point%energy = delta*(0.4_dp*p1 - 2*tension*(p1 - 0.5_dp*tension)/(3*p1))
      point%energy_error = 0.0_dp
   end subroutine find_point_of_ball

   !> The contact of the 1-D wave, by (I16), (I18), after Johnson (1995). P1 = sin^2 psi, psi = pi A/2, is the load of a
   !> strip of the same width without adhesion.
   subroutine find_point_of_line_wave(self, point)
      class(adhesive_problem), intent(in) :: self
      type(adhesive_point), intent(inout) :: point   !! on entry with its area

      real(dp) :: p1, slope, tension

      associate (s => sin(0.5_dp*pi*point%area), c => cos(0.5_dp*pi*point%area))
         p1 = s**2
         tension = sqrt(2*self%work*s/(pi*c))
         slope = 2*s*c - tension/(2*s*c)
         point%exists = .true.
         point%value(:2) = [p1 - tension, p1 - (p1 - tension)*log(p1)]
         point%value(3:) = 0.5_dp*pi*[slope, 2*s*c - slope*log(p1) - 2*(p1 - tension)*c/s]
         point%energy = 0.25_dp*p1**2 + log(p1)*(tension*(p1 - 0.5_dp*tension) - 0.5_dp*p1**2)
      end associate
      point%error = 0.0_dp
      point%energy_error = 0.0_dp
   end subroutine find_point_of_line_wave

   !> The contact of a wave on a lattice, by fitted functions with a singular edge: src/core/fitted/README.md, section
   !> 15.
   subroutine find_point_of_lattice(self, point, start, finest)
      class(adhesive_problem), intent(in) :: self
      type(adhesive_point), intent(inout) :: point          !! on entry with its area and branch
      type(fitted_answer), intent(in), optional :: start    !! as of find_point
      real(dp), intent(in), optional :: finest              !! as of find_point

      !> The area of the cell of one spot; of one pool minus this, as contact shrinks where a pool grows. The area of
      !> the spot or pool. Both in the lattice's units.
      real(dp) :: cell, area

      allocate (point%answer)
      associate (lattice => self%frame%lattice, unit => self%frame%pressure_unit, answer => point%answer)
         if (point%pools) then
            cell = -lattice%area/lattice%troughs
            area = (point%area - 1.0_dp)*cell
         else
            cell = lattice%area
            area = point%area*cell
         end if
         ! Less accurate points, which may be on the wrong side of an extreme, would be of no use to a curve.
         call solve_adhesive(lattice, point%pools, self%work/unit, area, min(self%accuracy, 1e-2_dp), answer, start, &
                             finest)
         if (answer%status > fitted_less_exact) return
         point%exists = .true.
         point%value = [unit*answer%pbar_over_pstar, answer%value(approach), cell*[unit, 1.0_dp]*answer%area_slopes]
         point%slope_error = scaled(answer%area_slope_errors, abs(cell)*[unit, 1.0_dp])
         point%error = [unit*answer%load_error, answer%error(mean_gap)]
         point%energy = answer%value(elastic_energy)*unit/lattice%area
         point%energy_error = answer%error(elastic_energy)*unit/lattice%area
      end associate
   end subroutine find_point_of_lattice

   !> Makes a contact_solution of a point, with the source of its fields, (I22), and of its edge. Separated bodies and
   !> points without a solution have no fields, and get the status not_found.
   subroutine make_solution(self, point, solution)
      class(adhesive_problem), intent(in) :: self
      type(adhesive_point), intent(in) :: point         !! a point of this problem
      type(contact_solution), intent(out) :: solution   !! has load, area, approach and mean gap

      type(fitted_source), allocatable :: fitted
      type(hertz_ball) :: contact

      associate (surface => self%surface, p => point%value(at_load))
         solution%solution_record = no_solution(or_nan(p), no_solver, not_found)
         if (point%kind == closed .and. is_known(p)) solution%status = full_contact
         if (any(point%kind == [closed, not_solved, separated])) return
         solution%status = point%status
         solution%value([contact_area, approach, mean_gap]) = &
            [point%area, point%value(at_approach), 1.0_dp - point%value(at_approach)]
         if (is_ball(surface)) then
            contact = hertz_contact(ball_radii(surface), 1.0_dp, area=point%area*surface%nominal_area())
            contact%tension = contact%force - p*surface%full_contact_pressure(1.0_dp)*surface%nominal_area()
            contact%approach = point%value(at_approach)*surface%amplitude
            allocate (solution%source, source=ball_source(record=solution%solution_record, contact=contact))
         else if (self%has_closed_form) then
            allocate (solution%source, source=closed_form_source(record=solution%solution_record, &
                                                                 tension=sin(0.5_dp*pi*point%area)**2 - p))
         else
            allocate (fitted)
            fitted%record = solution%solution_record
            fitted%frame = self%frame
            fitted%answer = point%answer
            fitted%accuracy = self%accuracy
            call move_alloc(fitted, solution%source)
         end if
      end associate
   end subroutine make_solution

end module wavycon_adhesive_contact
