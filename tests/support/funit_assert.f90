!> The assertions: `@assertX(expected, actual, ..)` of a .pf file is `call funit_check('assertX', expected, actual, ..)`.
!>
!> Ranks are 0, 1 or 2; a scalar expected value is compared with every element, of which there must be one. Integers and
!> logical values are compared as real numbers, which hold them exactly. The arithmetic raises no floating-point
!> exception, so that a failure is reported in builds that trap them.
module funit_assert
   use, intrinsic :: iso_fortran_env, only: dp => real64, int64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_positive_inf, ieee_value
   use funit_exception, only: SourceLocation, count_assertion, throw
   implicit none (type, external)
   private

   public :: funit_check, funit_fail

   interface funit_check
      procedure :: check_reals, check_integers, check_logicals, check_strings, check_value
   end interface funit_check

   character(*), parameter :: newline = new_line('a')
   character(*), parameter :: indent = newline//'      '

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

      call compare(assertion, as_real, of_reals(expected), of_reals(actual), tolerance, message, location)

   contains

      function of_reals(x) result(one)
         real(dp), intent(in) :: x(..)
         type(operand) :: one

         one%shape = shape_of(x)
         select rank (x)
         rank (0)
            one%numbers = [x]
         rank (1)
            one%numbers = x
         rank (2)
            one%numbers = reshape(x, [size(x)])
         end select
      end function of_reals

   end subroutine check_reals

   subroutine check_integers(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call compare(assertion, as_integer, of_integers(expected), of_integers(actual), message=message, location=location)

   contains

      function of_integers(x) result(one)
         integer, intent(in) :: x(..)
         type(operand) :: one

         one%shape = shape_of(x)
         select rank (x)
         rank (0)
            one%numbers = [real(x, dp)]
         rank (1)
            one%numbers = real(x, dp)
         rank (2)
            one%numbers = reshape(real(x, dp), [size(x)])
         end select
      end function of_integers

   end subroutine check_integers

   !> Also of assertTrue and assertFalse, which take no array of rank 2, as in pFUnit.
   subroutine check_logicals(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      logical, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call compare(assertion, as_logical, of_logicals(expected), of_logicals(actual), message=message, location=location)

   contains

      function of_logicals(x) result(one)
         logical, intent(in) :: x(..)
         type(operand) :: one

         one%shape = shape_of(x)
         select rank (x)
         rank (0)
            one%numbers = [merge(1.0_dp, 0.0_dp, x)]
         rank (1)
            one%numbers = merge(1.0_dp, 0.0_dp, x)
         rank (2)
            one%numbers = reshape(merge(1.0_dp, 0.0_dp, x), [size(x)])
         end select
      end function of_logicals

   end subroutine check_logicals

   !> Same length and same characters: trailing blanks count, unlike in Fortran's `==`.
   subroutine check_strings(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      character(*), intent(in) :: expected, actual
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      integer :: i

      call count_assertion()
      if (len(expected) == len(actual) .and. expected == actual) return
      do i = 1, min(len(expected), len(actual))
         if (expected(i:i) /= actual(i:i)) exit
      end do
      call fail(assertion, message, location, &
         indent//"expected:   '"//expected//"'"//indent//"actual:     '"//actual//"'"//indent// &
         'difference: from character '//list_text([i])//' on; lengths '// &
         list_text([len(expected)])//' and '//list_text([len(actual)]))
   end subroutine check_strings

   !> assertIsFinite and assertIsNaN.
   subroutine check_value(assertion, x, message, location)
      character(*), intent(in) :: assertion
      real(dp), intent(in) :: x
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      if (merge(ieee_is_nan(x), ieee_is_finite(x), assertion == 'assertIsNaN')) return
      call fail(assertion, message, location, indent//'actual:     '//number_text(x, as_real))
   end subroutine check_value

   !> assertFail.
   subroutine funit_fail(message, location)
      character(*), intent(in) :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      call fail('assertFail', message, location, '')
   end subroutine funit_fail

   subroutine fail(assertion, message, location, details)
      character(*), intent(in) :: assertion
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location
      character(*), intent(in) :: details  !! lines, each begun by `indent`

      if (present(message)) then
         call throw(assertion//': '//message//details, location)
      else
         call throw(assertion//details, location)
      end if
   end subroutine fail

   !> Reports the first pair of numbers for which the relation of an assertion does not hold.
   subroutine compare(assertion, layout, expected, actual, tolerance, message, location)
      character(*), intent(in) :: assertion
      character(*), intent(in) :: layout       !! of the numbers, one of those above
      type(operand), intent(in) :: expected, actual
      real(dp), intent(in), optional :: tolerance
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      character(:), allocatable :: details, found, relation, wanted
      integer :: failures, first, highest_rank
      logical, allocatable :: holds(:)
      real(dp) :: allowed
      real(dp), allocatable :: e(:)

      call count_assertion()
      relation = relation_of(assertion)
      allowed = 0.0_dp
      if (present(tolerance)) allowed = tolerance
      if (.not. tolerance_is_sound(allowed, relation)) then
         call fail(assertion, message, location, &
                   indent//'the tolerance makes no sense: '//number_text(allowed, as_real))
         return
      end if
      highest_rank = merge(1, 2, assertion == 'assertTrue' .or. assertion == 'assertFalse')
      if (.not. conform(expected%shape, actual%shape, highest_rank)) then
         call fail(assertion, message, location, indent//'expected:   shape ('//list_text(expected%shape)//')'// &
            indent//'actual:     shape ('//list_text(actual%shape)//'), which cannot be compared')
         return
      end if
      e = expected%numbers
      if (size(expected%shape) == 0) e = spread(e(1), 1, size(actual%numbers))
      holds = relation_holds(relation, e, actual%numbers, allowed)
      first = findloc(holds, .false., dim=1)
      if (first == 0) return

      failures = count(.not. holds)
      wanted = number_text(e(first), layout)
      found = number_text(actual%numbers(first), layout)
      if (scan(relation, '<>') > 0) then
         details = indent//'required:   '//wanted//' '//relation//' '//found
      else
         details = indent//'expected:   '//wanted//indent//'actual:     '//found
      end if
      if (layout /= as_logical) details = details//indent//'difference: '// &
         difference_text(e(first), actual%numbers(first), layout)
      if (present(tolerance)) details = details//' (tolerance '//number_text(tolerance, as_real)//')'
      if (size(actual%shape) == 1) then
         details = details//indent//'element:    ('//list_text([first])//')'
      else if (size(actual%shape) == 2) then
         details = details//indent//'element:    ('// &
            list_text([1 + modulo(first - 1, actual%shape(1)), 1 + (first - 1)/actual%shape(1)])//')'
      end if
      if (size(actual%shape) > 0) details = details//', the first of '//list_text([failures])// &
         ' that fail, out of '//list_text([size(actual%numbers)])
      call fail(assertion, message, location, details)
   end subroutine compare

   pure function relation_of(assertion) result(relation)
      character(*), intent(in) :: assertion
      character(:), allocatable :: relation

      select case (assertion)
      case ('assertRelativelyEqual')
         relation = '~'
      case ('assertLessThan')
         relation = '<'
      case ('assertLessThanOrEqual')
         relation = '<='
      case ('assertGreaterThan')
         relation = '>'
      case ('assertGreaterThanOrEqual')
         relation = '>='
      case default
         relation = '=='
      end select
   end function relation_of

   !> No relation holds for NaN.
   elemental logical function relation_holds(relation, expected, actual, tolerance) result(holds)
      character(*), intent(in) :: relation
      real(dp), intent(in) :: expected, actual, tolerance

      holds = .false.
      if (ieee_is_nan(expected) .or. ieee_is_nan(actual)) return
      select case (relation)
      case ('==')
         holds = actual <= expected .and. actual >= expected
         if (.not. holds) holds = abs(signed_difference(actual, expected)) <= tolerance
      case ('~')
         if (.not. (ieee_is_finite(actual) .and. ieee_is_finite(expected))) return
         if (abs(expected) <= 0.0_dp) return
         holds = abs(signed_difference(actual, expected)) <= tolerance*abs(expected)
      case ('<')
         holds = expected < actual
      case ('<=')
         holds = expected <= actual
      case ('>')
         holds = expected > actual
      case ('>=')
         holds = expected >= actual
      end select
   end function relation_holds

   !> Not NaN, finite, not negative; a relative one of 1 or more would let zero pass.
   pure logical function tolerance_is_sound(tolerance, relation) result(sound)
      real(dp), intent(in) :: tolerance
      character(*), intent(in) :: relation

      sound = .false.
      if (.not. ieee_is_finite(tolerance)) return
      sound = tolerance >= 0.0_dp
      if (relation == '~') sound = sound .and. tolerance < 1.0_dp
   end function tolerance_is_sound

   !> actual - expected of numbers that are not NaN; infinite, without a trap, where that overflows.
   elemental real(dp) function signed_difference(actual, expected) result(difference)
      real(dp), intent(in) :: actual, expected

      if (actual <= expected .and. actual >= expected) then
         difference = 0.0_dp
      else if (abs(0.5_dp*actual - 0.5_dp*expected) > 0.5_dp*huge(actual)) then
         difference = sign(ieee_value(actual, ieee_positive_inf), 0.5_dp*actual - 0.5_dp*expected)
      else
         difference = actual - expected
      end if
   end function signed_difference

   !> Whether the shapes agree, or the expected value is a scalar and there is something to compare.
   pure logical function conform(expected, actual, highest_rank)
      integer, intent(in) :: expected(:), actual(:), highest_rank

      conform = size(actual) <= highest_rank
      if (size(expected) == 0) then
         conform = conform .and. product(actual) > 0
      else
         conform = conform .and. size(expected) == size(actual)
         if (conform) conform = all(expected == actual)
      end if
   end function conform

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

   function difference_text(expected, actual, layout) result(text)
      real(dp), intent(in) :: expected, actual
      character(*), intent(in) :: layout
      character(:), allocatable :: text

      text = 'none: one of them is NaN'
      if (.not. (ieee_is_nan(actual) .or. ieee_is_nan(expected))) &
         text = number_text(signed_difference(actual, expected), layout)
   end function difference_text

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
