!> Takes the text of a deck apart into groups, their entries `key = values`, and the words of these.
!>
!> What the words mean is not looked at here. Every step costs time in proportion to the length of the text,
!> whatever bytes it holds.
module wavycon_deck_scanner
   use wavycon_deck_text, only: deck_text_type
   use wavycon_plain_text, only: excerpt, integer_text, lower_case
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: scan_type, token_type, entry_type, group_type, scan_deck

   !> What a token is. A group token is '&' and the name; a broken word has a quote that nothing closes.
   integer, parameter, public :: is_word = 1, is_broken_word = 2, is_equals = 3, is_comma = 4, is_slash = 5, &
      is_group = 6

   !> Smallest piece of a deck: the bytes `first` to `last` of its text.
   type :: token_type
      integer :: kind = 0, first = 0, last = 0
   end type token_type

   !> `key = values`.
   type :: entry_type
      integer :: group = 0                      !! number of the group that it stands in
      integer :: key = 0                        !! token of the key
      integer :: first_value = 1, last_value = 0  !! tokens of the values and of the commas among them
   end type entry_type

   !> `&name entries /`.
   type :: group_type
      integer :: name = 0  !! its token
   end type group_type

   type :: scan_type
      type(token_type), allocatable :: tokens(:)
      type(group_type), allocatable :: groups(:)   !! in the order of the deck
      type(entry_type), allocatable :: entries(:)  !! in the order of the deck
   end type scan_type

   character(*), parameter :: blanks = ' '//achar(9)//achar(10)//achar(13)
   character(*), parameter :: line_ends = achar(10)//achar(13)
   character(*), parameter :: quotes = '"'''
   character(*), parameter :: word_ends = blanks//'=,/!&'

contains

   !> Scans a text; what does not fit the grammar is added to the problems and left out.
   subroutine scan_deck(text, scan, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(out) :: scan
      type(problem_list_type), intent(inout) :: problems

      integer :: number

      call tokenise(text%content, number)
      allocate (scan%tokens(number))
      call tokenise(text%content, number, scan%tokens)
      call arrange(text, scan, problems)
   end subroutine scan_deck

   !> Counts the tokens, or stores them where there is room for them.
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
            last = end_before(content, place, line_ends)
            place = last + 1
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
         if (present(tokens)) tokens(number) = token_type(kind, place, last)
         place = last + 1
      end do
   end subroutine tokenise

   !> The last place before any byte of a set, looking from a place on.
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

   !> The end of a word: a closing quote, or what comes before the next separator. A quote must be closed on
   !> its line.
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

   !> Sorts the tokens into groups and entries.
   subroutine arrange(text, scan, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(inout) :: scan
      type(problem_list_type), intent(inout) :: problems

      type(group_type), allocatable :: groups(:)
      type(entry_type), allocatable :: entries(:)
      logical :: inside, quote_is_open
      integer :: group, entries_found, t

      allocate (groups(count(scan%tokens%kind == is_group)), entries(count(scan%tokens%kind == is_equals)))
      group = 0
      entries_found = 0
      inside = .false.
      quote_is_open = .false.
      t = 1
      do while (t <= size(scan%tokens))
         if (problems%is_full()) exit
         associate (token => scan%tokens(t))
            if (token%kind == is_group) then
               if (inside) then
                  call report_open_group(token%first)
               else if (is_old_end(token)) then
                  call report_outside(t)
               end if
               inside = .not. is_old_end(token)
               quote_is_open = .false.
               if (inside) then
                  group = group + 1
                  groups(group)%name = t
               end if
               t = t + 1
            else if (.not. inside) then
               call report_outside(t)
               do while (t <= size(scan%tokens))
                  if (scan%tokens(t)%kind == is_group) exit
                  t = t + 1
               end do
            else if (token%kind == is_slash) then
               inside = .false.
               t = t + 1
            else if (begins_entry(scan%tokens, t)) then
               entries_found = entries_found + 1
               entries(entries_found)%group = group
               entries(entries_found)%key = t
               t = t + 2
               call take_values(entries(entries_found))
            else
               call problems%add(token%first, "expected 'key = value', found '"// &
                  excerpt(text%content(token%first:token%last))//"'")
               quote_is_open = quote_is_open .or. token%kind == is_broken_word
               t = t + 1
               do while (t <= size(scan%tokens))
                  if (scan%tokens(t)%kind == is_group .or. scan%tokens(t)%kind == is_slash) exit
                  if (begins_entry(scan%tokens, t)) exit
                  t = t + 1
               end do
            end if
         end associate
      end do
      if (inside .and. t > size(scan%tokens)) call report_open_group(0)
      scan%groups = groups(:group)
      scan%entries = entries(:entries_found)

   contains

      !> Whether a group token is '&end', which closed a group before Fortran 90 and does no longer.
      pure logical function is_old_end(token)
         type(token_type), intent(in) :: token

         ! Most names are longer: decks may have a million groups.
         is_old_end = token%last - token%first + 1 == len('&end')
         if (is_old_end) is_old_end = lower_case(text%content(token%first:token%last)) == '&end'
      end function is_old_end

      !> Takes the words and commas that follow 'key ='; token t is the first.
      subroutine take_values(entry)
         type(entry_type), intent(inout) :: entry

         logical :: wants_value

         entry%first_value = t
         wants_value = .true.
         do while (t <= size(scan%tokens))
            associate (token => scan%tokens(t))
               select case (token%kind)
               case (is_comma)
                  if (wants_value) call problems%add(token%first, 'no value before this comma')
                  wants_value = .true.
               case (is_equals)
                  call problems%add(token%first, "'=' in place of a value")
               case (is_word, is_broken_word)
                  if (token%kind == is_broken_word) then
                     call problems%add(open_quote(token), &
                        'this quote is not closed on its line; within a text a quote is doubled')
                     quote_is_open = .true.
                  else if (scan%tokens(t - 1)%kind == is_word .and. &
                           scan%tokens(t - 1)%last == token%first - 1) then
                     call problems%add(token%first, 'expected a blank or a comma behind the quote')
                  end if
                  if (begins_entry(scan%tokens, t)) exit
                  wants_value = .false.
               case default
                  exit
               end select
            end associate
            t = t + 1
         end do
         entry%last_value = t - 1
      end subroutine take_values

      !> The place of the quote that is not closed in a broken word.
      pure integer function open_quote(token)
         type(token_type), intent(in) :: token

         open_quote = token%first
         do while (index(quotes, text%content(open_quote:open_quote)) == 0)
            open_quote = open_quote + 1
         end do
      end function open_quote

      !> A group without its '/'. Where a quote is open the '/' is likely to be behind it: no second problem.
      subroutine report_open_group(place)
         integer, intent(in) :: place  !! of the '&' that follows; 0 if the deck ends

         if (quote_is_open) return
         associate (name => scan%tokens(groups(group)%name))
            if (place == 0) then
               call problems%add(name%first, excerpt(text%content(name%first:name%last))// &
                  " is not closed: no '/' up to the end of the deck")
            else
               call problems%add(place, "expected the '/' that closes "// &
                  excerpt(text%content(name%first:name%last))//' of line '// &
                  integer_text(text%line_of(name%first)))
            end if
         end associate
      end subroutine report_open_group

      !> Text outside a group, at token t: outside is all up to the next '&'.
      subroutine report_outside(t)
         integer, intent(in) :: t

         associate (token => scan%tokens(t))
            if (t > 1) then
               if (scan%tokens(t - 1)%kind == is_slash .and. scan%tokens(t - 1)%last == token%first - 1) then
                  call problems%add(token%first, "text after the '/' that ends the group; "// &
                     "a '/' in a value is read as text only between quotes")
                  return
               end if
            end if
            call problems%add(token%first, "'"//excerpt(text%content(token%first:token%last))// &
               "' stands outside of any group: a group begins with &name and ends with '/'")
         end associate
      end subroutine report_outside

   end subroutine arrange

   !> Whether a token is a word followed by '='.
   pure logical function begins_entry(tokens, t)
      type(token_type), intent(in) :: tokens(:)
      integer, intent(in) :: t

      begins_entry = .false.
      if (t == size(tokens)) return
      begins_entry = tokens(t)%kind == is_word .and. tokens(t + 1)%kind == is_equals
   end function begins_entry

end module wavycon_deck_scanner
