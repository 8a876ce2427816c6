!> What all solvers that a user can choose have in common.
module wavycon_contact_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_fields, only: contact_fields, series_fields
   use wavycon_contact_measures, only: full_contact_measures
   use wavycon_contact_state, only: contact_state, full_contact, no_load, no_memory, not_finite, not_found
   use wavycon_edge_curves, only: edge_curve
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solver, is_settled

   !> A solver of one surface, for loads that are best given from the highest to the lowest. Fields and edges are in
   !> the angles X, Y of the surface's cell.
   type, abstract :: contact_solver
      type(surface_type) :: surface
   contains
      procedure :: settle
      procedure :: cheaper_levels
      procedure :: use_level
      procedure :: fields
      procedure :: settled_fields
      procedure :: edge_curves
      procedure(solve_load), deferred :: solve
      procedure(fields_of_state), deferred :: solved_fields
      procedure(edge_of_state), deferred :: solved_edge_curves
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

      !> Pressure and displacement of a state between no load and full contact.
      subroutine fields_of_state(self, state, fields)
         import :: contact_fields, contact_solver, contact_state
         class(contact_solver), intent(in) :: self
         type(contact_state), intent(in) :: state
         class(contact_fields), allocatable, intent(out) :: fields
      end subroutine fields_of_state

      !> The edge of contact of such a state: closed curves in 2-D, in 1-D the two ends of each strip.
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
   subroutine settle(self, pbar_over_pstar, state, settled)
      class(contact_solver), intent(in) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_state), intent(inout) :: state
      logical, intent(out) :: settled

      settled = .true.
      state%pbar_over_pstar = pbar_over_pstar
      if (ieee_is_nan(pbar_over_pstar)) then
         state%status = not_finite
      else if (pbar_over_pstar >= 1.0_dp) then
         state%status = full_contact
         state%measures = full_contact_measures(pbar_over_pstar, self%surface%full_contact_peak)
      else if (pbar_over_pstar <= 0.0_dp) then
         state%status = no_load
      else
         settled = .false.
      end if
   end subroutine settle

   !> How many times the loads to come may be solved more cheaply, by those who look for one of them.
   integer function cheaper_levels(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      cheaper_levels = 0
   end function cheaper_levels

   !> Solves the loads to come more cheaply.
   subroutine use_level(self, level)
      class(contact_solver), intent(inout) :: self
      integer, intent(in) :: level   !! 0 for as good as asked for .. `cheaper_levels`

      associate (unused => self, unused_too => level); end associate
   end subroutine use_level

   !> Pressure and displacement of any state.
   subroutine fields(self, state, answer)
      class(contact_solver), intent(in) :: self
      type(contact_state), intent(in) :: state
      class(contact_fields), allocatable, intent(out) :: answer

      if (is_settled(state)) then
         allocate (answer, source=self%settled_fields(state))
      else
         call self%solved_fields(state, answer)
      end if
   end subroutine fields

   !> Those of a state that needed no solver: all closed in full contact, else nothing yet.
   type(series_fields) function settled_fields(self, state) result(both)
      class(contact_solver), intent(in) :: self
      type(contact_state), intent(in) :: state

      if (state%status == full_contact) then
         both%pressure = self%surface%full_contact_series(state%pbar_over_pstar)
         both%displacement = self%surface%shape
      else
         allocate (both%pressure%c, both%displacement%c, mold=self%surface%shape%c)
         both%pressure%c = 0.0_dp
         both%displacement%c = 0.0_dp
      end if
   end function settled_fields

   subroutine edge_curves(self, state, curves)
      class(contact_solver), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      if (is_settled(state)) then
         allocate (curves(0))
      else
         call self%solved_edge_curves(state, curves)
      end if
   end subroutine edge_curves

   !> Whether a state needed no solver, or has nothing from it.
   pure logical function is_settled(state)
      type(contact_state), intent(in) :: state

      is_settled = state%status == full_contact .or. state%status == no_load .or. state%status == not_finite .or. &
                   state%status == not_found .or. (state%status == no_memory .and. .not. allocated(state%edge))
   end function is_settled

end module wavycon_contact_solver
