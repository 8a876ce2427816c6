!> Two blocks with a one-dimensional wave each, crossed at right angles.
module wavycon_crossed_1d
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: crossed_1d

contains

   !> Two blocks with a one-dimensional wave each, crossed at right angles: h = a_1 (1 - cos 2 pi x/lambda_1) + a_2 (1
   !> - cos 2 pi y/lambda_2). With equal amplitudes a and equal wavelengths it is eq. (21) rotated by 45 degrees, with
   !> Delta = 2a and sqrt2 times the wavelength.
   type(surface_type) function crossed_1d(amplitude1, wavelength1, amplitude2, wavelength2) result(surface)
      real(dp), intent(in) :: amplitude1, wavelength1   !! along x [length], >= 0, > 0
      real(dp), intent(in) :: amplitude2, wavelength2   !! along y [length], >= 0, > 0

      surface = wave_sum([wavelength1, wavelength2], [amplitude1, amplitude2], [1, 0], [0, 1], [0.0_dp, 0.0_dp])
   end function crossed_1d

end module wavycon_crossed_1d
