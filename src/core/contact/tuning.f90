!> Tuned constants of the contact solvers: numbers that no theory gives. Each has its reason beside it. README.md in
!> this directory derives what they multiply.
module wavycon_contact_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Sequence of grids.

   !> Points of the first grid to half of the surface's shortest wave, each way: the fewest of which two halvings of
   !> the step show how the errors fall.
   integer, parameter, public :: first_points = 8
   !> Most points of the last grid in 1-D, on half the cell of an even surface; others have as many on each half. It
   !> bounds the time of a load whose accuracy no grid attains.
   integer, parameter, public :: most_points_line = 524288
   !> Most points of the last grid in 2-D, on a quarter of the cell: 84 MB of arrays; on the whole cell four times as
   !> many.
   integer, parameter, public :: most_points_plane = 1048576

   ! Tolerance of the iteration.

   !> A grid is solved until the gap in contact deviates from zero by this part of the gap at the points next to the
   !> contact, so that the iteration adds little to the error of the edge.
   real(dp), parameter, public :: edge_tolerance = 5e-4_dp
   !> Iterations on one grid, after which the status is iteration_limit; so many, or
   integer, parameter, public :: iteration_limit = 500
   !> so many times the square root of the cell's longer side over the shortest step of the grid, if that is more: on
   !> cells of up to 1:1000 random maps took up to 4.6 times.
   real(dp), parameter, public :: iterations_of_root = 10.0_dp
   !> A point enters the contact when its overlap exceeds this part of the allowed residual. Smaller overlaps may be
   !> rounding: such points would enter and leave without end.
   real(dp), parameter, public :: overlap_part = 0.1_dp

   !> Largest relative difference of a load of a search from the one before, from whose pressure it starts.
   real(dp), parameter, public :: largest_change = 0.2_dp

   !> Part of its residual to which the pressure is corrected in single precision before the gap is computed anew in
   !> double precision.
   real(dp), parameter, public :: correction_part = 1e-4_dp
   !> A correction ends at this part of the residual allowed: the true residual is a little larger than that in single
   !> precision, and the gap at the edge, on which (C10) depends, falls in the first correction.
   real(dp), parameter, public :: correction_margin = 0.3_dp
   !> Most iterations of one correction.
   integer, parameter, public :: correction_limit = 60
   !> Points within this many steps of the contact may enter it in a correction.
   integer, parameter, public :: halo = 2
   !> Reach of the stencil that approximates S^-1, in steps.
   integer, parameter, public :: stencil_reach = 3
   !> Part of the points in contact below which the stencil replaces the transforms of S^-1: at 0.01 of 1024 x 1024
   !> points both take the same time, and the stencil 10 to 14 iterations in place of 7 to 10.
   real(dp), parameter, public :: stencil_fraction = 0.003_dp

   !> The preconditioner continues the gap from the contact to the points outside. For each doubling of the distance it
   !> falls by the factor decay_alone + decay_growth*(contact area fraction)^(1/2), at most 1: by about half beside a
   !> single spot, as the displacement of a point load does, and not at all in gaps that contact surrounds.
   real(dp), parameter, public :: decay_alone = 0.65_dp
   real(dp), parameter, public :: decay_growth = 1.2_dp
   !> On a layer it falls faster, in proportion to the distance, beyond this part of the thickness. On a rough map of
   !> 256 x 256 points, t/L = .1, .01 and .001, nu = .3: 25, 18, 19 iterations; with .5 28, 18, 19, with 1 50, 21, 19,
   !> without a limit 60, 97, 90. On half-spaces ten times softer than the layer it takes up to twice as many as
   !> without, on a thousand times softer ones it converges where it did not.
   real(dp), parameter, public :: reach_of_layer = 0.25_dp
   !> The preconditioner is applied again if (C4d) excludes more than this part of the points in contact. Larger:
   !> iterations grow by up to a half where many points enter at once. Smaller: it is applied for a few points. On 2048
   !> by 2048 points, waves of 4 and 16 points, 20, 50 and 90 % in contact, six runs together took 1.07 times the time
   !> with 0, 1.02 with 0.001, 1.03 with 0.01, 1.05 with 0.03 and 1.13 without a second application.
   real(dp), parameter, public :: blocked_part = 0.003_dp

   ! Error estimates of the grids.

   !> Factor on the changes from grid to grid of mean gap, contact area and peak pressure, whose errors fall to a fifth
   !> or a quarter. Above 1, as their fall is not regular.
   real(dp), parameter, public :: change_safety = 1.25_dp
   !> The part of the change before that the error estimates of gap and peak keep, so that one change that is small by
   !> chance does not pass for accuracy.
   real(dp), parameter, public :: kept_change = 0.5_dp
   !> The part of the change before that the area's estimate keeps: a quarter, as its changes fall. With it, this safety
   !> and the scatter below all of 2465 area estimates of 697 random scenes held, the largest error was 0.87 of its
   !> estimate; 1.09 without the factor 1.25.
   real(dp), parameter, public :: area_kept_change = 0.25_dp
   !> Uncertainty of the edge's place at one point of it, in steps, for where the errors of three grids are alike by
   !> chance. The root mean square of the area's error that it stands for was, on the same scenes, 0.02 to 0.1 for
   !> waves at 128 to 512 points a side; 0.2 for sums of waves, where the changes are larger still.
   real(dp), parameter, public :: edge_scatter = 0.1_dp
   !> Its mean over many points of the edge, in steps: all grids may err alike. Tilted waves showed 0.002 to 0.004.
   real(dp), parameter, public :: edge_bias = 0.003_dp
   !> Half width, in steps, of a contact whose peak the polynomial does not resolve: its edge may lie between the first
   !> and the second point from the crest.
   real(dp), parameter, public :: unresolved_width = 1.5_dp
   !> A point whose pressure is less than that of a neighbour over this may have a gap beside it, between the points.
   real(dp), parameter, public :: opening_ratio = 2.0_dp
   !> The least relative error of mean gap and peak pressure over that of the area. Both converge faster than the area,
   !> but not by much more than this: on the scenes above the gap's largest error was 4.6 times its estimate with 0.01,
   !> 2.2 times with 0.03.
   real(dp), parameter, public :: least_of_area = 0.03_dp

   ! Search for the load of a given area or gap, (C18). t is the target.

   !> The search ends when the value differs from t by this fraction of its error estimate: a closer value would not be
   !> more accurate.
   real(dp), parameter, public :: fraction_of_error = 0.01_dp
   !> The tolerance is at least this fraction of min(t, 1 - t): closed forms have no error estimate, and smaller
   !> differences are rounding.
   real(dp), parameter, public :: least_fraction = 1e-12_dp
   !> The tolerance is at most this fraction of min(t, 1 - t): where the error estimate is as large as t the value must
   !> still come close to t.
   real(dp), parameter, public :: largest_fraction = 1e-4_dp
   !> And at least so many spacings of the numbers at the target: the value itself is rounded, which near 1 is more than
   !> the fractions of 1 - t above.
   real(dp), parameter, public :: value_roundings = 4.0_dp
   !> P at which a search ends whose area or gap no longer follows the load: lighter than the lightest that adds a
   !> second point to the contact, about 1e-14 on 1e9 points, and far above the least number in single precision.
   real(dp), parameter, public :: lightest_load = 1e-20_dp
   !> Solutions of a search at one accuracy, after which the status is not_accurate. To halve a step of `longest_step`
   !> down to rounding takes 45.
   integer, parameter, public :: most_solves = 60
   !> Longest step in logit P, a factor of 20 in the load: over longer distances the two logits are no straight line.
   real(dp), parameter, public :: longest_step = 3.0_dp
   !> Least slope that the secant may have. Slopes lie between 1/2 and 5/2 (C18); where two values differ by less than
   !> their errors the secant may have any slope.
   real(dp), parameter, public :: flattest = 0.2_dp
   !> Largest slope that the secant may have. The margin over 5/2 is wide: too steep a secant makes short steps, not
   !> wrong ones.
   real(dp), parameter, public :: steepest = 20.0_dp
   !> Longest step of ln P upwards in the search for first yield: a longer one may pass the first root.
   real(dp), parameter, public :: longest_rise = 0.7_dp
   !> A search on a coarser level ends when the value differs by its error estimate or, if that is less, by this part of
   !> min(t, 1 - t) or of the stress: the value of the next finer level differs by more. It also ends when the loads
   !> of the bracket differ by this fraction: the value jumps between them.
   real(dp), parameter, public :: coarse_fraction = 0.02_dp
   !> A load of first yield whose stress has a larger relative error than this has the status not_accurate, also on the
   !> own points of a height map: the stress may be that of one point.
   real(dp), parameter, public :: largest_stress_error = 0.5_dp
   !> Grids refined to an accuracy search first with ten times, then a hundred times lower accuracies, down to this.
   !> Less accurate solutions do not help the search: their areas differ too much from the final ones.
   real(dp), parameter, public :: worst_search_accuracy = 1e-2_dp
   !> Grids of given points search first on grids with half the points each way, down to this number along the longer
   !> side, for the same reason.
   integer, parameter, public :: least_search_points = 64

   ! One spot in a periodic cell, (C27).

   !> Largest contact area fraction and least load concentration of what counts as one spot. At 2 % of a square cell
   !> Hertz' contact has the concentration 0.97; the next term of (C27) is some (radius/side)^3 of the approach, 5e-4.
   real(dp), parameter, public :: largest_spot = 0.02_dp, least_concentration = 0.95_dp

   ! The paper's series.

   !> The dual method starts at this load or a higher one and passes on to lighter ones. It begins with the pressure
   !> of full contact, whose rounding of 1e-16 must be small beside the load; and at lighter loads the active
   !> constraints hardly change, so that the pass takes few steps.
   real(dp), parameter, public :: lightest_start = 1e-6_dp

   !> The dual method continues from the load before with at most so many constraint points to a harmonic. Ten loads
   !> took 0.44, 0.64, 0.64, 0.98, 0.9 and 1.0 of the time without with 1.02, 1.05, 1.1, 1.5, 1.55 and 3 points.
   real(dp), parameter, public :: most_points_to_continue = 1.25_dp

   !> Difference of the loads that derivatives are from, in ln(P/(1 - P)) (C29). Half of it where spots are about to
   !> merge; elsewhere the points that enter the contact one after another then show more: at 256 points a side errors
   !> of G'' were 6e-2 and 3e-2 of it with .1 on the two lattices, 4e-3 and 2e-2 with .2.
   real(dp), parameter, public :: load_difference = 0.2_dp

   ! Expansions fitted to the edge.

   !> Largest ratio of the sides of a cell: longer spots need polynomials of higher degree.
   real(dp), parameter, public :: largest_aspect_ratio = 3.0_dp
   !> Largest ratio of the two curvatures of a crest, for the same reason.
   real(dp), parameter, public :: largest_curvature_ratio = 50.0_dp

   ! Free edges.

   !> Tolerance of the residual over the approach (C28): where the gap beside the contact is a step, as beside a punch,
   !> that of (C10) says nothing. 5e-5 keeps the iteration error of the approach below a tenth of the error estimates of
   !> punches of 128 points a side.
   real(dp), parameter, public :: approach_tolerance = 5e-5_dp
   !> Part of the approach of the coarser grid that is added to it for the rectangle of the finer one: if the approach
   !> turns out larger still, the grid is solved twice. Twice the part makes the rectangle 1 % wider about a ball.
   real(dp), parameter, public :: approach_margin = 0.02_dp

   !> Width of the border, over the sides of the map, whose part of the load the log tells: nearer contacts may miss
   !> neighbours beyond the border.
   real(dp), parameter, public :: border = 0.05_dp

end module wavycon_contact_tuning
