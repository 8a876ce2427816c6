!> Reads decimal numbers of decks and height maps.
module wavycon_decimal_number
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_loc, c_null_char, c_ptr
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: read_decimal

   !> Most bytes of the text of a number.
   integer, parameter :: longest_number = 100

   interface
      !> The C library's function: the number at the start of a text that a null character ends, and a pointer to the
      !> first byte behind the number.
      !> N.B. A number that is too large gives an infinity and signals overflow.
      real(c_double) function strtod(text, behind) bind(c, name='strtod')
         import :: c_double, c_ptr
         type(c_ptr), value :: text
         type(c_ptr), intent(out) :: behind
      end function strtod
   end interface

contains

   !> Reads a decimal number: a sign, digits with at most one point, and an exponent with the letter e or d.
   !>
   !> N.B. Fortran reads 1+3 as 1e3. Here 1+3 is not a number, because the user more likely means a sum.
   !> N.B. A number that is too large signals overflow: callers must switch off traps of overflow.
   subroutine read_decimal(word, value, is_number)
      character(*), intent(in) :: word    !! text without blanks
      real(dp), intent(out) :: value      !! the nearest double; infinity or 0 if out of range
      logical, intent(out) :: is_number   !! whether the whole word is a number

      character(longest_number + 1), target :: number
      type(c_ptr) :: behind
      integer :: i

      value = 0.0_dp
      is_number = .false.
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
      value = strtod(c_loc(number), behind)
      is_number = c_associated(behind, c_loc(number(len(word) + 1:len(word) + 1)))
   end subroutine read_decimal

end module wavycon_decimal_number
