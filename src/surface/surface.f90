!> The wavy surfaces: the gap h before deformation, and the pressure that closes it.
module wavycon_surface
   use wavycon_constants, only: pi, sqrt2
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: surface_type, wave_1d, wave_2d, crossed_1d

   !> A wave with a flat. phi = 2 pi x/lambda, theta = 2 pi y/lambda:
   !>   dimension 1: h/Delta = 1 - cos phi                (Johnson, Greenwood & Higginson 1985, eq. 3)
   !>   dimension 2: h/Delta = 1 - cos phi cos theta      (eq. 21)
   type :: surface_type
      integer :: dimension = 2
      real(dp) :: amplitude = 1.0_dp       !! Delta [length], >= 0
      real(dp) :: wavelength = 1.0_dp      !! lambda of phi and theta [length], > 0
      logical :: turned = .false.          !! the user's axes are turned by 45 degrees against those of phi and theta
   contains
      procedure :: full_contact_pressure
      procedure :: undeformed_gap_over_amplitude
      procedure :: cell_side
      procedure :: point_at
   end type surface_type

contains

   !> One-dimensional wave of eq. (3).
   pure type(surface_type) function wave_1d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda [length], > 0

      surface = surface_type(1, amplitude, wavelength, .false.)
   end function wave_1d

   !> Two-dimensional wave of eq. (21).
   pure type(surface_type) function wave_2d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda [length], > 0

      surface = surface_type(2, amplitude, wavelength, .false.)
   end function wave_2d

   !> Two blocks with the same one-dimensional wave, crossed at right angles. Their gap
   !> a (1 - cos X) + a (1 - cos Y) is that of eq. (21) with Delta = 2a, lambda = sqrt2 times theirs and the axes
   !> turned by 45 degrees: phi = (X + Y)/2, theta = (X - Y)/2.
   pure type(surface_type) function crossed_1d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! a, of each block [length], >= 0
      real(dp), intent(in) :: wavelength   !! of each block [length], > 0

      surface = surface_type(2, 2*amplitude, sqrt2*wavelength, .true.)
   end function crossed_1d

   !> p*, the mean pressure that just closes the gap everywhere: pi E* Delta/lambda in 1-D (eq. 7), sqrt2 times
   !> that in 2-D (eq. 22).
   elemental real(dp) function full_contact_pressure(self, e_star)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: e_star   !! plane-strain modulus E* [pressure]

      full_contact_pressure = pi*e_star*self%amplitude/self%wavelength
      if (self%dimension == 2) full_contact_pressure = sqrt2*full_contact_pressure
   end function full_contact_pressure

   !> h/Delta.
   elemental real(dp) function undeformed_gap_over_amplitude(self, phi, theta) result(gap)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: phi, theta   !! [rad]; theta does not matter in 1-D

      if (self%dimension == 1) then
         gap = 1.0_dp - cos(phi)
      else
         gap = 1.0_dp - cos(phi)*cos(theta)
      end if
   end function undeformed_gap_over_amplitude

   !> Side of the periodic cell in the user's axes [length].
   elemental real(dp) function cell_side(self)
      class(surface_type), intent(in) :: self

      cell_side = self%wavelength
      if (self%turned) cell_side = self%wavelength/sqrt2
   end function cell_side

   !> A point in the user's axes.
   elemental subroutine point_at(self, phi, theta, x, y)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: phi, theta   !! [rad]
      real(dp), intent(out) :: x, y        !! [length]

      if (self%turned) then
         x = self%cell_side()*(phi + theta)/(2*pi)
         y = self%cell_side()*(phi - theta)/(2*pi)
      else
         x = self%wavelength*phi/(2*pi)
         y = self%wavelength*theta/(2*pi)
      end if
   end subroutine point_at

end module wavycon_surface
