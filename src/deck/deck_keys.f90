!> The keys of a deck and their values as words, for tables that compare decks.
module wavycon_deck_keys
   use wavycon_deck, only: deck_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_value, key_type, logical_value, number_text, real_value
   implicit none (type, external)
   private

   public :: deck_key, list_keys

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
   subroutine list_keys(deck, keys)
      type(deck_type), intent(in) :: deck   !! without problems
      type(deck_key), allocatable, intent(out) :: keys(:)

      integer :: number

      allocate (keys(size(deck%material%table%keys) + size(deck%surface_values%table%keys) + &
                     size(deck%load%table%keys) + size(deck%stress%table%keys) + size(deck%method%table%keys)))
      number = 0
      call add_group(deck%material, .true.)
      call add_group(deck%surface_values, .true.)
      call add_group(deck%load, .true.)
      call add_group(deck%stress, deck%stress%place > 0)
      call add_group(deck%method, .true.)

   contains

      subroutine add_group(values, is_asked_for)
         type(group_values), intent(in) :: values
         logical, intent(in) :: is_asked_for

         integer :: k

         do k = 1, size(values%table%keys)
            number = number + 1
            associate (key => values%table%keys(k), listed => keys(number))
               listed%name = trim(values%table%name)//'_'//key%name
               listed%given = values%has(trim(key%name))
               listed%in_effect = is_asked_for .and. values%in_effect(trim(key%name)) .and. &
                                  .not. (values%table%name == 'load' .and. key%most_values > 1)
               listed%word = '-'
               if (any(key%kind == [real_value, integer_value])) listed%word = 'NaN'
               if (listed%in_effect) listed%word = word_of(values, key)
            end associate
         end do
      end subroutine add_group

   end subroutine list_keys

   !> The value of a key: the numbers of a list with commas between them, one number if they are equal.
   pure function word_of(values, key) result(word)
      type(group_values), intent(in) :: values
      type(key_type), intent(in) :: key
      character(:), allocatable :: word

      integer :: i

      select case (key%kind)
      case (real_value, integer_value)
         associate (numbers => values%reals(trim(key%name)))
            i = merge(1, size(numbers), maxval(numbers) <= minval(numbers))
            word = number_text(key, numbers(:i), ',')
         end associate
      case (logical_value)
         word = trim(merge('.true. ', '.false.', values%logical(trim(key%name))))
      case default
         word = values%text(trim(key%name))
         do i = 1, len(word)
            if (word(i:i) == ' ') word(i:i) = '_'
         end do
         if (word == '') word = '-'
      end select
   end function word_of

end module wavycon_deck_keys
