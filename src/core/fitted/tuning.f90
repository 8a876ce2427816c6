!> Tuned constants of the collocation fitted to the edge: numbers whose best value is found by trial, not by a
!> derivation.
!>
!> The comment of each constant says what the constant controls, and what happens with a smaller or a larger value. More
!> degrees, points, equations or rules always take more time, which is not repeated. scripts/constants measures the
!> effect of a factor of 2 on time and error. Mathematical constants and rounding thresholds are declared where they are
!> used.
!>
!> The merging ratio is 0 for a point and 1 for a spot or a pool that touches its neighbours. Loads are over the
!> pressure that closes the lattice's troughs, unless another unit is given.
module wavycon_fitted_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Start, and continuation in the load.

   real(dp), parameter, public :: heavy_load_start = 0.7_dp
      !! Least load of a start from a penny-shaped crack. Smaller: the crack is too far from the solution for Newton's
      !! method.
   real(dp), parameter, public :: load_step_ratio = 2.0_dp
      !! Ratio of P, or of the closing pressure less P, in one step. Larger: Newton's method may not converge.
   integer, parameter, public :: start_degree = 4
      !! Degree of the polynomials during continuation. Smaller: the polynomials cannot represent the solution.

   ! Sequence of degrees.

   integer, parameter, public :: first_degree = 6
      !! First degree after continuation. Smaller: the differences between degrees do not estimate the error.
   integer, parameter, public :: degree_step = 4
      !! Full step of the degree, an even number. Smaller: the differences between degrees underestimate the error.
   integer, parameter, public :: last_degree = 40
      !! Highest degree. Smaller: high accuracies are not reached near merging.
   integer, parameter, public :: full_step_degree = 8
      !! With four-fold symmetry the degree rises by half steps below this degree. Smaller: low accuracies take more
      !! time than they need.
   real(dp), parameter, public :: round_shape_ratio = 0.75_dp
      !! A shape with a merging ratio below this counts as round. For round shapes some degrees change next to nothing,
      !! and those with six-fold symmetry do not determine all terms of the shape.
   integer, parameter, public :: degree_per_shape_term = 3
      !! Increase of the degree for each further term of the shape. Smaller: the equations do not determine all terms.
      !! Larger: the shape limits the accuracy.
   integer, parameter, public :: degree_per_shape_term_twofold = 2
      !! The same with two-fold symmetry. Each degree needs a number of terms of its own; otherwise differences
      !! underestimate the error of the area.

   ! Newton's method at one degree.

   real(dp), parameter, public :: longest_shape_change = 0.3_dp
      !! Largest relative change of the shape in one step. Larger: the map may fold.

   ! Points and rules of the equations.

   real(dp), parameter, public :: sharp_collocation_ratio = 0.6_dp
      !! Above this merging ratio there are more angles of collocation. Larger: sharp shapes are badly determined.
   real(dp), parameter, public :: sharp_collocation_factor = 1.5_dp
      !! Factor on the number of angles above that ratio. Smaller: sharp shapes are badly determined.
   integer, parameter, public :: spot_extra_radii = 4
      !! Number of collocation radii of a spot, less half the degree. With fewer than two radii more than axisymmetric
      !! functions have terms, the size of a spot would not be determined.
   integer, parameter, public :: pool_extra_radii = 5
      !! The same for a pool.
   integer, parameter, public :: spot_extra_angles = 1
      !! Number of collocation angles of a spot, less degree/fold. Smaller: terms with the highest harmonic are not
      !! determined.
   integer, parameter, public :: pool_extra_angles = 2
      !! The same for a pool.
   real(dp), parameter, public :: sharp_quadrature_ratio = 0.7_dp
      !! Above this merging ratio the quadrature is finer. Larger: the error of the quadrature limits the accuracy.
   real(dp), parameter, public :: near_images_ratio = 0.85_dp
      !! Above this merging ratio the rule for the images is much finer. Larger: the rule does not resolve the kernel of
      !! near images.
   real(dp), parameter, public :: chords_per_degree = 1.5_dp
      !! Number of chords through a target for each degree; most of the time is spent on the chords. Smaller: the error
      !! of the quadrature limits the accuracy.
   real(dp), parameter, public :: sharp_chords_per_degree = 2.0_dp
      !! Number of chords for each degree of sharp shapes, whose tips make the integrand vary faster from chord to
      !! chord.
   integer, parameter, public :: extra_chord_points = 2
      !! Number of points on a chord, less half the degree. Smaller: the error of the quadrature limits the accuracy.
   integer, parameter, public :: extra_disc_angles = 1
      !! Number of angles of the rule for the images, less degree/fold. Smaller: the error of the quadrature limits the
      !! accuracy.

   ! Series of the images.

   real(dp), parameter, public :: series_growth = 1.03_dp
      !! A series holds for shapes up to this multiple of the present size. Smaller: the series is made again after a
      !! step. Larger: longer series.
   real(dp), parameter, public :: series_clearance = 3.4_dp
      !! The terms of lattice points within this many radii are summed one by one. Smaller: longer series. Larger: more
      !! terms for each pair of target and source.
   integer, parameter, public :: most_near_points = 12
      !! Largest number of such lattice points. With more of them the series takes as long as the kernel itself.

   ! Clustering of the map's points towards the tips, near merging on the square lattice.

   real(dp), parameter, public :: spot_clustering = 0.015_dp
      !! Clustering of a spot at merging. Larger: the Jacobian vanishes at the tips. Smaller: tips need higher degrees.
   real(dp), parameter, public :: spot_clustering_power = 4.0_dp
      !! The clustering of a spot is proportional to this power of the merging ratio. Smaller: more clustering away from
      !! merging, which takes higher degrees. Larger: too little clustering where it would help.
   real(dp), parameter, public :: pool_clustering = 0.095_dp
      !! Clustering of a pool at merging. Smaller and larger values do what those of a spot do.
   real(dp), parameter, public :: pool_clustering_power = 17.0_dp
      !! The clustering of a pool is proportional to this power of the merging ratio, as for a spot.
   real(dp), parameter, public :: least_clustering = 0.004_dp
      !! Smaller clusterings are set to zero: they cost a Newton step and do not improve the area.

   ! Estimates of errors. If they are larger, or if the range of the decay is smaller, one degree more than needed is
   ! solved.

   real(dp), parameter, public :: fastest_decay = 0.05_dp
      !! Least decay (ratio of successive misfits) that is taken for an estimate. Smaller: estimates are too small where
      !! the misfit falls faster than the errors.
   real(dp), parameter, public :: fastest_decay_at_point = 0.3_dp
      !! The same for values at a point. With 0.2 the error of the gap at a pool's trough reaches its estimate.
   real(dp), parameter, public :: previous_difference_share = 0.5_dp
      !! A difference between degrees is taken as at least this part of the previous one times the decay of the misfit.
      !! Smaller: a difference that is small by chance gives too small an estimate.
   real(dp), parameter, public :: error_safety = 5.0_dp
      !! Factor on all estimates. Smaller: estimates below the true error.
   real(dp), parameter, public :: first_error_factor = 10.0_dp
      !! Further factor on the first estimate. This one is from two solutions only, which may be close by chance.
   real(dp), parameter, public :: least_relative_share = 0.2_dp
      !! Relative error estimate of a measure, at least, over the largest one of all measures. Smaller: too small an
      !! estimate for a measure, such as the mean gap, whose differences are small by chance.

   ! Fields.

   real(dp), parameter, public :: field_accuracy = 1e-12_dp
      !! Relative error of the integrals over spots or pools. Larger: the errors of rules and rays limit the accuracy of
      !! fields. Smaller: fields take more time.
   integer, parameter, public :: least_map = 150
      !! Least number of positions outside at which a map takes a series. Smaller: series that cost more than they save.
      !! Larger: slow maps of few points.

   ! Stresses in the half-space.

   real(dp), parameter, public :: series_depth = 0.3_dp
      !! From this depth on stresses are Fourier series [s]. Smaller: longer series. Larger: rules over spots or pools
      !! and the table of the far ones are used to a larger depth.
   real(dp), parameter, public :: near_clearance = 0.8_dp
      !! Spots or pools within this distance from the cell are integrated one by one [s]. Smaller: the table of the
      !! others has more terms. Larger: more integrals for each point.
   real(dp), parameter, public :: far_top = 0.12_dp
      !! Least depth of the table's nodes [s]. Smaller: longer series for its values. Larger: rounding grows more
      !! towards the surface.
   real(dp), parameter, public :: far_bottom = 0.35_dp
      !! Largest depth of the table's nodes [s]. Smaller: rounding grows more towards the surface. Larger: more terms.
   real(dp), parameter, public :: rule_angles_per_degree = 2.0_dp
      !! Number of angles of the coarsest rule over the disc, over the degree. Smaller: near merging the rule does not
      !! resolve the fitted function.
   real(dp), parameter, public :: rule_radii_per_degree = 0.5_dp
      !! The same for the radii of the rule.
   real(dp), parameter, public :: rule_fineness = 1.6_dp
      !! Factor of the numbers of points from one rule to the next. Smaller: more rules to make. Larger: rules finer
      !! than needed.
   real(dp), parameter, public :: rule_angles_factor = 1.3_dp
      !! Number of angles that a rule needs for a point, over the number that would be needed if the shape were a round
      !! disc. Smaller: the errors of rules limit the accuracy.
   real(dp), parameter, public :: rule_radii_factor = 1.5_dp
      !! The same for radii.
   real(dp), parameter, public :: ray_points = 17.0_dp
      !! At an accuracy of 2e-12, the number of points on a ray, and of directions in a quarter of a turn; the following
      !! constants add to it. Smaller: the error of the quadrature limits the accuracy next to spots and pools.
   real(dp), parameter, public :: ray_points_per_degree = 0.2_dp
      !! Increase of both numbers for each degree.
   real(dp), parameter, public :: ray_angles_per_unit = 4.8_dp
      !! Increase of the number of directions for each factor 1/e of the distance from the edge.
   real(dp), parameter, public :: ray_points_per_unit = 1.5_dp
      !! Increase of the number of points for each factor 1/e of the distance from the point.
   real(dp), parameter, public :: ray_points_per_unit_and_degree = 0.07_dp
      !! The same increase for each degree.
   real(dp), parameter, public :: ray_angles_of_strain = 1.1_dp
      !! Factor on the number of directions where the map is far from conformal, at tips: README.md (F63).
   real(dp), parameter, public :: stress_error_safety = 2.0_dp
      !! Factor on error estimates of stresses from differences between degrees. Smaller: estimates below the true
      !! error.

end module wavycon_fitted_tuning
