!> The solver that a deck asks for.
module wavycon_choose_solver
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_solver, only: contact_solver
   use wavycon_deck, only: deck_type
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fourier_contact, only: fourier_contact
   use wavycon_grid_contact, only: grid_contact
   use wavycon_kinds, only: dp
   use wavycon_method_group, only: given_grid_points
   use wavycon_scene, only: scene_type
   use wavycon_surface, only: no_paper_wave
   implicit none (type, external)
   private

   public :: choose_solver

contains

   !> 'auto' takes the closed form where there is one, then fitted expansions where they know the lattice, with
   !> grids for what these leave. The truncated series of 'beale' is never the cheapest way to an accuracy, as it
   !> does not know its own.
   subroutine choose_solver(deck, scene, solver)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(in) :: scene
      class(contact_solver), allocatable, intent(out) :: solver

      type(fitted_frame) :: frame
      logical :: auto, keep_fields

      auto = deck%method%text('solver') == 'auto'
      keep_fields = deck%output%logical('lines') .or. deck%output%logical('map') .or. deck%output%logical('contours')
      associate (method => deck%method, surface => scene%surface)
         if (method%text('solver') == 'fitted' .or. auto) call find_frame(surface, frame)
         if (method%text('solver') == 'beale') then
            allocate (fourier_contact :: solver)
         else if (auto .and. surface%dimension == 1 .and. surface%paper_wave() /= no_paper_wave) then
            allocate (closed_form_contact :: solver)
         else if (frame%covered .and. all(given_grid_points(method) == 0)) then
            allocate (fitted_contact :: solver)
         else
            allocate (grid_contact :: solver)
         end if

         select type (solver)
         type is (fourier_contact)
            call solver%start(surface, method%integer('harmonics'), method%integer('constraint_points'), &
                              scene%symmetry, method%real('edge_level'))
         type is (closed_form_contact)
            call solver%start(surface)
         type is (grid_contact)
            call solver%start(surface, method%real('accuracy'), keep_fields, points=grid_asked_for())
         type is (fitted_contact)
            call solver%start(surface, method%real('accuracy'), with_grids=auto, &
                              keep_fields=keep_fields .or. deck%output%logical('details'))
         end select
      end associate

   contains

      !> That of the deck, or that of the file if the deck asks for no accuracy.
      pure function grid_asked_for() result(points)
         integer :: points(2)

         points = given_grid_points(deck%method)
         if (all(points == 0) .and. .not. deck%method%real('accuracy') > 0.0_dp) points = scene%surface%points
      end function grid_asked_for

   end subroutine choose_solver

end module wavycon_choose_solver
