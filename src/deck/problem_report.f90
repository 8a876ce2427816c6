!> The report of all problems in a deck, as the message of one error.
module wavycon_problem_report
   use wavycon_deck_text, only: deck_text_type
   use wavycon_plain_text, only: character_count, escaped, integer_text, is_continuation, newline
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: problem_report

   !> Most problems in a report. The remaining ones are only counted.
   integer, parameter, public :: most_printed = 50

contains

   !> All the problems in the order of their places, numbered, each with its line and a caret.
   pure function problem_report(problems, text) result(report)
      type(problem_list_type), intent(in) :: problems  !! at least one
      type(deck_text_type), intent(in) :: text
      character(:), allocatable :: report  !! lines, the last without a newline

      character(:), allocatable :: total
      integer :: i, left, order(problems%number)

      order = in_order(problems)
      total = at_least(problems)//integer_text(problems%number)
      report = ''
      do i = 1, min(problems%number, most_printed)
         associate (problem => problems%items(order(i)))
            if (i > 1) report = report//newline
            report = report//escaped(text%path)//':'
            if (problem%place > 0) report = report//position(text, problem%place)
            report = report//' error '//integer_text(i)//' of '//total//': '//problem%words
            if (problem%place == 0) cycle
            if (.not. text%is_in_option(problem%place)) report = report//newline//line_and_caret(text, problem%place)
         end associate
      end do
      left = problems%number - most_printed
      if (left > 0) report = report//newline//'and '//at_least(problems)//integer_text(left)//' more'
   end function problem_report

   !> 'at least ' if the list is full: there may be more problems than it holds.
   pure function at_least(problems) result(words)
      type(problem_list_type), intent(in) :: problems
      character(:), allocatable :: words

      words = ''
      if (problems%is_full()) words = 'at least '
   end function at_least

   !> The indices of the problems sorted by place; problems at the same place keep their order.
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

   !> "line:column:", the column counted in characters; of an option " option:".
   pure function position(text, place) result(words)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: place
      character(:), allocatable :: words

      integer :: line

      if (text%is_in_option(place)) then
         words = ' '//escaped(text%option_at(place))//':'
         return
      end if
      line = text%line_of(place)
      words = integer_text(line)//':'// &
         integer_text(character_count(text%content(text%line_start(line):place - 1)) + 1)//':'
   end function position

   !> The line with a caret below the place. A long line is cut around the place.
   pure function line_and_caret(text, place) result(words)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: place
      character(:), allocatable :: words

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
      words = number//' | '//trim(before//after)//newline// &
         repeat(' ', len(number))//' | '//repeat(' ', character_count(before))//'^'
   end function line_and_caret

end module wavycon_problem_report
