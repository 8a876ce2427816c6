!> The keys of groups with alternatives: &surface with its kinds of surface, &method with its solvers.
!>
!> Each alternative declares the keys that it reads. The table of the group, the problems with keys of other
!> alternatives and the keys in the resolved deck follow from these declarations.
module wavycon_key_alternatives
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, key_index, key_type, meaning_length
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: alternative_type, selector_key, merged_keys, names_reading, report_missing_keys, is_misplaced, &
      leave_out_other_keys

   integer, parameter :: name_length = 12

   type :: alternative_type
      character(name_length) :: name = ''
      character(:), allocatable :: meaning     !! one clause
      type(key_type), allocatable :: keys(:)   !! the keys that it reads; a deck must give the `required` ones
   end type alternative_type

contains

   !> The key that selects an alternative by its name; its meaning lists theirs.
   pure function selector_key(name, default, alternatives, required) result(key)
      character(*), intent(in) :: name, default               !! as of choice_key
      type(alternative_type), intent(in) :: alternatives(:)   !! with name and meaning
      logical, intent(in), optional :: required
      type(key_type) :: key

      character(name_length) :: names(size(alternatives))
      character(:), allocatable :: meanings
      integer :: i

      meanings = ''
      do i = 1, size(alternatives)
         names(i) = alternatives(i)%name
         if (i > 1) meanings = meanings//' '
         meanings = meanings//"'"//trim(alternatives(i)%name)//"': "//alternatives(i)%meaning//'.'
      end do
      key = choice_key(name, default, meanings, names, required)
   end function selector_key

   !> The keys of all alternatives, each once, in the order of their first alternatives. The meanings begin with the
   !> names of the alternatives, "Of a and b: ...".
   pure function merged_keys(alternatives) result(keys)
      type(alternative_type), intent(in) :: alternatives(:)
      type(key_type), allocatable :: keys(:)

      integer :: i, k

      allocate (keys(0))
      do i = 1, size(alternatives)
         do k = 1, size(alternatives(i)%keys)
            if (key_index(keys, alternatives(i)%keys(k)%name) > 0) cycle
            keys = [keys, alternatives(i)%keys(k)]
         end do
      end do
      do k = 1, size(keys)
         keys(k)%meaning = merged_meaning(alternatives, keys(k)%name)
         keys(k)%required = .false.
      end do
   end function merged_keys

   !> The meanings of a key for all alternatives: "Of a and b: this. Of c: that."
   pure function merged_meaning(alternatives, key) result(words)
      type(alternative_type), intent(in) :: alternatives(:)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      character(meaning_length) :: meaning(size(alternatives))
      character(name_length) :: names(size(alternatives))
      logical :: same(size(alternatives))
      integer :: i

      do i = 1, size(alternatives)
         names(i) = alternatives(i)%name
         meaning(i) = meaning_to(alternatives(i), key)
      end do
      words = ''
      do i = 1, size(alternatives)
         same = meaning == meaning(i)
         if (meaning(i) == '' .or. findloc(same, .true., dim=1) < i) cycle
         if (words /= '') words = words//' '
         words = words//'Of '//listed(pack(names, same), ' and ')//': '//trim(meaning(i))
      end do
   end function merged_meaning

   !> The meaning of a key for one alternative; empty if it does not read the key.
   pure function meaning_to(alternative, key) result(meaning)
      type(alternative_type), intent(in) :: alternative
      character(*), intent(in) :: key
      character(:), allocatable :: meaning

      integer :: k

      meaning = ''
      k = key_index(alternative%keys, key)
      if (k > 0) meaning = trim(alternative%keys(k)%meaning)
   end function meaning_to

   !> "'a', 'b' and 'c'": the alternatives that read a key.
   pure function names_reading(alternatives, key) result(words)
      type(alternative_type), intent(in) :: alternatives(:)
      character(*), intent(in) :: key   !! that one of them reads
      character(:), allocatable :: words

      character(name_length) :: names(size(alternatives))
      logical :: reads(size(alternatives))
      integer :: i

      do i = 1, size(alternatives)
         names(i) = alternatives(i)%name
         reads(i) = key_index(alternatives(i)%keys, key) > 0
      end do
      words = listed(in_quotes(pack(names, reads)), ' and ')
   end function names_reading

   !> Reports the keys that the chosen alternative requires and the deck does not give: "kind = 'sum' needs waves_x".
   pure subroutine report_missing_keys(alternative, selector, values, problems)
      type(alternative_type), intent(in) :: alternative
      character(*), intent(in) :: selector   !! key that chooses the alternative
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems

      integer :: k

      do k = 1, size(alternative%keys)
         associate (key => alternative%keys(k))
            if (key%required .and. .not. values%has(key%name)) call values%complain(problems, selector, &
               selector//" = '"//trim(alternative%name)//"' needs "//trim(key%name))
         end associate
      end do
   end subroutine report_missing_keys

   !> Whether the deck gives a key of other alternatives than the chosen one.
   pure logical function is_misplaced(alternatives, chosen, key, values)
      type(alternative_type), intent(in) :: alternatives(:)
      integer, intent(in) :: chosen
      character(*), intent(in) :: key
      type(group_values), intent(in) :: values

      integer :: i

      is_misplaced = .false.
      do i = 1, size(alternatives)
         is_misplaced = is_misplaced .or. key_index(alternatives(i)%keys, key) > 0
      end do
      is_misplaced = is_misplaced .and. values%has(key) .and. key_index(alternatives(chosen)%keys, key) == 0
   end function is_misplaced

   !> Leaves the keys of other alternatives out of the resolved deck.
   pure subroutine leave_out_other_keys(alternatives, chosen, values)
      type(alternative_type), intent(in) :: alternatives(:)
      integer, intent(in) :: chosen
      type(group_values), intent(inout) :: values

      integer :: i, k

      do i = 1, size(alternatives)
         do k = 1, size(alternatives(i)%keys)
            associate (key => alternatives(i)%keys(k)%name)
               if (key_index(alternatives(chosen)%keys, key) == 0) call values%leave_out(key)
            end associate
         end do
      end do
   end subroutine leave_out_other_keys

end module wavycon_key_alternatives
