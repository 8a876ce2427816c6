!> Reads the command line, and makes the text of --help.
module wavycon_command_line
   use wavycon_deck_groups, only: list_keys, number_of_groups
   use wavycon_deck_text, only: at_end, is_comma, next_token, token_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_group, only: key_group, key_list, key_value
   use wavycon_key_reference, only: add_wrapped, key_reference
   use wavycon_key_table, only: integer_value, key_type, logical_value, name_length, text_value
   use wavycon_key_values, only: must_be, read_value, word_value
   use wavycon_kinds, only: dp, int64
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_output_group, only: longest_directory
   use wavycon_plain_text, only: escaped, integer_text, listed, lower_case, newline, quoted
   use wavycon_scene, only: scene_type
   use wavycon_settings, only: read_setting, setting_type
   implicit none (type, external)
   private

   public :: command_line_type, make_help, read_command_line

   !> A run of a deck, with settings that replace keys of the deck.
   type :: run_type
      character(:), allocatable :: path
      integer :: deck = 0   !! number of the deck in the command line
      type(setting_type), allocatable :: settings(:)
   end type run_type

   !> The settings of one option: one setting of --set, or one for each value of --sweep.
   type :: sweep_type
      type(setting_type), allocatable :: values(:)
   end type sweep_type

   !> The options as a group of keys, so that the procedures for keys of decks read and describe them.
   type, extends(key_group) :: option_group
      type(key_value) :: check, set, sweep, output, csv, table, keep_going, resume, jobs, threads, quiet, version, help
   end type option_group

   type :: command_line_type
      type(run_type), allocatable :: runs(:)   !! each deck with each combination of the values of all sweeps
      type(option_group) :: options
   end type command_line_type

   !> Most runs of a command, and most processes or threads of an option.
   integer, parameter :: most_runs = 100000, most_processes = 1024

contains

   !> The options as keys. The unit of a key is the word that follows the option in the usage, such as DIR.
   subroutine list_options(options, keys)
      type(option_group), intent(in), target :: options   !! the record to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('options', '', options%key_group)
      call keys%add(options%check, key_type(logical_value, '--check', '.false.', '', &
         'validate the decks, say what a run would do, and stop'))
      call keys%add(options%set, key_type(text_value, '--set', '', 'GROUP.KEY=VALUE', &
         'set a key in place of those of the decks, such as surface.amplitude=2e-6 or load.pbar_over_pstar=0.1,'// &
         '0.2; may be repeated. Keys of the deck that contradict it are left out: other ways to give the loads or '// &
         'the stiffness, accuracy or grid_points, keys of another kind of surface or solver. The name of the case '// &
         'gets key and value, unless scene.case is set too'))
      call keys%add(options%sweep, key_type(text_value, '--sweep', '', 'GROUP.KEY=VALUE,...', &
         'run each deck once for each value, as with --set; several sweeps: for all combinations'))
      call keys%add(options%output, key_type(text_value, '--output', '', 'DIR', &
         'write the results to DIR, not to the directory of &output', longest=longest_directory))
      call keys%add(options%csv, key_type(logical_value, '--csv', '.false.', '', &
         'write each table with commas too, as --set output.csv=.true. does'))
      call keys%add(options%table, key_type(text_value, '--table', '', 'FILE', &
         'write one table of all decks: a row for each deck and load, with the values of the keys that are set or '// &
         'differ, and the columns of the summary; with commas, for spreadsheets, if FILE ends in .csv; - is '// &
         'standard output', longest=longest_directory))
      call keys%add(options%keep_going, key_type(logical_value, '--keep-going', '.false.', '', &
         'a bad deck does not keep the others from being run'))
      call keys%add(options%resume, key_type(logical_value, '--resume', '.false.', '', &
         'continue an interrupted run, to the same tables. Decks that are done are kept. Loads that were solved on '// &
         'grids are read from <case>.checkpoint; loads of the other solvers are fast and are solved again'))
      call keys%add(options%jobs, key_type(integer_value, '--jobs', '1', 'N', &
         'run N decks at a time, each in a process of its own; 1 if not given', 1, most_processes))
      call keys%add(options%threads, key_type(integer_value, '--threads', '1', 'N', &
         'work on large grids with N threads; 1 if not given', 1, most_processes))
      call keys%add(options%quiet, key_type(logical_value, '--quiet', '.false.', '', 'write nothing but problems'))
      call keys%add(options%version, key_type(logical_value, '--version', '.false.', '', 'show the version and stop'))
      call keys%add(options%help, key_type(logical_value, '--help', '.false.', '', &
         'show this and stop; --help surface: only the keys of this group; --help load.percolates or '// &
         '--help percolates: only this key'))
      call keys%close()
   end subroutine list_options

   !> Reads the command line. Words that do not begin with '-', '-' alone, and all words behind '--', are decks. Errors:
   !> exit_bad_input for an unknown option, a bad value of an option, or a command without a deck.
   subroutine read_command_line(command_line, error)
      type(command_line_type), intent(out), target :: command_line
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: trouble, value, word
      type(run_type) :: deck(command_argument_count())
      type(sweep_type) :: sweep(size(deck))
      type(key_list) :: keys
      type(key_type) :: key
      type(word_value) :: parsed
      integer :: decks, equals, i, k, sweeps
      logical :: options_over

      call list_options(command_line%options, keys)
      call keys%start('')
      decks = 0
      sweeps = 0
      value = ''
      word = ''
      options_over = .false.
      i = 0
      do while (i < command_argument_count() .and. .not. allocated(trouble))
         i = i + 1
         word = argument(i)
         if (options_over .or. index(word, '-') /= 1 .or. word == '-') then
            if (word == '') trouble = 'the name of a deck is empty'
            decks = decks + 1
            deck(decks)%path = word
            cycle
         end if
         options_over = word == '--'
         if (options_over) cycle
         if (word == '-h') word = '--help'
         equals = index(word//'=', '=')
         k = findloc(keys%rows%name == word(:equals - 1) .and. &
                     (keys%rows%kind /= logical_value .or. equals > len(word)), .true., dim=1)
         if (k == 0) then
            trouble = "unknown option '"//escaped(word)//"'"
            ! Many programs have options of one letter, which no name is near to.
            k = findloc(keys%rows%name(:3), '-'//word(:2), dim=1)
            if (len(word) == 2 .and. k > 0) word = trim(keys%rows(k)%name)
            trouble = trouble//did_you_mean(word, keys%rows%name, '', '')
            cycle
         end if
         key = keys%rows(k)
         if (key%kind == logical_value) then
            call keys%keys(k)%value%set([1.0_dp])
            cycle
         end if
         if (equals > len(word) .and. i < command_argument_count()) then
            i = i + 1
            value = argument(i)
         else
            value = word(min(equals, len(word)) + 1:)
         end if
         if (value == '' .or. index(value, '--') == 1) then
            trouble = trim(key%name)//' needs a value: '//trim(key%name)//' '//trim(key%unit)
         else if (any(key%name == ['--set  ', '--sweep'])) then
            sweeps = sweeps + 1
            call read_sweep(trim(key%name), value, sweep(sweeps)%values, trouble)
         else
            if (key%kind == text_value) value = quoted(value)
            call read_value(key, value, parsed, trouble)
            if (parsed%repeats > 1) trouble = must_be(key, value)
            if (.not. allocated(trouble)) call keys%take(k, 1, [parsed%number], parsed%text)
         end if
      end do
      associate (options => command_line%options)
         if (decks == 0 .and. .not. (options%version%is_true .or. options%help%is_true .or. &
                                     allocated(trouble))) trouble = 'no deck is given'
         if (allocated(trouble)) call fatal_error(error, exit_bad_input, trouble)
         if (allocated(error)) return
         if (options%output%is_given) then
            sweeps = sweeps + 1
            call read_sweep('--set', 'output.directory='//quoted(options%output%text), sweep(sweeps)%values, trouble)
         end if
         if (options%table%text == '-') call options%table%set(text='/dev/stdout')
         if (options%csv%is_true) then
            sweeps = sweeps + 1
            call read_sweep('--set', 'output.csv=.true.', sweep(sweeps)%values, trouble)
         end if
      end associate
      call make_runs(deck(:decks), sweep(:sweeps), command_line%runs, error)
   end subroutine read_command_line

   !> Reads the word behind --set or --sweep. The values of a sweep are separated by commas outside of quotes.
   subroutine read_sweep(option, word, values, trouble)
      character(*), intent(in) :: option   !! '--set' or '--sweep'
      character(*), intent(in) :: word     !! 'group.key=value', of --sweep 'group.key=value,value,...'
      type(setting_type), allocatable, intent(out) :: values(:)   !! a setting for each value
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      integer :: i
      integer, allocatable :: commas(:)
      type(setting_type) :: setting
      type(token_type) :: token

      call read_setting(word, setting, trouble)
      if (allocated(trouble) .and. option == '--sweep') trouble = '--sweep needs group.key=value,value,..., '// &
         "such as surface.amplitude=1e-6,2e-6, got '"//escaped(word)//"'"
      if (allocated(trouble)) return
      commas = [0]
      do while (option == '--sweep')
         token = next_token(setting%value, token%last + 1)
         if (token%kind == at_end) exit
         if (token%kind == is_comma) commas = [commas, token%first]
      end do
      commas = [commas, len(setting%value) + 1]
      allocate (values(size(commas) - 1))
      do i = 1, size(values)
         values(i)%group = setting%group
         values(i)%key = setting%key
         values(i)%value = trim(adjustl(setting%value(commas(i) + 1:commas(i + 1) - 1)))
      end do
   end subroutine read_sweep

   !> Makes the runs: each deck with each combination of the values of all sweeps. The values of the last sweep change
   !> fastest. Errors: exit_bad_input for more than `most_runs` runs.
   subroutine make_runs(decks, sweeps, runs, error)
      type(run_type), intent(in) :: decks(:)           !! without settings
      type(sweep_type), intent(in) :: sweeps(:)
      type(run_type), allocatable, intent(out) :: runs(:)
      type(error_type), allocatable, intent(out) :: error

      integer :: i, number, r, rest

      number = size(decks)
      do i = 1, size(sweeps)
         number = int(min(most_runs + 1_int64, int(number, int64)*size(sweeps(i)%values)))
      end do
      if (number > most_runs) then
         call fatal_error(error, exit_bad_input, '--sweep: more than '//integer_text(most_runs)//' runs')
         return
      end if
      allocate (runs(number))
      do r = 1, number
         allocate (runs(r)%settings(size(sweeps)))
         rest = r - 1
         do i = size(sweeps), 1, -1
            runs(r)%settings(i) = sweeps(i)%values(mod(rest, size(sweeps(i)%values)) + 1)
            rest = rest/size(sweeps(i)%values)
         end do
         runs(r)%path = decks(rest + 1)%path
         runs(r)%deck = rest + 1
      end do
   end subroutine make_runs

   !> Makes the text of --help: usage and options, then the reference of all keys; or that of groups and keys. Errors:
   !> exit_bad_input for a word beside --help that names neither, and is no deck.
   subroutine make_help(command_line, is_parallel, text, error)
      type(command_line_type), intent(in) :: command_line   !! with the names of groups and keys in place of decks
      logical, intent(in) :: is_parallel                    !! whether this is the parallel program
      character(:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: found, group, key, word
      character(name_length) :: groups(number_of_groups)
      character(name_length), allocatable :: keys(:)
      integer :: i, point, r
      type(key_list) :: lists(number_of_groups)
      type(scene_type), target :: no_scene   ! records without values, to which the lists point

      text = ''
      call list_keys(no_scene, lists)
      groups = lists%name
      do r = 1, size(command_line%runs)
         word = lower_case(command_line%runs(r)%path)
         if (index(word, '&') == 1) word = word(2:)
         point = index(word, '.')
         group = word(:max(point - 1, 0))
         key = word(point + 1:)
         found = ''
         if (any(groups == word)) then
            found = key_reference(word, '')
         else if (key /= '') then
            found = key_reference(group, key)
         end if
         text = text//found
         if (found /= '') cycle
         if (point > 0 .and. any(groups == group) .and. key /= 'nml') then
            keys = lists(findloc(groups == group, .true., dim=1))%rows%name
            call fatal_error(error, exit_bad_input, "--help: there is no key '"//escaped(key)//"' in &"//group// &
                             did_you_mean(key, keys, '', '', '; its keys are '//listed(keys, ' and ')))
         else if (scan(word, './') == 0) then
            keys = [(lists(i)%rows%name, i=1, size(lists))]
            call fatal_error(error, exit_bad_input, "--help: there is no group or key '"//escaped(word)//"'"// &
                             did_you_mean(word, [groups, keys], '', '', '; groups are '//listed(groups, ' and ')))
         end if
         if (allocated(error)) return
      end do
      if (text == '') text = help_text(is_parallel)
   end subroutine make_help

   !> Usage and options, then the reference of all keys.
   function help_text(is_parallel) result(text)
      logical, intent(in) :: is_parallel   !! as of make_help
      character(:), allocatable :: text

      integer, parameter :: indent = 18
      character(:), allocatable :: head, usage
      integer :: i
      type(key_list) :: keys
      type(option_group), target :: no_options   ! values without use, to which the list points

      call list_options(no_options, keys)
      text = 'wavycon: elastic contact of wavy and rough surfaces, from namelist decks to tables.'//newline//newline
      usage = 'DECK...'
      do i = 1, size(keys%rows)
         usage = usage//' ['//trim(trim(keys%rows(i)%name)//' '//keys%rows(i)%unit)//']'
         if (any(keys%rows(i)%name == ['--set  ', '--sweep'])) usage = usage//'...'
      end do
      head = 'usage: wavycon '
      if (is_parallel) head = 'usage: mpirun -n RANKS wavycon-mpi '
      call add_wrapped(text, len('usage: wavycon '), usage, head)
      text = text//newline
      do i = 1, size(keys%rows)
         head = '   '//trim(trim(keys%rows(i)%name)//' '//keys%rows(i)%unit)
         if (keys%rows(i)%name == '--help') head = head//', -h'
         if (len(head) < indent) then
            head = head//repeat(' ', indent - len(head))
         else
            text = text//head//newline
            head = repeat(' ', indent)
         end if
         call add_wrapped(text, indent, trim(keys%rows(i)%meaning), head)
      end do
      text = text//newline
      if (is_parallel) call add_wrapped(text, 0, 'The RANKS processes share the work: large grids are divided '// &
         'among them, or else the loads. Each needs the memory of its part, and has N threads of its own. The '// &
         'results are those of wavycon.')
      if (is_parallel) text = text//newline
      call add_wrapped(text, 0, 'The DECK - is standard input.'//newline)
      call add_wrapped(text, 0, 'Exit status: 0 fine, 1 bad input, 2 a load did not converge, 3 file trouble; of '// &
                       'several decks the worst.')
      text = text//newline//key_reference('', '')
   end function help_text

   !> A word of the command line, of any length.
   function argument(i) result(word)
      integer, intent(in) :: i   !! number of the word, from 1
      character(:), allocatable :: word

      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(length) :: word)
      if (length > 0) call get_command_argument(i, word)
   end function argument

end module wavycon_command_line
