!> Reads a text file of numbers, with the same number of them on each line.
!>
!> A comment reaches from '#' to the end of the line. Comments and lines without numbers are ignored, and so is the
!> head: lines before the first number that begin with a word. Lines end in LF, CR LF or CR. The '#' of a mark for a
!> missing number, such as `#N/A` and `1.#QNAN`, does not begin a comment.
module wavycon_number_table
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: byte_order_mark, make_one_byte, read_file
   use wavycon_kinds, only: dp, ieee_is_finite, not_a_number
   use wavycon_number_line, only: gaps, is_missing, read_line
   use wavycon_plain_text, only: decimal_digits, escaped, integer_text, lower_case
   implicit none (type, external)
   private

   public :: number_table, read_number_table

   type :: number_table
      character(:), allocatable :: path         !! as the user named the file
      real(dp), allocatable :: values(:, :)     !! shape (columns, rows), a row for a line with numbers; NaN if missing
      integer, allocatable :: line(:)           !! for each row the number of its line in the file
      integer :: words = 0                      !! number of lines of the head
   contains
      procedure :: refuse
   end type number_table

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13), tab = achar(9)

contains

   !> Makes an error of status exit_bad_input whose message begins with the name of the file and the line of a row.
   pure subroutine refuse(self, row, words, error)
      class(number_table), intent(in) :: self
      integer, intent(in) :: row             !! number of the row in `values`
      character(*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_bad_input, escaped(self%path)//':'//integer_text(self%line(row))//': '//words)
   end subroutine refuse

   !> Reads a file. Callers must switch off traps of overflow. Errors: exit_file_trouble if the file cannot be read or
   !> there is not enough memory; exit_bad_input for a word that is not a number, a number above largest_number, a
   !> possible decimal comma, a line of separators only, rows of unequal length, a file of more than one map, and a file
   !> without numbers.
   subroutine read_number_table(path, most_bytes, table, error)
      character(*), intent(in) :: path
      integer, intent(in) :: most_bytes   !! a file with more bytes is not read
      type(number_table), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content, trouble
      real(dp), allocatable :: row(:), values(:, :)
      integer, parameter :: most_coordinates = 3   ! x, y and z of a point
      integer :: behind, columns, filled, first, i, last, line, most_rows, rows, status, used
      !> Whether a row ends in a separator, so that a last number may be missing; whether all rows so far end so, so
      !> that the table may lack a column.
      logical :: ends_open, may_grow

      call read_file(path, most_bytes, content, error)
      if (allocated(error)) return
      call make_one_byte(content)
      table%path = path
      if (index(content(:min(len(content), len(byte_order_mark))), byte_order_mark) == 1) &
         content(:len(byte_order_mark)) = ' '
      call write_decimal_points(content)
      most_rows = 1
      do i = 1, len(content)
         if (is_line_end(content(i:i))) most_rows = most_rows + 1
      end do
      allocate (row(0))
      rows = 0
      line = 0
      columns = 0
      status = 0
      may_grow = .true.
      behind = 1
      do while (behind <= len(content))
         line = line + 1
         call next_line(content, behind, first, last)
         if (rows == 0) then
            if (is_remark(content(first:last))) then
               table%words = table%words + 1
               cycle
            end if
         else if (index(content(last + 1:behind - 1), '# Width:') == 1) then
            call trouble_in_line('another map begins here: write each map to a file of its own')
            return
         end if
         if (size(row) < last - first + 2) then
            deallocate (row)
            allocate (row(last - first + 2), stat=status)
            if (status /= 0) exit
         end if
         call read_line(content(first:last), row, used, ends_open, trouble)
         if (allocated(trouble)) call trouble_in_line(trouble)
         if (allocated(error)) return
         if (used == 0) cycle
         if (rows == 0) then
            columns = used
            ! The first row may lack a last number.
            allocate (table%values(merge(used + 1, used, ends_open), most_rows), table%line(most_rows), stat=status)
            if (status /= 0) exit
         else if (may_grow .and. used == min(columns + 1, size(table%values, 1))) then
            columns = used
         end if
         may_grow = may_grow .and. ends_open
         if (used /= columns .and. .not. (used == columns - 1 .and. ends_open)) then
            call trouble_in_line('this row has '//integer_text(used)//' numbers, the first has '// &
                                 integer_text(columns)//': all must have the same number (write nan for one that '// &
                                 'is missing, and # before lines that are no heights)')
            return
         end if
         rows = rows + 1
         table%line(rows) = line
         table%values(:used, rows) = row(:used)
         table%values(used + 1:, rows) = not_a_number()
      end do
      if (may_grow .and. rows > 0) then
         ! Behind heights or coordinates alone there may be empty columns. Those of a matrix are missing heights.
         filled = findloc([(any(ieee_is_finite(table%values(i, :rows))), i=1, columns)], .true., dim=1, back=.true.)
         if (filled >= 1 .and. filled <= most_coordinates) columns = filled
      end if
      if (status == 0 .and. rows > 0) allocate (values, source=table%values(:columns, :rows), stat=status)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': there is not the memory for its numbers')
      else if (rows == 0) then
         call fatal_error(error, exit_bad_input, escaped(path)//': there are no numbers in this file')
      else
         call move_alloc(values, table%values)
         table%line = table%line(:rows)
      end if

   contains

      !> Makes an error whose message begins with the name of the file and the current line.
      subroutine trouble_in_line(words)
         character(*), intent(in) :: words

         call fatal_error(error, exit_bad_input, escaped(path)//':'//integer_text(line)//': '//words)
      end subroutine trouble_in_line

   end subroutine read_number_table

   !> Whether a line begins with a word: not with a number, a mark for a missing number or `inf` and the like.
   pure logical function is_remark(line)
      character(*), intent(in) :: line

      integer :: first

      first = verify(line, gaps)
      is_remark = first > 0
      if (is_remark) is_remark = verify(line(first:first), '+-.0123456789') > 0 .and. .not. &
         (is_missing(word_at(line, first)) .or. index(lower_case(word_at(line, first)), 'inf') == 1)
   end function is_remark

   !> The word that begins at a position of a text. A word longer than any mark for a missing number is cut.
   pure function word_at(text, first) result(word)
      character(*), intent(in) :: text
      integer, intent(in) :: first       !! position of the word's first byte
      character(:), allocatable :: word

      integer, parameter :: longest = 9

      word = text(first:min(first + longest, len(text)))//' '
      word = word(:scan(word, gaps//line_feed//carriage_return) - 1)
   end function word_at

   !> Replaces decimal commas by points. The commas of a text are decimal if each line with a comma separates its
   !> numbers by tabs or semicolons, each comma stands between two digits, and no number has two commas.
   pure subroutine write_decimal_points(content)
      character(*), intent(inout) :: content

      integer :: behind, first, k, last, next, pass

      if (index(content, ',') == 0) return
      do pass = 1, 2
         behind = 1
         do while (behind <= len(content))
            call next_line(content, behind, first, last)
            if (index(content(first:last), ',') == 0 .or. is_remark(content(first:last))) cycle
            if (scan(content(first:last), tab//';') == 0) return
            do k = first, last
               if (content(k:k) /= ',') cycle
               if (pass == 2) content(k:k) = '.'
               if (pass == 2) cycle
               next = k + verify(content(k + 1:last)//' ', decimal_digits)
               if (k == first .or. next == k + 1) return
               if (verify(content(k - 1:k - 1), decimal_digits) > 0 .or. content(next:min(next, last)) == ',') return
            end do
         end do
      end do
   end subroutine write_decimal_points

   !> Finds the next line, without its comment.
   pure subroutine next_line(content, behind, first, last)
      character(*), intent(in) :: content
      integer, intent(inout) :: behind        !! position of the line's first byte; on exit that of the following line's
      integer, intent(out) :: first, last     !! positions of the line's first and last byte; last < first if empty

      first = behind
      do behind = first, len(content)
         ! This test passes over most bytes at once: their codes are above that of '#', those of line ends are below.
         if (iachar(content(behind:behind)) > iachar('#')) cycle
         if (is_line_end(content(behind:behind))) exit
         if (content(behind:behind) /= '#') cycle
         if (starts_comment(content, behind)) exit
      end do
      last = behind - 1
      do behind = behind, len(content)
         if (is_line_end(content(behind:behind))) exit
      end do
      if (content(behind:min(behind + 1, len(content))) == carriage_return//line_feed) behind = behind + 1
      behind = behind + 1
   end subroutine next_line

   !> Whether a '#' starts a comment. The '#' in `#N/A` and the like and in `1.#QNAN` does not.
   pure logical function starts_comment(content, hash)
      character(*), intent(in) :: content
      integer, intent(in) :: hash   !! position of the '#'

      starts_comment = .not. is_missing(word_at(content, hash)) .and. .not. &
                       (content(max(1, hash - 2):hash - 1) == '1.' .and. &
                        scan(lower_case(word_at(content, hash)), 'abcdefghijklmnopqrstuvwxyz') == 2)
   end function starts_comment

   !> Whether a byte ends a line.
   elemental logical function is_line_end(byte)
      character(1), intent(in) :: byte

      is_line_end = byte == line_feed .or. byte == carriage_return
   end function is_line_end

end module wavycon_number_table
