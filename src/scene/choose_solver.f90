!> The solver that a deck asks for.
module wavycon_choose_solver
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_solver, only: contact_solver
   use wavycon_deck, only: deck_type
   use wavycon_fourier_contact, only: fourier_contact
   use wavycon_grid_contact, only: grid_contact
   use wavycon_scene, only: scene_type
   implicit none (type, external)
   private

   public :: choose_solver

contains

   !> 'auto' takes the closed form where there is one. The truncated series of 'beale' is never the cheapest way to an
   !> accuracy, as it does not know its own.
   subroutine choose_solver(deck, scene, solver)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(in) :: scene
      class(contact_solver), allocatable, intent(out) :: solver

      associate (method => deck%method, dimension => scene%surface%dimension)
         if (method%solver == 'beale') then
            allocate (fourier_contact :: solver)
         else if (method%solver == 'auto' .and. dimension == 1) then
            allocate (closed_form_contact :: solver)
         else
            allocate (grid_contact :: solver)
         end if

         select type (solver)
         type is (fourier_contact)
            call solver%start(dimension, method%harmonics, method%constraint_points, scene%symmetry, method%edge_level)
         type is (grid_contact)
            call solver%start(dimension, method%accuracy, &
                              keep_fields=deck%output%lines .or. deck%output%map .or. deck%output%contours)
         end select
      end associate
   end subroutine choose_solver

end module wavycon_choose_solver
