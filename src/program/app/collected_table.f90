!> The collected table that --table asks for: a row for each load of each deck, with the columns of the summary. The
!> rows are read from the summaries that the runs have written. A deck that has failed has one row.
module wavycon_collected_table
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_deck_groups, only: list_deck_keys => list_keys, number_of_groups
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: read_file
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: integer_value, real_value
   use wavycon_memory_table, only: column_list, column_type, longest_column, of_words
   use wavycon_output_file, only: blank_mark, output_file, table_mark
   use wavycon_plain_text, only: escaped, lower_case, newline, replaced
   use wavycon_scene, only: scene_type
   use wavycon_settings, only: setting_type
   use wavycon_system, only: error_text, full_path, make_directories, path_directory, path_kind, refusal_to_write
   use wavycon_table, only: table_type
   use wavycon_tables, only: all_tables, summary_columns
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: check_table_file, collected_deck, list_keys, write_collected_table

   !> Width of the narrowest column, as in other tables.
   integer, parameter :: narrowest = 25

   !> Most bytes of 'group_key': two names of at most name_length bytes of wavycon_key_table.
   integer, parameter :: longest_key_name = 49

   !> The first words of a table with commas, and the end of the name of its file.
   character(*), parameter :: comma_mark = 'deck,case,', comma_ending = '.csv'

   !> A key of a deck and its value.
   type :: deck_key
      character(longest_key_name) :: name = ''   !! 'group_key'
      !> The value in effect; '-' for an empty text. If the key has no effect: 'NaN' in place of a
      !> number, '-' in place of a word.
      character(:), allocatable :: word
      logical :: in_effect = .false.
      logical :: given = .false.          !! whether the deck or the command line gives the key
   end type deck_key

   !> The data of a deck for the table.
   type :: collected_deck
      character(:), allocatable :: path, case    !! path of the deck; name of the case
      !> The absolute path of the deck's results without '.summary.dat' and other endings; not allocated for a bad deck.
      character(:), allocatable :: stem
      logical :: is_written = .false.            !! whether this run has written the summary; .false.: it has failed
      integer :: loads = 0                       !! number of loads
      type(deck_key), allocatable :: keys(:)     !! all keys, in the same order for each deck
      character(:), allocatable :: units, names  !! lines of the summary with the units and the names of the columns
      character(:), allocatable :: rows          !! the summary's rows, each with a newline
   end type collected_deck

contains

   !> Makes the directory of the table and checks whether the table can be written, so that a bad name is reported
   !> before decks are run. The table must not replace a file that is no table, such as a deck, nor a result of a deck.
   !> Errors: exit_file_trouble.
   subroutine check_table_file(path, decks, makes_directory, error)
      character(*), intent(in) :: path                !! path of the table
      class(collected_deck), intent(in) :: decks(:)   !! decks that are run have a stem
      logical, intent(in) :: makes_directory          !! whether its directory is made; if not it may be absent
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: folder, full, mark, trouble
      character(24), allocatable :: kinds(:)
      integer :: d, k, number
      type(table_type), allocatable :: tables(:)

      folder = path(:index(path, '/', back=.true.))//'.'
      if (makes_directory) call make_directories(folder, trouble)
      if (allocated(trouble)) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': its directory cannot be made: '//escaped(trouble))
         return
      end if
      mark = table_mark
      if (has_commas(path)) mark = comma_mark
      number = 0
      if (path_kind(folder) == path_directory) number = refusal_to_write(path//c_null_char, mark//c_null_char)
      if (number /= 0) trouble = error_text(number)
      if (path_kind(path) == path_directory .or. index(path, '/', back=.true.) == len(path)) &
         trouble = 'this is a directory'
      if (any(lower_case(path(max(1, index(path, '.', back=.true.)):)) == ['.xlsx', '.xls ', '.ods '])) &
         trouble = 'it is a text: end the name in .csv for spreadsheets'
      full = full_path(path)
      call all_tables(tables)
      kinds = [character(len(kinds)) :: tables%file, 'resolved', 'checkpoint']
      do d = 1, size(decks)
         if (.not. allocated(decks(d)%stem)) cycle
         if (any([(index(full//'.', decks(d)%stem//'.'//trim(kinds(k))//'.') == 1, k=1, size(kinds))])) &
            trouble = 'this is a result of '//escaped(decks(d)%path)
      end do
      if (allocated(trouble)) &
         call fatal_error(error, exit_file_trouble, escaped(path)//': the table cannot be written: '//trouble)
   end subroutine check_table_file

   !> Lists all keys with their values, in the same order for all decks. Keys of &scene, &interface and &output, and
   !> lists of loads, which have a row for each load, are marked as without effect: they get no columns.
   subroutine list_keys(scene, keys, settings)
      type(scene_type), intent(in), target :: scene   !! the scene of a deck
      type(deck_key), allocatable, intent(out) :: keys(:)
      !> Of a bad deck: the settings of its run, whose values are all that is shown of it.
      type(setting_type), intent(in), optional :: settings(:)

      integer :: i, k, number, s
      type(key_list) :: lists(number_of_groups)

      call list_deck_keys(scene, lists)
      allocate (keys(sum([(size(lists(i)%rows), i=1, size(lists))])))
      number = 0
      do i = 1, size(lists)
         do k = 1, size(lists(i)%rows)
            number = number + 1
            associate (key => lists(i)%rows(k), value => lists(i)%keys(k)%value, listed => keys(number))
               listed%name = trim(lists(i)%name)//'_'//key%name
               listed%given = value%is_given
               listed%in_effect = value%in_effect .and. all(lists(i)%name /= ['scene    ', 'interface', 'output   ']) &
                                  .and. .not. (lists(i)%name == 'load' .and. key%most_values > 1) .and. &
                                  (lists(i)%name /= 'stress' .or. lists(i)%group%position > 0)
               listed%word = '-'
               if (any(key%kind == [real_value, integer_value])) listed%word = 'NaN'
               if (present(settings)) then
                  s = findloc([(settings(s)%group//'_'//settings(s)%key == listed%name, s=1, size(settings))], &
                              .true., dim=1)
                  listed%in_effect = listed%in_effect .and. s > 0
                  if (s > 0) listed%word = escaped(settings(s)%value)
               else if (listed%in_effect) then
                  listed%word = word_of(lists(i), k)
               end if
            end associate
         end do
      end do
   end subroutine list_keys

   !> The value of a key as one word: a list has commas between its numbers; if all numbers are equal, one is shown.
   pure function word_of(list, k) result(word)
      type(key_list), intent(in) :: list
      integer, intent(in) :: k   !! number of the key
      character(:), allocatable :: word

      word = list%words(k, ',')
      if (any(list%rows(k)%kind == [real_value, integer_value])) then
         associate (numbers => list%keys(k)%value%numbers)
            if (maxval(numbers) <= minval(numbers)) word = word(:index(word//',', ',') - 1)
         end associate
      end if
      word = escaped(word)
      if (word == '') word = '-'
   end function word_of

   !> Writes the table. A key has a column if the command line sets the key, or if a deck gives it and its value differs
   !> between decks. A deck in which the key has no effect has NaN in the column, or '-' in place of a word. The unit of
   !> a column is that of the summaries if it is the same in all of them, otherwise a general name such as 'length'.
   !>
   !> A deck that has failed has one row, with 'failed' for its status.
   !>
   !> A file whose name ends in '.csv' has one line of names, with their units in brackets, and commas between words.
   !>
   !> Errors: exit_file_trouble, also for a summary that cannot be read or, kept by --resume, is damaged.
   subroutine write_collected_table(path, decks, settings, error)
      character(*), intent(in) :: path                !! path of the table
      type(collected_deck), intent(in) :: decks(:)
      type(setting_type), intent(in) :: settings(:)   !! settings of the command line
      type(error_type), allocatable, intent(out) :: error

      character :: blank   ! stands for the blanks within words
      character(:), allocatable :: line, names, units
      character(longest_column), allocatable :: general(:)   ! units of the summary's columns by their general names
      integer, allocatable :: columns(:), width(:)
      type(column_type), allocatable :: common(:), own(:)    ! columns with the units of all summaries; of one
      type(collected_deck), allocatable :: shown(:)   ! the decks with their rows
      type(output_file) :: file
      integer :: d, k, one   ! one: number of a deck that has a summary, or 0

      one = findloc(decks%is_written, .true., dim=1)
      call choose_columns(decks, settings, columns)
      allocate (width(2 + size(columns)), source=narrowest)
      shown = decks
      do d = 1, size(shown)
         if (shown(d)%is_written) call read_summary(shown(d), error)
         if (allocated(error)) return
         if (.not. allocated(shown(d)%case)) shown(d)%case = '-'
         width(:2) = max(width(:2), [len(escaped(shown(d)%path)), len(shown(d)%case)] + 1)
         do k = 1, size(columns)
            associate (key => shown(d)%keys(columns(k)))
               width(2 + k) = max(width(2 + k), len(key%word) + 1, len_trim(key%name) + 1)
            end associate
         end do
      end do
      names = ''
      units = ''
      common = column_list(summary_columns())
      general = common%unit
      do d = 1, size(shown)
         if (.not. shown(d)%is_written) cycle
         own = column_list(shown(d)%units)
         if (size(own) /= size(common)) cycle   ! of another version, which --resume has kept
         if (d == one) common%unit = own%unit
         where (own%unit /= common%unit) common%unit = general
      end do
      do k = 1, size(common)
         names = names//' '//trim(common(k)%name)
         units = units//' ['//trim(common(k)%unit)//']'
      end do
      if (one > 0) names = shown(one)%names
      if (has_commas(path)) then
         blank = blank_mark
         call file%open(comma_path=path)
      else
         blank = '_'
         call file%open(path)
      end if
      call file%put(table_mark//version//' ('//revision//')')
      do d = 1, size(decks)
         if (.not. decks(d)%is_written) call file%put('# failed: '//escaped(decks(d)%path))
      end do
      line = ''
      do k = 1, size(width)
         line = line//cell(k, '[-]')
      end do
      units = line(2:)//' '//units
      call file%put('#'//units)
      line = cell(1, 'deck')//cell(2, 'case')
      do k = 1, size(columns)
         line = line//cell(2 + k, trim(shown(1)%keys(columns(k))%name))
      end do
      call file%put_words(line//names, units)
      do d = 1, size(shown)
         line = cell(1, escaped(shown(d)%path))//cell(2, shown(d)%case)
         do k = 1, size(columns)
            line = line//cell(2 + k, shown(d)%keys(columns(k))%word)
         end do
         if (.not. shown(d)%is_written) then
            shown(d)%names = names
            shown(d)%rows = failed_row(names, common)//newline
         end if
         ! All rows of a summary are as long as its line of names. Those of another summary may be longer or shorter.
         associate (rows => shown(d)%rows, length => len(shown(d)%names))
            do k = 1, len(rows), length + 1
               call file%put_words(line//rows(k:k + length - 1))
            end do
         end associate
      end do
      call file%finish(error)

   contains

      !> A word at the right of a column, without blanks.
      pure function cell(column, word) result(text)
         integer, intent(in) :: column
         character(*), intent(in) :: word
         character(:), allocatable :: text

         text = repeat(' ', width(column) - len(word))//replaced(word, ' ', blank)
      end function cell

   end subroutine write_collected_table

   !> The row of a deck that has failed: NaN, and '-' for words but its status.
   pure function failed_row(names, columns) result(row)
      character(*), intent(in) :: names               !! line of the names, each at the right of its column
      type(column_type), intent(in) :: columns(:)
      character(len(names)) :: row

      character(:), allocatable :: word
      integer :: k, last

      row = ''
      do k = 1, size(columns)
         word = 'NaN'
         if (columns(k)%kind == of_words) word = '-'
         if (columns(k)%name == 'status') word = 'failed'
         last = index(names//' ', ' '//trim(columns(k)%name)//' ') + len_trim(columns(k)%name)
         row(last - len(word) + 1:last) = word
      end do
   end function failed_row

   !> Whether the name of a table asks for commas.
   pure logical function has_commas(path)
      character(*), intent(in) :: path

      has_commas = lower_case(path(max(1, len(path) - len(comma_ending) + 1):)) == comma_ending
   end function has_commas

   !> Reads a summary: a head whose last line has the units, a line of names, and rows. Errors: exit_file_trouble, also
   !> for one whose rows are not as many as the loads, or not as long as the line of names.
   subroutine read_summary(deck, error)
      type(collected_deck), intent(inout) :: deck   !! gets `units`, `names` and `rows`
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: text
      integer :: k, names, rows, units   ! names, rows, units: first byte of these lines in the text
      logical :: is_whole

      call read_file(deck%stem//'.summary.dat', huge(names), text, error)
      if (allocated(error)) return
      units = index(text, newline//'#', back=.true.) + 2
      names = units + index(text(units:), newline)
      rows = names + index(text(names:), newline)
      deck%units = text(units:names - 2)
      deck%names = text(names:rows - 2)
      deck%rows = text(rows:)
      is_whole = deck%rows /= '' .and. len(deck%rows) == deck%loads*(rows - names)
      if (is_whole) is_whole = all([(deck%rows(k*(rows - names):k*(rows - names)) == newline, k=1, deck%loads)])
      if (.not. is_whole) call fatal_error(error, exit_file_trouble, &
         escaped(deck%stem)//'.summary.dat: the summary is damaged. Without --resume all decks are run again')
   end subroutine read_summary

   !> Chooses the keys that have a column. A key that has an effect in an earlier deck comes first.
   subroutine choose_columns(decks, settings, columns)
      type(collected_deck), intent(in) :: decks(:)      !! the decks in the table; if any is written, such ones decide
      type(setting_type), intent(in) :: settings(:)     !! settings of the command line
      integer, allocatable, intent(out) :: columns(:)   !! numbers of the keys

      integer :: d, first, i, k
      logical :: decides(size(decks)), is_set
      logical, allocatable :: differs(:)   ! whether the value of each key differs between decks

      allocate (columns(0))
      if (size(decks) == 0) return
      decides = decks%is_written .or. .not. any(decks%is_written)
      first = findloc(decides, .true., dim=1)
      differs = [(any([(decides(d) .and. decks(d)%keys(k)%word /= decks(first)%keys(k)%word, d=1, size(decks))]), &
                  k=1, size(decks(first)%keys))]
      do d = 1, size(decks)
         if (.not. decides(d)) cycle
         do k = 1, size(differs)
            associate (key => decks(d)%keys(k))
               if (any(columns == k) .or. .not. key%in_effect) cycle
               is_set = any([(settings(i)%group//'_'//settings(i)%key == key%name, i=1, size(settings))])
               if (is_set .or. (key%given .and. differs(k))) columns = [columns, k]
            end associate
         end do
      end do
   end subroutine choose_columns

end module wavycon_collected_table
