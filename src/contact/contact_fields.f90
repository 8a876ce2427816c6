!> The pressure and the displacement of one solution, at points and on the grid of a cell.
module wavycon_contact_fields
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_fields, series_fields

   type, abstract :: contact_fields
   contains
      procedure(fields_at_point), deferred :: at
      procedure(fields_on_cell), deferred :: on_cell
   end type contact_fields

   abstract interface
      !> At one point.
      subroutine fields_at_point(self, x, y, pressure, displacement)
         import :: contact_fields, dp
         class(contact_fields), intent(inout) :: self
         real(dp), intent(in) :: x, y                       !! X, Y of the surface's cell [rad]
         real(dp), intent(out) :: pressure, displacement    !! p/p*, (u - ubar)/Delta
      end subroutine fields_at_point

      !> At X = 2 pi k/N, Y = 2 pi l/N, k, l = 0..N (l = 0 alone in 1-D).
      subroutine fields_on_cell(self, intervals, dimension, pressure, displacement)
         import :: contact_fields, dp
         class(contact_fields), intent(inout) :: self
         integer, intent(in) :: intervals, dimension   !! N; 1 or 2
         !> p/p* and (u - ubar)/Delta, shape (0:N, 0:N) in 2-D, (0:N, 0:0) in 1-D.
         real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :)
      end subroutine fields_on_cell
   end interface

   !> Pressure and displacement as Fourier series in X and Y.
   type, extends(contact_fields) :: series_fields
      type(fourier_series) :: pressure, displacement
   contains
      procedure :: at => series_at
      procedure :: on_cell => series_on_cell
   end type series_fields

contains

   subroutine series_at(self, x, y, pressure, displacement)
      class(series_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement

      pressure = self%pressure%at(x, y)
      displacement = self%displacement%at(x, y)
   end subroutine series_at

   !> The argument `dimension` is not used: the series have one.
   subroutine series_on_cell(self, intervals, dimension, pressure, displacement)
      class(series_fields), intent(inout) :: self
      integer, intent(in) :: intervals, dimension
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :)

      associate (unused => dimension); end associate
      call self%pressure%evaluate_on_cell(intervals, pressure)
      call self%displacement%evaluate_on_cell(intervals, displacement)
   end subroutine series_on_cell

end module wavycon_contact_fields
