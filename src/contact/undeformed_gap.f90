!> The gap before deformation at the points of a grid.
module wavycon_undeformed_gap
   use wavycon_constants, only: pi
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: sample_undeformed_gap

contains

   !> h/Delta at the points of a grid. Waves of the surface beyond the grid's highest wave number are left out. The
   !> digits do not depend on how the grid and the surface are distributed.
   subroutine sample_undeformed_gap(surface, slab, h)
      type(surface_type), intent(in) :: surface
      type(grid_slab), intent(in) :: slab                !! of the grid, of a quarter of the cell if the surface is even
      real(dp), intent(out), contiguous :: h(:, :)       !! shape (M, slab%columns())

      type(grid_transform) :: transform

      call transform%start(slab%points, surface%shape%is_even())
      call transform%sample(surface%shape, h)
      call surface%subtract_form(h, [transform%x_angle(1), transform%y_angle(slab%first)], &
                                 2*pi/(surface%parts()*slab%points))
      h = 1.0_dp - h
   end subroutine sample_undeformed_gap

end module wavycon_undeformed_gap
