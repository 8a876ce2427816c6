!> A text that grows at its end in constant time a byte.
module wavycon_text_buffer
   use wavycon_plain_text, only: newline
   implicit none (type, external)
   private

   public :: text_buffer_type

   type :: text_buffer_type
      private
      character(:), allocatable :: room
      integer :: used = 0
   contains
      procedure :: add
      procedure :: add_line
      procedure :: text
   end type text_buffer_type

contains

   pure subroutine add(self, piece)
      class(text_buffer_type), intent(inout) :: self
      character(*), intent(in) :: piece

      character(:), allocatable :: larger

      if (.not. allocated(self%room)) allocate (character(max(256, len(piece))) :: self%room)
      if (self%used + len(piece) > len(self%room)) then
         allocate (character(2*(self%used + len(piece))) :: larger)
         larger(:self%used) = self%room(:self%used)
         call move_alloc(larger, self%room)
      end if
      self%room(self%used + 1:self%used + len(piece)) = piece
      self%used = self%used + len(piece)
   end subroutine add

   !> Adds a piece and a newline.
   pure subroutine add_line(self, piece)
      class(text_buffer_type), intent(inout) :: self
      character(*), intent(in) :: piece

      call self%add(piece)
      call self%add(newline)
   end subroutine add_line

   !> All that was added.
   pure function text(self)
      class(text_buffer_type), intent(in) :: self
      character(:), allocatable :: text

      text = ''
      if (allocated(self%room)) text = self%room(:self%used)
   end function text

end module wavycon_text_buffer
