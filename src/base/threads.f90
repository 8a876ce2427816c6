!> How many threads work on large grids.
module wavycon_threads
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_fftw, only: fftw_init_threads, fftw_plan_with_nthreads
   implicit none (type, external)
   private

   public :: set_threads, threads_for, use_threads_for_transforms

   !> Below so many points a thread costs more than it gains.
   integer, parameter :: least_points = 65536

   integer :: threads = 1
   logical :: transforms_ready = .false.

contains

   !> Sets the number for all that follows; 1 until then.
   subroutine set_threads(number)
      integer, intent(in) :: number   !! >= 1

      threads = number
      if (number > 1 .and. .not. transforms_ready) transforms_ready = fftw_init_threads() /= 0
   end subroutine set_threads

   !> The threads that a grid of some points is worth.
   integer function threads_for(points)
      integer, intent(in) :: points

      threads_for = merge(threads, 1, points >= least_points)
   end function threads_for

   !> Sets the number of threads of the transforms planned from now on.
   subroutine use_threads_for_transforms(points)
      integer, intent(in) :: points   !! of the grid

      if (transforms_ready) call fftw_plan_with_nthreads(int(threads_for(points), c_int))
   end subroutine use_threads_for_transforms

end module wavycon_threads
