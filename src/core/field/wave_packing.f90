!> Converts between the coefficients of a Fourier series and the spectrum that FFTW computes from the field's values on
!> a grid of wavycon_grid_points. The spectrum consists of cosines for an even field, and of waves for any other field.
module wavycon_wave_packing
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: fold_waves, give_cosines, give_waves, take_cosines, take_waves

contains

   !> Computes the coefficients of an even field from its spectrum.
   pure subroutine take_cosines(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N, points of the grid
      real(dp), intent(in) :: spectrum(:, :, :)         !! shape (1, number of wave numbers of the series in X, N)
      type(fourier_series), intent(inout) :: answer     !! its array has been allocated by `new_series`

      answer%c(:, :) = spectrum(1, :, :)/(real(points(1), dp)*points(2))
      ! A cosine of wave number zero has half the factor of the others.
      answer%c(:, 0) = 0.5_dp*answer%c(:, 0)
      if (answer%first() == 0) answer%c(0, :) = 0.5_dp*answer%c(0, :)
   end subroutine take_cosines

   !> Computes the waves of a field that is not even from its spectrum. The wave k > 0 of the series stands for the
   !> waves k and -k of the spectrum, which are complex conjugates; this doubles its weight. If 2k = M or 2l = N the
   !> waves k and -k, or l and -l, have the same values at the points. They share one number of the spectrum.
   pure subroutine take_waves(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N, points of the grid
      real(dp), intent(in) :: spectrum(:, :, :)         !! real and imaginary parts, shape (2, wave numbers in X, N)
      type(fourier_series), intent(inout) :: answer     !! its array has been allocated by `new_series`

      real(dp) :: weight(answer%first():answer%last(1))
      integer :: k, l, row

      do l = -answer%last(2), answer%last(2)
         weight = [(merge(1.0_dp, 2.0_dp, k == 0 .or. 2*k == points(1)), k=answer%first(), answer%last(1))] &
                  /(real(points(1), dp)*points(2))
         if (2*abs(l) == points(2)) weight = 0.5_dp*weight
         row = modulo(l, points(2)) + 1
         answer%wave(:, l) = weight*cmplx(spectrum(1, :, row), spectrum(2, :, row), dp)
      end do
   end subroutine take_waves

   !> Computes the spectrum of an even field from its coefficients, the inverse of `take_cosines` but for a factor. The
   !> grid may have another number of points than that of the series; waves with l >= N are left out.
   pure subroutine give_cosines(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N, points of the grid
      type(fourier_series), intent(in) :: from            !! series of the field
      real(dp), intent(inout) :: spectrum(:, :, :)        !! first wave numbers of the series in X, (1, any, N)

      integer :: l

      spectrum = 0.0_dp
      do l = 0, min(points(2) - 1, from%last(2))
         spectrum(1, :, l + 1) = 0.5_dp*real(from%row(l, from%first() + size(spectrum, 2) - 1))
         if (from%first() == 0) spectrum(1, :1, l + 1) = 2*spectrum(1, :1, l + 1)
      end do
   end subroutine give_cosines

   !> Computes the spectrum of a field that is not even from its waves, the inverse of `take_waves` but for a factor.
   !> The grid may have another number of points than that of the series; waves with |l| > N/2 are left out.
   pure subroutine give_waves(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N, points of the grid
      type(fourier_series), intent(in) :: from            !! series of the field
      complex(dp), intent(inout) :: spectrum(:, :)        !! the first wave numbers of the series in X, shape (any, N)

      integer :: l, last

      spectrum = 0.0_dp
      last = min(points(2)/2, from%last(2))
      do l = -last, last
         call fold_waves(points, l, from%first(), 0.5_dp*from%row(l, from%first() + size(spectrum, 1) - 1), spectrum)
      end do
   end subroutine give_waves

   !> Adds the waves of one wave number in Y to a spectrum as in `grid_transform%sample_waves`. A wave that is too short
   !> for the points has the same values there as a longer wave, its alias, and is added to the alias.
   pure subroutine fold_waves(points, l, first, waves, spectrum)
      integer, intent(in) :: points(2)                      !! M, N, points of the grid
      integer, intent(in) :: l                              !! wave number in Y
      integer, intent(in) :: first                          !! first wave number in X; if > 0, waves end at k = M/2
      complex(dp), intent(in) :: waves(first:)              !! half of W_kl, k = first..m
      complex(dp), intent(inout) :: spectrum(first:, 0:)    !! shape (first:M/2, 0:N - 1)

      integer :: half, k, opposite, r, row   ! indices in the spectrum of l and -l

      half = min(ubound(waves, 1), points(1)/2)
      row = modulo(l, points(2))
      opposite = modulo(-l, points(2))
      spectrum(:half, row) = spectrum(:half, row) + waves(:half)
      ! The transform takes the waves -k as the conjugates of the waves k. For k = 0 and k = M/2 both are in the
      ! spectrum.
      if (first == 0) spectrum(0, opposite) = spectrum(0, opposite) + conjg(waves(0))
      do k = max(first, (points(1) + 1)/2), ubound(waves, 1)
         r = modulo(k, points(1))
         if (k > half .and. 2*r <= points(1)) spectrum(r, row) = spectrum(r, row) + waves(k)
         r = modulo(-k, points(1))
         if (2*r <= points(1)) spectrum(r, opposite) = spectrum(r, opposite) + conjg(waves(k))
      end do
   end subroutine fold_waves

end module wavycon_wave_packing
