!> The reference of all groups and keys for --help, generated from the same tables that decks are checked against.
module wavycon_key_reference
   use wavycon_deck_groups, only: deck_tables
   use wavycon_key_table, only: allowed_values, full_meaning, key_group_type, key_type
   use wavycon_plain_text, only: newline
   implicit none (type, external)
   private

   public :: add_wrapped, key_reference

   integer, parameter, public :: widest_line = 100

contains

   !> The reference: lines, each with a newline and none longer than `widest_line`.
   function key_reference() result(reference)
      character(:), allocatable :: reference

      type(key_group_type), pointer :: tables(:)
      integer :: i, k

      reference = ''
      tables => deck_tables()
      call add_wrapped(reference, 0, &
         "A deck consists of Fortran namelist groups, '&group key = value ... /', "// &
         "in any order; '!' begins a comment. A group or key may be left out unless marked as required. "// &
         'Lengths may be in any one unit and pressures in any one unit.')
      do i = 1, size(tables)
         reference = reference//newline
         call add_wrapped(reference, 0, '&'//trim(tables(i)%name)//'   '//trim(tables(i)%meaning)// &
            trim(merge(' (required)', '           ', tables(i)%required)))
         do k = 1, size(tables(i)%keys)
            call add_key(reference, tables(i)%keys(k))
         end do
      end do
   end function key_reference

   !> Adds a key: allowed values, unit, default and meaning.
   subroutine add_key(reference, key)
      character(:), allocatable, intent(inout) :: reference
      type(key_type), intent(in) :: key

      integer, parameter :: name_width = 24
      character(:), allocatable :: line
      character(name_width) :: name

      name = key%name
      line = allowed_values(key)
      if (key%unit /= '') line = line//' ['//trim(key%unit)//']'
      if (key%default /= '') line = line//'; default '//trim(key%default)
      if (key%needs /= '') line = line//'; needs '//trim(key%needs)
      if (key%required .and. key%way == 0) line = line//'; required'
      call add_wrapped(reference, name_width + 3, line, head='   '//name)
      call add_wrapped(reference, name_width + 3, full_meaning(key))
   end subroutine add_key

   !> Adds a text as lines that begin with blanks and break between words.
   subroutine add_wrapped(reference, indent, text, head)
      character(:), allocatable, intent(inout) :: reference
      integer, intent(in) :: indent                !! blanks
      character(*), intent(in) :: text
      character(*), intent(in), optional :: head   !! of the first line, in place of its blanks

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

end module wavycon_key_reference
