!> The keys of a deck and their values as words, for tables that compare decks.
module wavycon_deck_keys
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_value, key_type, real_value
   use wavycon_plain_text, only: escaped
   use wavycon_scene, only: scene_type
   implicit none (type, external)
   private

   public :: deck_key, list_keys, without_blanks

   !> Bytes of a name.
   integer, parameter :: longest_key_name = 49

   type :: deck_key
      character(longest_key_name) :: name = ''   !! 'group_key'
      !> The value in effect, without blanks; '-' for an empty text. Without an effect 'NaN' of a number, '-' of a word.
      character(:), allocatable :: word
      logical :: in_effect = .false.
      logical :: given = .false.          !! whether the deck or the command line gives it
   end type deck_key

contains

   !> Lists the keys of &material, &surface, &load, &stress and &method, the same for all decks. Lists of loads have no
   !> effect here: a table has a row for each.
   subroutine list_keys(scene, keys)
      type(scene_type), intent(in) :: scene
      type(deck_key), allocatable, intent(out) :: keys(:)

      type(group_values) :: groups(5)
      logical :: is_asked_for
      integer :: i, k, number

      groups(1) = scene%material
      groups(2) = scene%surface_values
      groups(3) = scene%load
      groups(4) = scene%stress
      groups(5) = scene%method
      allocate (keys(sum([(size(groups(i)%table%keys), i=1, size(groups))])))
      number = 0
      do i = 1, size(groups)
         associate (values => groups(i))
            is_asked_for = values%table%name /= 'stress' .or. values%place > 0
            do k = 1, size(values%table%keys)
               number = number + 1
               associate (key => values%table%keys(k), listed => keys(number))
                  listed%name = trim(values%table%name)//'_'//key%name
                  listed%given = values%has(key%name)
                  listed%in_effect = is_asked_for .and. values%in_effect(key%name) .and. &
                                     .not. (values%table%name == 'load' .and. key%most_values > 1)
                  listed%word = '-'
                  if (any(key%kind == [real_value, integer_value])) listed%word = 'NaN'
                  if (listed%in_effect) listed%word = word_of(values, key)
               end associate
            end do
         end associate
      end do
   end subroutine list_keys

   !> The value of a key: the numbers of a list with commas between them, one number if they are equal.
   pure function word_of(values, key) result(word)
      type(group_values), intent(in) :: values
      type(key_type), intent(in) :: key
      character(:), allocatable :: word

      word = values%words(trim(key%name), ',')
      if (any(key%kind == [real_value, integer_value])) then
         associate (numbers => values%reals(trim(key%name)))
            if (maxval(numbers) <= minval(numbers)) word = word(:index(word//',', ',') - 1)
         end associate
      end if
      word = without_blanks(word)
      if (word == '') word = '-'
   end function word_of

   !> A text as one word of a table.
   pure function without_blanks(text) result(word)
      character(*), intent(in) :: text
      character(:), allocatable :: word

      integer :: i

      word = escaped(text)
      do i = 1, len(word)
         if (word(i:i) == ' ') word(i:i) = '_'
      end do
   end function without_blanks

end module wavycon_deck_keys
