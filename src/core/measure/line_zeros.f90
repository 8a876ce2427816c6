!> Zeros of a cosine series along a line.
module wavycon_line_zeros
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: evaluate_line
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: part_inside, line_zeros, zero_between

contains

   !> The zeros between 0 and pi, ascending: those of the intervals of a grid at whose ends the signs differ.
   pure subroutine line_zeros(c, intervals, zeros)
      real(dp), intent(in) :: c(0:)                        !! sum_i c_i cos(i x), shape (0:n)
      integer, intent(in) :: intervals                     !! of the grid
      real(dp), allocatable, intent(out) :: zeros(:)       !! [rad]

      real(dp) :: found(intervals), values(0:intervals), slope, step
      integer :: k, count

      step = pi/intervals
      do k = 0, intervals
         call evaluate_line(c, k*step, values(k), slope)
      end do
      count = 0
      do k = 1, intervals
         if ((values(k - 1) >= 0.0_dp) .eqv. (values(k) >= 0.0_dp)) cycle
         count = count + 1
         call zero_between(c, (k - 1)*step, step, values(k - 1), values(k), found(count), slope)
      end do
      allocate (zeros, source=found(:count))
   end subroutine line_zeros

   !> The part of a range from 0 on that is inside, given the places where inside and outside change.
   pure real(dp) function part_inside(edges, starts_inside, last) result(part)
      real(dp), intent(in) :: edges(:)          !! ascending [rad]
      logical, intent(in) :: starts_inside
      real(dp), intent(in) :: last              !! end of the range [rad]

      associate (ends => [0.0_dp, edges, last])
         associate (widths => ends(2:) - ends(:size(ends) - 1))
            part = sum(widths(merge(1, 2, starts_inside)::2))/last
         end associate
      end associate
   end function part_inside

   !> Where sum_i c_i cos(i x) changes sign between two points: Newton's method, kept inside the bracket by
   !> bisection.
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
