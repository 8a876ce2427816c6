!> Runs a scene, or a deck, from beginning to end: starts the solver, solves all loads, writes the tables. Ranks are the
!> processes of the parallel program.
module wavycon_run_scene
   use wavycon_checkpoint, only: checkpoint_file, checkpoint_name, read_checkpoints
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_file_trouble, exit_fine, fatal_error
   use wavycon_file_bytes, only: read_file
   use wavycon_kinds, only: dp, int64
   use wavycon_methods, only: start_solver, traits_of
   use wavycon_notes, only: show_loads, show_scene, show_stresses, sum_up
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, integer_text, newline, quoted, short_number
   use wavycon_read_deck, only: parse_deck
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: by_percolation, by_pressure, by_yield, scene_type
   use wavycon_settings, only: setting_type
   use wavycon_solve_loads, only: find_interface, find_stresses, note_interface, order_loads, solve_loads
   use wavycon_spot_tables, only: say_percolation
   use wavycon_system, only: full_path, has_memory_for, make_directories
   use wavycon_table, only: table_type
   use wavycon_tables, only: requested_tables
   use wavycon_work_sharing, only: choose_sharing, distributed_grids
   implicit none (type, external)
   private

   public :: run_deck, run_scene, start_results

contains

   !> Runs a scene: starts its solver, decides how the ranks share the work, solves the loads and writes the tables. If
   !> one rank has an error all ranks return it. Errors: exit_bad_input for a checkpoint that is damaged or of another
   !> deck; exit_file_trouble for a file that cannot be read or written.
   subroutine run_scene(scene, quiet, resume, is_one_of_many, results, status, error)
      type(scene_type), allocatable, intent(inout) :: scene   !! not allocated afterwards: the results own it
      logical, intent(in) :: quiet     !! whether to write no log; it must be .true. on all ranks but the first
      logical, intent(in) :: resume    !! whether to continue from the checkpoint of an interrupted run
      !> Whether a checkpoint is to say that this deck is done, until remove_done removes it.
      logical, intent(in) :: is_one_of_many
      !> Complete on the first rank if there is no error; its loads are not allocated if the interrupted run had done
      !> them all.
      type(results_type), intent(out) :: results
      integer, intent(out) :: status   !! exit_fine or exit_not_converged
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: status_of_all(1)   ! sum of the statuses: ranks but the first have 0
      type(run_log), target :: logger
      type(table_type), allocatable :: tables(:)

      status = exit_fine
      call logger%start(quiet)
      call start_results(scene, results, tables)
      call show_scene(results, logger)
      if (results%sharing%kind == distributed_grids) call collect(results, tables, error)
      if (allocated(error)) return
      call results%sharing%work_alone(.not. results%sharing%is_shared)
      if (results%sharing%is_first .or. results%sharing%is_shared) call solve_and_write()
      call results%sharing%work_alone(.false.)
      call results%sharing%share_error(error)
      status_of_all = merge(status, 0, results%sharing%is_first)
      call results%sharing%add(status_of_all)
      status = int(status_of_all(1))

   contains

      !> Solves the loads of a scene and writes its tables.
      subroutine solve_and_write()
         type(checkpoint_file) :: checkpoint
         logical :: known(size(results%scene%target))   ! whether the solution of each load was in the checkpoint
         integer :: status_before   ! exit status of the interrupted run if it had done this deck, else -1

         status_before = -1
         allocate (results%loads(size(known)))
         known = .false.
         call order_loads(results)
         if (resume) call take_checkpoint(results, known, status_before, logger, error)
         status = max(status_before, exit_fine)
         if (allocated(error)) return
         if (status_before >= 0) then
            deallocate (results%loads)
            return
         end if
         if (results%sharing%is_first) call prepare_directory(results%scene, error)
         call results%sharing%share_error(error)
         if (allocated(error)) return

         call checkpoint%create(results, known)
         call solve_loads(results, known, checkpoint, logger)
         if (results%sharing%any(.not. checkpoint%is_complete)) call logger%note( &
            'not all loads could be written to '//escaped(checkpoint_name(results))//', to resume from')
         call logger%say_timed('solved and measured')
         call show_loads(results, logger)
         call write_results(results, tables, logger, error)
         if (allocated(error)) return
         call logger%say_timed('tables written')
         call sum_up(results, logger, status)
         call checkpoint%finish(results, status, is_one_of_many)
      end subroutine solve_and_write

   end subroutine run_scene

   !> Runs a deck as the program does: solves its loads and writes its tables. Errors: those of the program for a bad
   !> deck, a bad height map or files that cannot be written.
   !>
   !> N.B. As in the program, SIGINT, SIGTERM and SIGHUP remove an unfinished file and end the process, unless the
   !> process handles the signal itself.
   subroutine run_deck(path, directory, quiet, status, error)
      character(*), intent(in) :: path        !! path of the deck
      character(*), intent(in) :: directory   !! directory of the tables; '': the one that the deck names
      logical, intent(in) :: quiet            !! whether to write no log to standard output
      integer, intent(out) :: status          !! the program's exit status: exit_fine, exit_not_converged or the error's
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text
      type(results_type) :: results
      type(scene_type), allocatable :: scene
      type(setting_type), allocatable :: settings(:)   ! if not allocated, the optional argument is absent

      if (directory /= '') then
         allocate (settings(1))
         settings(1)%group = 'output'
         settings(1)%key = 'directory'
         settings(1)%value = quoted(directory)   ! gfortran loses memory where a constructor calls the function
      end if
      status = exit_fine
      allocate (scene)
      call read_deck_text(path, text, error)
      if (.not. allocated(error)) call parse_deck(text, scene, error, settings)
      if (.not. allocated(error)) call run_scene(scene, quiet, .false., .false., results, status, error)
      if (allocated(error)) status = error%status
   end subroutine run_deck

   !> Finds the largest stresses and writes the tables. If grids are distributed over the ranks, all ranks together
   !> write some of the tables first. For the other tables the first rank then collects the fields of all ranks and
   !> works alone. Errors: exit_file_trouble.
   subroutine write_results(results, tables, logger, error)
      type(results_type), intent(inout) :: results   !! with a solution for each load
      type(table_type), intent(in) :: tables(:)
      type(run_log), intent(inout) :: logger
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: subjects(2) = ['slip    ', 'adhesion']   ! what &interface may ask for
      logical :: are_distributed, by_all(size(tables))
      integer :: i

      are_distributed = results%sharing%kind == distributed_grids
      by_all = .false.
      if (are_distributed) then
         by_all = [(tables(i)%is_written_by_all(results), i=1, size(tables))]
         do i = 1, size(tables)
            if (by_all(i)) call tables(i)%write(results, error)
            call results%sharing%share_error(error)
            if (allocated(error)) return
         end do
         call collect(results, tables, error)
         if (allocated(error)) return
         call results%sharing%work_alone(.true.)
      end if
      if (results%sharing%is_first .or. .not. are_distributed) then
         if (asks_for_largest(results%scene)) then
            call find_stresses(results, logger)
            call logger%say_timed('largest stresses found')
            call show_stresses(results, logger)
         end if
         if (allocated(results%scene%interface_setting)) then
            do i = 1, size(subjects)
               call find_interface(results, logger, subjects(i))
               call note_interface(results, logger, subjects(i))
            end do
         end if
         if (any(tables%file == 'spots')) call say_percolation(results, logger)
      end if
      do i = 1, size(tables)
         if (results%sharing%is_first .and. .not. (by_all(i) .or. allocated(error))) &
            call tables(i)%write(results, error)
      end do
      if (are_distributed) call results%sharing%work_alone(.false.)
      call results%sharing%share_error(error)
   end subroutine write_results

   !> Whether the deck asks for the largest stresses.
   logical function asks_for_largest(scene)
      type(scene_type), intent(in) :: scene

      asks_for_largest = allocated(scene%stress_setting) .and. scene%p_star > 0.0_dp .and. scene%stress%largest%is_true
   end function asks_for_largest

   !> Starts the solver of a scene, selects the tables to write, if any are, and decides how the ranks share the work.
   subroutine start_results(scene, results, tables, with_fields)
      type(scene_type), allocatable, intent(inout) :: scene       !! not allocated afterwards: the results own it
      type(results_type), intent(out) :: results                  !! without solutions yet
      type(table_type), allocatable, intent(out), optional :: tables(:)   !! the tables to write; absent: none
      !> Whether solutions keep their fields. Absent: they do if a table needs them. In a search for a load of yield
      !> or percolation they always do.
      logical, intent(in), optional :: with_fields

      character(:), allocatable :: description
      logical :: for_tables   ! whether a table needs fields

      call move_alloc(scene, results%scene)
      associate (scene => results%scene)
         for_tables = .false.
         if (present(tables)) then
            results%traits = traits_of(scene%method%solver%text)
            call requested_tables(scene, results%traits, scene%surface, tables)
            for_tables = any(tables%needs_fields)
            results%keeps_fields = for_tables .or. asks_for_largest(scene)
         end if
         if (present(with_fields)) results%keeps_fields = with_fields
         results%keeps_fields = results%keeps_fields .or. any(scene%loads_by == [by_yield, by_percolation])
         call start_solver(scene%surface, scene%method, results%keeps_fields, results%solver, description)
         results%method = scene%method%solver%text//', '//description
         results%traits = results%solver%traits()
         results%sharing = choose_sharing(results%traits, size(scene%target), for_tables, &
                                          any(scene%loads_by == [by_yield, by_percolation]) .or. &
                                          allocated(scene%interface_setting) .or. scene%surface%has_free_edges)
      end associate
      deallocate (results%scene%surface)
      if (results%sharing%kind /= distributed_grids) &
         call results%solver%surface%shape%gather(first_only=.not. results%sharing%is_shared)
   end subroutine start_results

   !> Reads the solutions in the checkpoint, if there is one. Errors: those of read_checkpoints.
   subroutine take_checkpoint(results, known, status, logger, error)
      type(results_type), intent(inout) :: results   !! gets the solutions
      logical, intent(out) :: known(:)               !! whether each load need not be solved again
      integer, intent(out) :: status                 !! exit status of a deck that is done; -1 if it is not
      type(run_log), intent(inout) :: logger
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: name
      integer(int64) :: ranks_that_know(size(known))

      call read_checkpoints(results, known, status, name, error)
      call results%sharing%share_error(error)
      if (allocated(error)) return
      ranks_that_know = merge(1_int64, 0_int64, known)
      call results%sharing%add(ranks_that_know)
      ! A load on a distributed grid is known if all ranks have their columns. At the interruption some may have had
      ! them and others not.
      if (results%sharing%kind == distributed_grids) then
         ranks_that_know = ranks_that_know/results%sharing%ranks
         known = ranks_that_know > 0
      end if
      if (status == exit_fine) then
         call logger%say('resumed: this deck is done')
      else if (status > exit_fine) then
         call logger%say('resumed: this deck is done, with loads NOT solved as requested')
      else if (allocated(name)) then
         call logger%say('resumed: '//integer_text(count(ranks_that_know > 0))//' of '//integer_text(size(known))// &
                         ' loads are in '//escaped(name))
      else
         call logger%note('there is no '//escaped(checkpoint_name(results))//' to resume from: all loads are solved')
      end if
      ! A load that is searched for has digits that depend on the load solved before: solve all of them again, so that a
      ! resumed run gives the same digits.
      if (results%scene%loads_by /= by_pressure .and. results%traits%continues_last_load) known = .false.
   end subroutine take_checkpoint

   !> Makes the output directory and writes the resolved deck into it. So a directory into which nothing can be written
   !> is reported before the loads are solved. Errors: exit_file_trouble.
   subroutine prepare_directory(scene, error)
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: failure, path, text
      type(output_file) :: file

      call make_directories(scene%directory, failure)
      if (allocated(failure)) then
         call fatal_error(error, exit_file_trouble, escaped(scene%directory)// &
                          ': the output directory cannot be made: '//escaped(failure))
         return
      end if
      path = scene%directory//'/'//scene%case//'.resolved.nml'
      ! If the deck is itself the resolved deck that would be written, with the same values, it stays. The first lines
      ! are not compared: they name different decks.
      if (full_path(path) == full_path(scene%deck_path)) then
         call read_file(scene%deck_path, huge(0), text, error)
         if (allocated(error)) return
         if (text(index(text, newline):) == scene%resolved_deck(index(scene%resolved_deck, newline):)//newline) return
      end if
      call file%open(path)
      call file%put(scene%resolved_deck)
      call file%finish(error)
   end subroutine prepare_directory

   !> Collects on the first rank the distributed fields and the distributed surface, as far as tables need them that the
   !> first rank writes alone. Called before the loads are solved, the procedure only checks that the first rank has
   !> enough memory, provided that the deck gives the grid. Errors, on all ranks: exit_file_trouble if the first rank
   !> does not have enough memory.
   subroutine collect(results, tables, error)
      type(results_type), intent(inout) :: results   !! with the started solver; `loads` may not be allocated yet
      type(table_type), intent(in) :: tables(:)      !! the tables to write
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: bytes_of_number = storage_size(1.0_dp)/8
      integer :: i, load
      integer(int64) :: numbers
      logical :: by_first(size(tables)), needs_fields, needs_surface

      by_first = [(.not. tables(i)%is_written_by_all(results), i=1, size(tables))]
      needs_fields = any(tables%needs_fields .and. by_first) .or. asks_for_largest(results%scene)
      needs_surface = any(tables%needs_surface .and. by_first)
      numbers = 0
      if (needs_fields .and. allocated(results%loads)) then
         numbers = sum([(results%loads(load)%distributed_points(), load=1, size(results%loads))])
      else if (needs_fields) then
         numbers = size(results%scene%target)*product(int(results%traits%given_grid, int64))
      end if
      ! The surface takes the memory of its series, and twice as much more while the series is gathered.
      if (needs_surface .and. results%solver%surface%is_distributed()) &
         numbers = numbers + 3*product(int(results%solver%surface%points, int64)/results%solver%surface%maps_in_cell())
      if (.not. has_memory_for(numbers) .and. results%sharing%is_first) call fatal_error(error, exit_file_trouble, &
         'the first rank has too little memory for the tables: the whole fields of all loads, and the surface, '// &
         'take '//short_number(real(bytes_of_number*numbers, dp)/1e9_dp)//' GB. Leave out tables but the '// &
         "summary, a map with map_format = 'npy' and the points of the grid, and the heights, or solve fewer loads")
      call results%sharing%share_error(error)
      if (allocated(error) .or. .not. allocated(results%loads)) return
      if (needs_fields) then
         do load = 1, size(results%loads)
            call results%loads(load)%collect_fields()
         end do
      end if
      if (needs_surface) call results%solver%surface%shape%gather(first_only=.true.)
   end subroutine collect

end module wavycon_run_scene
