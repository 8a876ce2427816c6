!> The fields of a contact without an edge: full contact or no load. For a load without a solution they are NaN.
module wavycon_edgeless_fields
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_status, only: full_contact, no_load
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_series_samples, only: sample_series
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: edgeless_fields, start_edgeless_fields

   type, extends(contact_fields) :: edgeless_fields
      private
      type(fourier_series) :: pressure     !! p/p* in full contact
      type(surface_type) :: surface
      logical :: full = .false.            !! whether the contact is full
      logical :: solved = .false.          !! whether there is a solution
   contains
      procedure :: at
      procedure :: on_grid
   end type edgeless_fields

contains

   subroutine start_edgeless_fields(fields, surface, pbar_over_pstar, status)
      type(edgeless_fields), intent(out) :: fields
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P
      integer, intent(in) :: status             !! full_contact, no_load, or that of a load without a solution

      fields%full = status == full_contact
      fields%solved = fields%full .or. status == no_load
      fields%surface = surface
      if (fields%full) fields%pressure = surface%full_contact_series(pbar_over_pstar)
   end subroutine start_edgeless_fields

   subroutine at(self, x, y, pressure, displacement, gap)
      class(edgeless_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      real(dp) :: full_pressure

      full_pressure = 0.0_dp
      if (self%full) full_pressure = self%pressure%at(x, y)
      call take_values(self, self%surface%shape_at(x, y), full_pressure, pressure, displacement, gap)
   end subroutine at

   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(edgeless_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      real(dp), allocatable :: full_pressure(:, :), shape(:, :)

      allocate (pressure(points(1), points(2)), displacement(points(1), points(2)), gap(points(1), points(2)))
      call self%surface%sample_shape(points, offset, shape)
      if (self%full) then
         call sample_series(self%pressure, points, offset, full_pressure, self%surface%parts())
      else
         allocate (full_pressure(points(1), points(2)), source=0.0_dp)
      end if
      call take_values(self, shape, full_pressure, pressure, displacement, gap)
   end subroutine on_grid

   !> The fields from the values of the two series. Series are rounded, and that of a height map's pressure may be a
   !> little negative between its points.
   elemental subroutine take_values(fields, shape, full_pressure, pressure, displacement, gap)
      type(edgeless_fields), intent(in) :: fields
      real(dp), intent(in) :: shape, full_pressure
      real(dp), intent(out) :: pressure, displacement, gap

      pressure = 0.0_dp
      displacement = 0.0_dp
      gap = 0.0_dp
      if (fields%full) then
         pressure = max(full_pressure, 0.0_dp)
         displacement = shape
      else if (fields%solved) then
         gap = max(1.0_dp - shape, 0.0_dp)
      else
         pressure = ieee_value(pressure, ieee_quiet_nan)
         displacement = pressure
         gap = pressure
      end if
   end subroutine take_values

end module wavycon_edgeless_fields
