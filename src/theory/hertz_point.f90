!> The two-dimensional wave at light load: each crest is a separate Hertzian point contact.
!>
!> The limit pbar -> 0, equation (23) of Johnson, Greenwood & Higginson (1985). A crest has the curvature
!> 1/R = 4 pi^2 Delta/lambda^2 and bears pbar lambda^2/2, the load on a square of side lambda/sqrt(2). Every
!> function returns its formula's value for any pbar >= 0, also where it does not apply; a negative pbar
!> counts as 0. Pressures are in p* = sqrt(2) pi E* Delta/lambda, lengths in lambda.
module wavycon_hertz_point
   use wavycon_constants, only: pi, sqrt2
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: hertz_point_radius_over_wavelength, hertz_point_contact_area_fraction
   public :: hertz_point_peak_pressure_over_pstar, hertz_point_pressure_over_pstar

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

end module wavycon_hertz_point
