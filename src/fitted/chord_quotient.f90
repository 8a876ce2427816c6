!> The map's divided difference along chords through a target, its Jacobian, and how both depend on the coefficients.
!>
!> On the chord w = w_t + t e^(i phi) the quotient
!>
!>     Q = (z(w) - z(w_t))/(t e^(i phi)) = b_0 A(w) + sum over k of b_k D_k(w),   README.md (F26),
!>
!> is a polynomial in t that does not vanish where the map is one to one. With v = w_t its terms are
!>
!>     A   = 1 - tau (w^(m+1) - v^(m+1))/(w - v),   D_k = e^(-2 i phi) conj( (w^j - v^j)/(w - v) ),   j = m k - 1,
!>
!> and the differences of powers follow from (w^(j+m) - v^(j+m)) = w^m (w^j - v^j) + v^j (w^m - v^m). The factor e^(i
!> phi) does not matter, as only |Q| is used. For the same reason the conjugates of A and D_k are kept.
!>
!> Complex numbers are kept as real and imaginary parts, so that loops over points vectorise and BLAS sums the terms.
module wavycon_chord_quotient
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: chord_quotient, start_chord_quotient

   !> All at n points, of the target and the shape given last; the second index is 1 for the real, 2 for the imaginary
   !> part.
   type :: chord_quotient
      integer :: points = 0                                !! n
      real(dp), allocatable :: q(:, :)                     !! Q, shape (n, 2)
      real(dp), allocatable :: b_0_term(:, :)              !! dQ/d b_0, shape (n, 2)
      real(dp), allocatable :: b_terms(:, :, :)            !! dQ/d b_k, shape (n, 2, K)
      real(dp), allocatable :: slope(:, :)                 !! dz/d conj(w), shape (n, 2)
      real(dp), allocatable :: slope_terms(:, :, :)        !! d(dz/d conj(w))/d b_k, shape (n, 2, K)
      real(dp), allocatable :: analytic_square(:)          !! |dz/dw|^2/b_0^2, shape (n)
      real(dp), allocatable :: jacobian(:)                 !! |dz/dw|^2 - |dz/d conj(w)|^2 (F16), shape (n)
      ! Work space.
      real(dp), allocatable, private :: w(:, :), step(:, :), last(:, :)
   contains
      procedure :: evaluate
   end type chord_quotient

contains

   !> Makes room.
   subroutine start_chord_quotient(quotient, points, shape_terms)
      type(chord_quotient), intent(out) :: quotient
      integer, intent(in) :: points       !! n >= 1
      integer, intent(in) :: shape_terms  !! K >= 1

      quotient%points = points
      allocate (quotient%q(points, 2), quotient%b_0_term(points, 2), quotient%b_terms(points, 2, shape_terms))
      allocate (quotient%slope(points, 2), quotient%slope_terms(points, 2, shape_terms))
      allocate (quotient%analytic_square(points), quotient%jacobian(points))
      allocate (quotient%w(points, 2), quotient%step(points, 2), quotient%last(points, 2))
   end subroutine start_chord_quotient

   !> Sets all of it for one target.
   subroutine evaluate(self, shape, target, w, turn)
      class(chord_quotient), intent(inout) :: self
      type(shape_map), intent(in) :: shape        !! with K terms
      complex(dp), intent(in) :: target           !! w_t
      complex(dp), intent(in) :: w(:)             !! points on chords through the target, shape (n)
      real(dp), intent(in), contiguous :: turn(:, :)   !! e^(2 i phi) of the chords, shape (n, 2)

      integer :: i, terms

      terms = ubound(shape%b, 1)
      do i = 1, self%points
         self%w(i, 1) = w(i)%re
         self%w(i, 2) = w(i)%im
      end do
      call find_terms(self, shape, target, turn)
      self%q = shape%b(0)*self%b_0_term
      associate (rows => 2*self%points)
         call dgemv('N', rows, terms, 1.0_dp, self%b_terms, rows, shape%b(1:), 1, 1.0_dp, self%q, 1)
         call dgemv('N', rows, terms, 1.0_dp, self%slope_terms, rows, shape%b(1:), 1, 0.0_dp, self%slope, 1)
      end associate
      do i = 1, self%points
         self%jacobian(i) = shape%b(0)**2*self%analytic_square(i) - (self%slope(i, 1)**2 + self%slope(i, 2)**2)
      end do
   end subroutine evaluate

   !> The terms' differences of powers, README.md (F27), with e^(2 i phi), and their slopes.
   subroutine find_terms(self, shape, target, turn)
      type(chord_quotient), intent(inout) :: self
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target
      real(dp), intent(in), contiguous :: turn(:, :)   !! as of evaluate

      complex(dp) :: target_power, target_step
      integer :: j, k, m, n

      n = self%points
      m = shape%fold
      target_step = target**m
      target_power = target**(m - 1)
      associate (w => self%w, step => self%step, last => self%last, difference => self%b_terms, &
                 power => self%slope_terms)
         ! `step` becomes w^m, `difference` that of w^(m-1), `last` that of w^m.
         call set_to_one(difference(:, :, 1))
         call set_to_one(step)
         do j = 2, m - 1
            call multiply(n, difference(:, :, 1), w)
            call add(difference(:, :, 1), target**(j - 1))
            call multiply(n, step, w)
         end do
         power(:, :, 1) = (m - 1)*step
         call multiply(n, step, w)
         call multiply(n, step, w)
         last = difference(:, :, 1)
         call multiply(n, last, w)
         call add(last, target_power)
         call find_analytic_part(self, shape, target_step)
         ! The recurrence is linear in both differences: with e^(2 i phi) in them it is in all.
         call multiply(n, difference(:, :, 1), turn)
         call multiply(n, last, turn)
         do k = 2, ubound(shape%b, 1)
            call next_terms(n, step, last, target_power, (m*k - 1.0_dp)/(m*(k - 1) - 1.0_dp), &
                            difference(:, :, k - 1), power(:, :, k - 1), difference(:, :, k), power(:, :, k))
            target_power = target_power*target_step
         end do
      end associate
   end subroutine find_terms

   !> w^m times the difference of a term, plus a target's power times that of w^m, and w^m times the term's slope.
   pure subroutine next_terms(n, step, last, target_power, factor, difference, power, next_difference, next_power)
      integer, intent(in) :: n
      real(dp), intent(in) :: step(n, 2), last(n, 2)         !! w^m and its difference
      complex(dp), intent(in) :: target_power                !! w_t^j, j that of the term
      real(dp), intent(in) :: factor                         !! ratio of the powers of the next term and of this one
      real(dp), intent(in) :: difference(n, 2), power(n, 2)
      real(dp), intent(out) :: next_difference(n, 2), next_power(n, 2)

      real(dp) :: im, re
      integer :: i

      re = target_power%re
      im = target_power%im
      do i = 1, n
         next_difference(i, 1) = difference(i, 1)*step(i, 1) - difference(i, 2)*step(i, 2) &
            + (re*last(i, 1) - im*last(i, 2))
         next_difference(i, 2) = difference(i, 1)*step(i, 2) + difference(i, 2)*step(i, 1) &
            + (re*last(i, 2) + im*last(i, 1))
         next_power(i, 1) = factor*(power(i, 1)*step(i, 1) - power(i, 2)*step(i, 2))
         next_power(i, 2) = factor*(power(i, 1)*step(i, 2) + power(i, 2)*step(i, 1))
      end do
   end subroutine next_terms

   !> The analytic part of the map over b_0: the conjugate of its divided difference, and the square of its slope.
   subroutine find_analytic_part(self, shape, target_step)
      type(chord_quotient), intent(inout) :: self   !! with w^m and its difference; w is used up
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: target_step        !! w_t^m

      call set_to_one(self%b_0_term)
      self%analytic_square = 1.0_dp
      if (shape%clustering > 0.0_dp) then
         associate (w => self%w, step => self%step, m => shape%fold, tau => shape%clustering)
            call multiply(self%points, w, self%last)
            call add(w, target_step)
            self%b_0_term(:, 1) = 1.0_dp - tau*w(:, 1)
            self%b_0_term(:, 2) = tau*w(:, 2)
            self%analytic_square = (1.0_dp - (m + 1)*tau*step(:, 1))**2 + ((m + 1)*tau*step(:, 2))**2
         end associate
      end if
   end subroutine find_analytic_part

   !> a b, into a.
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

   !> a + number, into a.
   pure subroutine add(a, number)
      real(dp), intent(inout) :: a(:, :)
      complex(dp), intent(in) :: number

      a(:, 1) = a(:, 1) + number%re
      a(:, 2) = a(:, 2) + number%im
   end subroutine add

   pure subroutine set_to_one(a)
      real(dp), intent(out) :: a(:, :)

      a(:, 1) = 1.0_dp
      a(:, 2) = 0.0_dp
   end subroutine set_to_one

end module wavycon_chord_quotient
