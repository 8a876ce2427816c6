!> Runs a scene from beginning to end: starts the solver, solves all loads, writes the tables.
module wavycon_run_scene
   use wavycon_checkpoint, only: checkpoint_file, checkpoint_name, read_checkpoint
   use wavycon_contact_measures, only: is_known
   use wavycon_contact_status, only: converged, not_found, unresolved
   use wavycon_error, only: error_type, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_find_stresses, only: find_stresses
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, integer_text
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: by_yield, scene_type
   use wavycon_solve_loads, only: solve_loads
   use wavycon_solver_list, only: start_solver
   use wavycon_system, only: make_directories
   use wavycon_tables, only: all_tables, table_item
   implicit none (type, external)
   private

   public :: run_scene, start_results, need_fields

contains

   !> Runs a scene. Errors: exit_bad_input for a checkpoint that is damaged or of another deck; exit_file_trouble for
   !> a file that cannot be read or written.
   subroutine run_scene(scene, quiet, resume, results, status, error)
      type(scene_type), allocatable, intent(inout) :: scene   !! not allocated afterwards: the results own it
      logical, intent(in) :: quiet     !! whether to write no log
      logical, intent(in) :: resume    !! whether to continue from the checkpoint of an interrupted run
      type(results_type), intent(out) :: results   !! complete if there is no error
      integer, intent(out) :: status   !! exit_fine or exit_not_converged
      type(error_type), allocatable, intent(out) :: error

      type(run_log), target :: log
      type(checkpoint_file) :: checkpoint
      type(table_item), allocatable :: tables(:)

      status = exit_fine
      call log%start(quiet)
      call start_results(scene, results, tables)
      call log%show_scene(results)
      allocate (results%loads(size(results%scene%target)))
      if (resume) call take_checkpoint(results, log, error)
      if (.not. allocated(error)) call prepare_directory(results%scene, error)
      if (allocated(error)) return

      call checkpoint%create(results)
      call solve_loads(results, checkpoint, log)
      if (.not. checkpoint%is_complete()) call log%say('note: not all loads could be written to '// &
                                                       escaped(checkpoint_name(results))//', to resume from')
      call log%say_timed('solved and measured')
      call log%show_loads(results)
      if (asks_for_largest(results%scene)) then
         call find_stresses(results, log)
         call log%say_timed('largest stresses found')
         call log%show_stresses(results)
      end if
      call write_tables(results, tables, error)
      if (allocated(error)) return
      call checkpoint%remove()
      call log%say_timed('tables written')
      call sum_up(results, log, status)
   end subroutine run_scene

   !> Whether the deck asks for the largest stresses.
   logical function asks_for_largest(scene)
      type(scene_type), intent(in) :: scene

      asks_for_largest = allocated(scene%stress_setting) .and. scene%p_star > 0.0_dp
      if (asks_for_largest) asks_for_largest = scene%stress%logical('largest')
   end function asks_for_largest

   !> Starts the solver of a scene and finds its tables.
   subroutine start_results(scene, results, tables)
      type(scene_type), allocatable, intent(inout) :: scene       !! not allocated afterwards: the results own it
      type(results_type), intent(out) :: results                  !! without loads
      type(table_item), allocatable, intent(out) :: tables(:)     !! that are to be written

      call move_alloc(scene, results%scene)
      call requested_tables(results%scene, tables)
      associate (scene => results%scene)
         call start_solver(scene%surface, scene%method, need_fields(tables) .or. scene%loads_by == by_yield, &
                           results%solver)
      end associate
   end subroutine start_results

   !> The tables that a deck requests; for a flat surface, whose p* and Delta are zero, only those that allow it.
   subroutine requested_tables(scene, tables)
      type(scene_type), intent(in) :: scene
      type(table_item), allocatable, intent(out) :: tables(:)

      type(table_item), allocatable :: every(:)
      logical, allocatable :: requested(:)
      integer :: i, k

      call all_tables(every)
      allocate (requested(size(every)))
      do i = 1, size(every)
         requested(i) = every(i)%table%is_requested(scene)
         if (scene%p_star <= 0.0_dp) requested(i) = requested(i) .and. every(i)%table%is_for_flat_surfaces()
      end do
      allocate (tables(count(requested)))
      k = 0
      do i = 1, size(every)
         if (.not. requested(i)) cycle
         k = k + 1
         call move_alloc(every(i)%table, tables(k)%table)
      end do
   end subroutine requested_tables

   !> Whether any of the tables is made from fields, edges or details.
   pure logical function need_fields(tables)
      type(table_item), intent(in) :: tables(:)

      integer :: i

      need_fields = .false.
      do i = 1, size(tables)
         need_fields = need_fields .or. tables(i)%table%needs_fields()
      end do
   end function need_fields

   !> Reads the solutions in the checkpoint, if there is one. Errors: exit_bad_input, exit_file_trouble.
   subroutine take_checkpoint(results, log, error)
      type(results_type), intent(inout) :: results
      type(run_log), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error

      logical :: found
      integer :: i, known

      call read_checkpoint(results, found, error)
      if (allocated(error)) return
      if (found) then
         known = count([(allocated(results%loads(i)%solution), i=1, size(results%loads))])
         call log%say('resumed   '//integer_text(known)//' of '//integer_text(size(results%loads))// &
                      ' loads are in '//escaped(checkpoint_name(results)))
      else
         call log%say('note: there is no '//escaped(checkpoint_name(results))// &
                      ' to resume from: all loads are solved')
      end if
   end subroutine take_checkpoint

   !> Makes the output directory and writes the resolved deck into it, so that a directory that cannot be written to is
   !> reported before the loads are solved. Errors: exit_file_trouble.
   subroutine prepare_directory(scene, error)
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: failure
      type(output_file) :: file

      call make_directories(scene%directory, failure)
      if (allocated(failure)) then
         call fatal_error(error, exit_file_trouble, escaped(scene%directory)// &
                          ': the output directory cannot be made: '//escaped(failure))
         return
      end if
      call file%open(scene%directory, scene%case//'.resolved.nml')
      call file%put(scene%resolved_deck)
      call file%finish(error)
   end subroutine prepare_directory

   !> Writes the tables. Errors: exit_file_trouble.
   subroutine write_tables(results, tables, error)
      type(results_type), intent(in) :: results
      type(table_item), intent(in) :: tables(:)
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(tables)
         call tables(i)%table%write(results, error)
         if (allocated(error)) return
      end do
   end subroutine write_tables

   !> Writes the last lines of the log and finds the exit status.
   subroutine sum_up(results, log, status)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log
      integer, intent(out) :: status

      character(:), allocatable :: loads
      integer :: bad, i, unreached, without_area

      bad = 0
      without_area = 0
      do i = 1, size(results%loads)
         associate (solution => results%loads(i)%solution)
            if (.not. solution%is_good()) bad = bad + 1
            if (solution%status == converged .and. solution%measures%contact_area_fraction <= 0.0_dp) &
               without_area = without_area + 1
         end associate
      end do
      unreached = count([(results%loads(i)%solution%status == not_found, i=1, size(results%loads))])
      loads = integer_text(size(results%loads))
      associate (scene => results%scene)
         call note_unresolved(results, log)
         if (without_area > 0) call log%say('note: at '//integer_text(without_area)//' loads '// &
                                            results%solver%why_no_area()//', so that their contact area shows as 0')
         if (scene%loads_by == by_yield .and. .not. results%solver%has_error_estimates()) call log%say( &
            "note: solver = '"//results%solver%name()//"' estimates no errors; a light load of first yield may be "// &
            "wrong by a factor of 2. solver = 'auto' estimates them")
         if (scene%loads_by == by_yield .and. unreached > 0) call log%say('note: for '//integer_text(unreached)// &
            ' loads no mean pressure was found that brings the stresses to the given part of the yield stress')
         if (scene%p_star <= 0.0_dp) call log%say('the surface is flat: there is only a summary')
         call log%say('results: '//escaped(scene%directory)//'/'//scene%case//'.summary.dat')
         if (bad == 0) then
            call log%say(scene%case//': all '//loads//' loads solved')
         else
            call log%say(scene%case//': '//integer_text(bad)//' of '//loads// &
                         ' loads NOT solved as requested, see the status column')
         end if
      end associate
      status = merge(exit_fine, exit_not_converged, bad == 0)
   end subroutine sum_up

   !> Says which values have no error estimate and which are no larger than theirs, and what helps.
   subroutine note_unresolved(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      character(*), parameter :: names(*) = [character(17) :: 'the mean gap', 'the contact area', 'the peak pressure']
      character(:), allocatable :: loads, words
      integer :: coarse(3), i, listed, unknown

      coarse = 0
      unknown = 0
      do i = 1, size(results%loads)
         associate (solution => results%loads(i)%solution)
            if (solution%status /= unresolved) cycle
            if (any(is_known(solution%measures%errors()))) then
               coarse = coarse + merge(0, 1, solution%measures%are_resolved())
            else
               unknown = unknown + 1
            end if
         end associate
      end do
      loads = ' of '//integer_text(size(results%loads))//' loads'
      if (unknown > 0) call log%say('note: the errors of '//integer_text(unknown)//loads//' are unknown: a grid has'// &
         ' error estimates if its points are multiples of 4, from 64 a side. Give such grid_points, or an accuracy')
      if (all(coarse == 0)) return
      words = ''
      listed = 0
      do i = 1, size(names)
         if (coarse(i) == 0) cycle
         listed = listed + 1
         if (listed > 1 .and. listed == count(coarse > 0)) then
            words = words//' and'
         else if (listed > 1) then
            words = words//','
         end if
         words = words//' '//trim(names(i))//' at '//integer_text(coarse(i))
      end do
      call log%say('note: the grid is too coarse for'//words//loads//': the error is as large as the value, or '// &
                   'unknown. Give an accuracy, or more grid_points')
   end subroutine note_unresolved

end module wavycon_run_scene
