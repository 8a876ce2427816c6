!> The pressure and the displacement of one solution, anywhere on the surface.
module wavycon_contact_fields
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_fields, series_fields

   type, abstract :: contact_fields
   contains
      procedure(fields_at_point), deferred :: at
      procedure :: on_cell
   end type contact_fields

   abstract interface
      subroutine fields_at_point(self, x, y, pressure, displacement)
         import :: contact_fields, dp
         class(contact_fields), intent(inout) :: self
         real(dp), intent(in) :: x, y                       !! X, Y of the surface's cell [rad]
         real(dp), intent(out) :: pressure, displacement    !! p/p*, (u - ubar)/Delta
      end subroutine fields_at_point
   end interface

   !> Both as series.
   type, extends(contact_fields) :: series_fields
      type(fourier_series) :: pressure, displacement
   contains
      procedure :: at => series_at
      procedure :: on_cell => series_on_cell
   end type series_fields

contains

   !> At X = 2 pi k/N, Y = 2 pi l/N, k, l = 0..N (l = 0 alone in 1-D).
   subroutine on_cell(self, intervals, dimension, pressure, displacement)
      class(contact_fields), intent(inout) :: self
      integer, intent(in) :: intervals, dimension   !! N; 1 or 2
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :)   !! shape (0:N, 0:N) or (0:N, 0:0)

      integer :: k, l, lines

      lines = merge(0, intervals, dimension == 1)
      allocate (pressure(0:intervals, 0:lines), displacement(0:intervals, 0:lines))
      do l = 0, lines
         do k = 0, intervals
            call self%at(2*pi*k/intervals, 2*pi*l/intervals, pressure(k, l), displacement(k, l))
         end do
      end do
   end subroutine on_cell

   subroutine series_at(self, x, y, pressure, displacement)
      class(series_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement

      pressure = self%pressure%at(x, y)
      displacement = self%displacement%at(x, y)
   end subroutine series_at

   subroutine series_on_cell(self, intervals, dimension, pressure, displacement)
      class(series_fields), intent(inout) :: self
      integer, intent(in) :: intervals, dimension
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :)

      associate (known_by_the_series => dimension); end associate
      call self%pressure%evaluate_on_cell(intervals, pressure)
      call self%displacement%evaluate_on_cell(intervals, displacement)
   end subroutine series_on_cell

end module wavycon_contact_fields
