!> Keys that the command line sets: `--set surface.amplitude=2e-6`. They are read and checked as if the deck gave them.
module wavycon_settings
   use wavycon_deck_groups, only: group_name, word_of
   use wavycon_deck_scanner, only: entry_type, read_values, scan_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_deck_tokens, only: is_group, is_word, quotes, token_type, tokenise
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_value, key_group_type, key_index, text_value
   use wavycon_plain_text, only: excerpt, integer_text, is_printable, lower_case, quoted, unquoted
   use wavycon_problems, only: problem_list_type
   use wavycon_scene_group, only: longest_name, name_letters
   implicit none (type, external)
   private

   public :: setting_type, read_setting, add_settings, name_case

   !> group.key=value
   type :: setting_type
      character(:), allocatable :: group, key   !! lower case
      character(:), allocatable :: value        !! as given; texts with or without quotes
   end type setting_type

   character(*), parameter :: option = '--set '

contains

   !> Reads 'group.key=value'. Names and value are checked later, with each deck.
   pure subroutine read_setting(word, setting, trouble)
      character(*), intent(in) :: word
      type(setting_type), intent(out) :: setting
      character(:), allocatable, intent(out) :: trouble   !! message of the problem; not allocated if there is none

      integer :: equals, point

      equals = index(word, '=')
      point = index(word(:max(equals - 1, 0)), '.')
      if (point < 2 .or. equals - point < 2) then
         trouble = "--set needs group.key=value, such as surface.amplitude=2e-6, got '"//excerpt(word)//"'"
      else if (.not. is_printable(word)) then
         trouble = "--set: '"//excerpt(word)//"' must be ASCII or UTF-8 text without control characters"
      else
         setting%group = lower_case(trim(adjustl(word(:point - 1))))
         setting%key = lower_case(trim(adjustl(word(point + 1:equals - 1))))
         setting%value = trim(adjustl(word(equals + 1:)))
      end if
   end subroutine read_setting

   !> Puts settings in the place of the deck's own entries of the same keys, and of those that contradict them.
   subroutine add_settings(settings, tables, text, scan, problems)
      type(setting_type), intent(in) :: settings(:)
      type(key_group_type), intent(in) :: tables(:)
      type(deck_text_type), intent(inout) :: text   !! each setting is added as a line
      type(scan_type), intent(inout) :: scan
      type(problem_list_type), intent(inout) :: problems

      integer :: e, i, own_entries

      own_entries = size(scan%entries)
      do i = 1, size(settings)
         do e = 1, own_entries
            associate (entry => scan%entries(e))
               if (entry%group == 0) cycle
               if (group_name(text, scan, entry%group) /= settings(i)%group) cycle
               if (replaces(settings(i), word_of(text, scan, entry%key), tables)) entry%group = 0
            end associate
         end do
         call add_entry(settings(i), tables, text, scan, problems)
      end do
   end subroutine add_settings

   !> Adds a setting as an entry of its group, and the group if the deck does not have it.
   subroutine add_entry(setting, tables, text, scan, problems)
      type(setting_type), intent(in) :: setting
      type(key_group_type), intent(in) :: tables(:)
      type(deck_text_type), intent(inout) :: text
      type(scan_type), intent(inout) :: scan
      type(problem_list_type), intent(inout) :: problems

      type(entry_type) :: entry
      type(token_type), allocatable :: tokens(:)
      integer :: first, g, number, t
      logical :: quote_is_open

      call text%add_option(option//setting%group//'.'//setting%key//'='//deck_value(setting, tables))
      first = text%line_start(size(text%line_start)) + len(option)
      do g = 1, size(scan%groups)
         if (group_name(text, scan, g) == setting%group) exit
      end do
      if (g > size(scan%groups)) then
         scan%tokens = [scan%tokens, token_type(is_group, first, first + len(setting%group) - 1)]
         scan%groups = [scan%groups, size(scan%tokens)]
      end if
      first = first + len(setting%group) + 1
      scan%tokens = [scan%tokens, token_type(is_word, first, first + len(setting%key) - 1)]
      entry%group = g
      entry%key = size(scan%tokens)

      first = first + len(setting%key)
      call tokenise(text%content(first:), number)
      allocate (tokens(number))
      call tokenise(text%content(first:), number, tokens)
      tokens%first = tokens%first + first - 1
      tokens%last = tokens%last + first - 1
      scan%tokens = [scan%tokens, tokens]
      entry%first_value = entry%key + 2
      t = entry%first_value
      quote_is_open = .false.
      call read_values(text, scan%tokens, t, quote_is_open, problems)
      entry%last_value = t - 1
      if (t <= size(scan%tokens)) call problems%add(scan%tokens(t)%first, &
         "--set takes one key and its value, found '"// &
         excerpt(text%content(scan%tokens(t)%first:scan%tokens(t)%last))//"' behind them")
      scan%entries = [scan%entries, entry]
   end subroutine add_entry

   !> The value as a deck would give it: a text without quotes, which shells remove, gets them.
   pure function deck_value(setting, tables) result(value)
      type(setting_type), intent(in) :: setting
      type(key_group_type), intent(in) :: tables(:)
      character(:), allocatable :: value

      integer :: g, k

      value = setting%value
      g = findloc(tables%name == setting%group, .true., dim=1)
      if (g == 0) return
      k = key_index(tables(g)%keys, setting%key)
      if (k == 0) return
      if (all(tables(g)%keys(k)%kind /= [choice_value, text_value])) return
      if (scan(value, quotes) /= 1) value = quoted(value)
   end function deck_value

   !> Whether a setting takes the place of a key of the same group: of itself; of a key that gives the same in another
   !> way; where it selects a kind of surface or a solver, of the keys that others read. Misspelt keys of the deck stay
   !> and are reported.
   pure logical function replaces(setting, key, tables)
      type(setting_type), intent(in) :: setting
      character(*), intent(in) :: key
      type(key_group_type), intent(in) :: tables(:)

      integer :: chosen, g, k, own

      replaces = key == setting%key
      g = findloc(tables%name == setting%group, .true., dim=1)
      if (replaces .or. g == 0) return
      associate (keys => tables(g)%keys)
         own = key_index(keys, setting%key)
         k = key_index(keys, key)
         if (own == 0 .or. k == 0) return
         if (setting%key == tables(g)%selector) then
            chosen = findloc(keys(own)%choices(:keys(own)%number_of_choices) == plain_value(setting), .true., dim=1)
            if (chosen > 0) replaces = any(keys(k)%read_by) .and. .not. keys(k)%read_by(chosen)
         else
            replaces = min(keys(own)%way, keys(k)%way) > 0 .and. keys(own)%way /= keys(k)%way
         end if
      end associate
   end function replaces

   !> The value without quotes.
   pure function plain_value(setting) result(value)
      type(setting_type), intent(in) :: setting
      character(:), allocatable :: value

      value = setting%value
      if (len(value) > 1 .and. scan(value, quotes) == 1) value = unquoted(value)
   end function plain_value

   !> Adds the keys and values that are set to the name of the case, so that runs of a deck with different values do not
   !> replace each other's files. Not if the name itself is set; keys of &scene and &output are left out, which change
   !> no number.
   subroutine name_case(scene, settings, problems)
      type(group_values), intent(inout) :: scene   !! the group &scene, checked
      type(setting_type), intent(in) :: settings(:)
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: name, value
      integer :: i, k

      name = scene%text('case')
      do i = 1, size(settings)
         select case (settings(i)%group)
         case ('scene')
            if (settings(i)%key == 'case') return
         case ('output')
            cycle
         case default
            value = plain_value(settings(i))
            do k = 1, len(value)
               if (index(name_letters, value(k:k)) == 0) value(k:k) = '_'
            end do
            name = name//'-'//settings(i)%key//'-'//value
         end select
      end do
      if (len(name) > longest_name) then
         call problems%add(0, 'with the values of --set the name of the case would be longer than '// &
                           integer_text(longest_name)//' bytes: give one by --set scene.case=NAME')
      else
         call scene%set('case', name)
      end if
   end subroutine name_case

end module wavycon_settings
