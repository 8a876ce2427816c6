!> The program: reads all decks, then runs them one after the other.
program wavycon_main
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use wavycon_command_line, only: command_line_type, help_text, read_command_line
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, exit_fine, fatal_error
   use wavycon_make_scene, only: make_scene
   use wavycon_output_group, only: plain_directory
   use wavycon_plain_text, only: escaped
   use wavycon_read_deck, only: read_deck
   use wavycon_run_scene, only: run_scene
   use wavycon_scene, only: scene_type
   use wavycon_system, only: outlive_file_size_limit
   use wavycon_threads, only: set_threads, use_one_thread_for_matrices
   use wavycon_version, only: revision, version
   implicit none (type, external)

   interface
      subroutine c_exit(status) bind(c, name='exit')
         use, intrinsic :: iso_c_binding, only: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   type :: scene_item
      type(scene_type), allocatable :: scene
   end type scene_item

   type(command_line_type) :: command_line
   type(scene_item), allocatable :: scenes(:)
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

   call read_decks(command_line, scenes)
   if (command_line%check) then
      do i = 1, size(scenes)
         if (.not. command_line%quiet) &
            write (output_unit, '(a)') escaped(scenes(i)%scene%deck_path)//': the deck is fine'
      end do
      call finish(exit_fine)
   end if

   call use_one_thread_for_matrices()
   call set_threads(command_line%threads)
   worst = exit_fine
   do i = 1, size(scenes)
      if (i > 1 .and. .not. command_line%quiet) write (output_unit, '(a)') ''
      call run_scene(scenes(i)%scene, command_line%quiet, command_line%resume, status, error)
      call stop_on(error)
      worst = max(worst, status)
   end do
   call finish(worst)

contains

   !> Reads all decks before any is run. Shows the problems of all of them and ends the program if there are any.
   subroutine read_decks(command_line, scenes)
      type(command_line_type), intent(in) :: command_line
      type(scene_item), allocatable, intent(out) :: scenes(:)

      type(deck_type) :: deck
      type(error_type), allocatable :: error
      integer :: i, j, worst

      allocate (scenes(size(command_line%decks)))
      worst = exit_fine
      do i = 1, size(scenes)
         call read_deck(command_line%decks(i)%path, deck, error, command_line%settings)
         if (.not. allocated(error)) then
            if (allocated(command_line%output)) &
               call deck%output%set('directory', plain_directory(command_line%output))
            allocate (scenes(i)%scene)
            call make_scene(deck, scenes(i)%scene, error)
         end if
         if (allocated(error)) then
            write (error_unit, '(a)') error%message
            worst = max(worst, error%status)
         end if
      end do
      if (worst /= exit_fine) call finish(worst)

      do i = 1, size(scenes)
         do j = 1, i - 1
            associate (one => scenes(j)%scene, other => scenes(i)%scene)
               if (one%case /= other%case .or. one%directory /= other%directory) cycle
               call fatal_error(error, exit_bad_input, escaped(one%deck_path)//' and '//escaped(other%deck_path)// &
                                ' would write the same files: both are case '//other%case//' in '// &
                                escaped(other%directory)//'. Give them different cases.')
            end associate
            call stop_on(error)
         end do
      end do
   end subroutine read_decks

   !> Writes the message of an error, if there is one, and ends the program with its status.
   subroutine stop_on(error)
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      flush (output_unit)
      write (error_unit, '(a)') 'wavycon: '//error%message
      call finish(error%status)
   end subroutine stop_on

   !> Ends the program with an exit status. `stop` would write a message with some compilers.
   subroutine finish(status)
      use, intrinsic :: iso_c_binding, only: c_int
      integer, intent(in) :: status

      flush (output_unit)
      call c_exit(int(status, c_int))
   end subroutine finish

end program wavycon_main
