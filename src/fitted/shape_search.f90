!> Where a place lies with respect to a mapped disc: its preimage, and its distance from the edge.
module wavycon_shape_search
   use wavycon_constants, only: pi
   use wavycon_fitted_tuning, only: farthest_inverse_start, longest_inverse_step
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: find_preimage, find_edge_in_direction, distance_from_edge

   !> Safety limit: most steps of either of Newton's iterations. Places for which the continued map has a preimage take
   !> fewer. At the limit no preimage is found, and the place counts as far or as outside; a polar angle that is not
   !> found is only a worse start.
   integer, parameter :: most_inverse_steps = 40
   !> Guard: Jacobian over b_0^2 below which the inversion ends without a preimage, as Newton's method would step across
   !> the fold of the continued map. The place then counts as outside, and integrals to it take the rule over the disc.
   !> It matters in fields near merging: without it a map of the hexagonal wave at P = 0.7 p* takes four times as long.
   real(dp), parameter :: least_inverse_jacobian = 1e-3_dp

contains

   !> The preimage of a place under the map, or outside the disc under its continuation: z(w) = z.
   !>
   !> Newton's method, README.md (F19), from the point of the edge that is seen from the centre in the direction of z.
   !> The shapes in use are star-shaped: there is one such point.
   pure subroutine find_preimage(shape, z, w, found)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: z                !! [s]
      complex(dp), intent(out) :: w
      logical, intent(out) :: found               !! false where the continued map folds before it gets to z

      !> Step, and distance over b_0, that rounding leaves.
      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)
      complex(dp) :: analytic, edge, left, slope, step
      real(dp) :: jacobian
      integer :: i

      w = 0.0_dp
      found = abs(z) <= tiny(1.0_dp)
      if (found) return
      call find_edge_in_direction(shape, z, w, edge)
      w = w*min(abs(z)/abs(edge), farthest_inverse_start)
      do i = 1, most_inverse_steps
         left = z - shape%place(w)
         slope = shape%conjugate_slope(w)
         analytic = shape%b(0)*shape%analytic_slope(w)
         jacobian = analytic%re**2 + analytic%im**2 - (slope%re**2 + slope%im**2)
         if (.not. jacobian > least_inverse_jacobian*shape%b(0)**2) return
         step = (conjg(analytic)*left - slope*conjg(left))/jacobian
         w = w + step*min(1.0_dp, longest_inverse_step/max(abs(step), tiny(1.0_dp)))
         found = abs(step) <= rounding .or. abs(left) <= rounding*shape%b(0)
         if (found) return
      end do
   end subroutine find_preimage

   !> The point of the edge that lies in the direction of z, by Newton's method for its polar angle between two mirror
   !> lines, and by halving where that would leave them: at sharp tips and on long flat sides.
   pure subroutine find_edge_in_direction(shape, z, w, edge)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: z         !! not the centre
      complex(dp), intent(out) :: w        !! |w| = 1
      complex(dp), intent(out) :: edge     !! z(w) [s]

      !> Angle that is good enough for a start.
      real(dp), parameter :: angle_tolerance = 1e-10_dp
      real(dp) :: above, angle, below, direction, missing
      integer :: i

      direction = atan2(z%im, z%re)
      below = pi/shape%fold*floor(direction*shape%fold/pi)
      above = below + pi/shape%fold
      angle = direction
      do i = 1, most_inverse_steps
         w = exp(cmplx(0.0_dp, angle, dp))
         edge = shape%place(w)
         missing = direction - atan2(edge%im, edge%re)
         missing = missing - 2*pi*anint(missing/(2*pi))
         if (abs(missing) < angle_tolerance) exit
         if (missing > 0.0_dp) then
            below = angle
         else
            above = angle
         end if
         ! The polar angle's derivative, which is small at tips.
         angle = angle + missing/max(real(shape%tangent(w)/edge, dp), tiny(1.0_dp))
         if (.not. (angle > below .and. angle < above)) angle = 0.5_dp*(below + above)
      end do
   end subroutine find_edge_in_direction

   !> Distance of a place from the edge, negative inside [s]: from the nearest of some points by halving their distance.
   pure real(dp) function distance_from_edge(shape, z) result(distance)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: z       !! [s]

      !> Enough to find the nearest of the tips: the highest harmonic of the edge has some 40 periods.
      integer, parameter :: distance_points = 128
      !> They bring the angle to 5e-11. At its least the distance varies as the square: it is exact to rounding.
      integer, parameter :: distance_halvings = 30
      complex(dp) :: edge(-1:1), outwards
      real(dp) :: angle, length(distance_points), step
      integer :: i, nearest

      length = abs(z - shape%place([(exp(cmplx(0.0_dp, 2*pi*i/distance_points, dp)), i=1, distance_points)]))
      angle = 2*pi*minloc(length, 1)/distance_points
      step = 2*pi/distance_points
      do i = 1, distance_halvings
         step = 0.5_dp*step
         edge = shape%place(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
         nearest = minloc(abs(z - edge), 1) - 2
         angle = angle + nearest*step
      end do
      edge = shape%place(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
      outwards = (0.0_dp, -1.0_dp)*(edge(1) - edge(-1))
      distance = sign(abs(z - edge(0)), real((z - edge(0))*conjg(outwards), dp))
   end function distance_from_edge

end module wavycon_shape_search
