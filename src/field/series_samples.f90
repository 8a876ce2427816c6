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
      !> How often the points fit into the cell along x and y, 1 or 2; 1 if absent.
      integer, intent(in), optional :: parts(2)

      if (present(parts)) then
         call sample_whole(series, parts*points, offset, values)
         values = values(:points(1), :points(2))
      else
         call sample_whole(series, points, offset, values)
      end if
   end subroutine sample_series

   !> The values on a whole cell.
   subroutine sample_whole(series, points, offset, values)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! of the first point, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)

      complex(dp), allocatable :: turn_x(:), turn_y(:), waves(:, :)
      complex(dp) :: wave
      type(grid_transform) :: transform
      integer :: i, j, sign_x, sign_y, k, l

      allocate (values(points(1), points(2)))
      call transform%start(points, even=.false., whole=.true.)
      allocate (waves(points(1)/2 + 1, points(2)), source=(0.0_dp, 0.0_dp))
      allocate (turn_x, source=turns(ubound(series%c, 1), 1))
      allocate (turn_y, source=turns(ubound(series%c, 2), 2))
      ! cos iX cos jY is a quarter of the sum of e^(+-iX +-jY); each sine brings a factor of -+i.
      do sign_y = -1, 1, 2
         do sign_x = -1, 1, 2
            do j = 0, ubound(series%c, 2)
               l = modulo(sign_y*j, points(2))
               do i = 0, ubound(series%c, 1)
                  ! The transform derives the other half of the spectrum from this one.
                  k = modulo(sign_x*i, points(1))
                  if (2*k > points(1)) cycle
                  wave = series%c(i, j)
                  if (.not. series%is_even()) wave = wave &
                     - cmplx(sign_x*sign_y*series%ss(i, j), sign_y*series%cs(i, j) + sign_x*series%sc(i, j), dp)
                  waves(k + 1, l + 1) = waves(k + 1, l + 1) &
                     + 0.25_dp*wave*rotated(turn_x(i + 1), sign_x)*rotated(turn_y(j + 1), sign_y)
               end do
            end do
         end do
      end do
      call transform%sample_waves(waves, values)

   contains

      !> e^(2 pi i k offset/N) of the waves k = 0 .. last.
      pure function turns(last, direction)
         integer, intent(in) :: last, direction
         complex(dp) :: turns(last + 1)

         integer :: wave_number

         turns = [(exp(cmplx(0.0_dp, 2*pi*modulo(wave_number*offset(direction)/points(direction), 1.0_dp), dp)), &
                   wave_number=0, last)]
      end function turns

      elemental complex(dp) function rotated(turn, direction)
         complex(dp), intent(in) :: turn
         integer, intent(in) :: direction   !! 1 or -1

         rotated = cmplx(turn%re, direction*turn%im, dp)
      end function rotated

   end subroutine sample_whole

end module wavycon_series_samples
