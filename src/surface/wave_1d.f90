!> The one-dimensional wave.
module wavycon_wave_1d
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: wave_1d

contains

   !> h = Delta (1 - cos 2 pi x/lambda): Johnson, Greenwood & Higginson (1985), eq. (3).
   type(surface_type) function wave_1d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda [length], > 0

      surface = wave_sum([wavelength, wavelength], [amplitude], [1], [0], [0.0_dp])
   end function wave_1d

end module wavycon_wave_1d
