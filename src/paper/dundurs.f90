!> The Fourier series of Dundurs, Tsai & Keer for the pressure of the one-dimensional wave, truncated after n terms.
!>
!> J. Dundurs, K. C. Tsai & L. M. Keer, J. Elasticity 3 (1973) 109-115. The coefficients are the exact Fourier
!> coefficients of Westergaard's pressure (4). The truncation leaves small negative pressures, which Johnson,
!> Greenwood & Higginson (1985) show in Fig. 2. Pressures are in p*, p* = pi E* Delta/lambda.
module wavycon_dundurs
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_gsl, only: gsl_sf_legendre_pl_array
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: dundurs_coefficients, dundurs_pressure_over_pstar

contains

   !> Coefficients A_1 .. A_n of (p - pbar)/p* = sum of A_i cos(i phi), equation (12).
   !>
   !>     A_i = (1/2) integral of P_i + P_{i-1} from c to 1,   c = 1 - 2 pbar/p*,
   !>
   !> with the Legendre polynomials P_l. A mean pressure outside of 0..p* is replaced by the nearer end: all
   !> coefficients are zero without load; A_1 = 1 and the others are 0 in full contact.
   function dundurs_coefficients(pbar_over_pstar, n) result(a)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]
      integer, intent(in) :: n                 !! number of terms, >= 0
      real(dp) :: a(n)                         !! [p*]

      real(dp) :: c, legendre(0:n + 1)
      real(dp) :: integral(0:n)  !! of P_l from c to 1
      integer(c_int) :: ignored
      integer :: l

      c = 1 - 2*min(1.0_dp, max(0.0_dp, pbar_over_pstar))
      ! The status can be ignored: it is 0 for all -1 <= c <= 1.
      ignored = gsl_sf_legendre_pl_array(int(n + 1, c_int), c, legendre)
      integral = [1 - c, ((legendre(l - 1) - legendre(l + 1))/(2*l + 1), l=1, n)]
      a = (integral(1:n) + integral(0:n - 1))/2
   end function dundurs_coefficients

   !> Pressure of the series (12): pbar/p* + sum of A_i cos(i phi); it may be negative.
   !>
   !> N.B. phi = 2 pi x/lambda is twice the angle psi of Westergaard's solution.
   pure real(dp) function dundurs_pressure_over_pstar(phi, pbar_over_pstar, coefficients) result(p)
      real(dp), intent(in) :: phi              !! 2 pi x/lambda, from a crest [rad]
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]
      real(dp), intent(in) :: coefficients(:)  !! A_1 .. A_n, of `dundurs_coefficients` [p*]

      integer :: i

      p = pbar_over_pstar
      do i = 1, size(coefficients)
         p = p + coefficients(i)*cos(i*phi)
      end do
   end function dundurs_pressure_over_pstar

end module wavycon_dundurs
