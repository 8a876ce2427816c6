!> Quadrature of singular integrals over a mapped disc, for a target z = z(w_t) inside the disc, at any distance from
!> the edge: the integral of f/|z - z'|, and Hadamard's finite part of the integral of f/|z - z'|^3.
!>
!> The points lie on chords w = w_t + t e^(i phi) of the disc through the target. The area element is |t| dt dphi. On a
!> chord 1 - |w|^2 is the product of the distances to the chord's ends. So for the weight (1 - |w|^2)^power a
!> Gauss-Gegenbauer rule along the chord is exact for polynomials. In phi the midpoint rule over half a turn converges
!> exponentially. Let J be the map's Jacobian and Q = (z(w) - z(w_t))/(t e^(i phi)) its divided difference, which does
!> not vanish. Then the integrand over all chords, dt dphi, is
!>
!>     f J/|Q|   for f/|z - z'|, power 1/2: the area element cancels the singularity, README.md (F28), (F30);
!>     f J/(t^2 |Q|^3)   for f/|z - z'|^3, power 3/2, as Hadamard's finite part, README.md (F29), (F31).
!>
!> For the finite part let xi be the coordinate along a chord, from -1 to 1, and xi_0 that of the target. Then, by
!> (F33),
!>
!>     finite part of the integral of (1 - xi^2)^(3/2) C_m(xi)/(xi - xi_0)^2 dxi = (pi/2)(m+1)(m+3) T_(m+2)(xi_0),
!>
!> with Chebyshev's polynomials T_m and the Gegenbauer polynomials C_m of this weight, whose squares have the integrals
!> (pi/8)(m+1)(m+3) (F34). The neighbourhood of the target that the finite part leaves out is a circle in the image, not
!> in the disc. The difference is odd in t and cancels.
module wavycon_chord_rule
   use wavycon_disc_polynomials, only: disc_polynomials
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp, pi
   use wavycon_lapack, only: dgemv
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: chord_rule, start_chord_rule

   type :: chord_rule
      private
      integer :: kernel_power = 1                         !! power of 1/|z - z'|: 1 or 3
      real(dp) :: edge_power = 0.5_dp                     !! power of 1 - |w|^2 in the weight
      real(dp), allocatable :: node(:), node_weight(:)    !! Gauss's rule along a chord, -1 to 1, shape (n)
      !> For the kernel power 3 only. The weights of the nodes are the sum over m of gegenbauer(:, m) T_(m+2)(xi_0),
      !> (F32), or with adhesion of gegenbauer(:, m) U_m(xi_0), (F68). Shape (n, 0:n-1).
      real(dp), allocatable :: gegenbauer(:, :)
      complex(dp), allocatable :: direction(:)            !! e^(i phi) of each chord, shape (m)
      real(dp), allocatable :: turn(:, :)                 !! e^(2 i phi), real and imaginary part, shape (n m, 2)
      ! Work space for the n m points of a target, which is kept from target to target. Real and imaginary parts are
      ! apart, so that loops vectorise and BLAS sums the terms.
      real(dp), allocatable :: values(:, :)               !! values of the basis, shape (n m, N)
      real(dp), allocatable :: difference(:, :, :)        !! q_(fold k - 1) of README.md (F27), shape (n m, 2, K)
      real(dp), allocatable :: power(:, :, :)             !! `terms` of linearise_slopes, shape (n m, 2, K)
   contains
      procedure :: rows
   end type chord_rule

contains

   !> Prepares a rule for a basis, a number of shape terms, a number of chords, and a number of points on each chord.
   !> The kernel is 1/|z - z'| for a spot's pressure and 1/|z - z'|^3 for a pool's gap.
   subroutine start_chord_rule(rule, pool, basis, shape_terms, angles, points)
      type(chord_rule), intent(out) :: rule
      logical, intent(in) :: pool                      !! true: a pool's gap; false: a spot's pressure
      type(disc_polynomials), intent(in) :: basis      !! that of the fitted function
      integer, intent(in) :: shape_terms               !! K >= 1
      integer, intent(in) :: angles                    !! number m of chords, >= 1
      integer, intent(in) :: points                    !! number n of points on a chord, >= 2

      integer :: m

      rule%kernel_power = merge(3, 1, pool)
      rule%edge_power = basis%power
      rule%direction = [(exp(cmplx(0.0_dp, pi*(m - 0.5_dp)/angles, dp)), m=1, angles)]
      associate (n => points*angles)
         allocate (rule%node(points), rule%node_weight(points), rule%turn(n, 2), rule%values(n, basis%terms), &
                   rule%difference(n, 2, shape_terms), rule%power(n, 2, shape_terms))
      end associate
      rule%turn(:, 1) = reshape(spread(real(rule%direction**2, dp), 1, points), [points*angles])
      rule%turn(:, 2) = reshape(spread(aimag(rule%direction**2), 1, points), [points*angles])
      call gauss_jacobi(basis%power, basis%power, rule%node, rule%node_weight)
      if (rule%kernel_power == 1) return
      allocate (rule%gegenbauer(points, 0:points - 1))
      associate (g => rule%gegenbauer, s => rule%node, lambda => nint(rule%edge_power + 0.5_dp))
         ! Gegenbauer's polynomials C^(lambda), times the nodes' weights.
         g(:, 0) = rule%node_weight
         g(:, 1) = 2*lambda*s*g(:, 0)
         do m = 2, points - 1
            g(:, m) = (2*(m + lambda - 1)*s*g(:, m - 1) - (m + 2*lambda - 2)*g(:, m - 2))/m
         end do
         if (lambda == 2) then
            g = 4*g
         else
            g = -2*spread([(m, m=1, points)], 1, points)*g
         end if
      end associate
   end subroutine start_chord_rule

   !> For one target the integral, README.md (F30) or (F31), of each polynomial of a basis, and the derivatives of the
   !> integral of a sum of them with respect to the shape.
   !>
   !> N.B. The derivatives are at fixed w_t: the target z(w_t) moves with the shape.
   subroutine rows(self, basis, map, target, c, row, shape_row)
      class(chord_rule), intent(inout) :: self
      type(disc_polynomials), intent(in) :: basis      !! the one that the rule was prepared for
      type(shape_map), intent(in) :: map               !! the map of the disc
      complex(dp), intent(in) :: target                !! w_t, |w_t| <= 1
      real(dp), intent(in) :: c(:)                     !! coefficients of the sum, shape (N)
      real(dp), intent(out) :: row(:)                  !! integrals of the terms, shape (N) [s, 1/s with power 3]
      real(dp), intent(out) :: shape_row(0:)           !! d(integral of the sum)/d b_k, shape (0:K) [1, 1/s^2]

      real(dp), dimension(size(self%turn, 1), 2) :: analytic, q, slope, step, total
      real(dp), dimension(size(self%turn, 1)) :: analytic_square, density, f, f_slope, jacobian, weight
      complex(dp) :: w(size(self%turn, 1))
      integer :: n, terms

      n = size(weight)
      terms = ubound(map%b, 1)
      call place_points()
      call basis%evaluate(n, w, self%values)
      call map%find_differences(n, target, w, analytic, self%difference)
      call map%linearise_slopes(n, w, self%power, step)
      call dgemv('N', 2*n, terms, 1.0_dp, self%power, 2*n, map%b(1:), 1, 0.0_dp, slope, 1)
      call dgemv('N', 2*n, terms, 1.0_dp, self%difference, 2*n, map%b(1:), 1, 0.0_dp, total, 1)
      associate (turn => self%turn, tau => (map%fold + 1)*map%clustering)
         ! As only |Q| is used, the factor e^(i phi) of Q does not matter, and this is its conjugate.
         q(:, 1) = map%b(0)*analytic(:, 1) + turn(:, 1)*total(:, 1) - turn(:, 2)*total(:, 2)
         q(:, 2) = -map%b(0)*analytic(:, 2) + turn(:, 1)*total(:, 2) + turn(:, 2)*total(:, 1)
         analytic_square = (1.0_dp - tau*step(:, 1))**2 + (tau*step(:, 2))**2
         jacobian = map%b(0)**2*analytic_square - (slope(:, 1)**2 + slope(:, 2)**2)
         ! density = weight/|Q|^p, f = density J and, for d|Q|^-p, f_slope = p J/|Q|^2.
         f_slope = 1.0_dp/(q(:, 1)**2 + q(:, 2)**2)
         density = weight*sqrt(f_slope)
         if (self%kernel_power == 3) density = density*f_slope
         f_slope = self%kernel_power*jacobian*f_slope
         f = jacobian*density
         call dgemv('T', n, basis%terms, 1.0_dp, self%values, n, f, 1, 0.0_dp, row, 1)
         ! README.md (F39): the Jacobian contributes dJ/db_k, the distance -p J/|Q|^2 Re(conj(Q) dQ/db_k).
         call dgemv('N', n, basis%terms, 1.0_dp, self%values, n, c, 1, 0.0_dp, f, 1)
         density = density*f
         f_slope = density*f_slope
         shape_row(0) = 2*map%b(0)*dot_product(density, analytic_square) &
            - dot_product(f_slope, q(:, 1)*analytic(:, 1) - q(:, 2)*analytic(:, 2))
         slope(:, 1) = density*slope(:, 1)
         slope(:, 2) = density*slope(:, 2)
         total(:, 1) = f_slope*(q(:, 1)*turn(:, 1) + q(:, 2)*turn(:, 2))
         total(:, 2) = f_slope*(q(:, 2)*turn(:, 1) - q(:, 1)*turn(:, 2))
      end associate
      call dgemv('T', 2*n, terms, -2.0_dp, self%power, 2*n, slope, 1, 0.0_dp, shape_row(1:), 1)
      call dgemv('T', 2*n, terms, -1.0_dp, self%difference, 2*n, total, 1, 1.0_dp, shape_row(1:), 1)

   contains

      !> Sets the points `w` of the rule for the target, chord after chord, and the weights of the integral dt dphi.
      subroutine place_points()
         real(dp) :: factor, half, middle, of_chord(size(self%node)), t(2)
         integer :: i, j, k, points

         points = size(self%node)
         do i = 1, size(self%direction)
            k = (i - 1)*points
            associate (e => self%direction(i))
               ! The chord's points are t = middle + half xi.
               middle = -(target%re*e%re + target%im*e%im)
               half = sqrt(max(1.0_dp - (target%re*e%im - target%im*e%re)**2, 0.0_dp))
               do j = 1, points
                  w(k + j) = target + (middle + half*self%node(j))*e
               end do
            end associate
            of_chord = self%node_weight
            if (self%kernel_power == 3) then
               ! omega_j(xi_0), README.md (F32), by the recurrence of T_m(xi_0) from T_0 and T_1; with adhesion (F68),
               ! by that of U_m(xi_0) from U_(-2) and U_(-1).
               of_chord = 0.0_dp
               t = [1.0_dp, -middle/half]
               if (self%edge_power < 1.0_dp) t = [-1.0_dp, 0.0_dp]
               do j = 0, points - 1
                  t = [t(2), -2*middle/half*t(2) - t(1)]
                  of_chord = of_chord + t(2)*self%gegenbauer(:, j)
               end do
            end if
            ! A factor half^(2 beta + 1), or half^(2 beta - 1) for the finite part: 2 without adhesion, 0 with adhesion.
            factor = pi/size(self%direction)
            if (nint(2*self%edge_power) == self%kernel_power) factor = factor*half**2
            weight(k + 1:k + points) = factor*of_chord
         end do
      end subroutine place_points

   end subroutine rows

end module wavycon_chord_rule
