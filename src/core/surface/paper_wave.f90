!> Which wave of Johnson, Greenwood & Higginson (1985) a surface is, its wavelength and its angles in their equations.
module wavycon_paper_wave
   use wavycon_constants, only: sqrt2
   use wavycon_kinds, only: dp
   use wavycon_surface, only: shape_rounding, surface_type
   implicit none (type, external)
   private

   public :: is_paper_wave, paper_angles, paper_wave, paper_wavelength

   !> Straight: eq. (3) or (21) with phi = X, theta = Y. Rotated: eq. (21) with phi = (X + Y)/2, theta = (X - Y)/2.
   integer, parameter, public :: no_paper_wave = 0, straight_paper_wave = 1, rotated_paper_wave = 2

contains

   !> Whether the surface is a wave of the paper: no_paper_wave, straight_paper_wave or rotated_paper_wave. A
   !> distributed surface counts as none.
   pure integer function paper_wave(surface)
      type(surface_type), intent(in) :: surface

      real(dp) :: longest(0:1, 0:1)   ! coefficients of the longest waves
      integer :: highest(2)

      paper_wave = no_paper_wave
      if (surface%is_distributed() .or. surface%has_free_edges .or. .not. surface%shape%is_even()) return
      if (surface%dimension == 2 .and. .not. surface%is_square()) return
      longest = 0.0_dp
      highest = min(1, ubound(surface%shape%c))
      longest(:highest(1), :highest(2)) = surface%shape%c(:highest(1), :highest(2))
      select case (count(abs(surface%shape%c) > shape_rounding))
      case (1)
         if (abs(longest(1, surface%dimension - 1) - 1.0_dp) <= shape_rounding) paper_wave = straight_paper_wave
      case (2)
         if (all(abs([longest(1, 0), longest(0, 1)] - 0.5_dp) <= shape_rounding)) paper_wave = rotated_paper_wave
      end select
   end function paper_wave

   !> Whether the surface is a wave of the paper. A flat surface that is not a height map counts as one of amplitude 0
   !> in 1-D and on a square cell.
   pure logical function is_paper_wave(surface)
      type(surface_type), intent(in) :: surface

      if (surface%amplitude > 0.0_dp .or. surface%has_free_edges) then
         is_paper_wave = paper_wave(surface) /= no_paper_wave
      else
         is_paper_wave = .not. surface%is_height_map() .and. (surface%dimension == 1 .or. surface%is_square())
      end if
   end function is_paper_wave

   !> The wavelength lambda of eq. (3) or (21) [length].
   pure real(dp) function paper_wavelength(surface)
      type(surface_type), intent(in) :: surface   !! a wave of the paper

      paper_wavelength = surface%length(1)
      if (paper_wave(surface) == rotated_paper_wave) paper_wavelength = sqrt2*surface%length(1)
   end function paper_wavelength

   !> The angles phi and theta of eq. (3) or (21) at a point.
   pure subroutine paper_angles(surface, x, y, phi, theta)
      type(surface_type), intent(in) :: surface   !! a wave of the paper
      real(dp), intent(in) :: x, y                !! X, Y [rad]
      real(dp), intent(out) :: phi, theta         !! [rad]

      phi = x
      theta = y
      if (paper_wave(surface) == rotated_paper_wave) then
         phi = 0.5_dp*(x + y)
         theta = 0.5_dp*(x - y)
      end if
   end subroutine paper_angles

end module wavycon_paper_wave
