!> A suite without tests, beside one with a test that passes: the program must fail.
program empty_suite
   use funit, only: TestSuite
   use funit_runner, only: begin_tests, end_tests, run_suite
   implicit none (type, external)

   interface
      type(TestSuite) function test_passes_suite()
         import :: TestSuite
      end function test_passes_suite
   end interface

   type(TestSuite) :: empty

   empty%name = 'empty_suite'
   call begin_tests()
   call run_suite(empty)
   call run_suite(test_passes_suite())
   call end_tests()
end program empty_suite
