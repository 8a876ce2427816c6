!> The type that all solvers extend. src/README.md describes how to add a solver, README.md in this directory how solvers
!> and solutions work together.
module wavycon_contact_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_measures, only: full_contact_measures
   use wavycon_contact_solution, only: contact_solution, no_solution, solution_without_contact_edge
   use wavycon_contact_status, only: above_hardness, full_contact, interrupted, no_load, not_finite, not_found
   use wavycon_kinds, only: dp
   use wavycon_solution_record, only: no_solver
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solver, solver_traits

   !> What is known of a solver and its solutions without a load. Of a solver that was not started grids and levels are
   !> zero.
   type :: solver_traits
      integer :: solver = no_solver            !! of its solutions without numbers
      logical :: has_errors = .true.           !! whether the measures of its solutions have error estimates
      logical :: has_coefficients = .false.    !! whether every solution has `coefficients`, those of a Fourier series
      logical :: has_details = .false.         !! whether every partial contact has `details`
      !> Whether a solution depends, if only in its last digits, on the load solved before.
      logical :: continues_last_load = .false.
      !> Levels of lower accuracy at which loads are solved faster; a search for a load begins at the coarsest.
      integer :: coarser_levels = 0
      !> Points along x and y, of the part of the cell that is solved, of the finest grid that may be solved, and of the
      !> one grid that was given; zeros without.
      integer :: finest_grid(2) = 0, given_grid(2) = 0
      integer :: choice = 0                    !! why 'auto' took its solvers, a name of wavycon_auto_contact
   end type solver_traits

   !> A solver of one surface. Some solvers start each load from the solution of the last one: solve the loads from the
   !> highest to the lowest. Of the procedures below the deferred ones must be written; the others have defaults.
   type, abstract :: contact_solver
      type(surface_type) :: surface
      logical :: is_started = .false.   !! on a surface that it can solve
      class(solver_progress), pointer :: progress => null()   !! called within each load, if associated
   contains
      procedure :: solve
      procedure(solve_load), deferred :: solve_partial_contact
      procedure(traits_of_solver), deferred :: traits
      procedure :: show_progress
      procedure :: use_level
      procedure :: forget_last_load
      procedure :: skip_load
      procedure :: new_kept_solution
   end type contact_solver

   abstract interface
      !> `solve_partial_contact`: solves one load between no load and full contact and measures the solution. With a
      !> hardness P may exceed 1, where the pressure of full contact would exceed H.
      subroutine solve_load(self, pbar_over_pstar, solution)
         import :: contact_solution, contact_solver, dp
         class(contact_solver), intent(inout) :: self
         real(dp), intent(in) :: pbar_over_pstar     !! 0 < P < 1, or 0 < P < H
         class(contact_solution), allocatable, intent(out) :: solution   !! always allocated, with a status
      end subroutine solve_load

      !> `traits`: what is known without a load.
      function traits_of_solver(self) result(traits)
         import :: contact_solver, solver_traits
         class(contact_solver), intent(in) :: self
         type(solver_traits) :: traits
      end function traits_of_solver
   end interface

contains

   !> Solves one load and measures the solution. No load and full contact need no solver. The status is not_found if the
   !> solver was not started on a surface that it can solve, above_hardness if P >= H, and interrupted if self%progress
   !> says that it shall stop.
   subroutine solve(self, pbar_over_pstar, solution)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P; the status of the solution is not_finite if it is no number
      class(contact_solution), allocatable, intent(out) :: solution   !! always allocated, with a status

      logical :: is_number, is_partial
      type(solver_traits) :: traits

      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      is_number = .not. ieee_is_nan(pbar_over_pstar)
      if (.not. self%is_started) then
         traits = self%traits()
         call no_solution(pbar_over_pstar, traits%solver, not_found, solution)
         return
      end if
      if (is_number) then
         is_partial = pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < 1.0_dp
         if (self%surface%has_hardness()) then
            if (pbar_over_pstar >= self%surface%hardness) then
               call no_solution(pbar_over_pstar, no_solver, above_hardness, solution)
               return
            end if
            is_partial = pbar_over_pstar > 0.0_dp .and. &
                         (is_partial .or. pbar_over_pstar + self%surface%full_contact_peak > self%surface%hardness)
         end if
         if (is_partial) then
            if (shall_stop(self)) then
               traits = self%traits()
               call no_solution(pbar_over_pstar, traits%solver, interrupted, solution)
            else
               call self%solve_partial_contact(pbar_over_pstar, solution)
            end if
            return
         end if
      end if
      allocate (solution_without_contact_edge :: solution)
      solution%pbar_over_pstar = pbar_over_pstar
      if (.not. is_number) then
         solution%status = not_finite
      else if (pbar_over_pstar >= 1.0_dp) then
         solution%status = full_contact
         solution%measures = full_contact_measures(pbar_over_pstar, self%surface%full_contact_peak)
      else
         solution%status = no_load
      end if
   end subroutine solve

   logical function shall_stop(self)
      class(contact_solver), intent(in) :: self

      shall_stop = .false.
      if (associated(self%progress)) shall_stop = self%progress%shall_stop(0, 1.0_dp)
   end function shall_stop

   !> Sets the object that is called with the progress within each load.
   subroutine show_progress(self, progress)
      class(contact_solver), intent(inout) :: self
      class(solver_progress), intent(in), pointer :: progress   !! null: none is called

      self%progress => progress
   end subroutine show_progress

   !> Selects the level at which the next loads are solved.
   subroutine use_level(self, level)
      class(contact_solver), intent(inout) :: self
      integer, intent(in) :: level   !! 0, the accuracy requested, to traits%coarser_levels, the coarsest

      associate (unused => self, unused_too => level); end associate
   end subroutine use_level

   !> Makes the next load start as the first one does.
   subroutine forget_last_load(self)
      class(contact_solver), intent(inout) :: self

      associate (unused => self); end associate
   end subroutine forget_last_load

   !> Makes the state of the solver that which it would have after solving a load. Called for loads whose solutions were
   !> read from the checkpoint of an interrupted run.
   subroutine skip_load(self, pbar_over_pstar)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P

      associate (unused => self, unused_too => pbar_over_pstar); end associate
   end subroutine skip_load

   !> Allocates an empty solution of the type whose `is_kept` is true, for `unpack_kept`. Not allocated if the
   !> solutions of this solver are not written to checkpoints.
   subroutine new_kept_solution(self, solution)
      class(contact_solver), intent(in) :: self
      class(contact_solution), allocatable, intent(out) :: solution

      associate (unused => self); end associate
      if (allocated(solution)) return
   end subroutine new_kept_solution

end module wavycon_contact_solver
