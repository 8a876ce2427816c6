!> Fourier series whose terms are multiplied by powers of their frequencies, and series divided by numbers.
module wavycon_series_weights
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: divide_series, divided, weighted

contains

   !> A series with each term multiplied by a power of its frequency, one over its wavelength; the mean becomes 0.
   pure type(fourier_series) function weighted(series, length, power)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: length(2)   !! sides of the cell along x and y, > 0
      integer, intent(in) :: power        !! not 0

      real(dp) :: weight(lbound(series%c, 1):ubound(series%c, 1))
      logical :: has_mean
      integer :: i, j

      weighted = series
      do j = 0, ubound(series%c, 2)
         has_mean = j == 0 .and. lbound(series%c, 1) == 0
         weight = hypot([(i, i=lbound(series%c, 1), ubound(series%c, 1))]/length(1), j/length(2))
         if (has_mean) weight(0) = 1.0_dp
         weight = weight**power
         if (has_mean) weight(0) = 0.0_dp
         weighted%c(:, j) = weight*series%c(:, j)
         if (series%is_even()) cycle
         weighted%cs(:, j) = weight*series%cs(:, j)
         weighted%sc(:, j) = weight*series%sc(:, j)
         weighted%ss(:, j) = weight*series%ss(:, j)
      end do
   end function weighted

   !> A series divided by a number; unchanged if that is 0.
   pure type(fourier_series) function divided(series, unit)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: unit

      divided = series
      if (abs(unit) > 0.0_dp) call divide_series(divided, unit)
   end function divided

   !> Divides a series by a number in place.
   pure subroutine divide_series(series, unit)
      type(fourier_series), intent(inout) :: series
      real(dp), intent(in) :: unit   !! not 0

      series%c = series%c/unit
      if (series%is_even()) return
      series%cs = series%cs/unit
      series%sc = series%sc/unit
      series%ss = series%ss/unit
   end subroutine divide_series

end module wavycon_series_weights
