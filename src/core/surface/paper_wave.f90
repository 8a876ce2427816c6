!> Recognises the waves of Johnson, Greenwood & Higginson (1985) among surfaces, with the wavelength and the angles of
!> their equations. Also finds the smaller periodic cell that the 2-D wave and other surfaces of its symmetry have.
module wavycon_paper_wave
   use wavycon_kinds, only: dp, sqrt2
   use wavycon_rotated_series, only: in_other_angles, to_sum_angles
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: has_smaller_cell, is_paper_wave, paper_angles, paper_wave, paper_wavelength, smaller_cell

   !> `straight_paper_wave`: eq. (3) or (21) with phi = X, theta = Y. `rotated_paper_wave`: eq. (21) with
   !> phi = (X + Y)/2, theta = (X - Y)/2.
   integer, parameter, public :: no_paper_wave = 0, straight_paper_wave = 1, rotated_paper_wave = 2

   !> Coefficients of a shape are equal if they differ by at most this, and sides if they differ by this part of them.
   real(dp), parameter :: rounding = 1e-13_dp

contains

   !> Which wave of the paper the surface is. A distributed surface and one on a layer count as none. A flat surface
   !> that is not a height map counts as a straight wave of amplitude 0 in 1-D and on a square cell.
   pure integer function paper_wave(surface)
      type(surface_type), intent(in) :: surface

      real(dp) :: longest(0:1, 0:1)   ! coefficients of the longest waves
      integer :: highest(2)

      paper_wave = no_paper_wave
      if (surface%is_distributed() .or. surface%has_free_edges .or. surface%kernel%has_layer()) return
      if (.not. surface%shape%is_even()) return
      if (surface%dimension == 2 .and. .not. is_square(surface)) return
      longest = 0.0_dp
      highest = min(1, ubound(surface%shape%c))
      longest(:highest(1), :highest(2)) = surface%shape%c(:highest(1), :highest(2))
      select case (count(abs(surface%shape%c) > rounding))
      case (0)
         if (.not. surface%is_height_map()) paper_wave = straight_paper_wave
      case (1)
         if (abs(longest(1, surface%dimension - 1) - 1.0_dp) <= rounding) paper_wave = straight_paper_wave
      case (2)
         if (all(abs([longest(1, 0), longest(0, 1)] - 0.5_dp) <= rounding)) paper_wave = rotated_paper_wave
      end select
   end function paper_wave

   !> Whether the surface is a wave of the paper, for which there are the paper's series and closed forms.
   pure logical function is_paper_wave(surface)
      type(surface_type), intent(in) :: surface

      is_paper_wave = paper_wave(surface) /= no_paper_wave
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

   !> Whether the surface is also periodic on a square of half the area, rotated by 45 degrees, and even and symmetric
   !> under exchange of the directions there. For height maps the result is .false.: they are solved on their own cell.
   pure logical function has_smaller_cell(surface)
      type(surface_type), intent(in) :: surface

      has_smaller_cell = .false.
      if (surface%is_height_map() .or. surface%has_free_edges .or. surface%dimension == 1) return
      if (.not. (surface%shape%is_even() .and. is_square(surface))) return
      associate (c => surface%shape%c)
         if (ubound(c, 1) /= ubound(c, 2)) return
         ! The sum of the two wave numbers of each wave must be even.
         has_smaller_cell = all(abs(c - transpose(c)) <= rounding) .and. all(abs(c(0::2, 1::2)) <= rounding) &
                            .and. all(abs(c(1::2, 0::2)) <= rounding)
      end associate
   end function has_smaller_cell

   !> The same surface on its smaller cell, see has_smaller_cell. The angles of the smaller cell are X + Y and X - Y.
   type(surface_type) function smaller_cell(whole) result(surface)
      type(surface_type), intent(in) :: whole   !! a surface for which has_smaller_cell is true

      surface = whole
      surface%shape = in_other_angles(whole%shape, to_sum_angles)
      surface%length = whole%length/sqrt2
      surface%crest = [whole%crest(1) + whole%crest(2), whole%crest(1) - whole%crest(2)]
   end function smaller_cell

   !> Whether the sides of the cell are equal.
   pure logical function is_square(surface)
      type(surface_type), intent(in) :: surface

      is_square = abs(surface%length(1) - surface%length(2)) <= rounding*surface%length(1)
   end function is_square

end module wavycon_paper_wave
