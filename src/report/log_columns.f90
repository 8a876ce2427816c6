!> Lines of the log with numbers and words in columns, and the names above these.
module wavycon_log_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: log_line

   !> Characters of the columns of P, of values, and of errors.
   integer, parameter, public :: load_width = 10, width = 12, error_width = 8

   !> A line that grows column by column, together with that of the names.
   type :: log_line
      character(:), allocatable :: names, words
   contains
      procedure :: start
      procedure :: add_word
      procedure :: add_number
      procedure :: add_error
   end type log_line

contains

   !> Starts a line with the column of the load.
   subroutine start(self, name, load)
      class(log_line), intent(out) :: self
      character(*), intent(in) :: name
      real(dp), intent(in) :: load

      self%names = at_right(name, load_width)
      self%words = cell(load, load_width)
   end subroutine start

   !> Adds a word at the right of a column.
   subroutine add_word(self, name, word, width)
      class(log_line), intent(inout) :: self
      character(*), intent(in) :: name, word
      integer, intent(in) :: width             !! of the column

      self%names = self%names//at_right(name, width)
      self%words = self%words//at_right(word, width)
   end subroutine add_word

   !> Adds a number.
   subroutine add_number(self, name, number, unit)
      class(log_line), intent(inout) :: self
      character(*), intent(in) :: name
      real(dp), intent(in) :: number
      character(*), intent(in), optional :: unit   !! is shown, such as in 'pbar[MPa]', if it fits into the column

      character(:), allocatable :: name_and_unit

      name_and_unit = name
      if (present(unit)) then
         if (len(name//'['//unit//']') < width) name_and_unit = name//'['//unit//']'
      end if
      call self%add_word(name_and_unit, cell(number, width), width)
   end subroutine add_number

   !> Adds an error estimate: '-' for NaN, an error that is unknown.
   subroutine add_error(self, error)
      class(log_line), intent(inout) :: self
      real(dp), intent(in) :: error

      if (ieee_is_nan(error)) then
         call self%add_word('error', '-', error_width)
      else
         call self%add_word('error', with_exponent(error, 1), error_width)
      end if
   end subroutine add_error

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

   pure function at_right(text, width) result(column)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: column

      column = repeat(' ', max(0, width - len(text)))//text
   end function at_right

end module wavycon_log_columns
