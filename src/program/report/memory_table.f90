!> A table in memory: its columns as numbers. `output_file` writes tables to it in place of a file. Columns are declared
!> as name[unit]: those of the unit '#' have integers, those of the unit 'word' have words.
module wavycon_memory_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: newline
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: column_kind, column_list, column_name, column_unit, memory_table

   !> What the values of a column are.
   integer, parameter, public :: of_reals = 1, of_integers = 2, of_words = 3

   !> Bytes of name[unit].
   integer, parameter, public :: longest_column = 48
   integer, parameter, public :: longest_word = 32
   integer, parameter :: first_room = 64

   type :: memory_table
      character(longest_column), allocatable :: names(:), units(:)   !! of the columns
      integer, allocatable :: kinds(:)                      !! of the columns, names above
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
   subroutine start(self, names, units, kinds)
      class(memory_table), intent(out) :: self
      character(*), intent(in) :: names(:)
      character(*), intent(in) :: units(:)   !! as many
      integer, intent(in) :: kinds(:)        !! as many

      self%names = [character(longest_column) :: names]
      self%units = [character(longest_column) :: units]
      self%kinds = kinds
      allocate (self%values(size(names), first_room), self%words(0))
   end subroutine start

   !> Adds a row.
   subroutine add_row(self, numbers, words)
      class(memory_table), intent(inout) :: self
      real(dp), intent(in) :: numbers(:)               !! of the columns of integers and of numbers
      character(*), intent(in), optional :: words(:)   !! of the columns of words, of at most longest_word bytes

      integer :: i
      logical :: is_word(size(self%kinds))
      real(dp), allocatable :: longer(:, :)

      if (self%rows == size(self%values, 2)) then
         self%is_full = .not. has_memory_for(2*size(self%values, kind=int64))
         if (self%is_full) return
         allocate (longer(size(self%kinds), 2*self%rows))
         longer(:, :self%rows) = self%values
         call move_alloc(longer, self%values)
      end if
      self%rows = self%rows + 1
      is_word = self%kinds == of_words
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
      if (allocated(self%names)) column = findloc(self%names == name, .true., dim=1)
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
      do i = 1, merge(size(self%names), size(self%words), name == 'columns')
         if (i > 1) lines = lines//newline
         if (name == 'words') then
            lines = lines//trim(self%words(i))
         else if (self%kinds(i) == of_words) then
            lines = lines//trim(self%names(i))//'[word]'
         else
            lines = lines//trim(self%names(i))//'['//trim(self%units(i))//']'
         end if
      end do
   end subroutine text

   !> The columns in a text, name[unit] of each.
   pure function column_list(text) result(columns)
      character(*), intent(in) :: text   !! with a blank between two
      character(longest_column), allocatable :: columns(:)

      integer :: first, i, length

      allocate (columns(count([(text(i:i) == ']', i=1, len(text))])))
      first = 1
      do i = 1, size(columns)
         length = index(text(first:), ']')
         columns(i) = text(first:first + length - 1)
         first = first + length + 1
      end do
   end function column_list

   !> The name in name[unit].
   elemental function column_name(column) result(name)
      character(*), intent(in) :: column
      character(len(column)) :: name

      name = column(:index(column, '[') - 1)
   end function column_name

   !> The unit in name[unit]; '-' of integers and words.
   elemental function column_unit(column) result(unit)
      character(*), intent(in) :: column
      character(len(column)) :: unit

      unit = column(index(column, '[') + 1:index(column, ']') - 1)
      if (column_kind(column) /= of_reals) unit = '-'
   end function column_unit

   !> What the values of a column are, by its unit.
   elemental integer function column_kind(column) result(kind)
      character(*), intent(in) :: column   !! name[unit]

      kind = of_reals
      if (index(column, '[#]') > 0) kind = of_integers
      if (index(column, '[word]') > 0) kind = of_words
   end function column_kind

end module wavycon_memory_table
