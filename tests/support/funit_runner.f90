!> Runs the tests of a program and reports what their assertions find wrong.
module funit_runner
   use, intrinsic :: iso_fortran_env, only: output_unit
   implicit none (type, external)
   private

   public :: SourceLocation, anyExceptions, count_assertion, end_tests, run_test, throw

   abstract interface
      subroutine test_procedure()
      end subroutine test_procedure
   end interface

   !> Where an assertion stands: the .pf file and the line in it.
   type :: SourceLocation
      character(:), allocatable :: file
      integer :: line = 0
   end type SourceLocation

   integer :: tests_run = 0, tests_failed = 0
   !> Of the running test.
   integer :: assertions = 0, failures = 0

contains

   !> Reports a failure of the running test.
   subroutine throw(text, location)
      character(*), intent(in) :: text  !! may hold several lines
      type(SourceLocation), intent(in) :: location

      if (failures == 0) write (output_unit, '(a)') 'FAILED'
      failures = failures + 1
      write (output_unit, '(3x, a, ":", i0, ": ", a)') location%file, location%line, text
   end subroutine throw

   !> Whether the running test has failed already.
   logical function anyExceptions()
      anyExceptions = failures > 0
   end function anyExceptions

   !> Every assertion calls this, whatever its outcome.
   subroutine count_assertion()
      assertions = assertions + 1
   end subroutine count_assertion

   !> If the set-up fails neither body nor tear-down runs; if the body fails the tear-down still runs.
   subroutine run_test(name, body, set_up, tear_down)
      character(*), intent(in) :: name
      procedure(test_procedure) :: body
      procedure(test_procedure), optional :: set_up, tear_down

      ! The name comes out first: should the test crash, it is the last line.
      write (output_unit, '(a)', advance='no') name//': '
      flush (output_unit)
      failures = 0
      if (present(set_up)) call set_up()
      if (failures == 0) then
         assertions = 0
         call body()
         if (assertions == 0) call throw('the test made no assertion', SourceLocation(name, 0))
         if (present(tear_down)) call tear_down()
      end if
      tests_run = tests_run + 1
      if (failures == 0) then
         write (output_unit, '(a)') 'ok'
      else
         tests_failed = tests_failed + 1
      end if
   end subroutine run_test

   !> To be called last: ends the program with status 1 if a test failed.
   subroutine end_tests()
      if (tests_failed == 0) then
         write (output_unit, '(a, i0, a)') 'OK: ', tests_run, ' tests passed'
         return
      end if
      write (output_unit, '(a, i0, a, i0, a)') 'FAILED: ', tests_failed, ' of ', tests_run, ' tests failed'
      stop 1
   end subroutine end_tests

end module funit_runner
