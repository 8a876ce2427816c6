!> Converts between the coefficients of a Fourier series and the spectrum of its values on a grid of
!> wavycon_grid_points. The rows of the spectrum are cosines for an even field, waves for any other.
module wavycon_wave_packing
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
               ! Of e^(i(kX + lY)) and e^(i(kX - lY)), which are equal for l = 0, and at all points for 2l = N.
               weight = merge(1.0_dp, 2.0_dp, k == 0 .or. 2*k == m)/(real(m, dp)*n)
               up = weight*cmplx(spectrum(1, r, l + 1), spectrum(2, r, l + 1), dp)
               down = 0.0_dp
               if (l > 0 .and. 2*l < n) down = weight*cmplx(spectrum(1, r, n - l + 1), spectrum(2, r, n - l + 1), dp)
               answer%c(k, l) = real(up + down)
               answer%sc(k, l) = -aimag(up + down)
               if (l > 0 .and. 2*l < n) then
                  answer%cs(k, l) = aimag(down - up)
                  answer%ss(k, l) = real(down - up)
               end if
            end do
         end do
      end associate
   end subroutine take_waves

   !> The inverse of `take_cosines`; the number of points may differ.
   pure subroutine give_cosines(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      real(dp), intent(inout) :: spectrum(:, :, :)        !! of the first wave numbers of the series in X

      integer :: k, l, r

      spectrum = 0.0_dp
      do l = 0, min(points(2) - 1, ubound(from%c, 2))
         do r = 1, size(spectrum, 2)
            k = lbound(from%c, 1) + r - 1
            spectrum(1, r, l + 1) = merge(1.0_dp, 0.5_dp, k == 0)*merge(1.0_dp, 0.5_dp, l == 0)* &
                                    from%c(k, l)
         end do
      end do
   end subroutine give_cosines

   !> The inverse of `take_waves`; the number of points may differ.
   pure subroutine give_waves(points, from, spectrum)
      integer, intent(in) :: points(2)                    !! M, N
      type(fourier_series), intent(in) :: from
      real(dp), intent(inout) :: spectrum(:, :, :)        !! of the first wave numbers of the series in X

      !> One half where k and -k are two waves, and whether they have sines.
      real(dp), dimension(size(spectrum, 2)) :: halves, sines
      real(dp) :: of_c, of_cs, of_sc, of_ss
      integer :: k, l, last, r
      logical :: even

      even = from%is_even()
      of_cs = 0.0_dp
      of_sc = 0.0_dp
      of_ss = 0.0_dp
      associate (m => points(1), n => points(2))
         last = min(n/2, ubound(from%c, 2))
         spectrum(:, :, last + 2:n - last) = 0.0_dp
         do r = 1, size(spectrum, 2)
            k = lbound(from%c, 1) + r - 1
            halves(r) = merge(1.0_dp, 0.5_dp, k == 0 .or. 2*k == m)
            sines(r) = merge(0.0_dp, 1.0_dp, halves(r) > 0.5_dp)
         end do
         do l = 0, last
            do r = 1, size(spectrum, 2)
               k = lbound(from%c, 1) + r - 1
               of_c = halves(r)*from%c(k, l)
               if (.not. even) then
                  of_cs = halves(r)*from%cs(k, l)
                  of_sc = halves(r)*sines(r)*from%sc(k, l)
                  of_ss = halves(r)*sines(r)*from%ss(k, l)
               end if
               if (l == 0 .or. 2*l == n) then
                  spectrum(:, r, l + 1) = [of_c, -of_sc]
               else
                  spectrum(:, r, l + 1) = 0.5_dp*[of_c - of_ss, -of_sc - of_cs]
                  spectrum(:, r, n - l + 1) = 0.5_dp*[of_c + of_ss, of_cs - of_sc]
               end if
            end do
         end do
      end associate
   end subroutine give_waves

end module wavycon_wave_packing
