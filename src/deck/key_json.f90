!> All groups and keys of a deck as JSON, from the tables that decks are checked against: a list of groups, each with
!> name, meaning, required and keys; a key has name, type, unit, default, required, least and most (null: no bound),
!> above and below (whether the bounds themselves are excluded), most_values, longest (bytes of a text), choices,
!> read_by (for which values of the key that selects a kind or a solver it is read) and meaning. A default is written
!> as in a deck.
module wavycon_key_json
   use wavycon_deck_groups, only: deck_tables
   use wavycon_key_table, only: full_meaning, integer_value, key_group_type, key_type, no_bound, real_value, &
      text_value, words_of
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, integer_text, newline
   implicit none (type, external)
   private

   public :: key_json

   !> In the order of the kinds of wavycon_key_table.
   character(*), parameter :: type_names(*) = ['real   ', 'integer', 'logical', 'text   ', 'choice ']

contains

   function key_json() result(json)
      character(:), allocatable :: json

      type(key_group_type), pointer :: tables(:)
      integer :: i, k

      tables => deck_tables()
      json = '['
      do i = 1, size(tables)
         if (i > 1) json = json//','
         json = json//newline//'{"name": '//text(tables(i)%name)//', "meaning": '//text(tables(i)%meaning)// &
                ', "required": '//truth(tables(i)%required)//', "keys": ['
         do k = 1, size(tables(i)%keys)
            if (k > 1) json = json//','
            json = json//newline//' '//key_object(tables(i)%keys(k))
         end do
         json = json//']}'
      end do
      json = json//newline//']'
   end function key_json

   function key_object(key) result(json)
      type(key_type), intent(in) :: key
      character(:), allocatable :: json

      json = '{"name": '//text(key%name)//', "type": '//text(type_names(key%kind))//', "unit": '//text(key%unit)// &
             ', "default": '//text(key%default)//', "required": '//truth(key%required .and. key%way == 0)
      if (any(key%kind == [real_value, integer_value])) json = json//', "least": '//bound(max(key%least, key%above))// &
         ', "above": '//truth(key%above > -no_bound)//', "most": '//bound(min(key%most, key%below))// &
         ', "below": '//truth(key%below < no_bound)//', "most_values": '//integer_text(key%most_values)
      if (key%kind == text_value) json = json//', "longest": '//integer_text(key%longest)
      if (key%choices /= '') json = json//', "choices": '//list(words_of(key%choices))
      if (key%of /= '') json = json//', "read_by": '//list(words_of(key%of))
      json = json//', "meaning": '//text(full_meaning(key))//'}'
   end function key_object

   !> A list of texts.
   pure function list(names) result(json)
      character(*), intent(in) :: names(:)
      character(:), allocatable :: json

      integer :: i

      json = ''
      do i = 1, size(names)
         json = json//', '//text(names(i))
      end do
      json = '['//json(3:)//']'
   end function list

   pure function bound(number) result(json)
      real(dp), intent(in) :: number
      character(:), allocatable :: json

      json = 'null'
      if (abs(number) < no_bound) json = exact_number(number)
   end function bound

   pure function truth(value) result(json)
      logical, intent(in) :: value
      character(:), allocatable :: json

      json = trim(merge('true ', 'false', value))
   end function truth

   !> A text in quotes. The tables have no control characters.
   pure function text(words) result(json)
      character(*), intent(in) :: words
      character(:), allocatable :: json

      integer :: i

      json = '"'
      do i = 1, len_trim(words)
         if (any(words(i:i) == ['"', '\'])) json = json//'\'
         json = json//words(i:i)
      end do
      json = json//'"'
   end function text

end module wavycon_key_json
