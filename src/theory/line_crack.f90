!> The one-dimensional wave near full contact: each open strip is a separate pressurised crack.
!>
!> The limit pbar -> p* of Westergaard's solution, equation (11) of Johnson, Greenwood & Higginson
!> (1985). The interface has no strength, so the crack opens until its stress intensity factor is zero.
!> Pressures are in p* = pi E* Delta/lambda, lengths in lambda.
module wavycon_line_crack
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: line_crack_contact_area_fraction

contains

   !> Fraction of the nominal area in contact, 1 - 2 b/lambda with the half width of an open strip, equation (11):
   !> b/lambda = (1 - pbar/p*)^(1/2)/pi; 1 from pbar = p* on.
   !>
   !> Applies near pbar = p*; elsewhere the formula's value is returned: 0.36 at pbar = 0, where 0 is exact.
   elemental real(dp) function line_crack_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 1 - 2*(sqrt(max(0.0_dp, 1 - pbar_over_pstar))/pi)
   end function line_crack_contact_area_fraction

end module wavycon_line_crack
