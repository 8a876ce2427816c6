!> Chooses among the solvers: the closed form where there is one; otherwise collocation fitted to the edge of contact,
!> if the surface has a lattice, with grids for loads at which it is not accurate enough; otherwise grids. Only the grid
!> is used if its points are given or a hardness bounds the pressure.
module wavycon_auto_contact
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: converged, interrupted
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: main_quantities
   use wavycon_solution_record, only: by_choice
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_contact

   !> Why its solvers were taken: the closed form, collocation with grids where it is not accurate enough, or grids.
   integer, parameter, public :: has_closed_form = 1, has_expansions = 2, has_neither = 3, has_a_hardness = 4, &
      points_are_given = 5, points_are_of_the_map = 6, last_choice = 6

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

   !> Selects and starts the solvers. Collocation and grids have the same accuracy.
   subroutine start(self, surface, options, keep_fields)
      class(auto_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      type(grid_options), intent(in) :: options
      logical, intent(in) :: keep_fields               !! whether solutions keep their fields and edges

      type(closed_form_contact), allocatable :: closed_form
      type(fitted_contact), allocatable :: fitted
      type(fitted_frame) :: frame

      call self%grid_contact%start(surface, options, keep_fields)
      call find_frame(surface, frame)
      if (any(options%points > 0)) then
         self%choice = merge(points_are_of_the_map, points_are_given, all(options%points == surface%points))
      else if (closed_form_exists(surface)) then
         self%choice = has_closed_form
         allocate (closed_form)
         call closed_form%start(surface)
         closed_form%accuracy = options%accuracy
         call move_alloc(closed_form, self%first)
      else if (surface%has_hardness()) then
         self%choice = has_a_hardness
      else if (allocated(frame%lattice)) then
         self%choice = has_expansions
         allocate (fitted)
         call fitted%start(surface, options%accuracy, keep_fields)
         call move_alloc(fitted, self%first)
      else
         self%choice = has_neither
      end if
   end subroutine start

   !> Without a good solution of the first solver the load is solved on grids, and the better of the two solutions is
   !> returned. The digits of the first solution may differ between machines, so that one decision is taken for all
   !> slabs of the grid.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      type(contact_solution) :: on_grids
      type(grid_slab) :: slab
      type(solver_traits) :: of_grids

      if (.not. allocated(self%first)) then
         call self%grid_contact%solve_partial_contact(pbar_over_pstar, solution)
         return
      end if
      call self%first%solve(pbar_over_pstar, solution)
      of_grids = self%grid_contact%traits()
      call slab%start(of_grids%finest_grid)
      if (.not. slab%any(.not. solution%is_good())) return
      call self%grid_contact%solve_partial_contact(pbar_over_pstar, on_grids)
      if (slab%any(on_grids%status == converged .or. on_grids%status == interrupted .or. &
                   maxval(on_grids%error(main_quantities)) <= maxval(solution%error(main_quantities)))) &
         call on_grids%move_to(solution)
   end subroutine solve_partial_contact

   !> The traits of the first solver, with the finest grid of both.
   type(solver_traits) function traits(self)
      class(auto_contact), intent(in) :: self

      type(solver_traits) :: of_grids

      of_grids = self%grid_contact%traits()
      traits = of_grids
      if (allocated(self%first)) traits = self%first%traits()
      if (self%choice == has_expansions .or. of_grids%needs_whole_grids) traits%finest_grid = of_grids%finest_grid
      traits%needs_whole_grids = of_grids%needs_whole_grids
      traits%solver = by_choice
      traits%has_details = .false.
      traits%choice = self%choice
   end function traits

   subroutine forget_last_load(self)
      class(auto_contact), intent(inout) :: self

      if (allocated(self%first)) call self%first%forget_last_load()
   end subroutine forget_last_load

   !> The collocation of the next load starts from that of this load. Checkpoints have only loads solved on grids, so
   !> that the collocation is computed again.
   subroutine skip_load(self, pbar_over_pstar)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar

      type(contact_solution) :: unused

      if (allocated(self%first)) call self%first%solve(pbar_over_pstar, unused)
   end subroutine skip_load

end module wavycon_auto_contact
