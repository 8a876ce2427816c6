!> The map of the unit disc to a contact spot or an open island: z = b_0 (w - tau w^(fold+1)) + sum over k of
!> b_k conj(w)^(fold k - 1).
!>
!> With tau = 0 and one term the edge is a hypotrochoid, with b_1 = b_0/(fold - 1) an astroid and its kin:
!> spots and islands are very nearly such curves up to the load at which they merge. A small tau, with b_1
!> larger by tau b_0, leaves the edge much as it is and crowds its points towards the tips, where shapes
!> become sharp.
module wavycon_shape_map
   use wavycon_constants, only: pi
   use wavycon_fitted_tuning, only: distance_halvings, distance_points, farthest_inverse, farthest_inverse_start, &
      least_edge_points, least_inverse_jacobian, least_turning, longest_inverse_step, most_edge_points, &
      most_inverse_steps, radius_points
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: shape_map

   type :: shape_map
      integer :: fold = 4               !! of the symmetry, >= 2
      real(dp) :: crowding = 0.0_dp     !! tau, 0 <= tau < 1/(fold+1)
      real(dp), allocatable :: b(:)     !! coefficients [s], shape (0:K)
   contains
      procedure :: place
      procedure :: linearise_place
      procedure :: crowded
      procedure :: crowded_slope
      procedure :: jacobian
      procedure :: linearise_jacobian
      procedure :: area
      procedure :: radius
      procedure :: perimeter
      procedure :: distance
      procedure :: find
   end type shape_map

contains

   !> z(w) [s].
   elemental complex(dp) function place(self, w) result(z)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: power, step
      integer :: k

      z = self%b(0)*self%crowded(w)
      step = conjg(w)**self%fold
      power = conjg(w)**(self%fold - 1)
      do k = 1, ubound(self%b, 1)
         z = z + self%b(k)*power
         power = power*step
      end do
   end function place

   !> Derivatives of z(w) with the coefficients.
   pure subroutine linearise_place(self, w, derivative)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w
      complex(dp), intent(out) :: derivative(0:)   !! dz/d b_k, shape (0:K)

      complex(dp) :: power, step
      integer :: k

      derivative(0) = self%crowded(w)
      power = conjg(w)**(self%fold - 1)
      step = power*conjg(w)
      do k = 1, ubound(derivative, 1)
         derivative(k) = power
         power = power*step
      end do
   end subroutine linearise_place

   !> w - tau w^(fold+1), whose multiple by b_0 is the analytic part of the map.
   elemental complex(dp) function crowded(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      crowded = w
      if (self%crowding > 0.0_dp) crowded = w*(1.0_dp - self%crowding*w**self%fold)
   end function crowded

   !> Its derivative.
   elemental complex(dp) function crowded_slope(self, w) result(slope)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      slope = 1.0_dp
      if (self%crowding > 0.0_dp) slope = slope - (self%fold + 1)*self%crowding*w**self%fold
   end function crowded_slope

   !> Area of the image over that of the disc, |dz/dw|^2 - |dz/d conj(w)|^2 [s^2].
   elemental real(dp) function jacobian(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: own, slope

      own = self%b(0)*self%crowded_slope(w)
      slope = conjugate_slope(self, w)
      jacobian = own%re**2 + own%im**2 - (slope%re**2 + slope%im**2)
   end function jacobian

   !> dz/d conj(w) [s].
   elemental complex(dp) function conjugate_slope(self, w) result(slope)
      type(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: power, step
      integer :: k

      slope = 0.0_dp
      step = conjg(w)**self%fold
      power = conjg(w)**(self%fold - 2)
      do k = 1, ubound(self%b, 1)
         slope = slope + (self%fold*k - 1)*self%b(k)*power
         power = power*step
      end do
   end function conjugate_slope

   !> The same with its derivatives with the coefficients.
   pure subroutine linearise_jacobian(self, w, jacobian, derivative)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w
      real(dp), intent(out) :: jacobian         !! [s^2]
      real(dp), intent(out) :: derivative(0:)   !! d jacobian/d b_k [s], shape (0:K)

      complex(dp) :: own, own_power, power(ubound(self%b, 1)), slope, step
      real(dp) :: own_square
      integer :: k

      own = self%crowded_slope(w)
      own_square = own%re**2 + own%im**2
      slope = 0.0_dp
      own_power = conjg(w)**(self%fold - 2)
      step = own_power*conjg(w)**2
      do k = 1, ubound(self%b, 1)
         power(k) = (self%fold*k - 1)*own_power
         slope = slope + self%b(k)*power(k)
         own_power = own_power*step
      end do
      jacobian = self%b(0)**2*own_square - (slope%re**2 + slope%im**2)
      derivative(0) = 2*self%b(0)*own_square
      derivative(1:) = -2*(slope%re*power%re + slope%im*power%im)
   end subroutine linearise_jacobian

   !> Area enclosed [s^2].
   pure real(dp) function area(self)
      class(shape_map), intent(in) :: self

      integer :: k

      area = pi*(self%b(0)**2*(1.0_dp + (self%fold + 1)*self%crowding**2) &
                 - sum([((self%fold*k - 1)*self%b(k)**2, k=1, ubound(self%b, 1))]))
   end function area

   !> Largest distance of the edge from the centre [s], nearly.
   pure real(dp) function radius(self)
      class(shape_map), intent(in) :: self

      integer, parameter :: steps = radius_points
      integer :: i

      radius = maxval(abs(self%place([(exp(cmplx(0.0_dp, pi*i/(self%fold*steps), dp)), i=0, steps)])))
   end function radius

   !> Length of the edge [s].
   pure real(dp) function perimeter(self)
      class(shape_map), intent(in) :: self

      complex(dp) :: power, step, tangent, w
      real(dp) :: ratio
      integer :: i, k, points

      ! The tangent is that of a circle and, less than it by this ratio, what turns against it. Its length has
      ! coefficients that fall as powers of the ratio, if most of that turns once between two tips; half as fast
      ! as that is on the safe side.
      ratio = sum([((self%fold*k - 1)*abs(self%b(k)), k=1, ubound(self%b, 1))]) &
         /(self%b(0)*(1.0_dp - (self%fold + 1)*self%crowding))
      points = most_edge_points
      if (ratio < 1.0_dp) points = min(ceiling(log(epsilon(ratio))/log(max(ratio, tiny(ratio)))), most_edge_points)
      points = max(points, least_edge_points)
      perimeter = 0.0_dp
      do i = 1, points
         w = exp(cmplx(0.0_dp, pi*(i - 0.5_dp)/(self%fold*points), dp))
         tangent = self%b(0)*w*self%crowded_slope(w)
         step = conjg(w)**self%fold
         power = conjg(w)**(self%fold - 1)
         do k = 1, ubound(self%b, 1)
            tangent = tangent - (self%fold*k - 1)*self%b(k)*power
            power = power*step
         end do
         perimeter = perimeter + abs(tangent)
      end do
      perimeter = perimeter*2*pi/points
   end function perimeter

   !> Distance of a place from the edge, below zero inside [s].
   pure real(dp) function distance(self, z)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: z       !! [s]

      integer, parameter :: points = distance_points
      complex(dp) :: edge(-1:1), outwards
      real(dp) :: angle, length(points), step
      integer :: i, nearest

      length = abs(z - self%place([(exp(cmplx(0.0_dp, 2*pi*i/points, dp)), i=1, points)]))
      angle = 2*pi*minloc(length, 1)/points
      step = 2*pi/points
      do i = 1, distance_halvings
         step = 0.5_dp*step
         edge = self%place(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
         nearest = minloc(abs(z - edge), 1) - 2
         angle = angle + nearest*step
      end do
      edge = self%place(exp(cmplx(0.0_dp, angle + [-step, 0.0_dp, step], dp)))
      outwards = (0.0_dp, -1.0_dp)*(edge(1) - edge(-1))
      distance = sign(abs(z - edge(0)), real((z - edge(0))*conjg(outwards), dp))
   end function distance

   !> Where the map, or its continuation, has a place: z(w) = z.
   !>
   !> Newton's method from the edge in the direction of z, which the shapes in use, being star-shaped, have
   !> once.
   pure subroutine find(self, z, w, found)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: z       !! [s]
      complex(dp), intent(out) :: w
      logical, intent(out) :: found      !! not where the continued map folds before it gets to z

      !> Of b_0: what rounding leaves.
      real(dp), parameter :: tolerance = 64*epsilon(1.0_dp)
      complex(dp) :: edge, left, own, slope, step
      real(dp) :: angle, bend, direction, turn
      integer :: i, k

      w = 0.0_dp
      found = abs(z) <= tiny(1.0_dp)
      if (found) return
      direction = atan2(z%im, z%re)
      angle = direction
      do i = 1, most_inverse_steps
         w = exp(cmplx(0.0_dp, angle, dp))
         edge = self%place(w)
         turn = direction - atan2(edge%im, edge%re)
         turn = turn - 2*pi*anint(turn/(2*pi))
         ! How fast the direction turns with the angle, at least a little: tips are sharp.
         slope = self%b(0)*w*self%crowded_slope(w)
         do k = 1, ubound(self%b, 1)
            slope = slope - (self%fold*k - 1)*self%b(k)*conjg(w)**(self%fold*k - 1)
         end do
         bend = real(slope/edge, dp)
         angle = angle + turn/max(bend, least_turning)
         if (abs(turn) < 1e-10_dp) exit
      end do
      w = w*min(abs(z)/abs(edge), farthest_inverse_start)
      do i = 1, most_inverse_steps
         left = z - self%place(w)
         slope = conjugate_slope(self, w)
         own = self%b(0)*self%crowded_slope(w)
         bend = own%re**2 + own%im**2 - (slope%re**2 + slope%im**2)
         if (.not. bend > least_inverse_jacobian*self%b(0)**2 .or. .not. abs(w) < farthest_inverse) return
         step = (conjg(own)*left - slope*conjg(left))/bend
         w = w + step*min(1.0_dp, longest_inverse_step/max(abs(step), tiny(1.0_dp)))
         found = abs(step) <= tolerance .or. abs(left) <= tolerance*self%b(0)
         if (found) return
      end do
   end subroutine find

end module wavycon_shape_map
