!> All groups and keys of a deck as JSON, from the tables that decks are checked against: a list of groups, each with
!> name, meaning, required and keys; a key has name, type, unit, default, required, least and most (null: no bound),
!> above and below (whether the bounds themselves are excluded), most_values, longest (bytes of a text), choices,
!> read_by (for which values of the key that selects a kind or a solver it is read) and meaning. A default is written
!> as in a deck.
module wavycon_key_json
   use wavycon_constants, only: largest_number
   use wavycon_deck, only: deck_tables
   use wavycon_key_table, only: choice_value, integer_value, key_group_type, key_index, key_type, real_value, &
      text_value, type_names
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, integer_text, newline
   implicit none (type, external)
   private

   public :: key_json

contains

   function key_json() result(json)
      character(:), allocatable :: json

      type(key_group_type), allocatable :: tables(:)
      integer :: i, k

      tables = deck_tables()
      json = '['
      do i = 1, size(tables)
         if (i > 1) json = json//','
         json = json//newline//'{"name": '//text(tables(i)%name)//', "meaning": '//text(tables(i)%meaning)// &
                ', "required": '//truth(tables(i)%required)//', "keys": ['
         do k = 1, size(tables(i)%keys)
            if (k > 1) json = json//','
            json = json//newline//' '//key_object(tables(i), tables(i)%keys(k))
         end do
         json = json//']}'
      end do
      json = json//newline//']'
   end function key_json

   function key_object(table, key) result(json)
      type(key_group_type), intent(in) :: table
      type(key_type), intent(in) :: key   !! of the table
      character(:), allocatable :: json

      json = '{"name": '//text(key%name)//', "type": '//text(type_names(key%kind))//', "unit": '//text(key%unit)// &
             ', "default": '//text(key%default)//', "required": '//truth(key%required .and. key%way == 0)
      if (any(key%kind == [real_value, integer_value])) json = json//', "least": '//bound(key%least)// &
         ', "above": '//truth(key%above)//', "most": '//bound(key%most)//', "below": '//truth(key%below)// &
         ', "most_values": '//integer_text(key%most_values)
      if (key%kind == text_value) json = json//', "longest": '//integer_text(key%longest)
      if (key%kind == choice_value) json = json//', "choices": '//list(key%choices)
      if (any(key%read_by)) then
         associate (selector => table%keys(key_index(table%keys, table%selector)))
            json = json//', "read_by": '//list(pack(selector%choices, key%read_by))
         end associate
      end if
      json = json//', "meaning": '//text(key%meaning)//'}'
   end function key_object

   !> A list of texts; blank ones are left out.
   pure function list(names) result(json)
      character(*), intent(in) :: names(:)
      character(:), allocatable :: json

      integer :: i

      json = ''
      do i = 1, size(names)
         if (names(i) /= '') json = json//', '//text(names(i))
      end do
      json = '['//json(3:)//']'
   end function list

   pure function bound(number) result(json)
      real(dp), intent(in) :: number
      character(:), allocatable :: json

      json = 'null'
      if (abs(number) < largest_number) json = exact_number(number)
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
