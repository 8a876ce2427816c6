!> The contact area as the number of points in contact, and its correction by the number of changes along the lines of
!> the grid. Both are for comparison with other programs: (C26) of src/contact/README.md.
module wavycon_counted_area
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
   pure real(dp) function counted_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      fraction = count(edge%pressure_or_gap > 0.0_dp)/real(size(edge%pressure_or_gap), dp)
   end function counted_area_fraction

   !> The counted area less c for each change from contact to gap (C26).
   pure real(dp) function corrected_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge   !! of a surface: a profile has no lines in a second direction

      fraction = counted_area_fraction(edge) - area_of_change*edge_crossings(edge)/size(edge%pressure_or_gap)
   end function corrected_area_fraction

   !> Number of pairs of neighbouring points, along both directions, of which one is in contact and the other is not. On
   !> a whole cell the last points are neighbours of the first; on a quarter those next to a mirror line have their own
   !> images as neighbours.
   pure integer function edge_crossings(edge) result(crossings)
      type(grid_edge), intent(in) :: edge

      associate (field => edge%pressure_or_gap, m => size(edge%pressure_or_gap, 1), n => size(edge%pressure_or_gap, 2))
         crossings = count((field(:m - 1, :) > 0.0_dp) .neqv. (field(2:, :) > 0.0_dp)) &
                     + count((field(:, :n - 1) > 0.0_dp) .neqv. (field(:, 2:) > 0.0_dp))
         if (.not. edge%even) crossings = crossings + count((field(1, :) > 0.0_dp) .neqv. (field(m, :) > 0.0_dp)) &
                                          + count((field(:, 1) > 0.0_dp) .neqv. (field(:, n) > 0.0_dp))
      end associate
   end function edge_crossings

end module wavycon_counted_area
