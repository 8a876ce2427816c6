!> Text for messages and decks: lower case, numbers in words, lists, quotes, and escapes for bytes that do not print.
module wavycon_plain_text
   use wavycon_kinds, only: dp, int64
   implicit none (type, external)
   private

   public :: lower_case, integer_text, short_number, exact_number, quoted, unquoted, system_words
   public :: clauses, in_quotes, lines_of, listed, percent, replaced, with_mark
   public :: is_printable, escaped, excerpt, character_count

   !> An integer in decimal, without blanks.
   interface integer_text
      procedure :: default_integer_text, long_integer_text
   end interface integer_text

   character(*), parameter, public :: newline = achar(10), decimal_digits = '0123456789'

   character(*), parameter :: hexadecimal = '0123456789ABCDEF'

contains

   !> The text with A-Z replaced by a-z.
   pure function lower_case(text) result(lower)
      character(*), intent(in) :: text
      character(:), allocatable :: lower

      integer :: i

      lower = text
      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') lower(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end function lower_case

   !> For default integers.
   pure function default_integer_text(number) result(text)
      integer, intent(in) :: number
      character(:), allocatable :: text

      text = long_integer_text(int(number, int64))
   end function default_integer_text

   !> For 64-bit integers.
   pure function long_integer_text(number) result(text)
      integer(int64), intent(in) :: number
      character(:), allocatable :: text

      character(20) :: buffer
      integer :: first
      integer(int64) :: left

      ! Digit by digit, the last one first: an internal WRITE takes twenty times as long.
      left = number
      do first = len(buffer), 2, -1
         buffer(first:first) = achar(iachar('0') + int(abs(mod(left, 10_int64))))
         left = left/10
         if (left == 0) exit
      end do
      text = buffer(first:)
      if (number < 0) text = '-'//text
   end function long_integer_text

   !> A number in six significant digits without final zeros: 0.01, 4.44288, 1e-7, -2.5e6.
   pure function short_number(number) result(text)
      real(dp), intent(in) :: number
      character(:), allocatable :: text

      text = rounded(number, 6)
   end function short_number

   !> A number in 6, 15, 16 or 17 significant digits, the fewest that give the same number when read again. A NaN is
   !> 'NaN'.
   pure function exact_number(number) result(text)
      real(dp), intent(in) :: number
      character(:), allocatable :: text

      integer, parameter :: lengths(*) = [6, 15, 16, 17]   ! 17 digits are enough for any double precision number
      real(dp) :: again
      integer :: i

      do i = 1, size(lengths)
         text = rounded(number, lengths(i))
         if (text == 'NaN') return   ! comparisons with a NaN raise an exception, which Debug builds trap
         read (text, '(f32.0)') again
         if (.not. (again < number .or. again > number)) return
      end do
   end function exact_number

   !> A number rounded to a number of significant digits, without final zeros: as an integer, a decimal fraction or, if
   !> very small or large, with an exponent.
   pure function rounded(number, significant) result(text)
      real(dp), intent(in) :: number
      integer, intent(in) :: significant   !! number of digits, 6 to 17
      character(:), allocatable :: text

      integer, parameter :: least_plain = -4, most_plain = 5   ! powers of ten that need no exponent
      character(32) :: buffer, layout
      integer :: letter, power

      if (exponent(number) <= 16) then   ! false for a NaN, whose comparison would trap
         if (sign(1.0_dp, number) > 0.0_dp .and. .not. number > aint(number)) text = integer_text(int(number))
      end if
      if (allocated(text)) return
      write (layout, '(a, i0, a)') '(es32.', significant - 1, 'e3)'
      write (buffer, layout) number
      text = trim(adjustl(buffer))
      letter = index(text, 'E')
      if (letter == 0) return   ! an infinity, or no number
      read (text(letter + 1:), '(i4)') power
      if (power < least_plain .or. power > most_plain) then
         text = without_final_zeros(text(:letter - 1))//'e'//integer_text(power)
         return
      end if
      write (layout, '(a, i0, a)') '(f32.', significant - 1 - power, ')'
      write (buffer, layout) number
      text = without_final_zeros(trim(adjustl(buffer)))
   end function rounded

   !> A decimal fraction without the zeros that end it, and without the point if no digit follows it.
   pure function without_final_zeros(decimal) result(text)
      character(*), intent(in) :: decimal   !! decimal fraction with a point
      character(:), allocatable :: text

      text = decimal(:verify(decimal, '0', back=.true.))
      if (text(len(text):) == '.') text = text(:len(text) - 1)
   end function without_final_zeros

   !> A name in quotes: 'name'. Blanks at its end are left out and follow behind the quotes.
   elemental function in_quotes(name) result(words)
      character(*), intent(in) :: name
      character(len(name) + 2) :: words

      words = "'"//trim(name)//"'"
   end function in_quotes

   !> "a, b, c" or, with a last separator such as ' and ', "a, b and c".
   pure function listed(names, last) result(words)
      character(*), intent(in) :: names(:)              !! at least one; blanks at their ends are left out
      character(*), intent(in), optional :: last        !! the last separator; absent: ', '
      character(:), allocatable :: separator, words

      integer :: i

      words = trim(names(1))
      separator = ', '
      do i = 2, size(names)
         if (i == size(names) .and. present(last)) separator = last
         words = words//separator//trim(names(i))
      end do
   end function listed

   !> The lines of a text, padded with blanks; none of an empty text.
   pure function lines_of(text) result(lines)
      character(*), intent(in) :: text
      character(:), allocatable :: lines(:)

      integer :: first, i, last, length, pass

      length = 0
      do pass = 1, 2   ! finds the number of lines and the longest one; takes them
         first = 1
         i = 0
         do while (first <= len(text))
            last = first + index(text(first:), newline) - 2
            if (last < first - 1) last = len(text)   ! the last line has no newline
            length = max(length, last - first + 1)
            i = i + 1
            if (pass == 2) lines(i) = text(first:last)
            first = last + 2
         end do
         if (pass == 1) allocate (character(length) :: lines(i))
      end do
   end function lines_of

   !> Two clauses of a sentence, 'first; second'.
   pure function clauses(first, second) result(words)
      character(*), intent(in) :: first, second   !! if one is empty, the result is the other
      character(:), allocatable :: words

      words = second
      if (second == '') words = first
      if (first /= '' .and. second /= '') words = first//'; '//second
   end function clauses

   !> A fraction in per cent, such as '2.5 %', rounded to 0.1 %.
   pure function percent(part) result(share)
      real(dp), intent(in) :: part   !! the fraction, 0 to 1
      character(:), allocatable :: share

      share = short_number(0.1_dp*nint(1000*part))//' %'
      if (part > 0.0_dp .and. nint(1000*part) == 0) share = 'below 0.1 %'
   end function percent

   !> The text as a Fortran character constant: in quotes, with quotes inside doubled.
   pure function quoted(text) result(constant)
      character(*), intent(in) :: text
      character(:), allocatable :: constant

      constant = "'"//with_mark(text, "'", "'")//"'"
   end function quoted

   !> The text with a mark before each of some bytes.
   pure function with_mark(text, bytes, mark) result(marked)
      character(*), intent(in) :: text
      character(*), intent(in) :: bytes   !! the bytes that get the mark
      character, intent(in) :: mark
      character(:), allocatable :: marked

      integer :: i

      marked = ''
      do i = 1, len(text)
         if (index(bytes, text(i:i)) > 0) marked = marked//mark
         marked = marked//text(i:i)
      end do
   end function with_mark

   !> The text with another byte in place of one.
   pure function replaced(text, old, new) result(changed)
      character(*), intent(in) :: text
      character, intent(in) :: old, new
      character(len(text)) :: changed

      integer :: i

      do i = 1, len(text)
         changed(i:i) = merge(new, text(i:i), text(i:i) == old)
      end do
   end function replaced

   !> The value of a Fortran character constant, in quotes of either kind.
   pure function unquoted(constant) result(text)
      character(*), intent(in) :: constant  !! with the same quote at both ends, which is doubled inside
      character(:), allocatable :: text

      character(:), allocatable :: buffer
      integer :: i, length

      allocate (character(len(constant)) :: buffer)
      length = 0
      i = 2
      do while (i < len(constant))
         length = length + 1
         buffer(length:length) = constant(i:i)
         if (constant(i:i) == constant(1:1)) i = i + 1
         i = i + 1
      end do
      text = buffer(:length)
   end function unquoted

   !> Number of bytes of the printable character, ASCII or UTF-8, that starts at a position; 0 if none starts there.
   pure integer function printable_length(text, position) result(length)
      character(*), intent(in) :: text
      integer, intent(in) :: position   !! 1 to len(text)

      !> The least code of a character of 1, 2, 3 and 4 bytes. Smaller codes in as many bytes are not valid UTF-8.
      integer, parameter :: least(*) = [0, 128, 2048, 65536]
      !> The range of the first byte of such characters, and the part of the first byte that marks the length.
      integer, parameter :: lowest(*) = [32, 194, 224, 240], highest(*) = [126, 223, 239, 244], &
                            mark(*) = [0, 192, 224, 240]
      integer :: code, i

      code = iachar(text(position:position))
      length = findloc(code >= lowest .and. code <= highest, .true., dim=1)
      if (length <= 1) return
      code = code - mark(length)
      do i = position + 1, position + length - 1
         if (i <= len(text)) then
            if (is_continuation(text(i:i))) then
               code = 64*code + iachar(text(i:i)) - 128
               cycle
            end if
         end if
         length = 0
         return
      end do
      if (code < least(length)) length = 0
      ! Control characters, invisible blanks and marks of the direction of writing may come with copied text. They count
      ! as not printable, so that a message shows that a word is not the one that it looks like. The other codes here
      ! are not characters.
      select case (code)
      case (128:160, int(z'AD'), int(z'61C'), int(z'180E'), int(z'2000'):int(z'200F'), int(z'2028'):int(z'202F'), &
            int(z'2060'):int(z'206F'), int(z'D800'):int(z'DFFF'), int(z'FEFF'), int(z'FFF9'):int(z'FFFB'), &
            int(z'E0000'):int(z'E0FFF'), int(z'110000'):)
         length = 0
      end select
      if (modulo(code, 65536) >= 65534) length = 0
   end function printable_length

   !> Whether a byte is the second or a later byte of a UTF-8 character.
   elemental logical function is_continuation(byte)
      character(1), intent(in) :: byte

      is_continuation = iachar(byte) >= 128 .and. iachar(byte) < 192
   end function is_continuation

   !> Whether a text is ASCII or UTF-8, and all its characters print.
   pure logical function is_printable(text)
      character(*), intent(in) :: text

      is_printable = escaped(text) == text
   end function is_printable

   !> The text with tabs replaced by blanks and other bytes that do not print by \xNN.
   pure function escaped(text) result(clean)
      character(*), intent(in) :: text
      character(:), allocatable :: clean

      character(:), allocatable :: buffer, piece
      integer :: code, length, position, used

      allocate (character(4*len(text)) :: buffer)
      used = 0
      position = 1
      do while (position <= len(text))
         length = max(1, printable_length(text, position))
         piece = text(position:position + length - 1)
         code = iachar(piece(1:1))
         if (code == 9) then
            piece = ' '
         else if (length == 1 .and. (code < 32 .or. code > 126)) then
            piece = '\x'//hexadecimal(code/16 + 1:code/16 + 1)//hexadecimal(mod(code, 16) + 1:mod(code, 16) + 1)
         end if
         buffer(used + 1:used + len(piece)) = piece
         used = used + len(piece)
         position = position + length
      end do
      clean = buffer(:used)
   end function escaped

   !> A text for a message: escaped, and cut after 40 bytes.
   pure function excerpt(text) result(short)
      character(*), intent(in) :: text
      character(:), allocatable :: short

      integer, parameter :: longest = 40
      integer :: last

      last = min(longest, len(text))
      if (last < len(text)) then
         do while (is_continuation(text(last + 1:last + 1)) .and. last > longest - 4)
            last = last - 1
         end do
      end if
      short = escaped(text(:last))
      if (last < len(text)) short = short//'...'
   end function excerpt

   !> The message of the operating system, without the words that gfortran puts before it: "Cannot open file 'name': ".
   pure function system_words(message) result(words)
      character(*), intent(in) :: message   !! the iomsg of a Fortran statement
      character(:), allocatable :: words

      character(*), parameter :: before = "': "
      integer :: position

      position = index(message, before, back=.true.)
      words = trim(message)
      if (position > 0) words = trim(message(position + len(before):))
   end function system_words

   !> Number of characters of a UTF-8 text.
   pure integer function character_count(text)
      character(*), intent(in) :: text

      integer :: i

      character_count = count([(.not. is_continuation(text(i:i)), i=1, len(text))])
   end function character_count

end module wavycon_plain_text
