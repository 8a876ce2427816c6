!> What a scene asks of the interface: resistivities, friction, work of adhesion. Equations (I..) are those of README.md
!> in this directory.
module wavycon_interface_setting
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: interface_setting, dundurs_beta, shear_factors

   type :: interface_setting
      real(dp) :: resistivity = 0.0_dp   !! rho_1 + rho_2, in the deck's unit; 0: not given
      real(dp) :: friction = 0.0_dp      !! f; 0: not given
      !> Q, the mean tangential traction [p*] or, if `over_mean_pressure`, over the mean pressure.
      real(dp), allocatable :: tangential(:)
      logical :: over_mean_pressure = .false.
      !> kappa, the tangential compliance of a wave over the normal one (I12); its least and its largest value.
      real(dp) :: kappa(3) = 1.0_dp
      real(dp) :: beta = 0.0_dp          !! Dundurs' second parameter, which partial slip neglects
      real(dp) :: work = 0.0_dp          !! of adhesion, w' = w/(p* Delta); 0: not given
   end type interface_setting

contains

   !> kappa for shear across and along the ridges of a wave (I12), and their mean (I13).
   pure function shear_factors(e, nu) result(kappa)
      real(dp), intent(in) :: e(:)    !! Young's moduli of the bodies that are not rigid
      real(dp), intent(in) :: nu(:)   !! their Poisson's ratios
      real(dp) :: kappa(3)

      kappa(1) = 1.0_dp
      kappa(2) = sum((1.0_dp + nu)/e)/sum((1.0_dp - nu**2)/e)
      kappa(3) = 0.5_dp*(kappa(1) + kappa(2))
   end function shear_factors

   !> Dundurs' second parameter (I14) of two bodies; of one and a rigid body.
   pure real(dp) function dundurs_beta(e, nu) result(beta)
      real(dp), intent(in) :: e(:)    !! Young's moduli, shape (1 or 2)
      real(dp), intent(in) :: nu(:)   !! Poisson's ratios

      integer :: i

      beta = sum([((-1)**(i - 1)*(1.0_dp + nu(i))*(1.0_dp - 2*nu(i))/e(i), i=1, size(e))]) &
             /(2*sum((1.0_dp - nu**2)/e))
   end function dundurs_beta

end module wavycon_interface_setting
