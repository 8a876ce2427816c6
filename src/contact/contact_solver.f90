!> What all solvers that a user can choose have in common.
module wavycon_contact_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_measures, only: full_contact_measures
   use wavycon_contact_state, only: contact_state, full_contact, no_load, not_finite
   use wavycon_cosine_series, only: cosine_series
   use wavycon_edge_curves, only: edge_curve
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_solver, settle_without_solver

   !> A solver for loads that are best given from the highest to the lowest.
   type, abstract :: contact_solver
   contains
      procedure(solve_load), deferred :: solve
      procedure(field_of_state), deferred :: pressure
      procedure(field_of_state), deferred :: displacement
      procedure(edge_of_state), deferred :: edge_curves
      procedure(words_of_solver), deferred :: describe
   end type contact_solver

   abstract interface
      !> Solves for one load and measures it. Whatever happens the state has a status.
      subroutine solve_load(self, pbar_over_pstar, state)
         import :: contact_solver, contact_state, dp
         class(contact_solver), intent(inout) :: self
         real(dp), intent(in) :: pbar_over_pstar     !! P
         type(contact_state), intent(out) :: state
      end subroutine solve_load

      !> p/p*, or (u - ubar)/Delta, of a state as a series in phi and theta.
      function field_of_state(self, state) result(field)
         import :: contact_solver, contact_state, cosine_series
         class(contact_solver), intent(in) :: self
         type(contact_state), intent(in) :: state
         type(cosine_series) :: field
      end function field_of_state

      !> The edge of contact of a state in phi and theta: closed curves in 2-D, in 1-D the two ends of each strip.
      subroutine edge_of_state(self, state, curves)
         import :: contact_solver, contact_state, edge_curve
         class(contact_solver), intent(in) :: self
         type(contact_state), intent(in) :: state
         type(edge_curve), allocatable, intent(out) :: curves(:)
      end subroutine edge_of_state

      !> The solver and its discretisation, for the log and the heads of tables.
      pure function words_of_solver(self) result(words)
         import :: contact_solver
         class(contact_solver), intent(in) :: self
         character(:), allocatable :: words
      end function words_of_solver
   end interface

contains

   !> Settles the loads that need no solver: none, those from full contact on, and what is no number.
   pure subroutine settle_without_solver(pbar_over_pstar, state, settled)
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_state), intent(inout) :: state
      logical, intent(out) :: settled

      settled = .true.
      state%pbar_over_pstar = pbar_over_pstar
      if (ieee_is_nan(pbar_over_pstar)) then
         state%status = not_finite
      else if (pbar_over_pstar >= 1.0_dp) then
         state%status = full_contact
         state%measures = full_contact_measures(pbar_over_pstar)
      else if (pbar_over_pstar <= 0.0_dp) then
         state%status = no_load
      else
         settled = .false.
      end if
   end subroutine settle_without_solver

end module wavycon_contact_solver
