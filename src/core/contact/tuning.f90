!> Tuned constants of the contact solvers: numbers that no theory gives. Each has its reason beside its value. README.md
!> in this directory has the equations (C..) in which they are used.
module wavycon_contact_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Sequence of grids.

   !> Points of the first grid to half of the surface's shortest wave, along x and y. With fewer points the errors do
   !> not yet fall regularly when the step is halved twice, and (C14) needs these changes.
   integer, parameter, public :: first_points = 8
   !> Largest number of points of the last grid in 1-D, on half of the cell; a surface that is not even has as many on
   !> each half. The limit bounds the time of a load whose accuracy no grid attains.
   integer, parameter, public :: most_points_line = 524288
   !> Largest number of points of the last grid in 2-D, on a quarter of the cell: the arrays take 84 MB. A surface that
   !> is not even has four times as many on the whole cell.
   integer, parameter, public :: most_points_plane = 1048576

   ! Tolerance of the iteration.

   !> epsilon of (C10): a grid is solved until the root mean square gap in contact is this part of the gap at the points
   !> next to the contact. So the iteration adds little to the error of the edge.
   real(dp), parameter, public :: edge_tolerance = 5e-4_dp
   !> Number of iterations on one grid after which the status is iteration_limit, unless the next constant allows more.
   integer, parameter, public :: iteration_limit = 500
   !> Allowed iterations over the square root of (cell's longer side/shortest step of the grid). Random maps on cells of
   !> side ratios up to 1:1000 took up to 4.6 times this square root.
   real(dp), parameter, public :: iterations_of_root = 10.0_dp
   !> A point enters the contact (C8) when its overlap exceeds this part of the allowed residual. A smaller overlap may
   !> be rounding: the point would enter and leave the contact again and again.
   real(dp), parameter, public :: overlap_part = 0.1_dp

   !> A load of a search starts from the pressure of the load before if the loads differ by at most this part.
   real(dp), parameter, public :: largest_change = 0.2_dp

   !> A correction in single precision reduces the residual to this part. Then the gap is computed again in double
   !> precision.
   real(dp), parameter, public :: correction_part = 1e-4_dp
   !> A correction also ends at this part of the allowed residual. The margin is needed because the true residual is a
   !> little larger than that in single precision, and because the gap at the edge, on which (C10) depends, becomes
   !> smaller in the first correction.
   real(dp), parameter, public :: correction_margin = 0.3_dp
   !> Largest number of iterations of one correction.
   integer, parameter, public :: correction_limit = 60
   !> Points within this many steps of the contact may enter it in a correction.
   integer, parameter, public :: halo = 2
   !> Reach of the stencil that approximates S^-1, in steps.
   integer, parameter, public :: stencil_reach = 3
   !> If a smaller part of all points is in contact, the stencil replaces the transforms of S^-1. With 0.01 of 1024 x
   !> 1024 points in contact both take the same time: the stencil needs 10 to 14 iterations, the transforms 7 to 10.
   real(dp), parameter, public :: stencil_fraction = 0.003_dp

   !> Constants of c in (C4c), c = min(1, decay_alone + decay_growth*A^(1/2)), A the contact area fraction. The
   !> preconditioner continues the residual from the contact to the points outside, and the continuation falls by the
   !> factor c for each doubling of the distance. Beside a single spot the factor should be 1/2, as for the displacement
   !> of a point load; in a gap that contact surrounds it should be 1.
   real(dp), parameter, public :: decay_alone = 0.65_dp
   real(dp), parameter, public :: decay_growth = 1.2_dp
   !> The preconditioner is applied again if (C4d) excludes more than this part of the points in contact. With a larger
   !> part the number of iterations grows by up to a half where many points enter at once. With a smaller part the
   !> second application costs more than the few points are worth. On 2048 x 2048 points with 4 or 16 points to the
   !> shortest wave and 20, 50 or 90 % in contact, the six runs together took 1.07 times the time with 0, 1.02 with
   !> 0.001, 1.03 with 0.01, 1.05 with 0.03 and 1.13 without a second application.
   real(dp), parameter, public :: blocked_part = 0.003_dp

   !> The step (C6) that the first iteration of a correction foresees in (C7a): of 2000 steps the mean is .9, and fewer
   !> than a tenth are below .7 or above 1.1 but at light loads.
   real(dp), parameter, public :: first_step = 0.9_dp
   !> Of a change (C7a) whose best part is more than this the whole is taken, so that points leave.
   real(dp), parameter, public :: whole_step = 0.9_dp
   !> If less than this part of the change (C7a) is best, the next step is not foreseen.
   real(dp), parameter, public :: least_foreseen = 0.5_dp

   !> A layer bends like a plate, (C8c), if about some wave the compliance goes with a lower power of the wave number
   !> than this. Layers 3, 5, 10 and 1000 times stiffer than their base have -1.6, -1.9, -2.3 and -3.7. At 3 and
   !> 5 times (C7a), which takes fewer transforms, takes as many iterations as (C7) with (C8c).
   real(dp), parameter, public :: plate_order = -2.0_dp
   !> A correction wanders, and takes (C8c) from then on, if its residual is more than this times that at its start. Of
   !> 252 loads of rough profiles of 4,000 to 200,000 points 42 reached the limit of iterations without (C8c), with 4
   !> one, with 1 and 2 none; all took 39,200, 40,000 and 43,700 iterations with 1, 2 and 4. With 1 most maps, which do
   !> not wander, take (C8c) too.
   real(dp), parameter, public :: wandering_growth = 2.0_dp
   !> A point enters the contact of a plate, or of a correction that wanders, when its overlap exceeds this times the
   !> root mean square gap in contact (C8c). With 1 one of six loads of plates at a ratio of 1000 reached the limit of
   !> iterations, with 2 they took 1.1 to 1.4 times the iterations, with 4 two to three times.
   real(dp), parameter, public :: believed_overlap = 1.5_dp

   ! Error estimates of the grids.

   !> Factor of (C14) on the changes of mean gap, contact area and peak pressure from grid to grid. The errors of these
   !> values fall to a fifth or a quarter from grid to grid, but not regularly; so the factor is above 1.
   real(dp), parameter, public :: change_safety = 1.25_dp
   !> k_Q of (C14) for mean gap and peak pressure: the error estimate is at least this part of that from the change
   !> before. So a last change that is small by chance does not pass for accuracy.
   real(dp), parameter, public :: kept_change = 0.5_dp
   !> k_Q of (C14) for the area: its changes fall to a quarter from grid to grid. With this constant, change_safety and
   !> edge_scatter all of 2465 area estimates of 697 random scenes held, and the largest error was 0.87 of its estimate;
   !> without the factor 1.25 it was 1.09.
   real(dp), parameter, public :: area_kept_change = 0.25_dp
   !> Uncertainty of the place of the edge (C15) at one crossing of a line of the grid, in steps. It matters where the
   !> errors of three grids are equal by chance. On the same scenes the area's root mean square error corresponded to
   !> 0.02 to 0.1 steps for waves at 128 to 512 points a side, and to 0.2 for sums of waves, whose changes are larger
   !> still.
   real(dp), parameter, public :: edge_scatter = 0.1_dp
   !> Uncertainty of the mean place over many crossings (C15), in steps, because all grids may err alike. Tilted waves
   !> showed 0.002 to 0.004.
   real(dp), parameter, public :: edge_bias = 0.003_dp
   !> Half width, in steps, of the largest contact whose peak the polynomial may not resolve (C16): its edge lies
   !> between the first and the second point from the crest.
   real(dp), parameter, public :: unresolved_width = 1.5_dp
   !> A gap may lie beside a point in contact, between the points of the grid, if the pressure of a neighbour is more
   !> than this times the pressure at the point (C15).
   real(dp), parameter, public :: opening_ratio = 2.0_dp
   !> Relative error of mean gap and peak pressure over that of the area, at least (C17). Both converge faster than the
   !> area, but hardly by more than this factor: on the scenes above the gap's largest error was 4.6 times its estimate
   !> with 0.01, and 2.2 times with 0.03.
   real(dp), parameter, public :: least_of_area = 0.03_dp

   ! Search for the load at which area, gap or approach has a given value t, (C18).

   !> The search ends when the value differs from t by this fraction of the value's error estimate: a closer value would
   !> not be more accurate.
   real(dp), parameter, public :: fraction_of_error = 0.01_dp
   !> The tolerance is at least this fraction of min(t, 1 - t): closed forms have no error estimate, and smaller
   !> differences are rounding.
   real(dp), parameter, public :: least_fraction = 1e-12_dp
   !> The tolerance is at most this fraction of min(t, 1 - t): even if the error estimate is as large as t, the value
   !> must come close to t.
   real(dp), parameter, public :: largest_fraction = 1e-4_dp
   !> The tolerance is at least this number of spacings of floating-point numbers at t: the value itself is rounded.
   !> Near t = 1 this is more than the fractions of 1 - t above.
   real(dp), parameter, public :: value_roundings = 4.0_dp
   !> P that a search tries when area or gap no longer depend on the load (`not_found`). It must be below the load that
   !> adds a second point to the contact, about 1e-14 on 1e9 points, and far above the least number in single precision.
   real(dp), parameter, public :: lightest_load = 1e-20_dp
   !> Number of solutions of a search at one level after which the status is not_accurate. To halve a step of
   !> `longest_step` down to rounding takes 45 solutions.
   integer, parameter, public :: most_solves = 60
   !> Longest step in logit P. It is a factor of 20 in the load; over longer distances the graph of the two logits is
   !> not straight.
   real(dp), parameter, public :: longest_step = 3.0_dp
   !> Least slope of the secant. True slopes lie between 1/2 and 5/2 (C18), but a secant between two values whose
   !> difference is below their errors may have any slope.
   real(dp), parameter, public :: flattest = 0.2_dp
   !> Largest slope of the secant. The margin above 5/2 is wide, because a secant that is too steep makes short steps,
   !> not wrong ones.
   real(dp), parameter, public :: steepest = 20.0_dp
   !> Longest upward step of ln P in the search for first yield: a longer step may jump over the first root.
   real(dp), parameter, public :: longest_rise = 0.7_dp
   !> A search at a coarser level ends when the value differs from the target by less than its error estimate and less
   !> than this part of min(t, 1 - t) or of the stress: the value of the next finer level differs by more. The search
   !> also ends when the two loads of the bracket differ by this part, because the value then jumps between them.
   real(dp), parameter, public :: coarse_fraction = 0.02_dp
   !> On grids with coarser levels the search for first yield ends when the stress differs from its target by this part
   !> of the stress's error estimate, but at most by the second constant, relative. On 1024 x 1024 points of self-affine
   !> maps the last coarser level leads so close to the load that one or two solutions on these points are then enough.
   !> With .1 next to full contact it took three, each with a search for the largest stress, which takes longer.
   real(dp), parameter, public :: part_of_stress_error = 0.3_dp, largest_stress_miss = 1e-3_dp
   !> The load of first yield has the status not_accurate if the relative error of the stress is larger than this. This
   !> includes grids of a height map's own points: the largest stress may be that below a single point.
   real(dp), parameter, public :: largest_stress_error = 0.5_dp
   !> The bracket of the load at which contact or gap begins or ends to percolate is halved until it is shorter than
   !> this part of the error that the area's error makes of logit P, and than the second constant (C18a). So it adds at
   !> most .15 of itself to the told error. Next to the load at which spots merge a fitted solution takes up to 7 s.
   real(dp), parameter, public :: part_of_area_error = 0.3_dp, widest_bracket = 2e-3_dp
   !> Factor of (C18b) on what the error of the area makes of that load, beside `change_safety` on its change from the
   !> next coarser level: with 1 the largest error was .96 of its estimate. Contact closes the last neck across a cell
   !> late by a distance of the order of a step, so that the load may converge with the step, not with its square.
   real(dp), parameter, public :: percolation_safety = 2.0_dp
   !> If grids are refined to an accuracy, coarser levels of a search have 10, 100, ... times the error, up to this one.
   !> Less accurate solutions do not help the search, because their areas differ too much from the final ones.
   real(dp), parameter, public :: worst_search_accuracy = 1e-2_dp
   !> If the points of the grid are given, coarser levels of a search have 1/2, 1/4, ... of the points in each
   !> direction, down to this number along the longer side, for the same reason.
   integer, parameter, public :: least_search_points = 64

   ! One spot in a periodic cell, (C27).

   !> A contact is taken as one spot if its area fraction is at most the first constant and the concentration of its
   !> load at least the second. Hertz's contact on 2 % of a square cell has the concentration 0.97. There the next term
   !> after (C27) is of the order of (radius/side)^3 of the approach, 5e-4.
   real(dp), parameter, public :: largest_spot = 0.02_dp, least_concentration = 0.95_dp

   ! The paper's series.

   !> The dual method starts at this load or a higher one, and continues from there to lighter loads. It begins with the
   !> pressure of full contact, whose rounding of 1e-16 must be small against the load. Below this load the active
   !> constraints hardly change, so that the continuation takes few steps.
   real(dp), parameter, public :: lightest_start = 1e-6_dp

   !> The dual method continues from the active constraints of the load before if there are at most this many constraint
   !> points to a harmonic. With 1.02, 1.05, 1.1, 1.5, 1.55 and 3 points to a harmonic ten loads took 0.44, 0.64, 0.64,
   !> 0.98, 0.9 and 1.0 of the time that they took without continuing.
   real(dp), parameter, public :: most_points_to_continue = 1.25_dp

   ! Derivatives with respect to the load.

   !> Difference eta of ln(P/(1 - P)) between the loads whose solutions give derivatives (C29a). Where spots are about
   !> to merge half of it is used. Elsewhere a smaller difference is worse, because the derivatives show more of the
   !> points that enter the contact one after another: at 256 points a side the relative errors of G'' on the two
   !> lattices were 6e-2 and 3e-2 with .1, but 4e-3 and 2e-2 with .2.
   real(dp), parameter, public :: load_difference = 0.2_dp
   !> The scatter of the last changes is at least this part of the scatter of those before (C29d). The scatter falls as
   !> the step to the power 3/2, to .35, from grid to grid; so the constant is a little more.
   real(dp), parameter, public :: kept_scatter = 0.4_dp
   !> Part of the surface without contact up to which gaps between the points of a map are searched (C17c), in 1-D and
   !> 2-D. Where more is open the errors of what the points show are larger. With .01 in 1-D two of 230 gaps are beyond
   !> their estimates, by up to 1.8 times; with .05 in 2-D a load of 1024 x 1024 points at 98 % in contact takes 1.2
   !> times as long.
   real(dp), parameter, public :: most_open(2) = [0.05_dp, 0.01_dp]

   ! Collocation fitted to the edge.

   !> Largest ratio of the sides of a cell that 'fitted' solves: longer spots need polynomials of higher degree.
   real(dp), parameter, public :: largest_aspect_ratio = 3.0_dp
   !> Largest ratio of the two curvatures of a crest that 'fitted' solves, for the same reason.
   real(dp), parameter, public :: largest_curvature_ratio = 50.0_dp

   ! Free edges.

   !> Tolerance of the residual relative to the approach (C28). It is needed where the gap beside the contact is a step,
   !> as beside a punch, because the tolerance (C10) says nothing there. With 5e-5 the iteration error of the approach
   !> is below a tenth of the error estimates of punches of 128 points a side.
   real(dp), parameter, public :: approach_tolerance = 5e-5_dp
   !> The rectangle of a finer grid has the points with h below the approach of the coarser grid plus this part of it.
   !> If the approach of the finer grid is larger still, that grid is solved twice. A part twice as large makes the
   !> rectangle about a ball 1 % wider.
   real(dp), parameter, public :: approach_margin = 0.02_dp

   !> Width of a strip along the border of the map, over the sides of the map. The log tells which part of the load is
   !> carried in this strip: contacts there may lack neighbours beyond the border.
   real(dp), parameter, public :: border = 0.05_dp

end module wavycon_contact_tuning
