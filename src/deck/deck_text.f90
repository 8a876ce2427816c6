!> The text of a deck file, the line of each of its bytes, and the report of problems in it. Options of the command line
!> that set keys of the deck stand behind it, each as a line, so that problems with them have a place too.
module wavycon_deck_text
   use wavycon_error, only: error_type
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_plain_text, only: character_count, escaped, integer_text, newline
   use wavycon_problems, only: most_kept, problem_list_type
   use wavycon_ranks, only: is_first_rank, share_error, share_text
   implicit none (type, external)
   private

   public :: deck_text_type, problem_report, read_deck_text

   !> A place is the number of a byte of the text, counted from 1.
   type :: deck_text_type
      character(:), allocatable :: path        !! as the user named the file
      character(:), allocatable :: content     !! lines that end in LF, CR LF or CR, and a line for each option
      integer :: own = 0                       !! place of the last byte of the file; options are behind it
   contains
      procedure :: line_of
      procedure :: line_bounds
   end type deck_text_type

   interface deck_text_type
      module procedure new_deck_text
   end interface deck_text_type

   character(*), parameter :: carriage_return = achar(13)

   !> Most bytes of a deck. The longest list of loads takes a tenth of this.
   integer, parameter :: largest = 64*1024*1024

contains

   !> A text from memory. A byte order mark is left out.
   pure type(deck_text_type) function new_deck_text(path, content) result(text)
      character(*), intent(in) :: path, content

      text%path = path
      text%content = content
      if (index(content, byte_order_mark) == 1) text%content = content(len(byte_order_mark) + 1:)
      text%own = len(text%content)
   end function new_deck_text

   !> The number of the line that a place is in.
   pure integer function line_of(self, place)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: place  !! >= 1

      integer :: i

      line_of = 1
      do i = 1, place - 1
         if (self%content(i:i) == newline) then
            line_of = line_of + 1
         else if (self%content(i:i) == carriage_return) then
            if (self%content(i + 1:i + 1) /= newline) line_of = line_of + 1
         end if
      end do
   end function line_of

   !> First and last place, without its line end, of the line that a place is in.
   pure subroutine line_bounds(self, place, first, last)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: place   !! not of a line end
      integer, intent(out) :: first, last

      first = scan(self%content(:place - 1), newline//carriage_return, back=.true.) + 1
      last = scan(self%content(place:), newline//carriage_return) + place - 2
      if (last < place) last = len(self%content)
   end subroutine line_bounds

   !> Reads the text of a deck file. Errors: exit_file_trouble.
   subroutine read_deck_text(path, text, error)
      character(*), intent(in) :: path
      type(deck_text_type), intent(out) :: text
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content

      if (is_first_rank()) call read_file(path, largest, content, error)
      call share_error(error)
      if (allocated(error)) return
      if (.not. allocated(content)) content = ''
      call share_text(0, content)
      text = deck_text_type(path, content)
   end subroutine read_deck_text

   !> The report of all problems in a deck, as the message of one error: in the order of their places, numbered, each
   !> with its line and a caret.
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
               cycle
            end if
            call text%line_bounds(place, first, last)
            if (place > text%own) then
               report = report//' '//escaped(text%content(first:last))//':'//words
            else
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

      integer, parameter :: longest_line = 100, most_before = 60, most_after = 40, narrowest_number = 4
      character(:), allocatable :: after, before, number
      integer :: from, to

      from = first
      to = last
      if (last - first >= longest_line) then
         from = max(first, place - most_before)
         to = min(last, place + most_after)
      end if
      before = escaped(text%content(from:place - 1))
      if (from > first) before = '...'//before
      after = escaped(text%content(place:to))
      if (to < last) after = after//'...'
      number = integer_text(text%line_of(place))
      number = repeat(' ', max(0, narrowest_number - len(number)))//number
      words = number//' | '//trim(before//after)//newline// &
              repeat(' ', len(number))//' | '//repeat(' ', character_count(before))//'^'
   end function line_and_caret

end module wavycon_deck_text
