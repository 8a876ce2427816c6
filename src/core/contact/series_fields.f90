!> Pressure and displacement as Fourier series: truncated ones, shown as they are, whose pressure is a little negative
!> between the points at which it is constrained and whose gap is nowhere exactly zero; and those of a contact without
!> an edge, which is full contact or no load. For a load without a solution the fields are NaN.
module wavycon_series_fields
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_status, only: full_contact, no_load
   use wavycon_fourier_series, only: fourier_series
   use wavycon_full_contact, only: full_contact_series, mean_compliance
   use wavycon_kinds, only: dp
   use wavycon_series_samples, only: sample_series
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: series_fields, start_edgeless_fields

   type, extends(contact_fields) :: series_fields
      type(fourier_series) :: pressure       !! p/p*
      type(fourier_series) :: displacement   !! (u - ubar)/Delta, of full contact on a layer u/Delta
      type(surface_type) :: surface
      real(dp) :: mean_gap = 1.0_dp          !! G, less the mean of the displacement
      !> Whether the true pressure and gap are nowhere less than least_pressure and 0: what the series have below is
      !> rounding, or lies between the points of a height map.
      logical, private :: is_edgeless = .false.
      !> Without a bound in full contact below p*, which adhesion holds.
      real(dp), private :: least_pressure = 0.0_dp
   contains
      procedure :: at
      procedure :: on_grid
   end type series_fields

contains

   !> The fields of full contact, of no load, or of a load without a solution.
   subroutine start_edgeless_fields(fields, surface, pbar_over_pstar, status)
      type(series_fields), intent(out) :: fields
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P
      integer, intent(in) :: status             !! full_contact, no_load, or that of a load without a solution

      fields%surface = surface
      fields%is_edgeless = status == full_contact .or. status == no_load
      if (status == full_contact) then
         fields%pressure = full_contact_series(surface, pbar_over_pstar)
         fields%displacement = surface%shape
         ! On a layer the displacement has a mean, which the approach has too.
         fields%mean_gap = -mean_compliance(surface)*pbar_over_pstar
         call fields%displacement%set_mean(-fields%mean_gap)
         ! Only adhesion holds surfaces in full contact below p*: they are under tension at the troughs.
         if (pbar_over_pstar < 1.0_dp) fields%least_pressure = -huge(1.0_dp)
      else
         allocate (fields%pressure%c(0:surface%shape%last(1), 0:surface%shape%last(2)), source=0.0_dp)
         if (.not. fields%is_edgeless) fields%pressure%c = ieee_value(pbar_over_pstar, ieee_quiet_nan)
         fields%displacement = fields%pressure
      end if
   end subroutine start_edgeless_fields

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

   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(series_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      call sample_series(self%pressure, points, offset, pressure, self%surface%parts())
      call sample_series(self%displacement, points, offset, displacement, self%surface%parts())
      call self%surface%sample_shape(points, offset, gap)
      gap = self%mean_gap + displacement - gap
      if (.not. self%is_edgeless) return
      pressure = max(pressure, self%least_pressure)
      gap = max(gap, 0.0_dp)
   end subroutine on_grid

end module wavycon_series_fields
