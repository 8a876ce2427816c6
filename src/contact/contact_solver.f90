!> The type that all solvers of &method extend. src/README.md describes how to add a solver, README.md in this directory
!> how solvers and solutions work together.
module wavycon_contact_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_measures, only: full_contact_measures
   use wavycon_contact_solution, only: contact_solution, no_solution, solution_without_contact_edge
   use wavycon_contact_status, only: above_hardness, full_contact, no_load, not_finite, not_found
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_kinds, only: dp
   use wavycon_problems, only: problem_list_type
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solver

   !> A solver of one surface. Some solvers start each load from the solution of the last one: solve the loads from the
   !> highest to the lowest. Of the procedures below the deferred ones must be written; the others have defaults.
   type, abstract :: contact_solver
      type(surface_type) :: surface
      class(solver_progress), pointer :: progress => null()   !! called within each load, if associated
   contains
      procedure(words_interface), deferred, nopass :: name
      procedure(words_interface), deferred, nopass :: meaning
      procedure(keys_interface), deferred, nopass :: keys
      procedure, nopass :: refusal => no_refusal
      procedure, nopass :: is_default_for => never
      procedure, nopass :: set_defaults => no_defaults
      procedure, nopass :: check => no_check
      procedure, nopass :: advice => no_advice
      procedure(start_interface), deferred :: start_from_keys
      procedure(words_of_solver), deferred :: describe
      procedure :: solve
      procedure(solve_load), deferred :: solve_partial_contact
      procedure :: has_error_estimates
      procedure :: why_no_area
      procedure :: why_chosen
      procedure :: finest_grid
      procedure :: given_grid
      procedure :: has_coefficients
      procedure :: has_details
      procedure :: show_progress
      procedure :: coarser_levels
      procedure :: use_level
      procedure :: starts_from_last_load
      procedure :: forget_last_load
      procedure :: skip_load
      procedure :: new_kept_solution
   end type contact_solver

   abstract interface
      !> `name`: the value of the key `solver` in decks, at most 12 characters. `meaning`: one clause for the key
      !> reference.
      pure function words_interface() result(words)
         character(:), allocatable :: words
      end function words_interface

      !> `keys`: the keys of &method that the solver reads, besides `solver`. A key that two solvers read must have
      !> the same type, unit and bounds in both; its meaning may differ.
      function keys_interface() result(keys)
         import :: key_type
         type(key_type), allocatable :: keys(:)
      end function keys_interface

      !> `start_from_keys`: starts the solver with the values of &method.
      subroutine start_interface(self, surface, values, keep_fields)
         import :: contact_solver, group_values, surface_type
         class(contact_solver), intent(inout) :: self
         type(surface_type), intent(in) :: surface     !! for which `refusal` is empty
         type(group_values), intent(in) :: values      !! of &method, after `set_defaults` and `check`, without problems
         logical, intent(in) :: keep_fields            !! whether fields, edges or details of solutions will be needed
      end subroutine start_interface

      !> `describe`: the discretisation in words, for the log and the heads of tables.
      pure function words_of_solver(self) result(words)
         import :: contact_solver
         class(contact_solver), intent(in) :: self
         character(:), allocatable :: words
      end function words_of_solver

      !> `solve_partial_contact`: solves one load between no load and full contact and measures the solution. With a
      !> hardness P may exceed 1, where the pressure of full contact would exceed H.
      subroutine solve_load(self, pbar_over_pstar, solution)
         import :: contact_solution, contact_solver, dp
         class(contact_solver), intent(inout) :: self
         real(dp), intent(in) :: pbar_over_pstar     !! 0 < P < 1, or 0 < P < H
         class(contact_solution), allocatable, intent(out) :: solution   !! always allocated, with a status
      end subroutine solve_load
   end interface

contains

   !> `refusal`: why the solver cannot solve a surface, as the end of a sentence such as 'is for the 1-D wave'; empty
   !> if it can. Here it is empty.
   function no_refusal(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => surface); end associate
      words = ''
   end function no_refusal

   !> `is_default_for`: whether this solver is the default for a surface. If several are, the first of the list is
   !> taken. Here it is not.
   logical function never(surface, kind)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind           !! of the surface, as the deck names it

      associate (unused => surface, unused_too => kind); end associate
      never = .false.
   end function never

   !> `set_defaults`: sets the defaults that depend on the surface and leaves keys without a meaning for it out of the
   !> resolved deck. Here there are none.
   subroutine no_defaults(values, surface)
      type(group_values), intent(inout) :: values   !! of &method
      type(surface_type), intent(in) :: surface

      associate (unused => values, unused_too => surface); end associate
   end subroutine no_defaults

   !> `check`: reports values that contradict each other or the surface. Here there are none.
   subroutine no_check(values, surface, problems)
      type(group_values), intent(in) :: values           !! after `set_defaults`
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems   !! to which they are added

      associate (unused => values, unused_too => surface, also_unused => problems); end associate
   end subroutine no_check

   !> `advice`: what to give instead of a key of another solver, or why this one has no such key, as the end of a
   !> sentence such as ': it has no grid'. Here it is empty.
   function no_advice(key) result(words)
      character(*), intent(in) :: key   !! that other solvers read
      character(:), allocatable :: words

      words = key(:0)
   end function no_advice

   !> Solves one load and measures the solution. No load and full contact need no solver. The status is not_found if the
   !> solver was not started or was started on a surface that it refuses, and above_hardness if P >= H.
   subroutine solve(self, pbar_over_pstar, solution)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P; the status of the solution is not_finite if it is no number
      class(contact_solution), allocatable, intent(out) :: solution   !! always allocated, with a status

      logical :: is_number, is_partial

      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      is_number = .not. ieee_is_nan(pbar_over_pstar)
      if (.not. has_surface(self)) then
         call no_solution(pbar_over_pstar, self%name(), not_found, solution)
         return
      end if
      if (is_number) then
         is_partial = pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < 1.0_dp
         if (self%surface%has_hardness()) then
            if (pbar_over_pstar >= self%surface%hardness) then
               call no_solution(pbar_over_pstar, 'none', above_hardness, solution)
               return
            end if
            is_partial = pbar_over_pstar > 0.0_dp .and. &
                         (is_partial .or. pbar_over_pstar + self%surface%full_contact_peak > self%surface%hardness)
         end if
         if (is_partial) then
            call self%solve_partial_contact(pbar_over_pstar, solution)
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

   !> Whether the solver was started on a surface that it can solve.
   logical function has_surface(solver)
      class(contact_solver), intent(in) :: solver

      has_surface = allocated(solver%surface%shape%c)
      if (has_surface) has_surface = solver%refusal(solver%surface) == ''
   end function has_surface

   !> Whether the measures of its solutions have error estimates.
   pure logical function has_error_estimates(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      has_error_estimates = .true.
   end function has_error_estimates

   !> Why a converged solution may have no contact area, such as 'no pressure reaches 0.1 p*'; empty if it always has
   !> one.
   function why_no_area(self) result(words)
      class(contact_solver), intent(in) :: self
      character(:), allocatable :: words

      associate (unused => self); end associate
      words = ''
   end function why_no_area

   !> Why the solver that solves is the one that it is, as a sentence for --check; empty if the deck names it.
   function why_chosen(self) result(words)
      class(contact_solver), intent(in) :: self   !! started
      character(:), allocatable :: words

      associate (unused => self); end associate
      words = ''
   end function why_chosen

   !> Points along x and y of the finest grid that may be solved, of the part of the cell that is solved. Zeros if there
   !> is no grid.
   function finest_grid(self) result(points)
      class(contact_solver), intent(in) :: self   !! started
      integer :: points(2)

      associate (unused => self); end associate
      points = 0
   end function finest_grid

   !> The same of the grid whose points the deck gives. Zeros if it gives none.
   function given_grid(self) result(points)
      class(contact_solver), intent(in) :: self   !! started
      integer :: points(2)

      associate (unused => self); end associate
      points = 0
   end function given_grid

   !> Whether every solution has `coefficients`: those of the Fourier series of the pressure that the solver computed.
   pure logical function has_coefficients(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      has_coefficients = .false.
   end function has_coefficients

   !> Whether every partial contact has `details`.
   pure logical function has_details(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      has_details = .false.
   end function has_details

   !> Sets the object that is called with the progress within each load.
   subroutine show_progress(self, progress)
      class(contact_solver), intent(inout) :: self
      class(solver_progress), intent(in), pointer :: progress   !! null: none is called

      self%progress => progress
   end subroutine show_progress

   !> Number of levels of lower accuracy at which loads can be solved faster. The search for the load of a given area or
   !> gap begins at the coarsest.
   integer function coarser_levels(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      coarser_levels = 0
   end function coarser_levels

   !> Selects the level at which the next loads are solved.
   subroutine use_level(self, level)
      class(contact_solver), intent(inout) :: self
      integer, intent(in) :: level   !! 0, the accuracy requested, to `coarser_levels`, the coarsest

      associate (unused => self, unused_too => level); end associate
   end subroutine use_level

   !> Whether a solution depends, if only in its last digits, on the load solved before. A resumed run then solves the
   !> loads of a search again.
   pure logical function starts_from_last_load(self)
      class(contact_solver), intent(in) :: self

      associate (unused => self); end associate
      starts_from_last_load = .false.
   end function starts_from_last_load

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
