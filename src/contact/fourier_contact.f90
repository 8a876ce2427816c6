!> Contact with the pressure as a Fourier series: Johnson, Greenwood & Higginson (1985), by Beale's method.
module wavycon_fourier_contact
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_beale, only: beale_solver
   use wavycon_complementary_energy, only: energy_problem
   use wavycon_contact_state, only: contact_state, full_contact, no_load
   use wavycon_cosine_series, only: cosine_series
   use wavycon_fourier_terms, only: choose_terms, fourier_terms
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_not_finite, qp_status_name
   implicit none (type, external)
   private

   public :: fourier_contact

   !> Beale's method starts at this load, or at the load itself if that is higher, and the dual pass goes down from
   !> there. Few constraints are active so close to full contact, and the pass costs less than Beale's way from x = 0
   !> at a light load, along which neighbouring points near the troughs make nearly dependent sets.
   real(dp), parameter :: starting_load = 0.9_dp

   !> A solver for loads that are best given from the highest to the lowest.
   type :: fourier_contact
      type(fourier_terms) :: terms
      type(qp_problem) :: problem                      !! at zero load
      type(beale_solver), private :: solver
      real(dp), private :: last_load = -1.0_dp         !! that `solver` holds the answer of; negative: none
   contains
      procedure :: start
      procedure :: solve
      procedure :: pressure
      procedure :: displacement
   end type fourier_contact

contains

   !> Chooses the terms of the series and the points of the constraints.
   subroutine start(self, dimension, harmonics, constraint_points, symmetry)
      class(fourier_contact), intent(out) :: self
      integer, intent(in) :: dimension           !! 1 or 2
      integer, intent(in) :: harmonics           !! n >= 1
      integer, intent(in) :: constraint_points   !! on [0, pi] in each direction, >= 2
      integer, intent(in) :: symmetry            !! one of the names of wavycon_fourier_terms

      self%terms = choose_terms(dimension, harmonics, symmetry)
      self%problem = energy_problem(self%terms, constraint_points, symmetry)
   end subroutine start

   !> Solves for one load. Whatever happens the state has a status.
   subroutine solve(self, pbar_over_pstar, state)
      class(fourier_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! P >= 0
      type(contact_state), intent(out) :: state

      type(qp_problem) :: problem
      type(qp_solution) :: solution

      state%pbar_over_pstar = pbar_over_pstar
      allocate (state%x(self%terms%count()), source=0.0_dp)
      if (pbar_over_pstar >= 1.0_dp) then
         state%x(self%terms%fundamental()) = 1.0_dp   ! eq. (22)
         state%status = full_contact
         return
      end if
      if (pbar_over_pstar <= 0.0_dp) then
         state%status = no_load
         return
      end if
      if (ieee_is_nan(pbar_over_pstar)) then
         state%status = qp_status_name(qp_not_finite)
         return
      end if

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
   end subroutine solve

   !> p/p* of a state as a series.
   pure type(cosine_series) function pressure(self, state)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state

      call self%terms%coefficients(state%x, pressure%c)
      pressure%c(0, 0) = state%pbar_over_pstar
   end function pressure

   !> (u - ubar)/Delta of a state as a series: eqs. (13), (A10).
   pure type(cosine_series) function displacement(self, state)
      class(fourier_contact), intent(in) :: self
      type(contact_state), intent(in) :: state

      integer :: k

      call self%terms%coefficients([(self%terms%compliance(k)*state%x(k), k=1, self%terms%count())], displacement%c)
   end function displacement

end module wavycon_fourier_contact
