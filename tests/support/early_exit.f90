!> What test programs do before the first test and after the last one, see early_exit.c.
!> N.B. pFUnit's driver points to these procedures with `procedure(), pointer`, which gfortran 12 refuses for bind(c).
module early_exit
   implicit none (type, external)
   private

   public :: allow_exit, refuse_early_exit

   interface
      subroutine c_refuse_early_exit() bind(c, name='refuse_early_exit')
      end subroutine c_refuse_early_exit

      subroutine c_allow_exit() bind(c, name='allow_exit')
      end subroutine c_allow_exit
   end interface

contains

   !> To be called before the first test.
   subroutine refuse_early_exit()
      call c_refuse_early_exit()
   end subroutine refuse_early_exit

   !> To be called after the last test.
   subroutine allow_exit()
      call c_allow_exit()
   end subroutine allow_exit

end module early_exit
