!> Pressure and displacement as truncated Fourier series, shown as they are: the pressure is a little negative between
!> the points at which it is constrained, and the gap is nowhere exactly zero.
module wavycon_series_fields
   use wavycon_contact_fields, only: contact_fields
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_series_samples, only: sample_series
   implicit none (type, external)
   private

   public :: series_fields

   type, extends(contact_fields) :: series_fields
      type(fourier_series) :: pressure       !! p/p*
      type(fourier_series) :: displacement   !! (u - ubar)/Delta
      type(fourier_series) :: shape          !! of the surface: 1 - h/Delta
      real(dp) :: mean_gap = 1.0_dp          !! G
   contains
      procedure :: at
      procedure :: on_grid
   end type series_fields

contains

   subroutine at(self, x, y, pressure, displacement, gap)
      class(series_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      pressure = self%pressure%at(x, y)
      displacement = self%displacement%at(x, y)
      gap = self%mean_gap + displacement - self%shape%at(x, y)
   end subroutine at

   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(series_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      call sample_series(self%pressure, points, offset, pressure)
      call sample_series(self%displacement, points, offset, displacement)
      call sample_series(self%shape, points, offset, gap)
      gap = self%mean_gap + displacement - gap
   end subroutine on_grid

end module wavycon_series_fields
