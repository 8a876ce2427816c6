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
   !> Likewise in 2-D, on a quarter of the cell: 84 MB of arrays; on the whole cell four times as many.
   integer, parameter, public :: most_points_plane = 1048576

   ! Tolerance of the iteration.

   !> A grid of step h is solved to a residual of this times h^(3/2) P^(1/3) of the mean gap, so that the iteration adds
   !> little to the error of the discretisation.
   real(dp), parameter, public :: tolerance_factor = 1e-3_dp
   !> Tolerance of a grid whose points the user gives: its values are compared with those of other programs.
   real(dp), parameter, public :: given_grid_tolerance = 1e-11_dp
   !> Iterations on one grid, after which the status is iteration_limit.
   integer, parameter, public :: iteration_limit = 500
   !> A point enters the contact when its overlap exceeds this part of the allowed residual. Smaller overlaps may be
   !> rounding: such points would enter and leave without end.
   real(dp), parameter, public :: overlap_part = 0.1_dp

   ! Error estimates of the grids.

   !> Factor on the change of the mean gap from grid to grid, whose errors fall to a fifth. Above 1, as their fall is
   !> not regular.
   real(dp), parameter, public :: gap_safety = 1.25_dp
   !> Likewise of the contact area. It is larger, as the area's change depends on how the edge lies between the points.
   real(dp), parameter, public :: area_safety = 2.0_dp
   !> Likewise of the peak pressure.
   real(dp), parameter, public :: peak_safety = 1.25_dp
   !> The part of the change before that an error estimate keeps, so that one change that is small by chance does not
   !> pass for accuracy.
   real(dp), parameter, public :: kept_change = 0.5_dp
   !> Uncertainty of the edge's place at one point of it, in steps: two to three times the root mean squares of 0.10 to
   !> 0.16 that were measured on 432 solutions of the 2-D wave, lambda_y/lambda = 0.4 .. 1.3, 128 to 512 points a side.
   !> With 0.1 the area's error was up to 2.5 times its estimate where the errors of three grids are alike by chance.
   real(dp), parameter, public :: edge_scatter = 0.3_dp
   !> Its mean over many points of the edge, in steps, where mirror lines tie the grid to the surface: 0.002 to 0.016 on
   !> the same solutions.
   real(dp), parameter, public :: edge_bias_even = 0.005_dp
   !> Likewise on whole cells: there the errors of three grids may be alike by chance.
   real(dp), parameter, public :: edge_bias_whole = 0.02_dp
   !> Half width, in steps, of a contact whose peak the polynomial does not resolve: its edge may lie between the first
   !> and the second point from the crest.
   real(dp), parameter, public :: unresolved_width = 1.5_dp
   !> A point whose pressure is less than that of a neighbour over this may have a gap beside it, between the points.
   real(dp), parameter, public :: opening_ratio = 2.0_dp
   !> The least relative error of mean gap and peak pressure over that of the area. Both converge faster than the area,
   !> but not by much more than this.
   real(dp), parameter, public :: least_of_area = 0.01_dp

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
   !> Solutions of a search at one accuracy, after which the status is not_accurate. To halve a step of `longest_step`
   !> down to rounding takes 45.
   integer, parameter, public :: most_solves = 60
   !> Longest step in logit P, a factor of 20 in the load: over longer distances the two logits are no straight line.
   real(dp), parameter, public :: longest_step = 3.0_dp
   !> Least slope that the secant may have. Slopes lie between 1/2 and 5/2 (C18); where two values differ by less than
   !> their errors the secant may have any slope.
   real(dp), parameter, public :: flattest = 0.2_dp
   !> Largest slope, likewise. The margin over 5/2 is wide: too steep a secant makes short steps, not wrong ones.
   real(dp), parameter, public :: steepest = 20.0_dp
   !> Grids refined to an accuracy search first with ten times, then a hundred times lower accuracies, down to this.
   !> Less accurate solutions do not help the search: their areas differ too much from the final ones.
   real(dp), parameter, public :: worst_search_accuracy = 1e-2_dp
   !> Grids of given points search first on grids with half the points each way, down to this number along the longer
   !> side, for the same reason.
   integer, parameter, public :: least_search_points = 64

   ! The paper's series.

   !> The dual method starts at this load or a higher one and passes on to lighter ones. It begins with the pressure of full
   !> contact, whose rounding of 1e-16 must be small beside the load; and at lighter loads the active constraints hardly
   !> change, so that the pass takes few steps.
   real(dp), parameter, public :: lightest_start = 1e-6_dp

   ! Expansions fitted to the edge.

   !> Largest ratio of the sides of a cell: longer spots need polynomials of higher degree.
   real(dp), parameter, public :: largest_aspect_ratio = 3.0_dp
   !> Largest ratio of the two curvatures of a crest, for the same reason.
   real(dp), parameter, public :: largest_curvature_ratio = 50.0_dp

end module wavycon_contact_tuning
