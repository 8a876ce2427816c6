!> How many threads work on a grid.
module wavycon_threads
   implicit none (type, external)
   private

   public :: set_threads, threads_for

   !> Loops over fewer points take one thread. Where two threads had loops over 65536 points and more, a load on
   !> 512 x 512 points took 1.0 to 1.1 of the time with one thread, on 1024 x 1024 points 0.8.
   integer, parameter :: least_points = 524288

   integer :: threads = 1

contains

   !> Sets the number of threads from now on; before the first call it is 1.
   subroutine set_threads(number)
      integer, intent(in) :: number   !! >= 1; a smaller one counts as 1

      threads = max(1, number)
   end subroutine set_threads

   !> The number of threads for a loop over the points of a grid or of a part of it.
   integer function threads_for(points)
      integer, intent(in) :: points

      threads_for = merge(threads, 1, points >= least_points)
   end function threads_for

end module wavycon_threads
