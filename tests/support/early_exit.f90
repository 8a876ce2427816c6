!> Interfaces of the functions in early_exit.c.
module early_exit
   implicit none (type, external)
   public

   interface
      subroutine refuse_early_exit() bind(c)
      end subroutine refuse_early_exit

      subroutine allow_exit() bind(c)
      end subroutine allow_exit
   end interface

end module early_exit
