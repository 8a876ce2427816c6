!> Reads the command line; the texts of --help.
module wavycon_command_line
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_reference, only: add_wrapped, key_reference
   use wavycon_nearest_name, only: nearest_name
   use wavycon_output_group, only: longest_directory
   use wavycon_plain_text, only: escaped, integer_text, is_printable, newline, quoted
   use wavycon_settings, only: read_setting, setting_type
   implicit none (type, external)
   private

   public :: command_line_type, command_to_resume, read_command_line, help_text

   !> A deck, with keys set in place of its own.
   type :: run_type
      character(:), allocatable :: path
      type(setting_type), allocatable :: settings(:)
   end type run_type

   !> The values of an option --sweep.
   type :: sweep_type
      type(setting_type), allocatable :: values(:)
   end type sweep_type

   type :: command_line_type
      type(run_type), allocatable :: runs(:)   !! the decks, each with all combinations of the values of --sweep
      character(:), allocatable :: output   !! directory in place of that of the decks; not allocated if not given
      character(:), allocatable :: table    !! file for one table of all decks; not allocated if not given
      integer :: jobs = 1                   !! processes at a time, >= 1
      integer :: threads = 1                !! >= 1
      logical :: check = .false.
      logical :: keep_going = .false.
      logical :: quiet = .false.
      logical :: resume = .false.
      logical :: version = .false.
      logical :: help = .false.
   end type command_line_type

   !> An option, as --help has it.
   type :: option_type
      character(12) :: name
      character(27) :: value       !! what follows it; empty: nothing
      character(440) :: meaning
   end type option_type

   type(option_type), parameter :: options(*) = [ &
      option_type('--check', '', 'validate the decks, say what a run would do, and stop'), &
      option_type('--set', 'GROUP.KEY=VALUE', 'set a key in place of those of the decks, such as '// &
         'surface.amplitude=2e-6 or load.pbar_over_pstar=0.1,0.2; may be repeated. Keys of the deck that '// &
         'contradict it are left out: other ways to give the loads or the stiffness, accuracy or grid_points, keys '// &
         'of another kind of surface or solver. The name of the case gets key and value, unless scene.case is set '// &
         'too'), &
      option_type('--sweep', 'GROUP.KEY=VALUE,...', 'run each deck once for each value, as with --set; several '// &
         'sweeps: for all combinations'), &
      option_type('--output', 'DIR', 'write the results to DIR, not to the directory of &output'), &
      option_type('--table', 'FILE', 'write one table of all decks: a row for each deck and load, with the values '// &
         'of the keys that are set or differ, and the columns of the summary'), &
      option_type('--keep-going', '', 'a bad deck does not keep the others from being run'), &
      option_type('--resume', '', 'continue an interrupted run, to the same tables. Loads that were solved on '// &
         'grids are read from <case>.checkpoint; loads of the other solvers are fast and are solved again'), &
      option_type('--jobs', 'N', 'run N decks at a time, each in a process of its own; 1 if not given'), &
      option_type('--threads', 'N', 'work on large grids with N threads; 1 if not given'), &
      option_type('--quiet', '', 'write nothing but errors'), &
      option_type('--version', '', 'show the version and stop'), &
      option_type('--help', '', 'show this and stop')]
   integer, parameter :: most_runs = 100000

contains

   !> Reads the command line. Errors: exit_bad_input for an unknown option, a bad value of one, or no deck.
   subroutine read_command_line(command_line, error)
      type(command_line_type), intent(out) :: command_line
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: given, trouble, value, word
      type(run_type) :: deck(command_argument_count())
      type(setting_type) :: setting(size(deck))
      type(sweep_type) :: sweep(size(deck))
      integer :: decks, equals, i, near, settings, sweeps
      logical :: options_over

      decks = 0
      settings = 0
      sweeps = 0
      options_over = .false.
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         word = argument(i)
         if (options_over .or. index(word, '-') /= 1) then
            if (word == '') call fatal_error(error, exit_bad_input, 'the name of a deck is empty')
            if (allocated(error)) return
            decks = decks + 1
            deck(decks)%path = word
            cycle
         end if
         equals = index(word, '=')
         if (equals > 0) then
            if (any(word(:equals - 1) == options%name .and. options%value /= '')) then
               given = word(equals + 1:)
               word = word(:equals - 1)
            end if
         end if
         select case (word)
         case ('--')
            options_over = .true.
         case ('--check')
            command_line%check = .true.
         case ('--keep-going')
            command_line%keep_going = .true.
         case ('--quiet')
            command_line%quiet = .true.
         case ('--resume')
            command_line%resume = .true.
         case ('--version')
            command_line%version = .true.
         case ('--help', '-h')
            command_line%help = .true.
         case ('--set')
            call take_value(value)
            settings = settings + 1
            call read_setting(value, setting(settings), trouble)
            if (allocated(trouble)) call fatal_error(error, exit_bad_input, trouble)
         case ('--sweep')
            call take_value(value)
            sweeps = sweeps + 1
            call read_sweep(value, sweep(sweeps)%values, error)
         case ('--output')
            call take_value(command_line%output)
            call check_path(word, 'a directory', command_line%output, error)
         case ('--table')
            call take_value(command_line%table)
            call check_path(word, 'a file', command_line%table, error)
         case ('--threads')
            call take_value(value)
            call read_number('--threads', value, command_line%threads, error)
         case ('--jobs')
            call take_value(value)
            call read_number('--jobs', value, command_line%jobs, error)
         case default
            near = nearest_name(word, options%name)
            value = ''
            if (near > 0) value = ': did you mean '//trim(options(near)%name)//'?'
            call fatal_error(error, exit_bad_input, "unknown option '"//escaped(word)//"'"//value)
         end select
         if (allocated(error)) return
      end do
      if (decks == 0 .and. .not. (command_line%version .or. command_line%help)) then
         call fatal_error(error, exit_bad_input, 'no deck is given')
      else
         if (allocated(command_line%output)) then
            settings = settings + 1
            setting(settings) = setting_type('output', 'directory', quoted(command_line%output))
         end if
         call make_runs(deck(:decks), setting(:settings), sweep(:sweeps), command_line%runs, error)
      end if

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

   !> Reads the value of --threads or --jobs. Errors: exit_bad_input if it is not an integer from 1 to `most`.
   subroutine read_number(option, text, number, error)
      character(*), intent(in) :: option, text
      integer, intent(out) :: number
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most = 1024, longest = 4
      integer :: status

      number = 0
      status = 1
      if (text /= '' .and. len(text) <= longest .and. verify(text, '0123456789') == 0) &
         read (text, *, iostat=status) number
      if (status /= 0 .or. number < 1 .or. number > most) &
         call fatal_error(error, exit_bad_input, option//' needs a number from 1 to '//integer_text(most)// &
                          ", got '"//escaped(text)//"'")
   end subroutine read_number

   !> Reads the value of --sweep: a setting for each of its values, which commas outside of quotes separate. Errors:
   !> exit_bad_input.
   subroutine read_sweep(word, values, error)
      character(*), intent(in) :: word   !! group.key=value,value,...
      type(setting_type), allocatable, intent(out) :: values(:)
      type(error_type), allocatable, intent(out) :: error

      character :: quote
      character(:), allocatable :: trouble
      integer :: i
      integer, allocatable :: commas(:)
      type(setting_type) :: setting

      call read_setting(word, setting, trouble)
      if (allocated(trouble)) then
         call fatal_error(error, exit_bad_input, '--sweep needs group.key=value,value,..., such as '// &
                          "surface.amplitude=1e-6,2e-6, got '"//escaped(word)//"'")
         return
      end if
      commas = [0]
      quote = ' '
      do i = 1, len(setting%value)
         associate (byte => setting%value(i:i))
            if (quote == ' ' .and. scan(byte, '''"') == 1) then
               quote = byte
            else if (byte == quote) then
               quote = ' '
            else if (quote == ' ' .and. byte == ',') then
               commas = [commas, i]
            end if
         end associate
      end do
      commas = [commas, len(setting%value) + 1]
      allocate (values(size(commas) - 1))
      do i = 1, size(values)
         values(i)%group = setting%group
         values(i)%key = setting%key
         values(i)%value = trim(adjustl(setting%value(commas(i) + 1:commas(i + 1) - 1)))
      end do
   end subroutine read_sweep

   !> Each deck with all combinations of the values of all sweeps; the values of the last sweep change fastest. Errors:
   !> exit_bad_input if these are too many.
   subroutine make_runs(decks, settings, sweeps, runs, error)
      type(run_type), intent(in) :: decks(:)           !! without settings
      type(setting_type), intent(in) :: settings(:)    !! of all runs
      type(sweep_type), intent(in) :: sweeps(:)
      type(run_type), allocatable, intent(out) :: runs(:)
      type(error_type), allocatable, intent(out) :: error

      integer :: i, number, r, rest

      number = size(decks)
      do i = 1, size(sweeps)
         if (number <= most_runs) number = number*size(sweeps(i)%values)
      end do
      if (number > most_runs) then
         call fatal_error(error, exit_bad_input, '--sweep: more than '//integer_text(most_runs)//' runs')
         return
      end if
      allocate (runs(number))
      do r = 1, number
         allocate (runs(r)%settings(size(settings) + size(sweeps)))
         do i = 1, size(settings)
            runs(r)%settings(i) = settings(i)
         end do
         rest = r - 1
         do i = size(sweeps), 1, -1
            runs(r)%settings(size(settings) + i) = sweeps(i)%values(mod(rest, size(sweeps(i)%values)) + 1)
            rest = rest/size(sweeps(i)%values)
         end do
         runs(r)%path = decks(rest + 1)%path
      end do
   end subroutine make_runs

   !> Checks a path given to an option as the key `directory` of a deck is checked. Errors: exit_bad_input.
   subroutine check_path(option, what, path, error)
      character(*), intent(in) :: option, what   !! such as '--output', 'a directory'
      character(*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      if (path == '' .or. index(path, '--') == 1) then
         call fatal_error(error, exit_bad_input, option//' needs the name of '//what)
      else if (len(path) > longest_directory) then
         call fatal_error(error, exit_bad_input, option//': the name of '//what//' must be at most '// &
                          integer_text(longest_directory)//' bytes long, got '//integer_text(len(path)))
      else if (.not. is_printable(path)) then
         call fatal_error(error, exit_bad_input, option//": the name '"//escaped(path)// &
                          "' must be ASCII or UTF-8 text without control characters")
      end if
   end subroutine check_path

   !> The text of --help: usage and options, then the reference of all keys.
   function help_text(is_parallel) result(text)
      logical, intent(in) :: is_parallel   !! whether this is the parallel program
      character(:), allocatable :: text

      integer, parameter :: indent = 18
      character(:), allocatable :: head, usage
      integer :: i

      text = 'wavycon: elastic contact of regular wavy surfaces, from namelist decks to tables.'//newline//newline
      usage = 'DECK...'
      do i = 1, size(options)
         usage = usage//' ['//trim(trim(options(i)%name)//' '//options(i)%value)//']'
         if (any(options(i)%name == ['--set  ', '--sweep'])) usage = usage//'...'
      end do
      head = 'usage: wavycon '
      if (is_parallel) head = 'usage: mpirun -n RANKS wavycon-mpi '
      call add_wrapped(text, len('usage: wavycon '), usage, head)
      text = text//newline
      do i = 1, size(options)
         head = '   '//trim(trim(options(i)%name)//' '//options(i)%value)
         if (options(i)%name == '--help') head = head//', -h'
         if (len(head) < indent) then
            head = head//repeat(' ', indent - len(head))
         else
            text = text//head//newline
            head = repeat(' ', indent)
         end if
         call add_wrapped(text, indent, trim(options(i)%meaning), head)
      end do
      text = text//newline
      if (is_parallel) call add_wrapped(text, 0, 'The RANKS processes share the work: large grids are divided '// &
         'among them, or else the loads. Each needs the memory of its part, and has N threads of its own. The '// &
         'results are those of wavycon.')
      if (is_parallel) text = text//newline
      call add_wrapped(text, 0, 'Exit status: 0 fine, 1 bad input, 2 a load did not converge, 3 file trouble; of '// &
                       'several decks the worst.')
      text = text//newline//key_reference()
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

   !> The command that continues this run, for a shell.
   function command_to_resume() result(command)
      character(:), allocatable :: command

      character(*), parameter :: plain = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=,:+@%'
      character(:), allocatable :: word, words
      integer :: i, k

      command = ''
      do i = 0, command_argument_count()
         word = argument(i)
         if (i > 0 .and. word == '--resume') cycle
         if (verify(word, plain) > 0 .or. word == '') then
            words = "'"
            do k = 1, len(word)
               words = words//word(k:k)
               ! A quote ends the quoted text, stands escaped, and begins it again.
               if (word(k:k) == "'") words = words//"\''"
            end do
            word = words//"'"
         end if
         command = command//word//' '
         if (i == 0) command = command//'--resume '
      end do
      command = trim(command)
   end function command_to_resume

end module wavycon_command_line
