!> A table in memory: its columns as numbers. `output_file` writes tables to it in place of a file. Columns are declared
!> as name[unit]: those of the unit '#' have integers, those of the unit 'word' have words.
module wavycon_memory_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: newline
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: column_list, column_type, memory_table

   !> What the values of a column are.
   integer, parameter, public :: of_reals = 1, of_integers = 2, of_words = 3

   !> Bytes of a name or a unit.
   integer, parameter, public :: longest_column = 48
   integer, parameter, public :: longest_word = 32
   integer, parameter :: first_room = 64

   type :: column_type
      character(longest_column) :: name = '', unit = ''     !! '-' is the unit of integers and words
      integer :: kind = of_reals                            !! what its values are
   end type column_type

   type :: memory_table
      type(column_type), allocatable :: columns(:)
      integer :: rows = 0
      real(dp), allocatable :: values(:, :)                 !! shape (columns, rows or more)
      !> A column of words has their numbers in this list, from 1.
      character(longest_word), allocatable :: words(:)
      logical :: is_full = .false.                          !! whether there was not the memory for all rows
   contains
      procedure :: start
      procedure :: add_row
      procedure :: find_column
      procedure :: text
   end type memory_table

contains

   !> Starts an empty table.
   subroutine start(self, columns)
      class(memory_table), intent(out) :: self
      type(column_type), intent(in) :: columns(:)

      self%columns = columns
      allocate (self%values(size(columns), first_room), self%words(0))
   end subroutine start

   !> Adds a row.
   subroutine add_row(self, numbers, words)
      class(memory_table), intent(inout) :: self
      real(dp), intent(in) :: numbers(:)               !! of the columns of integers and of numbers
      character(*), intent(in), optional :: words(:)   !! of the columns of words, of at most longest_word bytes

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

   !> The number of a word, which is added to the list if it is new.
   integer function number_of_word(self, word) result(number)
      type(memory_table), intent(inout) :: self
      character(*), intent(in) :: word   !! at most longest_word bytes

      number = findloc(self%words == word, .true., dim=1)
      if (number > 0) return
      self%words = [character(longest_word) :: self%words, word]
      number = size(self%words)
   end function number_of_word

   !> The number of a column; 0 if there is none of this name.
   pure integer function find_column(self, name) result(column)
      class(memory_table), intent(in) :: self
      character(*), intent(in) :: name

      column = 0
      if (allocated(self%columns)) column = findloc(self%columns%name == name, .true., dim=1)
   end function find_column

   !> Lines, without a newline behind the last: 'columns', name[unit] of each, the unit of a column of words being
   !> 'word'; 'words', the list of words. Not allocated for another name.
   pure subroutine text(self, name, lines)
      class(memory_table), intent(in) :: self
      character(*), intent(in) :: name
      character(:), allocatable, intent(out) :: lines

      integer :: i

      if (name /= 'columns' .and. name /= 'words') return
      lines = ''
      do i = 1, merge(size(self%columns), size(self%words), name == 'columns')
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

   !> The columns in a text, name[unit] of each.
   pure function column_list(text) result(columns)
      character(*), intent(in) :: text   !! with a blank between two
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
