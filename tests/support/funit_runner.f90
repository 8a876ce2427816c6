!> Runs the tests of an executable and reports them.
module funit_runner
   use, intrinsic :: iso_fortran_env, only: output_unit
   use early_exit, only: allow_exit, refuse_early_exit
   use funit_exception, only: SourceLocation, anyExceptions, exception, take_assertion_count, &
      take_exceptions, throw
   implicit none (type, external)
   private

   public :: TestSuite, begin_tests, run_suite, end_tests

   abstract interface
      subroutine test_procedure()
      end subroutine test_procedure
   end interface

   interface
      subroutine c_exit(status) bind(c, name='exit')
         use, intrinsic :: iso_c_binding, only: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   type :: test_case
      character(:), allocatable :: name
      procedure(test_procedure), pointer, nopass :: body => null()
      procedure(test_procedure), pointer, nopass :: set_up => null()     !! or null
      procedure(test_procedure), pointer, nopass :: tear_down => null()  !! or null
   end type test_case

   !> The tests of one .pf file, whose preprocessor writes `suite = TestSuite(name)` and the calls of `add`.
   type :: TestSuite
      character(:), allocatable :: name
      type(test_case), allocatable :: tests(:)
   contains
      procedure :: add
   end type TestSuite

   integer :: tests_run = 0, tests_failed = 0, empty_suites = 0

contains

   subroutine add(self, name, body, set_up, tear_down)
      class(TestSuite), intent(inout) :: self
      character(*), intent(in) :: name
      procedure(test_procedure) :: body
      procedure(test_procedure), optional :: set_up, tear_down

      type(test_case) :: new

      new%name = name
      new%body => body
      if (present(set_up)) new%set_up => set_up
      if (present(tear_down)) new%tear_down => tear_down
      if (.not. allocated(self%tests)) allocate (self%tests(0))
      self%tests = [self%tests, new]
   end subroutine add

   !> To be called first.
   subroutine begin_tests()
      call refuse_early_exit()
   end subroutine begin_tests

   !> Runs every test of a suite; a suite without tests counts as a failure.
   subroutine run_suite(suite)
      type(TestSuite), intent(in) :: suite

      integer :: i

      if (.not. allocated(suite%tests)) then
         empty_suites = empty_suites + 1
         write (output_unit, '(a)') suite%name//': FAILED, it has no tests'
         return
      end if
      do i = 1, size(suite%tests)
         call run_test(suite%name//'.'//suite%tests(i)%name, suite%tests(i))
      end do
   end subroutine run_suite

   !> To be called last: ends the program with status 1 unless there was a test and none failed.
   subroutine end_tests()
      call allow_exit()
      if (tests_run == 0) then
         write (output_unit, '(a)') 'FAILED: no test was run'
      else if (tests_failed > 0 .or. empty_suites > 0) then
         write (output_unit, '(a, i0, a, i0, a, i0, a)') 'FAILED: ', tests_failed, ' of ', tests_run, &
            ' tests failed, ', empty_suites, ' suites without tests'
      else
         write (output_unit, '(a, i0, a)') 'OK: ', tests_run, ' tests passed'
         return
      end if
      flush (output_unit)
      ! `stop` would add a line, and gfortran 11 has no `stop 1, quiet=.true.`.
      call c_exit(1)
   end subroutine end_tests

   !> If the set-up fails neither body nor tear-down runs; if the body fails the tear-down still runs.
   subroutine run_test(full_name, test)
      character(*), intent(in) :: full_name
      type(test_case), intent(in) :: test

      type(exception), allocatable :: failures(:)
      integer :: i, assertions

      ! The name comes out first: should the test crash, it is the last line.
      write (output_unit, '(a)', advance='no') full_name//': '
      flush (output_unit)

      if (associated(test%set_up)) call test%set_up()
      if (.not. anyExceptions()) then
         call take_assertion_count(assertions)
         call test%body()
         call take_assertion_count(assertions)
         if (assertions == 0) call throw('the test made no assertion', SourceLocation(full_name, 0))
         if (associated(test%tear_down)) call test%tear_down()
      end if

      call take_exceptions(failures)
      tests_run = tests_run + 1
      if (size(failures) == 0) then
         write (output_unit, '(a)') 'ok'
         return
      end if
      tests_failed = tests_failed + 1
      write (output_unit, '(a)') 'FAILED'
      do i = 1, size(failures)
         if (failures(i)%location%line > 0) then
            write (output_unit, '(3x, a, a, i0, a, a)') failures(i)%location%file, ':', &
               failures(i)%location%line, ': ', failures(i)%text
         else
            write (output_unit, '(3x, a, a, a)') failures(i)%location%file, ': ', failures(i)%text
         end if
      end do
   end subroutine run_test

end module funit_runner
