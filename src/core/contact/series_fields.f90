!> Fields whose pressure and displacement are Fourier series. There are two cases. The truncated series of
!> `series_contact` are shown as they are: between the constraint points the pressure is a little negative, and the gap
!> is nowhere exactly zero. The series of full contact and of no load are exact, and there is no edge of contact. For a
!> load without a solution the fields are NaN.
module wavycon_series_fields
   use wavycon_contact_fields, only: contact_fields
   use wavycon_fourier_series, only: fourier_series
   use wavycon_full_contact, only: full_contact_series, mean_compliance
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_series_samples, only: sample_series
   use wavycon_solution_record, only: full_contact, no_load
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: series_fields, start_edgeless_fields

   type, extends(contact_fields) :: series_fields
      type(fourier_series) :: pressure       !! p/p*
      type(fourier_series) :: displacement   !! (u - ubar)/Delta, of full contact on a layer u/Delta
      type(surface_type) :: surface
      real(dp) :: mean_gap = 1.0_dp          !! G, less the mean of the displacement [Delta]
      !> Whether the series are those of full contact or no load. Then pressures below least_pressure and gaps below 0
      !> are due to rounding, or lie between the points of a height map, and are set to these limits.
      logical, private :: is_edgeless = .false.
      !> The least pressure [p*]; -huge if adhesion holds the surfaces in full contact below P = 1.
      real(dp), private :: least_pressure = 0.0_dp
   contains
      procedure :: at, on_grid
   end type series_fields

contains

   !> Sets the fields of full contact, of no load, or of a load without a solution.
   subroutine start_edgeless_fields(fields, surface, pbar_over_pstar, status)
      type(series_fields), intent(out) :: fields
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P
      integer, intent(in) :: status             !! full_contact or no_load; all others: a load without a solution

      fields%surface = surface
      fields%is_edgeless = status == full_contact .or. status == no_load
      if (status == full_contact) then
         fields%pressure = full_contact_series(surface, pbar_over_pstar)
         fields%displacement = surface%shape
         ! On a layer the displacement has a mean, which the approach has too.
         fields%mean_gap = -mean_compliance(surface)*pbar_over_pstar
         call fields%displacement%set_mean(-fields%mean_gap)
         ! Below P = 1 only adhesion holds surfaces in full contact: at the troughs the pressure is a tension.
         if (pbar_over_pstar < 1.0_dp) fields%least_pressure = -huge(1.0_dp)
      else
         allocate (fields%pressure%c(0:surface%shape%last(1), 0:surface%shape%last(2)), source=0.0_dp)
         if (.not. fields%is_edgeless) fields%pressure%c = not_a_number()
         fields%displacement = fields%pressure
      end if
   end subroutine start_edgeless_fields

   !> The fields at one point, as sums of the series.
   subroutine at(self, x, y, pressure, displacement, gap)
      class(series_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      pressure = self%pressure%at(x, y)
      displacement = self%displacement%at(x, y)
      gap = self%mean_gap + displacement - self%surface%shape_at(x, y)
      if (.not. self%is_edgeless) return
      pressure = max(pressure, self%least_pressure)
      gap = max(gap, 0.0_dp)
   end subroutine at

   !> The fields on a grid of the cell, by fast Fourier transforms.
   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(series_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      call sample_series(self%pressure, points, offset, pressure, self%surface%maps_in_cell())
      call sample_series(self%displacement, points, offset, displacement, self%surface%maps_in_cell())
      call self%surface%sample_shape(points, offset, gap)
      gap = self%mean_gap + displacement - gap
      if (.not. self%is_edgeless) return
      pressure = max(pressure, self%least_pressure)
      gap = max(gap, 0.0_dp)
   end subroutine on_grid

end module wavycon_series_fields
