!> Whether a shape is a wave of Johnson, Greenwood & Higginson (1985).
module wavycon_paper_wave
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: paper_wave_of

   !> Whether a shape is a wave of the paper, and in which angles. Straight: eq. (3) or (21) with phi = X, theta = Y.
   !> Turned: eq. (21) with phi = (X + Y)/2, theta = (X - Y)/2.
   integer, parameter, public :: no_paper_wave = 0, straight_paper_wave = 1, rotated_paper_wave = 2

   !> Coefficients of a shape that differ by less than this are equal.
   real(dp), parameter, public :: rounding = 1e-13_dp

contains

   pure integer function paper_wave_of(shape, dimension, is_square) result(paper_wave)
      type(fourier_series), intent(in) :: shape   !! whole
      integer, intent(in) :: dimension
      logical, intent(in) :: is_square            !! whether the cell is

      paper_wave = no_paper_wave
      if (.not. shape%is_even()) return
      if (dimension == 1) then
         if (is_wave(1, 0)) paper_wave = straight_paper_wave
      else if (is_square) then
         if (is_wave(1, 1)) paper_wave = straight_paper_wave
         if (is_wave(1, 0)) paper_wave = rotated_paper_wave
      end if

   contains

      !> Whether the shape is cos iX cos jY or, for i /= j, the mean of that and cos jX cos iY.
      pure logical function is_wave(i, j)
         integer, intent(in) :: i, j

         real(dp) :: expected
         integer :: k, l

         is_wave = i <= ubound(shape%c, 1) .and. (dimension == 1 .or. i <= ubound(shape%c, 2))
         if (.not. is_wave) return
         do l = 0, ubound(shape%c, 2)
            do k = 0, ubound(shape%c, 1)
               expected = 0.0_dp
               if (k == i .and. l == j) expected = merge(1.0_dp, 0.5_dp, i == j .or. dimension == 1)
               if (k == j .and. l == i .and. i /= j) expected = 0.5_dp
               is_wave = is_wave .and. abs(shape%c(k, l) - expected) <= rounding
            end do
         end do
      end function is_wave

   end function paper_wave_of

end module wavycon_paper_wave
