!> The solver that a deck asks for.
module wavycon_choose_solver
   use wavycon_auto_contact, only: auto_contact
   use wavycon_beale_contact, only: beale_contact
   use wavycon_contact_solver, only: contact_solver
   use wavycon_deck, only: deck_type
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_grid_contact, only: grid_contact
   use wavycon_kinds, only: dp
   use wavycon_scene, only: scene_type
   implicit none (type, external)
   private

   public :: choose_solver

contains

   subroutine choose_solver(deck, scene, keep_fields, solver)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(in) :: scene
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(beale_contact), allocatable :: beale
      type(grid_contact), allocatable :: grid
      type(fitted_contact), allocatable :: fitted
      type(auto_contact), allocatable :: auto
      integer :: points(2)

      points = deck%method%grid_points
      if (all(points == 0) .and. .not. deck%method%accuracy > 0.0_dp) points = scene%surface%points
      associate (method => deck%method, surface => scene%surface)
         select case (method%solver)
         case ('beale')
            allocate (beale)
            call beale%start(surface, method%harmonics, method%constraint_points, scene%symmetry, method%edge_level)
            call move_alloc(beale, solver)
         case ('grid')
            allocate (grid)
            call grid%start(surface, method%accuracy, keep_fields, points)
            call move_alloc(grid, solver)
         case ('fitted')
            allocate (fitted)
            call fitted%start(surface, method%accuracy, keep_fields)
            call move_alloc(fitted, solver)
         case default
            allocate (auto)
            call auto%start(surface, method%accuracy, keep_fields, points)
            call move_alloc(auto, solver)
         end select
      end associate
   end subroutine choose_solver

end module wavycon_choose_solver
