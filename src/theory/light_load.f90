!> Asymptotes of the two-dimensional wave for pbar -> 0, where each crest is a separate Hertzian point contact.
!>
!> A crest has the curvature 1/R = 4 pi^2 Delta/lambda^2 and bears pbar lambda^2/2, the load on a square of side
!> lambda/sqrt(2). `hertz_point_contact_area_fraction` is equation (23) of Johnson, Greenwood & Higginson (1985),
!> `light_load_mean_gap_one_square` is equation (29); the others correct and extend them. Every function returns its
!> formula's value for any P = pbar/p* >= 0, but none is useful above P = 0.2 or so, and values near P = 1 are
!> meaningless; a negative P counts as 0. The gap is negative above P = 0.24 by (29), above P = 0.34 with the lattice's
!> coefficient. p* = sqrt(2) pi E* Delta/lambda, gaps are in Delta, lengths in lambda.
!>
!> Derivation of the longer asymptotes, with lengths in s = lambda/sqrt(2), a crest at r = 0 and its load P: about the
!> crest h/Delta = pi^2 r^2 - (pi^4/4) r^4 + terms in cos(4 theta). The other crests displace it by P (S_1 + (S_3/4) r^2
!> + ...), S_1 and S_3 the lattice's sums of 1/|n| and 1/|n|^3. A rigid axisymmetric punch of that shape, with that
!> curvature added, gives load and approach as polynomials in the radius.
module wavycon_light_load
   use wavycon_constants, only: pi, sqrt2
   use wavycon_kinds, only: dp
   use wavycon_lattice_sums, only: inverse_cube_sum, inverse_distance_sum
   implicit none (type, external)
   private

   public :: hertz_point_radius_over_wavelength, hertz_point_contact_area_fraction
   public :: hertz_point_peak_pressure_over_pstar, hertz_point_pressure_over_pstar
   public :: light_load_mean_gap_one_square, light_load_mean_gap_lattice, light_load_mean_gap_longer
   public :: light_load_contact_area_longer

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

end module wavycon_light_load
