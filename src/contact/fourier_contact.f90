!> Contact with the pressure as a Fourier series: Johnson, Greenwood & Higginson (1985), by Beale's method.
module wavycon_fourier_contact
   use wavycon_beale, only: beale_solver
   use wavycon_complementary_energy, only: energy_problem
   use wavycon_contact_measures, only: measure_series, measuring_intervals
   use wavycon_contact_solver, only: contact_solver, settle_without_solver
   use wavycon_contact_state, only: contact_state, full_contact, no_load
   use wavycon_cosine_series, only: cosine_series
   use wavycon_edge_curves, only: edge_curve, strip_ends, trace_edges
   use wavycon_fourier_terms, only: choose_terms, fourier_terms
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: line_zeros
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_status_name
   implicit none (type, external)
   private

   public :: fourier_contact

   !> Beale's method starts at this load, or at the load itself if that is higher, and the dual pass goes down from
   !> there. Few constraints are active so close to full contact, and the pass costs less than Beale's way from x = 0
   !> at a light load, along which neighbouring points near the troughs make nearly dependent sets.
   real(dp), parameter :: starting_load = 0.9_dp

   type, extends(contact_solver) :: fourier_contact
      type(fourier_terms) :: terms
      type(qp_problem) :: problem                      !! at zero load
      real(dp) :: edge_level = 0.1_dp                  !! isobar taken as the edge of contact, over p*
      type(beale_solver), private :: solver
      real(dp), private :: last_load = -1.0_dp         !! that `solver` holds the answer of; negative: none
   contains
      procedure :: start
      procedure :: solve
      procedure :: solve_series
      procedure :: pressure
      procedure :: displacement
      procedure :: edge_curves
      procedure :: describe
   end type fourier_contact

contains

   !> Chooses the terms of the series and the points of the constraints.
   subroutine start(self, dimension, harmonics, constraint_points, symmetry, edge_level)
      class(fourier_contact), intent(out) :: self
      integer, intent(in) :: dimension           !! 1 or 2
      integer, intent(in) :: harmonics           !! n >= 1
      integer, intent(in) :: constraint_points   !! on [0, pi] in each direction, >= 2
      integer, intent(in) :: symmetry            !! one of the names of wavycon_fourier_terms
      real(dp), intent(in), optional :: edge_level   !! isobar taken as the edge of contact, over p*; 0.1 if absent

      if (present(edge_level)) self%edge_level = edge_level
      self%terms = choose_terms(dimension, harmonics, symmetry)
      self%problem = energy_problem(self%terms, constraint_points, symmetry)
   end subroutine start

   !> Solves for one load and measures it. Whatever happens the state has a status.
   subroutine solve(self, pbar_over_pstar, state)
      class(fourier_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! P
      type(contact_state), intent(out) :: state

      logical :: settled

      call settle_without_solver(pbar_over_pstar, state, settled)
      if (.not. settled) then
         call self%solve_series(pbar_over_pstar, state)
         call measure_series(self%pressure(state), self%displacement(state), self%edge_level, state%measures)
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
      state%kkt_residual = solution%kkt_residual
      if (.not. allocated(solution%x)) return
      state%x = solution%x
      state%active_constraints = size(solution%active)
   end subroutine solve_series

   !> p/p* of a state as a series.
   function pressure(self, state) result(field)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      call self%terms%coefficients(state%x, field%c)
      field%c(0, 0) = state%pbar_over_pstar
   end function pressure

   !> (u - ubar)/Delta of a state as a series: eqs. (13), (A10).
   function displacement(self, state) result(field)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      integer :: k

      call self%terms%coefficients([(self%terms%compliance(k)*state%x(k), k=1, self%terms%count())], field%c)
   end function displacement

   !> The isobar p = edge_level p*.
   subroutine edge_curves(self, state, curves)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      type(cosine_series) :: pressure
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)

      if (state%status == full_contact .or. state%status == no_load) then
         allocate (curves(0))
         return
      end if
      pressure = self%pressure(state)
      if (self%terms%dimension == 2) then
         call start_isobar_grid(grid, pressure, self%edge_level, measuring_intervals(self%terms%harmonics))
         call trace_edges(grid, curves)
      else
         pressure%c(0, 0) = pressure%c(0, 0) - self%edge_level
         call line_zeros(pressure%c(:, 0), measuring_intervals(self%terms%harmonics), zeros)
         call strip_ends(zeros, sum(pressure%c) >= 0.0_dp, curves)
      end if
   end subroutine edge_curves

   pure function describe(self) result(words)
      class(fourier_contact), intent(in) :: self
      character(:), allocatable :: words

      character(120) :: line

      write (line, '(3(i0, a))') self%terms%harmonics, ' harmonics (', self%terms%count(), ' unknowns), ', &
         size(self%problem%bounds), ' constraint points'
      words = trim(line)
   end function describe

end module wavycon_fourier_contact
