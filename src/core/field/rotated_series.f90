!> Converts Fourier series between axes that are rotated by 45 degrees, X = phi + theta, Y = phi - theta, for even
!> fields on a square lattice.
!>
!> A field that is even in both pairs of angles, and does not change when the two angles of a pair are exchanged, is a
!> sum of cos iX cos jY + cos jX cos iY = cos(i+j)phi cos(i-j)theta + cos(i-j)phi cos(i+j)theta.
module wavycon_rotated_series
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: in_other_angles

   !> The directions of the conversion. A term (i, j) has the new wave numbers (i + j)/direction and |i - j|/direction.
   integer, parameter, public :: to_difference_angles = 1, to_sum_angles = 2

contains

   !> With `to_sum_angles` converts a series in phi and theta to a series in X and Y. The field also has the period (pi,
   !> pi), so that i + j is even in all its terms; terms with an odd sum, which are rounding, are left out. A term
   !> (i, j) becomes the terms ((i+j)/2, |i-j|/2) and (|i-j|/2, (i+j)/2), each with half the coefficient.
   !>
   !> With `to_difference_angles` converts a series in X and Y, which does not change if X and Y are exchanged, to one
   !> in phi and theta: the inverse. The terms (i, j) and (j, i) become the terms (i + j, |i - j|) and (|i - j|, i + j).
   pure type(fourier_series) function in_other_angles(series, direction) result(rotated)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: direction   !! to_sum_angles or to_difference_angles

      integer :: i, j, last

      last = sum(ubound(series%c))/direction
      allocate (rotated%c(0:last, 0:last), source=0.0_dp)
      do j = 0, ubound(series%c, 2)
         do i = 0, ubound(series%c, 1)
            if (mod(i + j, direction) /= 0) cycle
            associate (high => (i + j)/direction, low => abs(i - j)/direction)
               rotated%c(high, low) = rotated%c(high, low) + 0.5_dp*series%c(i, j)
               rotated%c(low, high) = rotated%c(low, high) + 0.5_dp*series%c(i, j)
            end associate
         end do
      end do
   end function in_other_angles

end module wavycon_rotated_series
