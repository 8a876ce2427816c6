!> Arranges the tokens of a deck into groups and their entries `key = values`.
!>
!> Only the grammar is checked here, not names or values. Tokens that do not fit the grammar are reported and ignored.
module wavycon_deck_scanner
   use wavycon_deck_text, only: deck_text_type
   use wavycon_deck_tokens, only: is_broken_word, is_comma, is_equals, is_group, is_slash, is_word, quotes, &
      starts_entry, token_type, tokenise
   use wavycon_plain_text, only: excerpt, integer_text, lower_case
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: scan_type, entry_type, scan_deck, start_scan, read_group, read_values

   !> Most tokens, groups and entries of a deck, to bound time and memory. The longest list of loads takes 200000
   !> tokens.
   integer, parameter, public :: most_tokens = 1000000, most_groups = 100, most_entries = 1000

   !> `key = values`.
   type :: entry_type
      integer :: group = 0                        !! number of the group that it stands in
      integer :: key = 0                          !! token of the key
      integer :: first_value = 1, last_value = 0  !! tokens of the values and of the commas among them
   end type entry_type

   type :: scan_type
      type(token_type), allocatable :: tokens(:)
      integer, allocatable :: groups(:)            !! tokens of the groups' names, in the order of the deck
      type(entry_type), allocatable :: entries(:)  !! in the order of the deck
   end type scan_type

contains

   !> Scans a text. Adds a problem for each part that does not fit the grammar and ignores that part.
   subroutine scan_deck(text, scan, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(out) :: scan
      type(problem_list_type), intent(inout) :: problems

      integer :: t

      call start_scan(text, scan, problems)
      t = 1
      do while (t <= size(scan%tokens) .and. .not. problems%is_full())
         if (scan%tokens(t)%kind /= is_group .or. is_old_end(text, scan%tokens(t))) then
            call report_outside(text, scan%tokens, t, problems)
            t = next_start(scan%tokens, t + 1, in_group=.false.)
         else if (size(scan%groups) == most_groups) then
            call problems%add(scan%tokens(t)%first, 'a deck has at most '//integer_text(most_groups)// &
               ' groups: what follows is not read')
            exit
         else
            call read_group(text, scan, t, problems)
         end if
      end do
   end subroutine scan_deck

   !> Cuts the text into tokens, without groups and entries yet.
   subroutine start_scan(text, scan, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(out) :: scan
      type(problem_list_type), intent(inout) :: problems

      integer :: number

      call tokenise(text%content, number)
      allocate (scan%tokens(min(number, most_tokens)), scan%groups(0), scan%entries(0))
      call tokenise(text%content, number, scan%tokens)
      if (number > most_tokens) call problems%add(scan%tokens(most_tokens)%first, &
         'a deck has at most '//integer_text(most_tokens)//' words and separators: what follows is not read')
   end subroutine start_scan

   !> Reads a group, from its name to the '/' that closes it.
   subroutine read_group(text, scan, t, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(inout) :: scan
      integer, intent(inout) :: t   !! token of the group's name; then the token behind the group
      type(problem_list_type), intent(inout) :: problems

      logical :: quote_is_open
      integer :: name

      name = t
      scan%groups = [scan%groups, name]
      quote_is_open = .false.
      t = t + 1
      do while (t <= size(scan%tokens))
         if (problems%is_full()) return
         associate (token => scan%tokens(t))
            if (token%kind == is_slash) then
               t = t + 1
               return
            else if (token%kind == is_group) then
               if (.not. quote_is_open) call problems%add(token%first, "expected the '/' that closes "// &
                  shown(text, scan%tokens(name))//' of line '// &
                  integer_text(text%line_of(scan%tokens(name)%first)))
               if (is_old_end(text, token)) t = t + 1
               return
            else if (size(scan%entries) == most_entries) then
               call problems%add(token%first, 'a deck has at most '//integer_text(most_entries)// &
                  ' keys: what follows is not read')
               t = size(scan%tokens) + 1
               return
            else if (starts_entry(scan%tokens, t)) then
               call read_entry(text, scan, t, quote_is_open, problems)
            else
               call problems%add(token%first, "expected 'key = value', found '"//shown(text, token)//"'")
               quote_is_open = quote_is_open .or. token%kind == is_broken_word
               t = next_start(scan%tokens, t + 1, in_group=.true.)
            end if
         end associate
      end do
      ! If a quote is not closed, the '/' is likely within the quoted text: do not report it as missing.
      if (.not. quote_is_open) call problems%add(scan%tokens(name)%first, shown(text, scan%tokens(name))// &
         " is not closed: no '/' up to the end of the deck")
   end subroutine read_group

   !> Reads an entry of the last group.
   subroutine read_entry(text, scan, t, quote_is_open, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(inout) :: scan
      integer, intent(inout) :: t                !! token of the key; then the token behind the entry
      logical, intent(inout) :: quote_is_open    !! set where a quote is not closed
      type(problem_list_type), intent(inout) :: problems

      type(entry_type) :: entry

      entry%group = size(scan%groups)
      entry%key = t
      entry%first_value = t + 2
      t = t + 2
      call read_values(text, scan%tokens, t, quote_is_open, problems)
      entry%last_value = t - 1
      scan%entries = [scan%entries, entry]
   end subroutine read_entry

   !> Reads the words and commas that follow 'key =', up to the next entry, group or '/'.
   subroutine read_values(text, tokens, t, quote_is_open, problems)
      type(deck_text_type), intent(in) :: text
      type(token_type), intent(in) :: tokens(:)
      integer, intent(inout) :: t                !! the token behind the '='; then the token behind the values
      logical, intent(inout) :: quote_is_open    !! set where a quote is not closed
      type(problem_list_type), intent(inout) :: problems

      logical :: wants_value

      wants_value = .true.
      do while (t <= size(tokens))
         associate (token => tokens(t))
            select case (token%kind)
            case (is_comma)
               if (wants_value) call problems%add(token%first, 'no value before this comma')
               wants_value = .true.
            case (is_equals)
               call problems%add(token%first, "'=' in place of a value")
            case (is_word)
               if (tokens(t - 1)%kind == is_word .and. tokens(t - 1)%last == token%first - 1) &
                  call problems%add(token%first, 'expected a blank or a comma behind the quote')
               if (starts_entry(tokens, t)) return
               wants_value = .false.
            case (is_broken_word)
               call problems%add(token%first - 1 + scan(text%content(token%first:token%last), quotes), &
                  'this quote is not closed on its line; within a text a quote is doubled')
               quote_is_open = .true.
               wants_value = .false.
            case default
               return
            end select
         end associate
         t = t + 1
      end do
   end subroutine read_values

   !> Reports text outside a group, at token t.
   subroutine report_outside(text, tokens, t, problems)
      type(deck_text_type), intent(in) :: text
      type(token_type), intent(in) :: tokens(:)
      integer, intent(in) :: t
      type(problem_list_type), intent(inout) :: problems

      if (t > 1) then
         if (tokens(t - 1)%kind == is_slash .and. tokens(t - 1)%last == tokens(t)%first - 1) then
            call problems%add(tokens(t)%first, "text after the '/' that ends the group; "// &
               "a '/' in a value is read as text only between quotes")
            return
         end if
      end if
      call problems%add(tokens(t)%first, "'"//shown(text, tokens(t))// &
         "' stands outside of any group: a group begins with &name and ends with '/'")
   end subroutine report_outside

   !> The first token, from t on, that names a group or, within a group, begins an entry or ends it; one behind the last
   !> if there is none.
   pure integer function next_start(tokens, t, in_group) result(next)
      type(token_type), intent(in) :: tokens(:)
      integer, intent(in) :: t
      logical, intent(in) :: in_group

      do next = t, size(tokens)
         if (tokens(next)%kind == is_group) exit
         if (in_group .and. (tokens(next)%kind == is_slash .or. starts_entry(tokens, next))) exit
      end do
   end function next_start

   !> Whether a token is '&end', which closed a namelist group before Fortran 90. Decks do not allow it.
   pure logical function is_old_end(text, token)
      type(deck_text_type), intent(in) :: text
      type(token_type), intent(in) :: token

      is_old_end = lower_case(text%content(token%first:token%last)) == '&end'
   end function is_old_end

   !> The text of a token for messages: an excerpt with unprintable bytes escaped.
   pure function shown(text, token) result(words)
      type(deck_text_type), intent(in) :: text
      type(token_type), intent(in) :: token
      character(:), allocatable :: words

      words = excerpt(text%content(token%first:token%last))
   end function shown

end module wavycon_deck_scanner
