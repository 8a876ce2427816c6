!> Points on the chords of the unit disc through a target, and weights that integrate over the disc with them.
!>
!> With w = w_t + t e^(i phi) the area element is |t| dt dphi, and 1 - |w|^2 is the product of the distances to the
!> chord's ends. So with the weight (1 - |w|^2)^power a Gauss-Gegenbauer rule along the chord is exact for polynomials.
!> In phi the midpoint rule over half a turn converges exponentially. What is integrated is
!>
!>     power 1/2: f(w)/|t|, so that the area element cancels the singularity, README.md (F30);
!>     power 3/2: f(w)/|t|^3 as Hadamard's finite part, README.md (F31).
!>
!> For the finite part let s be the place along a chord, from -1 to 1, and s_0 the target's. Then
!>
!>     finite part of the integral of (1 - s^2)^(3/2) C_m(s)/(s - s_0)^2 ds = (pi/2)(m+1)(m+3) T_(m+2)(s_0),   (F33)
!>
!> with Gegenbauer's polynomials C_m of this weight, whose squares have the integrals (pi/8)(m+1)(m+3) (F34), and
!> Chebyshev's T_m. The part left out about the target is round in the image, not in the disc; what that changes is odd
!> in t and cancels.
module wavycon_chord_points
   use wavycon_constants, only: pi
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: chord_points, start_chord_points

   type :: chord_points
      integer :: twice_power = 1                          !! 2 power: 1 or 3
      real(dp), allocatable :: node(:), node_weight(:)    !! Gauss's rule along a chord, -1 to 1, shape (n)
      complex(dp), allocatable :: direction(:)            !! e^(i phi), shape (m)
      !> What C_m weighs at the nodes, for the finite part, shape (n, 0:n-1).
      real(dp), allocatable, private :: gegenbauer(:, :)
      real(dp), allocatable :: turn(:, :)                 !! e^(2 i phi) by real and imaginary part, shape (n m, 2)
      ! Set for each target, chord after chord, shape (n m).
      complex(dp), allocatable :: w(:)                    !! the points
      real(dp), allocatable :: weight(:)
   contains
      procedure :: place
   end type chord_points

contains

   !> Prepares for a number of chords and of points on each.
   subroutine start_chord_points(chords, power, angles, points)
      type(chord_points), intent(out) :: chords
      real(dp), intent(in) :: power     !! of the weight: 1/2, or 3/2 for the finite part
      integer, intent(in) :: angles     !! m, number of chords, >= 1
      integer, intent(in) :: points     !! n, on a chord, >= 1

      integer :: m, n

      n = angles*points
      chords%twice_power = nint(2*power)
      allocate (chords%node(points), chords%node_weight(points))
      chords%direction = exp(cmplx(0.0_dp, pi*([(m, m=1, angles)] - 0.5_dp)/angles, dp))
      call gauss_jacobi(power, power, chords%node, chords%node_weight)
      if (chords%twice_power == 3) then
         allocate (chords%gegenbauer(points, 0:points - 1))
         associate (g => chords%gegenbauer, s => chords%node)
            g(:, 0) = chords%node_weight
            if (points > 1) g(:, 1) = 4*s*g(:, 0)
            do m = 2, points - 1
               g(:, m) = (2*(m + 1)*s*g(:, m - 1) - (m + 2)*g(:, m - 2))/m
            end do
         end associate
      end if
      allocate (chords%w(n), chords%weight(n), chords%turn(n, 2))
      chords%turn(:, 1) = reshape(spread(chords%direction%re**2 - chords%direction%im**2, 1, points), [n])
      chords%turn(:, 2) = reshape(spread(2*chords%direction%re*chords%direction%im, 1, points), [n])
   end subroutine start_chord_points

   !> Sets points and weights for a target.
   subroutine place(self, target)
      class(chord_points), intent(inout) :: self
      complex(dp), intent(in) :: target          !! w_t, |w_t| <= 1

      complex(dp) :: e
      real(dp) :: half, middle, scale, weight(size(self%node))
      integer :: angles, i, j, k

      angles = size(self%direction)
      k = 0
      do i = 1, angles
         e = self%direction(i)
         scale = pi/angles
         ! The chord's points are t = middle + half s.
         middle = -(target%re*e%re + target%im*e%im)
         half = sqrt(max(1.0_dp - (target%re*e%im - target%im*e%re)**2, 0.0_dp))
         if (self%twice_power == 3) then
            scale = scale*half**(self%twice_power - 1)
            weight = finite_part_weights(self, -middle/half)
         else
            scale = scale*half**(self%twice_power + 1)
            weight = self%node_weight
         end if
         do j = 1, size(self%node)
            k = k + 1
            self%w(k) = target + (middle + half*self%node(j))*e
            self%weight(k) = scale*weight(j)
         end do
      end do
   end subroutine place

   !> Weights along a chord for the finite part with 1/(s - s_0)^2: W_j(s_0) of README.md (F32).
   pure function finite_part_weights(self, s_0) result(weight)
      class(chord_points), intent(in) :: self
      real(dp), intent(in) :: s_0               !! the target's place on the chord, between -1 and 1
      real(dp) :: weight(size(self%node))

      real(dp) :: before, next, now
      integer :: m

      weight = 0.0_dp
      ! T_1 and T_2.
      before = s_0
      now = 2*s_0**2 - 1.0_dp
      do m = 0, size(self%node) - 1
         weight = weight + 4*now*self%gegenbauer(:, m)
         next = 2*s_0*now - before
         before = now
         now = next
      end do
   end function finite_part_weights

end module wavycon_chord_points
