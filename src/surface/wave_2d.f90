!> The two-dimensional wave, with a wavelength of its own along y.
module wavycon_wave_2d
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: wave_2d

contains

   !> h = Delta [1 - cos(2 pi x/lambda_x) cos(2 pi y/lambda_y)]: eq. (21) with a wavelength of its own each way.
   type(surface_type) function wave_2d(amplitude, wavelength, wavelength_y) result(surface)
      real(dp), intent(in) :: amplitude                !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength               !! along x [length], > 0
      real(dp), intent(in), optional :: wavelength_y   !! along y [length], > 0; that along x if absent

      real(dp) :: length(2)

      length = wavelength
      if (present(wavelength_y)) length(2) = wavelength_y
      surface = wave_sum(length, 0.5_dp*[amplitude, amplitude], [1, 1], [1, -1], &
                         [0.0_dp, 0.0_dp])
   end function wave_2d

end module wavycon_wave_2d
