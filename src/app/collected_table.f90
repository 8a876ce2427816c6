!> The table of --table: a row for each load of each deck, with the columns of the summary. Its rows are read from the
!> summaries that the runs have written.
module wavycon_collected_table
   use wavycon_deck_keys, only: deck_key
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_memory_table, only: column_list, column_name, column_unit
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, system_words
   use wavycon_settings, only: setting_type
   use wavycon_summary_tables, only: summary_columns
   use wavycon_system, only: make_directories, path_directory, path_kind
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: collected_table

   integer, parameter :: longest_name = 49, longest_word = 32

   !> A deck that was run.
   type :: collected_deck
      character(:), allocatable :: deck, case
      character(:), allocatable :: summary     !! path of its summary table
      type(deck_key), allocatable :: keys(:)   !! the same of each deck
      character(longest_word), allocatable :: units(:)   !! of the columns of the summary
   end type collected_deck

   type :: collected_table
      private
      type(collected_deck), allocatable :: decks(:)
      character(longest_name), allocatable :: columns(:)   !! name[unit] of those of the summary
      integer :: number = 0                    !! of decks that have been added
      character(:), allocatable :: failed      !! lines of the head, for the decks that were not run
   contains
      procedure :: start
      procedure :: add
      procedure :: note_failure
      procedure :: write => write_table
   end type collected_table

contains

   !> Starts an empty table. Its directory is made, so that a bad name is reported before decks are run. Errors:
   !> exit_file_trouble.
   subroutine start(self, path, most_decks, error)
      class(collected_table), intent(out) :: self
      character(*), intent(in) :: path         !! of the file
      integer, intent(in) :: most_decks
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: failure

      allocate (self%decks(most_decks))
      self%columns = column_list(summary_columns)
      self%failed = ''
      call make_directories(directory_of(path), failure)
      if (allocated(failure)) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': its directory cannot be made: '//escaped(failure))
      else if (path_kind(path) == path_directory .or. index(path, '/', back=.true.) == len(path)) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': the table cannot be written: this is a directory')
      end if
   end subroutine start

   !> Adds a deck whose summary has been written.
   subroutine add(self, deck, case, summary, keys)
      class(collected_table), intent(inout) :: self
      character(*), intent(in) :: deck, case      !! its path; the name of its case
      character(*), intent(in) :: summary         !! path of its summary table
      type(deck_key), intent(in) :: keys(:)       !! of the deck

      self%number = self%number + 1
      associate (added => self%decks(self%number))
         added%deck = without_blanks(deck)
         added%case = case
         added%summary = summary
         added%keys = keys
      end associate
   end subroutine add

   !> Notes a deck that was not run to its end, for the head of the table.
   pure subroutine note_failure(self, deck)
      class(collected_table), intent(inout) :: self
      character(*), intent(in) :: deck   !! its path

      self%failed = self%failed//new_line('a')//'# failed: '//escaped(deck)
   end subroutine note_failure

   !> Writes the table. Columns of keys are those that are set on the command line, and those that a deck gives and that
   !> differ between decks. A deck without such a key has NaN there, or '-' in place of a word.
   !>
   !> Errors: exit_file_trouble, also for a summary that cannot be read.
   subroutine write_table(self, path, settings, error)
      class(collected_table), intent(inout) :: self
      character(*), intent(in) :: path
      type(setting_type), intent(in) :: settings(:)   !! of the command line
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: columns(:)
      type(output_file) :: file
      integer :: d

      do d = 1, self%number
         call read_summary(self%decks(d), size(self%columns), error)
         if (allocated(error)) return
      end do
      call choose_columns(self, settings, columns)
      call file%open(directory_of(path), path(index(path, '/', back=.true.) + 1:))
      call file%put('# wavycon '//version//' ('//revision//')'//self%failed)
      call put_columns(self, columns, file)
      do d = 1, self%number
         call read_summary(self%decks(d), size(self%columns), error, columns, file)
         if (allocated(error)) return
      end do
      call file%finish(error)
   end subroutine write_table

   !> Reads the units of a summary, or adds its rows to the table. Errors: exit_file_trouble.
   subroutine read_summary(deck, number, error, columns, file)
      type(collected_deck), intent(inout) :: deck
      integer, intent(in) :: number   !! of the columns of the summary
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: columns(:)              !! the keys that have a column
      type(output_file), intent(inout), optional :: file       !! present with `columns`: rows are added to it

      character(longest_word) :: words(number + 1)   ! the line of the units begins with a '#'
      character(2*longest_word*size(words)) :: line
      character(200) :: message
      character(:), allocatable :: head   ! of rows: deck, case, keys
      integer :: k, status, unit
      logical :: in_head

      open (newunit=unit, file=deck%summary, status='old', action='read', iostat=status, iomsg=message)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(deck%summary)//': cannot be read: '//system_words(message))
         return
      end if
      head = ''
      if (present(columns)) then
         head = deck%deck//' '//deck%case
         do k = 1, size(columns)
            head = head//' '//deck%keys(columns(k))%word
         end do
      end if
      in_head = .true.
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (line(1:1) == '#') then
            call split(line, words)
            cycle
         else if (in_head) then
            ! The line of the names, behind that of the units.
            in_head = .false.
            deck%units = words(2:)
            if (.not. present(file)) exit
            cycle
         end if
         call file%put_words(head//' '//trim(line))
      end do
      close (unit)
   end subroutine read_summary

   !> The first words of a line, without the brackets of units.
   pure subroutine split(line, words)
      character(*), intent(in) :: line
      character(*), intent(out) :: words(:)

      integer :: first, k, length

      words = ''
      first = 1
      do k = 1, size(words)
         first = first + verify(line(first:), ' ') - 1
         length = scan(line(first:), ' ') - 1
         if (length <= 0) return
         words(k) = line(first:first + length - 1)
         if (words(k)(1:1) == '[') words(k) = words(k)(2:length - 1)
         first = first + length
      end do
   end subroutine split

   !> Sets the names, units and widths of all columns.
   subroutine put_columns(table, columns, file)
      type(collected_table), intent(in) :: table
      integer, intent(in) :: columns(:)   !! the keys that have one
      type(output_file), intent(inout) :: file

      integer, parameter :: before = 2   !! columns before those of the keys
      character(longest_name) :: names(before + size(columns) + size(table%columns))
      character(longest_word) :: units(size(names))
      integer :: d, k, longest(size(names))

      names(:before) = [character(4) :: 'deck', 'case']
      units = '-'
      longest = 0
      do k = 1, size(columns)
         names(before + k) = table%decks(1)%keys(columns(k))%name
      end do
      do k = 1, size(table%columns)
         names(before + size(columns) + k) = column_name(table%columns(k))
         units(before + size(columns) + k) = common_unit(table, k)
      end do
      do d = 1, table%number
         longest(1) = max(longest(1), len(table%decks(d)%deck))
         longest(2) = max(longest(2), len(table%decks(d)%case))
         do k = 1, size(columns)
            longest(before + k) = max(longest(before + k), len(table%decks(d)%keys(columns(k))%word))
         end do
      end do
      call file%put_columns(names, units, longest)
   end subroutine put_columns

   !> The keys that have a column, in the order of the first deck in which they have an effect.
   subroutine choose_columns(table, settings, columns)
      type(collected_table), intent(in) :: table
      type(setting_type), intent(in) :: settings(:)
      integer, allocatable, intent(out) :: columns(:)

      integer :: d, k

      allocate (columns(0))
      do d = 1, table%number
         do k = 1, size(table%decks(d)%keys)
            associate (key => table%decks(d)%keys(k))
               if (any(columns == k) .or. .not. key%in_effect) cycle
               if (is_set(key%name, settings) .or. (key%given .and. differs(table, k))) columns = [columns, k]
            end associate
         end do
      end do
   end subroutine choose_columns

   !> Whether the command line sets a key.
   pure logical function is_set(name, settings)
      character(*), intent(in) :: name
      type(setting_type), intent(in) :: settings(:)

      integer :: i

      is_set = .false.
      do i = 1, size(settings)
         is_set = is_set .or. settings(i)%group//'_'//settings(i)%key == name
      end do
   end function is_set

   !> Whether the decks have different values of a key.
   pure logical function differs(table, k)
      type(collected_table), intent(in) :: table
      integer, intent(in) :: k

      integer :: d

      differs = .false.
      do d = 2, table%number
         differs = differs .or. table%decks(d)%keys(k)%word /= table%decks(1)%keys(k)%word
      end do
   end function differs

   !> The unit of a column: as the decks name it if they agree, otherwise 'length' or the like.
   pure function common_unit(table, column) result(unit)
      type(collected_table), intent(in) :: table
      integer, intent(in) :: column
      character(longest_word) :: unit

      integer :: d

      unit = column_unit(table%columns(column))
      do d = 1, table%number
         if (table%decks(d)%units(column) /= table%decks(1)%units(column)) return
      end do
      if (table%number > 0) unit = table%decks(1)%units(column)
   end function common_unit

   !> A text as one word of a table.
   pure function without_blanks(text) result(word)
      character(*), intent(in) :: text
      character(:), allocatable :: word

      integer :: i

      word = escaped(text)
      do i = 1, len(word)
         if (word(i:i) == ' ') word(i:i) = '_'
      end do
   end function without_blanks

   !> The directory of a path; '.' if it has none.
   pure function directory_of(path) result(directory)
      character(*), intent(in) :: path
      character(:), allocatable :: directory

      integer :: slash

      slash = index(path, '/', back=.true.)
      if (slash == 0) then
         directory = '.'
      else
         directory = path(:max(slash - 1, 1))
      end if
   end function directory_of

end module wavycon_collected_table
