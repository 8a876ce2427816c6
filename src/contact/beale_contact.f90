!> The method of Johnson, Greenwood & Higginson (1985). The pressure is a truncated Fourier series
!> whose coefficients minimise the complementary energy, a quadratic programme. Its minimum is found by Goldfarb &
!> Idnani's dual method or, as in the paper, by Beale's.
module wavycon_beale_contact
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_beale, only: beale_solver
   use wavycon_complementary_energy, only: bounds_at, energy_problem
   use wavycon_contact_measures, only: measure_series, measuring_intervals
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: status_of_programme
   use wavycon_contact_tuning, only: lightest_start
   use wavycon_dual_solver, only: dual_solver
   use wavycon_edge_curves, only: edge_curve, strip_ends, trace_edges, turn_curves
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: choose_terms, fourier_terms
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: line_zeros
   use wavycon_qp_problem, only: qp_problem, qp_solution
   use wavycon_series_fields, only: series_fields
   use wavycon_solution_record, only: by_series
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type, turned_paper_wave
   use wavycon_turned_series, only: to_sum_angles
   implicit none (type, external)
   private

   public :: beale_contact, beale_solution

   !> What the solver and its solutions share.
   type :: series_setup
      type(fourier_terms) :: terms
      logical :: turned = .false.                      !! phi and theta are the cell's angles turned by 45 degrees
      real(dp) :: edge_level = 0.1_dp                  !! isobar taken as the edge of contact [p*]
   end type series_setup

   type, extends(contact_solver) :: beale_contact
      type(series_setup) :: setup
      type(qp_problem) :: problem                      !! at zero load
      logical :: by_beale = .false.                    !! whether Beale's method solves each load
      class(dual_solver), allocatable, private :: solver   !! after the first load
   contains
      procedure :: start
      procedure :: solve_partial_contact
      procedure :: solve_series
      procedure :: traits
      procedure :: forget_last_load
   end type beale_contact

   type, extends(contact_solution) :: beale_solution
      real(dp), allocatable :: x(:)                    !! amplitudes of the Fourier terms of (p - pbar)/p*
      !> Means over the cell of gaps where p = 0 and of overlaps where p = H [Delta] (C25), from the multipliers.
      real(dp), private :: open_gap = 0.0_dp, imprint = 0.0_dp
      type(series_setup) :: setup
   contains
      procedure :: fields
      procedure :: edge_curves
      procedure :: stresses
      procedure :: coefficients
   end type beale_solution

contains

   !> Chooses the terms of the series and the points of the constraints.
   subroutine start(self, surface, harmonics, constraint_points, symmetry, edge_level, by_beale)
      class(beale_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface  !! a wave of the paper
      integer, intent(in) :: harmonics           !! n >= 1
      integer, intent(in) :: constraint_points   !! on [0, pi] in each direction, >= 2
      integer, intent(in) :: symmetry            !! one of the names of wavycon_fourier_terms
      real(dp), intent(in), optional :: edge_level   !! isobar taken as the edge of contact [p*]; 0.1 if absent
      logical, intent(in), optional :: by_beale  !! by Beale's method; if absent by the dual method

      if (present(edge_level)) self%setup%edge_level = edge_level
      if (present(by_beale)) self%by_beale = by_beale
      self%surface = surface
      self%is_started = surface%is_paper_wave()
      self%setup%turned = surface%paper_wave() == turned_paper_wave
      self%setup%terms = choose_terms(surface%dimension, harmonics, symmetry)
      self%problem = energy_problem(self%setup%terms, constraint_points, symmetry, surface%has_hardness())
   end subroutine start

   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(beale_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      class(contact_solution), allocatable, intent(out) :: solution

      type(beale_solution), allocatable :: own

      allocate (own)
      call self%solve_series(pbar_over_pstar, own)
      ! Without an imprint no point is at H, although a peak between the points may come close.
      call measure_series(pressure_series(own), displacement_series(own), self%setup%edge_level, own%measures, &
                          merge(self%surface%hardness, huge(1.0_dp), own%imprint > 0.0_dp))
      ! The crest, from which the approach follows otherwise, is then not in elastic contact.
      if (own%imprint > 0.0_dp) then
         own%measures%mean_gap_over_amplitude = own%open_gap
         own%measures%approach_over_amplitude = 1.0_dp - own%open_gap + own%imprint
      end if
      call move_alloc(own, solution)
   end subroutine solve_partial_contact

   !> Solves the quadratic programme (17), (18) or (26), (27) of the paper, with p <= H where the surface has a
   !> hardness, without measuring the solution.
   subroutine solve_series(self, pbar_over_pstar, solution)
      class(beale_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! 0 < P < 1 or H
      type(beale_solution), intent(out) :: solution !! x = 0 if no minimum was found

      type(qp_problem) :: problem
      type(qp_solution) :: programme
      real(dp) :: start
      logical :: solved

      solution%setup = self%setup
      solution%pbar_over_pstar = pbar_over_pstar
      allocate (solution%x(self%setup%terms%count()), source=0.0_dp)
      solved = .false.
      if (self%by_beale .or. .not. allocated(self%solver)) then
         if (allocated(self%solver)) deallocate (self%solver)
         problem = self%problem
         if (self%by_beale) then
            allocate (beale_solver :: self%solver)
            start = pbar_over_pstar
         else
            allocate (dual_solver :: self%solver)
            start = max(pbar_over_pstar, min(lightest_start, 0.5_dp*self%surface%hardness))
         end if
         problem%bounds = bounds_at(problem, start, self%surface%hardness)
         call self%solver%solve(problem, programme)
         solution%iterations = programme%pivots
         solved = pbar_over_pstar >= start .or. .not. allocated(programme%x)
      end if
      if (.not. solved) then
         call self%solver%pass_to(bounds_at(self%problem, pbar_over_pstar, self%surface%hardness), programme)
         solution%iterations = solution%iterations + programme%pivots
      end if
      if (.not. allocated(programme%x)) deallocate (self%solver)

      solution%status = status_of_programme(programme%status)
      solution%solver = by_series
      solution%residual = programme%kkt_residual
      if (.not. allocated(programme%x)) return
      solution%x = programme%x
      solution%active_constraints = size(programme%active)
      if (.not. self%surface%has_hardness()) return
      ! The energy per area is P plus the programme's objective times the mean square of the surface's wave.
      associate (at_hardness => programme%active > size(self%problem%bounds)/2, &
                 gaps => programme%multipliers/2**self%surface%dimension)
         solution%open_gap = sum(gaps, .not. at_hardness)
         solution%imprint = sum(gaps, at_hardness)
      end associate
   end subroutine solve_series

   type(solver_traits) function traits(self)
      class(beale_contact), intent(in) :: self

      traits = solver_traits(solver=by_series, has_errors=.false., has_coefficients=.true., &
                             continues_last_load=.not. self%by_beale)
   end function traits

   subroutine forget_last_load(self)
      class(beale_contact), intent(inout) :: self

      if (allocated(self%solver)) deallocate (self%solver)
   end subroutine forget_last_load

   !> p/p* as a series in phi and theta.
   type(fourier_series) function pressure_series(solution) result(series)
      type(beale_solution), intent(in) :: solution

      call solution%setup%terms%coefficients(solution%x, series%c)
      series%c(0, 0) = solution%pbar_over_pstar
   end function pressure_series

   !> (u - ubar)/Delta as a series in phi and theta: eqs. (13), (A10).
   type(fourier_series) function displacement_series(solution) result(series)
      type(beale_solution), intent(in) :: solution

      integer :: k

      associate (terms => solution%setup%terms)
         call terms%coefficients([(terms%compliance(k)*solution%x(k), k=1, terms%count())], series%c)
      end associate
   end function displacement_series

   subroutine fields(self, surface, answer)
      class(beale_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(series_fields), allocatable :: own

      allocate (own)
      call self%coefficients(surface, own%pressure)
      own%displacement = surface%displacement_of(own%pressure)
      own%shape = surface%shape
      own%mean_gap = 1.0_dp - self%measures%approach_over_amplitude
      call move_alloc(own, answer)
   end subroutine fields

   !> The error of a truncated series is not estimated.
   subroutine stresses(self, surface, answer)
      class(beale_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: pressure
      type(series_stress), allocatable :: own

      call self%coefficients(surface, pressure)
      allocate (own)
      call start_series_stress(own, surface, pressure, self%pbar_over_pstar, &
                               pressure_error=ieee_value(1.0_dp, ieee_quiet_nan), is_sampled=.false.)
      call move_alloc(own, answer)
   end subroutine stresses

   subroutine coefficients(self, surface, series)
      class(beale_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(out) :: series

      associate (unused => surface); end associate
      series = pressure_series(self)
      if (self%setup%turned) series = to_sum_angles(series)
   end subroutine coefficients

   !> The isobar p = edge_level p*.
   subroutine edge_curves(self, surface, curves, loads)
      class(beale_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out), optional :: loads(:)

      type(fourier_series) :: series
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)

      series = pressure_series(self)
      associate (level => self%setup%edge_level, harmonics => self%setup%terms%harmonics)
         if (surface%dimension == 2) then
            call start_isobar_grid(grid, series, level, measuring_intervals(harmonics))
            if (self%setup%turned) then
               ! A period of phi and theta is two cells.
               call trace_edges(grid, curves, cell=grid%period/[1, 2], skew=grid%period(1)/2)
               call turn_curves(curves, factor=1.0_dp)
            else
               call trace_edges(grid, curves)
            end if
         else
            series%c(0, 0) = series%c(0, 0) - level
            call line_zeros(series%c(:, 0), measuring_intervals(harmonics), zeros)
            call strip_ends(zeros, sum(series%c) >= 0.0_dp, curves)
         end if
         ! The part outside the isobar is not known.
         if (present(loads)) allocate (loads(0))
      end associate
   end subroutine edge_curves

end module wavycon_beale_contact
