!> The pressure that belongs to a displacement of the bodies' surface, and the inverse, in the units of a surface; and
!> full contact, where the displacement is the shape.
module wavycon_full_contact
   use wavycon_fourier_series, only: divide_series, fourier_series, weighted
   use wavycon_kinds, only: dp
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: displacement_of, full_contact_energy, full_contact_series, pressure_of

contains

   !> The pressure (p - pbar)/p* that belongs to a displacement (u - ubar)/Delta: Johnson, Greenwood & Higginson (1985),
   !> App. 1.
   type(fourier_series) function pressure_of(surface, displacement) result(pressure)
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: displacement

      pressure = weighted(displacement, surface%length, surface%kernel)
      call divide_series(pressure, 1.0_dp/surface%stiffness)
   end function pressure_of

   !> The displacement (u - ubar)/Delta that a pressure (p - pbar)/p* causes: the inverse of `pressure_of`.
   type(fourier_series) function displacement_of(surface, pressure) result(displacement)
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: pressure

      displacement = weighted(pressure, surface%length, surface%kernel, divides=.true.)
      call divide_series(displacement, surface%stiffness)
   end function displacement_of

   !> The pressure p/p* in full contact, where the displacement is the shape; eq. (22) for the paper's wave.
   type(fourier_series) function full_contact_series(surface, pbar_over_pstar) result(pressure)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 1

      pressure = pressure_of(surface, surface%shape)
      call pressure%set_mean(pbar_over_pstar)
   end function full_contact_series

   !> The elastic energy per nominal area in full contact [p* Delta]: half the mean of p times the shape, as a sum over
   !> waves by Parseval's theorem, (M25a) of src/core/map/README.md.
   real(dp) function full_contact_energy(surface)
      type(surface_type), intent(in) :: surface

      type(roughness_type) :: roughness

      roughness = roughness_of(surface%shape, 1.0_dp, surface%length, surface%points)
      full_contact_energy = 0.5_dp*surface%stiffness*roughness%frequency_moment
   end function full_contact_energy

end module wavycon_full_contact
