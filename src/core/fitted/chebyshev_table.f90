!> Tables of smooth functions of two variables by Chebyshev's polynomials,
!>
!>     f_k(u, v) = sum over i, j of c_ijk T_i(u) T_j(v),   -1 <= u, v <= 1.
!>
!> One such table is what is left of a sum over a lattice where the singular terms near by are taken out, whatever they
!> are: of the kernel, README.md (F22), of maps, section 12, and of stresses, section 13. What is left is even in x and
!> in y, so that u = 2 (x/a)^2 - 1, and v of y alike, on the rectangle |x| <= a, |y| <= b. Series outside of one spot or
!> pool, (F49), are another.
module wavycon_chebyshev_table
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   implicit none (type, external)
   private

   public :: chebyshev_nodes, chebyshev_polynomials, chebyshev_table, square_argument, square_nodes

   type :: chebyshev_table
      real(dp), allocatable :: c(:, :, :)                  !! shape (0:., 0:., functions)
      real(dp), allocatable, private :: power(:, :)        !! coefficients of u^i v^k of the first function, if made
      integer, allocatable, private :: degree(:)           !! in u for each power of v
   contains
      procedure :: set
      procedure :: at
      procedure :: set_powers
      procedure :: evaluate_even
   end type chebyshev_table

contains

   !> Interpolates values at the nodes of both variables.
   pure subroutine set(self, values, rounding)
      class(chebyshev_table), intent(inout) :: self
      real(dp), intent(in) :: values(:, :, :)        !! shape (n_u, n_v, functions)
      real(dp), intent(in), optional :: rounding     !! of the values: no smaller coefficients of the highest degrees

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

   !> All functions at a place.
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

   !> Makes `power` of the first function for `evaluate_even`.
   pure subroutine set_powers(self, rounding)
      class(chebyshev_table), intent(inout) :: self
      real(dp), intent(in) :: rounding         !! of its values: coefficients beyond the last larger one are dropped

      real(dp) :: of_chebyshev(0:max(size(self%c, 1), size(self%c, 2)), 0:max(size(self%c, 1), size(self%c, 2)))
      integer :: j, m, n, terms(0:ubound(self%c, 2))

      of_chebyshev = 0.0_dp
      of_chebyshev(0, 0) = 1.0_dp
      of_chebyshev(1, 1) = 1.0_dp
      do j = 2, ubound(of_chebyshev, 2)
         of_chebyshev(1:, j) = 2*of_chebyshev(:ubound(of_chebyshev, 1) - 1, j - 1)
         of_chebyshev(:, j) = of_chebyshev(:, j) - of_chebyshev(:, j - 2)
      end do
      ! T_j(v) contains lower powers of v, so a degree in u must not be less than those of higher powers of v.
      m = ubound(self%c, 1)
      n = ubound(self%c, 2)
      do j = 0, n
         terms(j) = findloc(maxval(abs(self%c(:, j:, 1)), 2) > rounding, .true., dim=1, back=.true.)
         self%c(terms(j):, j, 1) = 0.0_dp
      end do
      self%degree = max(pack(terms, terms > 0 .or. [(j == 0, j=0, n)]) - 1, 0)
      ! The coefficients fall much faster than those of Chebyshev's polynomials grow: no digits are lost.
      self%power = matmul(of_chebyshev(:m, :m), matmul(self%c(:, :, 1), transpose(of_chebyshev(:n, :n))))
   end subroutine set_powers

   !> The first function at n places of a rectangle, where it is even, and its gradient if that is given room: by
   !> Horner's scheme. With products of matrices in its place loads took a quarter more time.
   pure subroutine evaluate_even(self, half, n, x, y, value, slope_x, slope_y)
      class(chebyshev_table), intent(in) :: self    !! with powers
      real(dp), intent(in) :: half(2)               !! of the rectangle's sides along x and y [s]
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! in the rectangle [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)   !! both or none [1/s]

      real(dp), dimension(n) :: u, v, q, dq, du, dv
      real(dp) :: a, scale(2)
      integer :: i, j, k

      ! As square_argument, with fewer quotients.
      scale = 2/half**2
      u = scale(1)*x**2 - 1.0_dp
      v = scale(2)*y**2 - 1.0_dp
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
      slope_x = 2*scale(1)*x*du
      slope_y = 2*scale(2)*y*dv
   end subroutine evaluate_even

   !> The argument u of x, or v of y, where the function is even.
   elemental real(dp) function square_argument(x, half)
      real(dp), intent(in) :: x, half      !! |x| <= half

      square_argument = 2*(x/half)**2 - 1.0_dp
   end function square_argument

   !> The places of which these are the n nodes.
   pure function square_nodes(n, half) result(x)
      integer, intent(in) :: n             !! >= 1
      real(dp), intent(in) :: half
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

   !> T_0 to T_(n-1).
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
