!> The keys of groups with alternatives: &surface with its kinds of surface, &method with its solvers.
!>
!> Each alternative declares the keys that it reads. The table of the group follows from these declarations, and says of
!> each key which alternatives read it. From this follow the problems with keys of other alternatives, the keys in the
!> resolved deck, and what --set replaces.
module wavycon_key_alternatives
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, key_group, key_group_type, key_index, key_type
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: alternative_type, alternative_group, check_alternatives

   integer, parameter :: name_length = 12

   type :: alternative_type
      character(name_length) :: name = ''
      character(:), allocatable :: meaning     !! one clause
      type(key_type), allocatable :: keys(:)   !! the keys that it reads; a deck must give the `required` ones
      !> Keys of other alternatives that it lacks, and why, as the end of a sentence such as ': it has no grid'.
      character(24) :: lacks(2) = ''
      character(40) :: because(2) = ''
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
      character(len(alternatives%name)) :: names(size(alternatives))
      integer :: i, k, number, own

      names = alternatives%name
      allocate (keys(sum([(size(alternatives(i)%keys), i=1, size(alternatives))])))
      number = 0
      meanings = ''
      do i = 1, size(alternatives)
         if (i > 1) meanings = meanings//' '
         meanings = meanings//"'"//trim(alternatives(i)%name)//"': "//alternatives(i)%meaning//'.'
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
      group = key_group(name, meaning, [choice_key(selector, default, meanings, names, required), keys(:number)], &
                        required)
      group%selector = selector
   end function alternative_group

   !> The meanings of a key for all alternatives: "Of a and b: this. Of c: that."
   pure function merged_meaning(alternatives, key) result(words)
      type(alternative_type), intent(in) :: alternatives(:)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      character(len(alternatives%name)) :: names(size(alternatives))
      logical :: same(size(alternatives))
      integer :: i, j, k(size(alternatives))   ! numbers of the key; 0 where an alternative does not read it

      names = alternatives%name
      k = [(key_index(alternatives(i)%keys, key), i=1, size(k))]
      words = ''
      do i = 1, size(k)
         if (k(i) == 0) cycle
         associate (meaning => alternatives(i)%keys(k(i))%meaning)
            same = k > 0
            do j = 1, size(k)
               if (same(j)) same(j) = alternatives(j)%keys(k(j))%meaning == meaning
            end do
            if (findloc(same, .true., dim=1) < i) cycle
            if (words /= '') words = words//' '
            words = words//'Of '//listed(pack(names, same), ' and ')//': '//trim(meaning)
         end associate
      end do
   end function merged_meaning

   !> Reports keys that the selected alternative needs and the deck does not give, "kind = 'sum' needs waves_x", and
   !> keys of other alternatives, which are left out of the resolved deck.
   subroutine check_alternatives(selected, values, problems, before)
      type(alternative_type), intent(in) :: selected
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: before   !! what messages say before the names of alternatives; may be empty

      character(:), allocatable :: key, selector
      integer :: i, k

      selector = trim(values%table%selector)
      associate (keys => values%table%keys, choice => values%table%keys(key_index(values%table%keys, selector)))
         i = findloc(choice%choices == selected%name, .true., dim=1)
         do k = 1, size(keys)
            key = trim(keys(k)%name)
            if (keys(k)%needed_by(i) .and. .not. values%has(key)) call values%complain(problems, selector, &
               selector//" = '"//trim(selected%name)//"' needs "//key)
            if (keys(k)%read_by(i) .or. .not. any(keys(k)%read_by)) cycle
            call values%leave_out(key)
            if (values%has(key)) call values%complain(problems, key, key//' is a key of '//before// &
               listed(in_quotes(pack(choice%choices, keys(k)%read_by)), ' and ')//", not of '"// &
               trim(selected%name)//"'"//advice(selected, key))
         end do
      end associate
   end subroutine check_alternatives

   !> What to give instead of a key of other alternatives, or why it is missing, as the end of a sentence: the keys that
   !> are its plural, or have a number behind it. Empty if there are none.
   pure function advice(alternative, key) result(words)
      type(alternative_type), intent(in) :: alternative
      character(*), intent(in) :: key   !! that it does not read
      character(:), allocatable :: words

      integer :: i

      words = ''
      if (key_index(alternative%keys, key//'s') > 0) words = ': give '//key//'s'
      if (key_index(alternative%keys, key//'1') > 0) words = ': give '//key//'1 and '//key//'2'
      i = findloc(alternative%lacks == key, .true., dim=1)
      if (i > 0) words = trim(alternative%because(i))
   end function advice

end module wavycon_key_alternatives
