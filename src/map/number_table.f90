!> Reads a file of lines of numbers.
!>
!> Comments, from '#' to the end of the line, and lines without numbers are ignored, and so is a head: lines before the
!> first number that begin with a word. Lines end in LF, CR LF or CR.
module wavycon_number_table
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_overflow, ieee_set_halting_mode, &
      ieee_set_status, ieee_status_type
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_kinds, only: dp
   use wavycon_number_line, only: read_line
   use wavycon_plain_text, only: escaped, integer_text, lower_case
   implicit none (type, external)
   private

   public :: number_table, read_number_table, next_line

   type :: number_table
      character(:), allocatable :: path         !! as the user named the file
      real(dp), allocatable :: values(:)        !! a missing number is NaN
      integer, allocatable :: first(:)          !! index of the first value of each row; one more: size(values) + 1
      integer, allocatable :: line(:)           !! line of the file of each row
      logical, allocatable :: ends_open(:)      !! whether the row ends in a separator: a last number may be missing
      integer :: words = 0                      !! lines of the head that begin with a word
      integer :: next_head = 0                  !! line behind the first row with the head of another map; 0: none
   contains
      procedure :: rows
      procedure :: length
      procedure :: refuse
   end type number_table

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13), tab = achar(9)

contains

   !> The number of rows: lines that have numbers.
   pure integer function rows(self)
      class(number_table), intent(in) :: self

      rows = size(self%line)
   end function rows

   !> The number of values of a row.
   pure integer function length(self, row)
      class(number_table), intent(in) :: self
      integer, intent(in) :: row

      length = self%first(row + 1) - self%first(row)
   end function length

   !> Makes an error with the name of the file and the line of a row, and the status exit_bad_input.
   pure subroutine refuse(self, row, words, error)
      class(number_table), intent(in) :: self
      integer, intent(in) :: row
      character(*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_bad_input, escaped(self%path)//':'//integer_text(self%line(row))//': '//words)
   end subroutine refuse

   !> Reads a file. Errors: exit_file_trouble if it cannot be read; exit_bad_input for a word that is not a number, a
   !> number above largest_number, a possible decimal comma, a line of separators, and a file without numbers.
   subroutine read_number_table(path, most_bytes, table, error)
      character(*), intent(in) :: path
      integer, intent(in) :: most_bytes   !! a larger file is not read
      type(number_table), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content
      type(ieee_status_type) :: floating_point
      integer :: numbers, rows, status

      call read_file(path, most_bytes, content, error)
      if (allocated(error)) return
      table%path = path
      call write_decimal_points(content)
      ! The first pass counts, the second keeps.
      allocate (table%values(0), table%first(0), table%line(0), table%ends_open(0))
      call take_numbers(content, table, numbers, rows, error)
      deallocate (table%values, table%first, table%line, table%ends_open)
      allocate (table%values(numbers), table%first(rows + 1), table%line(rows), table%ends_open(rows), stat=status)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': there is not the memory for its numbers')
         return
      end if
      ! 1e999 must be reported as bad input in builds that trap overflow too.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call take_numbers(content, table, numbers, rows, error)
      call ieee_set_status(floating_point)
   end subroutine read_number_table

   !> Takes the numbers of all lines, or counts them if the table has no room, up to the first line that is wrong.
   !> Errors: exit_bad_input.
   subroutine take_numbers(content, table, used, rows, error)
      character(*), intent(in) :: content
      type(number_table), intent(inout) :: table   !! with room for all numbers and rows, or for none
      integer, intent(out) :: used, rows           !! how many numbers and rows there are
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: trouble
      integer :: behind, first, last, line, used_before
      logical :: ends_open

      rows = 0
      used = 0
      line = 0
      table%words = 0
      behind = 1
      if (index(content(:min(len(content), len(byte_order_mark))), byte_order_mark) == 1) &
         behind = len(byte_order_mark) + 1
      do while (behind <= len(content))
         line = line + 1
         call next_line(content, behind, first, last)
         used_before = used
         if (used == 0 .and. is_remark(content(first:last))) then
            table%words = table%words + 1
            cycle
         end if
         if (used > 0 .and. index(content(last + 1:behind - 1), '# Width:') == 1) table%next_head = line
         call read_line(content(first:last), table%values, used, ends_open, trouble)
         if (allocated(trouble)) then
            call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(line)//': '//trouble)
            return
         end if
         if (used == used_before) cycle
         rows = rows + 1
         if (size(table%line) == 0) cycle
         table%line(rows) = line
         table%first(rows) = used_before + 1
         table%ends_open(rows) = ends_open
      end do
      if (used == 0) then
         call fatal_error(error, exit_bad_input, escaped(table%path)//': there are no numbers in this file')
         return
      end if
      if (size(table%line) > 0) table%first(rows + 1) = used + 1
   end subroutine take_numbers

   !> Whether a line begins with a word that is no number, and not `nan` or `inf` or their like.
   pure logical function is_remark(line)
      character(*), intent(in) :: line

      character(3) :: start
      integer :: first

      first = verify(line, ' '//tab)
      is_remark = .false.
      if (first == 0) return
      start = lower_case(line(first:))
      is_remark = verify(start(1:1), '+-.,;0123456789') > 0 .and. start /= 'nan' .and. start /= 'inf'
   end function is_remark

   !> Replaces decimal commas by points. Commas are decimal if each line that has one separates its numbers by tabs or
   !> semicolons, and each comma stands between two digits, one in a number.
   pure subroutine write_decimal_points(content)
      character(*), intent(inout) :: content

      character(*), parameter :: digits = '0123456789'
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
               next = k + verify(content(k + 1:last)//' ', digits)
               if (k == first .or. next == k + 1) return
               if (verify(content(k - 1:k - 1), digits) > 0 .or. content(next:min(next, last)) == ',') return
            end do
         end do
      end do
   end subroutine write_decimal_points

   !> The next line, without its comment.
   pure subroutine next_line(content, behind, first, last)
      character(*), intent(in) :: content
      integer, intent(inout) :: behind        !! place of the line; then the place of the line behind it
      integer, intent(out) :: first, last     !! bytes of the line; last < first if it is empty

      first = behind
      do behind = first, len(content)
         ! Most bytes are beyond '#', and line ends are before it.
         if (iachar(content(behind:behind)) > iachar('#')) cycle
         if (is_line_end(content(behind:behind)) .or. content(behind:behind) == '#') exit
      end do
      last = behind - 1
      do behind = behind, len(content)
         if (is_line_end(content(behind:behind))) exit
      end do
      if (content(behind:min(behind + 1, len(content))) == carriage_return//line_feed) behind = behind + 1
      behind = behind + 1
   end subroutine next_line

   !> Whether a byte ends a line.
   elemental logical function is_line_end(byte)
      character(1), intent(in) :: byte

      is_line_end = byte == line_feed .or. byte == carriage_return
   end function is_line_end

end module wavycon_number_table
