!> A group of a deck, such as &surface. The values of its keys are components of a record, which extends `key_group`; a
!> table of rows describes the keys. A `key_list` connects both: procedures that read, check or write all keys alike go
!> through the list.
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
      integer :: position = 0                  !! position of the key in the deck's text, from 1; 0 if it is absent
      logical :: is_given = .false.            !! whether the deck gives the key
      !> Whether the key is given but its value cannot be used: checks that depend on the value are then left out.
      logical :: is_bad = .false.
      !> Whether the key has a value and other keys do not make the value irrelevant. The resolved deck shows such keys.
      logical :: in_effect = .false.
      !> Whether a comma between the numbers may be meant as a decimal point: blanks separate others, or 0 is the first
      !> of two loads.
      logical :: has_decimal_commas = .false.
      real(dp), allocatable :: numbers(:)      !! values of reals and integers; of logicals 1 for .true., 0 for .false.
      real(dp) :: number = 0.0_dp              !! the first of `numbers`; 0 if there is none
      real(dp) :: pair(2) = 0.0_dp             !! the first and the last of `numbers`
      logical :: is_true = .false.             !! whether `number` is > 0: the value of a logical key
      character(:), allocatable :: text        !! value of texts and choices, without blanks at its end; or empty
   contains
      procedure :: set, set_default
   end type key_value

   !> The components that the records of all groups have. The record of a group extends this type by its keys.
   type :: key_group
      character(:), allocatable :: deck_path   !! path of the deck's file as the caller gave it
      integer :: position = 0                  !! position of '&name' in the deck's text, from 1; 0 if it is absent
      !> Whether the deck has an unknown key in this group or, if the group is missing, an unknown group. The unknown
      !> key may mean any key that is missing, so that missing keys are not reported.
      logical :: has_unknown = .false.
      logical :: any_bad = .false.             !! whether any key is bad or unknown
      type(problem_list_type) :: problems      !! the problems that checks of the group have found
   contains
      procedure :: complain
   end type key_group

   !> An element of an array of pointers.
   type :: key_pointer
      type(key_value), pointer :: value => null()
   end type key_pointer

   !> The table of a group, with a row for each key, and pointers to the values of the keys. The constructor
   !> `key_list(name, meaning, values%key_group)` makes an empty list, `add` adds the keys, and `close` ends the list.
   type :: key_list
      character(name_length) :: name = ''      !! name of the group, without '&'
      character(80) :: meaning = ''            !! for --help
      type(key_group), pointer :: group => null()   !! the record, which must exist as long as the list
      logical :: required = .false.            !! whether a deck must have the group
      !> Name of the key that selects an alternative, a kind of surface or a solver; empty: the group has no
      !> alternatives.
      character(name_length) :: selector = ''
      character(48) :: of = ''                 !! choices of the selector that read the keys added next; empty: all
      type(key_type), allocatable :: rows(:)
      type(key_pointer), allocatable :: keys(:)   !! the values, in the order of `rows`
      integer, private :: number = 0           !! number of keys so far; until `close` the arrays may be longer
   contains
      procedure :: add
      procedure :: close => close_list
      procedure :: start, take, take_value, words, asked_for, check_relations
   end type key_list

contains

   !> Sets the value of a key, which is then in effect.
   pure subroutine set(self, numbers, text)
      class(key_value), intent(inout) :: self
      real(dp), intent(in), optional :: numbers(:)   !! values of reals, integers and logicals, as in the component
      character(*), intent(in), optional :: text     !! value of a text or a choice

      self%in_effect = .true.
      if (present(text)) self%text = trim(text)
      if (.not. present(numbers)) return
      self%numbers = numbers
      if (size(numbers) == 0) return
      self%number = numbers(1)
      self%pair = numbers([1, size(numbers)])
      self%is_true = self%number > 0.0_dp
   end subroutine set

   !> Sets a default that depends on other values. If the deck gives the key a good value, that value stays.
   pure subroutine set_default(self, numbers, text)
      class(key_value), intent(inout) :: self
      real(dp), intent(in), optional :: numbers(:)   !! as in `set`
      character(*), intent(in), optional :: text     !! as in `set`

      if (.not. self%is_given .or. self%is_bad) call self%set(numbers, text)
   end subroutine set_default

   !> Reports a problem at the position of a key or, if the deck does not give the key, of the group.
   pure subroutine complain(self, key, words)
      class(key_group), intent(inout) :: self
      type(key_value), intent(in) :: key
      character(*), intent(in) :: words   !! what is wrong, what was expected

      call self%problems%add(merge(key%position, self%position, key%position > 0), words)
   end subroutine complain

   !> Adds a key: a pointer to its value, and its row of the table.
   subroutine add(self, value, row)
      class(key_list), intent(inout) :: self
      type(key_value), intent(in), target :: value   !! the component of the record
      type(key_type), intent(in) :: row              !! its description; the component `of` follows from the list's

      integer, parameter :: first_size = 8

      if (.not. allocated(self%rows)) allocate (self%rows(first_size), self%keys(first_size))
      if (self%number == size(self%rows)) then
         ! Twice the size: to copy all rows for each key took most of the time of a short deck.
         self%rows = [self%rows, self%rows]
         self%keys = [self%keys, self%keys]
      end if
      self%number = self%number + 1
      self%rows(self%number) = row
      self%rows(self%number)%of = self%of
      self%keys(self%number)%value => value
   end subroutine add

   !> Ends the list: no key will be added.
   subroutine close_list(self)
      class(key_list), intent(inout) :: self   !! with at least one key

      type(key_type), allocatable :: rows(:)

      allocate (rows, source=self%rows(:self%number))
      call move_alloc(rows, self%rows)
      self%keys = self%keys(:self%number)
   end subroutine close_list

   !> Sets all keys to the defaults of the table. A default in words depends on other keys: such a key has no value
   !> until the group's check calls `set_default`.
   subroutine start(self, deck_path)
      class(key_list), intent(inout) :: self
      character(*), intent(in) :: deck_path   !! path of the deck's file as the caller gave it

      type(word_value) :: parsed
      character(:), allocatable :: trouble
      integer :: k

      self%group%deck_path = deck_path
      do k = 1, size(self%rows)
         associate (key => self%keys(k)%value, row => self%rows(k))
            allocate (key%numbers(0))
            key%text = ''
            if (row%default == '') cycle
            ! Words are known by their letters: to read them as a number would make a message that nobody sees.
            if (any(row%kind == [real_value, integer_value]) .and. verify(trim(row%default), '+-.0123456789e') > 0) &
               cycle
            call read_value(row, trim(row%default), parsed, trouble)
            if (.not. allocated(trouble)) call key%set([parsed%number], parsed%text)
         end associate
      end do
   end subroutine start

   !> Takes the values that the deck gives for a key. A key without values is bad, and its default stays in effect.
   subroutine take(self, k, position, numbers, text)
      class(key_list), intent(inout) :: self
      integer, intent(in) :: k                                !! number of the key
      integer, intent(in) :: position                         !! position of the key in the deck's text
      !> The values as numbers, as in key_value; for a text or a choice one number, which has no meaning. Empty or
      !> absent: no value.
      real(dp), intent(in), optional :: numbers(:)
      character(*), intent(in), optional :: text              !! value of a text or a choice

      associate (key => self%keys(k)%value)
         key%position = position
         key%is_given = .true.
         key%is_bad = .true.
         if (present(numbers)) key%is_bad = size(numbers) == 0
         if (.not. key%is_bad) call key%set(numbers, text)
      end associate
   end subroutine take

   !> Takes a number or a text that a program gives for a key, without a deck. A value that the key may not have is
   !> reported.
   subroutine take_value(self, k, number, text)
      class(key_list), intent(inout) :: self
      integer, intent(in) :: k                       !! number of the key
      real(dp), intent(in), optional :: number       !! the value of a real or an integer
      character(*), intent(in), optional :: text     !! the value of a text or a choice, if `number` is absent

      character(:), allocatable :: trouble
      type(word_value) :: parsed

      if (present(number)) then
         parsed%number = number
         call check_number(self%rows(k), exact_number(number), number, trouble)
      else
         call read_value(self%rows(k), quoted(text), parsed, trouble)
      end if
      call self%take(k, 0, [parsed%number], parsed%text)
      if (allocated(trouble)) call self%group%problems%add(0, trouble)
   end subroutine take_value

   !> The value of a key as a deck would give it: numbers to all digits, texts without quotes.
   pure function words(self, k, between) result(text)
      class(key_list), intent(in) :: self
      integer, intent(in) :: k              !! number of the key
      character(*), intent(in) :: between   !! separator of numbers
      character(:), allocatable :: text

      integer, parameter :: most_digits = 24   !! most characters of a number
      character(:), allocatable :: number
      integer :: i, used

      associate (key_kind => self%rows(k)%kind, numbers => self%keys(k)%value%numbers)
         select case (key_kind)
         case (real_value, integer_value)
            ! Appending numbers one by one would copy the text each time, for up to 100000 numbers.
            allocate (character((most_digits + len(between))*size(numbers)) :: text)
            used = 0
            do i = 1, size(numbers)
               number = exact_number(numbers(i))
               if (key_kind == integer_value) number = integer_text(nint(numbers(i)))
               if (i > 1) number = between//number
               text(used + 1:used + len(number)) = number
               used = used + len(number)
            end do
            text = text(:used)
         case (logical_value)
            text = '.false.'
            if (self%keys(k)%value%is_true) text = '.true.'
         case default
            text = self%keys(k)%value%text
         end select
      end associate
   end function words

   !> The name 'group.', and for each key that may request a table or a computation its name 'group.key': keys with the
   !> value .true., a number > 0, or a text other than 'none'. For other keys the result has 'group.' again.
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

   !> Checks the keys of the group against each other. Reported are required keys that are missing, keys given without
   !> those that they need, keys that give the same quantity in two ways, and keys that the selected alternative does
   !> not read. A problem that only follows from one already reported is left out.
   !>
   !> Keys without effect get in_effect = .false., so that the resolved deck does not show them: keys of other
   !> alternatives, keys without those that they need, and defaults of a quantity that is given in another way.
   !>
   !> A group with a selector has alternatives: &surface has kinds of surface, &method has solvers.
   subroutine check_relations(self)
      class(key_list), intent(in) :: self

      character(:), allocatable :: choice    ! the selected alternative; empty: there is none, or it is not known
      character(:), allocatable :: chosen    ! the alternative in words for messages
      character(:), allocatable :: reported  ! needed keys that were reported as missing, with blanks around each
      character(:), allocatable :: subject   ! subject of the message about a missing key
      character(:), allocatable :: key
      character(name_length), allocatable :: needs(:)
      integer :: first, i, k, position, selector_index
      logical :: is_default                  ! whether the alternative is the default
      logical :: is_told                     ! whether a key of another alternative was reported
      logical, allocatable :: is_lacking(:)  ! whether each needed key is missing
      logical, dimension(size(self%rows)) :: is_given, is_own, is_same   ! given; read; gives the same quantity

      choice = ''
      reported = ' '
      position = self%group%position
      subject = '&'//trim(self%name)
      is_default = .false.
      is_told = .false.
      is_own = .true.
      allocate (is_lacking(0))
      is_given = [(self%keys(k)%value%is_given, k=1, size(self%rows))]
      selector_index = key_index(self%rows, self%selector)
      if (selector_index > 0) then
         associate (selector => self%keys(selector_index)%value)
            is_default = .not. selector%is_given
            ! A selector that is bad or misspelt in the deck has its default, which is not what the user meant: no
            ! choice is known then.
            if (.not. (selector%is_bad .or. (is_default .and. self%group%has_unknown))) choice = selector%text
            if (choice /= '') then
               subject = trim(self%selector)//" = '"//choice//"'"
               position = max(selector%position, position)
               is_own = is_read(self%rows, choice)
            end if
         end associate
      end if
      chosen = "'"//choice//"'"
      if (is_default) chosen = 'the default, '//chosen
      associate (rows => self%rows, group => self%group)
         do k = 1, size(rows)
            key = trim(rows(k)%name)
            associate (value => self%keys(k)%value)
               if (.not. is_own(k)) then
                  value%in_effect = .false.
                  ! If the selector has its default, one report is enough to show that the selector is missing.
                  if (is_given(k) .and. .not. (value%is_bad .or. (is_default .and. is_told))) then
                     call group%complain(value, key//' is a key of '//trim(self%selector)//' = '// &
                        listed(in_quotes(words_of(rows(k)%of)), ' and ')//', not of '//chosen// &
                        did_you_mean(key, pack(rows%name, is_own .and. rows%of /= '' .and. .not. is_given), "'", "'"))
                     is_told = .true.
                  end if
                  cycle
               end if
               ! Most keys have no relations.
               if (rows(k)%way == 0 .and. rows(k)%needs == '' .and. .not. rows(k)%required) cycle
               ! The keys that give the same quantity: the key alone, or those of all ways.
               is_same = is_own .and. rows%way/100 == rows(k)%way/100
               if (rows(k)%way == 0) is_same = rows%name == key
               first = findloc(is_same, .true., dim=1)
               if (rows(k)%required .and. k == first .and. group%position > 0 .and. .not. group%has_unknown .and. &
                   .not. any(is_same .and. is_given) .and. (rows(k)%of == '' .or. choice /= '')) then
                  if (rows(k)%way == 0) then
                     call group%problems%add(position, subject//' needs '//key//' = '//allowed_values(rows(k)))
                  else
                     call group%problems%add(position, subject//' needs '//ways_in_words(rows, k))
                  end if
               end if
               first = findloc(is_same .and. is_given, .true., dim=1)
               needs = words_of(rows(k)%needs)
               is_lacking = [(.not. stands_beside(trim(needs(i))), i=1, size(needs))]
               if (any(is_lacking) .or. any(is_same .and. is_given .and. rows%way /= rows(k)%way)) &
                  value%in_effect = .false.
               if (.not. is_given(k)) cycle
               if (rows(k)%way /= rows(first)%way .and. &
                   .not. any(is_same(:k - 1) .and. is_given(:k - 1) .and. rows(:k - 1)%way /= rows(first)%way)) &
                  call group%problems%add(max(self%keys(first)%value%position, value%position), &
                     trim(rows(first)%name)//' and '//key//' contradict each other: give one of them')
               if (rows(k)%kind == logical_value .and. .not. value%is_true) cycle
               do i = 1, size(needs)
                  if (.not. is_lacking(i) .or. group%has_unknown) cycle
                  if (index(reported, ' '//trim(needs(i))//' ') > 0) cycle
                  call group%complain(value, key//' needs '//trim(needs(i))//' beside it')
                  reported = reported//trim(needs(i))//' '
               end do
            end associate
         end do
      end associate

   contains

      !> Whether the deck gives a needed key. If a value is needed too, whether the key has that value or a bad one.
      logical function stands_beside(word)
         character(*), intent(in) :: word   !! "key" or "key='value'"

         integer :: equals

         equals = index(word//'=', '=')
         associate (value => self%keys(key_index(self%rows, word(:equals - 1)))%value)
            stands_beside = value%is_given
            if (equals < len(word)) stands_beside = value%is_bad .or. value%text == word(equals + 2:len(word) - 1)
         end associate
      end function stands_beside

   end subroutine check_relations

end module wavycon_key_group
