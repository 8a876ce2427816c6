!> Interface to a procedure that a solver calls within a load, to display its progress.
module wavycon_solver_progress
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solver_progress

   type, abstract :: solver_progress
   contains
      procedure(grid_is_solved), deferred :: grid_solved
   end type solver_progress

   abstract interface
      !> Called after each grid.
      subroutine grid_is_solved(self, points, iterations, local_iterations, plain_iterations, residual)
         import :: dp, solver_progress
         class(solver_progress), intent(in) :: self
         integer, intent(in) :: points(2)     !! of the grid, on the whole cell along x and y
         integer, intent(in) :: iterations    !! on this grid
         integer, intent(in) :: local_iterations   !! those of them preconditioned by the stencil
         integer, intent(in) :: plain_iterations   !! those without extension of the gap
         real(dp), intent(in) :: residual     !! (C9)
      end subroutine grid_is_solved
   end interface

end module wavycon_solver_progress
