!> A group of a deck: the values of its keys, which are components of a record, and the table that describes them. A
!> list of keys connects both: what is read, checked and written for all keys alike goes through it.
module wavycon_key_group
   use wavycon_key_table, only: allowed_values, integer_value, is_read, key_index, key_type, logical_value, &
      name_length, real_value, ways_in_words, words_of
   use wavycon_key_values, only: check_number, read_value, word_value
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_plain_text, only: exact_number, in_quotes, integer_text, listed, quoted
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: key_group, key_list, key_value

   !> The value of one key and how it was given.
   type :: key_value
      integer :: place = 0                     !! byte of the deck's text where the key stands; 0 if it is absent
      logical :: is_given = .false.            !! by the deck
      logical :: is_bad = .false.              !! given, but its value cannot be used: omit checks that depend on it
      !> Whether the resolved deck shows it: it has a value, which has an effect beside those of other keys.
      logical :: in_effect = .false.
      real(dp), allocatable :: numbers(:)      !! of reals and integers; of logicals 1 for .true. and 0 for .false.
      real(dp) :: number = 0.0_dp              !! the first of them; 0 if there is none
      real(dp) :: pair(2) = 0.0_dp             !! the first and the last of them
      logical :: is_true = .false.             !! of a logical; of a number whether it is > 0
      character(:), allocatable :: text        !! of texts and choices, without blanks at its end; empty: it has none
   contains
      procedure :: set
      procedure :: set_default
   end type key_value

   !> What all groups have. Each extends it by its keys.
   type :: key_group
      character(:), allocatable :: deck_path   !! the deck's file, as the caller named it
      integer :: place = 0                     !! byte of the deck's text where '&name' stands; 0 if it is absent
      !> Whether the group, or a group in its place, has a key that the table has not: any other may have been meant.
      logical :: has_unknown = .false.
      logical :: any_bad = .false.             !! whether any key is bad or unknown
      type(problem_list_type) :: problems      !! with its keys
   contains
      procedure :: complain
   end type key_group

   type :: key_pointer
      type(key_value), pointer :: value => null()
   end type key_pointer

   !> The table of a group, a row for each key, and where their values are. It begins as
   !> `key_list(name, meaning, values%key_group)`.
   type :: key_list
      character(name_length) :: name = ''      !! of the group
      character(80) :: meaning = ''
      type(key_group), pointer :: group => null()   !! the record; it stays as long as the list
      logical :: required = .false.
      !> The key that selects an alternative, as a kind of surface or a solver, by its name; empty: there are none.
      character(name_length) :: selector = ''
      character(48) :: of = ''                 !! with which choices of the selector the keys added next are read
      type(key_type), allocatable :: rows(:)
      type(key_pointer), allocatable :: keys(:)
   contains
      procedure :: add
      procedure :: start
      procedure :: take
      procedure :: take_value
      procedure :: words
      procedure :: asked_for
      procedure :: check_relations
   end type key_list

contains

   !> Sets a value, which is then in effect.
   pure subroutine set(self, numbers, text)
      class(key_value), intent(inout) :: self
      real(dp), intent(in), optional :: numbers(:)
      character(*), intent(in), optional :: text

      self%in_effect = .true.
      if (present(text)) self%text = trim(text)
      if (.not. present(numbers)) return
      self%numbers = numbers
      if (size(numbers) == 0) return
      self%number = numbers(1)
      self%pair = numbers([1, size(numbers)])
      self%is_true = self%number > 0.0_dp
   end subroutine set

   !> Sets a default that depends on other values. It has no effect if the deck gives the key a good value.
   pure subroutine set_default(self, numbers, text)
      class(key_value), intent(inout) :: self
      real(dp), intent(in), optional :: numbers(:)   !! as of set
      character(*), intent(in), optional :: text

      if (.not. self%is_given .or. self%is_bad) call self%set(numbers, text)
   end subroutine set_default

   !> Reports a problem at the place of a key or, if it is absent, of the group.
   pure subroutine complain(self, key, words)
      class(key_group), intent(inout) :: self
      type(key_value), intent(in) :: key
      character(*), intent(in) :: words   !! what is wrong, what was expected

      call self%problems%add(merge(key%place, self%place, key%place > 0), words)
   end subroutine complain

   !> Adds a key: where its value is, and its row of the table.
   subroutine add(self, value, row)
      class(key_list), intent(inout) :: self
      type(key_value), intent(in), target :: value   !! a component of the record
      type(key_type), intent(in) :: row

      if (.not. allocated(self%rows)) allocate (self%rows(0), self%keys(0))
      self%rows = [self%rows, row]
      self%rows(size(self%rows))%of = self%of
      self%keys = [self%keys, key_pointer(value)]
   end subroutine add

   !> Sets the defaults of the table. A key whose default is in words has no value until `set_default` is called.
   subroutine start(self, deck_path)
      class(key_list), intent(inout) :: self
      character(*), intent(in) :: deck_path

      type(word_value) :: read
      character(:), allocatable :: trouble
      integer :: k

      self%group%deck_path = deck_path
      do k = 1, size(self%rows)
         associate (key => self%keys(k)%value)
            allocate (key%numbers(0))
            key%text = ''
            if (self%rows(k)%default == '') cycle
            call read_value(self%rows(k), trim(self%rows(k)%default), read, trouble)
            if (.not. allocated(trouble)) call key%set([read%number], read%text)
         end associate
      end do
   end subroutine start

   !> Takes what the deck gives for a key. Without a value it is bad: its default stays in effect.
   subroutine take(self, k, place, numbers, text)
      class(key_list), intent(inout) :: self
      integer, intent(in) :: k                                !! number of the key
      integer, intent(in) :: place                            !! of the key, byte of the deck's text
      real(dp), intent(in), optional :: numbers(:)            !! as of key_value, repeats expanded; empty: as absent
      character(*), intent(in), optional :: text

      associate (key => self%keys(k)%value)
         key%place = place
         key%is_given = .true.
         key%is_bad = .true.
         if (present(numbers)) key%is_bad = size(numbers) == 0
         if (.not. key%is_bad) call key%set(numbers, text)
      end associate
   end subroutine take

   !> Takes a number or a text that a caller in memory gives for a key, and reports one that it may not have.
   subroutine take_value(self, k, number, text)
      class(key_list), intent(inout) :: self
      integer, intent(in) :: k                       !! number of the key
      real(dp), intent(in), optional :: number       !! one of them
      character(*), intent(in), optional :: text

      character(:), allocatable :: trouble
      type(word_value) :: read

      if (present(number)) then
         read%number = number
         call check_number(self%rows(k), exact_number(number), number, trouble)
      else
         call read_value(self%rows(k), quoted(text), read, trouble)
      end if
      call self%take(k, 0, [read%number], read%text)
      if (allocated(trouble)) call self%group%problems%add(0, trouble)
   end subroutine take_value

   !> The value of a key as a deck gives it, numbers to all digits and texts without quotes.
   pure function words(self, k, between) result(text)
      class(key_list), intent(in) :: self
      integer, intent(in) :: k              !! number of the key
      character(*), intent(in) :: between   !! two numbers
      character(:), allocatable :: text

      integer, parameter :: most_digits = 24   !! and signs of a number
      character(:), allocatable :: number
      integer :: i, used

      associate (kind => self%rows(k)%kind, numbers => self%keys(k)%value%numbers)
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
            text = trim(merge('.true. ', '.false.', self%keys(k)%value%is_true))
         case default
            text = self%keys(k)%value%text
         end select
      end associate
   end function words

   !> 'group.', and 'group.key' of each key that asks for something: .true., a number > 0, a text other than 'none'.
   pure function asked_for(self) result(names)
      class(key_list), intent(in) :: self
      character(2*name_length) :: names(1 + size(self%rows))

      integer :: k

      names = trim(self%name)//'.'
      do k = 1, size(self%rows)
         associate (value => self%keys(k)%value)
            if (value%is_true .or. (value%text /= '' .and. value%text /= 'none')) &
               names(1 + k) = trim(names(1))//self%rows(k)%name
         end associate
      end do
   end function asked_for

   !> Reports required keys that are missing, keys without those that they need, keys that give the same in two ways,
   !> and keys that the selected alternative does not read. What has no effect is left out of the resolved deck: keys of
   !> other alternatives, keys without those that they need, and defaults beside another way to give the same. What
   !> follows from a mistake that has been reported is no problem of its own.
   !>
   !> A group with a selector has alternatives: &surface its kinds of surface, &method its solvers.
   subroutine check_relations(self)
      class(key_list), intent(in) :: self

      character(:), allocatable :: choice, key, others, said, who
      character(name_length), allocatable :: needs(:)
      integer :: first, i, k, place, selects
      logical :: is_default, is_told
      logical, allocatable :: lacks(:)
      logical, dimension(size(self%rows)) :: is_given, is_own, family

      choice = ''
      said = ' '
      place = self%group%place
      who = '&'//trim(self%name)
      is_default = .false.
      is_told = .false.
      is_own = .true.
      is_given = [(self%keys(k)%value%is_given, k=1, size(self%rows))]
      selects = key_index(self%rows, self%selector)
      if (selects > 0) then
         associate (selector => self%keys(selects)%value)
            is_default = .not. selector%is_given
            ! A bad selector, or one whose name is misspelt, has its default, which says nothing about the other keys.
            if (.not. (selector%is_bad .or. (is_default .and. self%group%has_unknown))) choice = selector%text
            if (choice /= '') then
               who = trim(self%selector)//" = '"//choice//"'"
               place = max(selector%place, place)
               is_own = is_read(self%rows, choice)
            end if
         end associate
      end if
      others = "'"//choice//"'"
      if (is_default) others = 'the default, '//others
      associate (rows => self%rows, group => self%group)
         do k = 1, size(rows)
            key = trim(rows(k)%name)
            associate (value => self%keys(k)%value)
               if (.not. is_own(k)) then
                  value%in_effect = .false.
                  ! Beside the default one key is enough to see that the selector is missing.
                  if (is_given(k) .and. .not. (value%is_bad .or. (is_default .and. is_told))) then
                     call group%complain(value, key//' is a key of '//trim(self%selector)//' = '// &
                        listed(in_quotes(words_of(rows(k)%of)), ' and ')//', not of '//others// &
                        did_you_mean(key, pack(rows%name, is_own .and. rows%of /= '' .and. .not. is_given), "'", "'"))
                     is_told = .true.
                  end if
                  cycle
               end if
               ! Those that give the same quantity: a key alone, or all ways.
               family = is_own .and. rows%way/10 == rows(k)%way/10
               if (rows(k)%way == 0) family = rows%name == key
               first = findloc(family, .true., dim=1)
               if (rows(k)%required .and. k == first .and. group%place > 0 .and. .not. group%has_unknown .and. &
                   .not. any(family .and. is_given) .and. (rows(k)%of == '' .or. choice /= '')) then
                  if (rows(k)%way == 0) then
                     call group%problems%add(place, who//' needs '//key//' = '//allowed_values(rows(k)))
                  else
                     call group%problems%add(place, who//' needs '//ways_in_words(rows, k))
                  end if
               end if
               first = findloc(family .and. is_given, .true., dim=1)
               needs = words_of(rows(k)%needs)
               lacks = [(.not. stands_beside(trim(needs(i))), i=1, size(needs))]
               if (any(lacks) .or. any(family .and. is_given .and. rows%way /= rows(k)%way)) value%in_effect = .false.
               if (.not. is_given(k)) cycle
               if (rows(k)%way /= rows(first)%way .and. &
                   .not. any(family(:k - 1) .and. is_given(:k - 1) .and. rows(:k - 1)%way /= rows(first)%way)) &
                  call group%problems%add(max(self%keys(first)%value%place, value%place), &
                     trim(rows(first)%name)//' and '//key//' contradict each other: give one of them')
               if (rows(k)%kind == logical_value .and. .not. value%is_true) cycle
               do i = 1, size(needs)
                  if (.not. lacks(i) .or. group%has_unknown .or. index(said, ' '//trim(needs(i))//' ') > 0) cycle
                  call group%complain(value, key//' needs '//trim(needs(i))//' beside it')
                  said = said//trim(needs(i))//' '
               end do
            end associate
         end do
      end associate

   contains

      !> Whether the deck gives a key or, of key='value', whether it has that value or a bad one.
      logical function stands_beside(word)
         character(*), intent(in) :: word

         integer :: equals

         equals = index(word//'=', '=')
         associate (value => self%keys(key_index(self%rows, word(:equals - 1)))%value)
            stands_beside = value%is_given
            if (equals < len(word)) stands_beside = value%is_bad .or. value%text == word(equals + 2:len(word) - 1)
         end associate
      end function stands_beside

   end subroutine check_relations

end module wavycon_key_group
