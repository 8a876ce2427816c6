!> One namelist group as a deck gives it, checked against its table of keys and ready to be read.
module wavycon_group_input
   use wavycon_deck_scanner, only: entry_type, is_broken_word, is_word, scan_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_key_table, only: allowed_values, group_names, key_group_type, key_index, key_names, key_type
   use wavycon_key_values, only: check_value
   use wavycon_nearest_name, only: did_you_mean, nearest_name
   use wavycon_plain_text, only: excerpt, integer_text, lower_case
   use wavycon_problems, only: problem_list_type
   use wavycon_text_buffer, only: text_buffer_type
   implicit none (type, external)
   private

   public :: group_input_type, take_groups

   !> What a deck says in one group.
   type :: group_input_type
      type(key_group_type) :: table
      integer :: place = 0                            !! of '&name' in the deck's text; 0 if it is absent
      integer, allocatable, private :: key_place(:)   !! of each key of the table; 0 where it is absent
      integer, allocatable, private :: key_values(:)  !! number of good values of each key
      logical, allocatable, private :: key_is_bad(:)  !! given, but with values that cannot be read
      !> A namelist record of the group, made of the good keys alone.
      character(:), allocatable :: record
   contains
      procedure :: has
      procedure :: is_bad
      procedure :: place_of
      procedure :: values_of
      procedure :: require
      procedure :: forbid
   end type group_input_type

contains

   !> Whether a key was given.
   pure logical function has(self, key)
      class(group_input_type), intent(in) :: self
      character(*), intent(in) :: key  !! one of the table

      has = self%key_place(key_index(self%table%keys, key)) > 0
   end function has

   !> Whether a key was given values that cannot be read: what follows from them is not to be judged.
   pure logical function is_bad(self, key)
      class(group_input_type), intent(in) :: self
      character(*), intent(in) :: key  !! one of the table

      is_bad = self%key_is_bad(key_index(self%table%keys, key))
   end function is_bad

   !> Where a problem with a key is shown: at the key, or at the group where the key was not given.
   pure integer function place_of(self, key)
      class(group_input_type), intent(in) :: self
      character(*), intent(in) :: key  !! one of the table

      place_of = self%key_place(key_index(self%table%keys, key))
      if (place_of == 0) place_of = self%place
   end function place_of

   !> The number of values that a key was given, repeats counted.
   pure integer function values_of(self, key)
      class(group_input_type), intent(in) :: self
      character(*), intent(in) :: key  !! one of the table

      values_of = self%key_values(key_index(self%table%keys, key))
   end function values_of

   !> Adds a problem for a key that was given without another that it needs.
   subroutine require(self, problems, key, other)
      class(group_input_type), intent(in) :: self
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: key, other

      if (self%has(key) .and. .not. self%has(other)) &
         call problems%add(self%place_of(key), key//' needs '//other//' beside it')
   end subroutine require

   !> Adds a problem for a key that was given together with another that contradicts it.
   subroutine forbid(self, problems, key, other, advice)
      class(group_input_type), intent(in) :: self
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: key, other
      character(*), intent(in) :: advice  !! what to give instead

      if (self%has(key) .and. self%has(other)) &
         call problems%add(max(self%place_of(key), self%place_of(other)), &
            key//' and '//other//' contradict each other: '//advice)
   end subroutine forbid

   !> Sorts the groups of a deck by the tables and checks all that a table can tell.
   subroutine take_groups(text, scan, tables, inputs, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      type(group_input_type), intent(out) :: inputs(size(tables))  !! one for each table
      type(problem_list_type), intent(inout) :: problems

      integer, allocatable :: entry_of_key(:)
      integer, allocatable :: table_of(:)
      integer :: first, g, i, last

      allocate (table_of(size(scan%groups)))
      call match_groups(text, scan, tables, table_of, problems)
      do i = 1, size(tables)
         inputs(i)%table = tables(i)
         associate (keys => size(tables(i)%keys))
            allocate (inputs(i)%key_place(keys), inputs(i)%key_values(keys), source=0)
            allocate (inputs(i)%key_is_bad(keys), source=.false.)
            allocate (entry_of_key(keys), source=0)
         end associate
         g = findloc(table_of, i, dim=1)
         if (g > 0) then
            inputs(i)%place = scan%tokens(scan%groups(g)%name)%first
            call find_entries(scan%entries, g, first, last)
            call match_keys(text, scan, tables, first, last, inputs(i), entry_of_key, problems)
         end if
         call report_missing(inputs(i), problems)
         call take_values(text, scan, entry_of_key, inputs(i), problems)
         deallocate (entry_of_key)
      end do
   end subroutine take_groups

   !> Which table each group of the deck belongs to; 0 for a group that is unknown or there already.
   subroutine match_groups(text, scan, tables, table_of, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      integer, intent(out) :: table_of(:)
      type(problem_list_type), intent(inout) :: problems

      integer :: first_of_table(size(tables)), g, i
      character(:), allocatable :: name

      table_of = 0
      first_of_table = 0
      do g = 1, size(scan%groups)
         if (problems%is_full()) return
         name = word_of(text, scan, scan%groups(g)%name)
         i = findloc(tables%name == name(2:), .true., dim=1)
         if (i == 0) cycle
         if (first_of_table(i) == 0) then
            first_of_table(i) = g
            table_of(g) = i
         else
            call problems%add(place(g), name//' is given twice, first in line '// &
               integer_text(text%line_of(place(first_of_table(i)))))
         end if
      end do

      do g = 1, size(scan%groups)
         if (problems%is_full()) return
         name = word_of(text, scan, scan%groups(g)%name)
         if (any(tables%name == name(2:))) cycle
         call problems%add(place(g), unknown_group(name, tables))
         i = nearest_name(name(2:), group_names(tables))
         if (i == 0) cycle
         if (first_of_table(i) > 0) cycle
         ! A misspelt group: what it holds is checked all the same, and it is not missing.
         first_of_table(i) = g
         table_of(g) = i
      end do

   contains

      pure integer function place(g)
         integer, intent(in) :: g

         place = scan%tokens(scan%groups(g)%name)%first
      end function place

   end subroutine match_groups

   !> What to say of a group that decks do not have.
   pure function unknown_group(name, tables) result(words)
      character(*), intent(in) :: name  !! with its '&'
      type(key_group_type), intent(in) :: tables(:)
      character(:), allocatable :: words

      if (name == '&') then
         words = "expected the name of a group right behind the '&'"
      else
         words = "there is no group '"//excerpt(name)//"'"// &
            did_you_mean(name(2:), group_names(tables), "'&", "'")
         if (nearest_name(name(2:), group_names(tables)) == 0) &
            words = words//'; the groups are '//listed(group_names(tables))
      end if
   end function unknown_group

   !> First and last entry of a group; last < first if it has none.
   subroutine find_entries(entries, group, first, last)
      type(entry_type), intent(in) :: entries(:)
      integer, intent(in) :: group
      integer, intent(out) :: first, last

      first = findloc(entries%group, group, dim=1)
      last = findloc(entries%group, group, dim=1, back=.true.)
      if (first == 0) first = 1
   end subroutine find_entries

   !> Finds the entry of each key of a group; reports unknown keys and those given twice.
   subroutine match_keys(text, scan, tables, first, last, input, entry_of_key, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(key_group_type), intent(in) :: tables(:)
      integer, intent(in) :: first, last              !! entries of the group
      type(group_input_type), intent(inout) :: input
      integer, intent(out) :: entry_of_key(:)         !! 0 where the key was not given
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: key
      integer :: e, k

      entry_of_key = 0
      do e = first, last
         key = word_of(text, scan, scan%entries(e)%key)
         k = key_index(input%table%keys, key)
         if (k == 0) cycle
         if (entry_of_key(k) == 0) then
            entry_of_key(k) = e
            input%key_place(k) = place(e)
         else
            call problems%add(place(e), key//' is given twice, first in line '// &
               integer_text(text%line_of(input%key_place(k))))
            input%key_is_bad(k) = .true.
         end if
      end do

      do e = first, last
         if (problems%is_full()) return
         key = word_of(text, scan, scan%entries(e)%key)
         if (key_index(input%table%keys, key) > 0) cycle
         call problems%add(place(e), unknown_key(key, input%table, tables))
         ! Whoever misspells a key means to give it: no complaint that it is missing.
         k = nearest_name(key, key_names(input%table%keys))
         if (k == 0) cycle
         if (entry_of_key(k) > 0) cycle
         input%key_place(k) = place(e)
         input%key_is_bad(k) = .true.
      end do

   contains

      pure integer function place(e)
         integer, intent(in) :: e

         place = scan%tokens(scan%entries(e)%key)%first
      end function place

   end subroutine match_keys

   !> What to say of a key that the group does not have.
   pure function unknown_key(key, table, tables) result(words)
      character(*), intent(in) :: key
      type(key_group_type), intent(in) :: table, tables(:)
      character(:), allocatable :: words

      integer :: bracket, i

      bracket = index(key, '(')
      if (bracket > 1) then
         if (key_index(table%keys, key(:bracket - 1)) > 0) then
            words = "elements are not given one by one: write '"//key(:bracket - 1)//" = value, value, ...'"
            return
         end if
      end if
      do i = 1, size(tables)
         if (key_index(tables(i)%keys, key) == 0) cycle
         words = key//' belongs to &'//trim(tables(i)%name)//', not to &'//trim(table%name)
         return
      end do
      words = "there is no key '"//excerpt(key)//"' in &"//trim(table%name)
      words = words//did_you_mean(key, key_names(table%keys), "'", "'")
      if (nearest_name(key, key_names(table%keys)) == 0) &
         words = words//'; its keys are '//listed(key_names(table%keys))
   end function unknown_key

   !> Reports what every deck needs and this one does not have.
   subroutine report_missing(input, problems)
      type(group_input_type), intent(in) :: input
      type(problem_list_type), intent(inout) :: problems

      integer :: k

      if (input%place == 0) then
         if (input%table%required) call problems%add(0, 'the group &'//trim(input%table%name)//' ('// &
            trim(input%table%meaning)//') is missing')
         return
      end if
      do k = 1, size(input%table%keys)
         associate (key => input%table%keys(k))
            if (key%required .and. input%key_place(k) == 0) call problems%add(input%place, &
               '&'//trim(input%table%name)//' needs '//trim(key%name)//' = '//allowed_values(key))
         end associate
      end do
   end subroutine report_missing

   !> Checks the values of each key and copies the good ones to the record.
   subroutine take_values(text, scan, entry_of_key, input, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      integer, intent(in) :: entry_of_key(:)
      type(group_input_type), intent(inout) :: input
      type(problem_list_type), intent(inout) :: problems

      type(text_buffer_type) :: record
      integer :: k, t

      call record%add('&'//trim(input%table%name))
      do k = 1, size(entry_of_key)
         if (entry_of_key(k) == 0) cycle
         associate (entry => scan%entries(entry_of_key(k)))
            call check_entry(text, scan, entry, k, input, problems)
            if (input%key_is_bad(k)) cycle
            call record%add(' '//trim(input%table%keys(k)%name)//' =')
            do t = entry%first_value, entry%last_value
               associate (token => scan%tokens(t))
                  if (token%kind == is_word) call record%add(' '//text%content(token%first:token%last))
               end associate
            end do
         end associate
      end do
      call record%add(' /')
      input%record = record%text()
   end subroutine take_values

   !> Checks the values of the key number k.
   subroutine check_entry(text, scan, entry, k, input, problems)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      type(entry_type), intent(in) :: entry
      integer, intent(in) :: k
      type(group_input_type), intent(inout) :: input
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: trouble
      integer :: t, values, values_here

      values = 0
      associate (key => input%table%keys(k))
         do t = entry%first_value, entry%last_value
            associate (token => scan%tokens(t))
               if (token%kind == is_broken_word) input%key_is_bad(k) = .true.
               if (token%kind /= is_word) cycle
               if (values >= key%most_values) then
                  call problems%add(token%first, one_too_many(key, input%table, word_of(text, scan, t)))
                  input%key_is_bad(k) = .true.
                  exit
               end if
               call check_value(key, text%content(token%first:token%last), values_here, trouble)
               if (.not. allocated(trouble) .and. values_here > key%most_values - values) &
                  trouble = trim(key%name)//' takes '//at_most(key%most_values)//", got '"// &
                  excerpt(text%content(token%first:token%last))//"'"
               if (allocated(trouble)) then
                  call problems%add(token%first, trouble)
                  input%key_is_bad(k) = .true.
                  if (problems%is_full() .or. key%most_values == 1) exit
                  values_here = 1
               end if
               values = values + values_here
            end associate
         end do
         if (entry%last_value < entry%first_value) then
            call problems%add(input%key_place(k), trim(key%name)//' has no value: it must be '// &
               allowed_values(key))
            input%key_is_bad(k) = .true.
         else if (values == 0) then
            input%key_is_bad(k) = .true.
         end if
      end associate
      input%key_values(k) = values
   end subroutine check_entry

   !> What to say of a value that a key has no use for.
   pure function one_too_many(key, table, word) result(words)
      type(key_type), intent(in) :: key
      type(key_group_type), intent(in) :: table
      character(*), intent(in) :: word
      character(:), allocatable :: words

      words = trim(key%name)//' takes '//at_most(key%most_values)//", and here is one more: '"// &
         excerpt(word)//"'"
      if (key_index(table%keys, word) > 0) words = words//"; is a '=' missing behind it?"
   end function one_too_many

   pure function at_most(number) result(words)
      integer, intent(in) :: number
      character(:), allocatable :: words

      words = 'one value'
      if (number > 1) words = 'at most '//integer_text(number)//' values'
   end function at_most

   !> The text of a token in lower case.
   pure function word_of(text, scan, t) result(word)
      type(deck_text_type), intent(in) :: text
      type(scan_type), intent(in) :: scan
      integer, intent(in) :: t
      character(:), allocatable :: word

      word = lower_case(text%content(scan%tokens(t)%first:scan%tokens(t)%last))
   end function word_of

   !> "a, b, c"
   pure function listed(names) result(words)
      character(*), intent(in) :: names(:)
      character(:), allocatable :: words

      integer :: i

      words = trim(names(1))
      do i = 2, size(names)
         words = words//', '//trim(names(i))
      end do
   end function listed

end module wavycon_group_input
