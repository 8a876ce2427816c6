!> Contact with the pressure as a Fourier series: Johnson, Greenwood & Higginson (1985), by Beale's method.
module wavycon_fourier_contact
   use wavycon_beale, only: beale_solver
   use wavycon_complementary_energy, only: energy_problem
   use wavycon_contact_measures, only: measure_series, measuring_intervals
   use wavycon_contact_state, only: by_beale, contact_state, full_contact
   use wavycon_fourier_series, only: fourier_series
   use wavycon_edge_curves, only: edge_curve, strip_ends, trace_edges, turn_curves
   use wavycon_fourier_terms, only: choose_terms, fourier_terms
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: line_zeros
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_status_name
   use wavycon_series_contact, only: series_contact
   use wavycon_surface, only: surface_type, turned_paper_wave
   use wavycon_turned_series, only: to_sum_angles
   implicit none (type, external)
   private

   public :: fourier_contact

   !> Beale's method starts at this load, or at the load itself if that is higher, and the dual pass goes down from
   !> there. Few constraints are active so close to full contact, and the pass costs less than Beale's way from
   !> x = 0 at a light load, along which neighbouring points near the troughs make nearly dependent sets.
   real(dp), parameter :: starting_load = 0.9_dp

   type, extends(series_contact) :: fourier_contact
      type(fourier_terms) :: terms
      logical :: turned = .false.                      !! phi and theta, the series' angles, against the cell's
      type(qp_problem) :: problem                      !! at zero load
      real(dp) :: edge_level = 0.1_dp                  !! isobar taken as the edge of contact, over p*
      type(beale_solver), private :: solver
      real(dp), private :: last_load = -1.0_dp         !! that `solver` holds the answer of; negative: none
   contains
      procedure :: start
      procedure :: solve
      procedure :: solve_series
      procedure :: solved_pressure
      procedure :: solved_edge_curves
      procedure :: describe
   end type fourier_contact

contains

   !> Chooses the terms of the series and the points of the constraints.
   subroutine start(self, surface, harmonics, constraint_points, symmetry, edge_level)
      class(fourier_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface  !! a wave of the paper
      integer, intent(in) :: harmonics           !! n >= 1
      integer, intent(in) :: constraint_points   !! on [0, pi] in each direction, >= 2
      integer, intent(in) :: symmetry            !! one of the names of wavycon_fourier_terms
      real(dp), intent(in), optional :: edge_level   !! isobar taken as the edge of contact, over p*; 0.1 if absent

      if (present(edge_level)) self%edge_level = edge_level
      self%surface = surface
      self%turned = surface%paper_wave() == turned_paper_wave
      self%terms = choose_terms(surface%dimension, harmonics, symmetry)
      self%problem = energy_problem(self%terms, constraint_points, symmetry)
   end subroutine start

   !> Solves for one load and measures it. Whatever happens the state has a status.
   subroutine solve(self, pbar_over_pstar, state)
      class(fourier_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! P
      type(contact_state), intent(out) :: state

      logical :: settled

      call self%settle(pbar_over_pstar, state, settled)
      if (.not. settled) then
         call self%solve_series(pbar_over_pstar, state)
         call measure_series(series_of(self, state), displacement_series(self, state), self%edge_level, &
                             state%measures)
         return
      end if
      allocate (state%x(self%terms%count()), source=0.0_dp)
      if (state%status == full_contact) state%x(self%terms%fundamental()) = 1.0_dp   ! eq. (22)
   end subroutine solve

   !> Solves for the series alone.
   subroutine solve_series(self, pbar_over_pstar, state)
      class(fourier_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! 0 < P < 1
      type(contact_state), intent(out) :: state

      type(qp_problem) :: problem
      type(qp_solution) :: solution

      state%pbar_over_pstar = pbar_over_pstar
      allocate (state%x(self%terms%count()), source=0.0_dp)
      if (self%last_load < pbar_over_pstar) then
         problem = self%problem
         self%last_load = max(starting_load, pbar_over_pstar)
         problem%bounds = -self%last_load
         call self%solver%solve(problem, solution)
         state%pivots = solution%pivots
      end if
      if (pbar_over_pstar < self%last_load .or. .not. allocated(solution%x)) then
         call self%solver%pass_to(self%problem%bounds - pbar_over_pstar, solution)
         self%last_load = pbar_over_pstar
         state%pivots = state%pivots + solution%pivots
      end if

      state%status = qp_status_name(solution%status)
      state%solver = by_beale
      state%kkt_residual = solution%kkt_residual
      if (.not. allocated(solution%x)) return
      state%x = solution%x
      state%active_constraints = size(solution%active)
   end subroutine solve_series

   !> p/p* of a state as a series in phi and theta.
   type(fourier_series) function series_of(self, state) result(series)
      type(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state

      call self%terms%coefficients(state%x, series%c)
      series%c(0, 0) = state%pbar_over_pstar
   end function series_of

   !> (u - ubar)/Delta of a state, likewise: eqs. (13), (A10).
   type(fourier_series) function displacement_series(self, state) result(series)
      type(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state

      integer :: k

      call self%terms%coefficients([(self%terms%compliance(k)*state%x(k), k=1, self%terms%count())], series%c)
   end function displacement_series

   function solved_pressure(self, state) result(field)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(fourier_series) :: field

      field = series_of(self, state)
      if (self%turned) field = to_sum_angles(field)
   end function solved_pressure

   !> The isobar p = edge_level p*.
   subroutine solved_edge_curves(self, state, curves)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      type(fourier_series) :: series
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)

      series = series_of(self, state)
      if (self%terms%dimension == 2) then
         call start_isobar_grid(grid, series, self%edge_level, measuring_intervals(self%terms%harmonics))
         call trace_edges(grid, curves)
         if (self%turned) call turn_curves(curves, factor=1.0_dp)
      else
         series%c(0, 0) = series%c(0, 0) - self%edge_level
         call line_zeros(series%c(:, 0), measuring_intervals(self%terms%harmonics), zeros)
         call strip_ends(zeros, sum(series%c) >= 0.0_dp, curves)
      end if
   end subroutine solved_edge_curves

   pure function describe(self) result(words)
      class(fourier_contact), intent(in) :: self
      character(:), allocatable :: words

      character(120) :: line

      write (line, '(3(i0, a))') self%terms%harmonics, ' harmonics (', self%terms%count(), ' unknowns), ', &
         size(self%problem%bounds), ' constraint points'
      words = trim(line)
   end function describe

end module wavycon_fourier_contact
