!> The largest pressure of a solution on a grid, between its points.
module wavycon_grid_peak
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_peak_pressure

   !> The polynomial goes through so many points each way, about the step that holds the peak.
   integer, parameter :: first = -2, last = 3

contains

   !> By the polynomial through the points about the largest pressure. At a crest of symmetry that lies midway
   !> between points it is even.
   pure subroutine grid_peak_pressure(edge, peak, resolved)
      type(grid_edge), intent(in) :: edge
      real(dp), intent(out) :: peak        !! in the unit of the edge's pressure
      logical, intent(out) :: resolved     !! whether all of these points are in contact

      real(dp) :: values(first:last, first:last), t(2)
      integer :: base(2), best(2), i, j, lines

      lines = size(edge%pressure_or_gap, 2)
      best = maxloc(edge%pressure_or_gap)
      base = best
      base(1) = merge(base(1) - 1, base(1), at(base(1) - 1, base(2)) > at(base(1) + 1, base(2)))
      if (lines > 1) base(2) = merge(base(2) - 1, base(2), at(base(1), base(2) - 1) > at(base(1), base(2) + 1))
      do j = first, last
         do i = first, last
            values(i, j) = at(base(1) + i, merge(base(2) + j, 1, lines > 1))
         end do
      end do
      resolved = all(values > 0.0_dp)
      values = max(values, 0.0_dp)
      peak = max(maxval(values), 0.0_dp)
      if (.not. resolved) return
      t = best - base
      call climb(values, lines > 1, t)
      peak = max(peak, polynomial(values, t, 0, 0))

   contains

      pure real(dp) function at(k, l)
         integer, intent(in) :: k, l

         at = edge%pressure_or_gap(edge%place(k, 1), edge%place(l, 2))
      end function at

   end subroutine grid_peak_pressure

   !> Newton's method, a little short of it so that it also climbs to a crest that is the same all along a line.
   pure subroutine climb(values, in_plane, t)
      real(dp), intent(in) :: values(first:last, first:last)
      logical, intent(in) :: in_plane
      real(dp), intent(inout) :: t(2)   !! 0..1, from one point to the next

      integer, parameter :: most_steps = 10
      real(dp), parameter :: short = 1e-3_dp
      real(dp) :: determinant, g(2), h(3), next(2)
      integer :: i

      do i = 1, most_steps
         g = [polynomial(values, t, 1, 0), 0.0_dp]
         h = [polynomial(values, t, 2, 0), 0.0_dp, 0.0_dp]
         if (in_plane) then
            g(2) = polynomial(values, t, 0, 1)
            h(2:3) = [polynomial(values, t, 1, 1), polynomial(values, t, 0, 2)]
         end if
         h([1, 3]) = h([1, 3]) - short*maxval(abs(h))
         determinant = h(1)*h(3) - h(2)**2
         if (.not. (determinant > 0.0_dp .and. h(1) < 0.0_dp)) return
         next = t - [h(3)*g(1) - h(2)*g(2), h(1)*g(2) - h(2)*g(1)]/determinant
         next = min(max(next, -0.5_dp), 1.5_dp)
         if (.not. polynomial(values, next, 0, 0) > polynomial(values, t, 0, 0)) return
         t = next
      end do
   end subroutine climb

   !> The polynomial through the values, or a derivative of it.
   pure real(dp) function polynomial(values, t, order_x, order_y)
      real(dp), intent(in) :: values(first:last, first:last), t(2)
      integer, intent(in) :: order_x, order_y   !! 0, 1 or 2

      real(dp) :: along_x(first:last), along_y(first:last)

      along_x = weights(t(1), order_x)
      along_y = weights(t(2), order_y)
      polynomial = dot_product(along_x, matmul(values, along_y))
   end function polynomial

   !> Lagrange's polynomials of the points, or their derivatives.
   pure function weights(t, order)
      real(dp), intent(in) :: t
      integer, intent(in) :: order   !! 0, 1 or 2
      real(dp) :: weights(first:last)

      real(dp) :: powers(0:2)
      integer :: i, k

      do k = first, last
         ! Value, first and half the second derivative of the product of (t - i)/(k - i).
         powers = [1.0_dp, 0.0_dp, 0.0_dp]
         do i = first, last
            if (i == k) cycle
            powers = ((t - i)*powers + [0.0_dp, powers(0), powers(1)])/(k - i)
         end do
         weights(k) = powers(order)*merge(2, 1, order == 2)
      end do
   end function weights

end module wavycon_grid_peak
