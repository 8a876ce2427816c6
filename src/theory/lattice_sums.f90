!> Sums over the square lattice: the effect of all other crests, or troughs, on one of them.
!>
!> The crests of h/Delta = 1 - cos(2 pi x/lambda) cos(2 pi y/lambda) form a square lattice of side
!> s = lambda/sqrt(2); lengths are in s, the origin is left out. In closed form the sum of |n|^(-2 q) over the
!> lattice is 4 zeta(q) beta(q), with Dirichlet's beta function beta(q) = 1 - 3^(-q) + 5^(-q) - ...
module wavycon_lattice_sums
   use wavycon_constants, only: pi
   use wavycon_gsl, only: gsl_sf_hzeta, gsl_sf_zeta
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: inverse_distance_sum, inverse_cube_sum

   integer :: m, n  ! of the implied loops in the constant

   !> Sum of 1/|n| less its mean, 4 zeta(1/2) beta(1/2) = -3.900264920001956: the displacement of one crest
   !> by unit loads on all others and by the uniform tension that balances all loads.
   !>
   !> An Ewald sum, as the plain sum diverges. With the width sqrt(pi) the sums over the lattice and over its
   !> reciprocal are equal, and both are truncated at 4 sides, where erfc is below 1e-22. The lattice consists of
   !> four quadrants m >= 1, n >= 0.
   real(dp), parameter :: inverse_distance_sum = &
      2*4*sum([((erfc(sqrt(pi*(m**2 + n**2)))/sqrt(real(m**2 + n**2, dp)), m=1, 4), n=0, 4)]) - 4

contains

   !> Sum of 1/|n|^3, 4 zeta(3/2) beta(3/2) = 9.033621683100950.
   pure real(dp) function inverse_cube_sum()
      real(dp), parameter :: q = 1.5_dp

      real(dp) :: beta

      beta = (gsl_sf_hzeta(q, 0.25_dp) - gsl_sf_hzeta(q, 0.75_dp))/4**q
      inverse_cube_sum = 4*gsl_sf_zeta(q)*beta
   end function inverse_cube_sum

end module wavycon_lattice_sums
