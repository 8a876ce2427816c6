!> Reads a file of lines of numbers.
!>
!> Comments, from '#' to the end of the line, and lines without numbers are ignored. Numbers are separated by blanks,
!> tabs, commas or semicolons, and written as in a deck. Lines end in LF, CR LF or CR.
module wavycon_number_table
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_overflow, ieee_set_halting_mode, &
      ieee_set_status, ieee_status_type
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_decimal_number, only: read_decimal
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_key_table, only: largest_number
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, excerpt, integer_text, lower_case, short_number
   implicit none (type, external)
   private

   public :: number_table, read_number_table, next_line, read_line

   type :: number_table
      character(:), allocatable :: path  !! as the user named the file
      real(dp), allocatable :: values(:)
      integer, allocatable :: first(:)   !! index of the first value of each row; one more element: size(values) + 1
      integer, allocatable :: line(:)    !! line of the file of each row
   contains
      procedure :: rows
      procedure :: length
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

   !> Reads a file. Errors: exit_file_trouble if it cannot be read; exit_bad_input for a word that is not a number, a
   !> number above largest_number, a missing number between commas, a possible decimal comma, and a file without
   !> numbers.
   subroutine read_number_table(path, most_bytes, table, error)
      character(*), intent(in) :: path
      integer, intent(in) :: most_bytes   !! a larger file is not read
      type(number_table), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content
      type(ieee_status_type) :: floating_point
      integer :: most_numbers, most_rows, status

      call read_file(path, most_bytes, content, error)
      if (allocated(error)) return
      table%path = path
      call count_words(content, most_numbers, most_rows)
      allocate (table%values(most_numbers), table%first(most_rows + 1), table%line(most_rows), stat=status)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': there is not the memory for its numbers')
         return
      end if
      ! 1e999 must be reported as bad input in builds that trap overflow too.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call take_numbers(content, table, error)
      call ieee_set_status(floating_point)
   end subroutine read_number_table

   !> Counts words and lines, those of comments too: upper bounds for the numbers and the rows.
   pure subroutine count_words(content, words, lines)
      character(*), intent(in) :: content
      integer, intent(out) :: words, lines

      integer :: place
      logical :: behind_gap, new_line

      words = 0
      lines = 0
      behind_gap = .true.
      new_line = .true.
      do place = 1, len(content)
         if (is_gap(content(place:place))) then
            behind_gap = .true.
            if (is_line_end(content(place:place))) new_line = .true.
            cycle
         end if
         if (behind_gap) words = words + 1
         if (new_line) lines = lines + 1
         behind_gap = .false.
         new_line = .false.
      end do
   end subroutine count_words

   !> Errors: exit_bad_input.
   subroutine take_numbers(content, table, error)
      character(*), intent(in) :: content
      type(number_table), intent(inout) :: table   !! with room for the numbers
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: trouble
      integer :: behind, first, last, line, rows, used, used_before

      rows = 0
      used = 0
      line = 0
      behind = 1
      if (index(content(:min(len(content), len(byte_order_mark))), byte_order_mark) == 1) &
         behind = len(byte_order_mark) + 1
      do while (behind <= len(content))
         line = line + 1
         call next_line(content, behind, first, last)
         used_before = used
         call read_line(content(first:last), table%values, used, trouble)
         if (allocated(trouble)) then
            call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(line)//': '//trouble)
            return
         end if
         if (used == used_before) cycle
         rows = rows + 1
         table%line(rows) = line
         table%first(rows) = used_before + 1
      end do
      if (used == 0) then
         call fatal_error(error, exit_bad_input, escaped(table%path)//': there are no numbers in this file')
         return
      end if
      table%first(rows + 1) = used + 1
      if (used < size(table%values)) table%values = table%values(:used)
      if (rows < size(table%line)) then
         table%first = table%first(:rows + 1)
         table%line = table%line(:rows)
      end if
   end subroutine take_numbers

   !> The next line, without its comment.
   pure subroutine next_line(content, behind, first, last)
      character(*), intent(in) :: content
      integer, intent(inout) :: behind        !! place of the line; then the place of the line behind it
      integer, intent(out) :: first, last     !! bytes of the line; last < first if it is empty

      first = behind
      do behind = first, len(content)
         if (is_line_end(content(behind:behind)) .or. content(behind:behind) == '#') exit
      end do
      last = behind - 1
      do behind = behind, len(content)
         if (is_line_end(content(behind:behind))) exit
      end do
      if (content(behind:min(behind + 1, len(content))) == carriage_return//line_feed) behind = behind + 1
      behind = behind + 1
   end subroutine next_line

   !> Adds the numbers of a line to those of the lines before it.
   subroutine read_line(line, values, used, trouble)
      character(*), intent(in) :: line         !! without comment and line end
      real(dp), intent(inout) :: values(:)     !! with room for the numbers
      integer, intent(inout) :: used           !! number of values so far
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      integer :: behind                !! the number before, place behind its last byte; 0 at the start of the line
      integer :: first, last, tight
      logical :: is_loose

      behind = 0
      tight = 0
      is_loose = .false.
      do
         call next_word(line, max(behind, 1), first, last)
         if (first > len(line)) return
         call read_number(line(first:last), values, used, trouble)
         if (.not. allocated(trouble)) call check_gap(line, behind, first, tight, is_loose, trouble)
         if (allocated(trouble)) return
         behind = last + 1
      end do
   end subroutine read_line

   !> The next word from a place on; first > len(line) if there is none.
   pure subroutine next_word(line, place, first, last)
      character(*), intent(in) :: line
      integer, intent(in) :: place
      integer, intent(out) :: first, last

      do first = place, len(line)
         if (.not. is_gap(line(first:first))) exit
      end do
      do last = first, len(line)
         if (is_gap(line(last:last))) exit
      end do
      last = last - 1
   end subroutine next_word

   !> Reports missing numbers between commas, and a possible decimal comma: a line with both a comma without blanks
   !> around it and numbers without a comma between them.
   pure subroutine check_gap(line, behind, first, tight, is_loose, trouble)
      character(*), intent(in) :: line
      integer, intent(in) :: behind         !! place behind the number before; 0 at the start of the line
      integer, intent(in) :: first          !! place of the number behind the gap
      integer, intent(inout) :: tight       !! place of a number that only a comma separates from the one before; or 0
      logical, intent(inout) :: is_loose    !! whether two numbers have no comma between them
      character(:), allocatable, intent(out) :: trouble

      integer :: commas, place, separators

      commas = 0
      separators = 0
      do place = max(behind, 1), first - 1
         if (line(place:place) == ',') commas = commas + 1
         if (line(place:place) == ',' .or. line(place:place) == ';') separators = separators + 1
      end do
      if (separators > merge(0, 1, behind == 0)) then
         trouble = "a number is left out before '"//excerpt(line(first:word_end(line, first)))//"'"
      else if (behind > 0) then
         if (commas == 1 .and. first - behind == 1) tight = first
         is_loose = is_loose .or. commas == 0
         if (tight > 0 .and. is_loose) trouble = "is '"// &
            excerpt(line(word_start(line, tight - 2):word_end(line, tight)))// &
            "' a number with a decimal comma? Write a point, or separate all numbers of a line by commas alone"
      end if
   end subroutine check_gap

   !> First and last place of the word that a place is in.
   pure integer function word_start(line, place)
      character(*), intent(in) :: line
      integer, intent(in) :: place

      do word_start = place, 2, -1
         if (is_gap(line(word_start - 1:word_start - 1))) exit
      end do
      word_start = max(word_start, 1)
   end function word_start

   pure integer function word_end(line, place)
      character(*), intent(in) :: line
      integer, intent(in) :: place

      do word_end = place, len(line) - 1
         if (is_gap(line(word_end + 1:word_end + 1))) exit
      end do
   end function word_end

   !> Reads a word as a number and adds it to the values.
   subroutine read_number(word, values, used, trouble)
      character(*), intent(in) :: word
      real(dp), intent(inout) :: values(:)
      integer, intent(inout) :: used
      character(:), allocatable, intent(out) :: trouble

      logical :: is_number

      used = used + 1
      call read_decimal(word, values(used), is_number)
      if (is_number .and. abs(values(used)) <= largest_number) return
      if (is_number) then
         trouble = "'"//excerpt(word)//"' is too large: numbers may be up to "//short_number(largest_number)//' in size'
         return
      end if
      select case (lower_case(word(merge(2, 1, scan(word(1:1), '+-') == 1):)))
      case ('nan')
         values(used) = ieee_value(1.0_dp, ieee_quiet_nan)
      case ('inf', 'infinity')
         trouble = "'"//excerpt(word)//"' is not a height: maps must be complete"
      case default
         trouble = "'"//excerpt(word)//"' is no number"
      end select
   end subroutine read_number

   !> Whether a byte ends a line.
   elemental logical function is_line_end(byte)
      character(1), intent(in) :: byte

      is_line_end = byte == line_feed .or. byte == carriage_return
   end function is_line_end

   !> Whether a byte separates numbers.
   elemental logical function is_gap(byte)
      character(1), intent(in) :: byte

      select case (byte)
      case (' ', ',', ';', tab, line_feed, carriage_return)
         is_gap = .true.
      case default
         is_gap = .false.
      end select
   end function is_gap

end module wavycon_number_table
