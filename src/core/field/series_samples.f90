!> Evaluates a Fourier series at the points of a grid on its cell, by one fast Fourier transform.
module wavycon_series_samples
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, pi
   use wavycon_wave_packing, only: fold_waves
   implicit none (type, external)
   private

   public :: sample_series

contains

   !> The values of a series at X = 2 pi (k + offset_x)/(parts_x N_x), k = 0 .. N_x - 1, and the same in Y. The values
   !> are exact for any number of points: a wave that is too short for the points has the same values there as a longer
   !> wave, its alias, and is added to the alias.
   subroutine sample_series(series, points, offset, values, maps_in_cell)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! distance of the first point from the origin, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)
      integer, intent(in) :: maps_in_cell(2)   !! how often the points fit into the cell along x and y, 1 or 2

      complex(dp) :: turn_x(0:series%last(1))
      complex(dp), allocatable :: waves(:, :)
      type(grid_transform) :: transform
      integer :: k, l, whole(2)   ! whole: points of the grid on the whole cell

      whole = maps_in_cell*points
      allocate (values(whole(1), whole(2)))
      call transform%start(whole, even=.false., whole=.true.)
      allocate (waves(whole(1)/2 + 1, whole(2)), source=(0.0_dp, 0.0_dp))
      turn_x = turn(2*pi*modulo([(k*offset(1)/whole(1), k=0, series%last(1))], 1.0_dp))
      do l = -series%last(2), series%last(2)
         associate (turn_y => turn(2*pi*modulo(l*offset(2)/whole(2), 1.0_dp)))
            call fold_waves(whole, l, 0, 0.5_dp*turn_y*turn_x*series%row(l, series%last(1)), waves)
         end associate
      end do
      call transform%sample_waves(waves, values)
      if (any(maps_in_cell > 1)) values = values(:points(1), :points(2))
   end subroutine sample_series

end module wavycon_series_samples
