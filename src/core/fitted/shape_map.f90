!> The map of the unit disc to a contact spot or an open pool,
!>
!>     z(w) = b_0 (w - tau w^(fold+1)) + sum over k = 1..K of b_k conj(w)^(fold k - 1),   README.md (F15).
!>
!> With tau = 0 and K = 1 the edge is a hypotrochoid; with b_1 = b_0/(fold - 1) it has cusps, as the astroid has. Spots
!> and pools are very nearly such curves up to the load at which they merge, so that a few terms are enough. A small
!> tau, together with b_1 larger by tau b_0, hardly changes the edge, but moves the images of the disc's points towards
!> the tips (clustering), which become sharp near merging.
!>
!> Outside of the disc another map, README.md (F48), which equals z(w) on the circle, is used. With tau = 0 it is
!> conformal, so it does not fold where (F15) would.
module wavycon_shape_map
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: shape_map

   !> Number of intervals on the edge in a half sector for the radius of a shape.
   integer, parameter :: radius_points = 8
   !> Bounds of the ratio that decides on the number of points for the perimeter, which is 16 to 512. Only an edge
   !> within about 7 % of having cusps has a larger ratio; its perimeter is less accurate.
   real(dp), parameter :: least_ratio = 0.1_dp, largest_ratio = 0.932_dp

   type :: shape_map
      integer :: fold = 4               !! order of the rotational symmetry, >= 2
      real(dp) :: clustering = 0.0_dp   !! tau, 0 <= tau < 1/(fold+1)
      real(dp), allocatable :: b(:)     !! coefficients b_k [s], shape (0:K)
   contains
      procedure :: position_of, linearise_position, find_differences, linearise_slopes, analytic_part, slopes, jacobian
      procedure :: tangent, linearise_edge, area, linearise_area, radius, position_outside, linearise_outside, perimeter
   end type shape_map

contains

   !> The image z(w) of a point of the disc [s], README.md (F15).
   elemental complex(dp) function position_of(self, w) result(z)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: power, step
      integer :: k

      z = self%b(0)*self%analytic_part(w)
      step = conjg(w)**self%fold
      power = conjg(w)**(self%fold - 1)
      do k = 1, ubound(self%b, 1)
         z = z + self%b(k)*power
         power = power*step
      end do
   end function position_of

   !> The derivatives of z(w) by the coefficients.
   pure subroutine linearise_position(self, w, derivative)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w
      complex(dp), intent(out) :: derivative(0:)   !! dz/d b_k, shape (0:K)

      complex(dp) :: power, step
      integer :: k

      derivative(0) = self%analytic_part(w)
      power = conjg(w)**(self%fold - 1)
      step = power*conjg(w)
      do k = 1, ubound(derivative, 1)
         derivative(k) = power
         power = power*step
      end do
   end subroutine linearise_position

   !> The divided differences of the map between a point v and n points w, without cancellation where w is close to v:
   !>
   !>     z(w) - z(v) = b_0 (w - v) A + conj( (w - v) sum over k of b_k q_j ),   README.md (F26),
   !>
   !> A = 1 - tau (w^(m+1) - v^(m+1))/(w - v) and q_j = (w^j - v^j)/(w - v), j = m k - 1, m the fold. They follow from
   !> w^(j+m) - v^(j+m) = w^m (w^j - v^j) + v^j (w^m - v^m).
   pure subroutine find_differences(self, n, v, w, analytic, terms)
      class(shape_map), intent(in) :: self
      integer, intent(in) :: n
      complex(dp), intent(in) :: v, w(n)
      real(dp), intent(out) :: analytic(n, 2)     !! A, real and imaginary part apart, so that loops vectorise
      real(dp), intent(out) :: terms(n, 2, ubound(self%b, 1))    !! q_j for each k, in the same form

      complex(dp) :: power
      real(dp), dimension(n, 2) :: of_fold, point, step
      integer :: i, k

      point = reshape([w%re, w%im], [n, 2])
      step = point
      terms(:, 1, 1) = 1.0_dp
      terms(:, 2, 1) = 0.0_dp
      do k = 1, self%fold - 2
         call multiply_add(n, terms(:, :, 1), point, v**k)
         call multiply_add(n, step, point, (0.0_dp, 0.0_dp))
      end do
      call multiply_add(n, step, point, (0.0_dp, 0.0_dp))
      of_fold = terms(:, :, 1)
      call multiply_add(n, of_fold, point, v**(self%fold - 1))
      do k = 2, ubound(self%b, 1)
         power = v**(self%fold*(k - 1) - 1)
         do i = 1, n
            terms(i, 1, k) = terms(i, 1, k - 1)*step(i, 1) - terms(i, 2, k - 1)*step(i, 2) &
               + (power%re*of_fold(i, 1) - power%im*of_fold(i, 2))
            terms(i, 2, k) = terms(i, 1, k - 1)*step(i, 2) + terms(i, 2, k - 1)*step(i, 1) &
               + (power%re*of_fold(i, 2) + power%im*of_fold(i, 1))
         end do
      end do
      analytic(:, 1) = 1.0_dp
      analytic(:, 2) = 0.0_dp
      if (self%clustering > 0.0_dp) then
         call multiply_add(n, of_fold, point, v**self%fold)
         analytic = analytic - self%clustering*of_fold
      end if
   end subroutine find_differences

   !> The derivatives by b_k of the conjugate of dz/d conj(w), which are (m k - 1) w^(m k - 2), and the power w^m; m is
   !> the fold.
   pure subroutine linearise_slopes(self, n, w, terms, step)
      class(shape_map), intent(in) :: self
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)
      real(dp), intent(out) :: terms(n, 2, ubound(self%b, 1))   !! the derivatives, real and imaginary part, for each k
      real(dp), intent(out) :: step(n, 2)                       !! w^m, real and imaginary part

      real(dp) :: factor, point(n, 2)
      integer :: i, k

      point = reshape([w%re, w%im], [n, 2])
      step(:, 1) = 1.0_dp
      step(:, 2) = 0.0_dp
      do k = 1, self%fold
         if (k == self%fold - 1) terms(:, :, 1) = (self%fold - 1)*step
         call multiply_add(n, step, point, (0.0_dp, 0.0_dp))
      end do
      do k = 2, ubound(self%b, 1)
         factor = (self%fold*k - 1.0_dp)/(self%fold*(k - 1) - 1.0_dp)
         do i = 1, n
            terms(i, 1, k) = factor*(terms(i, 1, k - 1)*step(i, 1) - terms(i, 2, k - 1)*step(i, 2))
            terms(i, 2, k) = factor*(terms(i, 1, k - 1)*step(i, 2) + terms(i, 2, k - 1)*step(i, 1))
         end do
      end do
   end subroutine linearise_slopes

   !> Replaces complex numbers a by a b + c. Real and imaginary parts are apart.
   pure subroutine multiply_add(n, a, b, c)
      integer, intent(in) :: n
      real(dp), intent(inout) :: a(n, 2)
      real(dp), intent(in) :: b(n, 2)
      complex(dp), intent(in) :: c

      real(dp) :: re
      integer :: i

      do i = 1, n
         re = a(i, 1)*b(i, 1) - a(i, 2)*b(i, 2) + c%re
         a(i, 2) = a(i, 1)*b(i, 2) + a(i, 2)*b(i, 1) + c%im
         a(i, 1) = re
      end do
   end subroutine multiply_add

   !> The analytic part of the map over b_0: w - tau w^(fold+1).
   elemental complex(dp) function analytic_part(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      analytic_part = w
      if (self%clustering > 0.0_dp) analytic_part = w*(1.0_dp - self%clustering*w**self%fold)
   end function analytic_part

   !> The derivatives dz/dw and dz/d conj(w) at n points [s].
   pure subroutine slopes(self, n, w, slope, conjugate_slope)
      class(shape_map), intent(in) :: self
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)
      complex(dp), intent(out) :: slope(n), conjugate_slope(n)

      complex(dp), dimension(n) :: lower, step
      integer :: k

      lower = 1.0_dp
      do k = 1, self%fold - 2
         lower = lower*conjg(w)
      end do
      ! Horner's scheme in conj(w)^fold.
      step = lower*conjg(w)**2
      conjugate_slope = 0.0_dp
      do k = ubound(self%b, 1), 1, -1
         conjugate_slope = conjugate_slope*step + (self%fold*k - 1)*self%b(k)
      end do
      conjugate_slope = conjugate_slope*lower
      slope = self%b(0)
      if (self%clustering > 0.0_dp) slope = self%b(0)*(1.0_dp - (self%fold + 1)*self%clustering*conjg(step))
   end subroutine slopes

   !> The Jacobian |dz/dw|^2 - |dz/d conj(w)|^2, README.md (F16): the area of the image over that of the disc [s^2].
   elemental real(dp) function jacobian(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: slope(1), conjugate_slope(1)

      call self%slopes(1, [w], slope, conjugate_slope)
      jacobian = slope(1)%re**2 + slope(1)%im**2 - (conjugate_slope(1)%re**2 + conjugate_slope(1)%im**2)
   end function jacobian

   !> -i dz/dphi at w = e^(i phi): the tangent of the edge, rotated to the outward normal [s].
   elemental complex(dp) function tangent(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w         !! |w| = 1

      complex(dp) :: slope(1), conjugate_slope(1)

      call self%slopes(1, [w], slope, conjugate_slope)
      tangent = w*slope(1) - conjg(w)*conjugate_slope(1)
   end function tangent

   !> The ratio of 1 - |w|^2 to the distance from the edge, in the limit at the edge, which is 2 |dz/dphi|/J, and the
   !> derivatives of its logarithm by the coefficients: README.md (F66).
   pure subroutine linearise_edge(self, w, ratio, log_slope)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w                   !! |w| = 1
      real(dp), intent(out) :: ratio                 !! [1/s]
      real(dp), intent(out) :: log_slope(0:)         !! d(ln ratio)/d b_k, shape (0:K) [1/s]

      complex(dp) :: conjugate_slope(1), normal, of_normal(0:ubound(log_slope, 1)), slope(1)
      integer :: k
      real(dp) :: jacobian

      call self%slopes(1, [w], slope, conjugate_slope)
      normal = w*slope(1) - conjg(w)*conjugate_slope(1)
      jacobian = abs(slope(1))**2 - abs(conjugate_slope(1))**2
      ratio = 2*abs(normal)/jacobian
      ! Derivatives of the normal by b_k. Those of conj(w) dz/d conj(w) by b_k, k > 0, are their negatives.
      of_normal(0) = w*slope(1)/self%b(0)
      do k = 1, ubound(log_slope, 1)
         of_normal(k) = -(self%fold*k - 1)*conjg(w)**(self%fold*k - 1)
      end do
      log_slope = real(conjg(normal)*of_normal, dp)/abs(normal)**2
      log_slope(0) = log_slope(0) - 2*abs(slope(1))**2/(self%b(0)*jacobian)
      log_slope(1:) = log_slope(1:) - 2*real(conjg(conjg(w)*conjugate_slope(1))*of_normal(1:), dp)/jacobian
   end subroutine linearise_edge

   !> The map z(v) outside of the disc [s], README.md (F48):
   !>
   !>     z(v) = b_0 v (1 - tau/conj(v)^fold) + sum over k = 1..K of b_k v^(1 - fold k),   |v| >= 1.
   pure complex(dp) function position_outside(self, v) result(z)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: v         !! |v| >= 1

      complex(dp) :: slope, conjugate_slope

      call self%linearise_outside(v, z, slope, conjugate_slope)
   end function position_outside

   !> The map z(v) outside of the disc and its derivatives dz/dv and dz/d conj(v) [s].
   pure subroutine linearise_outside(self, v, z, slope, conjugate_slope)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: v         !! |v| >= 1
      complex(dp), intent(out) :: z, slope, conjugate_slope

      complex(dp) :: power
      integer :: k

      power = (conjg(v)/(v%re**2 + v%im**2))**self%fold
      ! By Horner's scheme: b_0 + b_1 v^-fold + ..., and the same with the factors 1 - fold k.
      z = 0.0_dp
      slope = 0.0_dp
      do k = ubound(self%b, 1), 0, -1
         z = z*power + self%b(k)
         slope = slope*power + (1 - self%fold*k)*self%b(k)
      end do
      z = v*z
      conjugate_slope = 0.0_dp
      if (self%clustering > 0.0_dp) then
         power = self%clustering*self%b(0)*conjg(power)
         z = z - v*power
         slope = slope - power
         conjugate_slope = self%fold*v*power/conjg(v)
      end if
   end subroutine linearise_outside

   !> The area within the edge [s^2], README.md (F17).
   pure real(dp) function area(self)
      class(shape_map), intent(in) :: self

      integer :: k

      area = pi*(self%b(0)**2*(1.0_dp + (self%fold + 1)*self%clustering**2) &
                 - sum([((self%fold*k - 1)*self%b(k)**2, k=1, ubound(self%b, 1))]))
   end function area

   !> The derivatives of the area by the coefficients.
   pure subroutine linearise_area(self, derivative)
      class(shape_map), intent(in) :: self
      real(dp), intent(out) :: derivative(0:)   !! d(area)/d b_k, shape (0:K) [s]

      integer :: k

      derivative = 2*pi*[self%b(0)*(1.0_dp + (self%fold + 1)*self%clustering**2), &
                         [(-(self%fold*k - 1)*self%b(k), k=1, ubound(self%b, 1))]]
   end subroutine linearise_area

   !> The largest distance of some points of the edge from the centre [s]. The points lie between two neighbouring axes
   !> of symmetry. The farthest point of an edge is on an axis or on a broad tip, so that the result is only slightly
   !> too small.
   pure real(dp) function radius(self)
      class(shape_map), intent(in) :: self

      integer :: i

      radius = maxval(abs(self%position_of([(exp(cmplx(0.0_dp, pi*i/(self%fold*radius_points), dp)), &
                                              i=0, radius_points)])))
   end function radius

   !> The length of the edge [s], by the midpoint rule in the angle, which converges exponentially: README.md, section
   !> 11.
   pure real(dp) function perimeter(self)
      class(shape_map), intent(in) :: self

      real(dp) :: ratio
      integer :: i, k, points

      ! The tangent is that of a circle plus terms that rotate in the other direction. Their sum over the circle's
      ! tangent is at most `ratio`. The Fourier coefficients of the tangent's length fall about as the powers of this
      ! ratio if most of the terms make one turn between two tips. Twice as many points as needed are taken: so many
      ! that the power is rounding.
      ratio = sum([((self%fold*k - 1)*abs(self%b(k)), k=1, ubound(self%b, 1))]) &
         /(self%b(0)*(1.0_dp - (self%fold + 1)*self%clustering))
      points = ceiling(log(epsilon(ratio))/log(min(max(ratio, least_ratio), largest_ratio)))
      perimeter = sum([(abs(self%tangent(exp(cmplx(0.0_dp, pi*(i - 0.5_dp)/(self%fold*points), dp)))), i=1, points)]) &
         *2*pi/points
   end function perimeter

end module wavycon_shape_map
