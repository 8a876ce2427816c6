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
   public :: allowed_values, key_group, key_index, number_text, ways_in_words

   !> Types of values.
   integer, parameter, public :: real_value = 1, integer_value = 2, logical_value = 3, text_value = 4, &
      choice_value = 5
   character(*), parameter, public :: type_names(*) = ['real   ', 'integer', 'logical', 'text   ', 'choice ']

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
      logical :: required = .false.                      !! whether a deck must give it, or what gives the same
      !> Keys of a group that give the same quantity in different ways have the same tens here, which are not 0, and
      !> different ones: they contradict each other, and --set of one of them replaces the others.
      integer :: way = 0
      !> What must stand beside the key in a deck: names of keys of the group, or key='value', with blanks between them.
      character(32) :: needs = ''
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
   end type key_group_type

contains

   !> A group with its keys.
   pure function key_group(name, meaning, keys, required) result(group)
      character(*), intent(in) :: name, meaning
      type(key_type), intent(in) :: keys(:)
      logical, intent(in), optional :: required
      type(key_group_type) :: group

      group%name = name
      group%meaning = meaning
      allocate (group%keys(size(keys)))
      group%keys(:) = keys
      if (present(required)) group%required = required
   end function key_group

   !> A key whose value is a number or, with most_values, a list of numbers.
   pure function real_key(name, default, unit, meaning, least, most, above, below, most_values, required, way, needs) &
      result(key)
      character(*), intent(in) :: name, default, unit, meaning
      real(dp), intent(in), optional :: least, most    !! bounds, themselves allowed
      real(dp), intent(in), optional :: above, below   !! bounds, themselves excluded
      integer, intent(in), optional :: most_values, way
      logical, intent(in), optional :: required
      character(*), intent(in), optional :: needs
      type(key_type) :: key

      key = key_type(name, real_value, meaning, default, unit)
      if (present(least)) key%least = least
      if (present(most)) key%most = most
      if (present(above)) key%least = above
      if (present(below)) key%most = below
      key%above = present(above)
      key%below = present(below)
      if (present(most_values)) key%most_values = most_values
      if (present(required)) key%required = required
      if (present(way)) key%way = way
      if (present(needs)) key%needs = needs
   end function real_key

   !> A key whose value is an integer from least to most or, with most_values, a list of them.
   pure function integer_key(name, default, meaning, least, most, most_values, required, way, needs) result(key)
      character(*), intent(in) :: name, default, meaning
      integer, intent(in) :: least, most
      integer, intent(in), optional :: most_values, way
      logical, intent(in), optional :: required
      character(*), intent(in), optional :: needs
      type(key_type) :: key

      key = real_key(name, default, '', meaning, real(least, dp), real(most, dp), most_values=most_values, &
                     required=required, way=way, needs=needs)
      key%kind = integer_value
   end function integer_key

   pure function logical_key(name, default, meaning, needs) result(key)
      character(*), intent(in) :: name, default, meaning
      character(*), intent(in), optional :: needs   !! if it is true
      type(key_type) :: key

      key = key_type(name, logical_value, meaning, default)
      if (present(needs)) key%needs = needs
   end function logical_key

   pure function text_key(name, default, meaning, longest, may_be_blank, required) result(key)
      character(*), intent(in) :: name, default, meaning
      integer, intent(in) :: longest
      logical, intent(in), optional :: may_be_blank, required
      type(key_type) :: key

      key = key_type(name, text_value, meaning, default, longest=longest)
      if (present(may_be_blank)) key%may_be_blank = may_be_blank
      if (present(required)) key%required = required
   end function text_key

   !> A key whose value is one of a few words.
   pure function choice_key(name, default, meaning, choices, required, needs) result(key)
      character(*), intent(in) :: name, default, meaning
      character(*), intent(in) :: choices(:)  !! at most `most_choices`
      logical, intent(in), optional :: required
      character(*), intent(in), optional :: needs
      type(key_type) :: key

      key = key_type(name, choice_value, meaning, default, number_of_choices=size(choices))
      key%choices(:size(choices)) = choices
      if (present(required)) key%required = required
      if (present(needs)) key%needs = needs
   end function choice_key

   !> The number of a key in a table; 0 if it is not there.
   pure integer function key_index(keys, name)
      type(key_type), intent(in) :: keys(:)
      character(*), intent(in) :: name

      key_index = findloc(keys%name == name, .true., dim=1)
   end function key_index

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

   !> The keys that give the same quantity as one of them: "a, b, or c and d", where c and d make one way.
   pure function ways_in_words(keys, k) result(words)
      type(key_type), intent(in) :: keys(:)
      integer, intent(in) :: k   !! one of them; itself if there is no other
      character(:), allocatable :: words

      character(80) :: ways(0:9)
      integer :: i

      words = trim(keys(k)%name)
      if (keys(k)%way == 0) return
      ways = ''
      do i = 0, 9
         associate (is_one => keys%way == 10*(keys(k)%way/10) + i)
            if (any(is_one)) ways(i) = listed(pack(keys%name, is_one), ' and ')
         end associate
      end do
      words = listed(pack(ways, ways /= ''), ', or ')
   end function ways_in_words

   !> Numbers of a real or integer key as a deck gives them, to all digits.
   pure function number_text(key, numbers, between) result(text)
      type(key_type), intent(in) :: key
      real(dp), intent(in) :: numbers(:)
      character(*), intent(in) :: between   !! two numbers
      character(:), allocatable :: text

      integer, parameter :: most_digits = 24   !! and signs of a number
      character(:), allocatable :: number, room
      integer :: i, used

      ! To append to `text` would copy it each time, for up to 100000 numbers.
      allocate (character((most_digits + len(between))*size(numbers)) :: room)
      used = 0
      do i = 1, size(numbers)
         number = exact_number(numbers(i))
         if (key%kind == integer_value) number = integer_text(nint(numbers(i)))
         if (i > 1) number = between//number
         room(used + 1:used + len(number)) = number
         used = used + len(number)
      end do
      text = room(:used)
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
