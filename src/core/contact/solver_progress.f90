!> Procedures that a solver calls within a load: one displays the progress, the other tells whether the solver shall
!> stop. An extension of the type replaces these defaults, which do nothing.
module wavycon_solver_progress
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solver_progress

   type :: solver_progress
   contains
      procedure :: grid_solved, shall_stop
   end type solver_progress

contains

   !> Called after each grid that is solved.
   subroutine grid_solved(self, points, iterations, residual)
      class(solver_progress), intent(in) :: self
      integer, intent(in) :: points(2)     !! points of the grid on the whole cell along x and y
      integer, intent(in) :: iterations    !! number of iterations on this grid
      real(dp), intent(in) :: residual     !! residual (C9) of README.md in this directory

      associate (unused => self, also_unused => points, unused_too => iterations, not_used => residual); end associate
   end subroutine grid_solved

   !> Whether the solver shall stop. The load then has the status `interrupted`. A solver calls this before each load,
   !> also within a search for a load, and before each iteration on a grid. All processes must return the same answer.
   logical function shall_stop(self, iterations, residual)
      class(solver_progress), intent(in) :: self
      integer, intent(in) :: iterations    !! iterations of this correction of the pressure so far; 0 before a load
      !> Residual (C9), at most 1: before a load, and as long as the violated conditions are larger than the mean gap.
      real(dp), intent(in) :: residual

      associate (unused => self, unused_too => iterations, also_unused => residual); end associate
      shall_stop = .false.
   end function shall_stop

end module wavycon_solver_progress
