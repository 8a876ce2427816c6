!> The assertions: `@assertX(expected, actual, ..)` of a .pf file is
!> `call funit_check('assertX', expected, actual, ..)`.
!>
!> Ranks are 0, 1 or 2; a scalar expected value is compared with every element, of which there must be one. Integers and
!> logical values are compared as real numbers, which hold them exactly.
module funit_assert
   use, intrinsic :: iso_fortran_env, only: dp => real64, int64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use funit_runner, only: SourceLocation, count_assertion, throw
   implicit none (type, external)
   private

   public :: funit_check

   interface funit_check
      procedure :: check_reals, check_integers, check_logicals, check_strings, check_value, fail
   end interface funit_check

   character(*), parameter :: indent = new_line('a')//'      '

   !> How numbers are written.
   character(*), parameter :: as_real = '(es24.16e3)', as_integer = '(i0)', as_logical = '(l1)'

   !> Numbers of one operand, in array element order.
   type :: operand
      real(dp), allocatable :: numbers(:)
      integer, allocatable :: shape(:)
   end type operand

contains

   subroutine check_reals(assertion, expected, actual, tolerance, message, location)
      character(*), intent(in) :: assertion   !! the name of the directive
      real(dp), intent(in) :: expected(..), actual(..)
      real(dp), intent(in), optional :: tolerance
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call compare(assertion, as_real, operand_of(expected), operand_of(actual), tolerance, message, location)
   end subroutine check_reals

   subroutine check_integers(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call compare(assertion, as_integer, operand_of(expected), operand_of(actual), message=message, &
                   location=location)
   end subroutine check_integers

   !> Also of assertTrue and assertFalse.
   subroutine check_logicals(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      logical, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call compare(assertion, as_logical, operand_of(expected), operand_of(actual), message=message, &
                   location=location)
   end subroutine check_logicals

   !> Same length and same characters: trailing blanks count, unlike in Fortran's `==`.
   subroutine check_strings(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      character(*), intent(in) :: expected, actual
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      if (len(expected) == len(actual) .and. expected == actual) return
      call report(assertion, message, location, indent//"expected:   '"//expected//"'"//indent// &
         "actual:     '"//actual//"'")
   end subroutine check_strings

   !> assertIsFinite and assertIsNaN.
   subroutine check_value(assertion, x, message, location)
      character(*), intent(in) :: assertion
      real(dp), intent(in) :: x
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      if (merge(ieee_is_nan(x), ieee_is_finite(x), assertion == 'assertIsNaN')) return
      call report(assertion, message, location, indent//'actual:     '//number_text(x, as_real))
   end subroutine check_value

   !> assertFail.
   subroutine fail(assertion, message, location)
      character(*), intent(in) :: assertion, message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      call report(assertion, message, location, '')
   end subroutine fail

   subroutine report(assertion, message, location, details)
      character(*), intent(in) :: assertion
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location
      character(*), intent(in) :: details  !! lines, each begun by `indent`

      if (present(message)) then
         call throw(assertion//': '//message//details, location)
      else
         call throw(assertion//details, location)
      end if
   end subroutine report

   !> Reports the first pair of numbers for which the relation of an assertion does not hold.
   subroutine compare(assertion, layout, expected, actual, tolerance, message, location)
      character(*), intent(in) :: assertion
      character(*), intent(in) :: layout       !! of the numbers, one of those above
      type(operand), intent(in) :: expected, actual
      real(dp), intent(in), optional :: tolerance
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      character(:), allocatable :: details
      integer :: first
      logical, allocatable :: holds(:)
      logical :: alike
      real(dp) :: allowed
      real(dp), allocatable :: e(:)

      call count_assertion()
      if (size(expected%shape) == 0) then
         alike = size(actual%numbers) > 0
         e = spread(expected%numbers(1), 1, size(actual%numbers))
      else
         alike = size(expected%shape) == size(actual%shape)
         if (alike) alike = all(expected%shape == actual%shape)
         e = expected%numbers
      end if
      if (.not. alike) then
         call report(assertion, message, location, indent//'expected:   shape ('//list_text(expected%shape)//')'// &
            indent//'actual:     shape ('//list_text(actual%shape)//'), which cannot be compared')
         return
      end if
      allowed = 0.0_dp
      if (present(tolerance)) allowed = tolerance
      holds = relation_holds(assertion, e, actual%numbers, allowed)
      first = findloc(holds, .false., dim=1)
      if (first == 0) return

      details = indent//'expected:   '//number_text(e(first), layout)//indent//'actual:     '// &
         number_text(actual%numbers(first), layout)
      if (layout == as_real .and. ieee_is_finite(e(first)) .and. ieee_is_finite(actual%numbers(first))) &
         details = details//indent//'difference: '//number_text(actual%numbers(first) - e(first), layout)
      if (present(tolerance)) details = details//' (tolerance '//number_text(tolerance, as_real)//')'
      if (size(actual%shape) > 0) then
         details = details//indent//'element:    ('//list_text([1 + modulo(first - 1, actual%shape(1))])
         if (size(actual%shape) == 2) details = details//', '//list_text([1 + (first - 1)/actual%shape(1)])
         details = details//'), the first of '//list_text([count(.not. holds)])//' that fail, out of '// &
            list_text([size(holds)])
      end if
      call report(assertion, message, location, details)
   end subroutine compare

   !> No relation holds for NaN, which is not compared: that would be an exception where these are trapped.
   elemental logical function relation_holds(assertion, expected, actual, tolerance) result(holds)
      character(*), intent(in) :: assertion
      real(dp), intent(in) :: expected, actual, tolerance

      holds = .false.
      if (ieee_is_nan(expected) .or. ieee_is_nan(actual)) return
      select case (assertion)
      case ('assertRelativelyEqual')
         if (.not. (ieee_is_finite(actual) .and. ieee_is_finite(expected))) return
         holds = abs(expected) > 0.0_dp .and. abs(actual - expected) <= tolerance*abs(expected)
      case ('assertLessThan')
         holds = expected < actual
      case ('assertLessThanOrEqual')
         holds = expected <= actual
      case ('assertGreaterThan')
         holds = expected > actual
      case ('assertGreaterThanOrEqual')
         holds = expected >= actual
      case default
         holds = actual <= expected .and. actual >= expected
         if (.not. holds) holds = abs(actual - expected) <= tolerance
      end select
   end function relation_holds

   function operand_of(x) result(one)
      class(*), intent(in) :: x(..)
      type(operand) :: one

      one%shape = shape_of(x)
      select rank (x)
      rank (0)
         one%numbers = [number_of(x)]
      rank (1)
         ! With gfortran 12 x may begin at 0, and then a plain copy would.
         one%numbers = [number_of(x)]
      rank (2)
         one%numbers = reshape(number_of(x), [size(x)])
      end select
   end function operand_of

   !> A real number, an integer, or 1 and 0 for a logical value.
   elemental real(dp) function number_of(x)
      class(*), intent(in) :: x

      number_of = 0.0_dp
      select type (x)
      type is (real(dp))
         number_of = x
      type is (integer)
         number_of = real(x, dp)
      type is (logical)
         number_of = merge(1.0_dp, 0.0_dp, x)
      end select
   end function number_of

   !> The shape. gfortran 11 writes beyond the result of `shape` for a scalar of assumed rank, and gfortran 12 gives an
   !> empty array of assumed rank the extent -1.
   function shape_of(x) result(extents)
      type(*), intent(in) :: x(..)
      integer, allocatable :: extents(:)

      integer :: i

      allocate (extents(rank(x)))
      do i = 1, size(extents)
         extents(i) = max(size(x, i), 0)
      end do
   end function shape_of

   !> A number with every digit that it has.
   pure function number_text(x, layout) result(text)
      real(dp), intent(in) :: x
      character(*), intent(in) :: layout
      character(:), allocatable :: text

      character(32) :: buffer

      select case (layout)
      case (as_real)
         write (buffer, layout) x
      case (as_integer)
         write (buffer, layout) nint(x, int64)
      case default
         buffer = merge('.true. ', '.false.', x > 0.5_dp)
      end select
      text = trim(adjustl(buffer))
   end function number_text

   !> Integers, with commas between them.
   pure function list_text(list) result(text)
      integer, intent(in) :: list(:)
      character(:), allocatable :: text

      integer :: i

      text = ''
      do i = 1, size(list)
         if (i > 1) text = text//', '
         text = text//number_text(real(list(i), dp), as_integer)
      end do
   end function list_text

end module funit_assert
