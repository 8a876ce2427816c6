!> All groups and keys of a deck as JSON, from the tables that decks are checked against: a list of groups, each with
!> name, meaning, required and keys; a key has name, type, unit, default, required, least and most (null: no bound),
!> above and below (whether the bounds themselves are excluded), most_values, longest (bytes of a text), choices,
!> read_by (for which values of the key that selects a kind or a solver it is read) and meaning. A default is written
!> as in a deck.
module wavycon_key_json
   use wavycon_constants, only: largest_number
   use wavycon_deck, only: deck_tables
   use wavycon_key_table, only: choice_value, integer_value, key_group_type, key_index, key_type, logical_value, &
      real_value, text_value
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

      logical, allocatable :: all_of_them(:)

      json = '{"name": '//text(key%name)//', "type": '//text(type_name(key%kind))//', "unit": '//text(key%unit)// &
             ', "default": '//text(key%default)//', "required": '//truth(key%required)
      if (any(key%kind == [real_value, integer_value])) json = json//', "least": '//bound(key%least)// &
         ', "above": '//truth(key%above)//', "most": '//bound(key%most)//', "below": '//truth(key%below)// &
         ', "most_values": '//integer_text(key%most_values)
      if (key%kind == text_value) json = json//', "longest": '//integer_text(key%longest)
      allocate (all_of_them(size(key%read_by)), source=.true.)
      if (key%kind == choice_value) json = json//', "choices": '//list(key, all_of_them)
      if (any(key%read_by)) &
         json = json//', "read_by": '//list(table%keys(key_index(table%keys, table%selector)), key%read_by)
      json = json//', "meaning": '//text(key%meaning)//'}'
   end function key_object

   !> Some of the choices of a key.
   pure function list(key, chosen) result(json)
      type(key_type), intent(in) :: key
      logical, intent(in) :: chosen(:)
      character(:), allocatable :: json

      integer :: i

      json = '['
      do i = 1, key%number_of_choices
         if (.not. chosen(i)) cycle
         if (len(json) > 1) json = json//', '
         json = json//text(key%choices(i))
      end do
      json = json//']'
   end function list

   pure function type_name(kind) result(name)
      integer, intent(in) :: kind
      character(7) :: name

      select case (kind)
      case (integer_value)
         name = 'integer'
      case (logical_value)
         name = 'logical'
      case (text_value)
         name = 'text'
      case (choice_value)
         name = 'choice'
      case default
         name = 'real'
      end select
   end function type_name

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
