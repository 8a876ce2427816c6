!> The contact area as the number of points in contact, and its correction by the number of changes along the lines of
!> the grid. Both are for comparison with other programs: (C26) of src/contact/README.md.
module wavycon_counted_area
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: corrected_area_fraction, counted_area_fraction, edge_crossings

   !> c of (C26), the area by which each change makes the counted area too large, in cells of the grid.
   real(dp), parameter :: area_of_change = (pi - 1.0_dp + log(2.0_dp))/24

contains

   !> Points in contact over all points.
   real(dp) function counted_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      fraction = edge%points_in_contact()/real(edge%number_of_points(), dp)
   end function counted_area_fraction

   !> The counted area less c for each change from contact to gap (C26).
   real(dp) function corrected_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge   !! of a surface: a profile has no lines in a second direction

      fraction = counted_area_fraction(edge) - area_of_change*edge_crossings(edge)/edge%number_of_points()
   end function corrected_area_fraction

   !> Number of pairs of neighbouring points of the grid, along both directions, of which one is in contact and the
   !> other is not. On a whole cell the last points are neighbours of the first; on a quarter those next to a mirror
   !> line have their own images as neighbours.
   integer(int64) function edge_crossings(edge) result(crossings)
      type(grid_edge), intent(in) :: edge   !! with the columns of the neighbours, if the grid is distributed

      logical :: here(0:edge%slab%points(1) + 1), next(0:edge%slab%points(1) + 1)
      integer(int64) :: total(1)
      integer :: j, m

      m = edge%slab%points(1)
      total = 0
      if (edge%slab%columns() > 0) next = edge%column(edge%slab%first) > 0.0_dp
      do j = edge%slab%first, edge%slab%last
         here = next
         next = edge%column(j + 1) > 0.0_dp
         total = total + count(here(1:m) .neqv. here(2:)) + count(here(1:m) .neqv. next(1:m))
      end do
      call edge%slab%add(total)
      crossings = total(1)
   end function edge_crossings

end module wavycon_counted_area
