!> The assertions: expected value first, actual value second.
!>
!> Ranks are 0, 1 or 2; a scalar expected value is compared with every element, of which there must be one.
!> Conditions of assertTrue and assertFalse are scalars or vectors.
!> The arithmetic raises no floating-point exception, so that a failure is reported in builds that trap them.
module funit_assert
   use, intrinsic :: iso_fortran_env, only: dp => real64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_positive_inf, ieee_value
   use funit_exception, only: SourceLocation, count_assertion, throw
   implicit none (type, external)
   private

   public :: assertEqual, assertRelativelyEqual
   public :: assertLessThan, assertLessThanOrEqual, assertGreaterThan, assertGreaterThanOrEqual
   public :: assertTrue, assertFalse, assertIsFinite, assertIsNaN, assertFail

   interface assertEqual
      procedure :: equal_real, equal_integer, equal_logical, equal_string
   end interface assertEqual

   interface assertLessThan
      procedure :: less_real, less_integer
   end interface assertLessThan

   interface assertLessThanOrEqual
      procedure :: less_equal_real, less_equal_integer
   end interface assertLessThanOrEqual

   interface assertGreaterThan
      procedure :: greater_real, greater_integer
   end interface assertGreaterThan

   interface assertGreaterThanOrEqual
      procedure :: greater_equal_real, greater_equal_integer
   end interface assertGreaterThanOrEqual

   ! No array of rank 2, as in pFUnit.
   interface assertTrue
      procedure :: true_scalar, true_vector
   end interface assertTrue

   interface assertFalse
      procedure :: false_scalar, false_vector
   end interface assertFalse

   character(*), parameter :: newline = new_line('a')
   character(*), parameter :: indent = newline//'      '

contains

   ! ---- what a .pf file calls; `location` comes from the preprocessor ----

   !> actual = expected, or |actual - expected| <= tolerance (by default 0).
   subroutine equal_real(expected, actual, tolerance, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      real(dp), intent(in), optional :: tolerance
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertEqual', '==', expected, actual, message, location, tolerance)
   end subroutine equal_real

   !> |actual - expected| <= tolerance |expected|, with expected /= 0, actual finite and 0 <= tolerance < 1.
   subroutine assertRelativelyEqual(expected, actual, tolerance, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      real(dp), intent(in) :: tolerance
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertRelativelyEqual', '~', expected, actual, message, location, tolerance)
   end subroutine assertRelativelyEqual

   subroutine less_real(expected, actual, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertLessThan', '<', expected, actual, message, location)
   end subroutine less_real

   subroutine less_equal_real(expected, actual, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertLessThanOrEqual', '<=', expected, actual, message, location)
   end subroutine less_equal_real

   subroutine greater_real(expected, actual, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertGreaterThan', '>', expected, actual, message, location)
   end subroutine greater_real

   subroutine greater_equal_real(expected, actual, message, location)
      real(dp), intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_reals('assertGreaterThanOrEqual', '>=', expected, actual, message, location)
   end subroutine greater_equal_real

   subroutine equal_integer(expected, actual, message, location)
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_integers('assertEqual', '==', expected, actual, message, location)
   end subroutine equal_integer

   subroutine less_integer(expected, actual, message, location)
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_integers('assertLessThan', '<', expected, actual, message, location)
   end subroutine less_integer

   subroutine less_equal_integer(expected, actual, message, location)
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_integers('assertLessThanOrEqual', '<=', expected, actual, message, location)
   end subroutine less_equal_integer

   subroutine greater_integer(expected, actual, message, location)
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_integers('assertGreaterThan', '>', expected, actual, message, location)
   end subroutine greater_integer

   subroutine greater_equal_integer(expected, actual, message, location)
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_integers('assertGreaterThanOrEqual', '>=', expected, actual, message, location)
   end subroutine greater_equal_integer

   subroutine equal_logical(expected, actual, message, location)
      logical, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_logicals('assertEqual', expected, actual, message, location)
   end subroutine equal_logical

   !> Same length and same characters: trailing blanks count, unlike in Fortran's `==`.
   subroutine equal_string(expected, actual, message, location)
      character(*), intent(in) :: expected, actual
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      integer :: i

      call count_assertion()
      if (len(expected) == len(actual) .and. expected == actual) return
      do i = 1, min(len(expected), len(actual))
         if (expected(i:i) /= actual(i:i)) exit
      end do
      call fail('assertEqual', &
         indent//"expected:   '"//expected//"'"//indent//"actual:     '"//actual//"'"//indent// &
         'difference: from character '//integer_text(i)//' on; lengths '// &
         integer_text(len(expected))//' and '//integer_text(len(actual)), message, location)
   end subroutine equal_string

   subroutine true_scalar(condition, message, location)
      logical, intent(in) :: condition
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_logicals('assertTrue', .true., condition, message, location)
   end subroutine true_scalar

   subroutine true_vector(condition, message, location)
      logical, intent(in) :: condition(:)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_logicals('assertTrue', .true., condition, message, location)
   end subroutine true_vector

   subroutine false_scalar(condition, message, location)
      logical, intent(in) :: condition
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_logicals('assertFalse', .false., condition, message, location)
   end subroutine false_scalar

   subroutine false_vector(condition, message, location)
      logical, intent(in) :: condition(:)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call check_logicals('assertFalse', .false., condition, message, location)
   end subroutine false_vector

   subroutine assertIsFinite(x, message, location)
      real(dp), intent(in) :: x
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      if (ieee_is_finite(x)) return
      call fail('assertIsFinite', indent//'actual:     '//real_text(x), message, location)
   end subroutine assertIsFinite

   subroutine assertIsNaN(x, message, location)
      real(dp), intent(in) :: x
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      if (ieee_is_nan(x)) return
      call fail('assertIsNaN', indent//'actual:     '//real_text(x), message, location)
   end subroutine assertIsNaN

   subroutine assertFail(message, location)
      character(*), intent(in) :: message
      type(SourceLocation), intent(in) :: location

      call count_assertion()
      call fail('assertFail', '', message, location)
   end subroutine assertFail

   ! ---- one checker a type ----

   subroutine check_reals(assertion, relation, expected, actual, message, location, tolerance)
      character(*), intent(in) :: assertion, relation  !! relation: == ~ < <= > >=
      real(dp), intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location
      real(dp), intent(in), optional :: tolerance

      real(dp) :: allowed
      real(dp), allocatable :: e(:), a(:)
      character(:), allocatable :: difference
      integer :: first
      logical :: conform

      call count_assertion()
      allowed = 0.0_dp
      if (present(tolerance)) allowed = tolerance
      if (.not. tolerance_is_sound(allowed, relation)) then
         call fail(assertion, indent//'the tolerance makes no sense: '//real_text(allowed), message, location)
         return
      end if

      call require_conformable(assertion, shape_of(expected), shape_of(actual), message, location, conform)
      if (.not. conform) return
      allocate (a, source=flat_reals(actual))
      allocate (e, source=flat_reals(expected))
      if (rank(expected) == 0) e = spread(e(1), 1, size(a))
      first = findloc(holds_reals(relation, e, a, allowed), .false., dim=1)
      if (first == 0) return

      difference = 'none: one of them is NaN'
      if (.not. (ieee_is_nan(a(first)) .or. ieee_is_nan(e(first)))) then
         difference = real_text(signed_difference(a(first), e(first)))
      end if
      if (present(tolerance)) difference = difference//' (tolerance '//real_text(tolerance)//')'
      call fail_elements(assertion, relation, real_text(e(first)), real_text(a(first)), difference, first, &
         count(.not. holds_reals(relation, e, a, allowed)), shape_of(actual), message, location)
   end subroutine check_reals

   subroutine check_integers(assertion, relation, expected, actual, message, location)
      character(*), intent(in) :: assertion, relation
      integer, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      integer, allocatable :: e(:), a(:)
      integer :: first
      logical :: conform

      call count_assertion()
      call require_conformable(assertion, shape_of(expected), shape_of(actual), message, location, conform)
      if (.not. conform) return
      allocate (a, source=flat_integers(actual))
      allocate (e, source=flat_integers(expected))
      if (rank(expected) == 0) e = spread(e(1), 1, size(a))
      first = findloc(holds_integers(relation, e, a), .false., dim=1)
      if (first == 0) return
      ! In reals, which hold every difference of default integers exactly.
      call fail_elements(assertion, relation, integer_text(e(first)), integer_text(a(first)), &
         whole_text(real(a(first), dp) - real(e(first), dp)), first, &
         count(.not. holds_integers(relation, e, a)), shape_of(actual), message, location)
   end subroutine check_integers

   subroutine check_logicals(assertion, expected, actual, message, location)
      character(*), intent(in) :: assertion
      logical, intent(in) :: expected(..), actual(..)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      logical, allocatable :: e(:), a(:)
      integer :: first
      logical :: conform

      call count_assertion()
      call require_conformable(assertion, shape_of(expected), shape_of(actual), message, location, conform)
      if (.not. conform) return
      allocate (a, source=flat_logicals(actual))
      allocate (e, source=flat_logicals(expected))
      if (rank(expected) == 0) e = spread(e(1), 1, size(a))
      first = findloc(e .eqv. a, .false., dim=1)
      if (first == 0) return
      call fail_elements(assertion, '==', merge('.true. ', '.false.', e(first)), &
         merge('.true. ', '.false.', a(first)), '', first, count(e .neqv. a), &
         shape_of(actual), message, location)
   end subroutine check_logicals

   ! ---- comparing ----

   !> No relation holds for NaN.
   elemental logical function holds_reals(relation, expected, actual, tolerance) result(holds)
      character(*), intent(in) :: relation
      real(dp), intent(in) :: expected, actual, tolerance

      logical :: equal

      holds = .false.
      if (ieee_is_nan(expected) .or. ieee_is_nan(actual)) return
      equal = actual <= expected .and. actual >= expected
      select case (relation)
      case ('==')
         holds = equal
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
   end function holds_reals

   elemental logical function holds_integers(relation, expected, actual) result(holds)
      character(*), intent(in) :: relation
      integer, intent(in) :: expected, actual

      holds = .false.
      select case (relation)
      case ('==')
         holds = expected == actual
      case ('<')
         holds = expected < actual
      case ('<=')
         holds = expected <= actual
      case ('>')
         holds = expected > actual
      case ('>=')
         holds = expected >= actual
      end select
   end function holds_integers

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

   !> Fails unless the shapes agree, or the expected value is a scalar and there is something to compare.
   subroutine require_conformable(assertion, expected_shape, actual_shape, message, location, conform)
      character(*), intent(in) :: assertion
      integer, intent(in) :: expected_shape(:), actual_shape(:)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location
      logical, intent(out) :: conform

      integer, parameter :: highest_rank = 2
      integer :: expected(size(expected_shape)), actual(size(actual_shape))

      ! gfortran 12 gives an empty array of assumed rank the extent -1.
      expected = max(expected_shape, 0)
      actual = max(actual_shape, 0)

      conform = size(actual) <= highest_rank
      if (size(expected) == 0) then
         conform = conform .and. product(actual) > 0
      else
         conform = conform .and. size(expected) == size(actual)
         if (conform) conform = all(expected == actual)
      end if
      if (.not. conform) then
         call fail(assertion, indent//'expected:   shape '//list_text(expected)// &
            indent//'actual:     shape '//list_text(actual)//', which cannot be compared', message, location)
      end if
   end subroutine require_conformable

   !> The shape. gfortran 11 writes beyond the result of `shape` for a scalar of assumed rank.
   function shape_of(x) result(extents)
      type(*), intent(in) :: x(..)
      integer, allocatable :: extents(:)

      integer :: i

      allocate (extents(rank(x)))
      do i = 1, size(extents)
         extents(i) = size(x, i)
      end do
   end function shape_of

   function flat_reals(x) result(flat)
      real(dp), intent(in) :: x(..)
      real(dp), allocatable :: flat(:)

      select rank (x)
      rank (0)
         flat = [x]
      rank (1)
         flat = x
      rank (2)
         flat = reshape(x, [size(x)])
      end select
   end function flat_reals

   function flat_integers(x) result(flat)
      integer, intent(in) :: x(..)
      integer, allocatable :: flat(:)

      select rank (x)
      rank (0)
         flat = [x]
      rank (1)
         flat = x
      rank (2)
         flat = reshape(x, [size(x)])
      end select
   end function flat_integers

   function flat_logicals(x) result(flat)
      logical, intent(in) :: x(..)
      logical, allocatable :: flat(:)

      select rank (x)
      rank (0)
         flat = [x]
      rank (1)
         flat = x
      rank (2)
         flat = reshape(x, [size(x)])
      end select
   end function flat_logicals

   ! ---- reporting ----

   subroutine fail(assertion, details, message, location)
      character(*), intent(in) :: assertion
      character(*), intent(in) :: details  !! lines, each begun by `indent`
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      character(:), allocatable :: heading

      heading = assertion
      if (present(message)) heading = heading//': '//message
      call throw(heading//details, location)
   end subroutine fail

   subroutine fail_elements(assertion, relation, expected, actual, difference, first, failures, &
         actual_shape, message, location)
      character(*), intent(in) :: assertion, relation
      character(*), intent(in) :: expected, actual  !! of the first failing element
      character(*), intent(in) :: difference        !! likewise; may be empty
      integer, intent(in) :: first       !! its place in array element order
      integer, intent(in) :: failures    !! how many elements fail
      integer, intent(in) :: actual_shape(:)
      character(*), intent(in), optional :: message
      type(SourceLocation), intent(in) :: location

      character(:), allocatable :: details

      if (scan(relation, '<>') > 0) then
         details = indent//'required:   '//trim(expected)//' '//relation//' '//trim(actual)
      else
         details = indent//'expected:   '//trim(expected)//indent//'actual:     '//trim(actual)
      end if
      if (difference /= '') details = details//indent//'difference: '//difference
      if (size(actual_shape) == 1) then
         details = details//indent//'element:    '//list_text([first])
      else if (size(actual_shape) == 2) then
         details = details//indent//'element:    '// &
            list_text([1 + modulo(first - 1, actual_shape(1)), 1 + (first - 1)/actual_shape(1)])
      end if
      if (size(actual_shape) > 0) then
         details = details//', the first of '//integer_text(failures)//' that fail, out of '// &
            integer_text(product(actual_shape))
      end if
      call fail(assertion, details, message, location)
   end subroutine fail_elements

   !> Every digit that a double has.
   pure function real_text(x) result(text)
      real(dp), intent(in) :: x
      character(:), allocatable :: text

      character(32) :: buffer

      write (buffer, '(es24.16e3)') x
      text = trim(adjustl(buffer))
   end function real_text

   pure function whole_text(x) result(text)
      real(dp), intent(in) :: x  !! a whole number
      character(:), allocatable :: text

      character(32) :: buffer

      write (buffer, '(f24.0)') x
      text = trim(adjustl(buffer))
      text = text(:len(text) - 1)
   end function whole_text

   pure function integer_text(i) result(text)
      integer, intent(in) :: i
      character(:), allocatable :: text

      character(32) :: buffer

      write (buffer, '(i0)') i
      text = trim(buffer)
   end function integer_text

   pure function list_text(list) result(text)
      integer, intent(in) :: list(:)
      character(:), allocatable :: text

      integer :: i

      text = '('
      do i = 1, size(list)
         if (i > 1) text = text//', '
         text = text//integer_text(list(i))
      end do
      text = text//')'
   end function list_text

end module funit_assert
