!> What a solver calls within a load: to display its progress, and to ask whether it shall stop.
module wavycon_solver_progress
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solver_progress

   type :: solver_progress
   contains
      procedure :: grid_solved
      procedure :: shall_stop
   end type solver_progress

contains

   !> Called after each grid. Here nothing is done.
   subroutine grid_solved(self, points, iterations, residual)
      class(solver_progress), intent(in) :: self
      integer, intent(in) :: points(2)     !! of the grid, on the whole cell along x and y
      integer, intent(in) :: iterations    !! on this grid
      real(dp), intent(in) :: residual     !! (C9)

      associate (unused => self, also_unused => points, unused_too => iterations, not_used => residual); end associate
   end subroutine grid_solved

   !> Whether the solver shall leave the load, which then has the status `interrupted`. Asked before each load that a
   !> solver solves, also those of a search, and before each iteration on a grid. Here the answer is no. All ranks must
   !> give the same one.
   logical function shall_stop(self, iterations, residual)
      class(solver_progress), intent(in) :: self
      integer, intent(in) :: iterations    !! of this correction of the pressure; 0 before a load
      real(dp), intent(in) :: residual     !! root mean square of the violated conditions [Delta]; 1 before a load

      associate (unused => self, unused_too => iterations, also_unused => residual); end associate
      shall_stop = .false.
   end function shall_stop

end module wavycon_solver_progress
