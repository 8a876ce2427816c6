!> Where a place lies with respect to a mapped disc: its preimage, and its distance from the edge.
module wavycon_shape_search
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: distance_from_edge, edge_points, find_edge_in_direction, find_preimage

   !> Safety limit: most steps of either of Newton's iterations. Places for which the continued map has a preimage take
   !> fewer. At the limit no preimage is found, and the place counts as far or as outside; a polar angle that is not
   !> found is only a worse start.
   integer, parameter :: most_inverse_steps = 40
   !> Guard: Jacobian over b_0^2 below which the inversion ends without a preimage: at a tip either map folds next to
   !> the edge. The place then counts as outside, and rays to it start from the edge in its direction.
   real(dp), parameter :: least_inverse_jacobian = 1e-6_dp
   !> Enough to find the nearest of the tips: the highest harmonic of the edge has some 40 periods.
   integer, parameter :: distance_points = 128

contains

   !> The preimage of a place under the map of the disc and, outside, that of README.md (F48), which continues it.
   !>
   !> Newton's method, README.md (F19). Next to the centre or to the edge it starts from the point of the edge that is
   !> seen from the centre in the direction of z. The shapes in use are star-shaped: there is one such point. It starts
   !> from the preimage of another place if that is given and near.
   pure subroutine find_preimage(shape, z, v, found, near)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: z                !! [s]
      complex(dp), intent(out) :: v               !! |v| <= 1 inside
      logical, intent(out) :: found               !! false if Newton's method ends without it, next to a sharp tip
      complex(dp), intent(in), optional :: near   !! preimage of another place; 0 for none

      !> Step over the longest after which the next one would be below rounding, as convergence is quadratic.
      real(dp), parameter :: small_step = 1e-8_dp
      !> Longest steps, outside over |v|: longer ones go across the fold of a map.
      real(dp), parameter :: longest_step = 0.2_dp
      complex(dp), dimension(1) :: conjugate_slope, slope
      !> Distance over the sum of the map's coefficients from which the map is nearly b_0 v.
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
      least = least_inverse_jacobian*shape%b(0)**2
      do i = 1, most_inverse_steps
         if (abs(v%re) + abs(v%im) <= 0.0_dp) then
            from_near = .false.
            v = z/shape%b(0)
            if (abs(z) < far*sum(abs(shape%b))) then
               call find_edge_in_direction(shape, z, v, edge)
               v = v*(abs(z)/abs(edge))
            end if
         end if
         square = v%re**2 + v%im**2
         if (square > 1.0_dp) then
            call shape%linearise_outside(v, at_v, slope(1), conjugate_slope(1))
         else
            at_v = shape%place(v)
            call shape%slopes(1, [v], slope, conjugate_slope)
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

   !> The points of an edge from which its distance is found.
   pure function edge_points(shape) result(edge)
      type(shape_map), intent(in) :: shape
      complex(dp) :: edge(distance_points)   !! once around [s]

      integer :: i

      edge = shape%place([(exp(cmplx(0.0_dp, 2*pi*i/distance_points, dp)), i=1, distance_points)])
   end function edge_points

   !> Distance of a place from the edge, negative inside [s]: from the nearest of some points by halving their distance.
   pure real(dp) function distance_from_edge(shape, points, z) result(distance)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: points(distance_points)   !! edge_points of the shape
      complex(dp), intent(in) :: z                         !! [s]

      !> They bring the angle to 5e-11. At its least the distance varies as the square: it is exact to rounding.
      integer, parameter :: distance_halvings = 30
      complex(dp) :: edge(-1:1), outwards
      real(dp) :: angle, step
      integer :: i, nearest

      angle = 2*pi*minloc(abs(z - points), 1)/distance_points
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
