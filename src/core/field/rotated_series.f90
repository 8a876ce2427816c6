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

   public :: to_difference_angles, to_sum_angles

contains

   !> Converts a series in phi and theta to a series in X and Y. The field also has the period (pi, pi), so that i + j
   !> is even in all its terms. A term (i, j) becomes the terms ((i+j)/2, |i-j|/2) and (|i-j|/2, (i+j)/2), each with
   !> half the coefficient.
   pure type(fourier_series) function to_sum_angles(series) result(rotated)
      type(fourier_series), intent(in) :: series   !! in phi and theta; terms with odd i + j are zero but for rounding

      rotated = in_other_angles(series, 2)
   end function to_sum_angles

   !> Converts a series in X and Y to a series in phi and theta, the inverse of to_sum_angles. The terms (i, j) and (j,
   !> i) become the terms (i + j, |i - j|) and (|i - j|, i + j).
   pure type(fourier_series) function to_difference_angles(series) result(rotated)
      type(fourier_series), intent(in) :: series   !! in X and Y; does not change if X and Y are exchanged

      rotated = in_other_angles(series, 1)
   end function to_difference_angles

   !> Converts in either direction. The new wave numbers are (i + j)/divisor and |i - j|/divisor; terms whose i + j the
   !> divisor does not divide are left out.
   pure type(fourier_series) function in_other_angles(series, divisor) result(rotated)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: divisor   !! 2 from phi, theta to X, Y; 1 back

      integer :: i, j, last

      last = sum(ubound(series%c))/divisor
      allocate (rotated%c(0:last, 0:last), source=0.0_dp)
      do j = 0, ubound(series%c, 2)
         do i = 0, ubound(series%c, 1)
            if (mod(i + j, divisor) /= 0) cycle
            associate (high => (i + j)/divisor, low => abs(i - j)/divisor)
               rotated%c(high, low) = rotated%c(high, low) + 0.5_dp*series%c(i, j)
               rotated%c(low, high) = rotated%c(low, high) + 0.5_dp*series%c(i, j)
            end associate
         end do
      end do
   end function in_other_angles

end module wavycon_rotated_series
