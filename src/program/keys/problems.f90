!> The problems found in a deck, collected so that all are reported at once.
module wavycon_problems
   implicit none (type, external)
   private

   public :: problem_type, problem_list_type

   !> Most problems that are kept. When the list is full the search for further problems ends, which bounds time and
   !> memory.
   integer, parameter, public :: most_kept = 50

   type :: problem_type
      integer :: position = 0               !! position in the deck's text, a byte from 1; 0 means the deck as a whole
      character(:), allocatable :: words    !! what is wrong, what was expected
   end type problem_type

   type :: problem_list_type
      integer :: number = 0                   !! number of all problems, also of those that are not kept
      type(problem_type) :: items(most_kept)  !! the first ones found, in the order of their positions
   contains
      procedure :: add, join, is_full
   end type problem_list_type

contains

   !> Adds a problem in the order of positions, behind earlier problems of the same position.
   pure subroutine add(self, position, words)
      class(problem_list_type), intent(inout) :: self
      integer, intent(in) :: position    !! position in the deck's text, a byte from 1; 0 means the deck as a whole
      character(*), intent(in) :: words  !! what is wrong, what was expected

      integer :: i

      self%number = self%number + 1
      if (self%number > most_kept) return
      do i = self%number, 2, -1
         if (self%items(i - 1)%position <= position) exit
         self%items(i) = self%items(i - 1)
      end do
      self%items(i)%position = position
      self%items(i)%words = words
   end subroutine add

   !> Adds the problems of another list; those that the other list has not kept are counted.
   pure subroutine join(self, other)
      class(problem_list_type), intent(inout) :: self
      type(problem_list_type), intent(in) :: other

      integer :: i

      do i = 1, min(other%number, most_kept)
         call self%add(other%items(i)%position, other%items(i)%words)
      end do
      self%number = self%number + max(0, other%number - most_kept)
   end subroutine join

   !> Whether the list is full.
   pure logical function is_full(self)
      class(problem_list_type), intent(in) :: self

      is_full = self%number >= most_kept
   end function is_full

end module wavycon_problems
