!> Reads the command line; the texts of --help.
module wavycon_command_line
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_reference, only: key_reference
   use wavycon_nearest_name, only: nearest_name
   use wavycon_output_group, only: longest_directory
   use wavycon_plain_text, only: escaped, integer_text, is_printable
   implicit none (type, external)
   private

   public :: command_line_type, read_command_line, help_text

   !> The path of a deck.
   type :: path_type
      character(:), allocatable :: path
   end type path_type

   type :: command_line_type
      type(path_type), allocatable :: decks(:)
      character(:), allocatable :: output   !! directory in place of that of the decks; not allocated if not given
      integer :: threads = 1                !! >= 1
      logical :: check = .false.
      logical :: quiet = .false.
      logical :: resume = .false.
      logical :: version = .false.
      logical :: help = .false.
   end type command_line_type

   character(*), parameter :: options(*) = [character(9) :: '--check', '--output', '--resume', '--threads', &
      '--quiet', '--version', '--help']
   character(*), parameter :: usage = &
      'usage: wavycon DECK... [--check] [--output DIR] [--resume] [--threads N] [--quiet] [--version] [--help]'

contains

   !> Reads the command line. Errors: exit_bad_input for an unknown option, a bad value of one, or no deck.
   subroutine read_command_line(command_line, error)
      type(command_line_type), intent(out) :: command_line
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: given, value, word
      integer :: equals, i, near
      logical :: options_over

      allocate (command_line%decks(0))
      options_over = .false.
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         word = argument(i)
         if (options_over .or. index(word, '-') /= 1) then
            if (word == '') call fatal_error(error, exit_bad_input, 'the name of a deck is empty'//new_line('a')// &
                                             usage)
            if (allocated(error)) return
            call add_deck(command_line%decks, word)
            cycle
         end if
         equals = index(word, '=')
         if (equals > 0) then
            if (any(word(:equals - 1) == [character(9) :: '--output', '--threads'])) then
               given = word(equals + 1:)
               word = word(:equals - 1)
            end if
         end if
         select case (word)
         case ('--')
            options_over = .true.
         case ('--check')
            command_line%check = .true.
         case ('--quiet')
            command_line%quiet = .true.
         case ('--resume')
            command_line%resume = .true.
         case ('--version')
            command_line%version = .true.
         case ('--help', '-h')
            command_line%help = .true.
         case ('--output', '--threads')
            call take_value(value)
            if (word == '--output') then
               command_line%output = value
               call check_output(command_line%output, error)
            else
               call read_threads(value, command_line%threads, error)
            end if
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

   contains

      !> The value of an option: the text after '=', otherwise the next word; empty if there is none.
      subroutine take_value(text)
         character(:), allocatable, intent(out) :: text

         text = ''
         if (allocated(given)) then
            call move_alloc(given, text)
         else if (i < command_argument_count()) then
            i = i + 1
            text = argument(i)
         end if
      end subroutine take_value

   end subroutine read_command_line

   !> Reads the value of --threads. Errors: exit_bad_input if it is not an integer from 1 to most_threads.
   subroutine read_threads(text, threads, error)
      character(*), intent(in) :: text
      integer, intent(out) :: threads
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most_threads = 1024, longest = 4
      integer :: status

      threads = 0
      status = 1
      if (text /= '' .and. len(text) <= longest .and. verify(text, '0123456789') == 0) &
         read (text, *, iostat=status) threads
      if (status /= 0 .or. threads < 1 .or. threads > most_threads) &
         call fatal_error(error, exit_bad_input, "--threads needs a number from 1 to "// &
                          integer_text(most_threads)//", got '"//escaped(text)//"'"//new_line('a')//usage)
   end subroutine read_threads

   !> Adds the path of a deck.
   !>
   !> N.B. decks = [decks, path_type(word)] leaks memory: gfortran 12 does not free the paths of the temporary array.
   pure subroutine add_deck(decks, path)
      type(path_type), allocatable, intent(inout) :: decks(:)
      character(*), intent(in) :: path

      type(path_type), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(decks) + 1))
      do i = 1, size(decks)
         call move_alloc(decks(i)%path, longer(i)%path)
      end do
      longer(size(longer))%path = path
      call move_alloc(longer, decks)
   end subroutine add_deck

   !> Checks the value of --output as the key `directory` of a deck is checked. Errors: exit_bad_input.
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

   !> The text of --help: the options, then the reference of all keys.
   function help_text() result(text)
      character(:), allocatable :: text

      character, parameter :: newline = new_line('a')

      text = 'wavycon: elastic contact of regular wavy surfaces, from namelist decks to tables.'//newline// &
             newline// &
             usage//newline// &
             newline// &
             '   --check        validate the decks and stop'//newline// &
             '   --output DIR   write the results to DIR, not to the directory of &output'//newline// &
             '   --resume       continue an interrupted run, to the same tables. Loads that were solved'//newline// &
             '                  on grids are read from <case>.checkpoint; loads of the other solvers are'//newline// &
             '                  fast and are solved again'//newline// &
             '   --threads N    work on large grids with N threads; 1 if not given'//newline// &
             '   --quiet        write nothing but errors'//newline// &
             '   --version      show the version and stop'//newline// &
             '   --help, -h     show this and stop'//newline// &
             newline// &
             'Exit status: 0 fine, 1 bad input, 2 a load did not converge, 3 file trouble.'//newline// &
             newline// &
             key_reference()
   end function help_text

   !> A word of the command line, of any length.
   function argument(i) result(word)
      integer, intent(in) :: i
      character(:), allocatable :: word

      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(length) :: word)
      if (length > 0) call get_command_argument(i, word)
   end function argument

end module wavycon_command_line
