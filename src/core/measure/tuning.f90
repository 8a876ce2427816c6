!> Tuned constants of the measures: numbers that no theory gives, each with its reason. The formulas that they belong to
!> are derived in src/core/contact/README.md and, for histograms, in README.md of this directory.
module wavycon_measure_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Position of the edge of contact on a grid in 2-D, (C12).

   !> Weight of a gap against a pressure next to the edge. With this value the offset below is nearly the same for all
   !> directions of a straight edge against the grid: 0.127 to 0.131 grid steps, on tilted waves of 100 points a wave in
   !> 23 directions.
   real(dp), parameter, public :: gap_weight = 1.725_dp
   !> Distance of the edge from the point where pressure and weighted gap balance, into the contact [grid steps], for
   !> the same waves. With 0.127 the error of the area of the wave (21) at 512 points a side is 2.8e-6, with 0.128 it is
   !> 2.3e-6 (root mean squares).
   real(dp), parameter, public :: edge_offset = 0.128_dp
   !> An edge whose slope against a line of the grid is less than this is placed by (C11) in part, the more the smaller
   !> its slope. With this value the error of the area of the wave (21), on grids along the sides of its spots, falls to
   !> a third at 256 points and to a fifth at 512. Twice and three times the value do no better.
   real(dp), parameter, public :: aligned_slope = 0.1_dp
   !> Correction of the area for each full turn of the edge around a contact [grid cells]: 2 pi times the part of the
   !> error that is proportional to the curvature. Without this correction the error of the area is -0.59 to -0.81 for
   !> each spot and 1.35 to 1.47 for each hole, of which -0.15 and 0.95 do not come from the curvature.
   real(dp), parameter, public :: turn_area = 0.56_dp

   ! The same constants for a surface with free edges, whose pressures are uniform on the cells of the grid. They are
   ! from Hertz's contact of a ball at 40 loads, with contact radii of 2 to 54 cells.

   !> With this weight the error of the area has the least scatter, 0.26 cells. With 1.15 and with 1.3 it is 0.28.
   real(dp), parameter, public :: cell_gap_weight = 1.225_dp
   !> Slope and intercept of the area's error as a function of the length of the edge.
   real(dp), parameter, public :: cell_edge_offset = 0.160_dp
   real(dp), parameter, public :: cell_turn_area = 0.80_dp

   ! The peak on grids that do not resolve the waves of the surface, (C13a).

   !> A local maximum of the points is raised by this times what cubic interpolation midway to its larger neighbour adds
   !> to linear interpolation. Beside a kink on a mirror line the pressure rises so much more. With 2 the peak of rough
   !> maps may exceed all that were raised and left out, with 4 the told errors grow.
   real(dp), parameter, public :: rise_factor = 3.0_dp
   !> Number of local maxima about which the pressure is interpolated, in 1-D and 2-D, where each takes 0.3 % of the
   !> time of a load on 1024 x 1024 points.
   integer, parameter, public :: most_crests(2) = [6, 2]
   !> Points to a wave of the surface's shortest ones, from which on the polynomial of degree 5 through the points is
   !> enough: it misses the crest of such a wave by 1e-3 of its amplitude.
   integer, parameter, public :: resolved_points = 8

   ! Histograms, (A7) of README.md in this directory.

   !> Number of points in 1-D at which solutions without a grid are sampled. Bins of 1 % of the period then have errors
   !> of 0.1 %.
   integer, parameter, public :: line_samples = 262144
   !> Number of points along x and along y in 2-D. A load of the wave (21) takes 0.15 s. With 512 points the errors are
   !> 3 to 5 times larger, and 4096 points take 2 s.
   integer, parameter, public :: plane_samples = 1024

end module wavycon_measure_tuning
