!> Sums over the square lattice: the effect of all other crests, or troughs, on one of them.
!>
!> The crests of h/Delta = 1 - cos(2 pi x/lambda) cos(2 pi y/lambda) form a square lattice of side
!> s = lambda/sqrt(2); lengths are in s, the origin is left out. In closed form the sum of |n|^(-2 q) over the
!> lattice is 4 zeta(q) beta(q), with Dirichlet's beta function beta(q) = 1 - 3^(-q) + 5^(-q) - ...
module wavycon_lattice_sums
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   !> Sum of 1/|n| less its mean, 4 zeta(1/2) beta(1/2): the displacement of one crest by unit loads on all others and
   !> by the uniform tension that balances all loads.
   real(dp), parameter, public :: inverse_distance_sum = -3.900264920001956_dp

   !> Sum of 1/|n|^3, 4 zeta(3/2) beta(3/2).
   real(dp), parameter, public :: inverse_cube_sum = 9.033621683100950_dp
end module wavycon_lattice_sums
