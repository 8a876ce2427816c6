!> Chooses the size of a fitted function: the sequence of degrees, the number of shape terms, and the clustering of the
!> map. They depend on the merging ratio, a measure of how close a spot or pool is to its neighbours, which is computed
!> here.
module wavycon_fitted_size
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: degree_per_shape_term, degree_per_shape_term_twofold, degree_step, first_degree, &
      full_step_degree, pool_clustering, pool_clustering_power, least_clustering, round_shape_ratio, &
      spot_clustering, spot_clustering_power
   use wavycon_kinds, only: dp
   use wavycon_shape_search, only: distance_from_edge, edge_points
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: merging_ratio, next_clustering, next_degree, shape_terms

contains

   !> The merging ratio: the part of the distance from the centre to the midpoint between neighbours that a spot or pool
   !> covers, in the direction where this part is largest. It is 0 for a point, 1 where neighbours touch, and larger
   !> where they overlap. The point of the edge nearest to the midpoint counts: long spots have tips off the axes, which
   !> approach the midpoint from the side.
   pure real(dp) function merging_ratio(lattice, now) result(ratio)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now    !! the spot or pool

      complex(dp), allocatable :: midpoints(:)
      integer :: i

      allocate (midpoints, source=lattice%to_next_crest)
      if (now%pool) midpoints = lattice%to_next_trough
      associate (edge => edge_points(now%shape))
         ratio = 1.0_dp - minval([(distance_from_edge(now%shape, edge, midpoints(i))/abs(midpoints(i)), &
                                   i=1, size(midpoints))])
      end associate
   end function merging_ratio

   !> The next degree of the sequence, a half or a full step higher.
   !>
   !> Four-fold shapes take half steps at low degrees. While they are round they do so up to higher degrees, because
   !> terms that vary with the angle matter less. Other shapes have nearly a higher symmetry than their own, and half a
   !> step would add next to nothing.
   pure integer function next_degree(degree, fold, merging_ratio)
      integer, intent(in) :: degree, fold     !! the last degree; order of the rotational symmetry
      real(dp), intent(in) :: merging_ratio   !! merging ratio of the shape

      logical :: half

      half = degree < first_degree
      if (fold == 4) half = degree < full_step_degree .or. (degree < 12 .and. merging_ratio < round_shape_ratio)
      next_degree = degree + merge(degree_step/2, degree_step, half)
   end function next_degree

   !> The number K of terms of the shape for a degree of the polynomials.
   pure integer function shape_terms(degree, fold, merging_ratio)
      integer, intent(in) :: degree, fold     !! degree of the polynomials; order of the rotational symmetry
      real(dp), intent(in) :: merging_ratio   !! merging ratio of the shape

      if (fold == 2) then
         ! Each degree has a number of terms of its own. Otherwise differences between degrees underestimate the error
         ! of the area.
         shape_terms = degree/degree_per_shape_term_twofold
         return
      end if
      shape_terms = degree/degree_per_shape_term + 1
      ! Low degrees do not determine so many terms.
      if (degree < 12) shape_terms = (degree + 1)/degree_per_shape_term
      ! Choose about the same highest power of conj(w) for all symmetries. More terms of six-fold shapes are determined
      ! only if the tips are sharp.
      if (fold < 4 .or. merging_ratio < round_shape_ratio) shape_terms = nint(4.0_dp*shape_terms/fold)
   end function shape_terms

   !> The clustering tau of the map for the next degree, on the square lattice: a multiple of a power of the merging
   !> ratio. Small changes are not made. Increases are limited, so that Newton's method still converges.
   pure real(dp) function next_clustering(tau, merging_ratio, pool)
      real(dp), intent(in) :: tau             !! clustering of the present shape
      real(dp), intent(in) :: merging_ratio   !! merging ratio of the present shape
      logical, intent(in) :: pool             !! true: a pool; false: a spot

      associate (ratio => min(merging_ratio, 1.0_dp))
         next_clustering = merge(pool_clustering*ratio**pool_clustering_power, &
                                 spot_clustering*ratio**spot_clustering_power, pool)
      end associate
      if (next_clustering < least_clustering) next_clustering = 0.0_dp
      if (abs(next_clustering - tau) < 0.2_dp*next_clustering) next_clustering = tau
      next_clustering = min(next_clustering, tau + 0.02_dp)
   end function next_clustering

end module wavycon_fitted_size
