!> How close a spot or a pool is to merging with its neighbours.
module wavycon_merging_ratio
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   use wavycon_shape_search, only: distance_from_edge, edge_points
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: merging_ratio

contains

   !> The part of the way to the midpoint towards the nearest neighbour that a spot or pool takes up: 0 for a point, 1
   !> where it touches its neighbour, more where they overlap.
   pure real(dp) function merging_ratio(lattice, now) result(ratio)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      complex(dp), allocatable :: midpoints(:)
      integer :: i

      if (now%pool) then
         allocate (midpoints, source=lattice%to_next_trough)
      else
         allocate (midpoints, source=lattice%to_next_crest)
      end if
      ratio = maxval([(ratio_towards(now%shape, midpoints(i)), i=1, size(midpoints))])
   end function merging_ratio

   !> The same towards one midpoint.
   pure real(dp) function ratio_towards(shape, midpoint) result(ratio)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: midpoint   !! from the shape's centre [s]

      !> Sine of an angle that counts as 0.
      real(dp), parameter :: rounding = 1e-12_dp
      complex(dp) :: direction

      direction = midpoint/abs(midpoint)
      associate (rotated => direction**shape%fold)
         if (abs(rotated%im) < rounding) then
            ! On an axis of symmetry the edge's nearest point is that of the same angle in the disc.
            ratio = abs(shape%place(direction))/abs(midpoint)
         else
            ! Tips off the axes, as long spots have, come to the midpoint from the side.
            ratio = 1.0_dp - distance_from_edge(shape, edge_points(shape), midpoint)/abs(midpoint)
         end if
      end associate
   end function ratio_towards

end module wavycon_merging_ratio
