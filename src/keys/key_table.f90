!> Tables of the keys of each namelist group: name, type, bounds, default, unit and meaning.
!>
!> Checks of decks, the key reference of --help and the comments of resolved decks all follow from these tables.
module wavycon_key_table
   use wavycon_constants, only: largest_number
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, in_quotes, integer_text, listed, short_number
   implicit none (type, external)
   private

   public :: key_type, key_group_type, real_key, integer_key, logical_key, text_key, choice_key
   public :: key_group, key_index, key_names, group_names, allowed_values, number_text

   !> Types of values.
   integer, parameter, public :: real_value = 1, integer_value = 2, logical_value = 3, text_value = 4, &
      choice_value = 5

   integer, parameter :: name_length = 24, choice_length = 12
   integer, parameter, public :: most_choices = 12
   integer, parameter, public :: meaning_length = 640

   type :: key_type
      character(name_length) :: name = ''
      integer :: kind = real_value
      character(meaning_length) :: meaning = ''
      !> As in a deck; in words if it depends on other keys: the group's check then sets it. Empty: no default.
      character(40) :: default = ''
      character(24) :: unit = ''                         !! '-' if dimensionless; empty for texts, flags and counts
      logical :: required = .false.                      !! whether a deck must give the key wherever it applies
      !> Keys of a group that give the same in different ways have different numbers here: --set of one of them replaces
      !> the others. 0: there is no other way.
      integer :: way = 0
      real(dp) :: least = -largest_number, most = largest_number
      logical :: above = .false., below = .false.        !! whether `least` and `most` themselves are excluded
      integer :: most_values = 1                         !! more than 1: a list
      integer :: longest = 0                             !! bytes of a text
      logical :: may_be_blank = .false.                  !! of a text
      integer :: number_of_choices = 0
      character(choice_length) :: choices(most_choices) = ''   !! only the first number_of_choices are set
      !> Which choices of the group's selector read the key, and which need it; none: it is not a key of alternatives.
      logical :: read_by(most_choices) = .false., needed_by(most_choices) = .false.
   end type key_type

   type :: key_group_type
      character(name_length) :: name = ''
      character(80) :: meaning = ''
      logical :: required = .false.
      type(key_type), allocatable :: keys(:)
      character(name_length) :: selector = ''      !! the key that selects an alternative; empty: there are none
      character(name_length) :: former_key = ''    !! a key of earlier versions; empty: none
      character(80) :: in_its_place = ''           !! what to give instead
   end type key_group_type

contains

   !> A group with its keys.
   pure function key_group(name, meaning, keys, required, former_key, in_its_place) result(group)
      character(*), intent(in) :: name, meaning
      type(key_type), intent(in) :: keys(:)
      logical, intent(in), optional :: required
      character(*), intent(in), optional :: former_key, in_its_place   !! both or neither
      type(key_group_type) :: group

      group%name = name
      group%meaning = meaning
      allocate (group%keys(size(keys)))
      group%keys(:) = keys
      if (present(required)) group%required = required
      if (present(former_key)) group%former_key = former_key
      if (present(in_its_place)) group%in_its_place = in_its_place
   end function key_group

   !> A key whose value is a number or, with most_values, a list of numbers.
   pure function real_key(name, default, unit, meaning, least, most, above, below, most_values, required, way) &
      result(key)
      character(*), intent(in) :: name, default, unit, meaning
      real(dp), intent(in), optional :: least, most    !! bounds, themselves allowed
      real(dp), intent(in), optional :: above, below   !! bounds, themselves excluded
      integer, intent(in), optional :: most_values, way
      logical, intent(in), optional :: required
      type(key_type) :: key

      key = key_of(real_value, name, default, meaning, required)
      key%unit = unit
      if (present(least)) key%least = least
      if (present(most)) key%most = most
      if (present(above)) key%least = above
      if (present(below)) key%most = below
      key%above = present(above)
      key%below = present(below)
      if (present(most_values)) key%most_values = most_values
      if (present(way)) key%way = way
   end function real_key

   !> A key whose value is an integer from least to most or, with most_values, a list of them.
   pure function integer_key(name, default, meaning, least, most, most_values, required, way) result(key)
      character(*), intent(in) :: name, default, meaning
      integer, intent(in) :: least, most
      integer, intent(in), optional :: most_values, way
      logical, intent(in), optional :: required
      type(key_type) :: key

      key = real_key(name, default, '', meaning, real(least, dp), real(most, dp), most_values=most_values, &
                     required=required, way=way)
      key%kind = integer_value
   end function integer_key

   pure function logical_key(name, default, meaning) result(key)
      character(*), intent(in) :: name, default, meaning
      type(key_type) :: key

      key = key_of(logical_value, name, default, meaning)
   end function logical_key

   pure function text_key(name, default, meaning, longest, may_be_blank, required) result(key)
      character(*), intent(in) :: name, default, meaning
      integer, intent(in) :: longest
      logical, intent(in), optional :: may_be_blank, required
      type(key_type) :: key

      key = key_of(text_value, name, default, meaning, required)
      key%longest = longest
      if (present(may_be_blank)) key%may_be_blank = may_be_blank
   end function text_key

   !> A key whose value is one of a few words.
   pure function choice_key(name, default, meaning, choices, required) result(key)
      character(*), intent(in) :: name, default, meaning
      character(*), intent(in) :: choices(:)  !! at most `most_choices`
      logical, intent(in), optional :: required
      type(key_type) :: key

      key = key_of(choice_value, name, default, meaning, required)
      key%number_of_choices = size(choices)
      key%choices(:size(choices)) = choices
   end function choice_key

   !> A key with what those of all types have.
   pure function key_of(kind, name, default, meaning, required) result(key)
      integer, intent(in) :: kind
      character(*), intent(in) :: name, default, meaning
      logical, intent(in), optional :: required
      type(key_type) :: key

      key%kind = kind
      key%name = name
      key%default = default
      key%meaning = meaning
      if (present(required)) key%required = required
   end function key_of

   !> The number of a key in a table; 0 if it is not there.
   pure integer function key_index(keys, name)
      type(key_type), intent(in) :: keys(:)
      character(*), intent(in) :: name

      key_index = findloc(keys%name == name, .true., dim=1)
   end function key_index

   pure function key_names(keys) result(names)
      type(key_type), intent(in) :: keys(:)
      character(name_length) :: names(size(keys))

      names = keys%name
   end function key_names

   pure function group_names(groups) result(names)
      type(key_group_type), intent(in) :: groups(:)
      character(name_length) :: names(size(groups))

      names = groups%name
   end function group_names

   !> The allowed values of a key, as words that follow "must be".
   pure function allowed_values(key) result(words)
      type(key_type), intent(in) :: key
      character(:), allocatable :: words

      select case (key%kind)
      case (real_value)
         words = 'a number'
         if (key%most_values > 1) words = 'up to '//integer_text(key%most_values)//' numbers'
         words = words//bounds(key)
      case (integer_value)
         words = 'an integer'
         if (key%most_values > 1) words = 'up to '//integer_text(key%most_values)//' integers'
         words = words//' from '//integer_text(nint(key%least))//' to '//integer_text(nint(key%most))
      case (logical_value)
         words = '.true. or .false.'
      case (text_value)
         words = 'text in quotes, at most '//integer_text(key%longest)//' bytes'
      case (choice_value)
         words = listed(in_quotes(key%choices(:key%number_of_choices)), ' or ')
      end select
   end function allowed_values

   !> A number of a real or integer key as a deck gives it, to all digits.
   pure function number_text(key, number) result(text)
      type(key_type), intent(in) :: key
      real(dp), intent(in) :: number
      character(:), allocatable :: text

      if (key%kind == integer_value) then
         text = integer_text(nint(number))
      else
         text = exact_number(number)
      end if
   end function number_text

   !> The bounds of a number, with a blank before them; empty if there are none.
   pure function bounds(key) result(words)
      type(key_type), intent(in) :: key
      character(:), allocatable :: words

      words = ''
      if (key%least > -largest_number) words = merge(' > ', ' >=', key%above)
      if (key%least > -largest_number) words = trim(words)//' '//short_number(key%least)
      if (key%most < largest_number) then
         if (len(words) > 0) words = words//' and'
         words = words//trim(merge(' < ', ' <=', key%below))//' '//short_number(key%most)
      end if
   end function bounds

end module wavycon_key_table
