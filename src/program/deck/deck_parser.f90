!> Reads the values of all keys of a deck from its text, in one pass, and checks them against the grammar and the tables
!> of keys.
module wavycon_deck_parser
   use wavycon_deck_groups, only: unknown_group, unknown_key
   use wavycon_deck_text, only: at_end, deck_text_type, has_curly_quote, is_broken_word, is_comma, is_equals, &
      is_group, is_slash, is_word, next_token, quotes, starts_entry, token_type
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: allowed_values, choice_value, key_index, real_value, text_value
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: nearest_name
   use wavycon_plain_text, only: decimal_digits, excerpt, integer_text, lower_case, newline, quoted
   use wavycon_problems, only: problem_list_type
   use wavycon_settings, only: replaces, setting_type
   implicit none (type, external)
   private

   public :: take_groups

   !> A pass over the text.
   type :: deck_parser
      type(deck_text_type), pointer :: text => null()
      type(key_list), pointer :: lists(:) => null()            !! the keys of all groups
      type(problem_list_type), pointer :: problems => null()   !! problems are added
      type(setting_type), allocatable :: settings(:)           !! keys set in place of those of the deck
      integer :: last = 0                         !! last byte of the text that may be read: of the deck, or a setting
      type(token_type) :: token                   !! the next token
      type(token_type) :: before                  !! the token before it
      type(token_type) :: group                   !! name of the open group; its kind is at_end if no group is open
      type(key_list), pointer :: list => null()   !! keys of the open group; null: unknown or given twice
      logical :: quote_is_open = .false.          !! whether the open group has a quote that is not closed
      logical :: is_unknown = .false.             !! whether the deck has an unknown group: it may be any missing one
      logical, allocatable :: is_guessed(:)       !! whether the deck has a misspelt name that is near to this group's
   contains
      procedure :: take_setting, take_deck, open_group, take_entry, find_key, take_word, advance, shown
   end type deck_parser

   !> An entry `key = values` of the open group.
   type :: deck_entry
      character(:), allocatable :: name        !! name of the key, in lower case
      integer :: position = 0                  !! position of the key in the text
      !> Number of the key; 0 if its values are not to be read: it was reported, the group is unknown, or a setting of
      !> the command line replaces the key.
      integer :: k = 0
      real(dp), allocatable :: numbers(:)      !! the values; its size is the most that the key may have
      integer :: used = 0                      !! number of values so far; size(numbers) + 1: too many
      type(word_value) :: value                !! the value of the last word
      logical :: is_read = .false.             !! whether words are read as values; if not they are skipped
      logical :: is_bad = .false.              !! whether a value cannot be used
      logical :: by_blanks = .false.           !! whether blanks, alone or behind a comma, separate values of a line
      logical :: by_decimal_commas = .false.   !! whether commas do that may be meant as decimal points
   end type deck_entry

contains

   !> Reads the values of all groups, in one pass over the text, and checks them against the grammar and the tables of
   !> keys: names, types, bounds. Checks of keys against each other follow in the modules of the groups. Text that does
   !> not fit the grammar is reported and ignored. The time is proportional to the length of the text, for any bytes.
   !>
   !> Settings of the command line come first, so that the same keys of the deck are skipped.
   subroutine take_groups(text, lists, problems, settings)
      type(deck_text_type), intent(inout), target :: text          !! each setting is added as a line behind the deck
      type(key_list), intent(inout), target :: lists(:)            !! keys of all groups; their records get the values
      type(problem_list_type), intent(inout), target :: problems   !! problems are added
      type(setting_type), intent(in), optional :: settings(:)      !! keys set in place of those of the deck

      integer :: g, k, s
      type(deck_parser) :: parser

      parser%text => text
      parser%lists => lists
      parser%problems => problems
      allocate (parser%settings(0), parser%is_guessed(size(lists)))
      if (present(settings)) parser%settings = settings
      parser%is_guessed = .false.
      do g = 1, size(lists)
         call lists(g)%start(text%path)
      end do
      do s = 1, size(parser%settings)
         call parser%take_setting(s)
      end do
      call parser%take_deck()
      do g = 1, size(lists)
         associate (group => lists(g)%group)
            group%has_unknown = group%has_unknown .or. (parser%is_unknown .and. group%position == 0)
            group%any_bad = group%has_unknown .or. any([(lists(g)%keys(k)%value%is_bad, k=1, size(lists(g)%keys))])
         end associate
      end do
   end subroutine take_groups

   !> Adds a setting of the command line to the text, as a line '--set group.key=value', and takes its key.
   subroutine take_setting(self, s)
      class(deck_parser), intent(inout) :: self
      integer, intent(in) :: s   !! number of the setting

      character(:), allocatable :: value
      integer :: g, position

      associate (setting => self%settings(s), text => self%text)
         g = findloc(self%lists%name == setting%group, .true., dim=1)
         value = setting%value
         if (g > 0) then
            associate (keys => self%lists(g)%rows)
               ! Shells remove the quotes around a text: add them.
               if (any(keys%name == setting%key .and. (keys%kind == text_value .or. keys%kind == choice_value)) .and. &
                   scan(value, quotes) /= 1) value = quoted(value)
            end associate
         end if
         position = len(text%content) + len(' --set ') + 1
         text%content = text%content//newline//'--set '//setting%group//'.'//setting%key//'='//value
         if (g == 0) then
            call self%problems%add(position, unknown_group(setting%group, self%lists))
            return
         end if
         self%list => self%lists(g)
         if (self%list%group%position == 0) self%list%group%position = position
         position = position + len(setting%group) + 1
         self%last = len(text%content)
         self%token = token_type(is_word, position, position + len(setting%key) - 1)
      end associate
      call self%take_entry()
      if (self%token%kind /= at_end) call self%problems%add(self%token%first, &
         "--set takes one key and its value, found '"//self%shown(self%token)//"' behind them")
   end subroutine take_setting

   !> Takes the tokens of the deck one by one: names of groups, entries `key = values` and '/'. After a token that does
   !> not fit, others are skipped without a report up to the next group, entry or '/'.
   subroutine take_deck(self)
      class(deck_parser), intent(inout) :: self

      logical :: is_lost   ! whether tokens are skipped since one that does not fit

      is_lost = .false.
      self%last = self%text%last_of_deck
      self%token = token_type()
      call self%advance()
      do while (self%token%kind /= at_end .and. .not. self%problems%is_full())
         if (self%token%kind == is_group) then
            is_lost = .false.
            call self%open_group()
         else if (self%group%kind == is_group .and. self%token%kind == is_slash) then
            is_lost = .false.
            self%group%kind = at_end
         else if (self%group%kind == is_group .and. starts_entry(self%text%content(:self%last), self%token)) then
            is_lost = .false.
            call self%take_entry()
            cycle
         else if (.not. is_lost) then
            is_lost = .true.
            self%quote_is_open = self%quote_is_open .or. self%token%kind == is_broken_word
            if (self%group%kind == is_group) then
               call self%problems%add(self%token%first, "expected 'key = value', found '"//self%shown(self%token)//"'")
            else
               call self%problems%add(self%token%first, "'"//self%shown(self%token)//"' stands outside of any "// &
                  "group: a group begins with &name and ends with '/', which is text only between quotes; '!' "// &
                  'begins a comment')
            end if
         end if
         call self%advance()
      end do
      ! If a quote is not closed, the '/' is likely within the quoted text: do not report it as missing.
      if (self%group%kind == is_group .and. self%token%kind == at_end .and. .not. self%quote_is_open) &
         call self%problems%add(self%group%first, self%shown(self%group)// &
                                " is not closed: no '/' up to the end of the deck")
   end subroutine take_deck

   !> Opens the group that the next token names. The group has no list if it is unknown or given twice. A misspelt name
   !> counts as the nearest known one, so that the keys of the group are checked too, unless the deck has given that
   !> group before.
   subroutine open_group(self)
      class(deck_parser), intent(inout) :: self

      character(:), allocatable :: name   ! in lower case, without '&'
      integer :: g
      logical :: is_known

      if (self%group%kind == is_group .and. .not. self%quote_is_open) call self%problems%add(self%token%first, &
         "expected the '/' that closes "//self%shown(self%group)//' of line '// &
         integer_text(self%text%line_of(self%group%first)))
      self%group = self%token
      self%quote_is_open = .false.
      self%list => null()
      name = lower_case(self%text%content(self%group%first + 1:self%group%last))
      g = findloc(self%lists%name == name, .true., dim=1)
      is_known = g > 0
      if (.not. is_known) then
         call self%problems%add(self%group%first, unknown_group(name, self%lists))
         g = nearest_name(name, self%lists%name)
         self%is_unknown = self%is_unknown .or. g == 0
         if (g == 0) return
      end if
      associate (first => self%lists(g)%group%position)
         if (first > 0 .and. first <= self%text%last_of_deck .and. .not. self%is_guessed(g)) then
            if (is_known) call self%problems%add(self%group%first, &
               '&'//name//' is given twice, first in line '//integer_text(self%text%line_of(first)))
            return
         end if
         first = self%group%first
      end associate
      self%is_guessed(g) = .not. is_known
      self%list => self%lists(g)
   end subroutine open_group

   !> Takes an entry `key = values`. On entry the next token is the key, on exit it is the first one behind the values.
   !> Values are bad as a whole if one of them is.
   subroutine take_entry(self)
      class(deck_parser), intent(inout) :: self

      character(:), allocatable :: word
      integer :: equals        ! position of the '=' of the entry
      logical :: are_decimals  ! whether commas between digits are unlikely to separate numbers
      type(deck_entry) :: entry

      call self%find_key(entry)
      call self%advance()
      equals = self%token%last
      do
         call self%advance()
         select case (self%token%kind)
         case (is_comma)
            if (any(self%before%kind == [is_equals, is_comma])) &
               call self%problems%add(self%token%first, 'no value before this comma')
            entry%by_decimal_commas = entry%by_decimal_commas .or. may_be_decimal( &
               self%text%content(self%before%first:self%before%last), &
               self%text%content(self%before%last + 1:self%last))
         case (is_equals)
            call self%problems%add(self%token%first, "'=' in place of a value")
         case (is_broken_word)
            entry%is_bad = .true.
            self%quote_is_open = .true.
            ! The broken word may hide keys behind it, so that no key of the group counts as missing.
            if (associated(self%list)) self%list%group%has_unknown = .true.
            word = self%text%content(self%token%first:self%token%last)
            if (has_curly_quote(word)) then
               call self%problems%add(self%token%first, &
                  'curly quotes are no quotes here: write straight ones, '' or "')
            else
               call self%problems%add(self%token%first - 1 + scan(word, quotes), &
                                      'this quote is not closed on its line; within a text a quote is doubled')
            end if
         case (is_word)
            if (self%before%kind == is_word .and. self%before%last == self%token%first - 1) &
               call self%problems%add(self%token%first, 'expected a blank or a comma behind the quote')
            if (starts_entry(self%text%content(:self%last), self%token)) exit
            if (entry%is_read) call self%take_word(entry)
         case default
            exit
         end select
      end do
      if (entry%k == 0) return
      if (entry%is_bad) entry%used = 0
      call self%list%take(entry%k, entry%position, entry%numbers(:entry%used), entry%value%text)
      associate (row => self%list%rows(entry%k))
         ! Decimal commas may be meant if blanks separate other numbers; or if the loads would be 0 and another, which
         ! nobody solves. 0 and 2 may well be depths.
         are_decimals = entry%by_blanks .or. (self%list%name == 'load' .and. entry%used == 2 .and. &
            all(entry%numbers(:min(1, entry%used)) <= 0.0_dp) .and. &
            index(self%text%content(equals:self%before%last), '.') == 0)
         self%list%keys(entry%k)%value%has_decimal_commas = row%kind == real_value .and. are_decimals .and. &
            entry%by_decimal_commas
         if (self%before%last == equals) call self%problems%add(entry%position, &
            entry%name//' has no value: it must be '//allowed_values(row))
      end associate
   end subroutine take_entry

   !> Begins the entry whose key is the next token. Unknown keys and keys given twice are reported.
   subroutine find_key(self, entry)
      class(deck_parser), intent(inout) :: self
      type(deck_entry), intent(out) :: entry

      character(:), allocatable :: before
      integer :: candidate, first, i, k, last
      logical, allocatable :: is_given(:)

      entry%position = self%token%first
      entry%name = lower_case(self%text%content(self%token%first:self%token%last))
      if (.not. associated(self%list)) return
      associate (list => self%list, name => entry%name, position => entry%position, text => self%text)
         if (position <= text%last_of_deck .and. &
             any([(replaces(self%settings(i), list, name), i=1, size(self%settings))])) return
         k = key_index(list%rows, name)
         if (k == 0) then
            list%group%has_unknown = .true.
            call self%problems%add(position, unknown_key(name, list, self%lists))
            ! A misspelt key of the deck counts as the nearest one, without a value: that is not reported as missing
            ! too. The deck may still give the right key behind it.
            is_given = [(list%keys(i)%value%is_given, i=1, size(list%keys))]
            candidate = nearest_name(name, list%rows%name, is_given)
            if (candidate == 0 .or. position > text%last_of_deck) return
            if (.not. is_given(candidate)) call list%take(candidate, position)
            return
         end if
         associate (given => list%keys(k)%value)
            if (given%is_given .and. .not. given%is_bad) then
               before = 'in line '//integer_text(text%line_of(given%position))
               if (given%position > text%last_of_deck) then
                  call text%line_bounds(given%position, first, last)
                  before = 'by '//excerpt(text%content(first:last))
               end if
               call self%problems%add(position, name//' is given twice, first '//before)
               return
            end if
         end associate
         entry%k = k
         entry%is_read = .true.
         allocate (entry%numbers(list%rows(k)%most_values))
      end associate
   end subroutine find_key

   !> Takes the next token, a word, as the next value of an entry or, if it is 'r*value', as the next r values.
   subroutine take_word(self, entry)
      class(deck_parser), intent(inout) :: self
      type(deck_entry), intent(inout) :: entry

      character(:), allocatable :: trouble, word
      integer :: left         ! number of values that the key may still have
      type(token_type) :: next

      word = self%text%content(self%token%first:self%token%last)
      entry%by_blanks = entry%by_blanks .or. (any(self%before%kind == [is_word, is_comma]) .and. &
         self%before%last + 1 < self%token%first .and. &
         index(self%text%content(self%before%last:self%token%first), newline) == 0)
      associate (key => self%list%rows(entry%k), used => entry%used, most => size(entry%numbers), value => entry%value)
         left = most - used
         used = used + 1
         value = word_value()
         if (most == 1 .and. left == 1 .and. key%kind == real_value .and. &
             may_be_decimal(word, self%text%content(self%token%last + 1:self%last))) then
            next = next_token(self%text%content(:self%last), self%token%last + 2)
            trouble = trim(key%name)//" takes one value, and '"//self%shown( &
                      token_type(is_word, self%token%first, next%last))//"' is two: numbers have no comma, and "// &
                      'decimals have a point, as 0.5'
         else if (left > 0) then
            call read_value(key, word, value, trouble)
         end if
         if (.not. allocated(trouble)) then
            if (value%repeats <= left) then
               entry%numbers(used:used + value%repeats - 1) = value%number
               used = used + value%repeats - 1
               return
            end if
            used = most + 1
            trouble = trim(key%name)//' takes one value'
            if (most > 1) trouble = trim(key%name)//' takes at most '//integer_text(most)//' values'
            if (left > 0) then
               trouble = trouble//", got '"//excerpt(word)//"'"
            else
               trouble = trouble//", and here is one more: '"//excerpt(word)//"'"
               if (key_index(self%list%rows, lower_case(word)) > 0) trouble = trouble//"; is a '=' missing behind it?"
            end if
         end if
         call self%problems%add(self%token%first, trouble)
         entry%is_bad = .true.
         entry%is_read = used <= most .and. most > 1 .and. .not. self%problems%is_full()
      end associate
   end subroutine take_word

   !> Goes on to the next token.
   pure subroutine advance(self)
      class(deck_parser), intent(inout) :: self

      self%before = self%token
      self%token = next_token(self%text%content(:self%last), self%before%last + 1)
   end subroutine advance

   !> The text of a token for a message.
   pure function shown(self, token) result(words)
      class(deck_parser), intent(in) :: self
      type(token_type), intent(in) :: token
      character(:), allocatable :: words

      words = excerpt(self%text%content(token%first:token%last))
   end function shown

   !> Whether a comma may be meant as a decimal point: it stands between a whole number and a digit, without blanks.
   pure logical function may_be_decimal(word, rest)
      character(*), intent(in) :: word   !! the word before the comma
      character(*), intent(in) :: rest   !! what follows the word

      may_be_decimal = verify(word(scan(word, '+-') + 1:), decimal_digits) == 0 .and. index(rest, ',') == 1 .and. &
                       scan(rest(2:min(2, len(rest))), decimal_digits) == 1
   end function may_be_decimal

end module wavycon_deck_parser
