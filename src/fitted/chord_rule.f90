!> The singular integral over a mapped disc for a target inside, however near its edge: of f/|z - z'|, and Hadamard's
!> finite part of that of f/|z - z'|^3.
!>
!> For f = (1 - |w|^2)^power times a polynomial, J the map's Jacobian and Q its divided difference along a chord,
!>
!>     integral of f J/|z(w) - z(w_t)| over the disc = integral of f J/|Q| over all chords, dt dphi,
!>
!> README.md (F28), and with 1/|z - z'|^3 it is the finite part of f J/(t^2 |Q|^3) (F29). Q does not vanish, so that
!> quadrature along the chords and over their angles converges exponentially.
module wavycon_chord_rule
   use wavycon_chord_points, only: chord_points, start_chord_points
   use wavycon_chord_quotient, only: chord_quotient, start_chord_quotient
   use wavycon_disc_polynomials, only: disc_polynomials
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: chord_rule, start_chord_rule

   type :: chord_rule
      integer :: kernel_power = 1                              !! of 1/|z - z'|: 1 or 3
      type(chord_points), private :: chords
      type(chord_quotient), private :: quotient
      ! Work space for the n points of one target.
      real(dp), allocatable, private :: density(:), f(:), f_slope(:)    !! shape (n)
      real(dp), allocatable, private :: values(:, :)                    !! of the basis, shape (n, N)
   contains
      procedure :: rows
   end type chord_rule

contains

   !> Prepares for one basis and one number of shape terms.
   !>
   !> The weight determines the kernel: the power 1/2, of a spot's pressure, has 1/|z - z'|, the power 3/2, of an
   !> pool's gap, 1/|z - z'|^3.
   subroutine start_chord_rule(rule, basis, shape_terms, angles, points)
      type(chord_rule), intent(out) :: rule
      type(disc_polynomials), intent(in) :: basis
      integer, intent(in) :: shape_terms  !! K >= 1
      integer, intent(in) :: angles       !! number of chords, >= 1
      integer, intent(in) :: points       !! on a chord, >= 1

      integer :: n

      n = angles*points
      rule%kernel_power = nint(2*basis%power)
      call start_chord_points(rule%chords, basis%power, angles, points)
      call start_chord_quotient(rule%quotient, n, shape_terms)
      allocate (rule%density(n), rule%f(n), rule%f_slope(n), rule%values(n, basis%terms))
   end subroutine start_chord_rule

   !> The integral for one target, README.md (F30) or (F31), for each polynomial of the basis, and its derivatives with
   !> respect to the shape for a sum of them.
   !>
   !> N.B. The derivatives are at fixed w_t: the target moves with the shape.
   subroutine rows(self, basis, shape, target, c, row, shape_row)
      class(chord_rule), intent(inout) :: self
      type(disc_polynomials), intent(in) :: basis      !! the one the rule was prepared for
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target                !! w_t, |w_t| <= 1
      real(dp), intent(in) :: c(:)                     !! coefficients of the sum, shape (N)
      real(dp), intent(out) :: row(:)                  !! integrals of the terms, shape (N) [s, 1/s with power 3]
      real(dp), intent(out), optional :: shape_row(0:) !! d(integral of the sum)/d b_k, shape (0:K) [1, 1/s^2]

      integer :: i, n

      call self%chords%place(target)
      n = size(self%chords%w)
      call basis%evaluate(n, self%chords%w, self%values)
      call self%quotient%evaluate(shape, target, self%chords%w, self%chords%turn)
      associate (jacobian => self%quotient%jacobian, q => self%quotient%q, weight => self%chords%weight, &
                 density => self%density, f => self%f, f_slope => self%f_slope)
         ! density = weight/|Q|^p, f = density J and, for d|Q|^-p, f_slope = p J/|Q|^2.
         do i = 1, n
            f_slope(i) = 1.0_dp/(q(i, 1)**2 + q(i, 2)**2)
            density(i) = weight(i)*sqrt(f_slope(i))
         end do
         if (self%kernel_power == 3) density = density*f_slope
         f_slope = self%kernel_power*jacobian*f_slope
         f = jacobian*density
         call dgemv('T', n, basis%terms, 1.0_dp, self%values, n, f, 1, 0.0_dp, row, 1)
         if (.not. present(shape_row)) return
         call dgemv('N', n, basis%terms, 1.0_dp, self%values, n, c, 1, 0.0_dp, f, 1)
         density = density*f
      end associate
      call add_shape_slopes(self, shape, shape_row)
   end subroutine rows

   !> Derivatives of the sum's integral, README.md (F39): by the Jacobian, dJ/db_k, and by the distance, -p J/|Q|^2
   !> Re(conj(Q) dQ/db_k), both times the sum's value and the weight, which `density` holds.
   subroutine add_shape_slopes(self, shape, shape_row)
      type(chord_rule), intent(inout) :: self
      type(shape_map), intent(in) :: shape
      real(dp), intent(out) :: shape_row(0:)

      integer :: j, rows, terms

      associate (density => self%density, f_slope => self%f_slope, p => self%quotient)
         shape_row(0) = 2*shape%b(0)*dot_product(density, p%analytic_square)
         do j = 1, 2
            p%slope(:, j) = density*p%slope(:, j)
            p%q(:, j) = density*f_slope*p%q(:, j)
            shape_row(0) = shape_row(0) - dot_product(p%q(:, j), p%b_0_term(:, j))
         end do
         rows = 2*p%points
         terms = ubound(shape%b, 1)
         call dgemv('T', rows, terms, -2.0_dp, p%slope_terms, rows, p%slope, 1, 0.0_dp, shape_row(1:), 1)
         call dgemv('T', rows, terms, -1.0_dp, p%b_terms, rows, p%q, 1, 1.0_dp, shape_row(1:), 1)
      end associate
   end subroutine add_shape_slopes

end module wavycon_chord_rule
