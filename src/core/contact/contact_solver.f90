!> The type that all solvers extend. src/README.md describes how to add a solver, and README.md in this directory how
!> solvers and solutions work together.
module wavycon_contact_solver
   use wavycon_contact_measures, only: full_contact_quantities
   use wavycon_contact_solution, only: contact_solution
   use wavycon_full_contact, only: mean_compliance
   use wavycon_kinds, only: dp, ieee_is_nan
   use wavycon_quantities, only: approach, elastic_energy, mean_gap
   use wavycon_solution_record, only: above_hardness, full_contact, interrupted, no_load, no_solution, no_solver, &
      not_finite, not_found
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solver, solver_traits

   !> Accuracy of the solvers that have an accuracy, unless another one is requested.
   real(dp), parameter, public :: default_accuracy = 1e-3_dp

   !> Properties of a solver and its solutions that do not depend on the load. Grids and levels are zero before the
   !> solver is started.
   type :: solver_traits
      integer :: solver = no_solver            !! solver that the record of a failed load names
      logical :: has_errors = .true.           !! whether the measures of the solutions have error estimates
      logical :: has_coefficients = .false.    !! whether every solution has `coefficients` of a Fourier series
      logical :: has_details = .false.         !! whether every partial contact has `details`
      !> Whether a solution depends, if only in its last digits, on the load that was solved before.
      logical :: continues_last_load = .false.
      !> Number of levels of lower accuracy, at which loads are solved faster; a search for a load begins at the
      !> coarsest.
      integer :: coarser_levels = 0
      !> Points along x and y, on the part of the cell that is solved: of the coarsest and the finest grid on which a
      !> load may meet the accuracy, and of the one grid whose points were given; zeros if there is no such grid.
      integer :: coarsest_grid(2) = 0, finest_grid(2) = 0, given_grid(2) = 0
      logical :: lacks_waves = .false.         !! whether the given grid leaves out waves of the surface
      integer :: choice = 0                    !! reason of the choice of 'auto', a name of wavycon_auto_contact
   end type solver_traits

   !> A solver of one surface. Some solvers start each load from the solution of the last one, so that the loads should
   !> be solved from the highest to the lowest. An extension must write the deferred procedures; the others have
   !> defaults.
   type, abstract :: contact_solver
      type(surface_type) :: surface
      logical :: is_started = .false.   !! whether the solver was started on a surface that it can solve
      !> The level at which the next loads are solved, from 0, the accuracy requested, to traits%coarser_levels, the
      !> coarsest.
      integer :: level = 0
      class(solver_progress), pointer :: progress => null()   !! if associated, its procedures are called within a load
      !> Whether the surface that is solved closes at p*: a height map does so at its points, and between them, on other
      !> grids, a little later.
      logical :: closes_at_pstar = .true.
   contains
      procedure :: solve
      procedure(solve_load), deferred :: solve_partial_contact
      procedure :: measure_full_contact
      procedure(traits_of_solver), deferred :: traits
      procedure :: forget_last_load, begin_search, next_level, set_search, skip_load
   end type contact_solver

   abstract interface
      !> `solve_partial_contact`: solves one load between no load and full contact and measures the solution. With a
      !> hardness P may exceed 1 if the peak pressure of full contact would exceed H.
      subroutine solve_load(self, pbar_over_pstar, solution)
         import :: contact_solution, contact_solver, dp
         class(contact_solver), intent(inout) :: self
         real(dp), intent(in) :: pbar_over_pstar           !! 0 < P < H; P < 1 unless free edges or a hardness
         type(contact_solution), intent(out) :: solution   !! its status is set
      end subroutine solve_load

      !> `traits`: the properties of the solver that do not depend on the load.
      function traits_of_solver(self) result(traits)
         import :: contact_solver, solver_traits
         class(contact_solver), intent(in) :: self
         type(solver_traits) :: traits
      end function traits_of_solver
   end interface

contains

   !> Solves one load and measures the solution. Some loads need no solver. For P <= 0 there is no load. For P >= 1 the
   !> contact is full, unless the surface has free edges, is a height map on another grid than its points, or the
   !> largest pressure, P + full_contact_peak, exceeds the hardness H. For P >= H and for NaN there is no solution. The
   !> status is not_found if the solver was not started on a surface that it can solve, and interrupted if self%progress
   !> asks the solver to stop.
   subroutine solve(self, pbar_over_pstar, solution)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar             !! P, any number; the status is not_finite for NaN
      type(contact_solution), intent(out) :: solution     !! its status is set

      logical :: shall_stop
      type(solver_traits) :: traits

      traits = self%traits()
      solution%pbar_over_pstar = pbar_over_pstar
      associate (surface => self%surface)
         ! NaN is excluded first: a comparison with NaN raises an exception, at which Debug builds stop.
         if (.not. self%is_started) then
            solution%solution_record = no_solution(pbar_over_pstar, traits%solver, not_found)
         else if (ieee_is_nan(pbar_over_pstar)) then
            solution%status = not_finite
         else if (pbar_over_pstar <= 0.0_dp) then
            solution%status = no_load
            solution%value(elastic_energy) = 0.0_dp
            solution%error(elastic_energy) = 0.0_dp
         else if (surface%has_hardness() .and. pbar_over_pstar >= surface%hardness) then
            solution%solution_record = no_solution(pbar_over_pstar, no_solver, above_hardness)
         else if (pbar_over_pstar >= 1.0_dp .and. self%closes_at_pstar .and. .not. surface%has_free_edges .and. &
                  (.not. surface%has_hardness() .or. &
                   pbar_over_pstar + surface%full_contact_peak <= surface%hardness)) then
            solution%status = full_contact
            solution%quantities = full_contact_quantities(surface, pbar_over_pstar)
            call self%measure_full_contact(solution)
            call add_mean_compression(surface, solution)
         else
            shall_stop = .false.
            if (associated(self%progress)) shall_stop = self%progress%shall_stop(0, 1.0_dp)
            if (shall_stop) then
               solution%solution_record = no_solution(pbar_over_pstar, traits%solver, interrupted)
            else
               call self%solve_partial_contact(pbar_over_pstar, solution)
               solution%error(approach) = max(solution%error(approach), solution%error(mean_gap))
               call add_mean_compression(surface, solution)
               if (allocated(solution%source)) solution%source%record = solution%solution_record
            end if
         end if
      end associate
   end subroutine solve

   !> Measures between its points a height map that is closed at them. By default there is nothing to measure.
   subroutine measure_full_contact(self, solution)
      class(contact_solver), intent(inout) :: self
      type(contact_solution), intent(inout) :: solution   !! of full contact, with the values at the points

      associate (unused => self, unused_too => solution); end associate
   end subroutine measure_full_contact

   !> Adds what the mean pressure does to the layer below, if there is one: (E31) of src/core/half_space/README.md.
   subroutine add_mean_compression(surface, solution)
      type(surface_type), intent(in) :: surface
      type(contact_solution), intent(inout) :: solution   !! of partial or full contact

      real(dp) :: compression

      if (.not. surface%kernel%has_layer()) return
      compression = mean_compliance(surface)*solution%pbar_over_pstar
      solution%value(approach) = solution%value(approach) + compression
      solution%value(elastic_energy) = solution%value(elastic_energy) + 0.5_dp*compression*solution%pbar_over_pstar
   end subroutine add_mean_compression

   !> Forgets the last solution, so that the next load starts as the first one does. By default there is nothing to
   !> forget.
   subroutine forget_last_load(self)
      class(contact_solver), intent(inout) :: self

      associate (unused => self); end associate
   end subroutine forget_last_load

   !> Begins a search for a load, at the coarsest level. At each level the caller searches and then calls `next_level`.
   subroutine begin_search(self)
      class(contact_solver), intent(inout) :: self

      type(solver_traits) :: traits

      traits = self%traits()
      self%level = traits%coarser_levels
      call self%set_search(.true.)
   end subroutine begin_search

   !> Goes on with a search at the next finer level. The search ends after the finest one.
   subroutine next_level(self, is_over, ends)
      class(contact_solver), intent(inout) :: self   !! after begin_search; `level` is the next one, 0 at the end
      logical, intent(in) :: is_over                 !! whether finer levels are left out
      logical, intent(out) :: ends                   !! whether the search ends

      ends = is_over .or. self%level == 0
      self%level = self%level - 1
      if (.not. ends) return
      self%level = 0
      call self%set_search(.false.)
   end subroutine next_level

   !> Notes that a search for a load begins or ends. Loads within a search differ little, and each may start from the
   !> last one. The end of a search deletes these starts. By default nothing is done.
   subroutine set_search(self, begins)
      class(contact_solver), intent(inout) :: self
      logical, intent(in) :: begins                  !! whether a search begins; otherwise it ends

      associate (unused => self, unused_too => begins); end associate
   end subroutine set_search

   !> Brings the solver into the state that it would have after solving a load. This is called for loads whose solutions
   !> were read from the checkpoint of an interrupted run. By default a solver has no such state.
   subroutine skip_load(self, pbar_over_pstar)
      class(contact_solver), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar        !! P

      associate (unused => self, unused_too => pbar_over_pstar); end associate
   end subroutine skip_load

end module wavycon_contact_solver
