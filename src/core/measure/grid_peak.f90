!> The largest pressure of a solution on a grid, between its points: eq. (C13) of src/core/contact/README.md.
module wavycon_grid_peak
   use wavycon_grid_edge, only: grid_edge
   use wavycon_newton_maximiser, only: newton_maximiser
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: unknown
   implicit none (type, external)
   private

   public :: grid_peak_pressure

   !> Points of the polynomial each way: the peak lies on the step from 0 to 1.
   integer, parameter :: first = -2, last = 3

   !> The polynomial through 6 x 6 pressures, in steps of the grid. In 1-D all lines are equal.
   type, extends(newton_maximiser) :: peak_polynomial
      real(dp) :: values(first:last, first:last) = 0.0_dp
      logical :: in_plane = .true.
   contains
      procedure :: expand
   end type peak_polynomial

contains

   !> The maximum of the polynomial through the points about the largest pressure. At a crest on a mirror line, which
   !> lies midway between points, the polynomial is even. After `fetch_neighbours`.
   subroutine grid_peak_pressure(edge, peak, bend)
      type(grid_edge), intent(in) :: edge
      real(dp), intent(out) :: peak    !! in the unit of the edge's pressure
      !> Half the sum of the second differences at the largest pressure, (C16); 0 if all points of the polynomial are in
      !> contact, `unknown` if a neighbour of the largest pressure is open.
      real(dp), intent(out) :: bend

      real(dp) :: answer(2), highest
      integer :: best(2)

      ! The slab that has the first of the highest points computes the peak.
      call edge%slab%find_largest(edge%pressure_or_gap, highest, best)
      answer = 0.0_dp
      if (best(2) >= edge%slab%first .and. best(2) <= edge%slab%last) then
         call find_peak(edge, best, peak, bend)
         answer = [peak, bend]
      end if
      answer = edge%slab%total(answer)
      peak = answer(1)
      bend = answer(2)
   end subroutine grid_peak_pressure

   !> The same about a given point.
   pure subroutine find_peak(edge, best, peak, bend)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: best(2)       !! that has the largest pressure
      real(dp), intent(out) :: peak, bend

      !> The search leaves the step of the peak by no more than half a step.
      real(dp), parameter :: margin = 0.5_dp
      type(peak_polynomial) :: field
      real(dp) :: beside(4), height, place(2)
      integer :: base(2), i, j

      ! From the lines through the largest pressure both ways: a mirror image has the same peak.
      base = best
      if (edge%at(best(1) - 1, best(2)) > edge%at(best(1) + 1, best(2))) base(1) = best(1) - 1
      if (edge%at(best(1), best(2) - 1) > edge%at(best(1), best(2) + 1)) base(2) = best(2) - 1
      field = peak_polynomial(least=-margin, most=1.0_dp + margin, in_plane=edge%slab%points(2) > 1)
      do j = first, last
         do i = first, last
            field%values(i, j) = edge%at(base(1) + i, base(2) + j)
         end do
      end do
      peak = max(maxval(field%values), 0.0_dp)
      if (all(field%values > 0.0_dp)) then
         bend = 0.0_dp
         place = best - base
         call field%maximise(place, height)
         peak = max(peak, height)
      else
         beside = [edge%at(best(1) - 1, best(2)), edge%at(best(1) + 1, best(2)), edge%at(best(1), best(2) - 1), &
                   edge%at(best(1), best(2) + 1)]
         bend = merge(0.5_dp*sum(peak - beside), unknown, all(beside > 0.0_dp))
      end if
   end subroutine find_peak

   pure subroutine expand(self, place, height, gradient, hessian)
      class(peak_polynomial), intent(in) :: self
      real(dp), intent(in) :: place(2)
      real(dp), intent(out) :: height, gradient(2), hessian(3)

      real(dp), dimension(first:last, 0:2) :: along_x, along_y
      real(dp) :: derivatives(0:2, 0:2)   ! of each order along x and y

      along_x = weights(place(1))
      along_y = weights(place(2))
      derivatives = matmul(transpose(along_x), matmul(self%values, along_y))
      height = derivatives(0, 0)
      gradient = [derivatives(1, 0), derivatives(0, 1)]
      hessian = [derivatives(2, 0), derivatives(1, 1), derivatives(0, 2)]
      if (self%in_plane) return
      gradient(2) = 0.0_dp
      hessian(2:3) = [0.0_dp, hessian(1)]
   end subroutine expand

   !> Lagrange's polynomials of the points, and their first and second derivatives.
   pure function weights(t)
      real(dp), intent(in) :: t
      real(dp) :: weights(first:last, 0:2)

      integer :: i, k

      do k = first, last
         ! Value, first and half the second derivative of the product of (t - i)/(k - i).
         weights(k, :) = [1.0_dp, 0.0_dp, 0.0_dp]
         do i = first, last
            if (i /= k) weights(k, :) = ((t - i)*weights(k, :) + [0.0_dp, weights(k, :1)])/(k - i)
         end do
      end do
      weights(:, 2) = 2*weights(:, 2)
   end function weights

end module wavycon_grid_peak
