!> What the keys of a group need and exclude, as its table says, and groups with alternatives: &surface with its kinds
!> of surface, &method with its solvers. From the table follow the problems with keys of other alternatives, the keys in
!> the resolved deck, and what --set replaces.
module wavycon_key_relations
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, is_read, logical_value, name_length, ways_in_words, words_of
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: check_relations

contains

   !> Reports required keys that are missing, keys without those that they need, keys that give the same in two ways,
   !> and keys that the selected alternative does not read. What has no effect is left out of the resolved deck: keys of
   !> other alternatives, keys without those that they need, and defaults beside another way to give the same.
   subroutine check_relations(values, problems)
      type(group_values), intent(inout) :: values   !! the selector has its value, if it is not bad
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: choice, key, selector, who
      character(name_length), allocatable :: needs(:)
      integer :: first, i, k, place
      logical, allocatable :: lacks(:)
      logical, dimension(size(values%table%keys)) :: is_given, is_own, family

      selector = trim(values%table%selector)
      choice = ''
      place = values%place
      who = '&'//trim(values%table%name)
      if (selector /= '') choice = values%text(selector)
      associate (keys => values%table%keys)
         is_own = .true.
         if (choice /= '') then
            who = selector//" = '"//choice//"'"
            place = values%place_of(selector)
            is_own = is_read(keys, choice)
         end if
         is_given = [(values%has(keys(k)%name), k=1, size(keys))]
         do k = 1, size(keys)
            key = trim(keys(k)%name)
            if (.not. is_own(k)) then
               call values%leave_out(key)
               if (is_given(k)) call values%complain(problems, key, key//' is a key of '//selector//' = '// &
                  listed(in_quotes(words_of(keys(k)%of)), ' and ')//", not of '"//choice//"'"// &
                  did_you_mean(key, pack(keys%name, is_own .and. keys%of /= ''), "'", "'"))
               cycle
            end if
            ! Those that give the same quantity: a key alone, or all ways.
            family = is_own .and. keys%way/10 == keys(k)%way/10
            if (keys(k)%way == 0) family = keys%name == key
            first = findloc(family, .true., dim=1)
            if (keys(k)%required .and. k == first .and. values%place > 0 .and. .not. any(family .and. is_given) .and. &
                (keys(k)%of == '' .or. choice /= '')) then
               if (keys(k)%way == 0) then
                  call problems%add(place, who//' needs '//key//' = '//allowed_values(keys(k)))
               else
                  call problems%add(place, who//' needs '//ways_in_words(keys, k))
               end if
            end if
            first = findloc(family .and. is_given, .true., dim=1)
            needs = words_of(keys(k)%needs)
            lacks = [(.not. stands_beside(trim(needs(i))), i=1, size(needs))]
            if (any(lacks) .or. any(family .and. is_given .and. keys%way /= keys(k)%way)) call values%leave_out(key)
            if (.not. is_given(k)) cycle
            if (keys(k)%way /= keys(first)%way .and. &
                .not. any(family(:k - 1) .and. is_given(:k - 1) .and. keys(:k - 1)%way /= keys(first)%way)) &
               call problems%add(max(values%place_of(keys(first)%name), values%place_of(key)), &
                  trim(keys(first)%name)//' and '//key//' contradict each other: give one of them')
            if (keys(k)%kind == logical_value .and. .not. values%logical(key)) cycle
            do i = 1, size(needs)
               if (lacks(i)) call values%complain(problems, key, key//' needs '//trim(needs(i))//' beside it')
            end do
         end do
      end associate

   contains

      !> Whether the deck gives a key or, of key='value', whether it has that value.
      logical function stands_beside(word)
         character(*), intent(in) :: word

         integer :: equals

         equals = index(word, '=')
         if (equals == 0) then
            stands_beside = values%has(word)
         else
            stands_beside = values%text(word(:equals - 1)) == word(equals + 2:len(word) - 1)
         end if
      end function stands_beside

   end subroutine check_relations

end module wavycon_key_relations
