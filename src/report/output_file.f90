!> Result files. A file is written under a temporary name and renamed when it is complete. A table may be written to
!> memory in place of a file: it gets columns and rows, and lines by `put` are left out.
!>
!> A table has header lines that start with '#', the last of them with the units of the columns, then one line with
!> their names, then rows. gnuplot, numpy and pandas find columns by these names.
module wavycon_output_file
   use, intrinsic :: iso_c_binding, only: c_null_char
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: longest_word, memory_table, of_integers, of_reals, of_words
   use wavycon_plain_text, only: escaped, integer_text, system_words
   use wavycon_system, only: process_id, remove_file, remove_when_interrupted, rename_file
   implicit none (type, external)
   private

   public :: output_file

   !> A real number: 16 digits and a three-digit exponent.
   character(*), parameter :: real_digits = '.15e3', real_format = '(es24'//real_digits//')'
   !> The narrowest column: such a number with a blank before it.
   integer, parameter :: narrowest = 25

   type :: output_file
      private
      type(memory_table), pointer, public :: memory => null()   !! in place of the file; exists until `finish`
      integer :: unit = -1
      logical :: opened = .false.
      character(:), allocatable :: name           !! final name
      character(:), allocatable :: working_name   !! temporary name
      integer :: status = 0                       !! of the last statement, from iostat
      character(200) :: message = ''              !! from iomsg
      character(:), allocatable :: trouble        !! first error; not allocated if there was none
      character(:), allocatable :: names(:)       !! of the columns; not allocated if the file is no table
      logical :: has_names = .false.              !! whether the line of the names was written
      integer :: blocks = 0                       !! data sets begun by begin_block
      integer, allocatable :: column_end(:)       !! position in a row at which each column ends
      !> The row being filled: of each column what it is, the number, the word.
      integer :: columns_filled = 0
      integer, allocatable :: kinds(:)
      real(dp), allocatable :: numbers(:)
      character(longest_word), allocatable :: words(:)
   contains
      procedure :: open => open_file
      procedure :: is_open
      procedure :: put
      procedure :: put_numbers
      procedure :: put_columns
      procedure :: begin_block
      procedure, private :: add_integers, add_long, add_reals, add_word
      generic :: add => add_integers, add_long, add_reals, add_word
      procedure :: end_row
      procedure :: put_rows
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

      character(:), allocatable :: form
      form = 'formatted'
      if (present(head)) form = 'unformatted'
      self%name = directory//'/'//name
      self%working_name = directory//'/.'//name//'.'//integer_text(process_id())//'.part'
      call remove_when_interrupted(self%working_name//c_null_char)
      ! As a stream, because close_file needs the number of bytes written.
      open (newunit=self%unit, file=self%working_name, access='stream', form=form, status='replace', &
            action='write', iostat=self%status, iomsg=self%message)
      self%opened = self%status == 0
      if (self%opened .and. present(head)) write (self%unit, iostat=self%status, iomsg=self%message) head
      call check(self)
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
      write (self%unit, '(a)', iostat=self%status, iomsg=self%message) line
      call check(self)
   end subroutine put

   !> Writes numbers to a binary file, in the order of the array.
   subroutine put_numbers(self, numbers)
      class(output_file), intent(inout) :: self
      real(dp), intent(in), contiguous :: numbers(:, :)

      if (allocated(self%trouble)) return
      write (self%unit, iostat=self%status, iomsg=self%message) numbers
      call check(self)
   end subroutine put_numbers

   !> Sets the columns and writes the header line of their units. That of their names follows at the head of each block
   !> or, without blocks, before the first row.
   subroutine put_columns(self, names, units)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: names(:)   !! without blanks
      character(*), intent(in) :: units(:)   !! as many; shown in brackets

      character(len(units) + 2) :: in_brackets(size(units))
      character(:), allocatable :: line
      integer :: i, last, width

      allocate (self%kinds(size(names)), self%numbers(size(names)), self%words(size(names)))
      if (associated(self%memory)) call self%memory%start(names, units)
      self%names = names
      allocate (self%column_end(size(names)))
      last = 0
      do i = 1, size(names)
         in_brackets(i) = '['//trim(units(i))//']'
         width = max(narrowest, len_trim(names(i)) + 1, len_trim(in_brackets(i)) + merge(2, 1, i == 1))
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
      call self%put(aligned(self, self%names))
   end subroutine put_names

   !> Begins a data set of gnuplot's `index`: two blank lines, unless it is the first, a comment, and the names of the
   !> columns, which gnuplot looks for at the head of each data set.
   subroutine begin_block(self, comment)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: comment

      if (self%blocks > 0) then
         call self%put('')
         call self%put('')
      end if
      self%blocks = self%blocks + 1
      call self%put('# '//comment)
      call put_names(self)
   end subroutine begin_block

   !> Fills the next columns of a row with integers.
   subroutine add_integers(self, values)
      class(output_file), intent(inout) :: self
      integer, intent(in) :: values(:)

      call self%add_long(int(values, int64))
   end subroutine add_integers

   subroutine add_long(self, values)
      class(output_file), intent(inout) :: self
      integer(int64), intent(in) :: values(:)   !! of at most 15 digits

      call self%add(real(values, dp))
      self%kinds(self%columns_filled - size(values) + 1:self%columns_filled) = of_integers
   end subroutine add_long

   subroutine add_reals(self, values)
      class(output_file), intent(inout) :: self
      real(dp), intent(in) :: values(:)

      associate (first => self%columns_filled + 1, last => self%columns_filled + size(values))
         self%numbers(first:last) = values
         self%kinds(first:last) = of_reals
      end associate
      self%columns_filled = self%columns_filled + size(values)
   end subroutine add_reals

   subroutine add_word(self, word)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: word   !! without blanks

      call self%add([0.0_dp])
      self%words(self%columns_filled) = word
      self%kinds(self%columns_filled) = of_words
   end subroutine add_word

   !> Writes the row that was filled.
   subroutine end_row(self)
      class(output_file), intent(inout) :: self

      integer :: k

      do k = 1, self%columns_filled
         if (associated(self%memory)) then
            if (self%kinds(k) /= of_reals) self%memory%kinds(k) = self%kinds(k)
            if (self%kinds(k) == of_words) self%numbers(k) = self%memory%number_of_word(trim(self%words(k)))
         else if (self%kinds(k) == of_integers) then
            write (self%words(k), '(i0)') nint(self%numbers(k), int64)
         else if (self%kinds(k) == of_reals) then
            write (self%words(k), real_format) self%numbers(k)
            self%words(k) = adjustl(self%words(k))
         end if
      end do
      self%columns_filled = 0
      if (associated(self%memory)) then
         call self%memory%add_rows(reshape(self%numbers, [size(self%numbers), 1]))
      else
         if (.not. self%has_names) call put_names(self)
         call self%put(aligned(self, self%words))
      end if
   end subroutine end_row

   !> Writes many rows of integers and of numbers: the same as `add` and `end_row` for each, in a third of the time.
   subroutine put_rows(self, integers, values)
      class(output_file), intent(inout) :: self
      integer, intent(in) :: integers(:)     !! of the first columns, the same in each row
      real(dp), intent(in) :: values(:, :)   !! of the others, shape (other columns, rows)

      character(:), allocatable :: row_format, width
      integer :: i

      if (allocated(self%trouble)) return
      if (associated(self%memory)) then
         call self%memory%add_rows(values, integers)
         return
      end if
      if (.not. self%has_names) call put_names(self)
      row_format = '(i'//integer_text(self%column_end(1))
      do i = 2, size(self%column_end)
         width = integer_text(self%column_end(i) - self%column_end(i - 1))
         if (i <= size(integers)) then
            row_format = row_format//', i'//width
         else
            row_format = row_format//', es'//width//real_digits
         end if
      end do
      write (self%unit, row_format//')', iostat=self%status, iomsg=self%message) &
         (integers, values(:, i), i=1, size(values, 2))
      call check(self)
   end subroutine put_rows

   !> Records an error of the last statement.
   subroutine check(self)
      type(output_file), intent(inout) :: self

      if (self%status /= 0) call self%note_trouble(self%message)
   end subroutine check

   !> Records an error: `finish` will report it and remove the file.
   subroutine note_trouble(self, message)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: message   !! as from iomsg

      if (.not. allocated(self%trouble)) self%trouble = system_words(message)
   end subroutine note_trouble

   !> Closes the file and renames it to its final name; after an error the file is removed instead. Errors:
   !> exit_file_trouble.
   subroutine finish(self, error)
      class(output_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: failure

      if (associated(self%memory)) then
         if (self%memory%is_full) call self%note_trouble('there is not the memory for all rows')
         if (allocated(self%trouble)) call fatal_error(error, exit_file_trouble, 'table in memory: '//self%trouble)
         return
      end if
      if (allocated(self%names) .and. .not. self%has_names) call put_names(self)
      if (self%opened) call close_file(self)
      if (.not. allocated(self%trouble)) then
         call rename_file(self%working_name, self%name, failure)
         if (allocated(failure)) call self%note_trouble(failure)
      end if
      if (allocated(self%trouble)) then
         if (self%opened) call remove_file(self%working_name)
         call fatal_error(error, exit_file_trouble, escaped(self%name)//': cannot be written: '//self%trouble)
      end if
   end subroutine finish

   !> Closes the file and compares its size with the number of bytes written.
   !>
   !> N.B. On a full disk neither write, flush nor close reports an error with gfortran 12: the file is only too short.
   subroutine close_file(self)
      type(output_file), intent(inout) :: self

      integer(int64) :: bytes_there, next_byte

      flush (self%unit, iostat=self%status, iomsg=self%message)
      call check(self)
      inquire (unit=self%unit, pos=next_byte)
      close (self%unit, iostat=self%status, iomsg=self%message)
      call check(self)
      inquire (file=self%working_name, size=bytes_there)
      if (bytes_there /= next_byte - 1) &
         call self%note_trouble('it is cut short: the disk is full, or over a quota or a limit on file sizes')
   end subroutine close_file

end module wavycon_output_file
