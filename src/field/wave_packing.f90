!> Converts between the coefficients of a Fourier series and the spectrum of its values on a grid of
!> wavycon_grid_points. The rows of the spectrum are cosines for an even field, waves for any other.
module wavycon_wave_packing
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: give_cosines, give_waves, take_cosines, take_waves

contains

   !> The coefficients of an even field from its spectrum.
   pure subroutine take_cosines(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N
      real(dp), intent(in) :: spectrum(:, :, :)         !! shape (1, wave numbers of the series in X, N)
      type(fourier_series), intent(inout) :: answer     !! its arrays are those of own wave numbers

      integer :: k, l

      do l = 0, points(2) - 1
         do k = lbound(answer%c, 1), ubound(answer%c, 1)
            answer%c(k, l) = merge(0.5_dp, 1.0_dp, k == 0)*merge(0.5_dp, 1.0_dp, l == 0)* &
                             (spectrum(1, k - lbound(answer%c, 1) + 1, l + 1)/(real(points(1), dp)*points(2)))
         end do
      end do
   end subroutine take_cosines

   !> The coefficients of any other field.
   pure subroutine take_waves(points, spectrum, answer)
      integer, intent(in) :: points(2)                  !! M, N
      real(dp), intent(in) :: spectrum(:, :, :)         !! real and imaginary part, shape (2, wave numbers, N)
      type(fourier_series), intent(inout) :: answer

      complex(dp) :: down, up
      real(dp) :: weight
      integer :: k, l, r

      associate (m => points(1), n => points(2))
         do l = 0, n/2
            do r = 1, size(spectrum, 2)
               k = lbound(answer%c, 1) + r - 1
               ! Of e^(i(kX + lY)) and e^(i(kX - lY)): half each if both are the same wave.
               weight = merge(1.0_dp, 2.0_dp, k == 0 .or. 2*k == m)/(real(m, dp)*n)
               if (modulo(2*l, n) == 0) weight = 0.5_dp*weight
               up = weight*cmplx(spectrum(1, r, l + 1), spectrum(2, r, l + 1), dp)
               down = weight*cmplx(spectrum(1, r, modulo(-l, n) + 1), spectrum(2, r, modulo(-l, n) + 1), dp)
               answer%c(k, l) = real(up + down)
               answer%cs(k, l) = aimag(down - up)
               answer%sc(k, l) = -aimag(up + down)
               answer%ss(k, l) = real(down - up)
            end do
         end do
      end associate
   end subroutine take_waves

   !> The inverse of `take_cosines`; the number of points may differ.
   pure subroutine give_cosines(points, from, spectrum, power, per_wave)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      real(dp), intent(inout) :: spectrum(:, :, :)        !! of the first wave numbers of the series in X
      integer, intent(in), optional :: power              !! as of `grid_transform%sample`
      real(dp), intent(in), optional :: per_wave(2)

      integer :: k, l, r

      spectrum = 0.0_dp
      do l = 0, min(points(2) - 1, ubound(from%c, 2))
         do r = 1, size(spectrum, 2)
            k = lbound(from%c, 1) + r - 1
            spectrum(1, r, l + 1) = merge(1.0_dp, 0.5_dp, k == 0)*merge(1.0_dp, 0.5_dp, l == 0)* &
                                    from%c(k, l)*factor(k, l, power, per_wave)
         end do
      end do
   end subroutine give_cosines

   !> The inverse of `take_waves`; the number of points may differ. With `offset` the points are displaced, and waves
   !> that they cannot tell from slower ones are added to those; without it such waves are left out.
   pure subroutine give_waves(points, from, spectrum, power, per_wave, offset)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      real(dp), intent(inout) :: spectrum(:, :, :)        !! of the first wave numbers of the series in X
      integer, intent(in), optional :: power              !! as of `grid_transform%sample`
      real(dp), intent(in), optional :: per_wave(2), offset(2)

      !> Amplitudes, and how far e^(ikX) turns between a point of the grid and the displaced one.
      complex(dp), dimension(lbound(from%c, 1):ubound(from%c, 1)) :: down, turn, up
      complex(dp) :: turn_y
      real(dp), dimension(lbound(from%c, 1):ubound(from%c, 1)) :: halves, weight
      integer :: first, k, l, last(2), minus, plus, r

      first = lbound(from%c, 1)
      ! One half where k and -k are two waves.
      halves = [(merge(1.0_dp, 0.5_dp, modulo(2*k, points(1)) == 0), k=first, ubound(from%c, 1))]
      last = min([first + size(spectrum, 2) - 1, points(2)/2], ubound(from%c))
      if (present(offset)) then
         last = ubound(from%c)
         turn = [(turned(k*offset(1)/points(1)), k=first, last(1))]
      end if
      do l = 0, max(last(2), points(2)/2)
         plus = modulo(l, points(2)) + 1
         minus = modulo(-l, points(2)) + 1
         if (2*l <= points(2)) then
            spectrum(:, :, plus) = 0.0_dp
            spectrum(:, :, minus) = 0.0_dp
         end if
         if (l > last(2)) cycle
         weight = halves
         if (present(power)) weight = weight*[(factor(k, l, power, per_wave), k=first, ubound(from%c, 1))]
         call from%amplitudes(l, up, down)
         up = weight*up
         down = weight*down
         if (present(offset)) then
            turn_y = turned(l*offset(2)/points(2))
            up = turn*turn_y*up
            down = turn*conjg(turn_y)*down
         end if
         associate (a => spectrum(:, :, plus), b => spectrum(:, :, minus))
            do k = first, min(last(1), points(1)/2)
               a(1, k - first + 1) = a(1, k - first + 1) + up(k)%re
               a(2, k - first + 1) = a(2, k - first + 1) + up(k)%im
               b(1, k - first + 1) = b(1, k - first + 1) + down(k)%re
               b(2, k - first + 1) = b(2, k - first + 1) + down(k)%im
            end do
         end associate
         do k = max(first, points(1)/2 + 1), last(1)
            r = modulo(k, points(1)) + 1
            if (2*(r - 1) > points(1)) then
               ! The transform derives this half of the spectrum from the other: e^(ikX) and e^(-ikX) are conjugate.
               r = points(1) - r + 2
               spectrum(:, r, plus) = spectrum(:, r, plus) + [down(k)%re, -down(k)%im]
               spectrum(:, r, minus) = spectrum(:, r, minus) + [up(k)%re, -up(k)%im]
            else
               spectrum(:, r, plus) = spectrum(:, r, plus) + [up(k)%re, up(k)%im]
               spectrum(:, r, minus) = spectrum(:, r, minus) + [down(k)%re, down(k)%im]
            end if
         end do
      end do

   contains

      !> e^(2 pi i t)
      pure complex(dp) function turned(t)
         real(dp), intent(in) :: t

         turned = exp(cmplx(0.0_dp, 2*pi*modulo(t, 1.0_dp), dp))
      end function turned

   end subroutine give_waves

   !> A power of the frequency of a harmonic: 1 without a power, and 0 for the mean.
   pure real(dp) function factor(k, l, power, per_wave)
      integer, intent(in) :: k, l                         !! wave numbers, >= 0
      integer, intent(in), optional :: power
      real(dp), intent(in), optional :: per_wave(2)

      factor = 1.0_dp
      if (.not. present(power)) return
      factor = 0.0_dp
      if (k > 0 .or. l > 0) factor = hypot(k*per_wave(1), l*per_wave(2))**power
   end function factor

end module wavycon_wave_packing
