!> The own waves of a Fourier series: all waves or, if the series is distributed, those of some wave numbers in X.
module wavycon_own_waves
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: gather_series, slab_of_waves, wave_slab

contains

   !> The own wave numbers in X of a series, as columns of a grid: wave number k is column k + 1.
   type(grid_slab) function wave_slab(series)
      type(fourier_series), intent(in) :: series

      wave_slab = slab_of_waves(merge(series%distributed_waves, series%last(1) + 1, series%is_distributed()), &
                                series%is_distributed())
   end function wave_slab

   type(grid_slab) function slab_of_waves(number, is_distributed) result(slab)
      integer, intent(in) :: number       !! of wave numbers
      logical, intent(in) :: is_distributed

      if (is_distributed) then
         call slab%divide([1, number])
      else
         call slab%start([1, number], whole=.true.)
      end if
   end function slab_of_waves

   !> Gathers a distributed series, on the rank that writes the tables or on all; on other ranks it stays as it is.
   subroutine gather_series(series, first_only)
      type(fourier_series), intent(inout) :: series
      logical, intent(in) :: first_only   !! whether only where tables are written

      real(dp), allocatable :: own(:, :), whole(:, :)   ! real parts of the waves, and then the imaginary ones
      integer :: last, numbers
      type(grid_slab) :: rows

      rows = wave_slab(series)
      if (.not. rows%any(rows%is_distributed .and. rows%first == 1)) return
      last = series%last(2)
      if (series%is_even()) then
         own = transpose(series%c)
      else
         own = transpose(reshape([series%wave%re, series%wave%im], [size(series%wave, 1), 2*size(series%wave, 2)]))
      end if
      call rows%gather_whole(own, whole, first_only)
      if (.not. allocated(whole)) return
      series%distributed_waves = 0
      if (series%is_even()) then
         deallocate (series%c)
         allocate (series%c(0:size(whole, 2) - 1, 0:last), source=transpose(whole))
      else
         numbers = 2*last + 1
         deallocate (series%wave)
         allocate (series%wave(0:size(whole, 2) - 1, -last:last), &
                   source=transpose(cmplx(whole(:numbers, :), whole(numbers + 1:, :), dp)))
      end if
   end subroutine gather_series

end module wavycon_own_waves
