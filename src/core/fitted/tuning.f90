!> Tuned constants of the collocation fitted to the edge: numbers whose best value is found by trial, not by a
!> derivation.
!>
!> Each is one statement; its comment says what it controls and what a smaller or a larger value costs. More degrees,
!> points, equations or rules always take more time: that is not said again. scripts/constants measures the effect of a
!> factor of 2 on time and error. Mathematical constants and rounding thresholds are declared where they are used.
!>
!> The merging ratio is 0 for a point and 1 for a spot or a pool that touches its neighbours. Loads are in units of
!> the pressure that closes the lattice's troughs, where nothing else is said.
module wavycon_fitted_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Start, and continuation in the load.

   real(dp), parameter, public :: heavy_load_start = 0.7_dp
      !! Least load of a start from a penny-shaped crack. Smaller: a shape too far off for Newton's method.
   real(dp), parameter, public :: load_step_ratio = 2.0_dp
      !! Ratio of P, or of the closing pressure less P, in one step. Larger: outside Newton's convergence.
   integer, parameter, public :: start_degree = 4
      !! Degree of the polynomials during continuation. Smaller: the shape is not represented.

   ! Sequence of degrees.

   integer, parameter, public :: first_degree = 6
      !! Degree after continuation. Smaller: differences that do not estimate the error.
   integer, parameter, public :: degree_step = 4
      !! Full step of the degree, even. Smaller: differences that understate the error.
   integer, parameter, public :: last_degree = 40
      !! Highest degree. Smaller: accuracy lost near merging.
   integer, parameter, public :: full_step_degree = 8
      !! Four-fold symmetry: half steps below this degree. Smaller: low accuracies cost more than they need.
   real(dp), parameter, public :: round_shape_ratio = 0.75_dp
      !! Merging ratio below which a shape counts as round. Of round shapes some degrees change next to nothing, and
      !! six-fold ones do not determine all terms.
   integer, parameter, public :: degree_per_shape_term = 3
      !! Degrees to one more term of the shape. Smaller: terms that the equations do not determine. Larger: the shape
      !! limits the accuracy.
   integer, parameter, public :: degree_per_shape_term_twofold = 2
      !! The same with two-fold symmetry. Each degree needs its own number of terms; otherwise differences
      !! underestimate the error of the area.

   ! Newton's method at one degree.

   real(dp), parameter, public :: longest_shape_change = 0.3_dp
      !! Largest relative change of the shape in one step. Larger: the map folds.

   ! Points and rules of the equations.

   real(dp), parameter, public :: sharp_collocation_ratio = 0.6_dp
      !! Merging ratio from which there are more angles of collocation. Larger: sharp shapes are badly determined.
   real(dp), parameter, public :: sharp_collocation_factor = 1.5_dp
      !! Factor of the number of angles there. Smaller: sharp shapes are badly determined.
   integer, parameter, public :: spot_extra_radii = 4
      !! Collocation radii of a spot beyond half the degree. At least two more than round functions have terms, or any
      !! size of a spot would do.
   integer, parameter, public :: pool_extra_radii = 5
      !! The same of a pool.
   integer, parameter, public :: spot_extra_angles = 1
      !! Collocation angles of a spot beyond degree/fold. Smaller: terms with the highest harmonic are not determined.
   integer, parameter, public :: pool_extra_angles = 2
      !! The same of a pool.
   real(dp), parameter, public :: sharp_quadrature_ratio = 0.7_dp
      !! Merging ratio from which quadrature is finer. Larger: the quadrature's error shows.
   real(dp), parameter, public :: near_images_ratio = 0.85_dp
      !! Merging ratio from which the rule for the images is much finer. Larger: the near images' kernel is not
      !! resolved.
   real(dp), parameter, public :: chords_per_degree = 1.5_dp
      !! Chords through a target for each degree; they are most of the work. Smaller: the quadrature's error shows.
   real(dp), parameter, public :: sharp_chords_per_degree = 2.0_dp
      !! Chords for each degree of sharp shapes. Tips make the integrand vary faster from chord to chord.
   integer, parameter, public :: extra_chord_points = 2
      !! Points on a chord beyond half the degree. Smaller: the quadrature's error shows.
   integer, parameter, public :: extra_disc_angles = 1
      !! Angles of the rule for the images beyond degree/fold. Smaller: the quadrature's error shows.

   ! Series of the images.

   real(dp), parameter, public :: series_growth = 1.03_dp
      !! Growth of a shape that a series allows for. Smaller: made again after a step. Larger: longer series.
   real(dp), parameter, public :: series_clearance = 3.4_dp
      !! Lattice points within this many radii are summed one by one. Smaller: long series. Larger: more points at
      !! every pair of target and source.
   integer, parameter, public :: most_near_points = 12
      !! Most such points. With more of them the series saves nothing over the kernel itself.

   ! Clustering of the map's points towards the tips, near merging on the square lattice.

   real(dp), parameter, public :: spot_clustering = 0.015_dp
      !! Clustering of a spot at merging. Larger: the Jacobian vanishes at the tips. Smaller: tips need higher degrees.
   real(dp), parameter, public :: spot_clustering_power = 4.0_dp
      !! Power of the merging ratio with which it falls off. Smaller: clustering away from merging, which costs
      !! degrees. Larger: none where it would help.
   real(dp), parameter, public :: pool_clustering = 0.095_dp
      !! Clustering of a pool at merging. As of a spot.
   real(dp), parameter, public :: pool_clustering_power = 17.0_dp
      !! Power with which it falls off. As of a spot.
   real(dp), parameter, public :: least_clustering = 0.004_dp
      !! Clustering below which none is used: it costs a Newton step and does not improve the area.

   ! Estimates of errors. Larger ones, or a smaller range of the decay, cost a degree more than needed.

   real(dp), parameter, public :: fastest_decay = 0.05_dp
      !! The misfit is not taken to fall by more than this from degree to degree. Smaller: estimates that are too small
      !! where it falls faster than the errors.
   real(dp), parameter, public :: fastest_decay_at_point = 0.3_dp
      !! The same of values at a point. With 0.2 the gap at a pool's trough is as far off as its estimate allows.
   real(dp), parameter, public :: previous_difference_share = 0.5_dp
      !! Part of the difference before, carried on by the decay of the misfit, that a difference counts as at least.
      !! Smaller: a difference that is small by chance is believed.
   real(dp), parameter, public :: error_safety = 5.0_dp
      !! Factor on all estimates. Smaller: estimates below the true error.
   real(dp), parameter, public :: first_error_factor = 10.0_dp
      !! Further factor on the first estimate, which is from two solutions: they may be close by chance.
   real(dp), parameter, public :: least_relative_share = 0.2_dp
      !! Least relative error of one measure over the largest of all. Smaller: a mean gap whose differences are small
      !! by chance is taken for the error.

   ! Fields.

   real(dp), parameter, public :: field_accuracy = 1e-12_dp
      !! Accuracy of the integrals over spots or pools over the fields' scale. Larger: the error of rules and rays
      !! shows in fields. Smaller: more expensive fields.
   integer, parameter, public :: least_map = 150
      !! Places outside from which on a map takes a series. Smaller: series that cost more than they save. Larger: slow
      !! maps of few points.

   ! Stresses in the half-space.

   real(dp), parameter, public :: series_depth = 0.3_dp
      !! Depth from which stresses are Fourier series [s]. Smaller: longer series. Larger: rules over spots or pools,
      !! and a table of the far ones, to a larger depth.
   real(dp), parameter, public :: near_clearance = 0.8_dp
      !! Spots or pools are summed one by one within this distance from the cell [s]. Smaller: a larger table of the
      !! others. Larger: more of them at every place.
   real(dp), parameter, public :: far_top = 0.12_dp
      !! Least depth of the table's nodes [s]. Smaller: longer series for its values. Larger: rounding grows more
      !! towards the surface.
   real(dp), parameter, public :: far_bottom = 0.35_dp
      !! Largest depth of the table's nodes [s]. As far_top, the other way round.
   real(dp), parameter, public :: rule_angles_per_degree = 2.0_dp
      !! Angles of the coarsest rule over the disc, over the degree. Smaller: the expansion is not resolved near
      !! merging.
   real(dp), parameter, public :: rule_radii_per_degree = 0.5_dp
      !! The same of its radii.
   real(dp), parameter, public :: rule_fineness = 1.6_dp
      !! Factor from one rule to the next. Smaller: more rules to make. Larger: rules finer than needed.
   real(dp), parameter, public :: rule_angles_factor = 1.3_dp
      !! Angles that a place needs, over those that it would need above a round disc. Smaller: the rule's error shows.
   real(dp), parameter, public :: rule_radii_factor = 1.5_dp
      !! The same of radii.
   real(dp), parameter, public :: ray_points = 17.0_dp
      !! Points on a ray, and directions in a quarter of a turn, at an accuracy of 2e-12, beside the following. Smaller:
      !! the quadrature's error shows next to spots and pools.
   real(dp), parameter, public :: ray_points_per_degree = 0.2_dp
      !! More of both for each degree.
   real(dp), parameter, public :: ray_angles_per_unit = 4.8_dp
      !! More directions for each factor of e in the distance from the edge.
   real(dp), parameter, public :: ray_points_per_unit = 1.5_dp
      !! More points for each factor of e in the distance from the place.
   real(dp), parameter, public :: ray_points_per_unit_and_degree = 0.07_dp
      !! The same for each degree.
   real(dp), parameter, public :: ray_angles_of_strain = 1.1_dp
      !! Factor on the number of directions where the map is far from conformal, README.md (F63): at tips.
   real(dp), parameter, public :: stress_error_safety = 2.0_dp
      !! Factor on what the differences of degrees say of stresses. Smaller: estimates below the true error.

end module wavycon_fitted_tuning
