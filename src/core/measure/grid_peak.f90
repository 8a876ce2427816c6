!> The largest pressure of a solution on a grid, interpolated between the points: eq. (C13) of
!> src/core/contact/README.md.
module wavycon_grid_peak
   use wavycon_grid_edge, only: grid_edge
   use wavycon_newton_maximiser, only: newton_maximiser
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: unknown
   implicit none (type, external)
   private

   public :: grid_peak_pressure

   !> The points of the polynomial along each direction are -2 .. 3, so that the peak lies in the middle step, 0 to 1.
   integer, parameter :: first = -2, last = 3

   !> The polynomial of degree 5 along each direction through 6 x 6 pressures; coordinates are in grid steps.
   type, extends(newton_maximiser) :: peak_polynomial
      real(dp) :: values(first:last, first:last) = 0.0_dp   !! pressures at the points, in 1-D the same in all columns
      logical :: in_plane = .true.                          !! false in 1-D
   contains
      procedure :: expand
   end type peak_polynomial

contains

   !> Finds the maximum of the polynomial through the points around the largest pressure, (C13). If a point of the
   !> polynomial is outside of contact, the result is the largest pressure at the points. At a crest on a mirror line,
   !> midway between two points, the polynomial is even.
   subroutine grid_peak_pressure(edge, peak, bend)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`
      real(dp), intent(out) :: peak         !! the peak pressure, in the unit of the edge's pressure
      !> Zero if all points of the polynomial are in contact. Otherwise, for the error estimate (C16), minus half the
      !> sum of the pressure's second differences at the largest pressure, or `unknown` if one of its four neighbours is
      !> not in contact.
      real(dp), intent(out) :: bend

      real(dp) :: answer(2), highest
      integer :: best(2)

      ! The process that has the first of the points with the largest pressure computes the peak, and all get the sum.
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

   !> The same, given the point with the largest pressure.
   pure subroutine find_peak(edge, best, peak, bend)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: best(2)              !! the point (k, l) with the largest pressure
      real(dp), intent(out) :: peak, bend         !! as of grid_peak_pressure

      !> How far the search may leave the middle step, where the polynomial is accurate [grid steps].
      real(dp), parameter :: margin = 0.5_dp
      type(peak_polynomial) :: field
      real(dp) :: beside(4), height, position(2)
      integer :: base(2), i, j

      ! Along each direction the middle step of the polynomial goes from the largest pressure to the larger one of its
      ! two neighbours. So a solution and its mirror image have the same peak.
      base = best
      if (edge%value_at(best(1) - 1, best(2)) > edge%value_at(best(1) + 1, best(2))) base(1) = best(1) - 1
      if (edge%value_at(best(1), best(2) - 1) > edge%value_at(best(1), best(2) + 1)) base(2) = best(2) - 1
      field = peak_polynomial(least=-margin, most=1.0_dp + margin, in_plane=edge%slab%points(2) > 1)
      do j = first, last
         do i = first, last
            field%values(i, j) = edge%value_at(base(1) + i, base(2) + j)
         end do
      end do
      peak = max(maxval(field%values), 0.0_dp)
      if (all(field%values > 0.0_dp)) then
         bend = 0.0_dp
         position = best - base
         call field%maximise(position, height)
         peak = max(peak, height)
      else
         beside = [edge%value_at(best(1) - 1, best(2)), edge%value_at(best(1) + 1, best(2)), &
                   edge%value_at(best(1), best(2) - 1), edge%value_at(best(1), best(2) + 1)]
         bend = unknown
         if (all(beside > 0.0_dp)) bend = 0.5_dp*sum(peak - beside)
      end if
   end subroutine find_peak

   !> The polynomial and its derivatives at a point. In 1-D the second direction gets the curvature of the first one and
   !> no slope, so that Newton's step along it is zero.
   pure subroutine expand(self, place, height, gradient, hessian)
      class(peak_polynomial), intent(in) :: self
      real(dp), intent(in) :: place(2)                !! [grid steps]
      real(dp), intent(out) :: height                 !! value of the polynomial
      real(dp), intent(out) :: gradient(2)            !! derivatives along x, y
      real(dp), intent(out) :: hessian(3)             !! derivatives xx, xy, yy

      real(dp), dimension(first:last, 0:2) :: along_x, along_y
      real(dp) :: derivatives(0:2, 0:2)   ! (i, j): of order i along x and j along y

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

   !> The Lagrange polynomials of the points -2 .. 3 at a coordinate, and their first and second derivatives.
   pure function weights(t)
      real(dp), intent(in) :: t              !! coordinate [grid steps]
      real(dp) :: weights(first:last, 0:2)   !! second index: order of the derivative

      integer :: i, k

      do k = first, last
         ! The product of (t - i)/(k - i) over all i /= k: its value, first derivative and half its second derivative.
         weights(k, :) = [1.0_dp, 0.0_dp, 0.0_dp]
         do i = first, last
            if (i /= k) weights(k, :) = ((t - i)*weights(k, :) + [0.0_dp, weights(k, :1)])/(k - i)
         end do
      end do
      weights(:, 2) = 2*weights(:, 2)
   end function weights

end module wavycon_grid_peak
