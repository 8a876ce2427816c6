!> Progress of a solver within one load, for a caller that wants to display it.
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
      subroutine grid_is_solved(self, points, iterations, residual)
         import :: dp, solver_progress
         class(solver_progress), intent(in) :: self
         integer, intent(in) :: points(2)     !! of the whole cell
         integer, intent(in) :: iterations
         real(dp), intent(in) :: residual     !! relative
      end subroutine grid_is_solved
   end interface

end module wavycon_solver_progress
