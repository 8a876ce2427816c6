!> Arguments of the command line.
module command_words
   implicit none (type, external)
   private

   public :: number, word

contains

   function word(i)
      integer, intent(in) :: i
      character(:), allocatable :: word

      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(length) :: word)
      call get_command_argument(i, word)
   end function word

   integer function number(i)
      integer, intent(in) :: i

      character(:), allocatable :: text

      text = word(i)
      read (text, *) number
   end function number

end module command_words
