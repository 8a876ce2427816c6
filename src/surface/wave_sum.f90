!> A sum of any waves that are periodic on one cell.
module wavycon_wave_sum
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_of_series, surface_type
   implicit none (type, external)
   private

   public :: wave_sum

contains

   !> h = Delta - sum_q a_q cos(m_q X + n_q Y - phase_q), X = 2 pi x/L_x, Y = 2 pi y/L_y. Delta is the largest value of
   !> the sum, so that the surfaces just touch.
   type(surface_type) function wave_sum(length, a, m, n, phase) result(surface)
      real(dp), intent(in) :: length(2)      !! L_x, L_y [length], > 0
      real(dp), intent(in) :: a(:)           !! amplitudes [length], of either sign
      integer, intent(in) :: m(:), n(:)      !! wave numbers, shape of a; not both zero; all n = 0 for a profile
      real(dp), intent(in) :: phase(:)       !! phases [rad], shape of a

      !> If all sine coefficients are below this fraction of the sum of the amplitudes they are rounding: the sum is
      !> even.
      real(dp), parameter :: rounding = 1e-15_dp
      type(fourier_series) :: waves
      integer :: k, l, q
      real(dp) :: turn

      allocate (waves%c(0:maxval(abs(m)), 0:maxval(abs(n))), source=0.0_dp)
      allocate (waves%cs, waves%sc, waves%ss, source=waves%c)
      do q = 1, size(a)
         k = abs(m(q))
         l = abs(n(q))
         ! cos(mX + nY - phase) with m >= 0.
         turn = merge(phase(q), -phase(q), m(q) >= 0)
         associate (up => sign(1, n(q))*merge(1, -1, m(q) >= 0))
            waves%c(k, l) = waves%c(k, l) + a(q)*cos(turn)
            if (k > 0 .and. l > 0) waves%ss(k, l) = waves%ss(k, l) - up*a(q)*cos(turn)
            if (k > 0) waves%sc(k, l) = waves%sc(k, l) + a(q)*sin(turn)
            if (l > 0) waves%cs(k, l) = waves%cs(k, l) + up*a(q)*sin(turn)
         end associate
      end do
      if (max(maxval(abs(waves%cs)), maxval(abs(waves%sc)), maxval(abs(waves%ss))) <= rounding*sum(abs(a))) &
         deallocate (waves%cs, waves%sc, waves%ss)
      surface = surface_of_series(length, waves)
   end function wave_sum

end module wavycon_wave_sum
