!> Surfaces that are sums of harmonics on a rectangular cell.
!>
!>     h(x, y) = 1 - sum_q a_q cos(m_q X + n_q Y),   X = 2 pi x/L_x,  Y = 2 pi y/L_y,   sum_q a_q = 1, a_q > 0:
!>
!> a crest at the origin, where the surfaces first touch, and lengths along the gap in the mean gap before load, which
!> for the waves of the paper is their amplitude Delta. Pressures are in p*, the mean pressure that just closes the gap
!> everywhere.
module wavycon_harmonic_surface
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: harmonic_surface, wave_sum

   type :: harmonic_surface
      real(dp) :: length(2) = 1.0_dp         !! L_x, L_y of the cell, in any one unit
      real(dp), allocatable :: a(:)          !! amplitudes over the mean gap
      integer, allocatable :: m(:), n(:)     !! wave numbers along x and y
      real(dp) :: stiffness = 1.0_dp         !! pressure [p*] of a unit displacement [Delta] of unit wavelength
   contains
      procedure :: frequency
      procedure :: gap_at
   end type harmonic_surface

contains

   !> A sum of waves of which all are least at one and the same point: that closes last, when their full-contact
   !> pressures just add up to -p* there.
   pure type(harmonic_surface) function wave_sum(length, a, m, n) result(surface)
      real(dp), intent(in) :: length(2)      !! L_x, L_y > 0
      real(dp), intent(in) :: a(:)           !! amplitudes > 0, in any one unit
      integer, intent(in) :: m(:), n(:)      !! not both zero

      surface%length = length
      allocate (surface%a, source=a/sum(a))
      allocate (surface%m, source=m)
      allocate (surface%n, source=n)
      surface%stiffness = 1.0_dp/sum(surface%a*surface%frequency(m, n))
   end function wave_sum

   !> One over the wavelength of a harmonic.
   elemental real(dp) function frequency(self, m, n)
      class(harmonic_surface), intent(in) :: self
      integer, intent(in) :: m, n

      frequency = hypot(m/self%length(1), n/self%length(2))
   end function frequency

   !> h over the mean gap.
   elemental real(dp) function gap_at(self, x_angle, y_angle)
      class(harmonic_surface), intent(in) :: self
      real(dp), intent(in) :: x_angle, y_angle   !! X, Y [rad]

      gap_at = 1.0_dp - sum(self%a*cos(self%m*x_angle + self%n*y_angle))
   end function gap_at

end module wavycon_harmonic_surface
