!> Westergaard's exact solution for the one-dimensional wave h/Delta = 1 - cos(2 psi), psi = pi x/lambda, Kuznetsov's
!> exact mean gap, and the limits of light and of heavy loads.
!>
!> Equations (4), (5), (7), (8), (11) and (20) of Johnson, Greenwood & Higginson (1985), with p* = pi E* Delta/lambda.
!> The exact ones hold for every mean pressure: a negative one is taken as 0 (no contact), and from pbar = p* on contact
!> is full. All are even in psi and have the period pi. Pressures are in p*, displacements and gaps in Delta,
!> lengths in lambda.
!>
!> N.B. psi is half of the angle phi = 2 pi x/lambda of the Fourier series (12).
module wavycon_westergaard
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: westergaard_pressure_over_pstar, westergaard_peak_pressure_over_pstar
   public :: westergaard_displacement_over_amplitude, westergaard_gap_over_amplitude
   public :: westergaard_contact_area_fraction, kuznetsov_mean_gap_over_amplitude
   public :: hertz_line_contact_area_fraction, line_crack_contact_area_fraction

contains

   !> Contact pressure, equation (4) with (7) inserted; in full contact pbar/p* + cos(2 psi).
   elemental real(dp) function westergaard_pressure_over_pstar(psi, pbar_over_pstar) result(p)
      real(dp), intent(in) :: psi              !! pi x/lambda, from a crest [rad]
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      if (pbar_over_pstar >= 1) then
         p = pbar_over_pstar + cos(2*psi)
      else
         p = 2*abs(cos(psi))*sqrt(max(0.0_dp, pbar_over_pstar - sin(psi)**2))
      end if
   end function westergaard_pressure_over_pstar

   !> Pressure at the crest, the largest: 2 (pbar/p*)^(1/2), in full contact pbar/p* + 1.
   elemental real(dp) function westergaard_peak_pressure_over_pstar(pbar_over_pstar) result(p0)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      p0 = westergaard_pressure_over_pstar(0.0_dp, pbar_over_pstar)
   end function westergaard_peak_pressure_over_pstar

   !> Displacement into the bodies, equations (5a) and (5b), less its mean over the wave; cos(2 psi) in full
   !> contact.
   !>
   !> As that mean is zero the constant of (5) is C = -G, with Kuznetsov's mean gap G, equation (20): in contact
   !> u + h = 1 + C is the approach 1 - G.
   elemental real(dp) function westergaard_displacement_over_amplitude(psi, pbar_over_pstar) result(u)
      real(dp), intent(in) :: psi              !! pi x/lambda, from a crest [rad]
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      u = cos(2*psi) + westergaard_gap_over_amplitude(psi, pbar_over_pstar) &
         - kuznetsov_mean_gap_over_amplitude(pbar_over_pstar)
   end function westergaard_displacement_over_amplitude

   !> Gap under load, u + h less its value in contact: the difference of (5b) and (5a); 0 in contact.
   elemental real(dp) function westergaard_gap_over_amplitude(psi, pbar_over_pstar) result(gap)
      real(dp), intent(in) :: psi              !! pi x/lambda, from a crest [rad]
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: s    !! |sin psi|
      real(dp) :: s_a  !! sin psi_a, at the edge of contact
      real(dp) :: root

      s = abs(sin(psi))
      s_a = sqrt(max(0.0_dp, pbar_over_pstar))
      if (s <= s_a) then
         gap = 0
      else if (s_a > 0) then
         root = sqrt((s - s_a)*(s + s_a))
         ! asinh(root/s_a) is the logarithm of (5b). Next to the edge rounding could make the gap negative.
         gap = max(0.0_dp, 2*(s*root - s_a**2*asinh(root/s_a)))
      else
         gap = 2*s**2
      end if
   end function westergaard_gap_over_amplitude

   !> Fraction of the nominal area in contact, from 0 to 1: 2 a/lambda with the half width a of a strip, equation (7),
   !> a/lambda = asin((pbar/p*)^(1/2))/pi.
   elemental real(dp) function westergaard_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 2*(asin(sqrt(min(1.0_dp, max(0.0_dp, pbar_over_pstar))))/pi)
   end function westergaard_contact_area_fraction

   !> Mean gap G = 1 - P (1 - ln P), P = pbar/p*: equation (20).
   !>
   !> Exact for 0 <= P <= 1; 1 below and 0 above.
   elemental real(dp) function kuznetsov_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      if (pbar_over_pstar <= 0) then
         gap = 1
      else if (pbar_over_pstar >= 1) then
         gap = 0
      else
         ! In this order the difference loses few digits near P = 1, where G is (1 - P)^2/2.
         gap = max(0.0_dp, (1 - pbar_over_pstar) + pbar_over_pstar*log(pbar_over_pstar))
      end if
   end function kuznetsov_mean_gap_over_amplitude

   !> Fraction of the nominal area in contact where each crest is a separate Hertzian line contact, the limit pbar -> 0:
   !> 2 a/lambda with the half width of equation (8), a/lambda = (pbar/p*)^(1/2)/pi. A crest has the curvature 1/R = 4
   !> pi^2 Delta/lambda^2 and bears the load pbar lambda per unit length; its peak pressure 2 pbar lambda/(pi a) is
   !> Westergaard's at any load. The formula's value is returned for any pbar >= 0, also where it does not apply: only
   !> 0.64 at pbar = p*, and 1 at 2.5 p*.
   elemental real(dp) function hertz_line_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 2*(sqrt(max(0.0_dp, pbar_over_pstar))/pi)
   end function hertz_line_contact_area_fraction

   !> Fraction of the nominal area in contact where each open strip is a separate pressurised crack, the limit pbar ->
   !> p*. The crack opens until its stress intensity factor is zero: 1 - 2 b/lambda with its half width, equation (11),
   !> b/lambda = (1 - pbar/p*)^(1/2)/pi; 1 from pbar = p* on.
   !>
   !> Applies near pbar = p*; elsewhere the formula's value is returned: 0.36 at pbar = 0, where 0 is exact.
   elemental real(dp) function line_crack_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 1 - 2*(sqrt(max(0.0_dp, 1 - pbar_over_pstar))/pi)
   end function line_crack_contact_area_fraction

end module wavycon_westergaard
