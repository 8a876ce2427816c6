!> Cuts the text of a deck into tokens: words, separators and names of groups.
!>
!> The time is proportional to the length of the text, for any bytes.
module wavycon_deck_tokens
   implicit none (type, external)
   private

   public :: token_type, tokenise, starts_entry

   !> Kinds of tokens. A group token is '&' and the name; a broken word has a quote that is not closed.
   integer, parameter, public :: is_word = 1, is_broken_word = 2, is_equals = 3, is_comma = 4, is_slash = 5, &
      is_group = 6

   !> The bytes `first` to `last` of the deck's text.
   type :: token_type
      integer :: kind = 0, first = 0, last = 0
   end type token_type

   character(*), parameter :: blanks = ' '//achar(9)//achar(10)//achar(13)
   character(*), parameter :: line_ends = achar(10)//achar(13)
   character(*), parameter, public :: quotes = '"'''
   character(*), parameter :: word_ends = blanks//'=,/!&'

contains

   !> Counts the tokens and, where `tokens` is given, stores as many as it has room for.
   pure subroutine tokenise(content, number, tokens)
      character(*), intent(in) :: content
      integer, intent(out) :: number
      type(token_type), intent(inout), optional :: tokens(:)

      integer :: kind, last, place

      number = 0
      place = 1
      do while (place <= len(content))
         last = place
         select case (content(place:place))
         case (' ', achar(9), achar(10), achar(13))
            place = place + 1
            cycle
         case ('!')
            place = end_before(content, place, line_ends) + 1
            cycle
         case ('=')
            kind = is_equals
         case (',')
            kind = is_comma
         case ('/')
            kind = is_slash
         case ('&')
            kind = is_group
            last = end_before(content, place + 1, word_ends)
         case default
            call find_word_end(content, place, last, kind)
         end select
         number = number + 1
         if (present(tokens)) then
            if (number > size(tokens)) return
            tokens(number) = token_type(kind, place, last)
         end if
         place = last + 1
      end do
   end subroutine tokenise

   !> The place before the first byte of a set at or after `place`; the last place if there is none.
   pure integer function end_before(content, place, set)
      character(*), intent(in) :: content, set
      integer, intent(in) :: place

      end_before = scan(content(place:), set)
      if (end_before == 0) then
         end_before = len(content)
      else
         end_before = place + end_before - 2
      end if
   end function end_before

   !> Finds the end of a word: the closing quote, or the byte before the next separator. If a quote is not closed on its
   !> line, the word is broken.
   pure subroutine find_word_end(content, place, last, kind)
      character(*), intent(in) :: content
      integer, intent(in) :: place
      integer, intent(out) :: last, kind

      character(1) :: quote

      kind = is_word
      last = end_before(content, place, word_ends//quotes)
      if (last == len(content)) return
      quote = content(last + 1:last + 1)
      if (index(quotes, quote) == 0) return
      do
         last = end_before(content, last + 2, quote//line_ends)
         if (last == len(content)) exit
         if (content(last + 1:last + 1) /= quote) exit
         last = last + 1
         if (last == len(content)) return
         if (content(last + 1:last + 1) /= quote) return
      end do
      kind = is_broken_word
   end subroutine find_word_end

   !> Whether a token is a word followed by '='.
   pure logical function starts_entry(tokens, t)
      type(token_type), intent(in) :: tokens(:)
      integer, intent(in) :: t

      starts_entry = .false.
      if (t >= size(tokens)) return
      starts_entry = tokens(t)%kind == is_word .and. tokens(t + 1)%kind == is_equals
   end function starts_entry

end module wavycon_deck_tokens
