!> The pressure that belongs to a displacement of the bodies' surface, and the inverse, in the units of a surface; and
!> full contact, where the displacement is the shape.
module wavycon_full_contact
   use wavycon_fourier_series, only: divide_series, fourier_series, weighted
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_series_peak, only: find_peak
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: displacement_of, full_contact_energy, full_contact_series, mean_compliance, pressure_of, set_closure

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

      roughness = roughness_of(surface%shape, 1.0_dp, surface%length, surface%points, surface%kernel)
      full_contact_energy = 0.5_dp*surface%stiffness*roughness%frequency_moment
   end function full_contact_energy

   !> Sets what closes a surface: its stiffness, so that p* is its largest tension in full contact, and its largest
   !> pressure there. Of a map they are those at its points.
   subroutine set_closure(surface)
      type(surface_type), intent(inout) :: surface   !! periodic or mirrored, not flat, with its shape and kernel

      type(fourier_series) :: pressure
      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: largest(2), unused(2)   ! of pressure and tension

      pressure = weighted(surface%shape, surface%length, surface%kernel)
      if (surface%is_height_map()) then
         call transform%start(surface%points/surface%maps_in_cell(), even=surface%mirrored)
         allocate (values(transform%points(1), transform%slab%columns()))
         call transform%sample(pressure, values)
         largest = transform%slab%extremes(values)
      else
         call find_peak(pressure, largest(1), unused)
         call divide_series(pressure, -1.0_dp)
         call find_peak(pressure, largest(2), unused)
      end if
      surface%stiffness = 1.0_dp/largest(2)
      surface%full_contact_peak = largest(1)/largest(2)
   end subroutine set_closure

   !> How much the mean pressure p* compresses the layer under a surface [Delta]; 0 without one.
   pure real(dp) function mean_compliance(surface)
      type(surface_type), intent(in) :: surface

      mean_compliance = surface%kernel%layer%mean_compliance()/surface%stiffness
   end function mean_compliance

end module wavycon_full_contact
