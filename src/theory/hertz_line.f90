!> The one-dimensional wave at light load: each crest is a separate Hertzian line contact.
!>
!> The limit pbar -> 0 of Westergaard's solution, equation (8) of Johnson, Greenwood & Higginson (1985). A
!> crest has the curvature 1/R = 4 pi^2 Delta/lambda^2 and bears the load pbar lambda per unit length. Every
!> function returns its formula's value for any pbar >= 0, also where it does not apply; a negative pbar counts as 0.
!> Pressures are in p* = pi E* Delta/lambda, lengths in lambda.
module wavycon_hertz_line
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: hertz_line_half_width_over_wavelength, hertz_line_contact_area_fraction
   public :: hertz_line_peak_pressure_over_pstar

contains

   !> Half width of a contact strip, equation (8): a/lambda = (pbar/p*)^(1/2)/pi.
   elemental real(dp) function hertz_line_half_width_over_wavelength(pbar_over_pstar) result(a)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      a = sqrt(max(0.0_dp, pbar_over_pstar))/pi
   end function hertz_line_half_width_over_wavelength

   !> Fraction of the nominal area in contact, 2 a/lambda: only 0.64 at pbar = p*, and 1 at 2.5 p*.
   elemental real(dp) function hertz_line_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 2*hertz_line_half_width_over_wavelength(pbar_over_pstar)
   end function hertz_line_contact_area_fraction

   !> Pressure at the crest, p0 = 2 pbar lambda/(pi a) = 2 (pbar p*)^(1/2), which is Westergaard's at any load.
   elemental real(dp) function hertz_line_peak_pressure_over_pstar(pbar_over_pstar) result(p0)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      p0 = 2*sqrt(max(0.0_dp, pbar_over_pstar))
   end function hertz_line_peak_pressure_over_pstar

end module wavycon_hertz_line
