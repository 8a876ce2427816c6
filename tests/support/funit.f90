!> What a .pf file sees after `use funit` where the real pFUnit is absent.
module funit
   use funit_assert, only: funit_check
   use funit_runner, only: SourceLocation, anyExceptions
   implicit none (type, external)
   public
end module funit
