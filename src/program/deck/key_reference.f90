!> The reference of all groups and keys, as text for --help and as JSON. It is made from the same tables by which decks
!> are checked.
module wavycon_key_reference
   use wavycon_deck_groups, only: list_keys, number_of_groups
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: allowed_values, full_meaning, integer_value, key_type, name_length, no_bound, &
      real_value, text_value, words_of
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, integer_text, newline, with_mark
   use wavycon_scene, only: scene_type
   implicit none (type, external)
   private

   public :: add_wrapped, key_json, key_reference

   integer, parameter, public :: widest_line = 100

   !> Names of the types of values in JSON, in the order of the kinds of wavycon_key_table.
   character(*), parameter :: type_names(*) = ['real   ', 'integer', 'logical', 'text   ', 'choice ']

contains

   !> The reference as text: lines of at most `widest_line` characters, each with a newline; empty if there is no such
   !> group or key.
   function key_reference(group, key) result(reference)
      character(*), intent(in) :: group   !! name of the only group; '': all groups
      character(*), intent(in) :: key     !! name of the only key; '': all keys of the group
      character(:), allocatable :: reference

      type(key_list) :: lists(number_of_groups)
      type(scene_type), target :: no_scene   ! records without values, to which the lists point
      character(:), allocatable :: line      ! heading of a group; allowed values, unit and default of a key
      integer :: i, k

      reference = ''
      call list_keys(no_scene, lists)
      if (group == '' .and. key == '') call add_wrapped(reference, 0, &
         "A deck consists of Fortran namelist groups, '&group key = value ... /', "// &
         "in any order; '!' begins a comment. A group or key may be left out unless marked as required. "// &
         'Lengths may be in any one unit and pressures in any one unit.')
      do i = 1, size(lists)
         if (group /= '' .and. lists(i)%name /= group) cycle
         if (key /= '' .and. all(lists(i)%rows%name /= key)) cycle
         reference = reference//newline
         line = '&'//trim(lists(i)%name)//'   '//trim(lists(i)%meaning)
         if (lists(i)%required) line = line//' (required)'
         call add_wrapped(reference, 0, line)
         do k = 1, size(lists(i)%rows)
            associate (row => lists(i)%rows(k))
               if (key /= '' .and. row%name /= key) cycle
               line = allowed_values(row)
               if (row%unit /= '') line = line//' ['//trim(row%unit)//']'
               if (row%default /= '') line = line//'; default '//trim(row%default)
               if (row%needs /= '') line = line//'; needs '//trim(row%needs)
               if (row%required .and. row%way == 0) line = line//'; required'
               call add_wrapped(reference, name_length + 3, line, head='   '//row%name)
               call add_wrapped(reference, name_length + 3, full_meaning(row))
            end associate
         end do
      end do
   end function key_reference

   !> Adds a text, broken between words into lines of at most `widest_line` characters.
   subroutine add_wrapped(reference, indent, text, head)
      character(:), allocatable, intent(inout) :: reference   !! gets the lines at its end
      integer, intent(in) :: indent                !! number of blanks at the start of each line
      character(*), intent(in) :: text
      character(*), intent(in), optional :: head   !! text in place of the blanks of the first line

      character(:), allocatable :: start
      integer :: first, last

      start = repeat(' ', indent)
      if (present(head)) start = head
      first = 1
      do while (first <= len(text))
         last = len(text)
         if (last - first >= widest_line - indent) &
            last = first - 1 + index(text(first:first + widest_line - indent), ' ', back=.true.)
         reference = reference//start//trim(text(first:last))//newline
         start = repeat(' ', indent)
         first = last + 1
      end do
   end subroutine add_wrapped

   !> The reference as JSON: a list of groups, each with name, meaning, required and keys. A key has name, type, unit,
   !> default, required, least and most (null: no bound), above and below (whether the bounds themselves are excluded),
   !> most_values, longest (most bytes of a text), choices, read_by (the kinds of surface or the solvers that read the
   !> key) and meaning. A default is written as in a deck.
   function key_json() result(json)
      character(:), allocatable :: json

      type(key_list) :: lists(number_of_groups)
      type(scene_type), target :: no_scene   ! records without values, to which the lists point
      integer :: i, k

      call list_keys(no_scene, lists)
      json = '['
      do i = 1, size(lists)
         if (i > 1) json = json//','
         json = json//newline//'{"name": '//text(lists(i)%name)//', "meaning": '//text(lists(i)%meaning)// &
                ', "required": '//truth(lists(i)%required)//', "keys": ['
         do k = 1, size(lists(i)%rows)
            if (k > 1) json = json//','
            json = json//newline//' '//key_object(lists(i)%rows(k))
         end do
         json = json//']}'
      end do
      json = json//newline//']'
   end function key_json

   !> A key as an object of JSON.
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

   !> A list of texts in JSON.
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

   !> A bound in JSON; null if there is none.
   pure function bound(number) result(json)
      real(dp), intent(in) :: number
      character(:), allocatable :: json

      json = 'null'
      if (abs(number) < no_bound) json = exact_number(number)
   end function bound

   !> A logical value in JSON.
   pure function truth(value) result(json)
      logical, intent(in) :: value
      character(:), allocatable :: json

      json = 'false'
      if (value) json = 'true'
   end function truth

   !> A text in JSON. Texts of the tables of keys have no control characters, which JSON would have to escape.
   pure function text(words) result(json)
      character(*), intent(in) :: words
      character(:), allocatable :: json

      json = '"'//with_mark(trim(words), '"\', '\')//'"'
   end function text

end module wavycon_key_reference
