!> The linear law of light loads on rough surfaces, A/A0 = kappa pbar/(E* h'), h' the root mean square slope.
module wavycon_linear_area
   use wavycon_contact_measures, only: unknown
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: linear_area_fraction

   !> kappa. Theories give (8/pi)^(1/2) = 1.60, B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840-3861, and (2 pi)^(1/2)
   !> = 2.51, A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87-111. Computed contacts of self-affine surfaces
   !> lie between them, S. Hyun, L. Pei, J.-F. Molinari, M. O. Robbins, Phys. Rev. E 70 (2004) 026117; 2 is the value
   !> that results are compared with.
   real(dp), parameter :: area_coefficient = 2.0_dp

contains

   !> The fraction of the nominal area in contact by the linear law, for comparison with those that are computed. It is
   !> a straight line at all loads, and exceeds 1 at heavy ones. Unknown for surfaces that are no height maps: the law
   !> is one of random surfaces.
   pure real(dp) function linear_area_fraction(surface, rms_slope, pbar_over_pstar) result(fraction)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: rms_slope         !! of the surface; an argument because it takes a sum over all waves
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 0

      fraction = unknown
      if (surface%dimension == 1 .or. .not. surface%is_height_map() .or. .not. surface%amplitude > 0.0_dp) return
      if (surface%has_free_edges) return
      fraction = area_coefficient*pbar_over_pstar*surface%full_contact_pressure(e_star=1.0_dp)/rms_slope
   end function linear_area_fraction

end module wavycon_linear_area
