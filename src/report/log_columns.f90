!> Numbers and words in the columns of the log.
module wavycon_log_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: at_left, at_right, cell, error_cell, with_exponent, with_unit

   !> Characters of the columns of P, of values, and of errors.
   integer, parameter, public :: load_width = 10, width = 12, error_width = 8

contains

   !> A number at the right of a column: with six decimals where they fit, otherwise with an exponent.
   pure function cell(number, width) result(text)
      real(dp), intent(in) :: number
      integer, intent(in) :: width      !! at least 10
      character(:), allocatable :: text

      real(dp), parameter :: least = 1.0e-3_dp
      character(20) :: buffer

      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      if (ieee_is_nan(number)) then
         text = at_right('NaN', width)
      else if ((abs(number) >= least .and. abs(number) < 10.0_dp**(width - 8)) .or. .not. abs(number) > 0) then
         write (buffer, '(f20.6)') number
         text = at_right(trim(adjustl(buffer)), width)
      else
         text = at_right(with_exponent(number, min(4, width - 7)), width)
      end if
   end function cell

   !> An error estimate at the right of its column: '-' for NaN, an error that is unknown.
   pure function error_cell(error) result(text)
      real(dp), intent(in) :: error
      character(:), allocatable :: text

      if (ieee_is_nan(error)) then
         text = at_right('-', error_width)
      else
         text = at_right(with_exponent(error, 1), error_width)
      end if
   end function error_cell

   !> A number as 1.2345E+06, or as 1.2345E+249 if the exponent has three digits: there Fortran's `es` without an
   !> exponent width would omit the E.
   pure function with_exponent(number, decimals) result(text)
      real(dp), intent(in) :: number
      integer, intent(in) :: decimals
      character(:), allocatable :: text

      character(20) :: buffer, layout

      write (layout, '(a, i0, a)') '(es20.', decimals, ')'
      write (buffer, layout) number
      write (layout, '(a, i0, a)') '(es20.', decimals, 'e3)'
      if (index(buffer, 'E') == 0) write (buffer, layout) number
      text = trim(adjustl(buffer))
   end function with_exponent

   !> A name with a unit, such as 'pbar[MPa]', or the name alone if both do not fit into a column.
   pure function with_unit(name, unit) result(words)
      character(*), intent(in) :: name, unit
      character(:), allocatable :: words

      words = name//'['//unit//']'
      if (len(words) >= width) words = name
   end function with_unit

   pure function at_right(text, width) result(column)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: column

      column = repeat(' ', max(0, width - len(text)))//text
   end function at_right

   pure function at_left(text, width) result(column)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: column

      column = text//repeat(' ', max(0, width - len(text)))
   end function at_left

end module wavycon_log_columns
