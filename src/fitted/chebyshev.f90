!> Chebyshev's interpolation on -1 <= x <= 1, at the nodes cos(pi (i - 1/2)/n).
module wavycon_chebyshev
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: chebyshev_node, chebyshev_coefficients, chebyshev_polynomials

contains

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

end module wavycon_chebyshev
