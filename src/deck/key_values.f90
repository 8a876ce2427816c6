!> Whether a value, as it stands in a deck, is one that its key may have.
module wavycon_key_values
   use wavycon_key_table, only: allowed_values, choice_value, integer_value, key_type, largest_number, &
      logical_value, real_value, smallest_number, text_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: excerpt, integer_text, is_printable, lower_case, unquoted
   implicit none (type, external)
   private

   public :: check_value

   character(*), parameter :: digits = '0123456789'
   character(*), parameter :: logical_constants(*) = [ &
      '.true. ', '.false.', 'true   ', 'false  ', '.t.    ', '.f.    ', 't      ', 'f      ']

   !> A number written with more bytes than this is a slip.
   integer, parameter :: longest_number = 100

contains

   !> Checks one word: 'value', or 'r*value' for r values.
   pure subroutine check_value(key, word, values, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: word                      !! as in the deck, quotes included
      integer, intent(out) :: values                        !! how many values the word stands for
      character(:), allocatable, intent(out) :: trouble     !! what is wrong; not allocated if all is well

      integer :: start

      call split_repeat(word, values, start)
      if (values < 1) then
         trouble = trim(key%name)//": '"//excerpt(word)//"' must be a count, '*' and a value"
         values = 1
         return
      end if
      associate (value => word(start:))
         select case (key%kind)
         case (real_value)
            call check_real(key, value, trouble)
         case (integer_value)
            call check_integer(key, value, trouble)
         case (logical_value)
            if (.not. any(lower_case(value) == logical_constants)) trouble = must_be(key, value)
         case (text_value)
            call check_text(key, value, trouble)
         case (choice_value)
            call check_choice(key, value, trouble)
         end select
      end associate
   end subroutine check_value

   !> Takes 'r*' off the front of a word.
   pure subroutine split_repeat(word, repeats, start)
      character(*), intent(in) :: word
      integer, intent(out) :: repeats  !! 1 where there is no 'r*'; 0 if r is out of range or no value follows
      integer, intent(out) :: start    !! of the value

      integer, parameter :: most_digits = 7
      integer :: star, status

      repeats = 1
      start = 1
      star = verify(word, digits)
      if (star < 2) return
      if (word(star:star) /= '*') return
      start = star + 1
      repeats = 0
      if (star - 1 > most_digits .or. start > len(word)) return
      read (word(:star - 1), *, iostat=status) repeats
      if (status /= 0) repeats = 0
   end subroutine split_repeat

   pure subroutine check_real(key, value, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value
      character(:), allocatable, intent(out) :: trouble

      integer, parameter :: exponent_limit = range(1.0_dp) - 1
      real(dp) :: number
      integer :: power, status
      logical :: is_number, is_zero

      call parse_number(value, is_number, is_zero, power)
      if (.not. is_number) then
         trouble = must_be(key, value)
         return
      end if
      number = 0
      if (.not. is_zero) then
         ! Before the conversion, which may trap: 1e999 overflows.
         if (abs(power) <= exponent_limit) read (value, *, iostat=status) number
         if (abs(number) < smallest_number .or. abs(number) > largest_number) then
            trouble = must_be(key, value)//'; numbers may be 0 or from 1e-90 to 1e90 in size'
            return
         end if
      end if
      if (.not. within(key, number)) trouble = must_be(key, value)
   end subroutine check_real

   pure subroutine check_integer(key, value, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value
      character(:), allocatable, intent(out) :: trouble

      integer :: power
      logical :: is_number, is_zero

      call parse_number(value, is_number, is_zero, power)
      if (is_number) is_number = verify(value, digits//'+-') == 0
      if (is_number) then
         ! Nine digits at most below: they fit an integer.
         if (is_zero) power = 0
         if (power <= 8) is_number = within(key, whole_number(value))
         if (power > 8) is_number = .false.
      end if
      if (.not. is_number) trouble = must_be(key, value)
   end subroutine check_integer

   pure real(dp) function whole_number(value)
      character(*), intent(in) :: value  !! at most nine digits that are not leading zeros

      integer :: number

      read (value, *) number
      whole_number = real(number, dp)
   end function whole_number

   pure logical function within(key, number)
      type(key_type), intent(in) :: key
      real(dp), intent(in) :: number

      within = number >= key%least .and. number <= key%most
      if (key%above) within = within .and. number > key%least
      if (key%below) within = within .and. number < key%most
   end function within

   !> Takes a number apart: sign, digits with at most one point, and an exponent with the letter e or d.
   !>
   !> N.B. Fortran reads 1+3 as 1e3 too. Here that is no number: it is more likely a sum, which decks do not
   !> have.
   pure subroutine parse_number(text, is_number, is_zero, power)
      character(*), intent(in) :: text
      logical, intent(out) :: is_number
      logical, intent(out) :: is_zero    !! whether all digits before the exponent are 0
      integer, intent(out) :: power      !! 10**power <= |number| < 10**(power+1)

      integer :: first, head, letter, point

      is_number = .false.
      is_zero = .false.
      power = 0
      if (len(text) == 0 .or. len(text) > longest_number) return
      first = 1
      if (scan(text(1:1), '+-') == 1) first = 2
      letter = scan(text, 'eEdD')
      if (letter == 0) letter = len(text) + 1
      associate (mantissa => text(first:letter - 1), exponent => text(min(letter + 1, len(text) + 1):))
         if (verify(mantissa, digits//'.') > 0 .or. scan(mantissa, digits) == 0) return
         point = index(mantissa, '.')
         if (point == 0) point = len(mantissa) + 1
         if (index(mantissa, '.') /= index(mantissa, '.', back=.true.)) return
         if (letter <= len(text)) then
            if (.not. is_exponent(exponent)) return
            call read_exponent(exponent, power)
         end if
         head = scan(mantissa, '123456789')
         is_zero = head == 0
         power = power + point - head - merge(1, 0, head < point)
      end associate
      is_number = .true.
   end subroutine parse_number

   pure logical function is_exponent(text)
      character(*), intent(in) :: text

      integer :: first

      first = 1
      if (len(text) > 0) first = merge(2, 1, scan(text(1:1), '+-') == 1)
      is_exponent = len(text) >= first .and. verify(text(first:), digits) == 0
   end function is_exponent

   !> The exponent, or one that is far out of range where it has too many digits to be read.
   pure subroutine read_exponent(text, power)
      character(*), intent(in) :: text
      integer, intent(out) :: power

      integer, parameter :: most_digits = 6, far_out = 10**most_digits
      integer :: head

      power = 0
      head = scan(text, '123456789')
      if (head == 0) return
      if (len(text) - head >= most_digits) then
         power = merge(-far_out, far_out, text(1:1) == '-')
      else
         read (text, *) power
      end if
   end subroutine read_exponent

   pure subroutine check_text(key, value, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value
      character(:), allocatable, intent(out) :: trouble

      character(:), allocatable :: text

      if (.not. is_constant(value)) then
         trouble = must_be(key, value)
         return
      end if
      text = unquoted(value)
      if (len(text) > key%longest) then
         trouble = trim(key%name)//' must be at most '//integer_text(key%longest)//' bytes long, got '// &
            integer_text(len(text))
      else if (.not. is_printable(text)) then
         trouble = trim(key%name)//' must be ASCII or UTF-8 text without control characters'
      else if (len_trim(text) == 0 .and. .not. key%may_be_blank) then
         trouble = trim(key%name)//' must not be blank'
      end if
   end subroutine check_text

   pure subroutine check_choice(key, value, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value
      character(:), allocatable, intent(out) :: trouble

      character(:), allocatable :: bare

      associate (choices => key%choices(:key%number_of_choices))
         bare = value
         if (is_constant(value)) then
            bare = unquoted(value)
            if (len(bare) <= len(choices) .and. any(choices == bare)) return
         else if (any(choices == lower_case(bare))) then
            trouble = trim(key%name)//" must be in quotes: '"//lower_case(bare)//"'"
            return
         end if
         trouble = must_be(key, value)//did_you_mean(lower_case(bare), choices, "'", "'")
      end associate
   end subroutine check_choice

   !> Whether a word is nothing but one character constant.
   pure logical function is_constant(word)
      character(*), intent(in) :: word

      integer :: i

      is_constant = .false.
      if (len(word) < 2) return
      if (scan(word(1:1), '"''') == 0) return
      i = 2
      do while (i <= len(word))
         if (word(i:i) == word(1:1)) then
            if (i == len(word)) exit
            if (word(i + 1:i + 1) /= word(1:1)) return
            i = i + 1
         end if
         i = i + 1
      end do
      is_constant = i == len(word)
   end function is_constant

   !> "key must be ..., got ..."
   pure function must_be(key, value) result(words)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value
      character(:), allocatable :: words

      type(key_type) :: one

      one = key
      one%most_values = 1
      words = trim(key%name)//' must be '//allowed_values(one)
      if (key%most_values > 1) words = 'each value of '//words
      if (is_constant(value)) then
         words = words//', got the text '//excerpt(value)
      else
         words = words//", got '"//excerpt(value)//"'"
      end if
   end function must_be

end module wavycon_key_values
