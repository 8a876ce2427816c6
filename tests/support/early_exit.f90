!> Makes a test that stops the program a failure: the program then ends with status 1, whatever the test's own was.
!> Gives the program a working folder of its own, so that it may run twice at the same time.
module early_exit
   use, intrinsic :: iso_c_binding, only: c_char, c_funloc, c_funptr, c_int, c_null_char
   use, intrinsic :: iso_fortran_env, only: output_unit
   implicit none (type, external)
   private

   public :: refuse_early_exit, allow_exit

   interface
      integer(c_int) function c_atexit(handler) bind(c, name='atexit')
         import :: c_funptr, c_int
         type(c_funptr), value :: handler
      end function c_atexit

      integer(c_int) function c_getpid() bind(c, name='getpid')
         import :: c_int
      end function c_getpid

      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_mkdir

      integer(c_int) function c_chdir(path) bind(c, name='chdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_chdir

      integer(c_int) function c_rmdir(path) bind(c, name='rmdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_rmdir

      subroutine c_exit_at_once(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

   logical :: exit_is_early = .true.
   !> The working folder, in that of the start; removed at the end if it is empty.
   character(24) :: folder = ''

contains

   !> Called before the first test.
   subroutine refuse_early_exit()
      integer(c_int), parameter :: for_owner = int(o'700', c_int)

      write (folder, '(a, i0, a)') 'scratch_', c_getpid(), c_null_char
      if (c_mkdir(folder, for_owner) /= 0) error stop 'early_exit: the working folder cannot be made'
      if (c_chdir(folder) /= 0) error stop 'early_exit: the working folder cannot be entered'
      if (c_atexit(c_funloc(at_exit)) /= 0) error stop 'early_exit: atexit failed'
   end subroutine refuse_early_exit

   !> Called after the last test.
   subroutine allow_exit()
      exit_is_early = .false.
   end subroutine allow_exit

   !> Runs when the process ends.
   subroutine at_exit() bind(c)
      integer(c_int) :: ignored

      if (c_chdir('..'//c_null_char) == 0) ignored = c_rmdir(folder)
      if (.not. exit_is_early) return
      write (output_unit, '(/, a)') 'FAILED: a test stopped the program'
      flush (output_unit)
      call c_exit_at_once(1_c_int)
   end subroutine at_exit

end module early_exit
