!> The description of a key of a namelist group, a row of the group's table: name, type, bounds, default, unit, meaning.
!>
!> Checks of decks, the key reference of --help and the comments of resolved decks all follow from these tables.
module wavycon_key_table
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: in_quotes, integer_text, listed, short_number
   implicit none (type, external)
   private

   public :: key_type, allowed_values, full_meaning, is_read, key_index, ways_in_words, words_of

   !> Types of values.
   integer, parameter, public :: real_value = 1, integer_value = 2, logical_value = 3, text_value = 4, &
      choice_value = 5

   !> Most bytes of the name and of the meaning of a key; the size of a bound that does not exist.
   integer, parameter, public :: name_length = 24
   integer, parameter, public :: meaning_length = 640
   real(dp), parameter, public :: no_bound = huge(1.0_dp)

   type :: key_type
      integer :: kind = real_value                       !! type of the value: real_value or another name above
      character(name_length) :: name = ''                !! in lower case
      !> The default as a deck would give it; in words if the default depends on other keys, in which case the group's
      !> check sets the value. Empty: there is no default.
      character(40) :: default = ''
      character(32) :: unit = ''                         !! '-' if dimensionless; empty for texts, flags and counts
      character(meaning_length) :: meaning = ''          !! for --help
      real(dp) :: least = -no_bound, most = no_bound     !! bounds of a number that are allowed themselves
      real(dp) :: above = -no_bound, below = no_bound    !! bounds of a number that are excluded themselves
      integer :: most_values = 1                         !! most values of the key; a key with more than 1 is a list
      integer :: longest = 0                             !! most bytes of a text
      logical :: may_be_blank = .false.                  !! whether a text may consist of blanks
      character(80) :: choices = ''                      !! the words that a choice may be, with blanks between them
      logical :: required = .false.                      !! whether a deck must give the key, or its quantity otherwise
      !> Keys of a group that give the same quantity in different ways have numbers with the same hundreds. Keys with
      !> the same number belong together. Two ways contradict each other, --set of one key replaces those of the other
      !> ways, and defaults of the ways that are not given have no effect. A key that needs one of another quantity only
      !> adds to its way: --set of it replaces none. 0: no other key gives the quantity.
      integer :: way = 0
      !> What a deck must give beside the key: names of keys of the group, or key='value', with blanks between them.
      !> Without these the default of the key has no effect.
      character(32) :: needs = ''
      !> In a group with a selector: the choices of the selector with which the key is read, with blanks between them;
      !> empty: all.
      character(48) :: of = ''
   end type key_type

contains

   !> The words of a text.
   pure function words_of(text) result(words)
      character(*), intent(in) :: text   !! words of at most name_length bytes with blanks between them
      character(name_length), allocatable :: words(:)

      character(:), allocatable :: left
      integer :: blank

      allocate (words(0))
      left = trim(adjustl(text))//' '
      do while (left /= '')
         blank = index(left, ' ')
         words = [character(name_length) :: words, left(:blank)]
         left = adjustl(left(blank:))
      end do
   end function words_of

   !> Whether a key is read with a choice of the group's selector.
   elemental logical function is_read(key, choice)
      type(key_type), intent(in) :: key
      character(*), intent(in) :: choice

      is_read = key%of == '' .or. index(' '//key%of, ' '//trim(choice)//' ') > 0
   end function is_read

   !> The meaning of a key, with the choices of the selector that read the key: "Of a and b: meaning".
   pure function full_meaning(key) result(words)
      type(key_type), intent(in) :: key
      character(:), allocatable :: words

      words = trim(key%meaning)
      if (key%of /= '') words = 'Of '//listed(words_of(key%of), ' and ')//': '//words
   end function full_meaning

   !> The number of the key with a name in a table; 0 if the table does not have the key.
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
         if (key%least > -no_bound) words = words//' >= '//short_number(key%least)
         if (key%above > -no_bound) words = words//' > '//short_number(key%above)
         if (max(key%least, key%above) > -no_bound .and. min(key%most, key%below) < no_bound) words = words//' and'
         if (key%most < no_bound) words = words//' <= '//short_number(key%most)
         if (key%below < no_bound) words = words//' < '//short_number(key%below)
      case (integer_value)
         words = 'an integer'
         if (key%most_values > 1) words = 'up to '//integer_text(key%most_values)//' integers'
         words = words//' from '//integer_text(nint(key%least))//' to '//integer_text(nint(key%most))
      case (logical_value)
         words = '.true. or .false.'
      case (text_value)
         words = 'text in quotes, at most '//integer_text(key%longest)//' bytes'
      case (choice_value)
         words = listed(in_quotes(words_of(key%choices)), ' or ')
      end select
   end function allowed_values

   !> The keys that give the same quantity, in words: "a, b, or c and d", where c and d together are one way.
   pure function ways_in_words(keys, k) result(words)
      type(key_type), intent(in) :: keys(:)   !! table of a group
      integer, intent(in) :: k                !! number of a key that gives the quantity, with way > 0
      character(:), allocatable :: words

      character(80) :: ways(0:99)
      integer :: i

      ways = ''
      do i = 0, size(ways) - 1
         associate (is_one => keys%way == 100*(keys(k)%way/100) + i)
            if (any(is_one)) ways(i) = listed(pack(keys%name, is_one), ' and ')
         end associate
      end do
      words = listed(pack(ways, ways /= ''), ', or ')
   end function ways_in_words

end module wavycon_key_table
