!> Lines of numbers from a file.
!>
!> What stands behind a '#' and empty lines are left out; numbers are parted by blanks, tabs, commas or
!> semicolons, and written as in a deck. Lines end in LF, CR LF or CR.
module wavycon_number_table
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_overflow, ieee_set_halting_mode, &
      ieee_set_status, ieee_status_type
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_key_table, only: largest_number
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, excerpt, integer_text, lower_case, short_number
   use wavycon_system, only: parse_number
   implicit none (type, external)
   private

   public :: number_table, read_number_table

   type :: number_table
      character(:), allocatable :: path  !! as the user named the file
      real(dp), allocatable :: values(:)
      integer, allocatable :: first(:)   !! of each line that has numbers, its first; and one behind the last
      integer, allocatable :: line(:)    !! of these lines, the number in the file
   contains
      procedure :: rows
      procedure :: length
   end type number_table

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13), tab = achar(9)
   !> A number written with more bytes than this is a slip.
   integer, parameter :: longest_number = 100

contains

   !> Lines that have numbers.
   pure integer function rows(self)
      class(number_table), intent(in) :: self

      rows = size(self%line)
   end function rows

   !> Numbers of one of them.
   pure integer function length(self, row)
      class(number_table), intent(in) :: self
      integer, intent(in) :: row

      length = self%first(row + 1) - self%first(row)
   end function length

   !> Reads a file. Errors: exit_file_trouble if it cannot be read, exit_bad_input for what is no number that a
   !> deck could have, for numbers left out between commas, for what may be a decimal comma, and if there is none.
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
      ! 1e999 is bad input, not an exception, in builds that trap those.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call take_numbers(content, table, error)
      call ieee_set_status(floating_point)
   end subroutine read_number_table

   !> How many numbers and lines with numbers there can be: remarks count too.
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
            if (content(place:place) == line_feed .or. content(place:place) == carriage_return) new_line = .true.
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

      real(dp) :: value
      integer :: behind, line, place, rows, values
      integer :: blanks, commas, semicolons   !! since the last number, or the start of the line
      integer :: tight   !! place of a number on this line that a comma alone parts from the one before; 0 if none
      logical :: loose   !! two numbers on this line have no comma between them
      character(:), allocatable :: trouble

      rows = 0
      values = 0
      line = 1
      call begin_line()
      place = 1
      if (index(content(:min(len(content), len(byte_order_mark))), byte_order_mark) == 1) &
         place = len(byte_order_mark) + 1
      do while (place <= len(content))
         select case (content(place:place))
         case (' ', tab)
            blanks = blanks + 1
         case (',')
            commas = commas + 1
         case (';')
            semicolons = semicolons + 1
         case (line_feed)
            line = line + 1
            call begin_line()
         case (carriage_return)
            if (content(place:min(place + 1, len(content))) /= carriage_return//line_feed) then
               line = line + 1
               call begin_line()
            end if
         case ('#')
            do while (place < len(content))
               if (scan(content(place + 1:place + 1), line_feed//carriage_return) > 0) exit
               place = place + 1
            end do
         case default
            behind = place + 1
            do while (behind <= len(content))
               if (is_gap(content(behind:behind)) .or. content(behind:behind) == '#') exit
               behind = behind + 1
            end do
            call take_word(content(place:behind - 1), value, trouble)
            if (.not. allocated(trouble)) call check_gap()
            if (allocated(trouble)) then
               call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(line)//': '//trouble)
               return
            end if
            call append()
            place = behind - 1
         end select
         place = place + 1
      end do
      if (values == 0) then
         call fatal_error(error, exit_bad_input, escaped(table%path)//': there are no numbers in this file')
         return
      end if
      table%first(rows + 1) = values + 1
      if (values < size(table%values)) table%values = table%values(:values)
      if (rows < size(table%line)) then
         table%first = table%first(:rows + 1)
         table%line = table%line(:rows)
      end if

   contains

      subroutine begin_line()
         blanks = 0
         commas = 0
         semicolons = 0
         tight = 0
         loose = .false.
      end subroutine begin_line

      !> Looks at what parts a number from the one before it.
      subroutine check_gap()
         if (commas + semicolons > merge(0, 1, starts_line())) then
            trouble = "a number is left out before '"//excerpt(content(place:behind - 1))//"'"
            return
         end if
         if (.not. starts_line()) then
            if (commas == 1 .and. blanks == 0) tight = place
            loose = loose .or. commas == 0
            if (tight > 0 .and. loose) trouble = "is '"//tight_pair()//"' a number with a decimal comma? "// &
               'Write a point, or part all numbers of a line by commas alone'
         end if
         blanks = 0
         commas = 0
         semicolons = 0
      end subroutine check_gap

      !> The numbers before and behind a comma.
      function tight_pair() result(pair)
         character(:), allocatable :: pair

         integer :: from, to

         from = tight - 2
         do while (from > 1)
            if (is_gap(content(from - 1:from - 1))) exit
            from = from - 1
         end do
         to = tight
         do while (to < len(content))
            if (is_gap(content(to + 1:to + 1)) .or. content(to + 1:to + 1) == '#') exit
            to = to + 1
         end do
         pair = excerpt(content(from:to))
      end function tight_pair

      !> Whether the number at hand is the first of its line.
      logical function starts_line()
         starts_line = rows == 0
         if (rows > 0) starts_line = table%line(rows) /= line
      end function starts_line

      subroutine append()
         if (starts_line()) then
            rows = rows + 1
            table%line(rows) = line
            table%first(rows) = values + 1
         end if
         values = values + 1
         table%values(values) = value
      end subroutine append

   end subroutine take_numbers

   !> The number that a word is.
   subroutine take_word(word, value, trouble)
      character(*), intent(in) :: word
      real(dp), intent(out) :: value
      character(:), allocatable, intent(out) :: trouble   !! what is wrong; not allocated if all is well

      character(longest_number + 1) :: number
      integer :: i

      value = 0.0_dp
      if (len(word) <= longest_number) then
         number = word
         do i = 1, len(word)
            select case (word(i:i))
            case ('0':'9', '+', '-', '.', 'e', 'E')
            case ('d', 'D')
               number(i:i) = 'e'
            case default
               exit
            end select
         end do
         if (i > len(word)) then
            number(i:i) = c_null_char
            if (parse_number(number, value) == len(word)) then
               if (.not. abs(value) <= largest_number) trouble = "'"//excerpt(word)//"' is too large: numbers "// &
                  'may be up to '//short_number(largest_number)//' in size'
               return
            end if
         end if
      end if
      select case (lower_case(word(merge(2, 1, scan(word(1:1), '+-') == 1):)))
      case ('nan', 'inf', 'infinity')
         trouble = "'"//excerpt(word)//"' is no height: a map must be whole"
      case default
         trouble = "'"//excerpt(word)//"' is no number"
      end select
   end subroutine take_word

   !> Whether a byte parts numbers.
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
