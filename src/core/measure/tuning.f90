!> Tuned constants of the measures: numbers that no theory gives. Each has its reason beside it. README.md in
!> src/core/contact, and of histograms in this directory, derives what they multiply.
module wavycon_measure_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Place of the edge of contact on a grid in 2-D, (C12).

   !> Weight of a gap against a pressure next to the edge. With it the offset below is nearly the same for all
   !> directions of a straight edge against the grid: 0.127 to 0.131 steps on tilted waves of 100 points to a wave, 23
   !> directions.
   real(dp), parameter, public :: gap_weight = 1.725_dp
   !> Distance of the edge from the place where pressure and weighted gap balance, in steps, into the contact, of the
   !> same waves. With 0.127 the area of the wave (21) at 512 points a side is off by 2.8e-6, with 0.128 by 2.3e-6 (root
   !> mean squares).
   real(dp), parameter, public :: edge_offset = 0.128_dp
   !> Slope of the edge against a line of the grid below which it counts as running along it, the more the flatter it
   !> is. With it the error of the area of the wave (21), on grids along the sides of its spots, falls to a third at 256
   !> points and to a fifth at 512; twice and three times the value do no better.
   real(dp), parameter, public :: aligned_slope = 0.1_dp
   !> Correction of the area for each turn of the edge about a contact, in cells: 2 pi times the part of the error that
   !> goes with the curvature. Without it the area is off by -0.59 to -0.81 for each spot and 1.35 to 1.47 for
   !> each hole, of which -0.15 and 0.95 do not come from the curvature.
   real(dp), parameter, public :: turn_area = 0.56_dp

   ! The same three on a surface with free edges, whose pressures are uniform on the cells of the grid: Hertz's contact
   ! of a ball, 40 loads, 2 to 54 cells of radius.

   !> With it the area's error has the least scatter, 0.26 cells; 0.28 with 1.15 and 1.3.
   real(dp), parameter, public :: cell_gap_weight = 1.225_dp
   !> Slope and intercept of the area's error against the length of the edge.
   real(dp), parameter, public :: cell_edge_offset = 0.160_dp
   real(dp), parameter, public :: cell_turn_area = 0.80_dp

   ! Histograms, (A7) of README.md in this directory.

   !> Points in 1-D at which solutions that have no grid are sampled: bins of 1 % of the period are right to 0.1 %.
   integer, parameter, public :: line_samples = 262144
   !> Points along x and y in 2-D. A load of the wave (21) takes 0.15 s; with 512 points the errors are 3 to 5 times
   !> larger, 4096 need 2 s.
   integer, parameter, public :: plane_samples = 1024

end module wavycon_measure_tuning
