!> The problems found in a deck, collected so that all are reported at once.
module wavycon_problems
   implicit none (type, external)
   private

   public :: problem_type, problem_list_type

   !> Most problems of a list. When it is full the search for more ends, to bound time and memory.
   integer, parameter, public :: most_kept = 1000

   type :: problem_type
      integer :: place = 0                  !! byte of the deck's text; 0 means the deck as a whole
      character(:), allocatable :: words    !! what is wrong, what was expected
   end type problem_type

   type :: problem_list_type
      integer :: number = 0
      type(problem_type), allocatable :: items(:)   !! only the first `number` are set
   contains
      procedure :: add
      procedure :: is_full
   end type problem_list_type

contains

   !> Adds a problem, unless the list is full.
   pure subroutine add(self, place, words)
      class(problem_list_type), intent(inout) :: self
      integer, intent(in) :: place       !! byte of the deck's text; 0 means the deck as a whole
      character(*), intent(in) :: words  !! what is wrong, what was expected

      if (self%is_full()) return
      if (.not. allocated(self%items)) allocate (self%items(most_kept))
      self%number = self%number + 1
      self%items(self%number)%place = place
      self%items(self%number)%words = words
   end subroutine add

   pure logical function is_full(self)
      class(problem_list_type), intent(in) :: self

      is_full = self%number >= most_kept
   end function is_full

end module wavycon_problems
