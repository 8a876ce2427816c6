!> Gathers the waves of a Fourier series that is distributed.
module wavycon_own_waves
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: gather_series

contains

   !> Gathers a distributed series, on the rank that writes the tables or on all; on other ranks it stays as it is.
   subroutine gather_series(series, first_only)
      type(fourier_series), intent(inout) :: series
      logical, intent(in) :: first_only   !! whether only where tables are written

      real(dp), allocatable :: own(:, :), whole(:, :)   ! real parts of the waves, and then the imaginary ones
      integer :: last, numbers
      logical :: even

      if (.not. series%rows%any(series%is_distributed() .and. series%first() == 0)) return
      even = series%is_even()
      last = series%last(2)
      if (even) then
         own = transpose(series%c)
      else
         own = transpose(reshape([series%wave%re, series%wave%im], [size(series%wave, 1), 2*size(series%wave, 2)]))
      end if
      call series%rows%gather_whole(own, whole, first_only)
      if (.not. allocated(whole)) return
      series = fourier_series()
      if (even) then
         allocate (series%c(0:size(whole, 2) - 1, 0:last), source=transpose(whole))
      else
         numbers = 2*last + 1
         allocate (series%wave(0:size(whole, 2) - 1, -last:last), &
                   source=transpose(cmplx(whole(:numbers, :), whole(numbers + 1:, :), dp)))
      end if
   end subroutine gather_series

end module wavycon_own_waves
