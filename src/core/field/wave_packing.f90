!> Converts between the coefficients of a Fourier series and the spectrum of its values on a grid of
!> wavycon_grid_points. The rows of the spectrum are cosines for an even field, waves for any other.
module wavycon_wave_packing
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: fold_waves, give_cosines, give_waves, take_cosines, take_waves

contains

   !> The coefficients of an even field from its spectrum.
   pure subroutine take_cosines(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N
      real(dp), intent(in) :: spectrum(:, :, :)         !! shape (1, wave numbers of the series in X, N)
      type(fourier_series), intent(inout) :: answer     !! its arrays are those of own wave numbers

      integer :: l

      do l = 0, points(2) - 1
         answer%c(:, l) = merge(0.5_dp, 1.0_dp, l == 0)*(spectrum(1, :, l + 1)/(real(points(1), dp)*points(2)))
      end do
      if (answer%first() == 0) answer%c(0, :) = 0.5_dp*answer%c(0, :)
   end subroutine take_cosines

   !> The waves of any other field. At the points those of 2l = N are equal for l and -l.
   pure subroutine take_waves(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N
      real(dp), intent(in) :: spectrum(:, :, :)         !! real and imaginary part, shape (2, wave numbers, N)
      type(fourier_series), intent(inout) :: answer

      real(dp) :: weight(answer%first():answer%last(1))
      integer :: k, l, place

      do l = -answer%last(2), answer%last(2)
         weight = [(merge(1.0_dp, 2.0_dp, k == 0 .or. 2*k == points(1)), k=answer%first(), answer%last(1))] &
                  *merge(0.5_dp, 1.0_dp, 2*abs(l) == points(2))/(real(points(1), dp)*points(2))
         place = modulo(l, points(2)) + 1
         answer%wave(:, l) = weight*cmplx(spectrum(1, :, place), spectrum(2, :, place), dp)
      end do
   end subroutine take_waves

   !> The inverse of `take_cosines`; the number of points may differ.
   pure subroutine give_cosines(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      real(dp), intent(inout) :: spectrum(:, :, :)        !! of the first wave numbers of the series in X

      integer :: l

      spectrum = 0.0_dp
      do l = 0, min(points(2) - 1, from%last(2))
         spectrum(1, :, l + 1) = 0.5_dp*real(from%row(l, from%first() + size(spectrum, 2) - 1))
         if (from%first() == 0) spectrum(1, :1, l + 1) = 2*spectrum(1, :1, l + 1)
      end do
   end subroutine give_cosines

   !> The inverse of `take_waves`; the number of points may differ.
   pure subroutine give_waves(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      complex(dp), intent(inout) :: spectrum(:, :)        !! of the first wave numbers of the series in X

      integer :: l, last

      spectrum = 0.0_dp
      last = min(points(2)/2, from%last(2))
      do l = -last, last
         call fold_waves(points, l, from%first(), 0.5_dp*from%row(l, from%first() + size(spectrum, 1) - 1), spectrum)
      end do
   end subroutine give_waves

   !> Adds the waves of one wave number in Y to a spectrum as of `grid_transform%sample_waves`. Waves that the points
   !> cannot tell from slower ones are added to those.
   pure subroutine fold_waves(points, l, first, waves, spectrum)
      integer, intent(in) :: points(2)                      !! M, N
      integer, intent(in) :: l
      integer, intent(in) :: first                          !! wave number in X, > 0 if only waves up to M/2 are given
      complex(dp), intent(in) :: waves(first:)              !! half of W_kl, k = first..m
      complex(dp), intent(inout) :: spectrum(first:, 0:)    !! shape (first:M/2, 0:N - 1)

      integer :: half, k, place, opposite, r

      half = min(ubound(waves, 1), points(1)/2)
      place = modulo(l, points(2))
      opposite = modulo(-l, points(2))
      spectrum(:half, place) = spectrum(:half, place) + waves(:half)
      ! The transform takes the waves -k from the others, unless they are the same ones.
      if (first == 0) spectrum(0, opposite) = spectrum(0, opposite) + conjg(waves(0))
      do k = max(first, (points(1) + 1)/2), ubound(waves, 1)
         r = modulo(k, points(1))
         if (k > half .and. 2*r <= points(1)) spectrum(r, place) = spectrum(r, place) + waves(k)
         r = modulo(-k, points(1))
         if (2*r <= points(1)) spectrum(r, opposite) = spectrum(r, opposite) + conjg(waves(k))
      end do
   end subroutine fold_waves

end module wavycon_wave_packing
