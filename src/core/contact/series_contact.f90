!> The solvers 'beale' and 'series': the method of Johnson, Greenwood & Higginson (1985). The pressure is a truncated
!> Fourier series whose amplitudes minimise the complementary energy; the pressure is constrained to p >= 0 at given
!> points. This is a quadratic programme. 'beale' solves it by Beale's method, as the paper does, and 'series' by
!> the dual method of Goldfarb & Idnani, which is faster with many harmonics.
module wavycon_series_contact
   use wavycon_assertion, only: assert
   use wavycon_beale, only: solve_by_beale
   use wavycon_complementary_energy, only: bounds_at, energy_problem
   use wavycon_contact_contours, only: contact_contour, make_strips, rotate_contours, trace_edges
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: measure_series, measuring_intervals
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_tuning, only: lightest_start, most_points_to_continue
   use wavycon_dual_solver, only: dual_solver
   use wavycon_field_source, only: field_source
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_full
   use wavycon_full_contact, only: displacement_of
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_line_zeros, only: line_zeros
   use wavycon_paper_wave, only: is_paper_wave, paper_wave, rotated_paper_wave
   use wavycon_qp_problem, only: qp_problem, qp_solution
   use wavycon_quantities, only: approach, elastic_energy, gap_slope, mean_gap, peak_pressure, quantities
   use wavycon_rotated_series, only: in_other_angles, to_sum_angles
   use wavycon_series_fields, only: series_fields
   use wavycon_series_stress_fields, only: series_stress_fields, start_series_stress_fields
   use wavycon_solution_record, only: by_beale, by_series, status_of_programme
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: paper_constraint_points, paper_errors, paper_harmonics, qp_options, series_contact, series_source

   !> Harmonics of the paper's series, for 1-D and 2-D waves.
   integer, parameter :: paper_harmonics(2) = [10, 9]

   !> Upper limits of the errors of mean gap [Delta], contact area fraction and peak pressure [p*], with the harmonics
   !> and constraint points of the paper, at loads from 0.05 to 0.9 p*. At loads 0.001 p* apart the largest errors were
   !> 0.0218, 0.0276 and 0.128 for the 1-D wave, and 0.0244, 0.0306 and 0.103 for the 2-D wave. At lighter loads the
   !> errors reach 0.056 in the mean gap and 0.26 in the peak pressure, at heavier loads 0.09 in the area.
   real(dp), parameter :: paper_errors(3) = [0.025_dp, 0.031_dp, 0.13_dp]

   type :: qp_options
      integer :: harmonics = paper_harmonics(2)    !! n >= 1
      integer :: constraint_points = 27            !! number of points on [0, pi] in each direction, >= 2
      integer :: symmetry = symmetry_full          !! symmetry of the series, a name of wavycon_fourier_terms
      real(dp) :: edge_level = 0.1_dp              !! pressure of the isobar that is taken as the edge [p*], > 0
      logical :: uses_beale = .true.               !! whether Beale's method is used, otherwise the dual method
   end type qp_options

   !> The source of fields, edge and stresses of a pressure that is a truncated Fourier series.
   type, extends(field_source) :: series_source
      type(qp_options) :: options
      type(fourier_terms) :: terms
      !> Whether the axes of the series are rotated by 45 degrees: X = phi + theta, Y = phi - theta. Otherwise X = phi
      !> and Y = theta.
      logical :: rotated = .false.
      real(dp), allocatable :: x(:)        !! amplitudes of the terms of the series of (p - pbar)/p*
   contains
      procedure :: pressure, displacement, fields, contact_contours, stresses, coefficients, derivatives
   end type series_source

   type, extends(contact_solver) :: series_contact
      type(series_source) :: series                     !! options and terms of the series, without amplitudes
      type(qp_problem) :: problem                       !! the programme, with the bounds of some load
      integer, private :: solver = by_beale             !! by_beale or by_series, for the records of solutions
      type(dual_solver), allocatable, private :: dual   !! state of the dual method; not allocated before the first load
   contains
      procedure :: start, solve_partial_contact, solve_programme, traits, forget_last_load
   end type series_contact

contains

   !> The number of constraint points that is in the paper's proportion to the harmonics: 27 points for 9 harmonics of
   !> the 2-D wave, 26 points (25 intervals) for 10 harmonics of the 1-D wave. There are always more points than
   !> harmonics.
   pure integer function paper_constraint_points(dimension, harmonics) result(points)
      integer, intent(in) :: dimension   !! 1 or 2
      integer, intent(in) :: harmonics   !! >= 1

      points = 3*harmonics
      if (dimension == 1) points = (5*harmonics + 1)/2 + 1
   end function paper_constraint_points

   !> Chooses the terms of the series and the points of the constraints. Solutions always keep their fields. Afterwards
   !> `is_started` tells whether the surface is a wave of the paper.
   subroutine start(self, surface, options)
      class(series_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      type(qp_options), intent(in) :: options

      call assert(options%harmonics >= 1, 'harmonics >= 1')
      call assert(options%constraint_points >= 2, 'constraint_points >= 2')
      call assert(options%edge_level > 0.0_dp, 'edge_level > 0')
      self%surface = surface
      self%is_started = is_paper_wave(surface)
      self%series%options = options
      if (.not. options%uses_beale) self%solver = by_series
      self%series%rotated = paper_wave(surface) == rotated_paper_wave
      self%series%terms = choose_terms(surface%dimension, options%harmonics, options%symmetry)
      self%problem = energy_problem(self%series%terms, options%constraint_points, options%symmetry, &
                                    surface%has_hardness())
   end subroutine start

   !> Solves a load by the quadratic programme and measures its series. With a hardness mean gap and approach follow
   !> from the multipliers of the constraints (C25) wherever some pressure is at H.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(series_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      type(qp_solution) :: programme
      type(series_source), allocatable :: source
      real(dp) :: largest_pressure, residual_indentation, open_gap

      call self%solve_programme(pbar_over_pstar, programme)
      solution%pbar_over_pstar = pbar_over_pstar
      solution%solver = self%solver
      solution%status = status_of_programme(programme%status)
      solution%iterations = programme%pivots
      solution%residual = programme%kkt_residual
      open_gap = 0.0_dp
      residual_indentation = 0.0_dp
      solution%active_constraints = size(programme%active)
      if (self%surface%has_hardness()) then
         ! (C25). The energy per area is P plus the programme's objective times the mean square of the surface's wave,
         ! which is 2^-D; so the multipliers times 2^-D are gaps times the points' parts of the cell.
         associate (at_hardness => programme%active > size(self%problem%bounds)/2, &
                    gaps => programme%multipliers/2**self%surface%dimension)
            open_gap = sum(gaps, .not. at_hardness)
            residual_indentation = sum(gaps, at_hardness)
         end associate
      end if
      allocate (source, source=self%series)
      call move_alloc(programme%x, source%x)
      ! Without residual indentation no pressure is at H, although a peak between the points may come close to H.
      largest_pressure = huge(largest_pressure)
      if (residual_indentation > 0.0_dp) largest_pressure = self%surface%hardness
      call measure_series(source%pressure(pbar_over_pstar), source%displacement(), source%options%edge_level, &
                          solution%quantities, largest_pressure)
      associate (x => source%x, n => self%surface%dimension)
         ! The programme's energy is in units of the mean square of the surface's wave, 2^-n.
         solution%value(elastic_energy) = 0.5_dp*dot_product(x, self%problem%hessian*x)/2**n
      end associate
      ! `measure_series` takes the displacement at the crest as the approach. With residual indentation the crest is not
      ! in elastic contact.
      if (residual_indentation > 0.0_dp) then
         solution%value(mean_gap) = open_gap
         solution%value(approach) = 1.0_dp - open_gap + residual_indentation
      end if
      call move_alloc(source, solution%source)
   end subroutine solve_partial_contact

   !> Solves the quadratic programme (17), (18) or (26), (27) of the paper, with the further constraints p <= H if the
   !> surface has a hardness. On return programme%x are the amplitudes of the Fourier terms of (p - pbar)/p*, and
   !> programme%pivots counts the exchanges of variables for this load.
   subroutine solve_programme(self, pbar_over_pstar, programme)
      class(series_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! P > 0, below H with a hardness, otherwise below 1
      type(qp_solution), intent(out) :: programme

      real(dp) :: start
      integer :: pivots

      if (self%series%options%uses_beale) then
         self%problem%bounds = bounds_at(self%problem, pbar_over_pstar, self%surface%hardness)
         call solve_by_beale(self%problem, programme)
         return
      end if
      pivots = 0
      start = max(pbar_over_pstar, min(lightest_start, 0.5_dp*self%surface%hardness))
      if (.not. continues(self)) call self%forget_last_load()
      if (.not. allocated(self%dual)) then
         allocate (self%dual)
         self%problem%bounds = bounds_at(self%problem, start, self%surface%hardness)
         call self%dual%solve(self%problem, programme)
         pivots = programme%pivots
         if (pbar_over_pstar >= start) return
      end if
      call self%dual%pass_to(bounds_at(self%problem, pbar_over_pstar, self%surface%hardness), programme)
      programme%pivots = programme%pivots + pivots
   end subroutine solve_programme

   !> Whether a load starts from the active constraints of the last load. If there are only a few more points than
   !> harmonics, two loads have most of the active constraints in common.
   pure logical function continues(self)
      class(series_contact), intent(in) :: self

      associate (options => self%series%options)
         continues = .not. options%uses_beale .and. &
                     options%constraint_points <= most_points_to_continue*options%harmonics
      end associate
   end function continues

   !> The traits. The errors of a truncated series are not estimated.
   type(solver_traits) function traits(self)
      class(series_contact), intent(in) :: self

      traits = solver_traits(solver=self%solver, has_errors=.false., has_coefficients=.true., &
                             continues_last_load=continues(self))
   end function traits

   !> Forgets the last active constraints; the next load starts from none.
   subroutine forget_last_load(self)
      class(series_contact), intent(inout) :: self

      if (allocated(self%dual)) deallocate (self%dual)
   end subroutine forget_last_load

   !> The Fourier series of p/p* in phi and theta.
   type(fourier_series) function pressure(self, pbar_over_pstar) result(series)
      class(series_source), intent(in) :: self
      real(dp), intent(in) :: pbar_over_pstar    !! P

      call self%terms%coefficients(self%x, series%c)
      series%c(0, 0) = pbar_over_pstar
   end function pressure

   !> The Fourier series of (u - ubar)/Delta in phi and theta: eqs. (13), (A10) of the paper.
   type(fourier_series) function displacement(self) result(series)
      class(series_source), intent(in) :: self

      call self%terms%coefficients(self%terms%compliance*self%x, series%c)
   end function displacement

   !> Makes the fields from the series of pressure and displacement.
   subroutine fields(self, surface, answer)
      class(series_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(series_fields), allocatable :: own

      allocate (own)
      call self%coefficients(own%pressure)
      own%displacement = displacement_of(surface, own%pressure)
      own%surface = surface
      own%mean_gap = 1.0_dp - self%record%value(approach)
      call move_alloc(own, answer)
   end subroutine fields

   !> The stresses below the truncated series. Their error is NaN, because that of the series is not estimated.
   subroutine stresses(self, surface, answer)
      class(series_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: series
      type(series_stress_fields), allocatable :: own

      call self%coefficients(series)
      allocate (own)
      call start_series_stress_fields(own, surface, series, self%record%pbar_over_pstar, &
                                      pressure_error=not_a_number(), is_sampled=.false.)
      call move_alloc(own, answer)
   end subroutine stresses

   !> The Fourier series of p/p* in X and Y.
   subroutine coefficients(self, series)
      class(series_source), intent(in) :: self
      type(fourier_series), intent(out) :: series

      series = self%pressure(self%record%pbar_over_pstar)
      if (self%rotated) series = in_other_angles(series, to_sum_angles)
   end subroutine coefficients

   !> The isobar p = edge_level p*, which is taken as the edge of contact.
   subroutine contact_contours(self, surface, curves)
      class(series_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)

      type(fourier_series) :: series
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)

      series = self%pressure(self%record%pbar_over_pstar)
      associate (level => self%options%edge_level, harmonics => self%terms%harmonics)
         if (surface%dimension == 2) then
            call start_isobar_grid(grid, series, level, measuring_intervals(harmonics))
            if (self%rotated) then
               ! A period of phi and theta covers two cells of the surface.
               call trace_edges(grid, curves, cell=grid%period/[1, 2], skew=grid%period(1)/2)
               call rotate_contours(curves, factor=1.0_dp)
            else
               call trace_edges(grid, curves)
            end if
         else
            series%c(0, 0) = series%c(0, 0) - level
            call line_zeros(series%c(:, 0), measuring_intervals(harmonics), zeros)
            call make_strips(zeros, sum(series%c) >= 0.0_dp, .true., curves)
         end if
         ! The load of a spot is not known: some of the pressure lies outside the isobar.
      end associate
   end subroutine contact_contours

   !> The slope of the mean gap at fixed active constraints, from the least energy of a pressure of mean 1 that vanishes
   !> at the points of these constraints: (C30) of README.md in this directory. The slope is unknown with a hardness,
   !> and if the active constraints are linearly dependent. All other derivatives are unknown.
   subroutine derivatives(self, surface, answer)
      class(series_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(quantities), intent(out) :: answer

      !> A constraint is active if the pressure at its point is below this part of the peak pressure: such a pressure is
      !> zero but for rounding.
      real(dp), parameter :: active = 1e-9_dp
      type(qp_problem) :: problem
      type(working_set) :: set
      integer, allocatable :: constraints(:)
      integer :: i
      real(dp), allocatable :: multipliers(:), x(:)

      if (surface%has_hardness()) return
      problem = energy_problem(self%terms, self%options%constraint_points, self%options%symmetry, has_hardness=.false.)
      associate (pressure => self%record%pbar_over_pstar + matmul(self%x, problem%normals), &
                 least => active*self%record%value(peak_pressure))
         constraints = pack([(i, i=1, size(pressure))], pressure < least)
      end associate
      problem%linear = 0.0_dp
      problem%bounds = -1.0_dp
      call set%start(problem)
      call set%assign_active(problem, constraints)
      if (set%count < size(constraints)) return
      allocate (multipliers(set%count), x(size(self%x)))
      call set%solve(problem, x, multipliers)
      ! The programme's energy is in units of the mean square of the surface's wave, 2^-D.
      answer%value(gap_slope) = -sum(problem%hessian*x**2)/2**surface%dimension
   end subroutine derivatives

end module wavycon_series_contact
