!> Matches the groups and keys of a deck's text with the tables, and reads the values.
module wavycon_deck_groups
   use wavycon_deck_scanner, only: at_end, is_broken_word, is_group, is_word, next_part, next_token, &
      part_type, read_entry, scan_type, token_type
   use wavycon_deck_tables, only: deck_tables
   use wavycon_deck_text, only: deck_text_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, key_group_type, key_index, key_type
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean, nearest_name
   use wavycon_plain_text, only: excerpt, integer_text, listed, lower_case, newline
   use wavycon_problems, only: problem_list_type
   use wavycon_settings, only: deck_value, replaces, setting_type
   implicit none (type, external)
   private

   public :: read_group_text, take_groups

contains

   !> Reads the values of all groups and checks them against the tables: names, types, bounds. Checks of keys against
   !> each other follow in the modules of the groups.
   subroutine take_groups(text, tables, groups, problems, settings)
      type(deck_text_type), intent(inout) :: text              !! each setting is added as a line
      type(key_group_type), intent(in), target :: tables(:)    !! that stay as long as the values
      type(group_values), intent(out) :: groups(size(tables))  !! one for each table
      type(problem_list_type), intent(inout) :: problems
      type(setting_type), intent(in), optional :: settings(:)  !! keys set in place of those of the deck

      character(:), allocatable :: key
      type(part_type) :: part
      type(scan_type) :: scan
      type(setting_type), allocatable :: own_settings(:)
      logical :: is_guessed(size(tables))   ! of a misspelt name
      integer :: i, s

      allocate (own_settings(0))
      if (present(settings)) own_settings = settings
      is_guessed = .false.
      do i = 1, size(tables)
         call groups(i)%start(tables(i), text%path)
      end do
      do s = 1, size(own_settings)
         call take_setting(own_settings(s))
      end do
      i = 0
      do
         call next_part(text, scan, part, problems)
         if (part%name%kind == at_end) exit
         if (part%name%kind == is_group) then
            call open_group(lower_case(text%content(part%name%first + 1:part%name%last)), part%name%first)
         else if (i > 0) then
            key = lower_case(text%content(part%name%first:part%name%last))
            if (any([(replaces(own_settings(s), tables(i), key), s=1, size(own_settings))])) cycle
            call take_key(text, part, key, tables, groups(i), problems)
         end if
      end do

   contains

      !> Sets i to the number of a group's table; to 0 for an unknown group and for one that is given twice. The keys of
      !> a group whose name is misspelt are checked too, unless the deck has given the one that is meant.
      subroutine open_group(name, place)
         character(*), intent(in) :: name
         integer, intent(in) :: place

         logical :: is_known

         i = findloc(tables%name == name, .true., dim=1)
         is_known = i > 0
         if (.not. is_known) then
            call problems%add(place, unknown_group(name, tables))
            i = nearest_name(name, tables%name)
            if (i == 0) return
         end if
         if (groups(i)%place > 0 .and. groups(i)%place <= text%own .and. .not. is_guessed(i)) then
            if (is_known) call problems%add(place, '&'//name//' is given twice, first in line '// &
                                            integer_text(text%line_of(groups(i)%place)))
            i = 0
            return
         end if
         groups(i)%place = place
         is_guessed(i) = .not. is_known
      end subroutine open_group

      !> Takes a key that the command line sets.
      subroutine take_setting(setting)
         type(setting_type), intent(in) :: setting

         character(:), allocatable :: value
         integer :: place
         logical :: quote_is_open
         type(token_type) :: token

         i = findloc(tables%name == setting%group, .true., dim=1)
         value = setting%value
         if (i > 0) value = deck_value(setting, tables(i))
         place = len(text%content) + len(' --set ') + 1
         call text%add_option('--set '//setting%group//'.'//setting%key//'='//value)
         if (i == 0) then
            call problems%add(place, unknown_group(setting%group, tables))
            return
         end if
         if (groups(i)%place == 0) groups(i)%place = place
         place = place + len(setting%group) + 1
         token = token_type(is_word, place, place + len(setting%key) - 1)
         quote_is_open = .false.
         call read_entry(text%content, token, part, quote_is_open, problems)
         call take_key(text, part, setting%key, tables, groups(i), problems)
         token = next_token(text%content, part%last + 1)
         if (token%kind /= at_end) call problems%add(token%first, "--set takes one key and its value, found '"// &
            excerpt(text%content(token%first:token%last))//"' behind them")
      end subroutine take_setting

   end subroutine take_groups

   !> Reads the keys of one group from a text that holds nothing else, without '&name' and '/', and checks them against
   !> the table, as those of a deck.
   subroutine read_group_text(group, keys, values, text, problems)
      integer, intent(in) :: group                         !! a number of wavycon_deck_tables
      character(*), intent(in) :: keys                     !! such as "solver = 'grid', accuracy = 1e-4"
      type(group_values), intent(out) :: values
      type(deck_text_type), intent(out) :: text            !! to which the places of the problems refer
      type(problem_list_type), intent(inout) :: problems

      type(group_values) :: groups(1)
      type(key_group_type), pointer :: tables(:)
      character(:), allocatable :: name

      tables => deck_tables()
      ! The keys may end in a comment, so that the '/' needs a line of its own.
      name = '&'//trim(tables(group)%name)
      text = deck_text_type(name, name//' '//keys//newline//'/')
      call take_groups(text, tables(group:group), groups, problems)
      values = groups(1)
   end subroutine read_group_text

   !> The message for an unknown group.
   pure function unknown_group(name, tables) result(words)
      character(*), intent(in) :: name  !! without '&'
      type(key_group_type), intent(in) :: tables(:)
      character(:), allocatable :: words

      words = "there is no group '"//excerpt('&'//name)//"'"//did_you_mean(name, tables%name, "'&", "'", &
                                                                         '; the groups are '//listed(tables%name))
      if (name == '') words = "expected the name of a group right behind the '&'"
   end function unknown_group

   !> Takes a key of a group; reports unknown keys and those given twice.
   subroutine take_key(text, entry, key, tables, values, problems)
      type(deck_text_type), intent(in) :: text
      type(part_type), intent(in) :: entry
      character(*), intent(in) :: key                !! its name in lower case
      type(key_group_type), intent(in) :: tables(:)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: first
      integer :: k

      k = key_index(values%table%keys, key)
      if (k == 0) then
         call problems%add(entry%name%first, unknown_key(key, values%table, tables))
         ! A misspelt key is not reported as missing too, and the right one may follow.
         k = nearest_name(key, values%table%keys%name)
         if (k == 0) return
         if (.not. values%has(values%table%keys(k)%name)) &
            call values%take(values%table%keys(k)%name, entry%name%first)
      else if (values%has(key) .and. .not. values%is_bad(key)) then
         first = 'in line '//integer_text(text%line_of(values%place_of(key)))
         if (values%place_of(key) > text%own) first = 'by '//excerpt(text%line_at(values%place_of(key)))
         call problems%add(entry%name%first, key//' is given twice, first '//first)
      else
         call take_value(text, entry, values%table%keys(k), values, problems)
      end if
   end subroutine take_key

   !> The message for a key that the group does not have.
   pure function unknown_key(key, table, tables) result(words)
      character(*), intent(in) :: key
      type(key_group_type), intent(in) :: table, tables(:)
      character(:), allocatable :: words

      integer :: bracket, i

      bracket = index(key//'(', '(')
      do i = 1, size(tables)
         if (key_index(tables(i)%keys, key) == 0) cycle
         words = key//' belongs to &'//trim(tables(i)%name)//', not to &'//trim(table%name)
         return
      end do
      if (key_index(table%keys, key(:bracket - 1)) > 0) then
         words = "elements are not given one by one: write '"//key(:bracket - 1)//" = value, value, ...'"
      else
         words = "there is no key '"//excerpt(key)//"' in &"//trim(table%name)// &
                 did_you_mean(key, table%keys%name, "'", "'", '; its keys are '//listed(table%keys%name))
      end if
   end function unknown_key

   !> Reads the value of a key, or reports what is wrong with it.
   subroutine take_value(text, entry, key, values, problems)
      type(deck_text_type), intent(in) :: text
      type(part_type), intent(in) :: entry
      type(key_type), intent(in) :: key
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: most, trouble
      logical :: is_good
      real(dp) :: numbers(key%most_values)
      integer :: repeats, used
      type(token_type) :: token
      type(word_value) :: value

      most = 'one value'
      if (key%most_values > 1) most = 'at most '//integer_text(key%most_values)//' values'
      is_good = .true.
      used = 0
      token%last = entry%values - 1
      do
         token = next_token(text%content(:entry%last), token%last + 1)
         if (token%kind == at_end) exit
         if (token%kind == is_broken_word) is_good = .false.
         if (token%kind /= is_word) cycle
         associate (word => text%content(token%first:token%last))
            repeats = 1
            if (used >= key%most_values) then
               trouble = trim(key%name)//' takes '//most//", and here is one more: '"// &
                         excerpt(word)//"'"
               if (key_index(values%table%keys, lower_case(word)) > 0) &
                  trouble = trouble//"; is a '=' missing behind it?"
            else
               call read_value(key, word, value, trouble)
               if (.not. allocated(trouble)) repeats = value%repeats
               if (repeats > key%most_values - used) &
                  trouble = trim(key%name)//' takes '//most//", got '"//excerpt(word)//"'"
            end if
            if (allocated(trouble)) then
               call problems%add(token%first, trouble)
               is_good = .false.
               if (problems%is_full() .or. repeats > key%most_values - used .or. key%most_values == 1) exit
            end if
            numbers(used + 1:used + repeats) = value%number
            used = used + repeats
         end associate
      end do
      if (is_good .and. used > 0) then
         call values%take(key%name, entry%name%first, numbers(:used), value%text)
      else
         call values%take(key%name, entry%name%first)
      end if
      if (entry%last < entry%values) call problems%add(entry%name%first, trim(key%name)// &
         ' has no value: it must be '//allowed_values(key))
   end subroutine take_value

end module wavycon_deck_groups
