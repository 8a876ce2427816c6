!> Matches the groups and keys of a scanned deck with the tables, and reads the values.
module wavycon_deck_groups
   use wavycon_deck_scanner, only: entry_type, scan_deck, scan_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_deck_tokens, only: is_broken_word, is_word
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, group_names, key_group_type, key_index, key_names, key_type
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean, nearest_name
   use wavycon_plain_text, only: excerpt, integer_text, listed, lower_case, newline
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: group_name, read_group_text, take_groups, word_of

contains

   !> Reads the values of all groups and checks them against the tables: names, types, bounds, required keys. Checks
   !> of keys against each other follow in the modules of the groups.
   subroutine take_groups(text, scan, tables, groups, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      type(group_values), intent(out) :: groups(size(tables))  !! one for each table
      type(problem_list_type), intent(inout) :: problems

      integer :: e, g, i, table_of(size(scan%groups))

      call match_groups(text, scan, tables, table_of, problems)
      do i = 1, size(tables)
         call groups(i)%start(tables(i), text%path)
         g = findloc(table_of, i, dim=1)
         if (g > 0) then
            groups(i)%place = scan%tokens(scan%groups(g))%first
            call take_keys(text, scan, tables, pack([(e, e=1, size(scan%entries))], scan%entries%group == g), &
                           groups(i), problems)
         end if
         call report_missing(groups(i), problems)
      end do
   end subroutine take_groups

   !> Reads the keys of one group from a text that holds nothing else, without '&name' and '/', and checks them against
   !> the table, as those of a deck.
   subroutine read_group_text(table, keys, values, text, problems)
      type(key_group_type), intent(in) :: table
      character(*), intent(in) :: keys                     !! such as "solver = 'grid', accuracy = 1e-4"
      type(group_values), intent(out) :: values
      type(deck_text_type), intent(out) :: text            !! to which the places of the problems refer
      type(problem_list_type), intent(inout) :: problems

      type(group_values) :: groups(1)
      type(key_group_type) :: tables(1)
      type(scan_type) :: scan

      ! The keys may end in a comment, so that the '/' needs a line of its own.
      text = deck_text_type('&'//trim(table%name), '&'//trim(table%name)//' '//keys//newline//'/')
      tables(1) = table
      call scan_deck(text, scan, problems)
      call take_groups(text, scan, tables, groups, problems)
      values = groups(1)
   end subroutine read_group_text

   !> Finds the table of each group of the deck. It is 0 for an unknown group and for one that is given twice; both are
   !> reported.
   subroutine match_groups(text, scan, tables, table_of, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      integer, intent(out) :: table_of(:)
      type(problem_list_type), intent(inout) :: problems

      integer :: first_of_table(size(tables)), g, i
      character(:), allocatable :: name

      table_of = 0
      first_of_table = 0
      do g = 1, size(scan%groups)
         name = group_name(text, scan, g)
         i = findloc(tables%name == name, .true., dim=1)
         if (i == 0) cycle
         if (first_of_table(i) == 0) then
            first_of_table(i) = g
            table_of(g) = i
         else
            call problems%add(place(g), '&'//name//' is given twice, first in line '// &
               integer_text(text%line_of(place(first_of_table(i)))))
         end if
      end do

      do g = 1, size(scan%groups)
         name = group_name(text, scan, g)
         if (any(tables%name == name)) cycle
         call problems%add(place(g), unknown_group(name, tables))
         i = nearest_name(name, group_names(tables))
         if (i == 0) cycle
         if (first_of_table(i) > 0) cycle
         ! A misspelt group: its keys are checked too, and the group is not reported as missing.
         first_of_table(i) = g
         table_of(g) = i
      end do

   contains

      pure integer function place(g)
         integer, intent(in) :: g

         place = scan%tokens(scan%groups(g))%first
      end function place

   end subroutine match_groups

   !> The message for an unknown group.
   pure function unknown_group(name, tables) result(words)
      character(*), intent(in) :: name  !! without '&'
      type(key_group_type), intent(in) :: tables(:)
      character(:), allocatable :: words

      if (name == '') then
         words = "expected the name of a group right behind the '&'"
      else
         words = "there is no group '"//excerpt('&'//name)//"'"// &
            did_you_mean(name, group_names(tables), "'&", "'")
         if (nearest_name(name, group_names(tables)) == 0) &
            words = words//'; the groups are '//listed(group_names(tables))
      end if
   end function unknown_group

   !> Takes the keys of a group; reports unknown keys and those given twice.
   subroutine take_keys(text, scan, tables, entries, values, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      integer, intent(in) :: entries(:)              !! numbers of the group's entries
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: first, key
      integer :: e, i, k

      do i = 1, size(entries)
         e = entries(i)
         key = word_of(text, scan, scan%entries(e)%key)
         k = key_index(values%table%keys, key)
         if (k == 0) cycle
         if (values%has(key)) then
            first = 'in line '//integer_text(text%line_of(values%place_of(key)))
            if (text%is_in_option(values%place_of(key))) first = 'by '//excerpt(text%option_at(values%place_of(key)))
            call problems%add(place(e), key//' is given twice, first '//first)
            call values%take(key, values%place_of(key))
         else
            call take_value(text, scan, scan%entries(e), values%table%keys(k), values, problems)
         end if
      end do

      do i = 1, size(entries)
         e = entries(i)
         key = word_of(text, scan, scan%entries(e)%key)
         if (key_index(values%table%keys, key) > 0) cycle
         call problems%add(place(e), unknown_key(key, values%table, tables))
         ! A misspelt key is not reported as missing too.
         k = nearest_name(key, key_names(values%table%keys))
         if (k == 0) cycle
         key = trim(values%table%keys(k)%name)
         if (.not. values%has(key)) call values%take(key, place(e))
      end do

   contains

      pure integer function place(e)
         integer, intent(in) :: e

         place = scan%tokens(scan%entries(e)%key)%first
      end function place

   end subroutine take_keys

   !> The message for a key that the group does not have.
   pure function unknown_key(key, table, tables) result(words)
      character(*), intent(in) :: key
      type(key_group_type), intent(in) :: table, tables(:)
      character(:), allocatable :: words

      integer :: bracket, i

      if (key == table%former_key) then
         words = key//' is no longer a key: give '//trim(table%in_its_place)
         return
      end if
      bracket = index(key, '(')
      if (bracket > 1) then
         if (key_index(table%keys, key(:bracket - 1)) > 0) then
            words = "elements are not given one by one: write '"//key(:bracket - 1)//" = value, value, ...'"
            return
         end if
      end if
      do i = 1, size(tables)
         if (key_index(tables(i)%keys, key) == 0) cycle
         words = key//' belongs to &'//trim(tables(i)%name)//', not to &'//trim(table%name)
         return
      end do
      words = "there is no key '"//excerpt(key)//"' in &"//trim(table%name)
      words = words//did_you_mean(key, key_names(table%keys), "'", "'")
      if (nearest_name(key, key_names(table%keys)) == 0) &
         words = words//'; its keys are '//listed(key_names(table%keys))
   end function unknown_key

   !> Reports a required group or required keys that are missing.
   subroutine report_missing(values, problems)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems

      integer :: k

      associate (table => values%table)
         if (values%place == 0) then
            if (table%required) call problems%add(0, 'the group &'//trim(table%name)//' ('// &
               trim(table%meaning)//') is missing')
            return
         end if
         do k = 1, size(table%keys)
            associate (key => table%keys(k))
               if (key%required .and. .not. values%has(key%name)) call problems%add(values%place, &
                  '&'//trim(table%name)//' needs '//trim(key%name)//' = '//allowed_values(key))
            end associate
         end do
      end associate
   end subroutine report_missing

   !> Reads the value of a key, or reports what is wrong with it.
   subroutine take_value(text, scan, entry, key, values, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(entry_type), intent(in) :: entry
      type(key_type), intent(in) :: key
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: trouble
      logical :: is_good
      real(dp) :: numbers(key%most_values)
      integer :: place, repeats, t, used
      type(word_value) :: value

      place = scan%tokens(entry%key)%first
      is_good = .true.
      used = 0
      do t = entry%first_value, entry%last_value
         associate (token => scan%tokens(t), word => text%content(scan%tokens(t)%first:scan%tokens(t)%last))
            if (token%kind == is_broken_word) is_good = .false.
            if (token%kind /= is_word) cycle
            if (used >= key%most_values) then
               call problems%add(token%first, one_too_many(key, values%table, word))
               is_good = .false.
               exit
            end if
            call read_value(key, word, value, trouble)
            repeats = value%repeats
            if (.not. allocated(trouble) .and. repeats > key%most_values - used) &
               trouble = trim(key%name)//' takes '//at_most(key%most_values)//", got '"//excerpt(word)//"'"
            if (allocated(trouble)) then
               call problems%add(token%first, trouble)
               is_good = .false.
               if (problems%is_full() .or. key%most_values == 1) exit
               repeats = 1
            end if
            numbers(used + 1:used + repeats) = value%number
            used = used + repeats
         end associate
      end do
      if (entry%last_value < entry%first_value) call problems%add(place, trim(key%name)// &
         ' has no value: it must be '//allowed_values(key))
      if (is_good .and. used > 0) then
         call values%take(trim(key%name), place, numbers(:used), value%text)
      else
         call values%take(trim(key%name), place)
      end if
   end subroutine take_value

   !> The message for more values than a key takes.
   pure function one_too_many(key, table, word) result(words)
      type(key_type), intent(in) :: key
      type(key_group_type), intent(in) :: table
      character(*), intent(in) :: word   !! as in the deck
      character(:), allocatable :: words

      words = trim(key%name)//' takes '//at_most(key%most_values)//", and here is one more: '"// &
         excerpt(word)//"'"
      if (key_index(table%keys, lower_case(word)) > 0) words = words//"; is a '=' missing behind it?"
   end function one_too_many

   pure function at_most(number) result(words)
      integer, intent(in) :: number
      character(:), allocatable :: words

      words = 'one value'
      if (number > 1) words = 'at most '//integer_text(number)//' values'
   end function at_most

   !> The name of a group in lower case, without the '&' that it has in a deck.
   pure function group_name(text, scan, g) result(name)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      integer, intent(in) :: g
      character(:), allocatable :: name

      name = word_of(text, scan, scan%groups(g))
      if (index(name, '&') == 1) name = name(2:)
   end function group_name

   !> The text of a token in lower case.
   pure function word_of(text, scan, t) result(word)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      integer, intent(in) :: t
      character(:), allocatable :: word

      word = lower_case(text%content(scan%tokens(t)%first:scan%tokens(t)%last))
   end function word_of

end module wavycon_deck_groups
