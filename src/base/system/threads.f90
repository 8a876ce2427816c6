!> How many threads work on a grid.
module wavycon_threads
   implicit none (type, external)
   private

   public :: set_threads, threads_for

   !> Loops over fewer points have one thread. With two threads for loops over 65536 points and more, a load on 512 x
   !> 512 points took 1.0 to 1.1 times the time with one thread, a load on 1024 x 1024 points 0.8 times.
   integer, parameter :: least_points = 524288

   integer :: threads = 1   !! number of threads of loops over `least_points` points and more

contains

   !> Sets the number of threads from now on. Before the first call the number is 1.
   subroutine set_threads(number)
      integer, intent(in) :: number   !! number of threads; numbers below 1 count as 1

      threads = max(1, number)
   end subroutine set_threads

   !> The number of threads for a loop over points of a grid.
   integer function threads_for(points)
      integer, intent(in) :: points   !! number of points of the loop

      threads_for = 1
      if (points >= least_points) threads_for = threads
   end function threads_for

end module wavycon_threads
