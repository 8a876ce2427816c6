!> Result files. A file gets its name when it is complete (src/base/system/written_file.c). A table may be written to
!> memory in place of a file: the table in memory gets columns and rows, while lines written by `put` are left out. A
!> second file, or that file alone, may get the same table with commas between words, for spreadsheets.
!>
!> A table has header lines that start with '#', the last of them with the units of the columns, then one line with
!> their names, then rows. gnuplot, numpy and pandas find columns by these names.
module wavycon_output_file
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_type, longest_column, memory_table, of_words
   use wavycon_plain_text, only: escaped, newline, with_mark
   use wavycon_system, only: end_written, error_text, open_written, path_file, path_kind, put_bytes, put_text, &
      refusal_to_write, remove_file
   implicit none (type, external)
   private

   public :: output_file

   !> How tables and files of numpy begin: a file of this name that begins otherwise is not replaced.
   character(*), parameter, public :: table_mark = '# wavycon ', npy_mark = char(147)//'NUMPY'

   !> Width of the narrowest column: a real number of 16 digits with a three-digit exponent, and blanks before it.
   integer, parameter :: narrowest = 25

   interface
      !> Writes numbers to a line, each at the right of its column: row_text.c.
      pure subroutine put_in_columns(columns, kinds, ends, numbers, line) bind(c, name='wavycon_put_in_columns')
         import :: c_char, c_double, c_int
         integer(c_int), value :: columns
         integer(c_int), intent(in) :: kinds(*), ends(*)          !! `kinds` and `column_end` of output_file
         real(c_double), intent(in) :: numbers(*)                 !! values of the columns that do not have words
         character(kind=c_char), intent(inout) :: line(*)         !! blanks on entry, ends(columns) bytes
      end subroutine put_in_columns
   end interface

   !> A file of an earlier run, of the same table in another format.
   type :: replaced_file
      character(:), allocatable :: name   !! path; not allocated if there is no such file
      character(:), allocatable :: mark   !! its first bytes
   end type replaced_file

   type :: output_file
      private
      !> The table in memory that replaces the file; it must exist until `finish` is called.
      type(memory_table), pointer, public :: memory => null()
      type(c_ptr) :: file = c_null_ptr            !! the open file, from open_written, if `name` is allocated
      type(c_ptr) :: commas = c_null_ptr          !! the open file of the same table with commas, without a head
      character(:), allocatable :: comma_name     !! path of this file; not allocated if it is not written
      type(replaced_file) :: replaced(2)          !! files that `finish` removes
      character(:), allocatable :: name           !! path of the file; not allocated if it is not written
      character(:), allocatable :: trouble        !! message of the first error; not allocated if there was none
      type(column_type), allocatable :: columns(:)   !! columns of a table; not allocated for other files
      logical :: has_names = .false.              !! whether the line with the names of the columns was written
      integer :: blocks = 0                       !! number of data sets begun by begin_block
      integer(c_int), allocatable :: column_end(:)       !! position in a row at which each column ends
      integer(c_int), allocatable :: kinds(:)            !! kind of each column: of_reals, of_integers, of_words
   contains
      procedure :: open => open_file
      procedure :: replace, is_open, put, put_numbers
      procedure :: put_columns, begin_block, put_row, note_trouble, finish
   end type output_file

contains

   !> Opens a file for writing. `finish` reports the errors of this and of all other procedures.
   subroutine open_file(self, path, head, comma_path)
      class(output_file), intent(out) :: self
      character(*), intent(in), optional :: path   !! in an existing directory; absent: only the file with commas
      character(*), intent(in), optional :: head   !! the first bytes of a binary file; if absent it is a text
      character(*), intent(in), optional :: comma_path   !! path of the file of the same table with commas

      if (present(path)) then
         self%name = path
         self%file = open_written(path//c_null_char)
      end if
      if (present(comma_path)) then
         self%comma_name = comma_path
         self%commas = open_written(comma_path//c_null_char)
      end if
      if (present(head)) call check(self, put_text(self%file, head, len(head, c_size_t)))
   end subroutine open_file

   !> Makes `finish` remove a file of an earlier run that has the same table in another format, at most two such files.
   subroutine replace(self, ending, mark)
      class(output_file), intent(inout) :: self   !! with a path that has an ending
      character(*), intent(in) :: ending          !! ending of its name, in place of that of this file
      character(*), intent(in) :: mark            !! the first bytes of such a file; another file of this name stays

      integer :: i

      i = merge(2, 1, allocated(self%replaced(1)%name))
      self%replaced(i)%name = self%name(:index(self%name, '.', back=.true.) - 1)//ending
      self%replaced(i)%mark = mark
   end subroutine replace

   !> Whether the file is open and no error has occurred.
   pure logical function is_open(self)
      class(output_file), intent(in) :: self

      is_open = .not. allocated(self%trouble)
   end function is_open

   !> Writes a line. A table in memory and one with commas do not get it.
   subroutine put(self, line)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: line

      if (allocated(self%trouble) .or. .not. allocated(self%name)) return
      call check(self, put_text(self%file, line//newline, len(line, c_size_t) + 1))
   end subroutine put

   !> Writes numbers to a binary file, in the order of the array's elements in memory.
   subroutine put_numbers(self, numbers)
      class(output_file), intent(inout) :: self
      real(dp), intent(in), contiguous :: numbers(:, :)

      if (allocated(self%trouble)) return
      call check(self, put_bytes(self%file, numbers, size(numbers, kind=c_size_t)*storage_size(numbers)/8))
   end subroutine put_numbers

   !> Sets the columns and writes the header line of their units. The line of their names follows at the head of each
   !> block or, without blocks, before the first row.
   subroutine put_columns(self, columns, least_width)
      class(output_file), intent(inout) :: self
      type(column_type), intent(in) :: columns(:)   !! names without blanks; units are shown in brackets
      integer, intent(in), optional :: least_width(:)   !! of columns with long words

      character(longest_column + 2) :: in_brackets(size(columns))
      character(:), allocatable :: units
      integer :: i, last, width

      if (associated(self%memory)) call self%memory%start(columns)
      self%kinds = int(columns%kind, c_int)
      self%columns = columns
      allocate (self%column_end(size(columns)))
      last = 0
      do i = 1, size(columns)
         in_brackets(i) = '['//trim(columns(i)%unit)//']'
         width = max(narrowest, len_trim(columns(i)%name) + 1, len_trim(in_brackets(i)) + merge(2, 1, i == 1))
         if (present(least_width)) width = max(width, least_width(i))
         last = last + width
         self%column_end(i) = last
      end do
      units = repeat(' ', last)
      call put_at(units, self%column_end, in_brackets)
      call self%put('#'//units(2:))
   end subroutine put_columns

   !> Writes the line with the names of the columns; with commas only the first time, and with the units.
   subroutine put_names(self)
      type(output_file), intent(inout) :: self

      character(:), allocatable :: line

      line = repeat(' ', maxval(self%column_end))
      call put_at(line, self%column_end, self%columns%name)
      if (self%has_names) then
         call self%put(line)
      else
         call put_words(self, line)
      end if
      self%has_names = .true.
   end subroutine put_names

   !> Puts words at the right of columns.
   pure subroutine put_at(line, ends, words)
      character(*), intent(inout) :: line    !! blank in these columns
      integer(c_int), intent(in) :: ends(:)  !! where these columns end
      character(*), intent(in) :: words(:)

      integer :: i

      do i = 1, size(words)
         line(ends(i) - len_trim(words(i)) + 1:ends(i)) = trim(words(i))
      end do
   end subroutine put_at

   !> Writes a line of the words of all columns: to the file, and with commas between them. There the names, which are
   !> the first line, have units but [-] behind them. A word that has commas or quotes stands in quotes, and its quotes
   !> are doubled (RFC 4180).
   subroutine put_words(self, line)
      type(output_file), intent(inout) :: self
      character(*), intent(in) :: line   !! each word at the right of its column

      character(:), allocatable :: text, word
      integer :: first, i

      call self%put(line)
      if (allocated(self%trouble) .or. .not. allocated(self%comma_name)) return
      text = ''
      first = 1
      do i = 1, size(self%columns)
         word = trim(adjustl(line(first:self%column_end(i))))
         first = self%column_end(i) + 1
         if (.not. self%has_names .and. self%columns(i)%unit /= '-') word = word//'['//trim(self%columns(i)%unit)//']'
         if (scan(word, ',"') > 0) word = '"'//with_mark(word, '"', '"')//'"'
         text = text//','//word
      end do
      text = text(2:)//newline
      call check(self, put_text(self%commas, text, len(text, c_size_t)), self%comma_name)
   end subroutine put_words

   !> Begins a block, a data set that gnuplot's `index` counts: two blank lines, unless the block is the first, a
   !> comment, and the names of the columns, which gnuplot looks for at the head of each data set.
   subroutine begin_block(self, comment)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: comment

      if (self%blocks > 0) call self%put(newline)
      self%blocks = self%blocks + 1
      call self%put('# '//comment)
      call put_names(self)
   end subroutine begin_block

   !> Writes a row of the table, to the file or to memory.
   subroutine put_row(self, numbers, words)
      class(output_file), intent(inout) :: self
      real(dp), intent(in) :: numbers(:)               !! values of the columns of integers and of numbers, in order
      character(*), intent(in), optional :: words(:)   !! values of the columns of words, in order; without blanks

      character(:), allocatable :: line

      if (associated(self%memory)) then
         call self%memory%add_row(numbers, words)
         return
      end if
      if (.not. self%has_names) call put_names(self)
      line = repeat(' ', self%column_end(size(self%kinds)))
      call put_in_columns(size(self%kinds, kind=c_int), self%kinds, self%column_end, numbers, line)
      if (present(words)) call put_at(line, pack(self%column_end, self%kinds == of_words), words)
      call put_words(self, line)
   end subroutine put_row

   !> Records an error of the operating system, if there is one.
   subroutine check(self, number, name)
      class(output_file), intent(inout) :: self
      integer(c_int), intent(in) :: number   !! the system's number of the error, as error_text takes it; 0: no error
      character(*), intent(in), optional :: name   !! path of the file, if it is not `name`

      if (number == 0 .or. .not. self%is_open()) return
      if (present(name)) self%name = name
      call self%note_trouble(error_text(number))
   end subroutine check

   !> Records an error. `finish` will report the first recorded error and remove the file.
   subroutine note_trouble(self, message)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: message   !! what went wrong, without the name of the file

      if (.not. allocated(self%trouble)) self%trouble = message
   end subroutine note_trouble

   !> Closes the file and gives it its name. After an error the file is removed instead. Errors: exit_file_trouble.
   subroutine finish(self, error)
      class(output_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (associated(self%memory)) then
         if (self%memory%is_full) call self%note_trouble('there is not enough memory for all rows')
         if (allocated(self%trouble)) call fatal_error(error, exit_file_trouble, 'table in memory: '//self%trouble)
         return
      end if
      if (allocated(self%columns) .and. .not. self%has_names) call put_names(self)
      if (allocated(self%name)) &
         call check(self, end_written(self%file, merge(1_c_int, 0_c_int, self%is_open()), 0_c_int))
      if (allocated(self%comma_name)) &
         call check(self, end_written(self%commas, merge(1_c_int, 0_c_int, self%is_open()), 0_c_int), self%comma_name)
      if (allocated(self%trouble)) then
         call fatal_error(error, exit_file_trouble, escaped(self%name)//': cannot be written: '//self%trouble)
         return
      end if
      do i = 1, size(self%replaced)
         associate (old => self%replaced(i))
            if (.not. allocated(old%name)) exit
            if (path_kind(old%name) /= path_file) cycle
            if (refusal_to_write(old%name//c_null_char, old%mark//c_null_char) == 0) call remove_file(old%name)
         end associate
      end do
   end subroutine finish

end module wavycon_output_file
