!> A program that runs no test at all: it must fail.
program no_suite
   use funit_runner, only: begin_tests, end_tests
   implicit none (type, external)

   call begin_tests()
   call end_tests()
end program no_suite
