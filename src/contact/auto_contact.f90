!> Chooses among the solvers: the closed form where there is one, otherwise fitted expansions where these exist for the
!> surface, with grids for loads at which they are not accurate enough, otherwise grids. The grid alone if its points are
!> given or the pressure is bounded by a hardness.
module wavycon_auto_contact
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: converged, interrupted
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_grid_contact, only: grid_contact
   use wavycon_kinds, only: dp
   use wavycon_ranks, only: any_rank
   use wavycon_solution_record, only: by_choice
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_contact

   !> Why its solvers were taken: the closed form, expansions with grids where these are not accurate enough, or grids.
   integer, parameter, public :: has_closed_form = 1, has_expansions = 2, has_neither = 3, has_a_hardness = 4, &
      points_are_given = 5, points_are_of_the_map = 6

   !> The solver on grids, with another one before it.
   type, extends(grid_contact) :: auto_contact
      integer, private :: choice = 0                          !! one of the names above
      class(contact_solver), allocatable, private :: first    !! tries every load; not allocated: grids alone
   contains
      procedure :: start
      procedure :: solve_partial_contact
      procedure :: traits
      procedure :: forget_last_load
      procedure :: skip_load
   end type auto_contact

contains

   !> Selects and starts the solvers.
   subroutine start(self, surface, accuracy, keep_fields, points, residual)
      class(auto_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: accuracy                 !! of mean gap [Delta], contact area fraction, peak pressure [p*]
      logical, intent(in) :: keep_fields               !! whether solutions keep their fields and edges
      integer, intent(in), optional :: points(2)       !! of the one grid to solve; absent or zeros: to the accuracy
      real(dp), intent(in), optional :: residual       !! of that grid (C9), as for grid_contact

      type(closed_form_contact), allocatable :: closed_form
      type(fitted_contact), allocatable :: fitted
      type(fitted_frame) :: frame
      logical :: by_accuracy

      call self%grid_contact%start(surface, accuracy, keep_fields, points, residual)
      by_accuracy = .true.
      if (present(points)) by_accuracy = all(points == 0)
      call find_frame(surface, frame)
      if (closed_form_exists(surface) .and. by_accuracy .and. .not. surface%has_hardness()) then
         allocate (closed_form)
         call closed_form%start(surface)
         call move_alloc(closed_form, self%first)
         self%choice = has_closed_form
      else if (frame%is_found() .and. by_accuracy .and. .not. surface%has_hardness()) then
         allocate (fitted)
         call fitted%start(surface, accuracy, keep_fields)
         call move_alloc(fitted, self%first)
         self%choice = has_expansions
      else
         self%choice = has_neither
         if (surface%has_hardness()) self%choice = has_a_hardness
         if (.not. by_accuracy) &
            self%choice = merge(points_are_of_the_map, points_are_given, all(points == surface%points))
      end if
   end subroutine start

   !> Without a good solution of the first solver the load is solved on grids, and the better of the two solutions is
   !> returned. Ranks on different machines may have first solutions of different digits: they decide together.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      class(contact_solution), allocatable, intent(out) :: solution

      class(contact_solution), allocatable :: on_grids

      if (.not. allocated(self%first)) then
         call self%grid_contact%solve_partial_contact(pbar_over_pstar, solution)
         return
      end if
      call self%first%solve(pbar_over_pstar, solution)
      if (.not. any_rank(.not. solution%is_good())) return
      call self%grid_contact%solve_partial_contact(pbar_over_pstar, on_grids)
      if (any_rank(on_grids%status == converged .or. on_grids%status == interrupted .or. &
                   on_grids%largest_error() <= solution%largest_error())) &
         call move_alloc(on_grids, solution)
   end subroutine solve_partial_contact

   !> Those of the first solver, and the finest grid of both.
   type(solver_traits) function traits(self)
      class(auto_contact), intent(in) :: self

      type(solver_traits) :: of_grids

      of_grids = self%grid_contact%traits()
      traits = of_grids
      if (allocated(self%first)) traits = self%first%traits()
      if (self%choice == has_expansions) traits%finest_grid = of_grids%finest_grid
      traits%solver = by_choice
      traits%has_details = .false.
      traits%choice = self%choice
   end function traits

   subroutine forget_last_load(self)
      class(auto_contact), intent(inout) :: self

      if (allocated(self%first)) call self%first%forget_last_load()
   end subroutine forget_last_load

   !> The expansion of the next load starts from the expansion of this one. Only loads solved on grids are in
   !> checkpoints, so that the expansion is computed again.
   subroutine skip_load(self, pbar_over_pstar)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar

      class(contact_solution), allocatable :: unused

      if (allocated(self%first)) call self%first%solve(pbar_over_pstar, unused)
   end subroutine skip_load

end module wavycon_auto_contact
