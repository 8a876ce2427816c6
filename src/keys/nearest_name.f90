!> Finds the known name nearest to a misspelt one, for "did you mean".
module wavycon_nearest_name
   implicit none (type, external)
   private

   public :: nearest_name, edit_distance, did_you_mean

   !> Most letters of a name that is compared; it bounds the time.
   integer, parameter :: longest = 40
   !> Fewest letters of an abbreviation.
   integer, parameter :: shortest_abbreviation = 3

contains

   !> Number of the known name nearest to the one given; 0 if none is near.
   !>
   !> A name is near if at most a third of its letters, but at least one, are wrong, or if it abbreviates a known name.
   pure integer function nearest_name(name, known) result(nearest)
      character(*), intent(in) :: name      !! lower case
      character(*), intent(in) :: known(:)  !! lower case, padded with blanks

      integer :: distance, i, least

      nearest = 0
      if (len(name) == 0 .or. len(name) > longest) return
      least = max(1, len(name)/3) + 1
      do i = 1, size(known)
         distance = edit_distance(name, trim(known(i)))
         if (distance < least) then
            least = distance
            nearest = i
         end if
      end do
      if (nearest > 0 .or. len(name) < shortest_abbreviation) return
      do i = 1, size(known)
         if (index(known(i), name) == 1) then
            nearest = i
            return
         end if
      end do
   end function nearest_name

   !> "; did you mean 'x'?" if a name is near, else nothing.
   pure function did_you_mean(name, known, before, after) result(words)
      character(*), intent(in) :: name, known(:)  !! as for nearest_name
      character(*), intent(in) :: before, after   !! put around the known name
      character(:), allocatable :: words

      integer :: nearest

      words = ''
      nearest = nearest_name(name, known)
      if (nearest > 0) words = '; did you mean '//before//trim(known(nearest))//after//'?'
   end function did_you_mean

   !> Edit distance: the least number of insertions, deletions, changes and swaps of neighbours that turn a into b.
   pure integer function edit_distance(a, b) result(distance)
      character(*), intent(in) :: a, b

      integer :: row(0:len(b)), last(0:len(b)), last_but_one(0:len(b))
      integer :: i, j

      last_but_one = 0
      row = [(j, j=0, len(b))]
      do i = 1, len(a)
         last = row
         row(0) = i
         do j = 1, len(b)
            row(j) = min(last(j) + 1, row(j - 1) + 1, last(j - 1) + merge(0, 1, a(i:i) == b(j:j)))
            if (i > 1 .and. j > 1) then
               if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) &
                  row(j) = min(row(j), last_but_one(max(j - 2, 0)) + 1)
            end if
         end do
         last_but_one = last
      end do
      distance = row(len(b))
   end function edit_distance

end module wavycon_nearest_name
