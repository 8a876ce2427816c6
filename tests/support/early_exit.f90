!> Makes a test that stops the program a failure: the program then ends with status 1, whatever the test's own was.
module early_exit
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int
   use, intrinsic :: iso_fortran_env, only: output_unit
   implicit none (type, external)
   private

   public :: refuse_early_exit, allow_exit

   interface
      integer(c_int) function c_atexit(handler) bind(c, name='atexit')
         import :: c_funptr, c_int
         type(c_funptr), value :: handler
      end function c_atexit

      subroutine c_exit_at_once(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

   logical :: exit_is_early = .true.

contains

   !> Called before the first test.
   subroutine refuse_early_exit()
      if (c_atexit(c_funloc(at_exit)) /= 0) error stop 'early_exit: atexit failed'
   end subroutine refuse_early_exit

   !> Called after the last test.
   subroutine allow_exit()
      exit_is_early = .false.
   end subroutine allow_exit

   !> Runs when the process ends.
   subroutine at_exit() bind(c)
      if (.not. exit_is_early) return
      write (output_unit, '(/, a)') 'FAILED: a test stopped the program'
      flush (output_unit)
      call c_exit_at_once(1_c_int)
   end subroutine at_exit

end module early_exit
