!> Finds the known names that may be meant by an unknown one, for "did you mean".
module wavycon_nearest_name
   use wavycon_key_table, only: name_length, words_of
   use wavycon_plain_text, only: listed, lower_case, replaced
   implicit none (type, external)
   private

   public :: near_names, nearest_name, nearest_slip, did_you_mean

   !> Most letters of a misspelt name that is compared. The limit bounds the time.
   integer, parameter :: longest = 40
   !> Fewest letters of a misspelt name that is looked for as a part of known names.
   integer, parameter :: shortest_part = 3
   !> Fewest letters of a name of which one wrong letter says more than that it is a part of other names: 'gap' is
   !> rather the end of 'mean_gap' than 'map'.
   integer, parameter :: shortest_slip = 4
   !> Fewest letters of a word that is looked for in meanings; most names that are found so; most that are told.
   integer, parameter :: shortest_word = 4, most_related = 6, most_told = 4
   !> The edit distance of a wrong letter. A missing or superfluous underscore counts 1, because it is more frequent.
   integer, parameter :: change = 2

contains

   !> The numbers of the known names that may be meant, best first. Meant is the first that is found of these:
   !>
   !> - the known name of which one letter is wrong, unless the misspelt name is short;
   !> - that of which each word of the misspelt name is a part, if need be with slips; words are what stands between
   !>   underscores;
   !> - those whose whole name is one of these words, otherwise those whose meanings have the rarest of them;
   !> - that of which at most a third of the letters are wrong, but one always may be.
   pure function near_names(name, known, is_given, meanings) result(near)
      character(*), intent(in) :: name                  !! lower case
      character(*), intent(in) :: known(:)              !! lower case, padded with blanks
      !> Whether a known name stands beside this one: of two at the same distance the other one is taken.
      logical, intent(in) :: is_given(:)
      character(*), intent(in), optional :: meanings(:) !! of the known names; absent: the third is left out
      integer, allocatable :: near(:)

      integer :: nearest

      nearest = 0
      if (len(name) >= shortest_slip) nearest = nearest_slip(name, known, is_given, most_wrong=1)
      if (nearest == 0) nearest = name_with(name, known)
      allocate (near(0))
      if (nearest == 0 .and. present(meanings)) near = related_names(name, known, meanings)
      if (nearest == 0 .and. size(near) == 0) nearest = nearest_slip(name, known, is_given)
      if (nearest > 0) near = [nearest]
   end function near_names

   !> The number of the known name that is nearest to a misspelt name; 0 if none is near.
   pure integer function nearest_name(name, known, is_given) result(nearest)
      character(*), intent(in) :: name, known(:)     !! as for near_names
      logical, intent(in), optional :: is_given(:)   !! as for near_names; absent: none does

      logical :: given(size(known))

      given = .false.
      if (present(is_given)) given = is_given
      nearest = sum(near_names(name, known, given))   ! which are one or none
   end function nearest_name

   !> The numbers of the names whose whole name is a word of a name, otherwise of those whose meanings have the rarest
   !> word, unless they are many. A final 's' of a word need not be there: it may be that of a plural or of "Young's".
   pure function related_names(name, known, meanings) result(related)
      character(*), intent(in) :: name, known(:), meanings(:)   !! as for near_names
      integer, allocatable :: related(:)

      character(:), allocatable :: text, word
      character(name_length), allocatable :: words(:)
      integer :: i, k, most
      logical :: has(size(known)), is_related(size(known))

      allocate (related(0))
      if (len(name) > longest) return
      text = replaced(name, '_', ' ')
      allocate (words, source=words_of(text))
      is_related = [(len_trim(known(i)) >= shortest_word .and. any(words == known(i)), i=1, size(known))]
      most = most_related + 1
      do k = 1, merge(0, size(words), any(is_related))
         word = trim(words(k))
         if (len(word) < shortest_word) cycle
         if (word(len(word):) == 's') word = word(:len(word) - 1)
         has = [(index(lower_case(meanings(i)), word) > 0, i=1, size(known))]
         if (.not. any(has) .or. count(has) >= most) cycle
         most = count(has)
         is_related = has
      end do
      related = pack([(i, i=1, size(known))], is_related)
      related = related(:min(size(related), most_told))
   end function related_names

   !> The number of the known name that is near to a misspelt name by its letters alone; 0 if none is.
   pure integer function nearest_slip(name, known, is_given, most_wrong) result(nearest)
      character(*), intent(in) :: name, known(:)      !! as for near_names
      logical, intent(in), optional :: is_given(:)    !! as for near_names
      integer, intent(in), optional :: most_wrong     !! letters; absent: a third of the name, at least one

      integer :: distance(size(known)), i, most

      nearest = 0
      if (len(name) == 0 .or. len(name) > longest .or. size(known) == 0) return
      most = max(1, len(name)/3)
      if (present(most_wrong)) most = most_wrong
      distance = [(edit_distance(name, trim(known(i))), i=1, size(known))]
      if (minval(distance) > change*most) return
      if (present(is_given)) distance = 2*distance + merge(1, 0, is_given)
      nearest = minloc(distance, dim=1)
   end function nearest_slip

   !> The number of the known name of which each word of a name is a part, or a slip of a word; 0 if there is none.
   !> Best is one that has the last word as a word, then one that ends with it, then the shortest. A word of one or two
   !> letters is in too many names: it must be one of their words.
   pure integer function name_with(name, known) result(best)
      character(*), intent(in) :: name, known(:)   !! as for near_names

      character(:), allocatable :: last
      character(name_length), allocatable :: words(:)
      integer :: i, length, pass, shortest

      best = 0
      if (len(name) < shortest_part .or. len(name) > longest) return
      allocate (words, source=words_of(replaced(name, '_', ' ')))
      if (size(words) == 0) return
      last = trim(words(size(words)))
      do pass = 1, 2   ! without slips, with them
         shortest = huge(shortest)
         do i = 1, size(known)
            if (.not. has_all(trim(known(i)), words, with_slips=pass == 2)) cycle
            length = len_trim(known(i))
            if (index('_'//trim(known(i))//'_', '_'//last//'_') == 0) length = length + 2*len(known)
            if (index(known(i)//' ', last//' ') == 0) length = length + len(known)
            if (length >= shortest) cycle
            shortest = length
            best = i
         end do
         if (best > 0) return
      end do
   end function name_with

   !> Whether a known name has all words.
   pure logical function has_all(known, words, with_slips)
      character(*), intent(in) :: known        !! lower case
      character(*), intent(in) :: words(:)     !! lower case, padded with blanks
      logical, intent(in) :: with_slips        !! whether one letter of a word may be wrong

      character(:), allocatable :: word
      integer :: k

      has_all = .true.
      do k = 1, size(words)
         word = trim(words(k))
         if (len(word) < shortest_part) then
            has_all = has_all .and. index('_'//known//'_', '_'//word//'_') > 0
         else if (index(known, word) == 0) then
            has_all = has_all .and. with_slips .and. len(word) >= shortest_slip
            if (has_all) has_all = nearest_slip(word, words_of(replaced(known, '_', ' ')), most_wrong=1) > 0
         end if
      end do
   end function has_all

   !> Words that end a message: "; did you mean 'x'?" if known names are near, else `otherwise` or nothing.
   pure function did_you_mean(name, known, before, after, otherwise, is_given, meanings) result(words)
      character(*), intent(in) :: name, known(:)               !! as for near_names
      character(*), intent(in) :: before, after                !! put around each known name
      character(*), intent(in), optional :: otherwise          !! words if none is near
      logical, intent(in), optional :: is_given(:)             !! as for near_names
      character(*), intent(in), optional :: meanings(:)        !! as for near_names
      character(:), allocatable :: words

      character(len(before) + len(known) + len(after)) :: told(most_told)
      logical :: given(size(known))
      integer :: i
      integer, allocatable :: near(:)

      words = ''
      if (present(otherwise)) words = otherwise
      given = .false.
      if (present(is_given)) given = is_given
      if (present(meanings)) then
         allocate (near, source=near_names(name, known, given, meanings))
      else
         allocate (near, source=near_names(name, known, given))
      end if
      if (size(near) == 0) return
      do i = 1, size(near)
         told(i) = before//trim(known(near(i)))//after
      end do
      words = '; did you mean '//listed(told(:size(near)), ' or ')
      if (present(is_given)) then
         if (is_given(near(1))) words = words//', which is there'
      end if
      words = words//'?'
   end function did_you_mean

   !> Edit distance of two texts: the least cost of insertions, deletions, changes and swaps of neighbouring letters
   !> that turn a into b. Each costs `change`, but to insert or delete an underscore costs 1.
   pure integer function edit_distance(a, b) result(distance)
      character(*), intent(in) :: a, b

      integer :: d(0:len(a), 0:len(b))   ! d(i, j): distance of the first i letters of a and the first j letters of b
      integer :: i, j

      d(:, 0) = [(change*i, i=0, len(a))]
      d(0, :) = [(change*j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            d(i, j) = min(d(i - 1, j) + merge(1, change, a(i:i) == '_'), &
                          d(i, j - 1) + merge(1, change, b(j:j) == '_'), &
                          d(i - 1, j - 1) + merge(0, change, a(i:i) == b(j:j)))
            if (min(i, j) == 1) cycle
            if (a(i - 1:i) == b(j:j)//b(j - 1:j - 1)) d(i, j) = min(d(i, j), d(max(i - 2, 0), max(j - 2, 0)) + change)
         end do
      end do
      distance = d(len(a), len(b))
   end function edit_distance

end module wavycon_nearest_name
