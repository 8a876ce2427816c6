!> Finds the parts of a deck's text: the groups and their entries `key = values`.
!>
!> Only the grammar is checked here, not names or values. What does not fit the grammar is reported and ignored. The
!> time is proportional to the length of the text, for any bytes.
module wavycon_deck_scanner
   use wavycon_deck_text, only: deck_text_type
   use wavycon_plain_text, only: excerpt, integer_text, lower_case
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: token_type, part_type, scan_type, next_token, next_part, read_entry

   !> Kinds of tokens. A group token is '&' and the name; a broken word has a quote that is not closed.
   integer, parameter, public :: at_end = 0, is_word = 1, is_broken_word = 2, is_equals = 3, is_comma = 4, &
      is_slash = 5, is_group = 6

   !> The bytes `first` to `last` of the deck's text; behind the last byte at its end.
   type :: token_type
      integer :: kind = at_end, first = 1, last = 0
   end type token_type

   !> A group, of which only the name is read, or an entry.
   type :: part_type
      type(token_type) :: name         !! of the group with its '&', or the key; at_end: there are no more parts
      integer :: values = 0            !! the byte behind the '=' of an entry
      integer :: last = 0              !! the last byte of its values
   end type part_type

   !> How far a text has been read.
   type :: scan_type
      integer :: next = 1                  !! the next byte
      type(token_type) :: group            !! the name of the group that is open; at_end: none
      logical :: quote_is_open = .false.   !! whether a quote in that group is not closed
   end type scan_type

   character(*), parameter :: line_ends = achar(10)//achar(13)
   character(*), parameter :: blanks = ' '//achar(9)//line_ends
   character(*), parameter, public :: quotes = '"'''
   character(*), parameter :: separators = '=,/&', word_ends = blanks//separators//'!'

contains

   !> Reads up to the next group or entry. Adds a problem for each part that does not fit the grammar.
   subroutine next_part(text, scan, part, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(inout) :: scan
      type(part_type), intent(out) :: part
      type(problem_list_type), intent(inout) :: problems

      type(token_type) :: token

      do
         if (problems%is_full()) return
         associate (content => text%content(:text%own))
            token = next_token(content, scan%next)
            if (token%kind == at_end) then
               ! If a quote is not closed, the '/' is likely within the quoted text: do not report it as missing.
               if (scan%group%kind == is_group .and. .not. scan%quote_is_open) call problems%add(scan%group%first, &
                  shown(scan%group)//" is not closed: no '/' up to the end of the deck")
               return
            else if (scan%group%kind == at_end) then
               scan%next = token%last + 1
               if (token%kind == is_group .and. .not. is_old_end(token)) then
                  scan%group = token
                  scan%quote_is_open = .false.
                  part%name = token
                  return
               end if
               call report_outside(token)
               call skip()
            else if (token%kind == is_slash) then
               scan%next = token%last + 1
               scan%group%kind = at_end
            else if (token%kind == is_group) then
               if (.not. scan%quote_is_open) call problems%add(token%first, "expected the '/' that closes "// &
                  shown(scan%group)//' of line '//integer_text(text%line_of(scan%group%first)))
               scan%group%kind = at_end
               if (is_old_end(token)) scan%next = token%last + 1
            else if (starts_entry(content, token)) then
               call read_entry(content, token, part, scan%quote_is_open, problems)
               scan%next = part%last + 1
               return
            else
               call problems%add(token%first, "expected 'key = value', found '"//shown(token)//"'")
               scan%quote_is_open = scan%quote_is_open .or. token%kind == is_broken_word
               scan%next = token%last + 1
               call skip()
            end if
         end associate
      end do

   contains

      !> Reports text outside a group.
      subroutine report_outside(token)
         type(token_type), intent(in) :: token

         if (text%content(max(1, token%first - 1):token%first - 1) == '/') then
            call problems%add(token%first, "text after the '/' that ends the group; "// &
                              "a '/' in a value is read as text only between quotes")
         else
            call problems%add(token%first, "'"//shown(token)// &
                              "' stands outside of any group: a group begins with &name and ends with '/'")
         end if
      end subroutine report_outside

      !> Goes on to the next group or, within a group, to the next entry or the '/'.
      subroutine skip()
         do
            token = next_token(text%content(:text%own), scan%next)
            if (token%kind == at_end .or. token%kind == is_group) exit
            if (scan%group%kind == is_group) then
               if (token%kind == is_slash .or. starts_entry(text%content(:text%own), token)) exit
            end if
            scan%next = token%last + 1
         end do
      end subroutine skip

      !> Whether a token is '&end', which closed a namelist group before Fortran 90. Decks do not allow it.
      pure logical function is_old_end(token)
         type(token_type), intent(in) :: token

         is_old_end = lower_case(text%content(token%first:token%last)) == '&end'
      end function is_old_end

      pure function shown(token) result(words)
         type(token_type), intent(in) :: token
         character(:), allocatable :: words

         words = excerpt(text%content(token%first:token%last))
      end function shown

   end subroutine next_part

   !> Reads an entry, up to the next entry, group or '/'.
   subroutine read_entry(content, key, entry, quote_is_open, problems)
      character(*), intent(in) :: content
      type(token_type), intent(in) :: key        !! a word before a '='
      type(part_type), intent(out) :: entry
      logical, intent(inout) :: quote_is_open    !! set where a quote is not closed
      type(problem_list_type), intent(inout) :: problems

      type(token_type) :: before, token
      logical :: wants_value

      entry%name = key
      token = next_token(content, key%last + 1)
      entry%values = token%last + 1
      wants_value = .true.
      do
         before = token
         entry%last = before%last
         token = next_token(content, before%last + 1)
         select case (token%kind)
         case (is_comma)
            if (wants_value) call problems%add(token%first, 'no value before this comma')
            wants_value = .true.
         case (is_equals)
            call problems%add(token%first, "'=' in place of a value")
         case (is_word)
            if (before%kind == is_word .and. before%last == token%first - 1) &
               call problems%add(token%first, 'expected a blank or a comma behind the quote')
            if (starts_entry(content, token)) return
            wants_value = .false.
         case (is_broken_word)
            call problems%add(token%first - 1 + scan(content(token%first:token%last), quotes), &
                              'this quote is not closed on its line; within a text a quote is doubled')
            quote_is_open = .true.
            wants_value = .false.
         case default
            return
         end select
      end do
   end subroutine read_entry

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
         token%kind = is_group
         token%last = end_before(content, token%first + 1, word_ends)
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

   !> Whether a token is a word followed by '='.
   pure logical function starts_entry(content, token)
      character(*), intent(in) :: content
      type(token_type), intent(in) :: token

      type(token_type) :: next

      next = next_token(content, token%last + 1)
      starts_entry = token%kind == is_word .and. next%kind == is_equals
   end function starts_entry

end module wavycon_deck_scanner
