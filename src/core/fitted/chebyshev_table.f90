!> Tables of smooth functions of two variables by Chebyshev's polynomials,
!>
!>     f_k(u, v) = sum over i, j of c_ijk T_i(u) T_j(v),   -1 <= u, v <= 1.
!>
!> A sum over a lattice, less its singular terms near by, is such a table: the kernel, README.md (F22), maps of fields,
!> section 12, and stresses, section 13. These functions are even in x and in y. So u = 2 (x/a)^2 - 1 and v = 2 (y/b)^2
!> - 1 on the rectangle |x| <= a, |y| <= b. The series outside of one spot or pool, (F49), is such a table too.
module wavycon_chebyshev_table
   use wavycon_kinds, only: dp, pi
   use wavycon_lapack, only: dgemv
   implicit none (type, external)
   private

   public :: chebyshev_nodes, chebyshev_polynomials, chebyshev_table, square_argument, square_nodes

   type :: chebyshev_table
      real(dp), allocatable :: c(:, :, :)                  !! c_ijk, shape (0:n_u - 1, 0:n_v - 1, functions)
      !> Coefficients of u^i v^k of the first function; allocated by `set_powers`.
      real(dp), allocatable, private :: power(:, :)
      integer, allocatable, private :: degree(:)           !! for each power of v the degree of its polynomial in u
   contains
      procedure :: set, at, set_powers, evaluate_even
   end type chebyshev_table

contains

   !> Sets the coefficients of the functions that have given values at Chebyshev's nodes of u and v.
   pure subroutine set(self, values, rounding)
      class(chebyshev_table), intent(inout) :: self
      real(dp), intent(in) :: values(:, :, :)        !! shape (n_u, n_v, functions)
      !> Rounding of the values. Coefficients of the highest degrees in u that are no larger are set to zero.
      real(dp), intent(in), optional :: rounding

      integer :: j, k

      if (allocated(self%c)) deallocate (self%c)
      allocate (self%c(0:size(values, 1) - 1, 0:size(values, 2) - 1, size(values, 3)))
      associate (of_u => coefficients(size(values, 1)), of_v => coefficients(size(values, 2)))
         do k = 1, size(values, 3)
            self%c(:, :, k) = matmul(of_u, matmul(values(:, :, k), transpose(of_v)))
            if (.not. present(rounding)) cycle
            do j = 0, ubound(self%c, 2)
               self%c(findloc(abs(self%c(:, j, k)) > rounding, .true., dim=1, back=.true.):, j, k) = 0.0_dp
            end do
         end do
      end associate
   end subroutine set

   !> The values of all functions at a point u, v.
   pure function at(self, u, v) result(values)
      class(chebyshev_table), intent(in) :: self
      real(dp), intent(in) :: u, v
      real(dp) :: values(size(self%c, 3))

      real(dp) :: part(size(self%c, 2), size(self%c, 3))

      associate (c => self%c, of_u => chebyshev_polynomials(u, size(self%c, 1)), &
                 of_v => chebyshev_polynomials(v, size(self%c, 2)))
         call dgemv('T', size(c, 1), size(part), 1.0_dp, c, size(c, 1), of_u, 1, 0.0_dp, part, 1)
         call dgemv('T', size(c, 2), size(c, 3), 1.0_dp, part, size(c, 2), of_v, 1, 0.0_dp, values, 1)
      end associate
   end function at

   !> Converts the first function to powers of u and v, as `evaluate_even` takes them. Its coefficients of the highest
   !> degrees that are no larger than rounding are set to zero.
   pure subroutine set_powers(self, rounding)
      class(chebyshev_table), intent(inout) :: self
      real(dp), intent(in) :: rounding         !! rounding of the function's values

      real(dp) :: of_chebyshev(0:max(size(self%c, 1), size(self%c, 2)), 0:max(size(self%c, 1), size(self%c, 2)))
      integer :: j, m, n, terms(0:ubound(self%c, 2))

      of_chebyshev = 0.0_dp
      of_chebyshev(0, 0) = 1.0_dp
      of_chebyshev(1, 1) = 1.0_dp
      do j = 2, ubound(of_chebyshev, 2)
         of_chebyshev(1:, j) = 2*of_chebyshev(:ubound(of_chebyshev, 1) - 1, j - 1)
         of_chebyshev(:, j) = of_chebyshev(:, j) - of_chebyshev(:, j - 2)
      end do
      ! T_j(v) contains lower powers of v too. So the degree in u of a power of v must be at least that of any higher
      ! one.
      m = ubound(self%c, 1)
      n = ubound(self%c, 2)
      do j = 0, n
         terms(j) = findloc(maxval(abs(self%c(:, j:, 1)), 2) > rounding, .true., dim=1, back=.true.)
         self%c(terms(j):, j, 1) = 0.0_dp
      end do
      self%degree = max(pack(terms, terms > 0 .or. [(j == 0, j=0, n)]) - 1, 0)
      ! No digits are lost: the coefficients c fall much faster with the degree than those of Chebyshev's polynomials
      ! grow.
      self%power = matmul(of_chebyshev(:m, :m), matmul(self%c(:, :, 1), transpose(of_chebyshev(:n, :n))))
   end subroutine set_powers

   !> The first function, which is even in x and y, at n points of the rectangle, and its gradient if the arguments are
   !> present. Horner's scheme is used: with products of matrices the solution of a load took a quarter more time.
   pure subroutine evaluate_even(self, half, n, x, y, value, slope_x, slope_y)
      class(chebyshev_table), intent(in) :: self    !! after set_powers
      real(dp), intent(in) :: half(2)               !! half the rectangle's sides along x and y, a and b [s]
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! points in the rectangle [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)   !! both or none [1/s]

      real(dp), dimension(n) :: u, v, q, dq, du, dv
      real(dp) :: a, factor(2)
      integer :: i, j, k

      ! The arguments of square_argument, with fewer divisions.
      factor = 2/half**2
      u = factor(1)*x**2 - 1.0_dp
      v = factor(2)*y**2 - 1.0_dp
      value = 0.0_dp
      du = 0.0_dp
      dv = 0.0_dp
      do k = size(self%degree), 1, -1
         q = self%power(self%degree(k) + 1, k)
         if (present(slope_x)) dq = 0.0_dp
         do j = self%degree(k), 1, -1
            a = self%power(j, k)
            if (present(slope_x)) then
               do i = 1, n
                  dq(i) = dq(i)*u(i) + q(i)
                  q(i) = q(i)*u(i) + a
               end do
            else
               q = q*u + a
            end if
         end do
         if (present(slope_x)) then
            dv = dv*v + value
            du = du*v + dq
         end if
         value = value*v + q
      end do
      if (.not. present(slope_x)) return
      slope_x = 2*factor(1)*x*du
      slope_y = 2*factor(2)*y*dv
   end subroutine evaluate_even

   !> The argument u that belongs to x, or v that belongs to y, of an even function.
   elemental real(dp) function square_argument(x, half)
      real(dp), intent(in) :: x, half      !! the coordinate and half the side of the rectangle, |x| <= half

      square_argument = 2*(x/half)**2 - 1.0_dp
   end function square_argument

   !> The coordinates x >= 0 whose arguments u are the n nodes of Chebyshev's interpolation.
   pure function square_nodes(n, half) result(x)
      integer, intent(in) :: n             !! >= 1
      real(dp), intent(in) :: half         !! half the side of the rectangle
      real(dp) :: x(n)

      x = half*sqrt(0.5_dp*(1.0_dp + chebyshev_nodes(n)))
   end function square_nodes

   !> The nodes of Chebyshev's interpolation, the largest one first.
   pure function chebyshev_nodes(n) result(x)
      integer, intent(in) :: n             !! >= 1
      real(dp) :: x(n)

      integer :: i

      x = [(cos(pi*(i - 0.5_dp)/n), i=1, n)]
   end function chebyshev_nodes

   !> The matrix that turns values at the n nodes into coefficients of T_0 to T_(n-1).
   pure function coefficients(n) result(matrix)
      integer, intent(in) :: n             !! >= 1
      real(dp) :: matrix(0:n - 1, n)

      integer :: i, k

      do i = 1, n
         matrix(:, i) = [(merge(1, 2, k == 0)*cos(pi*k*(i - 0.5_dp)/n)/n, k=0, n - 1)]
      end do
   end function coefficients

   !> The values of Chebyshev's polynomials T_0 to T_(n-1).
   pure function chebyshev_polynomials(x, n) result(t)
      real(dp), intent(in) :: x
      integer, intent(in) :: n             !! >= 2
      real(dp) :: t(0:n - 1)

      integer :: i

      t(0) = 1.0_dp
      t(1) = x
      do i = 2, n - 1
         t(i) = 2*x*t(i - 1) - t(i - 2)
      end do
   end function chebyshev_polynomials

end module wavycon_chebyshev_table
