!> Finds the tokens of a deck's text: words, names of groups, and what separates them. Any bytes are tokens.
module wavycon_deck_scanner
   use wavycon_plain_text, only: lower_case
   implicit none (type, external)
   private

   public :: token_type, next_token, starts_entry

   !> Kinds of tokens. A group token is '&' and the name; a broken word has a quote that is not closed.
   integer, parameter, public :: at_end = 0, is_word = 1, is_broken_word = 2, is_equals = 3, is_comma = 4, &
      is_slash = 5, is_group = 6

   !> The bytes `first` to `last` of the deck's text; behind the last byte at its end.
   type :: token_type
      integer :: kind = at_end, first = 1, last = 0
   end type token_type

   character(*), parameter :: line_ends = achar(10)//achar(13)
   character(*), parameter :: blanks = ' '//achar(9)//line_ends
   character(*), parameter, public :: quotes = '"'''
   character(*), parameter :: separators = '=,/&', word_ends = blanks//separators//'!'

contains

   !> The first token from a place on.
   pure type(token_type) function next_token(content, place) result(token)
      character(*), intent(in) :: content
      integer, intent(in) :: place

      integer :: skipped

      token%first = place
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
      select case (content(token%first:token%first))
      case ('=')
         token%kind = is_equals
      case (',')
         token%kind = is_comma
      case ('/')
         token%kind = is_slash
      case ('&')
         token%last = end_before(content, token%first + 1, word_ends)
         ! Before Fortran 90 '&end' closed a group.
         token%kind = merge(is_slash, is_group, lower_case(content(token%first:token%last)) == '&end')
      case default
         call find_word_end(content, token)
      end select
   end function next_token

   !> The place before the first byte of a set at or after `place`; the last place if there is none.
   pure integer function end_before(content, place, set)
      character(*), intent(in) :: content, set
      integer, intent(in) :: place

      end_before = scan(content(place:), set) + place - 2
      if (end_before < place - 1) end_before = len(content)
   end function end_before

   !> Finds the end of a word: the closing quote, or the byte before the next separator. If a quote is not closed on its
   !> line, the word is broken.
   pure subroutine find_word_end(content, token)
      character(*), intent(in) :: content
      type(token_type), intent(inout) :: token

      character(1) :: quote

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

   !> Whether a token begins an entry `key = values`: a word followed by '='.
   pure logical function starts_entry(content, token)
      character(*), intent(in) :: content
      type(token_type), intent(in) :: token

      type(token_type) :: next

      next = next_token(content, token%last + 1)
      starts_entry = token%kind == is_word .and. next%kind == is_equals
   end function starts_entry

end module wavycon_deck_scanner
