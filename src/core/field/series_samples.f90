!> A series at the points of a grid of its cell, by one transform.
module wavycon_series_samples
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: sample_series

contains

   !> The values at X = 2 pi (k + offset_x)/(parts_x N_x), k = 0 .. N_x - 1, and the same in Y. They are exact for any
   !> number of points: waves that the points cannot tell from slower ones are added to those.
   subroutine sample_series(series, points, offset, values, parts)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! of the first point, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)
      integer, intent(in) :: parts(2)   !! how often the points fit into the cell along x and y, 1 or 2

      complex(dp) :: turn_x(-ubound(series%c, 1):ubound(series%c, 1)), turn_y(-ubound(series%c, 2):ubound(series%c, 2))
      complex(dp) :: wave
      complex(dp), allocatable :: waves(:, :)
      type(grid_transform) :: transform
      integer :: i, j, sign_x, sign_y, k, l, whole(2)   ! whole: points of the cell

      whole = parts*points
      allocate (values(whole(1), whole(2)))
      call transform%start(whole, even=.false., whole=.true.)
      allocate (waves(whole(1)/2 + 1, whole(2)), source=(0.0_dp, 0.0_dp))
      turn_x = turns(ubound(turn_x, 1), 1)
      turn_y = turns(ubound(turn_y, 1), 2)
      ! cos iX cos jY is a quarter of the sum of e^(+-iX +-jY); each sine brings a factor of -+i.
      do sign_y = -1, 1, 2
         do sign_x = -1, 1, 2
            do j = 0, ubound(series%c, 2)
               l = modulo(sign_y*j, whole(2))
               do i = 0, ubound(series%c, 1)
                  ! The transform derives the other half of the spectrum from this one.
                  k = modulo(sign_x*i, whole(1))
                  if (2*k > whole(1)) cycle
                  wave = series%c(i, j)
                  if (.not. series%is_even()) wave = wave &
                     - cmplx(sign_x*sign_y*series%ss(i, j), sign_y*series%cs(i, j) + sign_x*series%sc(i, j), dp)
                  waves(k + 1, l + 1) = waves(k + 1, l + 1) + 0.25_dp*wave*turn_x(sign_x*i)*turn_y(sign_y*j)
               end do
            end do
         end do
      end do
      call transform%sample_waves(waves, values)
      if (any(parts > 1)) values = values(:points(1), :points(2))

   contains

      !> e^(2 pi i k offset/N) of the waves k = -last .. last.
      pure function turns(last, direction)
         integer, intent(in) :: last, direction
         complex(dp) :: turns(-last:last)

         integer :: k

         turns(0:) = [(exp(cmplx(0.0_dp, 2*pi*modulo(k*offset(direction)/whole(direction), 1.0_dp), dp)), k=0, last)]
         turns(:-1) = conjg(turns(last:1:-1))
      end function turns

   end subroutine sample_series

end module wavycon_series_samples
