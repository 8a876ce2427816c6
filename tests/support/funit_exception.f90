!> What the assertions of the running test have found wrong, and where.
module funit_exception
   implicit none (type, external)
   private

   public :: SourceLocation, exception
   public :: throw, anyExceptions, take_exceptions
   public :: count_assertion, take_assertion_count

   !> Where an assertion stands: the .pf file and the line in it.
   type :: SourceLocation
      character(:), allocatable :: file
      integer :: line = 0
   end type SourceLocation

   !> One failed assertion.
   type :: exception
      type(SourceLocation) :: location
      character(:), allocatable :: text  !! may hold several lines
   end type exception

   type(exception), allocatable :: pending(:)
   integer :: assertion_count = 0

contains

   !> Adds a failure to those of the running test.
   subroutine throw(text, location)
      character(*), intent(in) :: text
      type(SourceLocation), intent(in) :: location

      type(exception) :: new

      new%location = location
      new%text = text
      if (.not. allocated(pending)) allocate (pending(0))
      pending = [pending, new]
   end subroutine throw

   !> Whether the running test has failed already.
   logical function anyExceptions()
      anyExceptions = .false.
      if (allocated(pending)) anyExceptions = size(pending) > 0
   end function anyExceptions

   !> Hands over the failures and forgets them.
   subroutine take_exceptions(taken)
      type(exception), allocatable, intent(out) :: taken(:)

      call move_alloc(pending, taken)
      if (.not. allocated(taken)) allocate (taken(0))
   end subroutine take_exceptions

   !> Every assertion calls this, whatever its outcome.
   subroutine count_assertion()
      assertion_count = assertion_count + 1
   end subroutine count_assertion

   !> Hands over the number of assertions since the last call.
   subroutine take_assertion_count(taken)
      integer, intent(out) :: taken

      taken = assertion_count
      assertion_count = 0
   end subroutine take_assertion_count

end module funit_exception
