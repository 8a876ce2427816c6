!> Quadrature over the disc for functions with the symmetry of a contact, by points in one half sector.
module wavycon_disc_rule
   use wavycon_constants, only: pi
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: disc_rule, start_disc_rule

   !> The sum of weight f(point) is the integral over the disc of (1 - |w|^2)^power f, for f with the symmetry.
   type :: disc_rule
      complex(dp), allocatable :: point(:)   !! in the sector 0 < arg w < pi/fold, shape (n)
      real(dp), allocatable :: weight(:)     !! > 0, shape (n)
   end type disc_rule

contains

   !> Gauss's rule in |w|^2, the midpoint rule in the angle: exact for products of disc polynomials whose degrees sum
   !> to no more than 4 radii - 2 and to less than 2 fold angles.
   subroutine start_disc_rule(rule, power, fold, radii, angles)
      type(disc_rule), intent(out) :: rule
      real(dp), intent(in) :: power   !! of the weight, > -1
      integer, intent(in) :: fold     !! of the symmetry, >= 1
      integer, intent(in) :: radii    !! >= 1
      integer, intent(in) :: angles   !! in the half sector, >= 1

      real(dp) :: node(radii), weight(radii), phi
      integer :: i, j, k

      allocate (rule%point(radii*angles), rule%weight(radii*angles))
      call gauss_jacobi(power, 0.0_dp, node, weight)
      k = 0
      do j = 1, angles
         phi = pi*(j - 0.5_dp)/(fold*angles)
         do i = 1, radii
            k = k + 1
            rule%point(k) = sqrt(0.5_dp*(1.0_dp + node(i)))*cmplx(cos(phi), sin(phi), dp)
            ! rho d rho = d(rho^2)/2, and the weight of GSL is for an interval of length 2.
            rule%weight(k) = pi/angles*weight(i)*0.5_dp**(power + 1)
         end do
      end do
   end subroutine start_disc_rule

end module wavycon_disc_rule
