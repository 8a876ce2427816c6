!> The report of all problems in a deck, as the message of one error.
module wavycon_problem_report
   use wavycon_deck_text, only: deck_text_type
   use wavycon_plain_text, only: character_count, escaped, integer_text, is_continuation, newline
   use wavycon_problems, only: most_kept, problem_list_type
   implicit none (type, external)
   private

   public :: problem_report

contains

   !> The problems in the order of their places, numbered, each with its line and a caret.
   pure function problem_report(problems, text) result(report)
      type(problem_list_type), intent(in) :: problems  !! at least one
      type(deck_text_type), intent(in) :: text
      character(:), allocatable :: report  !! lines, the last without a newline

      character(:), allocatable :: total, words
      integer :: first, i, last

      total = integer_text(problems%number)
      if (problems%is_full()) total = 'at least '//total
      report = ''
      do i = 1, min(problems%number, most_kept)
         words = ' error '//integer_text(i)//' of '//total//': '//problems%items(i)%words
         associate (place => problems%items(i)%place)
            if (i > 1) report = report//newline
            report = report//escaped(text%path)//':'
            if (place == 0) then
               report = report//words
            else if (text%is_in_option(place)) then
               report = report//' '//escaped(text%line_at(place))//':'//words
            else
               call text%line_bounds(place, first, last)
               report = report//integer_text(text%line_of(place))//':'// &
                        integer_text(character_count(text%content(first:place - 1)) + 1)//':'//words//newline// &
                        line_and_caret(text, place, first, last)
            end if
         end associate
      end do
      if (problems%number > most_kept) report = report//newline//'and more'
   end function problem_report

   !> The line with a caret below the place. A long line is cut around the place.
   pure function line_and_caret(text, place, first, last) result(words)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: place, first, last   !! in the text: of the problem and of its line
      character(:), allocatable :: words

      integer, parameter :: longest_line = 100, most_before = 60, most_after = 40
      character(4) :: short_number
      character(:), allocatable :: after, before, number
      integer :: from, to

      from = first
      to = last
      if (last - first >= longest_line) then
         from = max(first, place - most_before)
         to = min(last, place + most_after)
      end if
      ! Not within a character.
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
      number = integer_text(text%line_of(place))
      short_number = number
      if (len(number) < len(short_number)) number = adjustr(short_number)
      words = number//' | '//trim(before//after)//newline// &
              repeat(' ', len(number))//' | '//repeat(' ', character_count(before))//'^'
   end function line_and_caret

end module wavycon_problem_report
