!> How large an expansion is: its sequence of degrees, its number of shape terms, and the clustering of its map; and how
!> close a spot or a pool is to merging with its neighbours, on which they depend.
module wavycon_expansion_size
   use wavycon_expansion, only: expansion
   use wavycon_fitted_tuning, only: degree_per_shape_term, degree_per_shape_term_twofold, degree_step, first_degree, &
      full_step_degree, pool_clustering, pool_clustering_power, least_clustering, round_shape_ratio, &
      spot_clustering, spot_clustering_power
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   use wavycon_shape_search, only: distance_from_edge, edge_points
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: merging_ratio, next_clustering, next_degree, shape_terms

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

   !> The degree after this one: by a half or a full step.
   !>
   !> Four-fold shapes take half steps at low degrees, and further on while they are round, where terms that vary with
   !> the angle matter less. Other shapes are nearly of a higher symmetry than their own; half a step would add next to
   !> nothing.
   pure integer function next_degree(degree, fold, merging_ratio)
      integer, intent(in) :: degree, fold
      real(dp), intent(in) :: merging_ratio   !! of the shape

      logical :: half

      half = degree < first_degree
      if (fold == 4) half = degree < full_step_degree .or. (degree < 12 .and. merging_ratio < round_shape_ratio)
      next_degree = degree + merge(degree_step/2, degree_step, half)
   end function next_degree

   !> Number K of terms of the shape for a degree of the polynomials.
   pure integer function shape_terms(degree, fold, merging_ratio)
      integer, intent(in) :: degree, fold
      real(dp), intent(in) :: merging_ratio   !! of the shape

      if (fold == 2) then
         ! Vary the number of terms with the degree; otherwise differences of degrees underestimate the area's error.
         shape_terms = degree/degree_per_shape_term_twofold
         return
      end if
      shape_terms = degree/degree_per_shape_term + 1
      ! Low degrees do not determine as many.
      if (degree < 12) shape_terms = (degree + 1)/degree_per_shape_term
      ! The highest power of conj(w) is about the same for all symmetries. More terms of six-fold shapes are not
      ! determined, but for sharp tips.
      if (fold < 4 .or. merging_ratio < round_shape_ratio) shape_terms = nint(4.0_dp*shape_terms/fold)
   end function shape_terms

   !> The map's clustering tau for the next degree, on the square lattice: a power of the merging ratio. Small changes
   !> are not made, and rises are limited to what Newton's method follows.
   pure real(dp) function next_clustering(tau, merging_ratio, pool)
      real(dp), intent(in) :: tau             !! of the shape at hand
      real(dp), intent(in) :: merging_ratio   !! of the shape
      logical, intent(in) :: pool

      associate (ratio => min(merging_ratio, 1.0_dp))
         next_clustering = merge(pool_clustering*ratio**pool_clustering_power, &
                                 spot_clustering*ratio**spot_clustering_power, pool)
      end associate
      if (next_clustering < least_clustering) next_clustering = 0.0_dp
      if (abs(next_clustering - tau) < 0.2_dp*next_clustering) next_clustering = tau
      next_clustering = min(next_clustering, tau + 0.02_dp)
   end function next_clustering

end module wavycon_expansion_size
