!> Result files, written as written_file.c says. A table may be written to memory in place of a file: it gets columns
!> and rows, and lines by `put` are left out.
!>
!> A table has header lines that start with '#', the last of them with the units of the columns, then one line with
!> their names, then rows. gnuplot, numpy and pandas find columns by these names.
module wavycon_output_file
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_type, longest_column, memory_table, of_words
   use wavycon_plain_text, only: escaped, newline
   use wavycon_system, only: end_written, error_text, open_written, put_bytes, put_text
   implicit none (type, external)
   private

   public :: output_file

   !> The narrowest column: a real number of 16 digits with a three-digit exponent, and a blank before it.
   integer, parameter :: narrowest = 25

   interface
      !> Writes numbers to a line, each at the right of its column: row_text.c.
      pure subroutine put_in_columns(columns, kinds, ends, numbers, line) bind(c, name='wavycon_put_in_columns')
         import :: c_char, c_double, c_int
         integer(c_int), value :: columns
         integer(c_int), intent(in) :: kinds(*), ends(*)          !! of each column, as of output_file
         real(c_double), intent(in) :: numbers(*)                 !! of the columns without words
         character(kind=c_char), intent(inout) :: line(*)
      end subroutine put_in_columns
   end interface

   type :: output_file
      private
      type(memory_table), pointer, public :: memory => null()   !! in place of the file; exists until `finish`
      type(c_ptr) :: file = c_null_ptr            !! of open_written
      character(:), allocatable :: name
      character(:), allocatable :: trouble        !! first error; not allocated if there was none
      type(column_type), allocatable :: columns(:)   !! not allocated if the file is no table
      logical :: has_names = .false.              !! whether the line of the names was written
      integer :: blocks = 0                       !! data sets begun by begin_block
      integer(c_int), allocatable :: column_end(:)       !! position in a row at which each column ends
      integer(c_int), allocatable :: kinds(:)            !! what the values of each column are
   contains
      procedure :: open => open_file
      procedure :: is_open
      procedure :: put
      procedure :: put_numbers
      procedure :: put_columns
      procedure :: begin_block
      procedure :: put_row
      procedure :: note_trouble
      procedure :: finish
   end type output_file

contains

   !> Opens a file for writing. `finish` reports errors.
   subroutine open_file(self, directory, name, head)
      class(output_file), intent(out) :: self
      character(*), intent(in) :: directory      !! existing
      character(*), intent(in) :: name           !! of the file in the directory
      character(*), intent(in), optional :: head !! the first bytes of a binary file; if absent it is a text

      self%name = directory//'/'//name
      self%file = open_written(self%name//c_null_char)
      if (present(head)) call check(self, put_text(self%file, head, len(head, c_size_t)))
   end subroutine open_file

   !> Whether the file is open and no error has occurred.
   pure logical function is_open(self)
      class(output_file), intent(in) :: self

      is_open = .not. allocated(self%trouble)
   end function is_open

   !> Writes a line.
   subroutine put(self, line)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: line

      if (allocated(self%trouble) .or. associated(self%memory)) return
      call check(self, put_text(self%file, line//newline, len(line, c_size_t) + 1))
   end subroutine put

   !> Writes numbers to a binary file, in the order of the array.
   subroutine put_numbers(self, numbers)
      class(output_file), intent(inout) :: self
      real(dp), intent(in), contiguous :: numbers(:, :)

      if (allocated(self%trouble)) return
      call check(self, put_bytes(self%file, numbers, size(numbers, kind=c_size_t)*storage_size(numbers)/8))
   end subroutine put_numbers

   !> Sets the columns and writes the header line of their units. That of their names follows at the head of each block
   !> or, without blocks, before the first row.
   subroutine put_columns(self, columns)
      class(output_file), intent(inout) :: self
      type(column_type), intent(in) :: columns(:)   !! names without blanks; units are shown in brackets

      character(longest_column + 2) :: in_brackets(size(columns))
      character(:), allocatable :: line
      integer :: i, last, width

      if (associated(self%memory)) call self%memory%start(columns)
      self%kinds = int(columns%kind, c_int)
      self%columns = columns
      allocate (self%column_end(size(columns)))
      last = 0
      do i = 1, size(columns)
         in_brackets(i) = '['//trim(columns(i)%unit)//']'
         width = max(narrowest, len_trim(columns(i)%name) + 1, len_trim(in_brackets(i)) + merge(2, 1, i == 1))
         last = last + width
         self%column_end(i) = last
      end do
      line = aligned(self, in_brackets)
      line(1:1) = '#'
      call self%put(line)
   end subroutine put_columns

   !> A line with words at the right of their columns.
   pure function aligned(self, words) result(line)
      type(output_file), intent(in) :: self
      character(*), intent(in) :: words(:)   !! one for each column
      character(:), allocatable :: line

      integer :: i

      line = repeat(' ', self%column_end(size(words)))
      do i = 1, size(words)
         line(self%column_end(i) - len_trim(words(i)) + 1:self%column_end(i)) = trim(words(i))
      end do
   end function aligned

   !> Writes the line with the names of the columns.
   subroutine put_names(self)
      type(output_file), intent(inout) :: self

      self%has_names = .true.
      call self%put(aligned(self, self%columns%name))
   end subroutine put_names

   !> Begins a data set of gnuplot's `index`: two blank lines, unless it is the first, a comment, and the names of the
   !> columns, which gnuplot looks for at the head of each data set.
   subroutine begin_block(self, comment)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: comment

      if (self%blocks > 0) call self%put(newline)
      self%blocks = self%blocks + 1
      call self%put('# '//comment)
      call put_names(self)
   end subroutine begin_block

   !> Writes a row.
   subroutine put_row(self, numbers, words)
      class(output_file), intent(inout) :: self
      real(dp), intent(in) :: numbers(:)               !! of the columns of integers and of numbers
      character(*), intent(in), optional :: words(:)   !! of the columns of words; without blanks

      character(:), allocatable :: line
      integer :: i, k

      if (associated(self%memory)) then
         call self%memory%add_row(numbers, words)
         return
      end if
      if (.not. self%has_names) call put_names(self)
      line = repeat(' ', self%column_end(size(self%kinds)))
      call put_in_columns(size(self%kinds, kind=c_int), self%kinds, self%column_end, numbers, line)
      if (present(words)) then
         k = 0
         do i = 1, size(words)
            k = k + findloc(self%kinds(k + 1:), of_words, dim=1)
            line(self%column_end(k) - len_trim(words(i)) + 1:self%column_end(k)) = trim(words(i))
         end do
      end if
      call self%put(line)
   end subroutine put_row

   !> Records the error of the file, if there is one.
   subroutine check(self, number)
      class(output_file), intent(inout) :: self
      integer(c_int), intent(in) :: number   !! as of error_text

      if (number /= 0) call self%note_trouble(error_text(number))
   end subroutine check

   !> Records an error: `finish` will report it and remove the file.
   subroutine note_trouble(self, message)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: message

      if (.not. allocated(self%trouble)) self%trouble = message
   end subroutine note_trouble

   !> Closes the file and gives it its name; after an error the file is removed instead. Errors: exit_file_trouble.
   subroutine finish(self, error)
      class(output_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (associated(self%memory)) then
         if (self%memory%is_full) call self%note_trouble('there is not the memory for all rows')
         if (allocated(self%trouble)) call fatal_error(error, exit_file_trouble, 'table in memory: '//self%trouble)
         return
      end if
      if (allocated(self%columns) .and. .not. self%has_names) call put_names(self)
      call check(self, end_written(self%file, merge(1_c_int, 0_c_int, self%is_open()), 0_c_int))
      if (allocated(self%trouble)) &
         call fatal_error(error, exit_file_trouble, escaped(self%name)//': cannot be written: '//self%trouble)
   end subroutine finish

end module wavycon_output_file
