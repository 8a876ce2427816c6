!> What the keys of a group need and exclude, as its table says, and groups with alternatives: &surface with its kinds
!> of surface, &method with its solvers.
!>
!> Each alternative declares the keys that it reads. The table of the group follows from these declarations, and says of
!> each key which alternatives read it. From this follow the problems with keys of other alternatives, the keys in the
!> resolved deck, and what --set replaces.
module wavycon_key_relations
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, choice_key, key_group, key_group_type, key_index, key_type, &
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
      group = key_group(name, meaning, [choice_key(selector, default, meanings(2:), alternatives%name, required), &
                                        keys(:number)], required)
      group%selector = selector
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

      character(:), allocatable :: key, selector, who
      integer :: k, selected
      logical :: is_read(size(values%table%keys)), is_given(size(values%table%keys))

      who = '&'//trim(values%table%name)
      selector = trim(values%table%selector)
      selected = 0
      associate (keys => values%table%keys)
         is_read = .true.
         if (selector /= '') then
            associate (choices => keys(key_index(keys, selector))%choices)
               if (values%text(selector) /= '') selected = findloc(choices == values%text(selector), .true., dim=1)
               do k = 1, size(keys)
                  if (selected == 0 .or. .not. any(keys(k)%read_by)) cycle
                  is_read(k) = keys(k)%read_by(selected)
                  key = trim(keys(k)%name)
                  if (is_read(k)) cycle
                  call values%leave_out(key)
                  if (values%has(key)) call values%complain(problems, key, key//' is a key of '//selector//' = '// &
                     listed(in_quotes(pack(choices, keys(k)%read_by)), ' and ')//", not of '"// &
                     values%text(selector)//"'"//did_you_mean(key, pack(keys%name, keys%read_by(selected)), "'", "'"))
               end do
            end associate
            if (selected > 0) who = selector//" = '"//values%text(selector)//"'"
         end if
         is_given = is_read .and. [(values%has(keys(k)%name), k=1, size(keys))]
         do k = 1, size(keys)
            if (.not. is_read(k)) cycle
            call check_required(k)
            if (is_given(k)) call check_way(k)
            if (keys(k)%kind == logical_value .and. .not. values%logical(keys(k)%name)) cycle
            if (is_given(k)) call check_needs(keys(k))
         end do
      end associate

   contains

      !> Reports a required key that is missing, at the first of those that give the same.
      subroutine check_required(k)
         integer, intent(in) :: k

         associate (keys => values%table%keys, key => values%table%keys(k))
            if (values%place == 0) return
            if (key%way > 0) then
               if (any(is_read(:k - 1) .and. keys(:k - 1)%way/10 == key%way/10) .or. &
                   any(is_given .and. keys%way/10 == key%way/10)) return
            end if
            if (is_given(k)) return
            if (selected == 0) then
               if (key%required) call problems%add(values%place, who//' needs '//needed(keys, k))
            else if (key%needed_by(selected)) then
               call values%complain(problems, selector, who//' needs '//needed(keys, k))
            end if
         end associate
      end subroutine check_required

      !> Reports the first key that gives the same as another one in another way.
      subroutine check_way(k)
         integer, intent(in) :: k

         integer :: first

         associate (keys => values%table%keys, &
                    family => is_given(:k - 1) .and. values%table%keys(:k - 1)%way/10 == values%table%keys(k)%way/10)
            first = findloc(family, .true., dim=1)
            if (first == 0 .or. keys(k)%way == 0) return
            if (keys(k)%way == keys(first)%way .or. any(family .and. keys(:k - 1)%way /= keys(first)%way)) return
            call problems%add(max(values%place_of(keys(first)%name), values%place_of(keys(k)%name)), &
                              trim(keys(first)%name)//' and '//trim(keys(k)%name)//' contradict each other: give one of them')
         end associate
      end subroutine check_way

      !> Reports what must stand beside a key and does not.
      subroutine check_needs(key)
         type(key_type), intent(in) :: key

         character(:), allocatable :: left, word
         integer :: equals

         left = trim(key%needs)//' '
         do while (left /= '')
            word = left(:index(left, ' ') - 1)
            left = left(len(word) + 2:)
            equals = index(word, '=')
            if (equals == 0) then
               if (values%has(word)) cycle
            else if (values%text(word(:equals - 1)) == word(equals + 2:len(word) - 1)) then
               cycle
            end if
            call values%complain(problems, key%name, trim(key%name)//' needs '//word//' beside it')
         end do
      end subroutine check_needs

   end subroutine check_relations

   !> What a deck must give: a key and its values, or one of several ways.
   pure function needed(keys, k) result(words)
      type(key_type), intent(in) :: keys(:)
      integer, intent(in) :: k
      character(:), allocatable :: words

      words = ways_in_words(keys, k)
      if (keys(k)%way == 0) words = words//' = '//allowed_values(keys(k))
   end function needed

end module wavycon_key_relations
