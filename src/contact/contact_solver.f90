!> What every solver that a user can select declares and does. src/README.md describes how to add one.
module wavycon_contact_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_measures, only: full_contact_measures
   use wavycon_contact_solution, only: contact_solution, solution_without_contact_edge
   use wavycon_contact_status, only: full_contact, no_load, not_finite
   use wavycon_kinds, only: dp
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solver

   !> A solver of one surface. Some solvers start each load from the last one: give the loads from the highest to the lowest.
   type, abstract :: contact_solver
      type(surface_type) :: surface
      class(solver_progress), pointer :: progress => null()   !! shown the progress within a load, if associated
   contains
      procedure(name_of_solver), deferred, nopass :: name
      procedure(words_of_solver), deferred :: describe
      procedure :: solve
      procedure(solve_load), deferred :: solve_partial_contact
      procedure :: has_coefficients
      procedure :: has_details
      procedure :: show_progress
      procedure :: coarser_levels
      procedure :: use_level
      procedure :: starts_from_last_load
      procedure :: skip_load
      procedure :: new_kept_solution
   end type contact_solver

   abstract interface
      !> The name in decks and tables.
      pure function name_of_solver() result(name)
         character(:), allocatable :: name
      end function name_of_solver

      !> The discretisation, for the log and the heads of tables.
      pure function words_of_solver(self) result(words)
         import :: contact_solver
         class(contact_solver), intent(in) :: self
         character(:), allocatable :: words
      end function words_of_solver

      !> Solves and measures one load between no load and full contact. The solution is always allocated and has a status.
      subroutine solve_load(self, pbar_over_pstar, solution)
         import :: contact_solution, contact_solver, dp
         class(contact_solver), intent(inout) :: self
         real(dp), intent(in) :: pbar_over_pstar     !! 0 < P < 1
         class(contact_solution), allocatable, intent(out) :: solution
      end subroutine solve_load
   end interface

contains

   !> Solves and measures one load. The solution is always allocated and has a status.
   subroutine solve(self, pbar_over_pstar, solution)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P
      class(contact_solution), allocatable, intent(out) :: solution

      if (pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < 1.0_dp) then
         call self%solve_partial_contact(pbar_over_pstar, solution)
         return
      end if
      allocate (solution_without_contact_edge :: solution)
      solution%pbar_over_pstar = pbar_over_pstar
      if (ieee_is_nan(pbar_over_pstar)) then
         solution%status = not_finite
      else if (pbar_over_pstar >= 1.0_dp) then
         solution%status = full_contact
         solution%measures = full_contact_measures(pbar_over_pstar, self%surface%full_contact_peak)
      else
         solution%status = no_load
      end if
   end subroutine solve

   !> Whether every solution has the coefficients of a pressure series that the solver computed.
   pure logical function has_coefficients(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      has_coefficients = .false.
   end function has_coefficients

   !> Whether solutions have `contact_details`.
   pure logical function has_details(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      has_details = .false.
   end function has_details

   !> Shows the progress within each load to come.
   subroutine show_progress(self, progress)
      class(contact_solver), intent(inout) :: self
      class(solver_progress), intent(in), pointer :: progress   !! null: no more

      self%progress => progress
   end subroutine show_progress

   !> Number of levels at which loads can be solved faster and less accurately, while a load is searched for.
   integer function coarser_levels(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      coarser_levels = 0
   end function coarser_levels

   !> Selects the level of the loads to come.
   subroutine use_level(self, level)
      class(contact_solver), intent(inout) :: self
      integer, intent(in) :: level   !! 0, as accurate as requested, to coarser_levels

      associate (unused => self, unused_too => level); end associate
   end subroutine use_level

   !> Whether a solution depends, if only in its last digits, on the load solved before.
   pure logical function starts_from_last_load(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      starts_from_last_load = .false.
   end function starts_from_last_load

   !> Brings the solver to where it would be after solving a load whose solution was kept from an interrupted run.
   subroutine skip_load(self, pbar_over_pstar)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P

      associate (unused => self, unused_too => pbar_over_pstar); end associate
   end subroutine skip_load

   !> An empty solution of the type that this solver's is_kept solutions have. Not allocated if it keeps none.
   subroutine new_kept_solution(self, solution)
      class(contact_solver), intent(in) :: self
      class(contact_solution), allocatable, intent(out) :: solution

      associate (unused => self); end associate
      if (allocated(solution)) return
   end subroutine new_kept_solution

end module wavycon_contact_solver
