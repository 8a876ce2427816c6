!> The program from its command line to its exit status: reads all decks, then checks or runs them one after the other.
!>
!> In the parallel program all processes do the same, and only the first one writes. An error of one process ends all.
module wavycon_run_program
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char
   use, intrinsic :: iso_fortran_env, only: error_unit
   use wavycon_check_scene, only: check_scene
   use wavycon_checkpoint, only: remove_done
   use wavycon_collected_table, only: check_table_file, collected_deck, list_keys, write_collected_table
   use wavycon_command_line, only: command_line_type, make_help, read_command_line
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_kinds, only: int64
   use wavycon_notes, only: outcome
   use wavycon_plain_text, only: escaped, integer_text
   use wavycon_ranks, only: comm, end_ranks, is_first_rank, share_error
   use wavycon_read_deck, only: parse_deck
   use wavycon_results, only: results_type
   use wavycon_run_scene, only: run_scene
   use wavycon_scene, only: scene_type
   use wavycon_system, only: error_text, full_path, note_kept, prepare_process, print_trouble, remove_leftovers, say, &
      stack_limit
   use wavycon_threads, only: set_threads
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: run_program

   !> The stack that the program needs [byte]. The tables of keys take 100 kB of it, solvers less.
   integer(int64), parameter :: least_stack = 256*1024
   !> A status of at least this number says that a signal ended the process: the number of the signal is the status less
   !> this number.
   integer, parameter :: signal_status = 128
   !> Most jobs that may be begun beyond the first one whose output is not shown yet. Each of them has open files, and
   !> an element of the array in jobs.c.
   integer, parameter :: most_waiting = 100

   !> The jobs of the option --jobs: processes that run a deck each, numbered from 1 (jobs.c). The buffers of Fortran's
   !> units must be flushed before a job is begun or shown, or their content would be printed twice or too late.
   interface
      !> Starts a process for a job, a copy of this process. Returns 1 in the new process, 0 in this one, and -1 if no
      !> process could be made.
      integer(c_int) function begin_job(job) bind(c, name='wavycon_begin_job')
         import :: c_int
         integer(c_int), value :: job
      end function begin_job

      !> Waits until any process of a job ends, and returns the number of the job; 0 if the process was none of a job.
      integer(c_int) function await_job() bind(c, name='wavycon_await_job')
         import :: c_int
      end function await_job

      !> Prints the output of a job that has ended. Returns the job's exit status, or signal_status plus a signal's
      !> number.
      integer(c_int) function show_job(job) bind(c, name='wavycon_show_job')
         import :: c_int
         integer(c_int), value :: job
      end function show_job
   end interface

   interface
      !> C's function that ends the process. gfortran 11 does not know `stop` with `quiet`, without which it prints.
      subroutine end_process(status) bind(c, name='exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine end_process
   end interface

   !> A deck with its scene.
   type, extends(collected_deck) :: scene_item
      type(scene_type), allocatable :: scene      !! not allocated for a bad deck
   end type scene_item

contains

   !> Runs the program from its command line to its exit status, and ends it.
   subroutine run_program()
      character(:), allocatable :: text
      type(command_line_type) :: command_line
      type(scene_item), allocatable :: scenes(:)
      type(error_type), allocatable :: error
      integer :: i, worst
      logical :: quiet

      if (stack_limit() < least_stack) call fatal_error(error, exit_file_trouble, &
         'the limit on the stack is too low: allow '//integer_text(int(least_stack/1024))//' kB (ulimit -s)')
      call stop_on(error)
      call prepare_process()
      call read_command_line(command_line, error)
      if (allocated(comm) .and. nint(command_line%options%jobs%number) > 1 .and. .not. allocated(error)) &
         call fatal_error(error, exit_bad_input, '--jobs is an option of wavycon: mpirun starts the processes here')
      if (allocated(error)) error%message = error%message//new_line('a')//'wavycon --help shows all options'
      call share_error(error)
      call stop_on(error)
      if (command_line%options%version%is_true) then
         text = 'wavycon '//version//' ('//revision//')'
         if (allocated(comm)) text = text//', '//comm%library
      end if
      if (command_line%options%help%is_true) call make_help(command_line, allocated(comm), text, error)
      call stop_on(error)
      if (allocated(text)) then
         if (is_first_rank()) call say(text)
         call finish(exit_fine)
      end if
      quiet = command_line%options%quiet%is_true .or. .not. is_first_rank()

      call read_decks(command_line, scenes, worst)
      associate (options => command_line%options)
         if (is_first_rank() .and. options%table%is_given) &
            call check_table_file(options%table%text, scenes, .not. options%check%is_true, error)
      end associate
      call share_error(error)
      call stop_on(error)
      if (command_line%options%check%is_true) then
         do i = 1, size(scenes)
            if (.not. allocated(scenes(i)%scene)) cycle
            if (i > 1 .and. .not. quiet) call say('')
            call check_scene(scenes(i)%scene, quiet)
         end do
         call finish(worst)
      end if
      call run_scenes(command_line, quiet, scenes, worst)
      call finish(worst)
   end subroutine run_program

   !> Reads all decks before any is run, and shows the problems of all. Problems that runs of a sweep share are shown
   !> once, whatever value of the sweep they name. If there are problems the program ends, unless --keep-going says that
   !> the good decks are to be run.
   subroutine read_decks(command_line, scenes, worst)
      type(command_line_type), intent(in) :: command_line
      type(scene_item), allocatable, intent(out) :: scenes(:)   !! one for each run of the command line
      integer, intent(out) :: worst   !! the worst exit status

      type(error_type), allocatable :: error
      type(deck_text_type) :: text
      character(:), allocatable :: advice
      character(:), allocatable :: problems, shown   ! of one run, with its deck's path; all that were shown
      integer :: i, j
      logical :: is_read

      allocate (scenes(size(command_line%runs)))
      worst = exit_fine
      is_read = .false.
      problems = ''
      shown = ''
      do i = 1, size(scenes)
         if (allocated(error)) deallocate (error)
         scenes(i)%path = command_line%runs(i)%path
         allocate (scenes(i)%scene)
         ! Runs of one deck follow one another. It is read once: standard input could not be read again.
         if (is_read) is_read = text%path == scenes(i)%path
         if (.not. is_read) call read_deck_text(scenes(i)%path, text, error)
         is_read = .not. allocated(error)
         if (is_read) call parse_deck(text, scenes(i)%scene, error, command_line%runs(i)%settings)
         if (allocated(error)) then
            problems = scenes(i)%path//error%message(max(index(error%message, ': error 1 of '), 1):)//new_line('a')
            if (is_first_rank() .and. index(shown, problems) == 0) write (error_unit, '(a)') error%message
            shown = shown//problems
            worst = max(worst, error%status)
            if (command_line%options%table%is_given) &
               call list_keys(scenes(i)%scene, scenes(i)%keys, command_line%runs(i)%settings)
            deallocate (scenes(i)%scene)
         else
            if (command_line%options%table%is_given) call list_keys(scenes(i)%scene, scenes(i)%keys)
            scenes(i)%case = scenes(i)%scene%case
            scenes(i)%loads = size(scenes(i)%scene%target)
            scenes(i)%stem = full_path(scenes(i)%scene%directory)//'/'//scenes(i)%case
         end if
      end do
      if (worst /= exit_fine .and. .not. command_line%options%keep_going%is_true) call finish(worst)
      ! Report scenes that would write the same files.
      do i = 2, size(scenes)
         if (.not. allocated(scenes(i)%scene)) cycle
         do j = 1, i - 1
            if (.not. allocated(scenes(j)%scene)) cycle
            if (scenes(j)%stem == scenes(i)%stem) exit
         end do
         if (j == i) cycle
         associate (one => scenes(j)%scene, other => scenes(i)%scene)
            advice = 'Give them different cases.'
            if (one%deck_path == other%deck_path) advice = 'The deck is given twice.'
            if (command_line%runs(i)%deck == command_line%runs(j)%deck) advice = 'A value stands twice in a sweep.'
            call fatal_error(error, exit_bad_input, escaped(one%deck_path)//' and '//escaped(other%deck_path)// &
                             ' would write the same files: both are case '//other%case//' in '// &
                             escaped(other%directory)//'. '//advice)
         end associate
         if (.not. command_line%options%keep_going%is_true) call stop_on(error)
         call show(error)
         worst = max(worst, error%status)
         deallocate (scenes(i)%scene, scenes(i)%stem, error)
      end do
   end subroutine read_decks

   !> Runs all scenes, and writes the collected table if --table asks for it.
   subroutine run_scenes(command_line, quiet, scenes, worst)
      type(command_line_type), intent(in) :: command_line
      logical, intent(in) :: quiet      !! whether to write nothing but problems
      type(scene_item), intent(inout) :: scenes(:)
      integer, intent(inout) :: worst   !! the worst exit status

      type(error_type), allocatable :: error
      integer :: begun, i, jobs, running, status(size(scenes))
      logical :: has_ended(0:size(scenes))   ! whether each job has ended; job 0 stands for other processes
      logical :: keep_going, with_table

      jobs = nint(command_line%options%jobs%number)
      keep_going = command_line%options%keep_going%is_true
      call set_threads(nint(command_line%options%threads%number))
      with_table = is_first_rank() .and. command_line%options%table%is_given
      do i = 1, size(scenes)
         if (allocated(scenes(i)%scene)) call remove_leftovers(scenes(i)%scene%directory//c_null_char)
      end do
      status = exit_bad_input
      begun = 0
      running = 0
      has_ended = .false.
      do i = 1, size(scenes)
         if (allocated(scenes(i)%stem) .and. jobs == 1) then
            call run_one(i, status(i), error)
            if (.not. keep_going) call stop_on(error)
            call show(error)
         else if (allocated(scenes(i)%stem)) then
            call take_job(i, status(i))
         end if
      end do
      call note_kept(c_null_char)
      worst = max(worst, maxval(status))
      scenes%is_written = status == exit_fine .or. status == exit_not_converged
      if (allocated(error)) deallocate (error)
      if (with_table) call write_collected_table(command_line%options%table%text, scenes%collected_deck, &
                                                 command_line%runs(1)%settings, error)
      call share_error(error)
      if (allocated(error)) worst = max(worst, error%status)
      call show(error)
      if (.not. allocated(error) .and. size(scenes) > 1 .and. is_first_rank()) then
         do i = 1, size(scenes)
            if (scenes(i)%is_written) call remove_done(scenes(i)%stem)
         end do
      end if
      if (.not. keep_going .or. quiet) return
      call say('')
      call say(integer_text(size(scenes))//' decks: '// &
         integer_text(count(status == exit_fine))//' solved, '//integer_text(count(status == exit_not_converged))// &
         ' with loads NOT solved as requested, '//integer_text(count(.not. scenes%is_written))//' failed')

   contains

      !> Runs a scene. Errors: those of run_scene.
      subroutine run_one(i, status, error)
         integer, intent(in) :: i         !! number of the scene
         integer, intent(out) :: status   !! exit_fine, exit_not_converged, or the status of the error
         type(error_type), allocatable, intent(out) :: error

         type(results_type) :: results

         if (i > 1 .and. .not. quiet) call say('')
         call run_scene(scenes(i)%scene, quiet, command_line%options%resume%is_true, size(scenes) > 1, results, &
                        status, error)
         if (allocated(error)) status = error%status
         ! Without --quiet the log says so.
         if (status /= exit_not_converged .or. .not. quiet .or. .not. is_first_rank()) return
         if (allocated(results%loads)) then
            write (error_unit, '(a)') 'wavycon: '//outcome(results)
         else
            write (error_unit, '(a)') 'wavycon: '//scenes(i)%case//': done before, with loads NOT solved as requested'
         end if
      end subroutine run_one

      !> Waits for the job of a scene, a process of its own, and prints its output. Meanwhile jobs of the following
      !> scenes are begun, at most `jobs` at a time. As jobs are taken in the order of the scenes, the output is the
      !> same as if the scenes were run one after the other.
      subroutine take_job(i, status)
         integer, intent(in) :: i         !! number of the scene and of its job
         integer, intent(out) :: status   !! as in run_one

         type(error_type), allocatable :: error
         integer :: side   ! result of begin_job: whether this is the new process

         do
            call note_kept(integer_text(count(has_ended(1:)))//' of '//integer_text(size(scenes))// &
                           ' decks are done'//c_null_char)
            do while (running < jobs .and. begun < min(size(scenes), i + most_waiting))
               begun = begun + 1
               if (.not. allocated(scenes(begun)%stem)) cycle
               flush (error_unit)
               side = begin_job(begun)
               if (side < 0) call fatal_error(error, exit_file_trouble, &
                                              'a process or a temporary file for it cannot be made')
               call stop_on(error)
               if (side > 0) then
                  call run_one(begun, status, error)
                  call show(error)
                  call finish(status)
               end if
               running = running + 1
               deallocate (scenes(begun)%scene)
            end do
            if (has_ended(i)) exit
            has_ended(await_job()) = .true.
            running = running - 1
         end do
         status = show_job(i)
         if (status < signal_status) return
         call fatal_error(error, exit_file_trouble, escaped(scenes(i)%path)// &
                          ': its process was ended by signal '//integer_text(status - signal_status))
         call show(error)
         status = error%status
      end subroutine take_job

   end subroutine run_scenes

   !> Writes the message of an error, if there is one, and ends the program with its status.
   subroutine stop_on(error)
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      call show(error)
      call finish(error%status)
   end subroutine stop_on

   !> Writes the message of an error, if there is one.
   subroutine show(error)
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      if (is_first_rank()) write (error_unit, '(a)') 'wavycon: '//error%message
   end subroutine show

   !> Ends the program with an exit status, which is exit_file_trouble if writing to standard output has failed.
   subroutine finish(status)
      integer, intent(in) :: status

      integer :: last_status

      ! From here on a signal interrupts nothing: mpiexec sends one to the ranks when one of them has ended by an error.
      call note_kept(c_null_char)
      last_status = status
      if (print_trouble() /= 0) then
         write (error_unit, '(a)') 'wavycon: standard output: cannot be written: '//error_text(int(print_trouble()))
         last_status = exit_file_trouble
      end if
      call end_ranks(last_status)
      call end_process(int(last_status, c_int))
   end subroutine finish

end module wavycon_run_program
