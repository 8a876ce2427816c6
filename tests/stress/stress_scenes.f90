!> Solves the loads of a deck on grids as the program does, and checks the contact conditions of every solution. Prints
!> a line for each load, also if no solution was needed or found.
!>
!> usage: stress_scenes DECK [HARDNESS]   the hardness, over the mean pressure of each load, takes the place of that of
!> the deck
program stress_scenes
   use command_words, only: word
   use stress_kkt_of_grid, only: check_grid, grid_kkt
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_solution, only: contact_solution
   use wavycon_error, only: error_type
   use wavycon_grid_source, only: grid_source
   use wavycon_kinds, only: dp
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_read_deck, only: parse_deck
   use wavycon_methods, only: start_solver
   use wavycon_scene, only: scene_type
   use wavycon_solution_record, only: status_name
   implicit none (type, external)

   type(contact_solution) :: solution
   type(deck_text_type) :: text
   type(error_type), allocatable :: error
   type(grid_kkt) :: of_grid
   type(scene_type) :: scene
   class(contact_solver), allocatable :: solver
   character(:), allocatable :: ratio_word
   real(dp) :: ratio
   integer :: i

   if (all(command_argument_count() /= [1, 2])) error stop 'usage: stress_scenes DECK [HARDNESS]'
   call read_deck_text(word(1), text, error)
   call stop_on(error)
   call parse_deck(text, scene, error)
   call stop_on(error)
   call start_solver(scene%surface, scene%method, .true., solver)
   do i = 1, size(scene%target)
      if (command_argument_count() > 1) then
         ratio_word = word(2)
         read (ratio_word, *) ratio
         scene%surface%hardness = ratio*scene%target(i)
         call start_solver(scene%surface, scene%method, .true., solver)
      end if
      call solver%solve(scene%target(i), solution)
      if (.not. allocated(solution%source)) then
         write (*, '(a, "|", es24.16, "|", a)') 'none', scene%target(i), trim(status_name(solution%status))
         cycle
      end if
      select type (source => solution%source)
      type is (grid_source)
         of_grid = check_grid(scene%surface, solution%solution_record, source)
         write (*, '(a, "|", es24.16, "|", a, 8("|", es23.15e3), "|", i0)') 'grid', scene%target(i), &
            trim(status_name(solution%status)), of_grid%load, of_grid%residual, of_grid%complementarity, of_grid%gap, &
            solution%residual, &
            of_grid%size_of_gaps, of_grid%edge_gap, of_grid%depth, solution%iterations
      end select
   end do

contains

   subroutine stop_on(error)
      type(error_type), intent(in), allocatable :: error

      if (allocated(error)) error stop 'stress_scenes: the deck is bad'
   end subroutine stop_on

end program stress_scenes
