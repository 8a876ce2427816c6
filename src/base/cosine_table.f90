!> Cosines at equally spaced points of half a period.
module wavycon_cosine_table
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: cosine_table, folded

contains

   !> cos(i pi k/N), k = 0..N, i = 0..n. The multiple i k of pi/N is reduced to 0..N in integers. So the symmetries of
   !> the cosine hold to the last bit, and high harmonics are as accurate as low ones.
   pure function cosine_table(intervals, harmonics) result(table)
      integer, intent(in) :: intervals   !! N >= 1
      integer, intent(in) :: harmonics   !! n >= 0
      real(dp) :: table(0:intervals, 0:harmonics)

      real(dp) :: cosine(0:intervals)
      integer :: i, k

      ! N.B. Of an array expression gfortran computes several cosines at a time, whose last digits differ.
      do k = 0, intervals
         if (2*k == intervals) then
            cosine(k) = 0.0_dp
         else if (2*k < intervals) then
            cosine(k) = cos(pi*k/intervals)
         else
            cosine(k) = -cosine(intervals - k)
         end if
      end do
      do i = 0, harmonics
         table(:, i) = cosine(folded([(i*k, k=0, intervals)], intervals))
      end do
   end function cosine_table

   !> The node of 0..N at which a field that is even and periodic in phi = pi k/N has the same value as at node k.
   elemental integer function folded(k, intervals)
      integer, intent(in) :: k           !! any node
      integer, intent(in) :: intervals   !! N >= 1, intervals of half a period

      folded = modulo(k, 2*intervals)
      folded = min(folded, 2*intervals - folded)
   end function folded

end module wavycon_cosine_table
