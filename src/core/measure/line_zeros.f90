!> Zeros of a cosine series in one variable, and the part of a range that lies between them.
module wavycon_line_zeros
   use wavycon_fourier_series, only: evaluate_line
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: part_inside, line_zeros, zero_between

contains

   !> Finds the zeros of a cosine series between 0 and pi: one in each interval of a grid at whose ends the series has
   !> different signs. Two zeros within one interval are not found.
   pure subroutine line_zeros(c, intervals, zeros)
      real(dp), intent(in) :: c(0:)                        !! sum_i c_i cos(i x), shape (0:n)
      integer, intent(in) :: intervals                     !! number of intervals between 0 and pi
      real(dp), allocatable, intent(out) :: zeros(:)       !! ascending [rad]

      real(dp) :: crossings(intervals), values(0:intervals), slope, step
      integer :: k, found

      step = pi/intervals
      do k = 0, intervals
         call evaluate_line(c, k*step, values(k), slope)
      end do
      found = 0
      do k = 1, intervals
         if ((values(k - 1) >= 0.0_dp) .eqv. (values(k) >= 0.0_dp)) cycle
         found = found + 1
         call zero_between(c, (k - 1)*step, step, values(k - 1), values(k), crossings(found), slope)
      end do
      allocate (zeros, source=crossings(:found))
   end subroutine line_zeros

   !> The fraction of the range from 0 to `last` that lies inside. At each edge inside and outside change.
   pure real(dp) function part_inside(edges, starts_inside, last) result(part)
      real(dp), intent(in) :: edges(:)          !! ascending, within the range [rad]
      logical, intent(in) :: starts_inside      !! whether 0 lies inside
      real(dp), intent(in) :: last              !! end of the range [rad]

      associate (ends => [0.0_dp, edges, last])
         associate (widths => ends(2:) - ends(:size(ends) - 1))
            part = sum(widths(merge(1, 2, starts_inside)::2))/last
         end associate
      end associate
   end function part_inside

   !> The zero of sum_i c_i cos(i x) between two points at which its signs differ, by Newton's method. A step that would
   !> leave the bracket of the zero is replaced by bisection.
   pure subroutine zero_between(c, start, step, at_start, at_end, x, slope)
      real(dp), intent(in) :: c(0:)                 !! shape (0:n)
      real(dp), intent(in) :: start, step           !! bracket [start, start + step]
      real(dp), intent(in) :: at_start, at_end      !! values there, of opposite sign
      real(dp), intent(out) :: x, slope             !! the zero and the derivative there

      integer, parameter :: most_iterations = 60   ! enough for bisection alone
      real(dp) :: left, right, value, newton
      integer :: iteration

      left = start
      right = start + step
      x = start + step*at_start/(at_start - at_end)
      do iteration = 1, most_iterations
         call evaluate_line(c, x, value, slope)
         if ((value >= 0.0_dp) .eqv. (at_start >= 0.0_dp)) then
            left = x
         else
            right = x
         end if
         newton = 0.5_dp*(left + right)
         if (abs(slope)*(right - left) > abs(value)) newton = x - value/slope
         if (newton < left .or. newton > right) newton = 0.5_dp*(left + right)
         if (abs(newton - x) <= 4*epsilon(x)*max(1.0_dp, abs(x))) exit
         x = newton
      end do
   end subroutine zero_between

end module wavycon_line_zeros
