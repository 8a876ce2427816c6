!> A deck from beginning to end: scene, answers, measures, tables.
module wavycon_run_scene
   use wavycon_checkpoint, only: checkpoint_file, checkpoint_name, read_checkpoint
   use wavycon_choose_solver, only: choose_solver
   use wavycon_contact_status, only: converged
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_resolved_deck, only: write_resolved_deck
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: scene_type
   use wavycon_solve_loads, only: solve_loads
   use wavycon_system, only: make_directories
   use wavycon_table, only: table_type
   use wavycon_tables, only: all_tables, table_item
   implicit none (type, external)
   private

   public :: run_scene

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
      type(table_item), allocatable :: tables(:)
      integer :: bad, hidden, i
      logical :: keep_fields

      status = exit_fine
      call log%start(quiet)
      results%deck = deck
      results%directory = trim(deck%output%directory)
      call move_alloc(scene, results%scene)
      call all_tables(tables)
      keep_fields = .false.
      do i = 1, size(tables)
         if (is_requested(tables(i)%table, deck)) keep_fields = keep_fields .or. tables(i)%table%needs_fields()
      end do
      call choose_solver(deck, results%scene, keep_fields, results%solver)
      call log%show_scene(results)
      allocate (results%loads(size(results%scene%target)))
      call resolved_deck_text(results)
      if (resume) call take_checkpoint(results, log, error)
      if (.not. allocated(error)) call prepare_directory(results, error)
      if (allocated(error)) return

      call checkpoint%create(results)
      call solve_loads(results, checkpoint, log)
      if (.not. checkpoint%is_complete()) call log%say('note: not all loads could be written to '// &
                                                   escaped(checkpoint_name(results))//', to resume from')
      call log%say_timed('solved and measured')
      call log%show_loads(results)
      hidden = 0
      bad = 0
      do i = 1, size(results%loads)
         associate (solution => results%loads(i)%solution)
            if (solution%status == converged .and. solution%measures%contact_area_fraction <= 0.0_dp) hidden = hidden + 1
            if (.not. solution%is_good()) bad = bad + 1
         end associate
      end do
      if (hidden > 0) call log%say('note: at '//integer_text(hidden)//' loads no pressure reaches edge_level = '// &
                                   short_number(deck%method%edge_level)// &
                                   ' p*, so that their contact area shows as 0')

      call write_tables(results, error)
      if (allocated(error)) return
      call checkpoint%remove()
      if (bad > 0) status = exit_not_converged
      if (results%scene%p_star <= 0.0_dp) call log%say('the surface is flat: there is only a summary')
      call log%say_timed('tables written')
      call log%say('results: '//escaped(results%directory)//'/'//trim(deck%scene%case)//'.summary.dat')
      if (bad == 0) then
         call log%say(trim(deck%scene%case)//': all '//integer_text(size(results%loads))//' loads solved')
      else
         call log%say(trim(deck%scene%case)//': '//integer_text(bad)//' of '//integer_text(size(results%loads))// &
                      ' loads NOT solved as asked, see the status column')
      end if
   end subroutine run_scene

   !> Takes the loads that are finished. Errors: exit_bad_input, exit_file_trouble.
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
      call file%open(results%directory, trim(results%deck%scene%case)//'.resolved.nml')
      if (file%is_open()) then
         deck = results%deck
         if (allocated(results%scene%map)) deck%surface%file = results%scene%map%path
         call write_resolved_deck(deck, file%unit, status, message)
         if (status /= 0) call file%note_trouble(message)
      end if
      call file%finish(error)
   end subroutine prepare_directory

   !> Whether the deck requests a table.
   logical function is_requested(table, deck)
      class(table_type), intent(in) :: table
      type(deck_type), intent(in) :: deck

      associate (output => deck%output)
         select case (table%key())
         case ('lines')
            is_requested = output%lines
         case ('map')
            is_requested = output%map
         case ('contours')
            is_requested = output%contours
         case ('coefficients')
            is_requested = output%coefficients
         case ('theory')
            is_requested = output%theory
         case ('details')
            is_requested = output%details
         case default
            is_requested = .true.
         end select
      end associate
   end function is_requested

   subroutine resolved_deck_text(results)
      type(results_type), intent(inout) :: results

      character(2000) :: line
      type(deck_type) :: deck
      integer :: status, unit

      deck = results%deck
      deck%path = ''
      deck%output%directory = ''
      results%resolved_deck = ''
      open (newunit=unit, status='scratch', action='readwrite')
      call write_resolved_deck(deck, unit, status)
      rewind (unit)
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         results%resolved_deck = results%resolved_deck//trim(line)//new_line('a')
      end do
      close (unit)
   end subroutine resolved_deck_text

   !> Writes the tables that the deck requests. Errors: exit_file_trouble.
   subroutine write_tables(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(table_item), allocatable :: tables(:)
      integer :: i

      call all_tables(tables)
      do i = 1, size(tables)
         associate (table => tables(i)%table)
            if (.not. is_requested(table, results%deck)) cycle
            if (results%scene%p_star <= 0.0_dp .and. .not. table%is_for_flat_surfaces()) cycle
            call table%write(results, error)
            if (allocated(error)) return
         end associate
      end do
   end subroutine write_tables

end module wavycon_run_scene
