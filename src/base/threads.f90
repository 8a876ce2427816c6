!> The number of threads: of large grids, and of BLAS and LAPACK.
module wavycon_threads
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_fftw, only: fftw_init_threads, fftw_plan_with_nthreads
   implicit none (type, external)
   private

   public :: set_threads, threads_for, use_one_thread_for_matrices, use_threads_for_transforms

   !> Grids with fewer points are solved by one thread: starting more costs more time than they save.
   integer, parameter :: least_points = 65536

   integer :: threads = 1
   logical :: transforms_ready = .false.

   interface
      !> Makes BLAS and LAPACK use one thread, if they are OpenBLAS or MKL. By default these take all processors, also
      !> for the small matrices here, which other threads do not make faster.
      !>
      !> N.B. It acts on the whole process: for programs, not for procedures of a library.
      subroutine use_one_thread_for_matrices() bind(c, name='wavycon_use_one_thread_for_matrices')
      end subroutine use_one_thread_for_matrices
   end interface

contains

   !> Sets the number of threads from now on; before the first call it is 1.
   subroutine set_threads(number)
      integer, intent(in) :: number   !! >= 1; a smaller one counts as 1

      threads = max(1, number)
      if (number > 1 .and. .not. transforms_ready) transforms_ready = fftw_init_threads() /= 0
   end subroutine set_threads

   !> The number of threads for a grid.
   integer function threads_for(points)
      integer, intent(in) :: points   !! of the grid

      threads_for = merge(threads, 1, points >= least_points)
   end function threads_for

   !> Sets the number of threads of the Fourier transforms that are planned from now on.
   subroutine use_threads_for_transforms(points)
      integer, intent(in) :: points   !! of the grid

      if (transforms_ready) call fftw_plan_with_nthreads(int(threads_for(points), c_int))
   end subroutine use_threads_for_transforms

end module wavycon_threads
