!> Runs a deck as the program does.
module wavycon_deck_run
   use wavycon_error, only: error_type, exit_fine
   use wavycon_read_deck, only: read_deck
   use wavycon_results, only: results_type
   use wavycon_run_scene, only: run_scene
   use wavycon_scene, only: scene_type
   use wavycon_settings, only: setting_type
   implicit none (type, external)
   private

   public :: run_deck

contains

   !> Runs a deck: solves its loads and writes its tables. Errors: those of the program for a bad deck, a bad height map
   !> or files that cannot be written.
   !>
   !> N.B. As in the program, those of SIGINT, SIGTERM and SIGHUP that the process does not handle remove an unfinished
   !> file and end the process.
   subroutine run_deck(path, directory, quiet, status, error)
      character(*), intent(in) :: path        !! of the deck
      character(*), intent(in) :: directory   !! for the tables, in place of that of the deck; '': that of the deck
      logical, intent(in) :: quiet            !! whether to write no log to standard output
      integer, intent(out) :: status          !! the program's exit status: exit_fine, exit_not_converged or the error's
      type(error_type), allocatable, intent(out) :: error

      type(results_type) :: results
      type(scene_type), allocatable :: scene
      type(setting_type), allocatable :: settings(:)

      allocate (settings(merge(0, 1, directory == '')))
      if (size(settings) > 0) settings(1) = setting_type('output', 'directory', directory)
      status = exit_fine
      allocate (scene)
      call read_deck(path, scene, error, settings)
      if (.not. allocated(error)) call run_scene(scene, quiet, .false., results, status, error)
      if (allocated(error)) status = error%status
   end subroutine run_deck

end module wavycon_deck_run
