!> Polynomials on the unit disc that are orthonormal with the weight (1 - |w|^2)^power and have the symmetry of a
!> contact: they do not change under rotation by 1/fold of a full turn and under reflection at the x axis.
!>
!> They are multiples of Re(w^(fold k)) P_l^(power, fold k)(2 |w|^2 - 1), fold k + 2 l <= degree, with Jacobi's
!> polynomials P: README.md (F24).
module wavycon_disc_polynomials
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: disc_polynomials, start_disc_polynomials

   type :: disc_polynomials
      integer :: fold = 4                   !! order of the rotational symmetry, >= 1
      integer :: degree = 0                 !! highest degree of the polynomials, >= 0
      integer :: terms = 0                  !! number N of polynomials
      real(dp) :: power = 0.5_dp            !! power of 1 - |w|^2 in the weight, > -1
      integer, allocatable :: angular(:)    !! fold k of each term, shape (N)
      integer, allocatable :: radial(:)     !! l of each term, shape (N)
      real(dp), allocatable, private :: recurrence(:, :)  !! p_l = (r1 x + r2) p_(l-1) + r3 p_(l-2), shape (3, N)
   contains
      procedure :: evaluate, slopes
   end type disc_polynomials

contains

   !> Sets the terms and their three-term recurrences in l, which are those of Jacobi's polynomials scaled to the norm
   !> 1.
   subroutine start_disc_polynomials(basis, fold, degree, power)
      type(disc_polynomials), intent(out) :: basis
      integer, intent(in) :: fold     !! component of the same name, >= 1
      integer, intent(in) :: degree   !! component of the same name, >= 0
      real(dp), intent(in) :: power   !! component of the same name, > -1

      real(dp) :: a, b, norm, previous_norm, s
      integer :: k, l, n

      basis%fold = fold
      basis%degree = degree
      basis%power = power
      basis%terms = sum([((degree - k)/2 + 1, k=0, degree, fold)])
      allocate (basis%angular(basis%terms), basis%radial(basis%terms), basis%recurrence(3, basis%terms))
      n = 0
      a = power
      do k = 0, degree, fold
         b = k
         previous_norm = 1.0_dp
         do l = 0, (degree - k)/2
            n = n + 1
            basis%angular(n) = k
            basis%radial(n) = l
            norm = norm_over_disc(k, l, a)
            s = 2*l + a + b
            associate (r => basis%recurrence(:, n))
               select case (l)
               case (0)
                  r = [0.0_dp, 1.0_dp/norm, 0.0_dp]
               case (1)
                  r = [0.5_dp*(a + b + 2), 0.5_dp*(a - b), 0.0_dp]*previous_norm/norm
               case default
                  r = [(s - 1)*s*(s - 2), (s - 1)*(a**2 - b**2), -2*(l + a - 1)*(l + b - 1)*s] &
                     /(2*l*(l + a + b)*(s - 2))
                  r(:2) = r(:2)*previous_norm/norm
                  r(3) = r(3)*norm_over_disc(k, l - 2, a)/norm
               end select
            end associate
            previous_norm = norm
         end do
      end do
   end subroutine start_disc_polynomials

   !> The norm of a term before scaling, README.md (F25): the root of the integral over the disc of its square times the
   !> weight.
   pure real(dp) function norm_over_disc(k, l, a) result(norm)
      integer, intent(in) :: k     !! `angular` of the term: fold times its k
      integer, intent(in) :: l     !! `radial` of the term
      real(dp), intent(in) :: a    !! power of 1 - |w|^2 in the weight

      norm = log_gamma(l + a + 1) + log_gamma(l + k + 1.0_dp) - log_gamma(l + 1.0_dp) - log_gamma(l + a + k + 1)
      norm = sqrt(merge(pi, 0.5_dp*pi, k == 0)*exp(norm)/(2*l + a + k + 1))
   end function norm_over_disc

   !> The values of all terms at n points. The points may also lie outside of the disc.
   pure subroutine evaluate(self, n, w, values)
      class(disc_polynomials), intent(in) :: self
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)                  !! points x + i y
      real(dp), intent(out) :: values(n, self%terms)

      complex(dp), dimension(n) :: angular, step
      real(dp) :: x(n), a, b, c
      integer :: i, k, l, older, t

      x = 2*(w%re**2 + w%im**2) - 1.0_dp
      angular = 1.0_dp
      step = w
      do k = 2, self%fold
         step = step*w
      end do
      t = 0
      do k = 0, self%degree, self%fold
         if (k > 0) angular = angular*step
         do l = 0, (self%degree - k)/2
            t = t + 1
            a = self%recurrence(1, t)
            b = self%recurrence(2, t)
            c = self%recurrence(3, t)
            if (l == 0) then
               values(:, t) = b*angular%re
               cycle
            end if
            ! For l = 1 there is no term l - 2. Any term will do in its place, as c is 0.
            older = max(t - 2, 1)
            do i = 1, n
               values(i, t) = (a*x(i) + b)*values(i, t - 1) + c*values(i, older)
            end do
         end do
      end do
   end subroutine evaluate

   !> The gradients of all terms at n points.
   pure subroutine slopes(self, n, w, values, slope_x, slope_y)
      class(disc_polynomials), intent(in) :: self
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)                            !! points x + i y
      real(dp), intent(in) :: values(n, self%terms)              !! values of the terms, from `evaluate`
      real(dp), intent(out), dimension(n, self%terms) :: slope_x, slope_y   !! derivatives along x and y

      complex(dp) :: power(n), step(n)
      real(dp) :: a, b, c, s
      integer :: i, k, l, older, t

      step = conjg(w)**self%fold
      power = 0.0_dp
      t = 0
      do k = 0, self%degree, self%fold
         ! The gradient of Re(w^k) is k conj(w)^(k-1).
         if (k == self%fold) power = conjg(w)**(self%fold - 1)
         if (k > self%fold) power = power*step
         do l = 0, (self%degree - k)/2
            t = t + 1
            a = self%recurrence(1, t)
            b = self%recurrence(2, t)
            c = self%recurrence(3, t)
            if (l == 0) then
               slope_x(:, t) = b*k*power%re
               slope_y(:, t) = b*k*power%im
               cycle
            end if
            older = max(t - 2, 1)
            do i = 1, n
               s = a*(2*(w(i)%re**2 + w(i)%im**2) - 1.0_dp) + b
               slope_x(i, t) = s*slope_x(i, t - 1) + 4*a*w(i)%re*values(i, t - 1) + c*slope_x(i, older)
               slope_y(i, t) = s*slope_y(i, t - 1) + 4*a*w(i)%im*values(i, t - 1) + c*slope_y(i, older)
            end do
         end do
      end do
   end subroutine slopes

end module wavycon_disc_polynomials
