!> Notes when each grid of a load is solved.
module grid_clock
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   use wavycon_solver_progress, only: solver_progress
   implicit none (type, external)
   private

   public :: grid_times, start_grid_clock, wall_clock

   !> What is noted of the last grid. `solver_progress` is constant to those who call it: the notes are kept here.
   real(dp), protected, public :: grid_started = 0.0_dp, grid_solved_at = 0.0_dp   !! [s]
   integer, protected, public :: grid_iterations = 0
   !> Iterations of all grids, in units of one on this grid: one on a grid with half the points each way is a quarter.
   real(dp), protected, public :: equal_iterations = 0.0_dp

   type, extends(solver_progress) :: grid_times
   contains
      procedure :: grid_solved
   end type grid_times

contains

   !> The time since some moment [s].
   real(dp) function wall_clock()
      integer(int64) :: count, rate

      call system_clock(count, rate)
      wall_clock = real(count, dp)/rate
   end function wall_clock

   !> Starts a load.
   subroutine start_grid_clock()
      grid_solved_at = wall_clock()
      equal_iterations = 0.0_dp
   end subroutine start_grid_clock

   subroutine grid_solved(self, points, iterations, local_iterations, plain_iterations, residual)
      class(grid_times), intent(in) :: self
      integer, intent(in) :: points(2), iterations, local_iterations, plain_iterations
      real(dp), intent(in) :: residual

      associate (unused => self, unused_too => points, others => [local_iterations, plain_iterations], one => residual)
      end associate
      grid_started = grid_solved_at
      grid_solved_at = wall_clock()
      grid_iterations = iterations
      equal_iterations = equal_iterations/4 + iterations
   end subroutine grid_solved

end module grid_clock
