!> Reads decimal numbers of decks and height maps.
module wavycon_decimal_number
   use, intrinsic :: iso_c_binding, only: c_null_char
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   use wavycon_system, only: parse_number
   implicit none (type, external)
   private

   public :: read_decimal

   !> Most bytes of a number.
   integer, parameter :: longest_number = 100

contains

   !> Reads a sign, digits with at most one point, and an exponent with the letter e or d.
   !>
   !> N.B. Fortran reads 1+3 as 1e3. Here it is not a number, because it is more likely meant as a sum.
   !> N.B. A number that is too large signals overflow: callers must switch off traps of overflow.
   subroutine read_decimal(word, value, is_number)
      character(*), intent(in) :: word
      real(dp), intent(out) :: value      !! the nearest double; infinity or 0 if out of range
      logical, intent(out) :: is_number   !! whether the whole word is a number

      character(longest_number + 1) :: number
      integer :: i

      call read_short(word, value, is_number)
      if (is_number) return
      if (len(word) == 0 .or. len(word) > longest_number) return
      number(:len(word)) = word
      do i = 1, len(word)
         select case (word(i:i))
         case ('0':'9', '+', '-', '.', 'e', 'E')
         case ('d', 'D')
            number(i:i) = 'e'
         case default
            return
         end select
      end do
      number(len(word) + 1:len(word) + 1) = c_null_char
      is_number = parse_number(number, value) == len(word)
   end subroutine read_decimal

   !> Reads a number of few digits: a whole number below 2**53, times or over a power of ten up to 10**22. Both are
   !> exact in double precision, so that the result is the nearest double (W. D. Clinger, How to read floating point
   !> numbers accurately, Proc. ACM SIGPLAN 1990, 92-101). It takes a fifth of the time of the C library.
   pure subroutine read_short(word, value, is_read)
      character(*), intent(in) :: word
      real(dp), intent(out) :: value    !! 0 if it is not read
      logical, intent(out) :: is_read   !! .false. for any other number and for what is no number

      !> Above this a number with one more digit may be beyond 2**53.
      integer(int64), parameter :: most = 900719925474098_int64
      !> Sign, 16 digits, point and exponent.
      integer, parameter :: longest = 22
      integer :: i
      real(dp), parameter :: tens(0:22) = [(10.0_dp**i, i=0, 22)]
      integer :: code, digits, exponent, fraction, start
      integer(int64) :: whole
      logical :: is_fraction

      value = 0.0_dp
      is_read = .false.
      start = 1
      if (len(word) == 0 .or. len(word) > longest) return
      if (word(1:1) == '-' .or. word(1:1) == '+') start = 2
      whole = 0
      digits = 0
      fraction = 0
      is_fraction = .false.
      do i = start, len(word)
         code = iachar(word(i:i)) - iachar('0')
         if (code >= 0 .and. code <= 9) then
            if (whole > most) return
            whole = 10*whole + code
            digits = digits + 1
            if (is_fraction) fraction = fraction + 1
         else if (word(i:i) == '.' .and. .not. is_fraction) then
            is_fraction = .true.
         else
            exit
         end if
      end do
      if (digits == 0) return
      exponent = 0
      if (i <= len(word)) then
         call read_exponent(word(i:), exponent, is_read)
         if (.not. is_read) return
      end if
      exponent = exponent - fraction
      is_read = abs(exponent) <= ubound(tens, 1)
      if (.not. is_read) return
      if (exponent >= 0) then
         value = whole*tens(exponent)
      else
         value = whole/tens(-exponent)
      end if
      if (word(1:1) == '-') value = -value
   end subroutine read_short

   !> Reads an exponent of at most two digits.
   pure subroutine read_exponent(word, exponent, is_read)
      character(*), intent(in) :: word   !! not empty
      integer, intent(out) :: exponent
      logical, intent(out) :: is_read

      integer :: code, i, start

      exponent = 0
      start = 2
      if (len(word) > 1) start = merge(3, 2, word(2:2) == '-' .or. word(2:2) == '+')
      is_read = scan(word(1:1), 'eEdD') == 1 .and. len(word) >= start .and. len(word) <= start + 1
      if (.not. is_read) return
      do i = start, len(word)
         code = iachar(word(i:i)) - iachar('0')
         is_read = is_read .and. code >= 0 .and. code <= 9
         exponent = 10*exponent + code
      end do
      if (word(2:2) == '-') exponent = -exponent
   end subroutine read_exponent

end module wavycon_decimal_number
