!> What the keys of a group need and exclude, as its table says, and groups with alternatives: &surface with its kinds
!> of surface, &method with its solvers.
!>
!> Each alternative declares the keys that it reads. The table of the group follows from these declarations, and says of
!> each key which alternatives read it. From this follow the problems with keys of other alternatives, the keys in the
!> resolved deck, and what --set replaces.
module wavycon_key_relations
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, choice_key, key_group_type, key_index, key_type, &
      logical_value, meaning_length, ways_in_words
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: alternative_type, alternative_group, check_relations

   integer, parameter :: name_length = 12

   type :: alternative_type
      character(name_length) :: name = ''
      character(:), allocatable :: meaning     !! one clause
      type(key_type), allocatable :: keys(:)   !! the keys that it reads; a deck must give the `required` ones
   end type alternative_type

contains

   !> The table of a group: the selector, which is the key whose value is the name of an alternative and whose meaning
   !> lists theirs, and the keys of all alternatives, each once, in the order of their first alternatives.
   function alternative_group(name, meaning, selector, default, alternatives, required) result(group)
      character(*), intent(in) :: name, meaning               !! of the group
      character(*), intent(in) :: selector, default           !! the key and its default, as of choice_key
      type(alternative_type), intent(in) :: alternatives(:)   !! at most `most_choices`, with name, meaning and keys
      logical, intent(in) :: required                         !! whether decks must have the group and the selector
      type(key_group_type) :: group

      character(:), allocatable :: meanings
      type(key_type), allocatable :: keys(:)
      integer :: i, k, number, own

      allocate (keys(sum([(size(alternatives(i)%keys), i=1, size(alternatives))])))
      number = 0
      meanings = ''
      do i = 1, size(alternatives)
         meanings = meanings//" '"//trim(alternatives(i)%name)//"': "//alternatives(i)%meaning//'.'
         do own = 1, size(alternatives(i)%keys)
            associate (key => alternatives(i)%keys(own))
               k = key_index(keys(:number), key%name)
               if (k == 0) then
                  number = number + 1
                  k = number
                  keys(k) = key
                  keys(k)%meaning = merged_meaning(alternatives, key%name)
                  keys(k)%required = .false.
               end if
               keys(k)%read_by(i) = .true.
               keys(k)%needed_by(i) = key%required
            end associate
         end do
      end do
      group = key_group_type(name, meaning, [choice_key(selector, default, meanings(2:), alternatives%name, required), &
                                             keys(:number)], required, selector)
   end function alternative_group

   !> The meanings of a key for all alternatives: "Of a and b: this. Of c: that."
   pure function merged_meaning(alternatives, key) result(words)
      type(alternative_type), intent(in) :: alternatives(:)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      character(meaning_length) :: meanings(size(alternatives))   ! empty where an alternative does not read the key
      integer :: i, k

      meanings = ''
      words = ''
      do i = 1, size(alternatives)
         k = key_index(alternatives(i)%keys, key)
         if (k > 0) meanings(i) = alternatives(i)%keys(k)%meaning
      end do
      do i = 1, size(alternatives)
         if (meanings(i) == '' .or. any(meanings(:i - 1) == meanings(i))) cycle
         words = words//' Of '//listed(pack(alternatives%name, meanings == meanings(i)), ' and ')//': '// &
                 trim(meanings(i))
      end do
      words = words(2:)
   end function merged_meaning

   !> Reports required keys that are missing, keys without those that they need, keys that give the same in two ways,
   !> and keys that the selected alternative does not read. These are left out of the resolved deck.
   subroutine check_relations(values, problems)
      type(group_values), intent(inout) :: values   !! the selector has its value, if it is not bad
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: key, selector, what, who
      integer :: first, k, place, selected
      logical, dimension(size(values%table%keys)) :: is_read, is_given, is_needed, family

      selector = trim(values%table%selector)
      selected = 0
      place = values%place
      who = '&'//trim(values%table%name)
      associate (keys => values%table%keys)
         if (selector /= '') selected = key_index(keys, selector)
         if (selected > 0) selected = findloc(keys(selected)%choices(:keys(selected)%number_of_choices) == &
                                              values%text(selector), .true., dim=1)
         is_needed = keys%required
         is_read = .true.
         if (selected > 0) then
            who = selector//" = '"//values%text(selector)//"'"
            place = values%place_of(selector)
            is_needed = keys%needed_by(selected)
            is_read = keys%read_by(selected) .or. [(.not. any(keys(k)%read_by), k=1, size(keys))]
         end if
         is_given = [(values%has(keys(k)%name), k=1, size(keys))]
         do k = 1, size(keys)
            key = trim(keys(k)%name)
            if (.not. is_read(k)) then
               call values%leave_out(key)
               if (is_given(k)) call values%complain(problems, key, key//' is a key of '//selector//' = '// &
                  listed(in_quotes(pack(keys(key_index(keys, selector))%choices, keys(k)%read_by)), ' and ')// &
                  ", not of '"//values%text(selector)//"'"// &
                  did_you_mean(key, pack(keys%name, keys%read_by(selected)), "'", "'"))
               cycle
            end if
            ! Those that give the same quantity: a key alone, or all ways.
            family = is_read .and. keys%way/10 == keys(k)%way/10
            if (keys(k)%way == 0) family = keys%name == key
            first = findloc(family, .true., dim=1)
            if (is_needed(k) .and. k == first .and. values%place > 0 .and. .not. any(family .and. is_given)) then
               what = ways_in_words(keys, k)
               if (keys(k)%way == 0) what = what//' = '//allowed_values(keys(k))
               call problems%add(place, who//' needs '//what)
            end if
            if (.not. is_given(k)) cycle
            first = findloc(family .and. is_given, .true., dim=1)
            if (keys(k)%way /= keys(first)%way .and. &
                .not. any(family(:k - 1) .and. is_given(:k - 1) .and. keys(:k - 1)%way /= keys(first)%way)) &
               call problems%add(max(values%place_of(keys(first)%name), values%place_of(key)), &
                  trim(keys(first)%name)//' and '//key//' contradict each other: give one of them')
            if (keys(k)%kind == logical_value .and. .not. values%logical(key)) cycle
            call check_needs(values, key, trim(keys(k)%needs)//' ', problems)
         end do
      end associate
   end subroutine check_relations

   !> Reports what must stand beside a key and does not.
   subroutine check_needs(values, key, needs, problems)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: key, needs   !! as of key_type
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: left, word
      integer :: equals

      left = needs
      do while (left /= '')
         word = left(:index(left, ' ') - 1)
         left = left(len(word) + 2:)
         equals = index(word//'=', '=')
         if (equals > len(word)) then
            if (values%has(word)) cycle
         else if (values%text(word(:equals - 1)) == word(equals + 2:len(word) - 1)) then
            cycle
         end if
         call values%complain(problems, key, key//' needs '//word//' beside it')
      end do
   end subroutine check_needs

end module wavycon_key_relations
