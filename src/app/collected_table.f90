!> The table of --table: a row for each load of each deck, with the columns of the summary. Its rows are read from the
!> summaries that the runs have written.
module wavycon_collected_table
   use wavycon_deck_keys, only: deck_key, without_blanks
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

   !> Width of the narrowest column, as in other tables; length of the longest line of a summary.
   integer, parameter :: narrowest = 25, longest_line = 4096

   !> A deck that was run.
   type :: collected_deck
      character(:), allocatable :: deck, case
      character(:), allocatable :: summary     !! path of its summary table
      type(deck_key), allocatable :: keys(:)   !! the same of each deck
      character(:), allocatable :: units       !! line of the units of the summary
   end type collected_deck

   type :: collected_table
      private
      type(collected_deck), allocatable :: decks(:)
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
   !> differ between decks. A deck without such a key has NaN there, or '-' in place of a word. Units are those of the
   !> summaries if these agree, otherwise 'length' or the like.
   !>
   !> Errors: exit_file_trouble, also for a summary that cannot be read.
   subroutine write_table(self, path, settings, error)
      class(collected_table), intent(inout) :: self
      character(*), intent(in) :: path
      type(setting_type), intent(in) :: settings(:)   !! of the command line
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: line, names, units
      integer, allocatable :: columns(:), width(:)
      type(output_file) :: file
      integer :: d, k
      logical :: agree

      call choose_columns(self, settings, columns)
      allocate (width(2 + size(columns)), source=narrowest)
      names = ''
      units = ''
      associate (summary => column_list(summary_columns))
         do k = 1, size(summary)
            names = names//' '//trim(column_name(summary(k)))
            units = units//' ['//trim(column_unit(summary(k)))//']'
         end do
      end associate
      agree = self%number > 0
      do d = 1, self%number
         associate (deck => self%decks(d))
            call read_summary(deck, names, error)
            if (allocated(error)) return
            agree = agree .and. deck%units == self%decks(1)%units
            width(:2) = max(width(:2), [len(deck%deck), len(deck%case)] + 1)
            do k = 1, size(columns)
               width(2 + k) = max(width(2 + k), len(deck%keys(columns(k))%word) + 1, &
                                  len_trim(deck%keys(columns(k))%name) + 1)
            end do
         end associate
      end do
      if (agree) units = self%decks(1)%units
      call file%open(directory_of(path), path(index(path, '/', back=.true.) + 1:))
      call file%put('# wavycon '//version//' ('//revision//')'//self%failed)
      line = ''
      do k = 1, size(width)
         line = line//cell(k, '[-]')
      end do
      call file%put('#'//line(2:)//' '//units)
      line = cell(1, 'deck')//cell(2, 'case')
      do k = 1, size(columns)
         line = line//cell(2 + k, trim(self%decks(1)%keys(columns(k))%name))
      end do
      call file%put(line//names)
      do d = 1, self%number
         associate (deck => self%decks(d))
            line = cell(1, deck%deck)//cell(2, deck%case)
            do k = 1, size(columns)
               line = line//cell(2 + k, deck%keys(columns(k))%word)
            end do
            call read_summary(deck, names, error, file, line)
            if (allocated(error)) return
         end associate
      end do
      call file%finish(error)

   contains

      !> A word at the right of a column.
      pure function cell(column, word) result(text)
         integer, intent(in) :: column
         character(*), intent(in) :: word
         character(:), allocatable :: text

         text = repeat(' ', width(column) - len(word))//word
      end function cell

   end subroutine write_table

   !> Reads the lines of the units and the names of a summary, or adds its rows to the table. Errors: exit_file_trouble.
   subroutine read_summary(deck, names, error, file, before)
      type(collected_deck), intent(inout) :: deck
      character(:), allocatable, intent(inout) :: names
      type(error_type), allocatable, intent(out) :: error
      type(output_file), intent(inout), optional :: file   !! rows are added to it
      character(*), intent(in), optional :: before         !! of each row

      character(longest_line) :: line
      character(200) :: message
      integer :: status, unit
      logical :: in_head

      open (newunit=unit, file=deck%summary, status='old', action='read', iostat=status, iomsg=message)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(deck%summary)//': cannot be read: '//system_words(message))
         return
      end if
      in_head = .true.
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (line(1:1) == '#') then
            deck%units = trim(line(2:))
         else if (in_head) then
            in_head = .false.
            names = trim(line)
            if (.not. present(file)) exit
         else
            call file%put(before//trim(line))
         end if
      end do
      close (unit)
   end subroutine read_summary

   !> The keys that have a column, in the order of the first deck in which they have an effect.
   subroutine choose_columns(table, settings, columns)
      type(collected_table), intent(in) :: table
      type(setting_type), intent(in) :: settings(:)
      integer, allocatable, intent(out) :: columns(:)

      integer :: d, i, k
      logical :: differs, is_set

      allocate (columns(0))
      do d = 1, table%number
         do k = 1, size(table%decks(d)%keys)
            associate (key => table%decks(d)%keys(k))
               if (any(columns == k) .or. .not. key%in_effect) cycle
               is_set = any([(settings(i)%group//'_'//settings(i)%key == key%name, i=1, size(settings))])
               differs = any([(table%decks(i)%keys(k)%word /= table%decks(1)%keys(k)%word, i=2, table%number)])
               if (is_set .or. (key%given .and. differs)) columns = [columns, k]
            end associate
         end do
      end do
   end subroutine choose_columns

   !> The directory of a path; '.' if it has none.
   pure function directory_of(path) result(directory)
      character(*), intent(in) :: path
      character(:), allocatable :: directory

      directory = path(:max(index(path, '/', back=.true.) - 1, 0))
      if (directory == '') directory = trim(merge('/', '.', index(path, '/') == 1))
   end function directory_of

end module wavycon_collected_table
