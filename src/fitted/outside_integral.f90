!> The integral over a mapped disc of f/|z - z'|^3, an island's gap f, for a target outside: what the island adds to the
!> pressure in the contact.
module wavycon_outside_integral
   use wavycon_disc_polynomials, only: disc_polynomials
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: outside_rule, start_outside_rule

   type :: outside_rule
      real(dp), private :: power = 1.5_dp
      real(dp), allocatable, private :: angle(:), angle_weight(:)     !! Gauss-Legendre rule of the chords, shape (m)
      real(dp), allocatable, private :: node(:), node_weight(:)       !! and of the nearer half of each, shape (n)
      real(dp), allocatable, private :: far_node(:), far_weight(:)    !! with (1 - x)^power, of the other half
   contains
      procedure :: integral
   end type outside_rule

contains

   !> Prepares.
   subroutine start_outside_rule(rule, power, chords, half_points)
      type(outside_rule), intent(out) :: rule
      real(dp), intent(in) :: power         !! of f's weight
      integer, intent(in) :: chords         !! m >= 1
      integer, intent(in) :: half_points    !! n >= 1, points on either half of each

      rule%power = power
      allocate (rule%angle(chords), rule%angle_weight(chords), rule%node(half_points), rule%node_weight(half_points))
      allocate (rule%far_node(half_points), rule%far_weight(half_points))
      call gauss_jacobi(0.0_dp, 0.0_dp, rule%angle, rule%angle_weight)
      call gauss_jacobi(0.0_dp, 0.0_dp, rule%node, rule%node_weight)
      call gauss_jacobi(power, 0.0_dp, rule%far_node, rule%far_weight)
   end subroutine start_outside_rule

   !> The integral for one target.
   !>
   !> It is taken over chords on lines through the target: README.md, end of section 6. Along a chord, s from -1 to 1,
   !> the integrand has a pole beyond the nearer end, as close to it as the target is to the edge. With 1 + s = x^2 and
   !> x = root sinh(y), where root^2 is the distance of the pole from s = -1, the half -1 <= s <= 0 is smooth in y. The
   !> other half is smooth in s.
   real(dp) function integral(self, basis, shape, target, c)
      class(outside_rule), intent(in) :: self
      type(disc_polynomials), intent(in) :: basis   !! with the power of f's weight
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target             !! w_t, |w_t| > 1, where the continued map has the target
      real(dp), intent(in) :: c(:)                  !! coefficients of f, shape (N)

      real(dp), dimension(2*size(self%node)) :: density, inverse_square, t, weight
      real(dp) :: values(2*size(self%node), basis%terms)
      complex(dp), dimension(2*size(self%node)) :: w, z
      complex(dp) :: e, z_target
      real(dp) :: distance, half, middle, nearer_end, opening
      integer :: i, points

      points = 2*size(self%node)
      distance = abs(target)
      opening = asin(1.0_dp/distance)
      z_target = shape%place(target)
      integral = 0.0_dp
      do i = 1, size(self%angle)
         e = -target/distance*exp(cmplx(0.0_dp, opening*self%angle(i), dp))
         middle = -(target%re*e%re + target%im*e%im)
         half = sqrt(max(1.0_dp - (target%re*e%im - target%im*e%re)**2, tiny(1.0_dp)))
         nearer_end = (distance - 1.0_dp)*(distance + 1.0_dp)/(middle + half)
         call place_on_chord(self%power, nearer_end, half, self%node, self%node_weight, self%far_node, &
                             self%far_weight, t, weight)
         w = target + t*e
         call basis%evaluate(points, w, values)
         z = shape%place(w) - z_target
         inverse_square = 1.0_dp/(z%re**2 + z%im**2)
         density = weight*t*shape%jacobian(w)*inverse_square*sqrt(inverse_square)
         integral = integral + opening*self%angle_weight(i)*half**(2*self%power + 1) &
            *dot_product(density, matmul(values, c))
      end do
   end function integral

   !> Distances t from the target of a chord's points, and weights with (1 - s^2)^power.
   pure subroutine place_on_chord(power, nearer_end, half, node, node_weight, far_node, far_weight, t, weight)
      real(dp), intent(in) :: power
      real(dp), intent(in) :: nearer_end                                   !! t of the nearer end, > 0
      real(dp), intent(in) :: half                                         !! half the chord's length, > 0
      real(dp), intent(in), dimension(:) :: node, node_weight              !! Gauss-Legendre rule, shape (n)
      real(dp), intent(in), dimension(:) :: far_node, far_weight           !! with the weight (1 - x)^power, shape (n)
      real(dp), intent(out), dimension(:) :: t, weight                     !! shape (2 n)

      real(dp), dimension(size(node)) :: x, y
      real(dp) :: root, top
      integer :: n

      n = size(node)
      root = sqrt(nearer_end/half)
      top = asinh(1.0_dp/root)
      y = 0.5_dp*top*(1.0_dp + node)
      x = root*sinh(y)
      t(:n) = nearer_end + half*x**2
      weight(:n) = top*node_weight*root*cosh(y)*x**(2*power + 1)*(2.0_dp - x**2)**power
      t(n + 1:) = nearer_end + half*(1.5_dp + 0.5_dp*far_node)
      weight(n + 1:) = far_weight*0.5_dp**(power + 1)*(1.5_dp + 0.5_dp*far_node)**power
   end subroutine place_on_chord

end module wavycon_outside_integral
