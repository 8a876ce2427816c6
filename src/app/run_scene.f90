!> A deck from beginning to end: scene, answers, measures, tables.
module wavycon_run_scene
   use wavycon_checkpoint, only: checkpoint_file, checkpoint_name, read_checkpoint
   use wavycon_choose_solver, only: choose_solver
   use wavycon_coefficients_table, only: write_coefficients_table
   use wavycon_contact_state, only: converged
   use wavycon_contour_table, only: write_contour_table
   use wavycon_deck, only: deck_type
   use wavycon_details_table, only: write_details_table
   use wavycon_error, only: error_type, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_lines_table, only: write_lines_table
   use wavycon_map_table, only: write_map_table
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_resolved_deck, only: write_resolved_deck
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: scene_type
   use wavycon_solve_loads, only: solve_loads
   use wavycon_summary_table, only: write_summary_table
   use wavycon_system, only: make_directories
   use wavycon_theory_table, only: write_theory_table
   implicit none (type, external)
   private

   public :: run_scene

   abstract interface
      subroutine table_writer(results, error)
         import :: error_type, results_type
         type(results_type), intent(in) :: results
         type(error_type), allocatable, intent(out) :: error
      end subroutine table_writer
   end interface

contains

   !> Runs a deck. Errors: exit_bad_input, exit_file_trouble.
   subroutine run_scene(deck, scene, quiet, resume, status, error)
      type(deck_type), intent(in) :: deck
      type(scene_type), allocatable, intent(inout) :: scene   !! of the deck; it goes into the results
      logical, intent(in) :: quiet
      logical, intent(in) :: resume    !! go on from the checkpoint of an interrupted run
      integer, intent(out) :: status   !! exit_fine or exit_not_converged
      type(error_type), allocatable, intent(out) :: error

      type(results_type) :: results
      type(run_log), target :: log
      type(checkpoint_file) :: checkpoint
      logical, allocatable :: known(:)
      integer :: bad, hidden

      status = exit_fine
      call log%start(quiet)
      results%deck = deck
      results%directory = deck%output%text('directory')
      call move_alloc(scene, results%scene)
      call choose_solver(deck, results%scene, results%contact)
      call log%show_scene(results)
      allocate (results%states(size(results%scene%target)))
      allocate (known(size(results%states)), source=.false.)
      if (resume) call take_checkpoint(results, known, log, error)
      if (.not. allocated(error)) call prepare_directory(results, error)
      if (allocated(error)) return

      call checkpoint%begin(results, known)
      call solve_loads(results, known, checkpoint, log)
      if (.not. checkpoint%is_kept()) call log%say('note: not all loads could be written to '// &
                                                   escaped(checkpoint_name(results))//', to resume from')
      call log%say_timed('solved and measured')
      call log%show_loads(results)
      hidden = count(results%states%status == converged .and. &
                     results%states%measures%contact_area_fraction <= 0.0_dp)
      if (hidden > 0) call log%say('note: at '//integer_text(hidden)//' loads no pressure reaches edge_level = '// &
                                   short_number(deck%method%real('edge_level'))// &
                                   ' p*, so that their contact area shows as 0')

      call write_tables(results, error)
      if (allocated(error)) return
      call checkpoint%remove()
      bad = count(.not. results%states%is_good())
      if (bad > 0) status = exit_not_converged
      if (results%scene%p_star <= 0.0_dp) call log%say('the surface is flat: there is only a summary')
      call log%say_timed('tables written')
      call log%say('results: '//escaped(results%directory)//'/'//deck%scene%text('case')//'.summary.dat')
      if (bad == 0) then
         call log%say(deck%scene%text('case')//': all '//integer_text(size(results%states))//' loads solved')
      else
         call log%say(deck%scene%text('case')//': '//integer_text(bad)//' of '//integer_text(size(results%states))// &
                      ' loads NOT solved as asked, see the status column')
      end if
   end subroutine run_scene

   !> Takes the loads that are finished. Errors: exit_bad_input, exit_file_trouble.
   subroutine take_checkpoint(results, known, log, error)
      type(results_type), intent(inout) :: results
      logical, intent(inout) :: known(:)          !! which loads those are
      type(run_log), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      logical :: found

      call read_checkpoint(results, known, found, error)
      if (allocated(error)) return
      if (found) then
         call log%say('resumed   '//integer_text(count(known))//' of '//integer_text(size(known))// &
                      ' loads are in '//escaped(checkpoint_name(results)))
      else
         call log%say('note: there is no '//escaped(checkpoint_name(results))// &
                      ' to resume from: all loads are solved')
      end if
   end subroutine take_checkpoint

   !> Makes the output directory and writes the resolved deck into it, so that file trouble shows before the work.
   subroutine prepare_directory(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(deck_type) :: deck
      character(:), allocatable :: failure
      character(200) :: message
      integer :: status
      type(output_file) :: file

      call make_directories(results%directory, failure)
      if (allocated(failure)) then
         call fatal_error(error, exit_file_trouble, escaped(results%directory)// &
                          ': the output directory cannot be made: '//escaped(failure))
         return
      end if
      call file%open(results%directory, results%deck%scene%text('case')//'.resolved.nml')
      if (file%is_open()) then
         deck = results%deck
         if (allocated(results%scene%map)) call deck%surface_values%set('file', results%scene%map%path)
         call write_resolved_deck(deck, file%unit, status, message)
         if (status /= 0) call file%note_trouble(message)
      end if
      call file%finish(error)
   end subroutine prepare_directory

   !> Writes the tables that the deck asks for. Of a flat surface only the summary: its fields are to be shown in p*
   !> and Delta, which are zero.
   subroutine write_tables(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      call write_summary_table(results, error)
      if (results%scene%p_star <= 0.0_dp) return
      call write_if(results%deck%output%logical('lines'), write_lines_table)
      call write_if(results%deck%output%logical('map'), write_map_table)
      call write_if(results%deck%output%logical('contours'), write_contour_table)
      call write_if(results%deck%output%logical('coefficients'), write_coefficients_table)
      call write_if(results%deck%output%logical('theory'), write_theory_table)
      call write_if(results%deck%output%logical('details'), write_details_table)

   contains

      subroutine write_if(asked, write_table)
         logical, intent(in) :: asked
         procedure(table_writer) :: write_table

         if (asked .and. .not. allocated(error)) call write_table(results, error)
      end subroutine write_if

   end subroutine write_tables

end module wavycon_run_scene
