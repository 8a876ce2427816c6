!> The values of one group of a deck: for each key of the group's table the value that the deck gives, or its default,
!> and the check of what keys need and exclude, as the table says.
module wavycon_group_values
   use wavycon_key_table, only: allowed_values, integer_value, is_read, key_group_type, key_index, logical_value, &
      name_length, real_value, ways_in_words, words_of
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: exact_number, in_quotes, integer_text, listed
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: group_values

   !> The value of one key and how it was given.
   type :: key_entry
      integer :: place = 0                     !! byte of the deck's text where the key stands; 0 if it is absent
      logical :: is_bad = .false.              !! given, but its value cannot be used
      logical :: applies = .true.              !! whether the resolved deck shows it
      logical :: has_value = .false.
      real(dp), allocatable :: numbers(:)      !! of reals and integers; of logicals 1 for .true. and 0 for .false.
      character(:), allocatable :: text        !! of texts and choices
   end type key_entry

   !> To ask for a key that is not in the table is a programming error, which stops the program.
   type :: group_values
      type(key_group_type), pointer :: table => null()
      character(:), allocatable :: deck_path   !! the deck's file, as the caller named it
      character(:), allocatable :: length_unit   !! the deck's label of lengths, for &surface; empty: it gives none
      integer :: place = 0                     !! byte of the deck's text where '&name' stands; 0 if it is absent
      !> Whether the group, or a group in its place, has a key that the table has not: any other may have been meant.
      logical :: has_unknown = .false.
      type(key_entry), allocatable, private :: entries(:)   !! of the keys of the table
   contains
      procedure :: start
      procedure :: take
      procedure :: has
      procedure :: is_bad
      procedure :: any_bad
      procedure :: place_of
      procedure :: in_effect
      procedure :: leave_out
      procedure :: reals
      procedure :: pair
      procedure :: real => get_real
      procedure :: integer => get_integer
      procedure :: logical => get_logical
      procedure :: text
      procedure :: choice
      procedure :: words
      procedure :: set
      procedure :: set_default
      procedure :: complain
      procedure :: check_relations
      procedure, private :: find
   end type group_values

contains

   !> Sets the defaults of the table. A key whose default is in words has no value until `set_default` is called.
   subroutine start(self, table, deck_path)
      class(group_values), intent(out) :: self
      type(key_group_type), intent(in), target :: table   !! stays as long as the values
      character(*), intent(in) :: deck_path

      type(word_value) :: value
      character(:), allocatable :: trouble
      integer :: k

      self%table => table
      self%deck_path = deck_path
      self%length_unit = ''
      allocate (self%entries(size(table%keys)))
      do k = 1, size(table%keys)
         allocate (self%entries(k)%numbers(0))
         self%entries(k)%text = ''
         if (table%keys(k)%default == '') cycle
         call read_value(table%keys(k), trim(table%keys(k)%default), value, trouble)
         if (.not. allocated(trouble)) call self%set(table%keys(k)%name, [value%number], value%text)
      end do
   end subroutine start

   !> Takes what the deck gives for a key. Without a value it is bad: its default stays in effect.
   pure subroutine take(self, key, place, numbers, text)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: place                            !! of the key, byte of the deck's text
      real(dp), intent(in), optional :: numbers(:)            !! as of key_entry, repeats expanded
      character(*), intent(in), optional :: text              !! of texts and choices

      associate (entry => self%entries(self%find(key)))
         entry%place = place
         entry%is_bad = .not. present(numbers)
      end associate
      if (present(numbers)) call self%set(key, numbers, text)
   end subroutine take

   !> Whether the deck gives a key.
   pure logical function has(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      has = self%entries(self%find(key))%place > 0
   end function has

   !> Whether the deck gives a key a value that cannot be used. Checks that depend on the key should then be omitted.
   pure logical function is_bad(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      is_bad = self%entries(self%find(key))%is_bad
   end function is_bad

   !> Whether any key is bad or unknown.
   pure logical function any_bad(self)
      class(group_values), intent(in) :: self

      any_bad = self%has_unknown .or. any(self%entries%is_bad)
   end function any_bad

   !> The place at which a problem with a key is reported: that of the key or, if it is absent, of the group.
   pure integer function place_of(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      place_of = self%entries(self%find(key))%place
      if (place_of == 0) place_of = self%place
   end function place_of

   !> Whether a key has a value and has not been left out.
   pure logical function in_effect(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      associate (entry => self%entries(self%find(key)))
         in_effect = entry%has_value .and. entry%applies
      end associate
   end function in_effect

   !> Leaves a key out of the resolved deck, because it has no effect beside the other values of this deck.
   pure subroutine leave_out(self, key)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key

      self%entries(self%find(key))%applies = .false.
   end subroutine leave_out

   !> The values of a real or integer key, or that of a logical one, as of key_entry.
   pure function reals(self, key) result(numbers)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key
      real(dp), allocatable :: numbers(:)

      numbers = self%entries(self%find(key))%numbers
   end function reals

   !> The two numbers of a real or integer key; a single one is both. Zeros if it has none.
   pure function pair(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key
      real(dp) :: pair(2)

      pair = 0.0_dp
      associate (given => self%entries(self%find(key))%numbers)
         if (size(given) > 0) pair = given([1, size(given)])
      end associate
   end function pair

   !> The value of a real key; of a list its first, 0 if it has none.
   pure real(dp) function get_real(self, key) result(number)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      real(dp) :: both(2)

      both = self%pair(key)
      number = both(1)
   end function get_real

   !> The value of an integer key; of a list its first, 0 if it has none.
   pure integer function get_integer(self, key) result(number)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      number = nint(self%real(key))
   end function get_integer

   !> The value of a logical key.
   pure logical function get_logical(self, key) result(flag)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      flag = self%real(key) > 0
   end function get_logical

   !> The value of a text or choice key, without blanks at its end; empty if it has none.
   pure function text(self, key) result(words)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key
      character(:), allocatable :: words

      words = self%entries(self%find(key))%text
   end function text

   !> The number of the value of a choice key among its choices; 0 if it has none.
   pure integer function choice(self, key)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      choice = findloc(words_of(self%table%keys(self%find(key))%choices) == self%text(key), .true., dim=1)
   end function choice

   !> A value as a deck gives it, numbers to all digits and texts without quotes.
   pure function words(self, key, between) result(text)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key       !! of the table
      character(*), intent(in) :: between   !! two numbers
      character(:), allocatable :: text

      integer, parameter :: most_digits = 24   !! and signs of a number
      character(:), allocatable :: number
      integer :: i, used

      associate (kind => self%table%keys(self%find(key))%kind, numbers => self%entries(self%find(key))%numbers)
         select case (kind)
         case (real_value, integer_value)
            ! To append each number would copy the text each time, for up to 100000 numbers.
            allocate (character((most_digits + len(between))*size(numbers)) :: text)
            used = 0
            do i = 1, size(numbers)
               number = exact_number(numbers(i))
               if (kind == integer_value) number = integer_text(nint(numbers(i)))
               if (i > 1) number = between//number
               text(used + 1:used + len(number)) = number
               used = used + len(number)
            end do
            text = text(:used)
         case (logical_value)
            text = trim(merge('.true. ', '.false.', self%logical(key)))
         case default
            text = self%text(key)
         end select
      end associate
   end function words

   !> Sets a value in place of the deck's or the default.
   pure subroutine set(self, key, numbers, text)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in), optional :: numbers(:)   !! as of key_entry
      character(*), intent(in), optional :: text     !! of texts and choices

      associate (entry => self%entries(self%find(key)))
         entry%has_value = .true.
         if (present(numbers)) entry%numbers = numbers
         if (present(text)) entry%text = trim(text)
      end associate
   end subroutine set

   !> Sets a default that depends on other values. It has no effect if the deck gives the key a good value.
   pure subroutine set_default(self, key, numbers, text)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in), optional :: numbers(:)   !! as of set
      character(*), intent(in), optional :: text

      if (.not. self%has(key) .or. self%is_bad(key)) call self%set(key, numbers, text)
   end subroutine set_default

   !> Reports a problem at the place of a key.
   pure subroutine complain(self, problems, key, words)
      class(group_values), intent(in) :: self
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: key
      character(*), intent(in) :: words   !! what is wrong, what was expected

      call problems%add(self%place_of(key), words)
   end subroutine complain

   !> The number of a key in the table.
   pure integer function find(self, key) result(k)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      k = key_index(self%table%keys, key)
      if (k == 0) error stop 'no such key in the table of a group: '//key
   end function find

   !> Reports required keys that are missing, keys without those that they need, keys that give the same in two ways,
   !> and keys that the selected alternative does not read. What has no effect is left out of the resolved deck: keys of
   !> other alternatives, keys without those that they need, and defaults beside another way to give the same. What
   !> follows from a mistake that has been reported is no problem of its own.
   !>
   !> A group with a selector has alternatives: &surface its kinds of surface, &method its solvers.
   subroutine check_relations(self, problems)
      class(group_values), intent(inout) :: self
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: choice, key, others, said, selector, who
      character(name_length), allocatable :: needs(:)
      integer :: first, i, k, place
      logical :: is_default, is_told
      logical, allocatable :: lacks(:)
      logical, dimension(size(self%table%keys)) :: is_given, is_own, family

      selector = trim(self%table%selector)
      choice = ''
      said = ' '
      place = self%place
      who = '&'//trim(self%table%name)
      is_default = .false.
      is_told = .false.
      if (selector /= '') then
         is_default = .not. self%has(selector)
         ! A bad selector, or one whose name is misspelt, has its default, which says nothing about the other keys.
         if (.not. (self%is_bad(selector) .or. (is_default .and. self%has_unknown))) choice = self%text(selector)
      end if
      others = "'"//choice//"'"
      if (is_default) others = 'the default, '//others
      associate (keys => self%table%keys)
         is_own = .true.
         if (choice /= '') then
            who = selector//" = '"//choice//"'"
            place = self%place_of(selector)
            is_own = is_read(keys, choice)
         end if
         is_given = [(self%has(keys(k)%name), k=1, size(keys))]
         do k = 1, size(keys)
            key = trim(keys(k)%name)
            if (.not. is_own(k)) then
               call self%leave_out(key)
               ! Beside the default one key is enough to see that the selector is missing.
               if (is_given(k) .and. .not. (self%is_bad(key) .or. (is_default .and. is_told))) then
                  call self%complain(problems, key, &
                     key//' is a key of '//selector//' = '//listed(in_quotes(words_of(keys(k)%of)), ' and ')// &
                     ', not of '//others// &
                     did_you_mean(key, pack(keys%name, is_own .and. keys%of /= '' .and. .not. is_given), "'", "'"))
                  is_told = .true.
               end if
               cycle
            end if
            ! Those that give the same quantity: a key alone, or all ways.
            family = is_own .and. keys%way/10 == keys(k)%way/10
            if (keys(k)%way == 0) family = keys%name == key
            first = findloc(family, .true., dim=1)
            if (keys(k)%required .and. k == first .and. self%place > 0 .and. .not. any(family .and. is_given) .and. &
                .not. self%has_unknown .and. (keys(k)%of == '' .or. choice /= '')) then
               if (keys(k)%way == 0) then
                  call problems%add(place, who//' needs '//key//' = '//allowed_values(keys(k)))
               else
                  call problems%add(place, who//' needs '//ways_in_words(keys, k))
               end if
            end if
            first = findloc(family .and. is_given, .true., dim=1)
            needs = words_of(keys(k)%needs)
            lacks = [(.not. stands_beside(trim(needs(i))), i=1, size(needs))]
            if (any(lacks) .or. any(family .and. is_given .and. keys%way /= keys(k)%way)) call self%leave_out(key)
            if (.not. is_given(k)) cycle
            if (keys(k)%way /= keys(first)%way .and. &
                .not. any(family(:k - 1) .and. is_given(:k - 1) .and. keys(:k - 1)%way /= keys(first)%way)) &
               call problems%add(max(self%place_of(keys(first)%name), self%place_of(key)), &
                  trim(keys(first)%name)//' and '//key//' contradict each other: give one of them')
            if (keys(k)%kind == logical_value .and. .not. self%logical(key)) cycle
            do i = 1, size(needs)
               if (.not. lacks(i) .or. self%has_unknown .or. index(said, ' '//trim(needs(i))//' ') > 0) cycle
               call self%complain(problems, key, key//' needs '//trim(needs(i))//' beside it')
               said = said//trim(needs(i))//' '
            end do
         end do
      end associate

   contains

      !> Whether the deck gives a key or, of key='value', whether it has that value or a bad one.
      logical function stands_beside(word)
         character(*), intent(in) :: word

         integer :: equals

         equals = index(word, '=')
         if (equals == 0) then
            stands_beside = self%has(word)
         else
            stands_beside = self%text(word(:equals - 1)) == word(equals + 2:len(word) - 1) .or. &
                            self%is_bad(word(:equals - 1))
         end if
      end function stands_beside

   end subroutine check_relations

end module wavycon_group_values
