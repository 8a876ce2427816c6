!> The preimage of a position under the map of the disc, and the distance of a position from the edge.
module wavycon_shape_search
   use wavycon_kinds, only: dp, pi
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: distance_from_edge, edge_points, find_edge_in_direction, find_preimage

   !> Safety limit: the largest number of steps of both Newton iterations. Positions that have a preimage take fewer. At
   !> the limit no preimage is found, and the position counts as outside. A polar angle that is not found is only a
   !> worse start.
   integer, parameter :: most_inverse_steps = 40
   !> Guard: the inversion ends without a preimage where the Jacobian over b_0^2 is below this: at a tip either map may
   !> fold next to the edge. The position then counts as outside, and rays to it start from the edge in its direction.
   real(dp), parameter :: least_inverse_jacobian = 1e-6_dp
   !> Number of points on the edge, enough to find the tip closest to a position: the highest harmonic of the edge has
   !> some 40 periods.
   integer, parameter :: distance_points = 128

contains

   !> Finds the preimage of a position under the map of the disc or, outside, under that of README.md (F48), by Newton's
   !> method, README.md (F19).
   !>
   !> The iteration starts from the preimage of another position if that is given and close. If not, it starts in the
   !> direction of the preimage of the edge's point that lies in the direction of z. There is one such point, because
   !> the shapes are star-shaped. Far outside it starts from z/b_0.
   pure subroutine find_preimage(map, z, v, found, near)
      type(shape_map), intent(in) :: map
      complex(dp), intent(in) :: z                !! position x + i y from the centre [s]
      complex(dp), intent(out) :: v               !! its preimage; |v| <= 1 inside the edge
      logical, intent(out) :: found               !! false if Newton's method fails, next to a sharp tip
      complex(dp), intent(in), optional :: near   !! preimage of another position; 0 for none

      !> If a step is shorter than this part of the longest one, the next step would be below rounding, as convergence
      !> is quadratic.
      real(dp), parameter :: small_step = 1e-8_dp
      !> Longest step, outside over |v|. A longer step could go across a fold of the map.
      real(dp), parameter :: longest_step = 0.2_dp
      complex(dp), dimension(1) :: conjugate_slope, slope
      !> From this distance on, over the sum of the map's coefficients, the map is nearly b_0 v.
      real(dp), parameter :: far = 1.5_dp
      complex(dp) :: at_v, edge, left, step
      real(dp) :: jacobian, least, size_of_step, square
      logical :: from_near
      integer :: i

      v = 0.0_dp
      found = z%re**2 + z%im**2 <= tiny(1.0_dp)
      if (found) return
      if (present(near)) v = near
      from_near = .true.
      least = least_inverse_jacobian*map%b(0)**2
      do i = 1, most_inverse_steps
         if (abs(v%re) + abs(v%im) <= 0.0_dp) then
            from_near = .false.
            v = z/map%b(0)
            if (abs(z) < far*sum(abs(map%b))) then
               call find_edge_in_direction(map, z, v, edge)
               v = v*(abs(z)/abs(edge))
            end if
         end if
         square = v%re**2 + v%im**2
         if (square > 1.0_dp) then
            call map%linearise_outside(v, at_v, slope(1), conjugate_slope(1))
         else
            at_v = map%position_of(v)
            call map%slopes(1, [v], slope, conjugate_slope)
         end if
         left = z - at_v
         jacobian = slope(1)%re**2 + slope(1)%im**2 - (conjugate_slope(1)%re**2 + conjugate_slope(1)%im**2)
         step = (conjg(slope(1))*left - conjugate_slope(1)*conjg(left))/max(jacobian, least)
         size_of_step = sqrt((step%re**2 + step%im**2)/max(square, 1.0_dp))/longest_step
         if (from_near .and. (jacobian < least .or. size_of_step > 1.0_dp)) then
            v = 0.0_dp
            cycle
         end if
         if (.not. jacobian > least) return
         found = size_of_step <= small_step
         v = v + step/max(size_of_step, 1.0_dp)
         if (found) return
      end do
   end subroutine find_preimage

   !> Finds the point of the edge that lies in the direction of z from the centre, by Newton's method for the angle of
   !> w. A step that would leave the sector between two axes of symmetry is replaced by bisection, as at sharp tips and
   !> on long flat sides.
   pure subroutine find_edge_in_direction(map, z, w, edge)
      type(shape_map), intent(in) :: map
      complex(dp), intent(in) :: z         !! a position x + i y, not the centre
      complex(dp), intent(out) :: w        !! preimage of the point, |w| = 1
      complex(dp), intent(out) :: edge     !! the point z(w) [s]

      !> An error of the polar angle that does not matter, as the point is a start only.
      real(dp), parameter :: angle_tolerance = 1e-10_dp
      real(dp) :: above, angle, below, direction, missing
      integer :: i

      direction = atan2(z%im, z%re)
      below = pi/map%fold*floor(direction*map%fold/pi)
      above = below + pi/map%fold
      angle = direction
      do i = 1, most_inverse_steps
         w = exp(cmplx(0.0_dp, angle, dp))
         edge = map%position_of(w)
         missing = direction - atan2(edge%im, edge%re)
         missing = missing - 2*pi*anint(missing/(2*pi))
         if (abs(missing) < angle_tolerance) exit
         if (missing > 0.0_dp) then
            below = angle
         else
            above = angle
         end if
         ! The step divides by the derivative of the polar angle, which is small at tips.
         angle = angle + missing/max(real(map%tangent(w)/edge, dp), tiny(1.0_dp))
         if (.not. (angle > below .and. angle < above)) angle = 0.5_dp*(below + above)
      end do
   end subroutine find_edge_in_direction

   !> Points of the edge, as `distance_from_edge` takes them.
   pure function edge_points(map) result(edge)
      type(shape_map), intent(in) :: map
      complex(dp) :: edge(distance_points)   !! points once around the edge [s]

      integer :: i

      edge = map%position_of([(exp(cmplx(0.0_dp, 2*pi*i/distance_points, dp)), i=1, distance_points)])
   end function edge_points

   !> The distance of a position from the edge, negative inside [s]. The search starts at the nearest of some points of
   !> the edge, and halves the step of the angle.
   pure real(dp) function distance_from_edge(map, points, z) result(distance)
      type(shape_map), intent(in) :: map
      complex(dp), intent(in) :: points(distance_points)   !! edge_points of the shape
      complex(dp), intent(in) :: z                         !! position x + i y from the centre [s]

      !> Number of halvings, which give the angle to 5e-11. Near its minimum the distance is quadratic in the angle, so
      !> that its error is rounding.
      integer, parameter :: distance_halvings = 30
      complex(dp) :: edge(-1:1), outwards
      real(dp) :: angle, step
      integer :: i, closest

      angle = 2*pi*minloc(abs(z - points), 1)/distance_points
      step = 2*pi/distance_points
      do i = 1, distance_halvings
         step = 0.5_dp*step
         edge = map%position_of(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
         closest = minloc(abs(z - edge), 1) - 2
         angle = angle + closest*step
      end do
      edge = map%position_of(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
      outwards = (0.0_dp, -1.0_dp)*(edge(1) - edge(-1))
      distance = sign(abs(z - edge(0)), real((z - edge(0))*conjg(outwards), dp))
   end function distance_from_edge

end module wavycon_shape_search
