!> The problems found in a deck, kept until all are known and then reported at once.
module wavycon_problems
   use wavycon_deck_text, only: deck_text_type
   use wavycon_plain_text, only: character_count, escaped, integer_text, is_continuation
   use wavycon_text_buffer, only: text_buffer_type
   implicit none (type, external)
   private

   public :: problem_list_type, problem_report

   !> Whoever sees this many goes back to the deck anyway.
   integer, parameter, public :: most_printed = 50
   !> Enough of them to stop looking for more: bounds time and memory on a file that is no deck at all.
   integer, parameter, public :: most_kept = 1000

   type :: problem_type
      integer :: place = 0  !! in the deck's text; 0 means the deck as a whole
      character(:), allocatable :: words
   end type problem_type

   type :: problem_list_type
      integer :: number = 0
      type(problem_type), allocatable, private :: items(:)
   contains
      procedure :: add
      procedure :: is_full
   end type problem_list_type

contains

   !> Adds a problem, unless the list is full.
   pure subroutine add(self, place, words)
      class(problem_list_type), intent(inout) :: self
      integer, intent(in) :: place       !! where in the deck's text; 0 means the deck as a whole
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

   !> All the problems in the order of their places, numbered, each with its line and a caret.
   pure function problem_report(problems, text) result(report)
      type(problem_list_type), intent(in) :: problems  !! at least one
      type(deck_text_type), intent(in) :: text
      character(:), allocatable :: report  !! lines, the last without a newline

      type(text_buffer_type) :: buffer
      character(:), allocatable :: total
      integer :: i, left, order(problems%number)

      order = in_order(problems)
      total = integer_text(problems%number)
      if (problems%is_full()) total = 'at least '//total
      do i = 1, min(problems%number, most_printed)
         associate (problem => problems%items(order(i)))
            if (i > 1) call buffer%add_line('')
            call buffer%add(escaped(text%path)//':')
            if (problem%place > 0) call buffer%add(position(text, problem%place))
            call buffer%add(' error '//integer_text(i)//' of '//total//': '//problem%words)
            if (problem%place > 0) call add_line_and_caret(buffer, text, problem%place)
         end associate
      end do
      left = problems%number - most_printed
      if (left > 0) then
         call buffer%add_line('')
         call buffer%add('and ')
         if (problems%is_full()) call buffer%add('at least ')
         call buffer%add(integer_text(left)//' more')
      end if
      report = buffer%text()
   end function problem_report

   !> Numbers that sort the problems by place; those of equal places stay in their order.
   pure function in_order(problems) result(order)
      type(problem_list_type), intent(in) :: problems
      integer :: order(problems%number)

      integer :: i, j

      do i = 1, problems%number
         j = i
         do while (j > 1)
            if (problems%items(order(j - 1))%place <= problems%items(i)%place) exit
            order(j) = order(j - 1)
            j = j - 1
         end do
         order(j) = i
      end do
   end function in_order

   !> "line:column:", the column counted in characters.
   pure function position(text, place) result(words)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: place
      character(:), allocatable :: words

      integer :: line

      line = text%line_of(place)
      words = integer_text(line)//':'// &
         integer_text(character_count(text%content(text%line_start(line):place - 1)) + 1)//':'
   end function position

   !> The line with a caret below the place. Of a long line only the neighbourhood of the place is shown.
   pure subroutine add_line_and_caret(buffer, text, place)
      type(text_buffer_type), intent(inout) :: buffer
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: place

      integer, parameter :: longest_line = 100, most_before = 60, most_after = 40, narrowest_number = 4
      character(:), allocatable :: after, before, number
      integer :: first, from, last, line, to

      line = text%line_of(place)
      call text%line_bounds(line, first, last)
      from = first
      to = last
      if (last - first >= longest_line) then
         from = max(first, place - most_before)
         to = min(last, place + most_after)
      end if
      do while (from < place)
         if (.not. is_continuation(text%content(from:from))) exit
         from = from + 1
      end do
      do while (to > place .and. to < last)
         if (.not. is_continuation(text%content(to + 1:to + 1))) exit
         to = to - 1
      end do
      before = escaped(text%content(from:place - 1))
      if (from > first) before = '...'//before
      after = escaped(text%content(place:to))
      if (to < last) after = after//'...'

      number = integer_text(line)
      number = repeat(' ', max(0, narrowest_number - len(number)))//number
      call buffer%add_line('')
      call buffer%add_line(number//' | '//trim(before//after))
      call buffer%add(repeat(' ', len(number))//' | '//repeat(' ', character_count(before))//'^')
   end subroutine add_line_and_caret

end module wavycon_problems
