!> What a .pf file sees after `use funit` where the real pFUnit is absent.
module funit
   use funit_assert, only: funit_check, funit_fail
   use funit_exception, only: SourceLocation, anyExceptions
   use funit_runner, only: TestSuite
   implicit none (type, external)
   public
end module funit
