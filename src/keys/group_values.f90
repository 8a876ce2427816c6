!> The values of one group of a deck: for each key of the group's table the value that the deck gives, or its default.
module wavycon_group_values
   use wavycon_assertion, only: assert
   use wavycon_key_table, only: key_group_type, key_index
   use wavycon_key_values, only: read_value, word_value
   use wavycon_kinds, only: dp
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

   !> To ask for a key that is not in the table is a programming error: a Debug build stops, any other build returns
   !> false, 0, or an empty list or text.
   type :: group_values
      type(key_group_type) :: table
      character(:), allocatable :: deck_path   !! the deck's file, as the caller named it
      !> The deck's label of lengths, for &surface; not allocated if the deck gives none.
      character(:), allocatable :: length_unit
      integer :: place = 0                     !! byte of the deck's text where '&name' stands; 0 if it is absent
      type(key_entry), allocatable, private :: entries(:)   !! of the keys of the table; 0 is the neutral one
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
      procedure :: integers
      procedure :: pair
      procedure :: real => get_real
      procedure :: integer => get_integer
      procedure :: logical => get_logical
      procedure :: text
      procedure, private :: set_numbers
      procedure, private :: set_text
      generic :: set => set_numbers, set_text
      procedure, private :: default_numbers
      procedure, private :: default_text
      generic :: set_default => default_numbers, default_text
      procedure :: complain
      procedure, private :: find
   end type group_values

contains

   !> Sets the defaults of the table. A key whose default is in words has no value until `set_default` is called.
   subroutine start(self, table, deck_path)
      class(group_values), intent(out) :: self
      type(key_group_type), intent(in) :: table
      character(*), intent(in) :: deck_path

      type(word_value) :: value
      character(:), allocatable :: trouble
      integer :: k

      self%table = table
      self%deck_path = deck_path
      allocate (self%entries(0:size(table%keys)))
      do k = 0, size(table%keys)
         allocate (self%entries(k)%numbers(0))
         self%entries(k)%text = ''
         if (k == 0) cycle
         if (table%keys(k)%default == '') cycle
         call read_value(table%keys(k), trim(table%keys(k)%default), value, trouble)
         if (.not. allocated(trouble)) call put(self, k, [value%number], value%text)
      end do
   end subroutine start

   !> Takes what the deck gives for a key. Without a value it is bad: its default stays in effect.
   pure subroutine take(self, key, place, numbers, text)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: place                            !! of the key, byte of the deck's text
      real(dp), intent(in), optional :: numbers(:)            !! as of key_entry, repeats expanded
      character(*), intent(in), optional :: text              !! of texts and choices

      integer :: k

      k = self%find(key)
      if (k == 0) return
      self%entries(k)%place = place
      self%entries(k)%is_bad = .not. present(numbers)
      if (present(numbers)) call put(self, k, numbers, text)
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

   !> Whether any key is bad.
   pure logical function any_bad(self)
      class(group_values), intent(in) :: self

      any_bad = any(self%entries%is_bad)
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

      integer :: k

      k = self%find(key)
      if (k > 0) self%entries(k)%applies = .false.
   end subroutine leave_out

   !> The values of a real or integer key, or that of a logical one, as of key_entry.
   pure function reals(self, key) result(numbers)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key
      real(dp), allocatable :: numbers(:)

      numbers = self%entries(self%find(key))%numbers
   end function reals

   !> The values of an integer key.
   pure function integers(self, key) result(numbers)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key
      integer, allocatable :: numbers(:)

      numbers = nint(self%reals(key))
   end function integers

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

   !> `set`: sets a value in place of the deck's or the default.
   pure subroutine set_numbers(self, key, numbers)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: numbers(:)   !! of an integer key without fractions

      call put(self, self%find(key), numbers)
   end subroutine set_numbers

   pure subroutine set_text(self, key, words)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key, words

      call put(self, self%find(key), text=words)
   end subroutine set_text

   !> `set_default`: sets a default that depends on other values. It has no effect if the deck gives the key a good
   !> value.
   pure subroutine default_numbers(self, key, numbers)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: numbers(:)   !! as of set

      if (.not. self%has(key) .or. self%is_bad(key)) call self%set(key, numbers)
   end subroutine default_numbers

   pure subroutine default_text(self, key, words)
      class(group_values), intent(inout) :: self
      character(*), intent(in) :: key, words

      if (.not. self%has(key) .or. self%is_bad(key)) call self%set(key, words)
   end subroutine default_text

   !> Sets the value of key number k. Entry 0, which stands for keys that do not exist, is not changed.
   pure subroutine put(self, k, numbers, text)
      class(group_values), intent(inout) :: self
      integer, intent(in) :: k
      real(dp), intent(in), optional :: numbers(:)
      character(*), intent(in), optional :: text

      if (k == 0) return
      self%entries(k)%has_value = .true.
      if (present(numbers)) self%entries(k)%numbers = numbers
      if (present(text)) self%entries(k)%text = trim(text)
   end subroutine put

   !> Reports a problem at the place of a key.
   pure subroutine complain(self, problems, key, words)
      class(group_values), intent(in) :: self
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: key
      character(*), intent(in) :: words   !! what is wrong, what was expected

      call problems%add(self%place_of(key), words)
   end subroutine complain

   !> The number of a key in the table; 0 if it is not there.
   pure integer function find(self, key) result(k)
      class(group_values), intent(in) :: self
      character(*), intent(in) :: key

      k = key_index(self%table%keys, key)
      if (k == 0) call assert(.false., 'no key '//key//' in &'//trim(self%table%name))
   end function find

end module wavycon_group_values
