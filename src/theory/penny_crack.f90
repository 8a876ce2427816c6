!> The two-dimensional wave near full contact: each closed pool is a separate pressurised penny-shaped crack.
!>
!> The limit pbar -> p*: equations (24), (30) and Appendix 2 of Johnson, Greenwood & Higginson (1985), after
!> Sneddon. Pressures are in p* = sqrt(2) pi E* Delta/lambda, openings and gaps in Delta, lengths in lambda.
!> The radius, the contact area and the mean gap apply near pbar = p* and are those of full contact (0, 1,
!> 0) above; below they return their formula's value.
!>
!> The longer asymptotes `near_closure_...` extend (24) and (30) in powers of e = 1 - pbar/p*. They are useful down to
!> pbar = 0.8 p* or so.
!>
!> Derivation, with lengths in s = lambda/sqrt(2) and a trough at r = 0: the pressure that opens the crack is
!> e - pi^2 r^2 + (pi^4/4) r^4 + terms in cos(4 theta), and the volume G of each other crack adds the tension
!> G/(4 pi^2 |n|^3). With y = pi^2 b^2 the stress intensity factor vanishes for 2 y/3 - 2 y^2/15 = e + k G,
!> k = S_3/(4 pi^2), S_3 the lattice's sum of 1/|n|^3.
module wavycon_penny_crack
   use wavycon_constants, only: pi, sqrt2
   use wavycon_kinds, only: dp
   use wavycon_lattice_sums, only: inverse_cube_sum
   implicit none (type, external)
   private

   public :: penny_crack_pressure_over_pstar, penny_crack_opening_over_amplitude
   public :: penny_crack_radius_over_wavelength, penny_crack_contact_area_fraction
   public :: penny_crack_mean_gap_over_amplitude
   public :: near_closure_contact_area_fraction, near_closure_mean_gap_over_amplitude

   !> Tension at one trough for unit mean gap at all the others, k [p*/Delta].
   real(dp), parameter :: interaction = inverse_cube_sum/(4*pi**2)

contains

   !> Pressure that opens the crack, (A4): (1 - pbar/p*) - 2 pi^2 (r/lambda)^2.
   !>
   !> It is the tension that would keep the trough closed, to second order in r/lambda. The formula's value is
   !> returned for any argument.
   elemental real(dp) function penny_crack_pressure_over_pstar(r_over_wavelength, pbar_over_pstar) result(p)
      real(dp), intent(in) :: r_over_wavelength  !! distance from the trough [lambda]
      real(dp), intent(in) :: pbar_over_pstar    !! mean pressure [p*]

      p = (1 - pbar_over_pstar) - 2*(pi*r_over_wavelength)**2
   end function penny_crack_pressure_over_pstar

   !> Opening of a crack of any radius by the pressure (A4): (A6), both faces together; 0 for r >= b.
   !>
   !>     g_n = 2 b A_n/(sqrt(pi) E*) (n/2)!/((n+1)/2)! I_n(r/b),   I_0 = (1 - r^2/b^2)^(1/2),
   !>     I_2 = (I_0 + 2 (r/b)^2 I_0)/3,
   !>
   !> is the opening by the pressure A_n (r/b)^n, (A5).
   !>
   !> With a radius above that of (A7) it is negative near the edge: such a crack would close there.
   elemental real(dp) function penny_crack_opening_over_amplitude(rho, radius_over_wavelength, &
      pbar_over_pstar) result(opening)
      real(dp), intent(in) :: rho                     !! r/b, >= 0
      real(dp), intent(in) :: radius_over_wavelength  !! b [lambda]
      real(dp), intent(in) :: pbar_over_pstar         !! mean pressure [p*]

      real(dp), parameter :: pstar_wavelength_over_modulus_amplitude = sqrt2*pi
      real(dp) :: a_0, a_2, i_0, i_2, scale

      a_0 = 1 - pbar_over_pstar
      a_2 = -2*(pi*radius_over_wavelength)**2
      i_0 = sqrt(max(0.0_dp, (1 - rho)*(1 + rho)))
      i_2 = (i_0 + 2*rho**2*i_0)/3
      scale = pstar_wavelength_over_modulus_amplitude*2*radius_over_wavelength
      opening = scale*a_0/sqrt(pi)/gamma(1.5_dp)*i_0 + scale*a_2/sqrt(pi)/gamma(2.5_dp)*i_2
   end function penny_crack_opening_over_amplitude

   !> Radius of a closed pool, (A7): b/lambda = (3 (1 - pbar/p*))^(1/2)/(2 pi); 0 from pbar = p* on.
   !>
   !> With this radius the faces close smoothly, dg/dr = 0 at r = b.
   elemental real(dp) function penny_crack_radius_over_wavelength(pbar_over_pstar) result(b)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      b = sqrt(3*max(0.0_dp, 1 - pbar_over_pstar))/(2*pi)
   end function penny_crack_radius_over_wavelength

   !> Fraction of the nominal area in contact, equation (24): 1 - 2 pi b^2/lambda^2
   !> = 1 - (3/(2 pi)) (1 - pbar/p*); 1 from pbar = p* on, 0.52 at pbar = 0.
   elemental real(dp) function penny_crack_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 1 - 3/(2*pi)*max(0.0_dp, 1 - pbar_over_pstar)
   end function penny_crack_contact_area_fraction

   !> Mean gap, equation (30) = (A9): (16/(15 pi^2)) (3/2)^(3/2) (1 - pbar/p*)^(5/2); 0 from pbar = p* on,
   !> 0.20 at pbar = 0.
   elemental real(dp) function penny_crack_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      gap = 16/(15*pi**2)*1.5_dp**1.5_dp*max(0.0_dp, 1 - pbar_over_pstar)**2.5_dp
   end function penny_crack_mean_gap_over_amplitude

   !> Fraction of the nominal area in contact, 1 - (3/(2 pi)) [e + 0.3 e^2 + k G_30], with (30) for
   !> G_30, which goes as e^(5/2). The error is O(e^3).
   elemental real(dp) function near_closure_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: e

      e = max(0.0_dp, 1 - pbar_over_pstar)
      fraction = 1 - 3/(2*pi) &
         *(e + 0.3_dp*e**2 + interaction*penny_crack_mean_gap_over_amplitude(pbar_over_pstar))
   end function near_closure_contact_area_fraction

   !> Mean gap, (30) times 1 + (9/28) e + (5/2) k G_30/e; the error is O(e^2) of it.
   elemental real(dp) function near_closure_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: e, g_30

      e = max(0.0_dp, 1 - pbar_over_pstar)
      g_30 = penny_crack_mean_gap_over_amplitude(pbar_over_pstar)
      gap = 0
      if (e > 0) gap = g_30*(1 + 9*e/28 + 2.5_dp*interaction*g_30/e)
   end function near_closure_mean_gap_over_amplitude

end module wavycon_penny_crack
