!> The number of threads: of large grids, and of BLAS and LAPACK.
module wavycon_threads
   implicit none (type, external)
   private

   public :: set_threads, threads_for, use_one_thread_for_matrices

   !> Grids with fewer points are solved by one thread: starting more costs more time than they save.
   integer, parameter :: least_points = 65536

   integer :: threads = 1

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
   end subroutine set_threads

   !> The number of threads for a grid.
   integer function threads_for(points)
      integer, intent(in) :: points   !! of the grid

      threads_for = merge(threads, 1, points >= least_points)
   end function threads_for

end module wavycon_threads
