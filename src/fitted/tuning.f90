!> Tuned constants of the boundary-fitted solver: numbers whose best value is found by trial, not by a derivation.
!>
!> Each is one statement; its comment says what it controls and what a smaller or a larger value costs.
!> scripts/constants measures the effect of a factor of 2 on time and error. Mathematical constants and rounding
!> thresholds are declared where they are used.
!>
!> The merging ratio is 0 for a point and 1 for a spot or an island that touches its neighbours. Loads are in units of
!> the pressure that closes the lattice's troughs, where nothing else is said.
module wavycon_fitted_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Start, and continuation in the load.

   real(dp), parameter, public :: light_load_start = 0.06_dp
      !! Largest P of a Hertzian start [p* of the lattice]. Larger: Newton's method starts from a shape too far off.
      !! Smaller: more steps of continuation.
   real(dp), parameter, public :: heavy_load_start = 0.7_dp
      !! Least load of a start from a penny-shaped crack. Smaller: Newton's method starts from a shape too far off.
      !! Larger: more steps of continuation.
   real(dp), parameter, public :: load_step_ratio = 2.0_dp
      !! Ratio of P, or of the closing pressure less P, in one step. Larger: the scaled solution is outside Newton's
      !! convergence. Smaller: more steps of continuation.
   integer, parameter, public :: start_degree = 4
      !! Degree of the polynomials during continuation. Larger: steps cost more, for a solution that is refined
      !! afterwards. Smaller: the shape is not represented.
   real(dp), parameter, public :: spot_ellipticity_power = 0.6_dp
      !! Axis ratio of a Hertzian start: curvature ratio to this power. Only a start: an approximation to the exact
      !! relation by elliptic integrals.
   real(dp), parameter, public :: island_ellipticity_power = 0.5_dp
      !! The same of a crack, with the pressure's curvatures. Only a start: exact for slender ellipses.
   real(dp), parameter, public :: start_shape_change = 1e-2_dp
      !! Relative change of the shape at which Newton's method stops during continuation. Smaller: Newton steps that
      !! the next load makes useless. Larger: errors add up over the loads.
   real(dp), parameter, public :: start_series_growth = 1.1_dp
      !! Growth of a shape that its first image series allows for. Smaller: the series is made again after a step.
      !! Larger: longer series.
   integer, parameter, public :: restart_degree_steps = 3
      !! A sweep starts a load this many degree steps below the degree of the load before. Smaller: degrees never come
      !! down again in a sweep. Larger: degrees are solved that are not needed.

   ! Sequence of degrees.

   integer, parameter, public :: first_degree = 6
      !! Degree after continuation. Larger: low accuracies cost more than they need. Smaller: differences that do not
      !! estimate the error.
   integer, parameter, public :: degree_step = 4
      !! Full step of the degree, even. Smaller: more solutions, and differences that understate the error. Larger: a
      !! degree higher than needed.
   integer, parameter, public :: last_degree = 40
      !! Highest degree. Larger: time spent where rounding or the tips limit the accuracy. Smaller: accuracy lost near
      !! merging.
   integer, parameter, public :: full_step_degree = 8
      !! Four-fold symmetry: half steps below this degree. Larger: more solutions. Smaller: low accuracies cost more
      !! than they need.
   integer, parameter, public :: full_step_degree_round = 12
      !! The same for round shapes. There the terms that vary with the angle matter less, and a full step gives more
      !! than is needed.
   real(dp), parameter, public :: round_shape_ratio = 0.75_dp
      !! Merging ratio below which a shape counts as round. Round shapes: some degrees change next to nothing, and six-
      !! fold shapes do not determine all their terms.
   integer, parameter, public :: degree_per_shape_term = 3
      !! Degrees to one more term of the shape. Smaller: terms that the equations do not determine. Larger: the shape
      !! limits the accuracy.
   integer, parameter, public :: degree_per_shape_term_twofold = 2
      !! The same with two-fold symmetry. Each degree needs its own number of terms; otherwise differences
      !! underestimate the error of the area.
   integer, parameter, public :: full_shape_degree = 12
      !! Degree from which the shape has its full number of terms. Smaller: low degrees do not determine the terms.
      !! Larger: low accuracies need higher degrees.

   ! Newton's method at one degree.

   real(dp), parameter, public :: longest_shape_change = 0.3_dp
      !! Largest relative change of the shape in one step. Larger: the map folds. Smaller: more steps.
   real(dp), parameter, public :: change_per_square = 10.0_dp
      !! Change of a Newton step over the square of the one before, while convergence is quadratic. Smaller: the error
      !! left by the last step shows in the result. Larger: steps that change no digit asked for.
   real(dp), parameter, public :: remaining_of_accuracy = 0.1_dp
      !! What Newton's method may leave of the shape, over the accuracy. Larger: it shows in the result. Smaller: steps
      !! that change no digit asked for.
   real(dp), parameter, public :: least_remaining = 1e-13_dp
      !! Least such remainder. Smaller: steps into rounding. Larger: digits lost at the tightest accuracy.
   real(dp), parameter, public :: largest_remaining = 1e-7_dp
      !! Largest such remainder. Larger: differences of degrees show unfinished iterations. Smaller: steps that low
      !! accuracies do not need.
   real(dp), parameter, public :: linear_convergence_ratio = 0.7_dp
      !! Merging ratio from which the first degree takes a second step to measure the contraction: convergence is less
      !! than quadratic there. Smaller: steps without need. Larger: unfinished iterations near merging.
   real(dp), parameter, public :: largest_change = 1e-4_dp
      !! Change beyond which a degree's solution is not used. Larger: errors are estimated from solutions that have not
      !! converged. Smaller: degrees are left out for nothing.

   ! Points and rules of the equations.

   real(dp), parameter, public :: sharp_collocation_ratio = 0.6_dp
      !! Merging ratio from which there are more angles of collocation. Larger: sharp shapes are badly determined.
      !! Smaller: more equations than needed.
   real(dp), parameter, public :: sharp_collocation_factor = 1.5_dp
      !! Factor of the number of angles there. Smaller: sharp shapes are badly determined. Larger: more expensive
      !! steps.
   integer, parameter, public :: spot_extra_radii = 4
      !! Collocation radii of a spot beyond half the degree. At least two more than round functions have terms, or any
      !! size of a spot would do. Larger: more expensive steps.
   integer, parameter, public :: island_extra_radii = 5
      !! The same of an island.
   integer, parameter, public :: spot_extra_angles = 1
      !! Collocation angles of a spot beyond degree/fold. Smaller: terms with the highest harmonic are not determined.
      !! Larger: more expensive steps.
   integer, parameter, public :: island_extra_angles = 2
      !! The same of an island.
   real(dp), parameter, public :: sharp_quadrature_ratio = 0.7_dp
      !! Merging ratio from which quadrature is finer. Larger: the quadrature's error shows. Smaller: points that are
      !! not needed.
   real(dp), parameter, public :: near_images_ratio = 0.85_dp
      !! Merging ratio from which the rule for the images is much finer. Larger: the near images' kernel is not
      !! resolved. Smaller: points that are not needed.
   real(dp), parameter, public :: chords_per_degree = 1.5_dp
      !! Chords through a target for each degree. Smaller: the quadrature's error shows. Larger: more expensive steps;
      !! chords are most of the work.
   integer, parameter, public :: extra_chords = 4
      !! Chords beyond that.
   real(dp), parameter, public :: sharp_chords_per_degree = 2.0_dp
      !! Chords for each degree of sharp shapes. Tips make the integrand vary faster from chord to chord.
   integer, parameter, public :: extra_sharp_chords = 20
      !! Chords beyond that of sharp shapes, but no more than the degree: low degrees are not that accurate.
   integer, parameter, public :: extra_chord_points = 2
      !! Points on a chord beyond half the degree. Smaller: the quadrature's error shows. Larger: more expensive steps.
   integer, parameter, public :: extra_disc_radii = 2
      !! Radii of the rule for the images beyond half the degree. Smaller: the quadrature's error shows. Larger: more
      !! expensive images.
   integer, parameter, public :: extra_disc_angles = 1
      !! Angles of the rule for the images beyond degree/fold. Smaller: the quadrature's error shows. Larger: more
      !! expensive images.
   integer, parameter, public :: sharp_disc_extra = 1
      !! More radii and angles of that rule for sharp shapes. As extra_disc_radii and extra_disc_angles.
   integer, parameter, public :: near_disc_extra = 6
      !! More radii and angles of that rule where images are near. Smaller: the near images' kernel is not resolved.
      !! Larger: more expensive images.
   integer, parameter, public :: degree_per_near_disc_extra = 4
      !! Degrees to one more of them up to that number: low degrees are not that accurate. As near_disc_extra, the other
      !! way round.

   ! Series of the images.

   real(dp), parameter, public :: series_error_of_accuracy = 1e-2_dp
      !! Error of the image series over the accuracy asked for. Larger: its error shows in the result. Smaller: longer
      !! series.
   real(dp), parameter, public :: loosest_series_accuracy = 1e-4_dp
      !! Loosest accuracy that a series is made for. Larger: shorter series, which are hardly quicker, and differences
      !! that show their error. Smaller: longer series.
   real(dp), parameter, public :: series_growth = 1.03_dp
      !! Growth of a shape that a series allows for. Smaller: the series is made again after a step. Larger: longer
      !! series.
   real(dp), parameter, public :: series_clearance = 3.4_dp
      !! Lattice points within this many radii are summed one by one. Smaller: long series. Larger: more points at
      !! every pair of target and source.
   integer, parameter, public :: most_near_points = 12
      !! Most lattice points that are summed one by one. With more of them the series saves nothing over the kernel
      !! itself.

   ! Smooth part of the kernel.

   integer, parameter, public :: kernel_fit_degree = 12
      !! Degree of the fit in the square of either coordinate. Smaller: the fit's error is above rounding. Larger: a
      !! longer fit, whose last terms are cut off as rounding.
   real(dp), parameter, public :: kernel_near_distance = 0.75_dp
      !! Lattice points this near to the cell are summed one by one [s], together with the next constant. Smaller: a
      !! fit of higher degree. Larger: more points in every evaluation.
   real(dp), parameter, public :: kernel_near_per_side = 0.6_dp
      !! What is added to it for each longer side of the cell.

   ! Clustering of the map's points towards the tips, near merging on the square lattice.

   real(dp), parameter, public :: spot_clustering = 0.015_dp
      !! Clustering of a spot at merging. Larger: the Jacobian vanishes at the tips. Smaller: tips need higher degrees.
   real(dp), parameter, public :: spot_clustering_power = 4.0_dp
      !! Power of the merging ratio with which it falls off. Smaller: clustering away from merging, which costs
      !! degrees. Larger: none where it would help.
   real(dp), parameter, public :: island_clustering = 0.095_dp
      !! Clustering of an island at merging. As of a spot.
   real(dp), parameter, public :: island_clustering_power = 17.0_dp
      !! Power with which it falls off. As of a spot.
   real(dp), parameter, public :: least_clustering = 0.004_dp
      !! Clustering below which none is used. Smaller values cost a Newton step and do not improve the area. Larger:
      !! none where it would help.
   real(dp), parameter, public :: least_clustering_change = 0.2_dp
      !! Relative change of it below which the old value is kept. A change costs a Newton step. Larger: values that do
      !! not fit the shape.
   real(dp), parameter, public :: longest_clustering_step = 0.02_dp
      !! Largest rise of it from one degree to the next. Larger: Newton's method does not follow. Smaller: the value is
      !! reached at a higher degree than needed.

   ! Estimates of errors.

   real(dp), parameter, public :: fastest_decay = 0.05_dp
      !! The misfit is not taken to fall by more than this from degree to degree. Smaller: estimates that are too small
      !! where it falls faster than the errors. Larger: a degree more than needed.
   real(dp), parameter, public :: fastest_decay_at_point = 0.3_dp
      !! The same of values at a point. With 0.2 the gap at an island's trough is as far off as its estimate allows.
   real(dp), parameter, public :: previous_difference_share = 0.5_dp
      !! Part of the difference before, carried on by the decay of the misfit, that a difference counts as at least.
      !! Smaller: a difference that is small by chance is believed. Larger: a degree more than needed.
   real(dp), parameter, public :: error_safety = 5.0_dp
      !! Factor on all estimates. Smaller: estimates below the true error. Larger: a degree more than needed.
   real(dp), parameter, public :: first_error_factor = 10.0_dp
      !! Further factor on the first estimate, which is from two solutions: they may be close by chance. Smaller: such
      !! estimates fail. Larger: a degree more than needed.
   real(dp), parameter, public :: least_relative_share = 0.2_dp
      !! Least relative error of one measure over the largest of all. Smaller: a mean gap whose differences are small
      !! by chance is taken for the error. Larger: a degree more than needed.

   ! Fields.

   real(dp), parameter, public :: field_accuracy = 1e-12_dp
      !! Accuracy of the integrals over spots or islands over the fields' scale. Larger: the error of rules and rays
      !! shows in fields. Smaller: more expensive fields.
   integer, parameter, public :: field_angles = 48
      !! Least points per turn of the rule for spots and islands that are far. Smaller: more of them count as near.
      !! Larger: more points of the periodic kernel.
   real(dp), parameter, public :: field_angles_per_degree = 2.0_dp
      !! The same over the degree.
   integer, parameter, public :: field_radii = 12
      !! Least points per radius of that rule. As field_angles.
   real(dp), parameter, public :: field_radii_per_degree = 0.6_dp
      !! The same over the degree.

   integer, parameter, public :: least_map = 150
      !! Places outside from which on a map takes a series. Smaller: series that cost more than they save. Larger: slow
      !! maps of few points.

   ! Stresses in the half-space.

   real(dp), parameter, public :: series_depth = 0.3_dp
      !! Depth from which stresses are Fourier series [s]. Smaller: longer series. Larger: rules over spots or islands,
      !! and a table of the far ones, to a larger depth.
   real(dp), parameter, public :: near_clearance = 0.8_dp
      !! Spots or islands are summed one by one within this distance from the cell [s]. Smaller: a larger table of the
      !! others. Larger: more of them at every place.
   real(dp), parameter, public :: far_top = 0.12_dp
      !! Least depth of the table's nodes [s]. Smaller: longer series for its values. Larger: rounding grows more
      !! towards the surface.
   real(dp), parameter, public :: far_bottom = 0.35_dp
      !! Largest depth of the table's nodes [s]. As far_top, the other way round.

   real(dp), parameter, public :: rule_angles_per_degree = 2.0_dp
      !! Angles of the coarsest rule over the disc, over the degree. Smaller: the expansion is not resolved near
      !! merging. Larger: more points for every spot or island near by.
   real(dp), parameter, public :: rule_radii_per_degree = 0.5_dp
      !! The same of its radii.
   real(dp), parameter, public :: rule_fineness = 1.6_dp
      !! Factor from one rule to the next. Smaller: more rules to make. Larger: rules finer than needed.
   real(dp), parameter, public :: rule_angles_factor = 1.3_dp
      !! Angles that a place needs, over those that it would need above a round disc. Smaller: the rule's error shows.
      !! Larger: finer rules, or rays, than needed.
   real(dp), parameter, public :: rule_radii_factor = 1.5_dp
      !! The same of radii.
   real(dp), parameter, public :: ray_points = 17.0_dp
      !! Points on a ray, and directions in a quarter of a turn, at an accuracy of 2e-12, beside the following. Smaller:
      !! the quadrature's error shows next to spots and islands. Larger: slower rays.
   real(dp), parameter, public :: ray_points_per_degree = 0.2_dp
      !! More of both for each degree.
   real(dp), parameter, public :: ray_angles_per_unit = 4.8_dp
      !! More directions for each factor of e in the distance from the edge.
   real(dp), parameter, public :: ray_points_per_unit = 1.5_dp
      !! More points for each factor of e in the distance from the place.
   real(dp), parameter, public :: ray_points_per_unit_and_degree = 0.07_dp
      !! The same for each degree.
   real(dp), parameter, public :: ray_angles_of_strain = 1.1_dp
      !! Factor on the number of directions where the map is far from conformal, README.md (F63). Smaller: the
      !! quadrature's error shows at tips. Larger: slower rays.
   real(dp), parameter, public :: stress_error_safety = 2.0_dp
      !! Factor on what the differences of degrees say of stresses. Smaller: estimates below the true error. Larger:
      !! estimates that are too large.

   ! Geometry of shapes.

   integer, parameter, public :: radius_points = 8
      !! Intervals of a half sector in which a shape's radius is looked for. Smaller: tips off the axes are missed.
      !! Larger: more time.
   integer, parameter, public :: least_edge_points = 16
      !! Least points of a half sector for the length of an edge. Smaller: the length's error shows. Larger: more time.
   real(dp), parameter, public :: farthest_inverse_start = 1.2_dp
      !! Largest |w| at which the inversion of the map starts. Larger: starts beyond where the continued map folds.
      !! Smaller: more steps.
   real(dp), parameter, public :: longest_inverse_step = 0.2_dp
      !! Largest step of it in |w|. Larger: steps across a fold. Smaller: more steps.

end module wavycon_fitted_tuning
