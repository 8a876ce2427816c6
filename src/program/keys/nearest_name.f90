!> Finds the known name nearest to a misspelt one, for "did you mean".
module wavycon_nearest_name
   implicit none (type, external)
   private

   public :: nearest_name, did_you_mean

   !> Most letters of a name that is compared; it bounds the time.
   integer, parameter :: longest = 40
   !> Fewest letters of a part of a name.
   integer, parameter :: shortest_part = 3
   !> The distance by a letter. That by an underscore is 1: it is forgotten more easily.
   integer, parameter :: change = 2

contains

   !> Number of the known name nearest to the one given; 0 if none is near.
   !>
   !> A name is near if at most a third of its letters, but at least one, are wrong, or if it is a part of a
   !> known name, which had better be its beginning. Of two names that are equally near it is the one that is not given.
   pure integer function nearest_name(name, known, is_given) result(nearest)
      character(*), intent(in) :: name      !! lower case
      character(*), intent(in) :: known(:)  !! lower case, padded with blanks
      logical, intent(in), optional :: is_given(:)   !! whether a known name stands beside this one; absent: none does

      integer :: distance(size(known)), i

      nearest = 0
      if (len(name) == 0 .or. len(name) > longest .or. size(known) == 0) return
      distance = [(edit_distance(name, trim(known(i))), i=1, size(known))]
      if (minval(distance) <= change*max(1, len(name)/3)) then
         if (present(is_given)) distance = 2*distance + merge(1, 0, is_given)
         nearest = minloc(distance, dim=1)
      else if (len(name) >= shortest_part) then
         nearest = findloc(index(known, name), 1, dim=1)
         if (nearest == 0) nearest = findloc(index(known, name) > 1, .true., dim=1)
      end if
   end function nearest_name

   !> "; did you mean 'x'?" if a name is near, else nothing or all names.
   pure function did_you_mean(name, known, before, after, otherwise, is_given) result(words)
      character(*), intent(in) :: name, known(:)            !! as for nearest_name
      character(*), intent(in) :: before, after             !! put around the known name
      character(*), intent(in), optional :: otherwise       !! words if none is near
      logical, intent(in), optional :: is_given(:)          !! as for nearest_name
      character(:), allocatable :: words

      integer :: nearest

      words = ''
      if (present(otherwise)) words = otherwise
      nearest = nearest_name(name, known, is_given)
      if (nearest == 0) return
      words = '; did you mean '//before//trim(known(nearest))//after
      if (present(is_given)) words = words//trim(merge(', which is there', '                ', is_given(nearest)))
      words = words//'?'
   end function did_you_mean

   !> Edit distance: the least sum of insertions, deletions, changes and swaps of neighbours that turn a into b.
   pure integer function edit_distance(a, b) result(distance)
      character(*), intent(in) :: a, b

      integer :: d(0:len(a), 0:len(b))   ! of the first letters of both
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
