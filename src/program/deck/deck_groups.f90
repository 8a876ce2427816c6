!> The groups of a deck: the tables of their keys, and the values of the keys, which are read from the deck's text.
module wavycon_deck_groups
   use wavycon_deck_text, only: at_end, deck_text_type, has_curly_quote, is_broken_word, is_comma, is_equals, &
      is_group, is_slash, is_word, next_token, quotes, starts_entry, token_type
   use wavycon_interface_group, only: list_interface_keys
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: allowed_values, choice_value, key_index, key_type, name_length, real_value, &
      text_value, words_of
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: list_load_keys
   use wavycon_material_group, only: list_material_keys
   use wavycon_methods, only: list_method_keys
   use wavycon_nearest_name, only: did_you_mean, nearest_name, nearest_slip
   use wavycon_output_group, only: list_output_keys
   use wavycon_plain_text, only: excerpt, in_quotes, integer_text, listed, lower_case, newline, quoted, replaced
   use wavycon_problems, only: problem_list_type
   use wavycon_scene, only: scene_type
   use wavycon_scene_group, only: list_scene_keys
   use wavycon_settings, only: replaces, setting_type
   use wavycon_stress_group, only: list_stress_keys
   use wavycon_surface_group, only: list_surface_keys
   implicit none (type, external)
   private

   public :: list_keys, take_groups, unknown_key

   integer, parameter, public :: number_of_groups = 8

contains

   !> The keys of all groups, in the order in which they are documented and written.
   subroutine list_keys(scene, lists)
      type(scene_type), intent(in), target :: scene            !! the records of the groups, to which the lists point
      type(key_list), intent(out) :: lists(number_of_groups)

      integer :: i

      call list_scene_keys(scene%scene_values, lists(1))
      call list_material_keys(scene%material, lists(2))
      call list_surface_keys(scene%surface_values, lists(3))
      call list_load_keys(scene%load, lists(4))
      call list_stress_keys(scene%stress, lists(5))
      call list_interface_keys(scene%interface, lists(6))
      call list_method_keys(scene%method, lists(7))
      call list_output_keys(scene%output, lists(8))
      do i = 1, size(lists)
         call lists(i)%close()
      end do
   end subroutine list_keys

   !> Reads the values of all groups, in one pass over the text, and checks them against the grammar and the tables of
   !> keys: names, types, bounds. Checks of keys against each other follow in the modules of the groups. Text that does
   !> not fit the grammar is reported and ignored. The time is proportional to the length of the text, for any bytes.
   !>
   !> Settings of the command line come first, so that the same keys of the deck are skipped. Then the tokens of the
   !> deck are read one by one: names of groups, entries `key = values` and '/'. After a token that does not fit, others
   !> are skipped without a report up to the next group, entry or '/'.
   subroutine take_groups(text, lists, problems, settings)
      type(deck_text_type), intent(inout) :: text              !! each setting is added as a line behind the deck
      type(key_list), intent(inout) :: lists(:)                !! the keys of all groups; their records get the values
      type(problem_list_type), intent(inout) :: problems       !! problems are added
      type(setting_type), intent(in), optional :: settings(:)  !! keys set in place of those of the deck

      integer :: g                          ! number of the open group in `lists`; 0: not a known group
      integer :: s                          ! number of a setting
      logical :: is_guessed(size(lists))    ! whether the deck has a misspelt name that is near to this group's
      logical :: is_unknown                 ! whether the deck has an unknown group: it may be any that is missing
      logical :: is_lost                    ! whether tokens are skipped since one that does not fit
      logical :: quote_is_open              ! whether the open group has a quote that is not closed
      type(setting_type), allocatable :: own_settings(:)
      type(token_type) :: group             ! name of the open group; its kind is at_end if no group is open
      type(token_type) :: token             ! the next token

      allocate (own_settings(0))
      if (present(settings)) own_settings = settings
      is_guessed = .false.
      is_unknown = .false.
      is_lost = .false.
      quote_is_open = .false.
      do g = 1, size(lists)
         call lists(g)%start(text%path)
      end do
      do s = 1, size(own_settings)
         call take_setting(own_settings(s))
      end do
      g = 0
      token = next_token(text%content(:text%last_of_deck), 1)
      do while (token%kind /= at_end .and. .not. problems%is_full())
         if (token%kind == is_group) then
            if (group%kind == is_group .and. .not. quote_is_open) call problems%add(token%first, &
               "expected the '/' that closes "//shown(group)//' of line '//integer_text(text%line_of(group%first)))
            group = token
            quote_is_open = .false.
            is_lost = .false.
            call open_group(lower_case(text%content(token%first + 1:token%last)), token%first)
         else if (group%kind == is_group .and. token%kind == is_slash) then
            group%kind = at_end
            is_lost = .false.
         else if (group%kind == is_group .and. starts_entry(text%content(:text%last_of_deck), token)) then
            is_lost = .false.
            call take_entry(text%last_of_deck)
            cycle
         else if (.not. is_lost) then
            is_lost = .true.
            quote_is_open = quote_is_open .or. token%kind == is_broken_word
            if (group%kind == is_group) then
               call problems%add(token%first, "expected 'key = value', found '"//shown(token)//"'")
            else
               call problems%add(token%first, "'"//shown(token)//"' stands outside of any group: a group begins "// &
                                 "with &name and ends with '/', which is text only between quotes; "// &
                                 "'!' begins a comment")
            end if
         end if
         token = next_token(text%content(:text%last_of_deck), token%last + 1)
      end do
      ! If a quote is not closed, the '/' is likely within the quoted text: do not report it as missing.
      if (group%kind == is_group .and. token%kind == at_end .and. .not. quote_is_open) call problems%add(group%first, &
         shown(group)//" is not closed: no '/' up to the end of the deck")
      do g = 1, size(lists)
         associate (group => lists(g)%group)
            group%has_unknown = group%has_unknown .or. (is_unknown .and. group%position == 0)
            group%any_bad = group%has_unknown .or. any([(lists(g)%keys(s)%value%is_bad, s=1, size(lists(g)%keys))])
         end associate
      end do

   contains

      !> The text of a token for a message.
      pure function shown(token) result(words)
         type(token_type), intent(in) :: token
         character(:), allocatable :: words

         words = excerpt(text%content(token%first:token%last))
      end function shown

      !> Sets g to the number of a group in `lists`, or to 0 for an unknown group and for one that is given twice. A
      !> misspelt name counts as the nearest known one, so that the keys of the group are checked too, unless the deck
      !> has given that group before.
      subroutine open_group(name, position)
         character(*), intent(in) :: name   !! in lower case, without '&'
         integer, intent(in) :: position    !! position of the '&' in the text

         logical :: is_known

         g = findloc(lists%name == name, .true., dim=1)
         is_known = g > 0
         if (.not. is_known) then
            call problems%add(position, unknown_group(name, lists))
            g = nearest_name(name, lists%name)
            is_unknown = is_unknown .or. g == 0
            if (g == 0) return
         end if
         associate (first => lists(g)%group%position)
            if (first > 0 .and. first <= text%last_of_deck .and. .not. is_guessed(g)) then
               if (is_known) call problems%add(position, '&'//name//' is given twice, first in line '// &
                                               integer_text(text%line_of(first)))
               g = 0
               return
            end if
         end associate
         lists(g)%group%position = position
         is_guessed(g) = .not. is_known
      end subroutine open_group

      !> Adds a setting of the command line to the text, as a line '--set group.key=value', and takes its key.
      subroutine take_setting(setting)
         type(setting_type), intent(in) :: setting

         character(:), allocatable :: value
         integer :: position

         g = findloc(lists%name == setting%group, .true., dim=1)
         value = setting%value
         if (g > 0) then
            associate (keys => lists(g)%rows)
               ! Shells remove the quotes around a text: add them.
               if (any(keys%name == setting%key .and. (keys%kind == text_value .or. keys%kind == choice_value)) .and. &
                   scan(value, quotes) /= 1) value = quoted(value)
            end associate
         end if
         position = len(text%content) + len(' --set ') + 1
         text%content = text%content//newline//'--set '//setting%group//'.'//setting%key//'='//value
         if (g == 0) then
            call problems%add(position, unknown_group(setting%group, lists))
            return
         end if
         if (lists(g)%group%position == 0) lists(g)%group%position = position
         position = position + len(setting%group) + 1
         token = token_type(is_word, position, position + len(setting%key) - 1)
         call take_entry(len(text%content))
         if (token%kind /= at_end) call problems%add(token%first, "--set takes one key and its value, found '"// &
                                                     shown(token)//"' behind them")
      end subroutine take_setting

      !> Takes an entry `key = values`. On entry the next token is the key, on exit it is the first one behind the
      !> values. Values are bad as a whole if one of them is.
      subroutine take_entry(last)
         integer, intent(in) :: last           !! last byte of the text that may be read

         character(:), allocatable :: name, trouble
         integer :: k, most_values, position, used
         logical :: is_bad     ! whether a value cannot be used
         logical :: is_read    ! whether words are read as values; if not they are skipped
         logical :: by_blanks, by_decimal_commas   ! whether blanks alone, and such commas, separate values of a line
         real(dp), allocatable :: numbers(:)
         type(token_type) :: before, equals   ! the token before the next one; the '=' of the entry
         type(word_value) :: value

         position = token%first
         name = lower_case(text%content(position:token%last))
         call find_key(name, position, k)
         most_values = 0
         if (k > 0) most_values = lists(g)%rows(k)%most_values
         allocate (numbers(most_values))
         used = 0
         is_read = k > 0
         is_bad = .false.
         by_blanks = .false.
         by_decimal_commas = .false.
         equals = next_token(text%content(:last), token%last + 1)
         token = equals
         do
            before = token
            token = next_token(text%content(:last), before%last + 1)
            select case (token%kind)
            case (is_comma)
               if (any(before%kind == [is_equals, is_comma])) &
                  call problems%add(token%first, 'no value before this comma')
               by_decimal_commas = by_decimal_commas .or. may_be_decimal(text%content(before%first:before%last), &
                                                                         text%content(before%last + 1:last))
            case (is_equals)
               call problems%add(token%first, "'=' in place of a value")
            case (is_broken_word)
               if (has_curly_quote(text%content(token%first:token%last))) then
                  call problems%add(token%first, 'curly quotes are no quotes here: write straight ones, '' or "')
               else
                  call problems%add(token%first - 1 + scan(text%content(token%first:token%last), quotes), &
                                    'this quote is not closed on its line; within a text a quote is doubled')
               end if
               quote_is_open = .true.
               ! The broken word may hide keys behind it, so that no key of the group counts as missing.
               if (g > 0) lists(g)%group%has_unknown = .true.
               is_bad = .true.
            case (is_word)
               if (before%kind == is_word .and. before%last == token%first - 1) &
                  call problems%add(token%first, 'expected a blank or a comma behind the quote')
               if (starts_entry(text%content(:last), token)) exit
               if (.not. is_read) cycle
               by_blanks = by_blanks .or. (before%kind == is_word .and. &
                                           index(text%content(before%last:token%first), newline) == 0)
               call read_word(text%content(token%first:token%last), lists(g)%rows, k, numbers, used, value, trouble)
               if (.not. allocated(trouble)) cycle
               call problems%add(token%first, trouble)
               is_bad = .true.
               is_read = used <= size(numbers) .and. size(numbers) > 1 .and. .not. problems%is_full()
            case default
               exit
            end select
         end do
         if (k == 0) return
         if (is_bad) used = 0
         call lists(g)%take(k, position, numbers(:used), value%text)
         lists(g)%keys(k)%value%has_decimal_commas = lists(g)%rows(k)%kind == real_value .and. by_blanks .and. &
            by_decimal_commas
         if (before%last == equals%last) call problems%add(position, &
            name//' has no value: it must be '//allowed_values(lists(g)%rows(k)))
      end subroutine take_entry

      !> Finds a key of the open group. Unknown keys and keys given twice are reported.
      subroutine find_key(name, position, k)
         character(*), intent(in) :: name   !! in lower case
         integer, intent(in) :: position    !! position of the key in the text
         !> Number of the key; 0 if its values are not to be read: it was reported, the group is unknown, or a setting
         !> of the command line replaces the key.
         integer, intent(out) :: k

         character(:), allocatable :: before
         integer :: candidate, first, i, last
         logical, allocatable :: is_given(:)

         k = 0
         if (g == 0) return
         if (position <= text%last_of_deck .and. &
             any([(replaces(own_settings(s), lists(g), name), s=1, size(own_settings))])) return
         k = key_index(lists(g)%rows, name)
         if (k == 0) then
            lists(g)%group%has_unknown = .true.
            call problems%add(position, unknown_key(name, lists(g), lists))
            ! A misspelt key of the deck counts as the nearest one, without a value: that is not reported as missing
            ! too. The deck may still give the right key behind it.
            is_given = [(lists(g)%keys(i)%value%is_given, i=1, size(lists(g)%keys))]
            candidate = nearest_name(name, lists(g)%rows%name, is_given)
            if (candidate == 0 .or. position > text%last_of_deck) return
            if (.not. is_given(candidate)) call lists(g)%take(candidate, position)
            return
         end if
         associate (given => lists(g)%keys(k)%value)
            if (.not. given%is_given .or. given%is_bad) return
            before = 'in line '//integer_text(text%line_of(given%position))
            if (given%position > text%last_of_deck) then
               call text%line_bounds(given%position, first, last)
               before = 'by '//excerpt(text%content(first:last))
            end if
         end associate
         call problems%add(position, name//' is given twice, first '//before)
         k = 0
      end subroutine find_key

   end subroutine take_groups

   !> Whether a comma may be meant as a decimal point: it stands between a whole number and a digit, without blanks.
   pure logical function may_be_decimal(word, rest)
      character(*), intent(in) :: word   !! the word before the comma
      character(*), intent(in) :: rest   !! what follows the word

      character(*), parameter :: digits = '0123456789'

      may_be_decimal = verify(word(scan(word, '+-') + 1:), digits) == 0 .and. index(rest, ',') == 1 .and. &
                       scan(rest(2:min(2, len(rest))), digits) == 1
   end function may_be_decimal

   !> Reads a word of a deck as the next value of a key or, if it is 'r*value', as the next r values.
   subroutine read_word(word, rows, k, numbers, used, value, trouble)
      character(*), intent(in) :: word
      type(key_type), intent(in) :: rows(:)               !! table of the group's keys
      integer, intent(in) :: k                            !! number of the key
      real(dp), intent(inout) :: numbers(:)               !! the values; its size is the most that the key may have
      integer, intent(inout) :: used                      !! number of values so far; size(numbers) + 1: too many
      type(word_value), intent(out) :: value              !! the value of this word
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      integer :: left

      associate (key => rows(k))
         left = size(numbers) - used
         used = used + 1
         if (left > 0) call read_value(key, word, value, trouble)
         if (allocated(trouble)) return
         if (value%repeats <= left) then
            numbers(used:used + value%repeats - 1) = value%number
            used = used + value%repeats - 1
            return
         end if
         used = size(numbers) + 1
         trouble = trim(key%name)//' takes one value'
         if (key%most_values > 1) trouble = trim(key%name)//' takes at most '//integer_text(key%most_values)//' values'
         if (left > 0) then
            trouble = trouble//", got '"//excerpt(word)//"'"
         else
            trouble = trouble//", and here is one more: '"//excerpt(word)//"'"
            if (key_index(rows, lower_case(word)) > 0) trouble = trouble//"; is a '=' missing behind it?"
         end if
      end associate
   end subroutine read_word

   !> The message for an unknown group.
   pure function unknown_group(name, lists) result(words)
      character(*), intent(in) :: name  !! in lower case, without '&'
      type(key_list), intent(in) :: lists(:)
      character(:), allocatable :: words

      words = "there is no group '"//excerpt('&'//name)//"'"//did_you_mean(name, lists%name, "'&", "'", &
                                                                         '; the groups are '//listed(lists%name))
      if (name == '') words = "expected the name of a group right behind the '&'"
   end function unknown_group

   !> The message for a key that the group does not have.
   pure function unknown_key(key, list, lists) result(words)
      character(*), intent(in) :: key                !! in lower case
      type(key_list), intent(in) :: list, lists(:)   !! keys of the group; keys of all groups
      character(:), allocatable :: words

      character(:), allocatable :: otherwise   ! words for a key that is near to none of the group
      integer :: bracket, i, slip
      logical :: has_key(size(lists)), is_given(size(list%keys))

      bracket = index(key//'(', '(')
      is_given = [(list%keys(i)%value%is_given, i=1, size(list%keys))]
      has_key = [(key_index(lists(i)%rows, key) > 0, i=1, size(lists))]
      if (any(has_key)) then
         words = key//' belongs to &'//listed(pack(lists%name, has_key), ' and &')//', not to &'//trim(list%name)// &
                 did_you_mean(key, pack(list%rows%name, .not. is_given), "'", "'")
      else if (key_index(list%rows, key(:bracket - 1)) > 0) then
         words = "elements are not given one by one: write '"//key(:bracket - 1)//" = value, value, ...'"
      else
         otherwise = related_keys(key, list%rows)
         do i = size(lists), 1, -1
            slip = nearest_slip(key, lists(i)%rows%name)
            if (slip > 0) otherwise = "; did you mean '"//trim(lists(i)%rows(slip)%name)//"' of &"// &
                                      trim(lists(i)%name)//'?'
         end do
         words = "there is no key '"//excerpt(key)//"' in &"//trim(list%name)// &
                 did_you_mean(key, list%rows%name, "'", "'", otherwise, is_given)
      end if
   end function unknown_key

   !> Words for an unknown key that has no similar name: which keys may be meant. The words of a name are what stands
   !> between its underscores. Related are keys whose whole name is among the words of the unknown key; if there are
   !> none, keys whose meaning contains the longest of these words. If no key or too many keys are related, all keys are
   !> listed.
   pure function related_keys(key, keys) result(words)
      character(*), intent(in) :: key       !! in lower case
      type(key_type), intent(in) :: keys(:)   !! table of the group's keys
      character(:), allocatable :: words

      !> Most letters of an unknown key, most related keys that are named, fewest letters of a word that is compared.
      integer, parameter :: longest = 40, most_related = 4, shortest = 4
      character(:), allocatable :: longest_word
      character(longest) :: name_words   ! the words of the unknown key with blanks between them
      character(name_length), allocatable :: split(:)
      integer :: i
      logical :: is_related(size(keys))

      words = '; its keys are '//listed(keys%name)
      if (len(key) > longest) return
      name_words = replaced(key, '_', ' ')
      if (name_words == '') return
      allocate (split, source=words_of(name_words))
      longest_word = trim(split(maxloc(len_trim(split), dim=1)))
      is_related = [(len_trim(keys(i)%name) >= shortest .and. &
                     index(' '//trim(name_words)//' ', ' '//trim(keys(i)%name)//' ') > 0, i=1, size(keys))]
      if (.not. any(is_related)) &
         is_related = [(len(longest_word) >= shortest .and. index(lower_case(keys(i)%meaning), longest_word) > 0, &
                        i=1, size(keys))]
      if (any(is_related) .and. count(is_related) <= most_related) &
         words = '; did you mean '//listed(in_quotes(pack(keys%name, is_related)), ' or ')//'?'
   end function related_keys

end module wavycon_deck_groups
