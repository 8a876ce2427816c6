!> Reads the value of a key from a word of a deck, and checks type and bounds of the value.
module wavycon_key_values
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_overflow, ieee_set_halting_mode, ieee_set_status, &
      ieee_status_type
   use wavycon_decimal_number, only: read_decimal
   use wavycon_key_table, only: allowed_values, choice_value, integer_value, key_type, logical_value, &
      name_length, real_value, text_value, words_of
   use wavycon_kinds, only: dp, ieee_is_nan, largest_number, smallest_number
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: decimal_digits, excerpt, integer_text, is_printable, lower_case, unquoted
   implicit none (type, external)
   private

   public :: check_number, must_be, read_value, word_value

   !> The value of a word: a number or a text, according to the type of the key.
   type :: word_value
      integer :: repeats = 1                 !! r of 'r*value'
      real(dp) :: number = 0.0_dp            !! value of a real or an integer; of a logical 1 for .true., 0 for .false.
      character(:), allocatable :: text      !! value of a text or a choice, without the quotes
   end type word_value

   character(*), parameter :: true_words(*) = ['.true.', 'true  ', '.t.   ', 't     ']
   character(*), parameter :: false_words(*) = ['.false.', 'false  ', '.f.    ', 'f      ']

contains

   !> Reads one word: 'value', or 'r*value' for r equal values.
   subroutine read_value(key, word, value, trouble)
      type(key_type), intent(in) :: key                   !! description of the key
      character(*), intent(in) :: word                    !! the word as the deck has it, with its quotes
      type(word_value), intent(out) :: value
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      integer :: start

      call split_repeat(word, value%repeats, start)
      if (value%repeats < 1) then
         trouble = trim(key%name)//": '"//excerpt(word)//"' must be a count, '*' and a value"
         value%repeats = 1
         return
      end if
      associate (rest => word(start:))
         select case (key%kind)
         case (real_value, integer_value)
            call read_number(key, rest, value%number, trouble)
         case (logical_value)
            value%number = count(lower_case(rest) == true_words)
            if (value%number < 1 .and. all(lower_case(rest) /= false_words)) trouble = must_be(key, rest)
         case (text_value)
            call read_text(key, rest, value%text, trouble)
         case (choice_value)
            call read_choice(key, rest, value%text, trouble)
         end select
      end associate
   end subroutine read_value

   !> Reads the repeat count 'r*' at the front of a word.
   pure subroutine split_repeat(word, repeats, start)
      character(*), intent(in) :: word
      integer, intent(out) :: repeats  !! 1 where there is no 'r*'; 0 if r is out of range or no value follows
      integer, intent(out) :: start    !! first byte of the value in the word

      integer :: star, status

      repeats = 1
      start = 1
      star = verify(word, decimal_digits)
      if (star < 2) return
      if (word(star:star) /= '*') return
      start = star + 1
      read (word(:star - 1), *, iostat=status) repeats
      if (status /= 0 .or. start > len(word)) repeats = 0
   end subroutine split_repeat

   !> Reads a real number, or an integer: digits and perhaps a sign, without point and exponent.
   subroutine read_number(key, word, number, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: word
      real(dp), intent(out) :: number   !! exact for integers: the bounds of decks are far below 2^53
      character(:), allocatable, intent(out) :: trouble

      type(ieee_status_type) :: floating_point
      logical :: is_number

      ! Overflow must not trap: 1e999 must be reported as bad input in Debug builds too.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call read_decimal(word, number, is_number)
      call ieee_set_status(floating_point)
      if (key%kind == integer_value) is_number = is_number .and. verify(word, decimal_digits//'+-') == 0
      if (is_number) then
         call check_number(key, word, number, trouble)
      else
         trouble = must_be(key, word)
         if (index(word, ';') > 0) trouble = trouble//'; commas or blanks separate values, a point the decimals'
      end if
   end subroutine read_number

   !> Checks a number against the bounds of a key.
   pure subroutine check_number(key, word, number, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: word   !! the number as it is written, for the message
      real(dp), intent(in) :: number
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      if (ieee_is_nan(number)) then
         trouble = must_be(key, word)
      else if (key%kind == real_value .and. (abs(number) > largest_number .or. &
                                             (abs(number) < smallest_number .and. abs(number) > 0.0_dp))) then
         trouble = must_be(key, word)//'; numbers may be 0 or from 1e-90 to 1e90 in size'
      else if (number < key%least .or. number > key%most .or. number <= key%above .or. number >= key%below) then
         trouble = must_be(key, word)
      end if
   end subroutine check_number

   !> Reads a text: a character constant in quotes.
   pure subroutine read_text(key, word, text, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: word
      character(:), allocatable, intent(out) :: text      !! without blanks at its end
      character(:), allocatable, intent(out) :: trouble

      if (.not. is_constant(word)) then
         trouble = must_be(key, word)
         return
      end if
      text = unquoted(word)
      if (len(text) > key%longest) then
         trouble = trim(key%name)//' must be at most '//integer_text(key%longest)//' bytes long, got '// &
            integer_text(len(text))
      else if (.not. is_printable(text)) then
         trouble = trim(key%name)//' must be ASCII or UTF-8 text without control characters'
      else if (len_trim(text) == 0 .and. .not. key%may_be_blank) then
         trouble = trim(key%name)//' must not be blank'
      end if
      text = trim(text)
   end subroutine read_text

   !> Reads a choice: one of the words of the key, in quotes.
   pure subroutine read_choice(key, word, text, trouble)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: word
      character(:), allocatable, intent(out) :: text, trouble

      character(name_length), allocatable :: choices(:)

      text = word
      choices = words_of(key%choices)
      if (is_constant(word)) then
         text = unquoted(word)
         if (any(choices == text)) return   ! blanks at the end of the text are ignored
      else if (any(choices == lower_case(word))) then
         trouble = trim(key%name)//" must be in quotes: '"//lower_case(word)//"'"
         return
      end if
      trouble = must_be(key, word)//did_you_mean(lower_case(text), choices, "'", "'")
   end subroutine read_choice

   !> Whether a word is a character constant in quotes.
   pure logical function is_constant(word)
      character(*), intent(in) :: word   !! a word that ends with its closing quote if it begins with a quote

      is_constant = len(word) > 1 .and. scan(word, '"''') == 1
   end function is_constant

   !> The message for a bad value: "key must be ..., got ...".
   pure function must_be(key, value) result(words)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: value   !! the value as it is written, a text with its quotes
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
