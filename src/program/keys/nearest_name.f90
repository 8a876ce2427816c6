!> Finds the known name nearest to a misspelt one, for "did you mean".
module wavycon_nearest_name
   implicit none (type, external)
   private

   public :: nearest_name, nearest_slip, did_you_mean

   !> Most letters of a misspelt name that is compared. The limit bounds the time.
   integer, parameter :: longest = 40
   !> Fewest letters of a misspelt name that is looked for as a part of known names.
   integer, parameter :: shortest_part = 3
   !> The edit distance of a wrong letter. A missing or superfluous underscore counts 1, because it is more frequent.
   integer, parameter :: change = 2

contains

   !> The number of the known name that is nearest to a misspelt name; 0 if none is near.
   !>
   !> A known name is near if at most a third of the letters are wrong, but one letter always may be. Otherwise it is
   !> near if the misspelt name is a part of it: best of the shortest one. Of two known names at the same distance the
   !> one that the deck does not give is taken.
   pure integer function nearest_name(name, known, is_given) result(nearest)
      character(*), intent(in) :: name      !! lower case
      character(*), intent(in) :: known(:)  !! lower case, padded with blanks
      logical, intent(in), optional :: is_given(:)   !! whether a known name stands beside this one; absent: none does

      nearest = nearest_slip(name, known, is_given)
      if (nearest > 0 .or. len(name) < shortest_part .or. len(name) > longest) return
      nearest = minloc(len_trim(known), dim=1, mask=index(known, name) > 0)
   end function nearest_name

   !> The number of the known name that is near to a misspelt name by its letters alone; 0 if none is.
   pure integer function nearest_slip(name, known, is_given) result(nearest)
      character(*), intent(in) :: name, known(:)         !! as for nearest_name
      logical, intent(in), optional :: is_given(:)       !! as for nearest_name

      integer :: distance(size(known)), i

      nearest = 0
      if (len(name) == 0 .or. len(name) > longest .or. size(known) == 0) return
      distance = [(edit_distance(name, trim(known(i))), i=1, size(known))]
      if (minval(distance) > change*max(1, len(name)/3)) return
      if (present(is_given)) distance = 2*distance + merge(1, 0, is_given)
      nearest = minloc(distance, dim=1)
   end function nearest_slip

   !> Words that end a message: "; did you mean 'x'?" if a known name is near, else `otherwise` or nothing.
   pure function did_you_mean(name, known, before, after, otherwise, is_given) result(words)
      character(*), intent(in) :: name, known(:)            !! as for nearest_name
      character(*), intent(in) :: before, after             !! put around the known name
      character(*), intent(in), optional :: otherwise       !! words if none is near
      logical, intent(in), optional :: is_given(:)          !! as for nearest_name
      character(:), allocatable :: words

      integer :: candidate

      words = ''
      if (present(otherwise)) words = otherwise
      candidate = nearest_name(name, known, is_given)
      if (candidate == 0) return
      words = '; did you mean '//before//trim(known(candidate))//after
      if (present(is_given)) then
         if (is_given(candidate)) words = words//', which is there'
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
