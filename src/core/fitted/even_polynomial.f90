!> Chebyshev's interpolation on -1 <= x <= 1, at the nodes cos(pi (i - 1/2)/n); and a function that is even in x and in
!> y, as a polynomial in x^2 and y^2 on the rectangle |x| <= 1/2, |y| <= height/2.
!>
!> The latter is interpolated in u = 8 x^2 - 1 and v = 8 (y/height)^2 - 1, both between -1 and 1: README.md (F22).
!> Coefficients below rounding are dropped, and the rest is turned into powers of u and v, evaluated by Horner's scheme.
module wavycon_even_polynomial
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: chebyshev_coefficients, chebyshev_node, chebyshev_polynomials
   public :: even_polynomial, fit_nodes, start_even_polynomial

   type :: even_polynomial
      real(dp) :: height = 1.0_dp                     !! of the rectangle [s]
      real(dp), allocatable :: coefficient(:, :)      !! of u^i v^k, shape (0:., 0:.)
      integer, allocatable :: degree(:)               !! in u for each power of v, shape (0:.)
   contains
      procedure :: evaluate
   end type even_polynomial

   !> In the square of either coordinate: the first term left out is below rounding.
   integer, parameter, public :: fit_degree = 12

contains

   !> Places at which the function is needed: those where u and v are the nodes of Chebyshev's interpolation.
   pure subroutine fit_nodes(height, x, y)
      real(dp), intent(in) :: height                                       !! > 0 [s]
      real(dp), intent(out), dimension(0:fit_degree, 0:fit_degree) :: x, y !! [s]

      integer :: i
      real(dp) :: node(0:fit_degree)

      do i = 0, fit_degree
         node(i) = sqrt(0.5_dp*(1.0_dp + chebyshev_node(i + 1, fit_degree + 1)))
      end do
      do i = 0, fit_degree
         x(:, i) = 0.5_dp*node
         y(i, :) = 0.5_dp*height*node
      end do
   end subroutine fit_nodes

   !> Interpolates.
   pure subroutine start_even_polynomial(fit, height, values, rounding)
      type(even_polynomial), intent(out) :: fit
      real(dp), intent(in) :: height                   !! > 0 [s]
      real(dp), intent(in) :: values(0:fit_degree, 0:fit_degree)   !! of the function at the nodes
      real(dp), intent(in) :: rounding                 !! of the values: smaller coefficients are dropped

      integer, parameter :: n = fit_degree
      real(dp), dimension(0:n, 0:n) :: chebyshev, of_values, powers
      integer :: degree(0:n), j, k

      of_values = chebyshev_coefficients(n + 1)
      chebyshev = matmul(of_values, matmul(values, transpose(of_values)))
      do j = 0, n
         degree(j) = findloc(abs(chebyshev(:, j)) > rounding, .true., dim=1, back=.true.) - 1
         chebyshev(degree(j) + 1:, j) = 0.0_dp
      end do
      k = max(findloc(degree >= 0, .true., dim=1, back=.true.) - 1, 0)
      ! T_j(v) contains lower powers of v, so a degree in u must not be less than those of higher powers of v.
      degree(k) = max(degree(k), 0)
      do j = k - 1, 0, -1
         degree(j) = max(degree(j), degree(j + 1))
      end do
      call powers_of_chebyshev(powers)
      ! The coefficients fall much faster than those of Chebyshev's polynomials grow: no digits are lost.
      chebyshev = matmul(powers, matmul(chebyshev, transpose(powers)))
      fit%height = height
      allocate (fit%degree(0:k), fit%coefficient(0:degree(0), 0:k))
      fit%degree(:) = degree(:k)
      fit%coefficient(:, :) = chebyshev(:degree(0), :k)
   end subroutine start_even_polynomial

   !> Coefficients of the powers in Chebyshev's polynomials T_0, T_1, .., a column each.
   pure subroutine powers_of_chebyshev(powers)
      real(dp), intent(out) :: powers(0:fit_degree, 0:fit_degree)

      integer :: j

      powers = 0.0_dp
      powers(0, 0) = 1.0_dp
      powers(1, 1) = 1.0_dp
      do j = 2, fit_degree
         powers(1:, j) = 2*powers(:fit_degree - 1, j - 1)
         powers(:, j) = powers(:, j) - powers(:, j - 2)
      end do
   end subroutine powers_of_chebyshev

   !> The polynomial and, if its slopes are given room, its gradient at n places.
   pure subroutine evaluate(self, n, x, y, value, slope_x, slope_y)
      class(even_polynomial), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! in the rectangle [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)   !! both or none [1/s]

      real(dp), dimension(n) :: u, v, q, dq, du, dv
      real(dp) :: a
      integer :: i, j, k

      do i = 1, n
         u(i) = 8*x(i)**2 - 1.0_dp
         v(i) = 8*(y(i)/self%height)**2 - 1.0_dp
      end do
      value = 0.0_dp
      du = 0.0_dp
      dv = 0.0_dp
      do k = ubound(self%degree, 1), 0, -1
         q = self%coefficient(self%degree(k), k)
         if (present(slope_x)) then
            dq = 0.0_dp
            do j = self%degree(k) - 1, 0, -1
               a = self%coefficient(j, k)
               do i = 1, n
                  dq(i) = dq(i)*u(i) + q(i)
                  q(i) = q(i)*u(i) + a
               end do
            end do
            do i = 1, n
               dv(i) = dv(i)*v(i) + value(i)
               du(i) = du(i)*v(i) + dq(i)
            end do
         else
            do j = self%degree(k) - 1, 0, -1
               a = self%coefficient(j, k)
               do i = 1, n
                  q(i) = q(i)*u(i) + a
               end do
            end do
         end if
         do i = 1, n
            value(i) = value(i)*v(i) + q(i)
         end do
      end do
      if (present(slope_x)) then
         do i = 1, n
            slope_x(i) = 16*x(i)*du(i)
            slope_y(i) = 16*y(i)/self%height**2*dv(i)
         end do
      end if
   end subroutine evaluate

   !> The i-th of n nodes of Chebyshev's interpolation.
   elemental real(dp) function chebyshev_node(i, n) result(x)
      integer, intent(in) :: i          !! 1 to n; the largest node is the first
      integer, intent(in) :: n          !! >= 1

      x = cos(pi*(i - 0.5_dp)/n)
   end function chebyshev_node

   !> The matrix that turns values at the n nodes into coefficients of T_0 to T_(n-1).
   pure function chebyshev_coefficients(n) result(matrix)
      integer, intent(in) :: n          !! >= 1
      real(dp) :: matrix(0:n - 1, n)

      integer :: i, k

      do i = 1, n
         matrix(:, i) = [(merge(1, 2, k == 0)*cos(pi*k*(i - 0.5_dp)/n)/n, k=0, n - 1)]
      end do
   end function chebyshev_coefficients

   !> T_0 to T_(n-1).
   pure function chebyshev_polynomials(x, n) result(t)
      real(dp), intent(in) :: x
      integer, intent(in) :: n          !! >= 2
      real(dp) :: t(0:n - 1)

      integer :: i

      t(0) = 1.0_dp
      t(1) = x
      do i = 2, n - 1
         t(i) = 2*x*t(i - 1) - t(i - 2)
      end do
   end function chebyshev_polynomials

end module wavycon_even_polynomial
