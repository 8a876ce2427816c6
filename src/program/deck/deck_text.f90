!> The text of a deck file: its lines; its tokens, which are words, names of groups and separators; and the report of
!> problems in it. Any sequence of bytes can be split into tokens. Options of the command line that set keys of the deck
!> are added behind the deck's own text, each as a line, so that a problem with an option has a position in the text
!> too.
module wavycon_deck_text
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_error, only: error_type
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_plain_text, only: character_count, escaped, integer_text, lower_case, newline
   use wavycon_problems, only: most_kept, problem_list_type
   use wavycon_ranks, only: is_first_rank, share_error, share_text
   use wavycon_system, only: note_input
   implicit none (type, external)
   private

   public :: deck_text_type, problem_report, read_deck_text
   public :: token_type, has_curly_quote, next_token, starts_entry

   !> The text. A position is the number of a byte in the text, from 1.
   type :: deck_text_type
      character(:), allocatable :: path        !! path of the file as the user gave it
      character(:), allocatable :: content     !! lines that end in LF, CR LF or CR, and a line for each option
      integer :: last_of_deck = 0              !! position of the last byte of the file's text; options are behind it
   contains
      procedure :: line_of, line_bounds
   end type deck_text_type

   interface deck_text_type
      module procedure new_deck_text
   end interface deck_text_type

   !> Kinds of tokens. A group token is '&' and the name; a broken word has a quote that is not closed, or begins with a
   !> curly quote.
   integer, parameter, public :: at_end = 0, is_word = 1, is_broken_word = 2, is_equals = 3, is_comma = 4, &
      is_slash = 5, is_group = 6

   !> A token: the bytes `first` to `last` of the text. At the end of the text, `first` is behind the last byte.
   type :: token_type
      integer :: kind = at_end, first = 1, last = 0
   end type token_type

   character(*), parameter :: carriage_return = achar(13), line_ends = newline//carriage_return
   character(*), parameter :: blanks = ' '//achar(9)//line_ends
   character(*), parameter, public :: quotes = '"'''
   !> The separators, in the order of their kinds is_equals, is_comma, is_slash, is_group: the first follows
   !> is_broken_word.
   character(*), parameter :: separators = '=,/&'
   character(*), parameter :: word_ends = blanks//separators//'!'

   !> Most bytes of a deck. The longest list of loads takes a tenth of this.
   integer, parameter :: most_bytes = 64*1024*1024

contains

   !> The text of a deck in memory. A byte order mark at its start is left out.
   pure type(deck_text_type) function new_deck_text(path, content) result(text)
      character(*), intent(in) :: path, content   !! name of the deck for messages, and its bytes

      text%path = path
      text%content = content
      if (index(content, byte_order_mark) == 1) text%content = content(len(byte_order_mark) + 1:)
      text%last_of_deck = len(text%content)
   end function new_deck_text

   !> The number of the line in which a position is, from 1.
   pure integer function line_of(self, position)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: position  !! >= 1

      integer :: i

      line_of = 1
      do i = 1, position - 1
         ! A line ends at its LF or, if no LF follows, at its CR.
         if (self%content(i:i) == newline .or. (self%content(i:i) == carriage_return .and. &
                                                self%content(i + 1:i + 1) /= newline)) line_of = line_of + 1
      end do
   end function line_of

   !> The first and the last byte of the line in which a position is.
   pure subroutine line_bounds(self, position, first, last)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: position       !! position of a byte that is not CR or LF
      integer, intent(out) :: first, last   !! positions of these bytes; the line end is left out

      first = scan(self%content(:position - 1), line_ends, back=.true.) + 1
      last = end_before(self%content, position, line_ends)
   end subroutine line_bounds

   !> Reads the text of a deck file, or of standard input: the first rank reads it, and all get the text. Errors:
   !> exit_file_trouble.
   subroutine read_deck_text(path, text, error)
      character(*), intent(in) :: path   !! '-' is standard input
      type(deck_text_type), intent(out) :: text
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content, file

      file = path
      if (path == '-') file = '/dev/stdin'
      if (is_first_rank()) call read_file(file, most_bytes, content, error)
      call note_input(file//c_null_char)
      call share_error(error)
      if (allocated(error)) return
      if (.not. allocated(content)) content = ''
      call share_text(0, content)
      text = deck_text_type(path, content)
   end subroutine read_deck_text

   !> The first token from a position on. Blanks, line ends and comments before it are skipped.
   pure type(token_type) function next_token(content, position) result(token)
      character(*), intent(in) :: content
      integer, intent(in) :: position

      integer :: skipped

      token%first = position
      do
         skipped = verify(content(token%first:), blanks) - 1
         if (skipped < 0) then
            token = token_type(at_end, len(content) + 1, len(content))
            return
         end if
         token%first = token%first + skipped
         if (content(token%first:token%first) /= '!') exit
         token%first = end_before(content, token%first, line_ends) + 1
      end do
      token%last = token%first
      token%kind = is_broken_word + index(separators, content(token%first:token%first))
      if (token%kind == is_group) then
         token%last = end_before(content, token%first + 1, word_ends)
         ! Before Fortran 90 '&end' closed a group.
         if (lower_case(content(token%first:token%last)) == '&end') token%kind = is_slash
      else if (token%kind == is_broken_word) then
         call find_word_end(content, token)
      end if
   end function next_token

   !> The position before the first byte that is in a set, searched from `position` on; the last position of the text if
   !> no byte is.
   pure integer function end_before(content, position, set)
      character(*), intent(in) :: content, set   !! the text; the bytes of the set
      integer, intent(in) :: position

      end_before = scan(content(position:), set) + position - 2
      if (end_before < position - 1) end_before = len(content)
   end function end_before

   !> Finds the end of a word: its closing quote, or the byte before the next blank or separator. A word whose quote is
   !> not closed on its line is broken. A word that begins with a curly quote is broken too and ends with its line.
   pure subroutine find_word_end(content, token)
      character(*), intent(in) :: content
      type(token_type), intent(inout) :: token   !! on entry its first byte and kind; on exit its last byte and kind

      character(1) :: quote

      if (has_curly_quote(content(token%first:min(token%first + 2, len(content))))) then
         token%last = end_before(content, token%first, line_ends)
         return
      end if
      token%kind = is_word
      token%last = end_before(content, token%first, word_ends//quotes)
      if (token%last == len(content)) return
      quote = content(token%last + 1:token%last + 1)
      if (index(quotes, quote) == 0) return
      do
         token%last = end_before(content, token%last + 2, quote//line_ends)
         if (token%last == len(content)) exit
         if (content(token%last + 1:token%last + 1) /= quote) exit
         token%last = token%last + 1
         if (token%last == len(content)) return
         if (content(token%last + 1:token%last + 1) /= quote) return
      end do
      token%kind = is_broken_word
   end subroutine find_word_end

   !> Whether a text has a curly quote, one of U+2018 to U+201F in UTF-8.
   pure logical function has_curly_quote(text)
      character(*), intent(in) :: text

      integer :: i

      has_curly_quote = any([(text(i:i + 1) == char(226)//char(128) .and. text(i + 2:i + 2) >= char(152) .and. &
                              text(i + 2:i + 2) <= char(159), i=1, len(text) - 2)])
   end function has_curly_quote

   !> Whether a token begins an entry `key = values`: it is a word, and '=' follows.
   pure logical function starts_entry(content, token)
      character(*), intent(in) :: content
      type(token_type), intent(in) :: token

      type(token_type) :: next

      next = next_token(content, token%last + 1)
      starts_entry = token%kind == is_word .and. next%kind == is_equals
   end function starts_entry

   !> The report of all problems in a deck, as the message of one error. Problems are numbered in the order of their
   !> positions. Each has its line of the deck with a caret below the position.
   pure function problem_report(problems, text) result(report)
      type(problem_list_type), intent(in) :: problems  !! at least one problem
      type(deck_text_type), intent(in) :: text
      character(:), allocatable :: report              !! lines; the last has no newline

      character(:), allocatable :: total, words
      integer :: first, i, last

      total = integer_text(problems%number)
      if (problems%is_full()) total = 'at least '//total
      report = ''
      do i = 1, min(problems%number, most_kept)
         words = ' error '//integer_text(i)//' of '//total//': '//problems%items(i)%words
         associate (position => problems%items(i)%position)
            if (i > 1) report = report//newline
            report = report//escaped(text%path)//':'
            if (position == 0) then
               report = report//words
               cycle
            end if
            call text%line_bounds(position, first, last)
            if (position > text%last_of_deck) then
               report = report//' '//escaped(text%content(first:last))//':'//words
            else
               report = report//integer_text(text%line_of(position))//':'// &
                        integer_text(character_count(text%content(first:position - 1)) + 1)//':'//words//newline// &
                        line_and_caret(text, position, first, last)
            end if
         end associate
      end do
      if (problems%number > most_kept) report = report//newline//'and more'
   end function problem_report

   !> A line of the deck, with a caret below a position in a second line. A long line is cut on both sides of the
   !> position.
   pure function line_and_caret(text, position, first, last) result(words)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: position, first, last   !! those of the problem and of the first and last byte of its line
      character(:), allocatable :: words

      integer, parameter :: longest_line = 100, most_before = 60, most_after = 40, narrowest_number = 4
      character(:), allocatable :: after, before, number
      integer :: from, to

      from = first
      to = last
      if (last - first >= longest_line) then
         from = max(first, position - most_before)
         to = min(last, position + most_after)
      end if
      before = escaped(text%content(from:position - 1))
      if (from > first) before = '...'//before
      after = escaped(text%content(position:to))
      if (to < last) after = after//'...'
      number = integer_text(text%line_of(position))
      number = repeat(' ', max(0, narrowest_number - len(number)))//number
      words = number//' | '//trim(before//after)//newline// &
              repeat(' ', len(number))//' | '//repeat(' ', character_count(before))//'^'
   end function line_and_caret

end module wavycon_deck_text
