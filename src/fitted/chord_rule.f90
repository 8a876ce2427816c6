!> The integral of f/|z - z'| over a mapped disc, exact to rounding for a target z inside or outside, however
!> near its edge; and Hadamard's finite part of that of f/|z - z'|^3.
!>
!> For f = (1 - |w|^2)^power times a polynomial take the chords through the target w_t: with w = w_t + t e^(i
!> phi),
!>
!>     integral of f J/|z(w) - z(w_t)| over the disc = integral of f J/|Q| over all chords, dt dphi,
!>
!> where Q = (z(w) - z(w_t))/t is a polynomial that does not vanish, and 1 - |w|^2 the product of the
!> distances to the chord's ends. So a Gauss rule along the chord and, in phi, the midpoint rule over half a
!> turn (target inside) or Gauss's between the tangents (outside) are spectral.
!>
!> For 1/|z - z'|^3 it is the finite part of f J/(t^2 |Q|^3): the circle left out about the target is not one in
!> the disc, but what that adds is odd in t. With s along the chord from -1 to 1 and s_0 the target,
!>
!>     finite part of the integral of (1 - s^2)^(3/2) C_m(s)/(s - s_0)^2 ds = (pi/2)(m+1)(m+3) T_(m+2)(s_0),
!>
!> C_m Gegenbauer's polynomials of this weight, whose squares have the integrals (pi/8)(m+1)(m+3), and T_m
!> Chebyshev's.
module wavycon_chord_rule
   use wavycon_constants, only: pi
   use wavycon_disc_polynomials, only: disc_polynomials
   use wavycon_fitted_tuning, only: outside_chords, outside_half_points
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: chord_rule, start_chord_rule

   type :: chord_rule
      real(dp) :: power = 0.5_dp                          !! of the weight
      logical :: cubes = .false.                          !! whether the kernel is 1/|z - z'|^3
      real(dp), allocatable :: node(:), weight(:)         !! along a chord, between -1 and 1, shape (n)
      complex(dp), allocatable :: direction(:)            !! of the chords of a target inside, shape (m)
      real(dp), allocatable :: angle(:), angle_weight(:)  !! Gauss's rule for a target outside, shape (m)
      !> Weights of the coefficients of C_m, shape (n, 0:n-1).
      real(dp), allocatable, private :: gegenbauer(:, :)
      ! Room for the n m points of one target; of complex numbers the real parts, then the imaginary ones.
      complex(dp), allocatable, private :: w(:)
      real(dp), allocatable, private :: e2(:, :), own(:, :), q(:, :), slope(:, :), step(:, :)  !! shape (n m, 2)
      real(dp), allocatable, private :: last(:, :), parts(:, :)                                !! shape (n m, 2)
      real(dp), allocatable, private :: quotient(:, :, :), power_of_w(:, :, :)                 !! shape (n m, 2, K)
      real(dp), allocatable, private :: factor(:), density(:), f(:), f_slope(:), swelling(:)
      real(dp), allocatable, private :: values(:, :)                                           !! shape (n m, N)
   contains
      procedure :: rows
      procedure, nopass :: cube_integral
      procedure, private :: place_points
   end type chord_rule

contains

   !> Prepares for targets in the image of one basis and one number of shape terms.
   !>
   !> The weight decides on the kernel: (1 - |w|^2)^(1/2), a spot's pressure, has 1/|z - z'|, and the power 3/2,
   !> an island's gap, 1/|z - z'|^3.
   subroutine start_chord_rule(rule, basis, shape_terms, angles, points)
      type(chord_rule), intent(out) :: rule
      type(disc_polynomials), intent(in) :: basis
      integer, intent(in) :: shape_terms  !! K >= 1
      integer, intent(in) :: angles       !! m, number of chords, >= 1
      integer, intent(in) :: points       !! n, on a chord, >= 1

      integer :: m, n

      n = angles*points
      rule%power = basis%power
      rule%cubes = rule%power > 1.0_dp
      allocate (rule%node(points), rule%weight(points), rule%angle(angles), rule%angle_weight(angles))
      rule%direction = exp(cmplx(0.0_dp, pi*([(m, m=1, angles)] - 0.5_dp)/angles, dp))
      call gauss_jacobi(basis%power, basis%power, rule%node, rule%weight)
      call gauss_jacobi(0.0_dp, 0.0_dp, rule%angle, rule%angle_weight)
      if (rule%cubes) then
         allocate (rule%gegenbauer(points, 0:points - 1))
         associate (g => rule%gegenbauer, s => rule%node)
            g(:, 0) = rule%weight
            if (points > 1) g(:, 1) = 4*s*g(:, 0)
            do m = 2, points - 1
               g(:, m) = (2*(m + 1)*s*g(:, m - 1) - (m + 2)*g(:, m - 2))/m
            end do
         end associate
      end if
      allocate (rule%w(n), rule%e2(n, 2), rule%own(n, 2), rule%q(n, 2), rule%slope(n, 2), rule%step(n, 2))
      allocate (rule%last(n, 2), rule%parts(n, 2))
      allocate (rule%quotient(n, 2, shape_terms), rule%power_of_w(n, 2, shape_terms))
      allocate (rule%factor(n), rule%density(n), rule%f(n), rule%f_slope(n), rule%swelling(n))
      allocate (rule%values(n, basis%terms))
   end subroutine start_chord_rule

   !> The integral for one target, for each polynomial of the basis, and its derivative with the shape for a
   !> sum of them.
   !>
   !> N.B. The derivative is taken with the target's w_t kept, so that the target moves with the shape.
   subroutine rows(self, basis, shape, target, c, row, shape_row)
      class(chord_rule), intent(inout) :: self
      type(disc_polynomials), intent(in) :: basis      !! the one the rule was prepared for
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target                !! w_t; for cubes |w_t| <= 1
      real(dp), intent(in) :: c(:)                     !! coefficients of the sum, shape (N)
      real(dp), intent(out) :: row(:)                  !! integrals of the terms, shape (N)
      real(dp), intent(out) :: shape_row(0:)           !! d(integral of the sum)/d b_k, shape (0:K)

      complex(dp) :: target_power, target_step
      integer :: bends, i, j, k, m, n

      n = size(self%w)
      m = shape%fold
      bends = ubound(shape%b, 1)
      call self%place_points(target)
      call basis%evaluate(n, self%w, self%values)
      associate (w => self%parts, e2 => self%e2, q => self%q, slope => self%slope, step => self%step, &
                 own => self%own, last => self%last, quotient => self%quotient, power_of_w => self%power_of_w, &
                 f => self%f, f_slope => self%f_slope, density => self%density, swelling => self%swelling)
         ! With v = w_t: (w^(j+m) - v^(j+m)) = w^m (w^j - v^j) + v^j (w^m - v^m), all over t e^(i phi), j = m
         ! k - 1.
         target_step = target**m
         target_power = target**(m - 1)
         do i = 1, n
            w(i, 1) = self%w(i)%re
            w(i, 2) = self%w(i)%im
         end do
         call set(quotient(:, :, 1), (1.0_dp, 0.0_dp))
         call set(step, (1.0_dp, 0.0_dp))
         do j = 2, m - 1
            call multiply(n, quotient(:, :, 1), w)
            call add(quotient(:, :, 1), target**(j - 1))
            call multiply(n, step, w)
         end do
         power_of_w(:, :, 1) = (m - 1)*step
         call multiply(n, step, w)
         call multiply(n, step, w)
         last = quotient(:, :, 1)
         call multiply(n, last, w)
         call add(last, target_power)
         ! The analytic part's quotient over b_0 and its slope's square.
         call set(own, (1.0_dp, 0.0_dp))
         swelling = 1.0_dp
         if (shape%crowding > 0.0_dp) then
            call multiply(n, w, last)
            call add(w, target_step)
            own(:, 1) = 1.0_dp - shape%crowding*w(:, 1)
            own(:, 2) = shape%crowding*w(:, 2)
            swelling = (1.0_dp - (m + 1)*shape%crowding*step(:, 1))**2 + ((m + 1)*shape%crowding*step(:, 2))**2
         end if
         do k = 2, bends
            quotient(:, :, k) = quotient(:, :, k - 1)
            call multiply(n, quotient(:, :, k), step)
            quotient(:, 1, k) = quotient(:, 1, k) + (target_power%re*last(:, 1) - target_power%im*last(:, 2))
            quotient(:, 2, k) = quotient(:, 2, k) + (target_power%re*last(:, 2) + target_power%im*last(:, 1))
            target_power = target_power*target_step
            power_of_w(:, :, k) = power_of_w(:, :, k - 1)*((m*k - 1.0_dp)/(m*(k - 1) - 1.0_dp))
            call multiply(n, power_of_w(:, :, k), step)
         end do
         do k = 1, bends
            call multiply(n, quotient(:, :, k), e2)
         end do
         q = shape%b(0)*own
         call dgemv('N', 2*n, bends, 1.0_dp, quotient, 2*n, shape%b(1:), 1, 1.0_dp, q, 1)
         call dgemv('N', 2*n, bends, 1.0_dp, power_of_w, 2*n, shape%b(1:), 1, 0.0_dp, slope, 1)
         do i = 1, n
            f_slope(i) = 1.0_dp/(q(i, 1)**2 + q(i, 2)**2)
            density(i) = self%factor(i)*sqrt(f_slope(i))
            f(i) = shape%b(0)**2*swelling(i) - (slope(i, 1)**2 + slope(i, 2)**2)
         end do
         if (self%cubes) density = density*f_slope
         f_slope = merge(3, 1, self%cubes)*f*f_slope
         f = f*density
         call dgemv('T', n, basis%terms, 1.0_dp, self%values, n, f, 1, 0.0_dp, row, 1)
         call dgemv('N', n, basis%terms, 1.0_dp, self%values, n, c, 1, 0.0_dp, f, 1)
         density = density*f
         shape_row(0) = 2*shape%b(0)*dot_product(density, swelling)
         do j = 1, 2
            slope(:, j) = density*slope(:, j)
            q(:, j) = density*f_slope*q(:, j)
            shape_row(0) = shape_row(0) - dot_product(q(:, j), own(:, j))
         end do
         call dgemv('T', 2*n, bends, -2.0_dp, power_of_w, 2*n, slope, 1, 0.0_dp, shape_row(1:), 1)
         call dgemv('T', 2*n, bends, -1.0_dp, quotient, 2*n, q, 1, 1.0_dp, shape_row(1:), 1)
      end associate
   end subroutine rows

   !> Complex numbers, kept as real and imaginary parts, times others.
   pure subroutine multiply(n, a, b)
      integer, intent(in) :: n
      real(dp), intent(inout) :: a(n, 2)
      real(dp), intent(in) :: b(n, 2)

      real(dp) :: re
      integer :: i

      do i = 1, n
         re = a(i, 1)*b(i, 1) - a(i, 2)*b(i, 2)
         a(i, 2) = a(i, 1)*b(i, 2) + a(i, 2)*b(i, 1)
         a(i, 1) = re
      end do
   end subroutine multiply

   !> The same plus one number.
   pure subroutine add(a, number)
      real(dp), intent(inout) :: a(:, :)
      complex(dp), intent(in) :: number

      a(:, 1) = a(:, 1) + number%re
      a(:, 2) = a(:, 2) + number%im
   end subroutine add

   !> All the same number.
   pure subroutine set(a, number)
      real(dp), intent(out) :: a(:, :)
      complex(dp), intent(in) :: number

      a(:, 1) = number%re
      a(:, 2) = number%im
   end subroutine set

   !> Points on the chords, and their weights with the weight of f.
   subroutine place_points(self, target)
      class(chord_rule), intent(inout) :: self
      complex(dp), intent(in) :: target          !! w_t

      complex(dp) :: direction, e
      real(dp) :: distance, half, middle, opening, scale, t, weight(size(self%node))
      integer :: angles, i, j, k, of_half

      angles = size(self%angle)
      ! The powers of the weights in use are odd halves.
      of_half = nint(2*self%power)
      distance = abs(target)
      k = 0
      do i = 1, angles
         if (distance <= 1.0_dp) then
            e = self%direction(i)
            scale = pi/angles
         else
            opening = asin(1.0_dp/distance)
            direction = -target/distance
            e = direction*exp(cmplx(0.0_dp, opening*self%angle(i), dp))
            scale = opening*self%angle_weight(i)
         end if
         middle = -(target%re*e%re + target%im*e%im)
         half = sqrt(max(1.0_dp - (target%re*e%im - target%im*e%re)**2, 0.0_dp))
         if (self%cubes) then
            scale = scale*half**(of_half - 1)
            weight = finite_part_weights(self, -middle/half)
         else
            scale = scale*half**(of_half + 1)
            weight = self%weight
         end if
         do j = 1, size(self%node)
            k = k + 1
            t = middle + half*self%node(j)
            self%w(k) = target + t*e
            self%e2(k, 1) = e%re**2 - e%im**2
            self%e2(k, 2) = 2*e%re*e%im
            self%factor(k) = scale*weight(j)
         end do
      end do
   end subroutine place_points

   !> Weights along a chord for the finite part with 1/(s - s_0)^2.
   pure function finite_part_weights(self, s_0) result(weight)
      class(chord_rule), intent(in) :: self
      real(dp), intent(in) :: s_0               !! the target's place on the chord, between -1 and 1
      real(dp) :: weight(size(self%node))

      real(dp) :: last, next, now
      integer :: m

      weight = 0.0_dp
      last = s_0
      now = 2*s_0**2 - 1.0_dp
      do m = 0, size(self%node) - 1
         weight = weight + 4*now*self%gegenbauer(:, m)
         next = 2*s_0*now - last
         last = now
         now = next
      end do
   end function finite_part_weights

   !> The integral of f/|z - z'|^3 for a target outside.
   !>
   !> On a chord this has a pole beyond the nearer end, s = -1, of -1 <= s <= 1, as close as the target is to
   !> the edge. With 1 + s = x^2, x = root sinh(y), root^2 the distance of the pole, the nearer half is smooth
   !> in y; the farther one is smooth in s.
   real(dp) function cube_integral(basis, shape, target, c) result(integral)
      type(disc_polynomials), intent(in) :: basis
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target      !! w_t, |w_t| > 1
      real(dp), intent(in) :: c(:)           !! coefficients of f, shape (N)

      integer, parameter :: chords = outside_chords, half_points = outside_half_points, points = 2*half_points
      real(dp) :: angle(chords), angle_weight(chords), values(points, basis%terms)
      real(dp), dimension(half_points) :: far_node, far_weight, node, node_weight, x, y
      real(dp), dimension(points) :: t, weight
      complex(dp) :: direction, e, w(points), z_target
      real(dp) :: distance, half, middle, nearer_end, opening, root, sum_of_chord, top
      integer :: i, j

      distance = abs(target)
      call gauss_jacobi(0.0_dp, 0.0_dp, angle, angle_weight)
      call gauss_jacobi(0.0_dp, 0.0_dp, node, node_weight)
      call gauss_jacobi(basis%power, 0.0_dp, far_node, far_weight)
      opening = asin(1.0_dp/distance)
      direction = -target/distance
      z_target = shape%place(target)
      integral = 0.0_dp
      do i = 1, chords
         e = direction*exp(cmplx(0.0_dp, opening*angle(i), dp))
         middle = -(target%re*e%re + target%im*e%im)
         half = sqrt(max(1.0_dp - (target%re*e%im - target%im*e%re)**2, tiny(1.0_dp)))
         nearer_end = (distance - 1.0_dp)*(distance + 1.0_dp)/(middle + half)
         root = sqrt(nearer_end/half)
         top = asinh(1.0_dp/root)
         y = 0.5_dp*top*(1.0_dp + node)
         x = root*sinh(y)
         t(:half_points) = nearer_end + half*x**2
         weight(:half_points) = top*node_weight*root*cosh(y)*x**(2*basis%power + 1) &
            *(2.0_dp - x**2)**basis%power
         ! From s = 0 to 1.
         t(half_points + 1:) = nearer_end + half*(1.5_dp + 0.5_dp*far_node)
         weight(half_points + 1:) = far_weight*0.5_dp**(basis%power + 1) &
            *(1.5_dp + 0.5_dp*far_node)**basis%power
         w = target + t*e
         call basis%evaluate(points, w, values)
         sum_of_chord = 0.0_dp
         do j = 1, points
            sum_of_chord = sum_of_chord + weight(j)*dot_product(values(j, :), c)*shape%jacobian(w(j)) &
               *t(j)/abs(shape%place(w(j)) - z_target)**3
         end do
         integral = integral + opening*angle_weight(i)*half**(2*basis%power + 1)*sum_of_chord
      end do
   end function cube_integral

end module wavycon_chord_rule
