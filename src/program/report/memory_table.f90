!> A table in memory, whose columns are arrays of numbers. `output_file` writes a table to memory in place of a file.
!> Columns are declared as name[unit]. A column of the unit '#' has integers, one of the unit 'word' has words.
module wavycon_memory_table
   use wavycon_kinds, only: dp, int64
   use wavycon_plain_text, only: newline
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: column_list, column_type, memory_table

   !> The kinds of values that a column has.
   integer, parameter, public :: of_reals = 1, of_integers = 2, of_words = 3

   !> Most bytes of the name or the unit of a column, such as that of an energy, which is made of labels of a pressure
   !> and of lengths of at most 20 bytes each; and of a word in a table.
   integer, parameter, public :: longest_column = 64
   integer, parameter, public :: longest_word = 32
   !> Rows for which a new table has memory.
   integer, parameter :: first_rows = 64

   type :: column_type
      character(longest_column) :: name = '', unit = ''     !! the unit of integers and words is '-'
      integer :: kind = of_reals                            !! of_reals, of_integers or of_words
   end type column_type

   type :: memory_table
      type(column_type), allocatable :: columns(:)
      integer :: rows = 0                                   !! number of rows so far
      real(dp), allocatable :: values(:, :)                 !! shape (columns, rows or more)
      !> All words of the table, each once. In place of a word `values` has the word's number in this list, from 1.
      character(longest_word), allocatable :: words(:)
      logical :: is_full = .false.                          !! whether memory was too short for further rows
   contains
      procedure :: start, add_row, find_column, text
   end type memory_table

contains

   !> Starts an empty table.
   subroutine start(self, columns)
      class(memory_table), intent(out) :: self
      type(column_type), intent(in) :: columns(:)

      self%columns = columns
      allocate (self%values(size(columns), first_rows), self%words(0))
   end subroutine start

   !> Adds a row. If there is not enough memory for the row, it is lost and `is_full` becomes .true.
   subroutine add_row(self, numbers, words)
      class(memory_table), intent(inout) :: self
      real(dp), intent(in) :: numbers(:)               !! values of the columns of integers and of numbers, in order
      character(*), intent(in), optional :: words(:)   !! values of the columns of words, <= longest_word bytes

      integer :: i
      logical :: is_word(size(self%columns))
      real(dp), allocatable :: longer(:, :)

      if (self%rows == size(self%values, 2)) then
         self%is_full = .not. has_memory_for(2*size(self%values, kind=int64))
         if (self%is_full) return
         allocate (longer(size(self%columns), 2*self%rows))
         longer(:, :self%rows) = self%values
         call move_alloc(longer, self%values)
      end if
      self%rows = self%rows + 1
      is_word = self%columns%kind == of_words
      associate (row => self%values(:, self%rows))
         row = unpack(numbers, .not. is_word, 0.0_dp)
         if (present(words)) row = unpack([(real(number_of_word(self, words(i)), dp), i=1, size(words))], is_word, row)
      end associate
   end subroutine add_row

   !> The number of a word in the list of words. A new word is added to the list.
   integer function number_of_word(self, word) result(number)
      type(memory_table), intent(inout) :: self
      character(*), intent(in) :: word   !! at most longest_word bytes

      number = findloc(self%words == word, .true., dim=1)
      if (number > 0) return
      self%words = [character(longest_word) :: self%words, word]
      number = size(self%words)
   end function number_of_word

   !> The number of the column with a name; 0 if there is none.
   pure integer function find_column(self, name) result(column)
      class(memory_table), intent(in) :: self
      character(*), intent(in) :: name

      column = 0
      if (allocated(self%columns)) column = findloc(self%columns%name == name, .true., dim=1)
   end function find_column

   !> One of two lists as text, a line for each entry.
   pure subroutine text(self, name, lines)
      class(memory_table), intent(in) :: self
      !> 'columns': name[unit] of each column, with the unit 'word' for columns of words; 'words': the list of words.
      character(*), intent(in) :: name
      !> Lines separated by newlines, the last without one; not allocated for another name.
      character(:), allocatable, intent(out) :: lines

      integer :: entries, i

      if (name /= 'columns' .and. name /= 'words') return
      lines = ''
      entries = size(self%columns)
      if (name == 'words') entries = size(self%words)
      do i = 1, entries
         if (i > 1) lines = lines//newline
         if (name == 'words') then
            lines = lines//trim(self%words(i))
         else if (self%columns(i)%kind == of_words) then
            lines = lines//trim(self%columns(i)%name)//'[word]'
         else
            lines = lines//trim(self%columns(i)%name)//'['//trim(self%columns(i)%unit)//']'
         end if
      end do
   end subroutine text

   !> The columns that a text declares.
   pure function column_list(text) result(columns)
      character(*), intent(in) :: text   !! name[unit] of each column, with a blank between two
      type(column_type), allocatable :: columns(:)

      integer :: behind, first, i, last

      allocate (columns(count([(text(i:i) == ']', i=1, len(text))])))
      first = 1
      do i = 1, size(columns)
         behind = first + index(text(first:), '[') - 1
         last = first + index(text(first:), ']') - 1
         columns(i) = column_type(text(first:behind - 1), text(behind + 1:last - 1))
         if (columns(i)%unit == '#') columns(i)%kind = of_integers
         if (columns(i)%unit == 'word') columns(i)%kind = of_words
         if (columns(i)%kind /= of_reals) columns(i)%unit = '-'
         first = last + 2
      end do
   end function column_list

end module wavycon_memory_table
