!> Word of each grid as it is solved, for whoever wants to show it.
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
      subroutine grid_is_solved(self, points, iterations, residual)
         import :: dp, grid_progress
         class(grid_progress), intent(in) :: self
         integer, intent(in) :: points(2)     !! of the whole cell
         integer, intent(in) :: iterations
         real(dp), intent(in) :: residual     !! relative
      end subroutine grid_is_solved
   end interface

end module wavycon_grid_progress
