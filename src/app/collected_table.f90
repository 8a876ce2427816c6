!> The table of --table: a row for each load of each deck, with the columns of the summary.
module wavycon_collected_table
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_deck_jobs, only: send_bytes, take_bytes
   use wavycon_deck_keys, only: deck_key
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_memory_table, only: column_name, column_unit, memory_table
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped
   use wavycon_results, only: results_type
   use wavycon_settings, only: setting_type
   use wavycon_summary_table, only: put_summary_row, summary_columns
   use wavycon_system, only: make_directories, path_directory, path_kind
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: collected_table

   integer, parameter :: longest_name = 49, longest_unit = 24

   !> The rows of one deck.
   type :: deck_rows
      character(:), allocatable :: deck, case
      type(deck_key), allocatable :: keys(:)   !! the same of each deck
      character(longest_unit) :: units(size(summary_columns)) = ''
      type(memory_table) :: summary
   end type deck_rows

   type :: collected_table
      private
      type(deck_rows), allocatable :: decks(:)
      integer :: number = 0                    !! of decks that have been added
      character(:), allocatable :: failed      !! lines of the head, for the decks that were not run
   contains
      procedure :: start
      procedure :: add
      procedure :: send
      procedure :: take
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

   !> Adds the loads of a deck.
   subroutine add(self, results, keys)
      class(collected_table), intent(inout), target :: self
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(deck_key), intent(in) :: keys(:)       !! of the deck

      type(output_file) :: file
      integer :: i

      self%number = self%number + 1
      associate (rows => self%decks(self%number))
         rows%deck = without_blanks(results%scene%deck_path)
         rows%case = results%scene%case
         rows%keys = keys
         do i = 1, size(summary_columns)
            rows%units(i) = results%unit_in_words(trim(column_unit(summary_columns(i))))
         end do
      end associate
      call file%open_in_memory(self%decks(self%number)%summary)
      call file%put_columns(column_name(summary_columns), column_unit(summary_columns))
      do i = 1, size(results%loads)
         call put_summary_row(results, i, file)
      end do
   end subroutine add

   !> Sends the rows of the last deck, in the process of a job.
   subroutine send(self)
      class(collected_table), intent(in) :: self

      integer(int8), parameter :: byte(1) = 0_int8

      associate (rows => self%decks(self%number), summary => self%decks(self%number)%summary)
         call send_bytes(transfer([len(rows%deck), len(rows%case), summary%rows, size(summary%words)], byte))
         call send_bytes(transfer(rows%deck//rows%case, byte))
         call send_bytes(transfer(rows%units, byte))
         call send_bytes(transfer(summary%kinds, byte))
         call send_bytes(transfer(summary%values(:, :summary%rows), byte))
         call send_bytes(transfer(summary%words, byte))
      end associate
   end subroutine send

   !> Takes the rows that a job has sent. Errors: exit_file_trouble if they are not all there.
   subroutine take(self, job, keys, error)
      class(collected_table), intent(inout), target :: self
      integer, intent(in) :: job
      type(deck_key), intent(in) :: keys(:)       !! of its deck
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: names
      integer :: numbers(4)
      integer(int8), allocatable :: bytes(:)
      type(output_file) :: file

      call take_bytes(job, storage_size(numbers)*4/8, bytes)
      if (size(bytes) == 0) then
         call fatal_error(error, exit_file_trouble, 'the rows of a deck for the table are not there')
         return
      end if
      numbers = transfer(bytes, numbers)
      self%number = self%number + 1
      call file%open_in_memory(self%decks(self%number)%summary)
      call file%put_columns(column_name(summary_columns), column_unit(summary_columns))
      associate (rows => self%decks(self%number), summary => self%decks(self%number)%summary)
         rows%keys = keys
         call take_bytes(job, numbers(1) + numbers(2), bytes)
         names = transfer(bytes, repeat(' ', size(bytes)))
         rows%deck = names(:numbers(1))
         rows%case = names(numbers(1) + 1:)
         call take_bytes(job, longest_unit*size(rows%units), bytes)
         rows%units = transfer(bytes, rows%units)
         call take_bytes(job, storage_size(summary%kinds)/8*size(summary%kinds), bytes)
         summary%kinds = transfer(bytes, summary%kinds)
         summary%rows = numbers(3)
         deallocate (summary%values, summary%words)
         allocate (summary%values(size(summary%kinds), numbers(3)), summary%words(numbers(4)))
         call take_bytes(job, storage_size(summary%values)/8*size(summary%values), bytes)
         summary%values = reshape(transfer(bytes, summary%values), shape(summary%values))
         call take_bytes(job, len(summary%words)*size(summary%words), bytes)
         summary%words = transfer(bytes, summary%words)
      end associate
   end subroutine take

   !> Notes a deck that was not run to its end, for the head of the table.
   pure subroutine note_failure(self, deck)
      class(collected_table), intent(inout) :: self
      character(*), intent(in) :: deck   !! its path

      self%failed = self%failed//new_line('a')//'# failed: '//escaped(deck)
   end subroutine note_failure

   !> Writes the table. Columns of keys are those that are set on the command line, and those that a deck gives and that
   !> differ between decks. A deck without such a key has NaN there, or '-' in place of a word.
   !>
   !> Errors: exit_file_trouble.
   subroutine write_table(self, path, settings, error)
      class(collected_table), intent(in) :: self
      character(*), intent(in) :: path
      type(setting_type), intent(in) :: settings(:)   !! of the command line
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: columns(:)
      type(output_file) :: file
      integer :: d, i, k

      call choose_columns(self, settings, columns)
      call file%open(directory_of(path), path(index(path, '/', back=.true.) + 1:))
      call file%put('# wavycon '//version//' ('//revision//')'//self%failed)
      call put_columns(self, columns, file)
      do d = 1, self%number
         associate (rows => self%decks(d))
            do i = 1, rows%summary%rows
               call file%add(rows%deck)
               call file%add(rows%case)
               do k = 1, size(columns)
                  call file%add(rows%keys(columns(k))%word)
               end do
               call file%add_row_of(rows%summary, i)
               call file%end_row()
            end do
         end associate
      end do
      call file%finish(error)
   end subroutine write_table

   !> Sets the names, units and widths of all columns.
   subroutine put_columns(table, columns, file)
      type(collected_table), intent(in) :: table
      integer, intent(in) :: columns(:)   !! the keys that have one
      type(output_file), intent(inout) :: file

      integer, parameter :: before = 2   !! columns before those of the keys
      character(longest_name) :: names(before + size(columns) + size(summary_columns))
      character(longest_unit) :: units(size(names))
      integer :: d, k, longest(size(names))

      names(:before) = [character(4) :: 'deck', 'case']
      units = '-'
      longest = 0
      do k = 1, size(columns)
         names(before + k) = table%decks(1)%keys(columns(k))%name
      end do
      do k = 1, size(summary_columns)
         names(before + size(columns) + k) = column_name(summary_columns(k))
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
      character(longest_unit) :: unit

      unit = column_unit(summary_columns(column))
      if (table%number == 0) return
      if (all(table%decks(:table%number)%units(column) == table%decks(1)%units(column))) &
         unit = table%decks(1)%units(column)
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
