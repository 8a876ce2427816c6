!> What is called after each grid of a sequence, to show the progress of a long solution.
module wavycon_grid_progress
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_progress

   type, abstract :: grid_progress
   contains
      procedure(grid_is_solved), deferred :: grid_solved
   end type grid_progress

   abstract interface
      !> Reports one grid.
      subroutine grid_is_solved(self, points, iterations, residual)
         import :: dp, grid_progress
         class(grid_progress), intent(in) :: self
         integer, intent(in) :: points(2)     !! of the whole cell
         integer, intent(in) :: iterations    !! on this grid
         real(dp), intent(in) :: residual     !! (C9) of README.md in this directory [-]
      end subroutine grid_is_solved
   end interface

end module wavycon_grid_progress
