!> Makes surfaces of cosine waves: sums of any waves, and the named kinds of decks.
module wavycon_wave_surfaces
   use wavycon_fourier_series, only: divide_series, fourier_series, turn, weighted
   use wavycon_full_contact, only: set_closure
   use wavycon_kinds, only: dp, sqrt3
   use wavycon_series_peak, only: find_peak
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: crossed_1d, hexagonal, surface_of_series, wave_1d, wave_2d, wave_sum

contains

   !> h = Delta (1 - cos 2 pi x/lambda): Johnson, Greenwood & Higginson (1985), eq. (3).
   type(surface_type) function wave_1d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda [length], > 0

      surface = wave_sum([wavelength, wavelength], [amplitude], [1], [0], [0.0_dp])
   end function wave_1d

   !> h = Delta [1 - cos(2 pi x/lambda_x) cos(2 pi y/lambda_y)]: eq. (21) with different wavelengths along x and y.
   type(surface_type) function wave_2d(amplitude, wavelength, wavelength_y) result(surface)
      real(dp), intent(in) :: amplitude                !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength               !! lambda_x [length], > 0
      real(dp), intent(in), optional :: wavelength_y   !! lambda_y [length], > 0; lambda_x if absent

      real(dp) :: length(2)

      length = wavelength
      if (present(wavelength_y)) length(2) = wavelength_y
      surface = wave_sum(length, 0.5_dp*[amplitude, amplitude], [1, 1], [1, -1], [0.0_dp, 0.0_dp])
   end function wave_2d

   !> Two blocks with a one-dimensional wave each, crossed at right angles: h = a_1 (1 - cos 2 pi x/lambda_1) +
   !> a_2 (1 - cos 2 pi y/lambda_2). With equal amplitudes a and equal wavelengths this is eq. (21) rotated by 45
   !> degrees, with Delta = 2a and sqrt2 times the wavelength.
   type(surface_type) function crossed_1d(amplitude1, wavelength1, amplitude2, wavelength2) result(surface)
      real(dp), intent(in) :: amplitude1, wavelength1   !! a_1 >= 0 and lambda_1 > 0, along x [length]
      real(dp), intent(in) :: amplitude2, wavelength2   !! a_2 >= 0 and lambda_2 > 0, along y [length]

      surface = wave_sum([wavelength1, wavelength2], [amplitude1, amplitude2], [1, 0], [0, 1], [0.0_dp, 0.0_dp])
   end function crossed_1d

   !> Three equal waves whose directions differ by 60 degrees: h = Delta [1 - (cos k1.r + cos k2.r + cos k3.r)/3] with
   !> wave vectors k1, k2, k3 = k2 - k1 of length 2 pi/lambda. The crests form rows along x, in which they are
   !> 2 lambda/sqrt3 apart. The rectangular cell has two crests.
   type(surface_type) function hexagonal(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda of each wave [length], > 0

      surface = wave_sum([2/sqrt3, 2.0_dp]*wavelength, spread(amplitude/3, 1, 3), [0, 1, 1], [2, 1, -1], &
                         spread(0.0_dp, 1, 3))
   end function hexagonal

   !> A sum of waves: h = Delta - sum_q a_q cos(m_q X + n_q Y - phase_q), X = 2 pi x/L_x, Y = 2 pi y/L_y. Delta is the
   !> largest value of the sum, so that the surfaces just touch.
   type(surface_type) function wave_sum(length, a, m, n, phase) result(surface)
      real(dp), intent(in) :: length(2)      !! L_x, L_y [length], > 0
      real(dp), intent(in) :: a(:)           !! amplitudes [length], of either sign
      integer, intent(in) :: m(:), n(:)      !! wave numbers, shape of a; not both zero; all n = 0 for a profile
      real(dp), intent(in) :: phase(:)       !! phases [rad], shape of a

      !> The sum is taken as even if its coefficients differ from those of an even sum by at most this part of the sum
      !> of the amplitudes.
      real(dp), parameter :: rounding = 1e-15_dp
      type(fourier_series) :: waves
      integer :: last, q, sense

      last = maxval(abs(n))
      allocate (waves%wave(0:maxval(abs(m)), -last:last), source=(0.0_dp, 0.0_dp))
      do q = 1, size(a)
         ! A wave with m < 0 is written as the same wave with -m, -n and -phase.
         sense = 1
         if (m(q) < 0) sense = -1
         call waves%add_wave(abs(m(q)), sense*n(q), a(q)*turn(-sense*phase(q)))
      end do
      associate (mirrored => waves%wave(:, last:-last:-1))
         if (max(maxval(abs(waves%wave%im)), maxval(abs(waves%wave - mirrored))) <= rounding*sum(abs(a))) then
            allocate (waves%c(0:ubound(waves%wave, 1), 0:last), source=real(waves%wave(:, 0:)))
            waves%c(:, 1:) = waves%c(:, 1:) + real(waves%wave(:, -1:-last:-1))
            deallocate (waves%wave)
         end if
      end associate
      surface = surface_of_series(length, waves)
   end function wave_sum

   !> Makes the surface whose height is a Fourier series. Peak, p* and curvature are the extremes of the series, found
   !> by a search.
   type(surface_type) function surface_of_series(length, height) result(surface)
      real(dp), intent(in) :: length(2)            !! L_x, L_y [length], > 0
      type(fourier_series), intent(in) :: height   !! height [length]; its mean is not used

      real(dp) :: unused(2)

      surface%shape = height
      call surface%shape%set_mean(0.0_dp)
      surface%length = length
      if (height%last(2) == 0) surface%dimension = 1
      call find_peak(surface%shape, surface%amplitude, surface%crest)
      if (.not. surface%amplitude > 0.0_dp) surface%amplitude = 0.0_dp
      if (surface%amplitude <= 0.0_dp) return
      call divide_series(surface%shape, surface%amplitude)
      call find_peak(weighted(surface%shape, surface%length), surface%crest_curvature, unused)
      surface%ridges = surface%shape%parallel_slopes(length)
      call set_closure(surface)
   end function surface_of_series

end module wavycon_wave_surfaces
