!> Checks against programming errors: a Debug build stops, any other build continues.
module wavycon_assertion
   implicit none (type, external)
   private

   public :: assert

   !> Whether `assert` stops the program: in Debug builds alone.
#ifdef WAVYCON_DEBUG
   logical, parameter, public :: assertions_stop = .true.
#else
   logical, parameter, public :: assertions_stop = .false.
#endif

contains

   !> Stops a Debug build unless the condition holds.
   pure subroutine assert(condition, words)
      logical, intent(in) :: condition
      character(*), intent(in) :: words   !! the condition in words

      if (assertions_stop .and. .not. condition) error stop 'programming error: '//words
   end subroutine assert

end module wavycon_assertion
