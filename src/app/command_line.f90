!> The command line.
module wavycon_command_line
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_reference, only: key_reference
   use wavycon_nearest_name, only: nearest_name
   use wavycon_output_group, only: longest_directory
   use wavycon_plain_text, only: escaped, integer_text, is_printable
   implicit none (type, external)
   private

   public :: command_line_type, read_command_line, help_text

   !> The name of a deck.
   type :: path_type
      character(:), allocatable :: path
   end type path_type

   type :: command_line_type
      type(path_type), allocatable :: decks(:)
      character(:), allocatable :: output   !! directory that replaces the decks'; not allocated if not given
      logical :: check = .false.
      logical :: quiet = .false.
      logical :: version = .false.
      logical :: help = .false.
   end type command_line_type

   character(*), parameter :: options(*) = [character(9) :: '--check', '--output', '--quiet', '--version', '--help']
   character(*), parameter :: usage = 'usage: wavycon DECK... [--check] [--output DIR] [--quiet] [--version] [--help]'

contains

   !> Reads the command line. Errors: exit_bad_input.
   subroutine read_command_line(command_line, error)
      type(command_line_type), intent(out) :: command_line
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: word
      integer :: i, near
      logical :: options_over

      allocate (command_line%decks(0))
      options_over = .false.
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         word = argument(i)
         if (.not. options_over .and. index(word, '--output=') == 1) then
            command_line%output = word(len('--output=') + 1:)
            call check_output(command_line%output, error)
            if (allocated(error)) return
            cycle
         end if
         if (options_over .or. index(word, '-') /= 1) then
            if (word == '') call fatal_error(error, exit_bad_input, 'the name of a deck is empty'//new_line('a')//usage)
            if (allocated(error)) return
            command_line%decks = [command_line%decks, path_type(word)]
            cycle
         end if
         select case (word)
         case ('--')
            options_over = .true.
         case ('--check')
            command_line%check = .true.
         case ('--quiet')
            command_line%quiet = .true.
         case ('--version')
            command_line%version = .true.
         case ('--help', '-h')
            command_line%help = .true.
         case ('--output')
            command_line%output = ''
            if (i < command_argument_count()) then
               i = i + 1
               command_line%output = argument(i)
            end if
            call check_output(command_line%output, error)
            if (allocated(error)) return
         case default
            near = nearest_name(word, options)
            if (near > 0) then
               call fatal_error(error, exit_bad_input, "unknown option '"//escaped(word)//"': did you mean "// &
                                trim(options(near))//'?'//new_line('a')//usage)
            else
               call fatal_error(error, exit_bad_input, "unknown option '"//escaped(word)//"'"//new_line('a')//usage)
            end if
            return
         end select
      end do
      if (size(command_line%decks) == 0 .and. .not. (command_line%version .or. command_line%help)) &
         call fatal_error(error, exit_bad_input, 'no deck is given'//new_line('a')//usage)
   end subroutine read_command_line

   !> Errors: exit_bad_input if it is no directory that a deck could name too.
   subroutine check_output(directory, error)
      character(*), intent(in) :: directory
      type(error_type), allocatable, intent(out) :: error

      if (directory == '' .or. index(directory, '--') == 1) then
         call fatal_error(error, exit_bad_input, '--output needs the name of a directory'//new_line('a')//usage)
      else if (len(directory) > longest_directory) then
         call fatal_error(error, exit_bad_input, '--output: the name of a directory must be at most '// &
                          integer_text(longest_directory)//' bytes long, got '//integer_text(len(directory)))
      else if (.not. is_printable(directory)) then
         call fatal_error(error, exit_bad_input, "--output: the name '"//escaped(directory)// &
                          "' must be ASCII or UTF-8 text without control characters")
      end if
   end subroutine check_output

   function help_text() result(text)
      character(:), allocatable :: text

      character, parameter :: newline = new_line('a')

      text = 'wavycon: elastic contact of regular wavy surfaces, from namelist decks to tables.'//newline// &
             newline// &
             usage//newline// &
             newline// &
             '   --check        validate the decks and stop'//newline// &
             '   --output DIR   write the results there, not where the deck says'//newline// &
             '   --quiet        say nothing but what is wrong'//newline// &
             '   --version      show the version and stop'//newline// &
             '   --help, -h     show this and stop'//newline// &
             newline// &
             'Exit status: 0 fine, 1 bad input, 2 a load did not converge, 3 file trouble.'//newline// &
             newline// &
             key_reference()
   end function help_text

   function argument(i) result(word)
      integer, intent(in) :: i
      character(:), allocatable :: word

      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(length) :: word)
      if (length > 0) call get_command_argument(i, word)
   end function argument

end module wavycon_command_line
