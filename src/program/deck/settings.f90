!> Keys that the command line sets: `--set surface.amplitude=2e-6`. Their values are read and checked as if the deck
!> gave them.
module wavycon_settings
   use wavycon_deck_text, only: quotes
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: is_read, key_index, name_length, words_of
   use wavycon_plain_text, only: excerpt, integer_text, is_printable, lower_case, unquoted
   use wavycon_scene_groups, only: scene_group
   use wavycon_scene_group, only: longest_name, name_letters
   implicit none (type, external)
   private

   public :: setting_type, read_setting, replaces, name_case

   !> A setting, 'group.key=value' on the command line.
   type :: setting_type
      character(:), allocatable :: group, key   !! lower case
      character(:), allocatable :: value        !! value as on the command line; texts with or without quotes
   end type setting_type

contains

   !> Reads a setting. Names and value are checked later, with each deck.
   pure subroutine read_setting(word, setting, trouble)
      character(*), intent(in) :: word                    !! 'group.key=value'
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

   !> Whether a setting replaces a key of a deck. A setting replaces three kinds of keys: the same key; keys that give
   !> the same quantity in another way; if the setting selects a kind of surface or a solver, the keys that this kind or
   !> solver does not read. A key that only adds to a way, as layer_nu does to e_star, replaces no other way: the deck
   !> would lose the quantity. Misspelt keys of the deck are not replaced, so that they are reported.
   pure logical function replaces(setting, table, key)
      type(setting_type), intent(in) :: setting
      type(key_list), intent(in) :: table         !! keys of the group in which the key of the deck stands
      character(*), intent(in) :: key             !! name of the key of the deck

      integer :: i, k, own
      logical :: adds   ! whether the key only adds to its way: it needs one of another quantity
      character(name_length), allocatable :: needs(:)

      replaces = setting%group == table%name .and. key == setting%key
      if (replaces .or. setting%group /= table%name) return
      own = key_index(table%rows, setting%key)
      k = key_index(table%rows, key)
      if (own == 0 .or. k == 0) return
      associate (keys => table%rows)
         needs = words_of(keys(own)%needs)
         adds = any([(any(keys%name == needs(i) .and. keys%way == 0), i=1, size(needs))])
         replaces = keys(own)%way > 0 .and. keys(own)%way/100 == keys(k)%way/100 .and. &
                    keys(own)%way /= keys(k)%way .and. .not. adds
         if (setting%key == table%selector) replaces = any(words_of(keys(own)%choices) == plain_value(setting)) &
                                                       .and. .not. is_read(keys(k), plain_value(setting))
      end associate
   end function replaces

   !> The value of a setting without quotes.
   pure function plain_value(setting) result(value)
      type(setting_type), intent(in) :: setting
      character(:), allocatable :: value

      value = setting%value
      if (len(value) > 1 .and. scan(value, quotes) == 1) value = unquoted(value)
   end function plain_value

   !> Adds the keys and values of settings to the name of the case, so that runs of a deck with different values do not
   !> replace each other's files. If a setting gives the name itself, nothing is added. Settings of &scene and &output
   !> are left out, because they change no number.
   subroutine name_case(scene, settings)
      type(scene_group), intent(inout) :: scene   !! the values of &scene after check_scene_group
      type(setting_type), intent(in) :: settings(:)

      character(:), allocatable :: name, value
      integer :: i, k

      name = scene%case%text
      do i = 1, size(settings)
         if (settings(i)%group == 'scene' .and. settings(i)%key == 'case') return
         if (any(settings(i)%group == ['scene ', 'output'])) cycle
         value = plain_value(settings(i))
         do k = 1, len(value)
            if (index(name_letters, value(k:k)) == 0) value(k:k) = '_'
         end do
         name = name//'-'//settings(i)%key//'-'//value
      end do
      if (len(name) > longest_name) then
         call scene%problems%add(0, 'with the values of --set the name of the case would be longer than '// &
                           integer_text(longest_name)//' bytes: give one by --set scene.case=NAME')
      else
         call scene%case%set(text=name)
      end if
   end subroutine name_case

end module wavycon_settings
