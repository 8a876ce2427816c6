!> The program: reads all decks, then runs them one after the other.
program wavycon_main
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use wavycon_command_line, only: command_line_type, help_text, read_command_line
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, exit_fine, fatal_error
   use wavycon_output_group, only: plain_directory
   use wavycon_plain_text, only: escaped
   use wavycon_read_deck, only: read_deck
   use wavycon_run_scene, only: run_scene
   use wavycon_scene, only: make_scene, scene_type
   use wavycon_system, only: outlive_file_size_limit
   use wavycon_threads, only: set_threads
   use wavycon_version, only: revision, version
   implicit none (type, external)

   interface
      subroutine c_exit(status) bind(c, name='exit')
         use, intrinsic :: iso_c_binding, only: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   !> A deck that has been checked, and what it describes.
   type :: checked_deck
      type(deck_type) :: deck
      type(scene_type), allocatable :: scene
   end type checked_deck

   type(command_line_type) :: command_line
   type(checked_deck), allocatable :: decks(:)
   type(error_type), allocatable :: error
   integer :: i, status, worst

   call outlive_file_size_limit()
   call read_command_line(command_line, error)
   call stop_on(error)
   if (command_line%help) then
      write (output_unit, '(a)') help_text()
      call finish(exit_fine)
   else if (command_line%version) then
      write (output_unit, '(a)') 'wavycon '//version//' ('//revision//')'
      call finish(exit_fine)
   end if

   call read_decks(command_line, decks)
   if (command_line%check) then
      do i = 1, size(decks)
         if (.not. command_line%quiet) write (output_unit, '(a)') escaped(decks(i)%deck%path)//': the deck is fine'
      end do
      call finish(exit_fine)
   end if

   call set_threads(command_line%threads)
   worst = exit_fine
   do i = 1, size(decks)
      if (i > 1 .and. .not. command_line%quiet) write (output_unit, '(a)') ''
      call run_scene(decks(i)%deck, decks(i)%scene, command_line%quiet, command_line%resume, status, error)
      call stop_on(error)
      worst = max(worst, status)
   end do
   call finish(worst)

contains

   !> Reads all decks before any is run; the problems of all of them are shown.
   subroutine read_decks(command_line, decks)
      type(command_line_type), intent(in) :: command_line
      type(checked_deck), allocatable, intent(out) :: decks(:)

      type(error_type), allocatable :: error
      integer :: i, j, worst

      allocate (decks(size(command_line%decks)))
      worst = exit_fine
      do i = 1, size(decks)
         call read_deck(command_line%decks(i)%path, decks(i)%deck, error)
         if (.not. allocated(error)) then
            allocate (decks(i)%scene)
            call make_scene(decks(i)%deck, decks(i)%scene, error)
         end if
         if (allocated(error)) then
            write (error_unit, '(a)') error%message
            worst = max(worst, error%status)
         end if
      end do
      if (worst /= exit_fine) call finish(worst)

      do i = 1, size(decks)
         if (allocated(command_line%output)) &
            call decks(i)%deck%output%set('directory', plain_directory(command_line%output))
         do j = 1, i - 1
            if (decks(i)%deck%scene%text('case') /= decks(j)%deck%scene%text('case')) cycle
            if (decks(i)%deck%output%text('directory') /= decks(j)%deck%output%text('directory')) cycle
            call fatal_error(error, exit_bad_input, escaped(decks(j)%deck%path)//' and '// &
                             escaped(decks(i)%deck%path)// &
                             ' would write the same files: both are case '//decks(i)%deck%scene%text('case')// &
                             ' in '//escaped(decks(i)%deck%output%text('directory'))//'. Give them different cases.')
            call stop_on(error)
         end do
      end do
   end subroutine read_decks

   !> Ends the program if there is an error.
   subroutine stop_on(error)
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      flush (output_unit)
      write (error_unit, '(a)') 'wavycon: '//error%message
      call finish(error%status)
   end subroutine stop_on

   !> Ends the program without a word, which `stop` does not everywhere.
   subroutine finish(status)
      use, intrinsic :: iso_c_binding, only: c_int
      integer, intent(in) :: status

      flush (output_unit)
      call c_exit(int(status, c_int))
   end subroutine finish

end program wavycon_main
