!> Asymptotes of the two-dimensional wave: light loads, pbar -> 0, and near full contact, pbar -> p*. Pressures are in
!> p* = sqrt(2) pi E* Delta/lambda, displacements, openings and gaps in Delta, lengths in lambda.
!>
!> **Light loads.** Each crest is a separate Hertzian point contact. A crest has the curvature 1/R = 4 pi^2
!> Delta/lambda^2 and bears pbar lambda^2/2, the load on a square of side lambda/sqrt(2).
!> `hertz_point_contact_area_fraction` is equation (23) of Johnson, Greenwood & Higginson (1985),
!> `light_load_mean_gap_one_square` is equation (29). N.B. The other mean gaps, and the area with more terms, are not in
!> the paper: they correct and extend it. Every function returns its formula's value for any P = pbar/p* >= 0, but none
!> is useful above P = 0.2 or so, and values near P = 1 are meaningless; a negative P counts as 0. The gap is negative
!> above P = 0.24 by (29), above P = 0.34 with the lattice's coefficient.
!>
!> Derivation of the longer asymptotes, with lengths in s = lambda/sqrt(2), a crest at r = 0 and its load P: about the
!> crest h/Delta = pi^2 r^2 - (pi^4/4) r^4 + terms in cos(4 theta). The other crests displace it by P (S_1 + (S_3/4) r^2
!> + ...), S_1 and S_3 the lattice's sums of 1/|n| and 1/|n|^3. A rigid axisymmetric punch of that shape, with that
!> curvature added, gives load and approach as polynomials in the radius.
!>
!> **Near full contact.** Each closed pool is a separate pressurised penny-shaped crack: equations (24), (30) and
!> Appendix 2, after Sneddon. The radius, the contact area and the mean gap apply near pbar = p* and are those of full
!> contact (0, 1, 0) above; below they return their formula's value. N.B. The longer asymptotes `near_closure_...` are
!> not in the paper: they extend (24) and (30) in powers of e = 1 - pbar/p*. They are useful down to pbar = 0.8 p* or
!> so.
!>
!> Derivation, with lengths in s and a trough at r = 0: the pressure that opens the crack is e - pi^2 r^2 + (pi^4/4) r^4
!> + terms in cos(4 theta), and the volume G of each other crack adds the tension G/(4 pi^2 |n|^3). With y = pi^2 b^2
!> the stress intensity factor vanishes for 2 y/3 - 2 y^2/15 = e + k G, k = S_3/(4 pi^2).
module wavycon_wave_2d_limits
   use wavycon_kinds, only: dp, pi, sqrt2
   implicit none (type, external)
   private

   public :: hertz_point_radius_over_wavelength, hertz_point_contact_area_fraction
   public :: hertz_point_peak_pressure_over_pstar, hertz_point_pressure_over_pstar
   public :: light_load_mean_gap_one_square, light_load_mean_gap_lattice, light_load_mean_gap_longer
   public :: light_load_contact_area_longer
   public :: penny_crack_pressure_over_pstar, penny_crack_opening_over_amplitude
   public :: penny_crack_radius_over_wavelength, penny_crack_contact_area_fraction
   public :: penny_crack_mean_gap_over_amplitude
   public :: near_closure_contact_area_fraction, near_closure_mean_gap_over_amplitude

   !> The effect of all other crests, or troughs, on one of them: sums over their square lattice of side s, lengths in
   !> s, the origin left out. In closed form the sum of |n|^(-2 q) over the lattice is 4 zeta(q) beta(q), with
   !> Dirichlet's beta function beta(q) = 1 - 3^(-q) + 5^(-q) - ...
   !>
   !> S_1, the sum of 1/|n| less its mean, 4 zeta(1/2) beta(1/2): the displacement of one crest by unit loads on all
   !> others and by the uniform tension that balances all loads.
   real(dp), parameter, public :: inverse_distance_sum = -3.900264920001956_dp

   !> S_3, the sum of 1/|n|^3, 4 zeta(3/2) beta(3/2).
   real(dp), parameter, public :: inverse_cube_sum = 9.033621683100950_dp

   !> Tension at one trough for unit mean gap at all the others, k [p*/Delta].
   real(dp), parameter :: interaction = inverse_cube_sum/(4*pi**2)

contains

   !> Radius of a contact spot: a/lambda = (3 P/(8 pi))^(1/3)/sqrt(2), P = pbar/p*.
   !>
   !> From a^3 = 3 W R/(4 E*) with the load W = pbar lambda^2/2.
   elemental real(dp) function hertz_point_radius_over_wavelength(pbar_over_pstar) result(a)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      a = (3*max(0.0_dp, pbar_over_pstar)/(8*pi))**(1.0_dp/3)/sqrt2
   end function hertz_point_radius_over_wavelength

   !> Fraction of the nominal area in contact, equation (23): 2 pi a^2/lambda^2 = pi (3 P/(8 pi))^(2/3).
   !>
   !> It is 0.76 at pbar = p*, where 1 is exact, and grows further above.
   elemental real(dp) function hertz_point_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 2*pi*hertz_point_radius_over_wavelength(pbar_over_pstar)**2
   end function hertz_point_contact_area_fraction

   !> Pressure at the crest, 3 W/(2 pi a^2): p0/p* = 4 (3 P/(8 pi))^(1/3) = 4 sqrt(2) a/lambda.
   elemental real(dp) function hertz_point_peak_pressure_over_pstar(pbar_over_pstar) result(p0)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      p0 = 4*sqrt2*hertz_point_radius_over_wavelength(pbar_over_pstar)
   end function hertz_point_peak_pressure_over_pstar

   !> Pressure about one crest, p0 (1 - r^2/a^2)^(1/2), and 0 outside of r < a.
   elemental real(dp) function hertz_point_pressure_over_pstar(r_over_wavelength, pbar_over_pstar) result(p)
      real(dp), intent(in) :: r_over_wavelength  !! distance from the crest [lambda]
      real(dp), intent(in) :: pbar_over_pstar    !! mean pressure [p*]

      real(dp) :: a

      a = hertz_point_radius_over_wavelength(pbar_over_pstar)
      ! p0/a = 4 sqrt(2): written so there is no division by the load.
      p = 4*sqrt2*sqrt(max(0.0_dp, (a - r_over_wavelength)*(a + r_over_wavelength)))
   end function hertz_point_pressure_over_pstar

   !> Mean gap G = 1 - (1/2) (3 pi^2 P)^(2/3) + 4 ln(sqrt(2) + 1) P, equation (29).
   !>
   !> N.B. The last term is the effect of the mean pressure on the one square of side lambda/sqrt(2) about the crest.
   !> The other squares are left out, which makes it 10 % too small.
   elemental real(dp) function light_load_mean_gap_one_square(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      gap = hertz_gap(pbar_over_pstar) + 4*log(sqrt2 + 1)*max(0.0_dp, pbar_over_pstar)
   end function light_load_mean_gap_one_square

   !> Mean gap (29) with the mean pressure on all squares and the loads on all crests: the coefficient of P is
   !> -4 zeta(1/2) beta(1/2) = 3.9003 in place of 3.5255. The error is O(P^(4/3)).
   elemental real(dp) function light_load_mean_gap_lattice(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      gap = hertz_gap(pbar_over_pstar) - inverse_distance_sum*max(0.0_dp, pbar_over_pstar)
   end function light_load_mean_gap_lattice

   !> Mean gap with two more terms,
   !>
   !>     + (3 pi^2 P)^(4/3)/120 - (4/15) S_3 (3/(8 pi))^(2/3) P^(5/3);   the error is O(P^2).
   !>
   !> The first is due to the wave's deviation from a paraboloid, the second to the curvature that the other crests
   !> add.
   elemental real(dp) function light_load_mean_gap_longer(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: p

      p = max(0.0_dp, pbar_over_pstar)
      gap = light_load_mean_gap_lattice(p) + (3*pi**2*p)**(4.0_dp/3)/120 &
         - 4*inverse_cube_sum/15*(3/(8*pi))**(2.0_dp/3)*p**(5.0_dp/3)
   end function light_load_mean_gap_longer

   !> Fraction of the nominal area in contact: (23) times
   !>
   !>     1 + (3 pi^2 P)^(2/3)/15 - S_3 P/(6 pi^2);   the error is O(P^2).
   elemental real(dp) function light_load_contact_area_longer(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: p

      p = max(0.0_dp, pbar_over_pstar)
      fraction = hertz_point_contact_area_fraction(p) &
         *(1 + (3*pi**2*p)**(2.0_dp/3)/15 - inverse_cube_sum*p/(6*pi**2))
   end function light_load_contact_area_longer

   !> Mean gap without interaction of the crests, 1 - a^2/(R Delta).
   elemental real(dp) function hertz_gap(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      gap = 1 - (3*pi**2*max(0.0_dp, pbar_over_pstar))**(2.0_dp/3)/2
   end function hertz_gap

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
      real(dp) :: a_0, a_2, i_0, i_2, factor

      a_0 = 1 - pbar_over_pstar
      a_2 = -2*(pi*radius_over_wavelength)**2
      i_0 = sqrt(max(0.0_dp, (1 - rho)*(1 + rho)))
      i_2 = (i_0 + 2*rho**2*i_0)/3
      factor = pstar_wavelength_over_modulus_amplitude*2*radius_over_wavelength
      opening = factor*a_0/sqrt(pi)/gamma(1.5_dp)*i_0 + factor*a_2/sqrt(pi)/gamma(2.5_dp)*i_2
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

end module wavycon_wave_2d_limits
