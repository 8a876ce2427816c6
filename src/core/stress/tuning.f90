!> The tuned constants of this directory. README.md, "Constants", says what a change of each one does;
!> `scripts/constants --directory stress` measures this.
module wavycon_stress_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Series.

   real(dp), parameter, public :: pressure_part = 1e3_dp
      !! Waves are left out where exp(-q Z) is below the error of the pressure [p*] over this number. Smaller: the waves
      !! that are left out show in the stress. Larger: more waves are added up at depth.

   real(dp), parameter, public :: coarsest = 1e-3_dp
      !! Upper bound of the error of the pressure [p*] in the rule above. Height maps solved on their own points may
      !! have errors of p*, far above the stresses at depth. Without the bound so many waves would be left out that the
      !! stresses jump from one depth to the next.

   ! Scan of planes, for the largest stress of a series. The stress varies over a distance of about the depth.

   real(dp), parameter, public :: plane_ratio = 1.5_dp
      !! Depth of a plane over the depth of the plane above, > 1. Smaller: more planes. Larger: the refinement starts
      !! farther from the maximum.
   integer, parameter, public :: shallow_planes = 2
      !! Planes between the surface and the depth of half of the shortest wavelength. Smaller: the stress below a spot
      !! of one or two points is missed. Larger: more planes.
   real(dp), parameter, public :: least_depth = 0.48_dp
      !! Planes no deeper than a step of the grid are left out if the next one is less deep than this times the half
      !! width of the sharpest high peak of the pressure. At .48 radii the stress below a round Hertzian spot is the
      !! largest (nu = 0.3). Larger: a maximum may lie above the planes. Smaller: more planes.
   real(dp), parameter, public :: waves_in_depth = 9.0_dp
      !! Points of a plane across the cell, times its depth Z. Smaller: maxima fall between the points. Larger: more
      !! expensive planes.
   real(dp), parameter, public :: faintest_on_planes = 9.0_dp
      !! Waves with q Z above this are left out of the scan. Smaller: the largest stress may appear at wrong points.
      !! Larger: more waves.
   integer, parameter, public :: plane_points = 24
      !! Fewest points of a plane across the cell. Smaller: maxima fall between the points. Larger: more expensive
      !! planes.

   integer, parameter, public :: window_points = 64
      !! Points of a window across, a multiple of 8. Larger: windows take as long as whole planes. Smaller: more planes
      !! of the whole cell.
   real(dp), parameter, public :: window_depth = 0.125_dp
      !! The deepest plane of windows: its depth over the side of a window. Larger: pressures outside of the window,
      !! which are neglected, become important. Smaller: more planes of the whole cell.
   real(dp), parameter, public :: least_pressure = 0.5_dp
      !! Windows are used if those whose largest pressure is at least this part of the cell's largest one cover at most
      !! a quarter of the cell. Larger: windows are used where they are many. Smaller: planes of the whole cell where
      !! windows would take less time.

   ! Start places of the search below fitted functions. Fewer: a maximum may be missed. More: each one is evaluated.

   real(dp), parameter, public :: edge_ratios(*) = [0.5_dp, 0.9_dp, 1.0_dp, 1.1_dp, 1.4_dp]
      !! Distances of start places from the centre of a spot or pool, over the distance of its edge from the centre.
   real(dp), parameter, public :: depths_of_spot(*) = [0.0_dp, 0.1_dp, 0.25_dp, 0.5_dp, 0.9_dp]
      !! Depths of start places over the radius of a spot or pool.
   real(dp), parameter, public :: depths_of_cell(*) = [0.03_dp, 0.07_dp, 0.12_dp, 0.2_dp]
      !! Depths of start places over the distance of crests, where spots have merged.

   ! Free edges.

   real(dp), parameter, public :: shift_of_smooth = 0.05_dp
      !! The depth d of (S11) over the shorter side of the map. Larger: the stresses of the images are not removed well.
      !! Smaller: more forces.
   real(dp), parameter, public :: steps_in_shift = 3.0_dp
      !! Least ratio of d to the step of the lattice of forces. Smaller: the stresses are those of separate forces.
      !! Larger: more forces.
   integer, parameter, public :: nodes = 8
      !! Forces of a block along each direction. Smaller: the field of a block differs from that of the forces that it
      !! replaces. Larger: more forces.
   real(dp), parameter, public :: whole_from = 1.75_dp
      !! Least distance at which a block replaces its forces, over the block's longer side. Smaller: the field of the
      !! block differs from that of the forces. Larger: more forces.
   real(dp), parameter, public :: smooth_places = 6.0_dp
      !! Sum of d and the depth of a plane, over the distance of the points at which the smooth part is computed there.
      !! Smaller: the interpolation between them has larger errors. Larger: more points.

   ! Refinement of the largest stress.

   integer, parameter, public :: refined_places = 3
      !! Most start places that are refined. Smaller: a lower maximum may be taken for the largest. Larger: more time.
   real(dp), parameter, public :: close_to_largest = 0.75_dp
      !! Start places whose stress is below this part of the largest one among them are not refined; < 1. Larger: a
      !! lower maximum may be taken for the largest. Smaller: more time.
   real(dp), parameter, public :: gain_part = 0.1_dp
      !! The search ends when a step gains less than this part of the estimated error of the stress. Larger: the search
      !! adds to the error. Smaller: more steps.
   real(dp), parameter, public :: search_accuracy = 1e-6_dp
      !! The search does not end before a step gains less than this part of the stress. Larger: the search adds to the
      !! error. Smaller: more steps.
   real(dp), parameter, public :: likely_gain = 3.0_dp
      !! A place is given up when its stress plus this many gains of the last model stays below the largest stress
      !! found. Smaller: a lower maximum may be taken for the largest. Larger: more time.
   real(dp), parameter, public :: first_reach = 0.25_dp
      !! Distance of the points of the first quadratic model over the width of the maximum. Larger: the stress is not
      !! quadratic within the model. Smaller: the maximum is outside of the model.
   real(dp), parameter, public :: reach_factor = 0.2_dp
      !! Factor of the distance of the points from one model to the next. Larger: more models. Smaller: the maximum is
      !! outside of the next model.
   integer, parameter, public :: most_models = 8
      !! Most models of one search. Smaller: searches that do not reach their maximum. Larger: searches that go on
      !! though the gains are rounding.

   integer, parameter, public :: taylor_order = 8
      !! Order N of the Taylor series (S9), which replaces the sum over waves near a place. Smaller: the search follows
      !! errors of the series. Larger: more moments are added up for each wave.
   real(dp), parameter, public :: noise_part = 1e-3_dp
      !! A known Taylor series is used for a model if its error there is below this part of the change of the stress
      !! over the model's reach. Larger: the search follows errors of the series. Smaller: more series are made.

   ! Estimates of errors.

   real(dp), parameter, public :: octave_factor = 2.0_dp
      !! Error of a grid's stress near the edge of contact over the amplitude of the waves of the last octave, (S5).
      !! Smaller: estimates below the true error. Larger: estimates that are too large.
   real(dp), parameter, public :: told_of_edges = 0.6_dp
      !! Part of (S15a) that is told as the error of a grid's stress at a depth: its energy follows from that of the
      !! approach, which is mostly told ten times too large. Smaller: estimates below the true error. Larger: estimates
      !! that are too large.
   real(dp), parameter, public :: error_of_invariant = 2.0_dp
      !! Error of a von Mises stress or a shear stress over that of the components, (S7). Smaller: estimates below the
      !! true error. Larger: estimates that are too large.
end module wavycon_stress_tuning
