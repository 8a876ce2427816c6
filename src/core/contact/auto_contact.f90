!> The solver 'auto', which chooses among the other solvers. It takes the closed form if the surface has one. Otherwise
!> it takes collocation fitted to the edge of contact if the crests of the surface form a lattice; loads at which
!> collocation is not accurate enough are solved on grids. All other surfaces are solved on grids alone, and so is any
!> surface if the points of the grid are given or a hardness bounds the pressure.
module wavycon_auto_contact
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: crests_form_lattice
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: main_quantities
   use wavycon_solution_record, only: by_auto, converged, interrupted
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_contact

   !> Reasons for the choice. The surface has a closed form; or collocation (`has_lattice`) is used, with grids where
   !> collocation is not accurate enough; or grids alone are used, for one of five reasons: the surface has neither, it
   !> has a hardness or a layer, the points of the grid are given, or these points are the height map's own ones.
   integer, parameter, public :: has_closed_form = 1, has_lattice = 2, has_neither = 3, has_a_hardness = 4, &
      points_are_given = 5, points_are_of_the_map = 6, has_a_layer = 7, last_choice = 7

   !> The solver on grids, preceded by another solver where the surface allows one.
   type, extends(grid_contact) :: auto_contact
      integer, private :: choice = 0          !! one of the reasons above
      !> The closed form or collocation, which tries every load before the grids do. Not allocated if grids are used
      !> alone.
      class(contact_solver), allocatable, private :: preferred
   contains
      procedure :: start, solve_partial_contact, traits, forget_last_load, skip_load
   end type auto_contact

contains

   !> Selects and starts the solvers. Collocation and grids get the same accuracy, that of `options`.
   subroutine start(self, surface, options, keep_fields)
      class(auto_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      type(grid_options), intent(in) :: options
      logical, intent(in) :: keep_fields               !! whether solutions keep their fields and edges

      type(closed_form_contact), allocatable :: closed_form
      type(fitted_contact), allocatable :: fitted

      call self%grid_contact%start(surface, options, keep_fields)
      if (any(options%points > 0)) then
         self%choice = points_are_given
         if (all(options%points == surface%points)) self%choice = points_are_of_the_map
      else if (closed_form_exists(surface)) then
         self%choice = has_closed_form
         allocate (closed_form)
         call closed_form%start(surface)
         closed_form%accuracy = options%accuracy
         call move_alloc(closed_form, self%preferred)
      else if (surface%has_hardness()) then
         self%choice = has_a_hardness
      else if (surface%kernel%has_layer()) then
         self%choice = has_a_layer
      else if (crests_form_lattice(surface)) then
         self%choice = has_lattice
         allocate (fitted)
         call fitted%start(surface, options%accuracy, keep_fields)
         call move_alloc(fitted, self%preferred)
      else
         self%choice = has_neither
      end if
   end subroutine start

   !> Solves a load by the preferred solver and, if its solution is not good, on grids too. The solution on grids is
   !> returned if it converged, was interrupted or has the smaller error estimate, otherwise the first one. All
   !> processes compute the first solution, and its last digits may differ between machines; so they take both
   !> decisions together.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      type(contact_solution) :: on_grids
      type(grid_slab) :: slab

      if (.not. allocated(self%preferred)) then
         call self%grid_contact%solve_partial_contact(pbar_over_pstar, solution)
         return
      end if
      call self%preferred%solve(pbar_over_pstar, solution)
      if (.not. slab%any(.not. solution%is_good())) return
      call self%grid_contact%solve_partial_contact(pbar_over_pstar, on_grids)
      if (slab%any(on_grids%status == converged .or. on_grids%status == interrupted .or. &
                   maxval(on_grids%error(main_quantities)) <= maxval(solution%error(main_quantities)))) &
         call on_grids%move_to(solution)
   end subroutine solve_partial_contact

   !> The traits of the preferred solver, or of grids without one. `coarsest_grid` and `finest_grid` are those of the
   !> solver on grids wherever a load may be solved on grids.
   type(solver_traits) function traits(self)
      class(auto_contact), intent(in) :: self

      type(solver_traits) :: of_grids

      of_grids = self%grid_contact%traits()
      traits = of_grids
      if (allocated(self%preferred)) traits = self%preferred%traits()
      if (self%choice == has_lattice .or. self%surface%has_free_edges) then
         traits%coarsest_grid = of_grids%coarsest_grid
         traits%finest_grid = of_grids%finest_grid
      end if
      traits%solver = by_auto
      traits%has_details = .false.
      traits%choice = self%choice
   end function traits

   !> Forgets the last collocation. Grids keep nothing of a load outside a search.
   subroutine forget_last_load(self)
      class(auto_contact), intent(inout) :: self

      if (allocated(self%preferred)) call self%preferred%forget_last_load()
   end subroutine forget_last_load

   !> Repeats the collocation of a load that was read from a checkpoint, because the collocation of the next load starts
   !> from it. Checkpoints hold solutions on grids only.
   subroutine skip_load(self, pbar_over_pstar)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar

      type(contact_solution) :: unused

      if (allocated(self%preferred)) call self%preferred%solve(pbar_over_pstar, unused)
   end subroutine skip_load

end module wavycon_auto_contact
