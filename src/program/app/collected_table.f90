!> The collected table that --table asks for: a row for each load of each deck, with the columns of the summary. The
!> rows are read from the summaries that the runs have written. A deck that has failed has one row.
module wavycon_collected_table
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_deck_groups, only: list_deck_keys => list_keys, number_of_groups
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: read_file
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: integer_value, real_value, words_of
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_list, column_type, longest_column, longest_word, of_words
   use wavycon_output_file, only: output_file, table_mark
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
      type(column_type), allocatable :: columns(:)   !! columns of the summary
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
                  ! A list has commas between its numbers; if all are equal, one is shown.
                  listed%word = lists(i)%words(k, ',')
                  if (any(key%kind == [real_value, integer_value]) .and. &
                      maxval(value%numbers) <= minval(value%numbers)) &
                     listed%word = listed%word(:index(listed%word//',', ',') - 1)
                  listed%word = escaped(listed%word)
                  if (listed%word == '') listed%word = '-'
               end if
            end associate
         end do
      end do
   end subroutine list_keys

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

      integer, allocatable :: keys(:), width(:)   ! numbers of the keys that have columns; least widths of all columns
      type(column_type), allocatable :: columns(:)             ! all columns, as words
      !> Those of the summary, and the same with the general names of units, such as 'length'.
      type(column_type), allocatable :: general(:), summary(:)
      type(collected_deck), allocatable :: shown(:)   ! the decks with their summaries
      type(output_file) :: file
      integer :: d, k
      integer :: before   ! number of the columns before those of the summary

      call choose_columns(decks, settings, keys)
      before = 2 + size(keys)
      allocate (shown, source=decks)
      allocate (general, source=column_list(summary_columns()))
      allocate (summary, source=general)
      allocate (width(before + size(summary)), source=0)
      do d = 1, size(shown)
         if (.not. allocated(shown(d)%case)) shown(d)%case = '-'
         do k = 1, before
            width(k) = max(width(k), len(word_about(shown(d), k)) + 1)
         end do
         if (.not. shown(d)%is_written) cycle
         call read_summary(shown(d), size(summary), error)
         if (allocated(error)) return
         if (d == findloc(decks%is_written, .true., dim=1)) summary%unit = shown(d)%columns%unit
         where (shown(d)%columns%unit /= summary%unit) summary%unit = general%unit
      end do
      if (has_commas(path)) then
         call file%open(comma_path=path)
      else
         call file%open(path)
      end if
      call file%put(table_mark//version//' ('//revision//')')
      do d = 1, size(shown)
         if (.not. shown(d)%is_written) call file%put('# failed: '//escaped(shown(d)%path))
      end do
      columns = [(column_type(unit='-'), k=1, before), summary]
      columns(:before)%name = [character(longest_column) :: 'deck', 'case', shown(1)%keys(keys)%name]
      columns%kind = of_words
      call file%put_columns(columns, width)
      do d = 1, size(shown)
         call put_rows(shown(d))
      end do
      call file%finish(error)

   contains

      !> Writes the rows of a deck. That of a deck that has failed has NaN, and '-' for words but its status.
      subroutine put_rows(deck)
         type(collected_deck), intent(in) :: deck

         character(max(longest_word, maxval(width))) :: row(size(width))
         integer :: i, length

         do i = 1, before
            row(i) = word_about(deck, i)
         end do
         if (deck%is_written) then
            length = len(deck%rows)/deck%loads
            do i = 1, len(deck%rows), length
               read (deck%rows(i:i + length - 2), *) row(before + 1:)
               call file%put_row([real(dp) ::], row)
            end do
         else
            row(before + 1:) = 'NaN'
            where (summary%kind == of_words) row(before + 1:) = '-'
            where (summary%name == 'status') row(before + 1:) = 'failed'
            call file%put_row([real(dp) ::], row)
         end if
      end subroutine put_rows

      !> The name of a deck, of its case, or the value of one of its keys. Only between commas it may have blanks.
      pure function word_about(deck, column) result(word)
         type(collected_deck), intent(in) :: deck
         integer, intent(in) :: column   !! number of the column
         character(:), allocatable :: word

         select case (column)
         case (1)
            word = escaped(deck%path)
         case (2)
            word = deck%case
         case default
            word = deck%keys(keys(column - 2))%word
         end select
         if (.not. has_commas(path)) word = replaced(word, ' ', '_')
      end function word_about

   end subroutine write_collected_table

   !> Whether the name of a table asks for commas.
   pure logical function has_commas(path)
      character(*), intent(in) :: path

      has_commas = lower_case(path(max(1, len(path) - len(comma_ending) + 1):)) == comma_ending
   end function has_commas

   !> Reads a summary: a head whose last line has the units, a line of names, and rows. Errors: exit_file_trouble, also
   !> for one whose rows are not as many as the loads, or not as long as the line of names, or lack words.
   subroutine read_summary(deck, columns, error)
      type(collected_deck), intent(inout) :: deck   !! gets `columns` and `rows`
      integer, intent(in) :: columns                !! the number of columns that a summary has
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: text
      integer :: k, names, rows, units   ! names, rows, units: first byte of these lines in the text
      logical :: is_whole

      call read_file(deck%stem//'.summary.dat', huge(names), text, error)
      if (allocated(error)) return
      units = index(text, newline//'#', back=.true.) + 2
      names = units + index(text(units:), newline)
      rows = names + index(text(names:), newline)
      deck%columns = column_list(text(units:names - 2))
      deck%rows = text(rows:)
      is_whole = deck%rows /= '' .and. len(deck%rows) == deck%loads*(rows - names) .and. size(deck%columns) == columns
      do k = 1, merge(deck%loads, 0, is_whole)
         associate (row => deck%rows((k - 1)*(rows - names) + 1:k*(rows - names)))
            is_whole = is_whole .and. row(len(row):) == newline .and. size(words_of(row(:len(row) - 1))) == columns
         end associate
      end do
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
