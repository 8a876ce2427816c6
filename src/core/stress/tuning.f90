!> The tuned constants of this room. README.md, "Constants", has what changing them does;
!> `scripts/constants --room stress` measures it.
module wavycon_stress_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   ! Series.

   real(dp), parameter, public :: pressure_part = 1e3_dp
      !! Waves are left out where exp(-q Z) is below the error of the pressure [p*] over this. Smaller: the error of
      !! leaving them out shows in the stress. Larger: more waves at depth.

   real(dp), parameter, public :: coarsest = 1e-3_dp
      !! An error of the pressure above this [p*] counts as this: height maps solved on their own points may have errors
      !! of p*, far above the stresses at depth, and waves left out would show as steps.

   ! Scan of planes, for the largest stress of a series. It varies over a distance of about its depth.

   real(dp), parameter, public :: plane_ratio = 1.5_dp
      !! Depth of a plane over that of the plane above it, above 1. Smaller: more planes. Larger: the refinement starts
      !! farther from the maximum.
   real(dp), parameter, public :: waves_in_depth = 9.0_dp
      !! Points of a plane across the cell, times its depth Z. Smaller: maxima fall between the points. Larger: more
      !! expensive planes.
   real(dp), parameter, public :: faintest_on_planes = 9.0_dp
      !! Waves with q Z above this are left out. Smaller: other points seem to have the largest stress. Larger: more
      !! waves.
   integer, parameter, public :: plane_points = 24
      !! Fewest points of a plane across the cell. As waves_in_depth.

   integer, parameter, public :: window_points = 64
      !! Points of a window across, a multiple of 8. Larger: windows take as long as whole planes. Smaller: more planes
      !! of the whole cell.
   real(dp), parameter, public :: window_depth = 0.125_dp
      !! Depth down to which planes are those of windows, over their sides. Larger: the pressures beyond the window
      !! count. Smaller: more planes of the whole cell.
   real(dp), parameter, public :: least_pressure = 0.5_dp
      !! Largest pressure in a window over that of the cell below which there is none. Larger: a maximum may be missed.
      !! Smaller: whole planes where windows would take less time.

   ! Start places of expansions. Fewer: a maximum may be missed. More: each is another place to evaluate.

   real(dp), parameter, public :: edge_ratios(*) = [0.5_dp, 0.9_dp, 1.0_dp, 1.1_dp, 1.4_dp]
      !! Distances from the centre of a spot or pool, over that of its edge.
   real(dp), parameter, public :: depths_of_spot(*) = [0.0_dp, 0.1_dp, 0.25_dp, 0.5_dp, 0.9_dp]
      !! Depths over the radius of a spot or pool.
   real(dp), parameter, public :: depths_of_cell(*) = [0.03_dp, 0.07_dp, 0.12_dp, 0.2_dp]
      !! Depths over the distance of crests, where spots have merged.

   ! Free edges.

   real(dp), parameter, public :: shift_of_smooth = 0.05_dp
      !! d of (S11) over the shorter side of the map. Larger: the images show in the stresses. Smaller: more forces.
   real(dp), parameter, public :: steps_in_shift = 3.0_dp
      !! Fewest steps of the lattice of forces in d. Smaller: the lattice shows in the stresses. Larger: more forces.
   integer, parameter, public :: nodes = 8
      !! Forces of a block each way. Smaller: blocks have other fields than their load. Larger: more forces.
   real(dp), parameter, public :: whole_from = 1.75_dp
      !! Distance from which a block is seen as a whole, over its longer side. As nodes.
   real(dp), parameter, public :: smooth_places = 6.0_dp
      !! Places on a plane in d and its depth. Smaller: the stresses between them are wrong. Larger: more places.

   ! Refinement of the largest stress.

   integer, parameter, public :: refined_places = 3
      !! Most start places that are refined. Smaller: a lower maximum may be taken for the largest. Larger: more time.
   real(dp), parameter, public :: close_to_largest = 0.75_dp
      !! Start places whose stress is below this part of the largest one there are not refined, below 1. Larger: a lower
      !! maximum may be taken for the largest. Smaller: more time.
   real(dp), parameter, public :: gain_part = 0.1_dp
      !! The search ends when a step gains less than this part of the estimated error of the stress. Larger: the search
      !! adds to the error. Smaller: more steps.
   real(dp), parameter, public :: search_accuracy = 1e-6_dp
      !! It ends no earlier than at a gain of this part of the stress. As gain_part.
   real(dp), parameter, public :: likely_gain = 3.0_dp
      !! A place is given up when its stress would stay below the largest one found even if later models gained so many
      !! times what the last one did. Smaller: a lower maximum may be taken for the largest. Larger: more time.
   real(dp), parameter, public :: first_reach = 0.25_dp
      !! Distance of the points of the first quadratic model, over the width of the maximum. Larger: the stress is not
      !! quadratic over it. Smaller: the maximum is outside the model.
   real(dp), parameter, public :: reach_factor = 0.2_dp
      !! Factor of that distance from one model to the next. Larger: more models. Smaller: the maximum is outside.
   integer, parameter, public :: most_models = 8
      !! Most models of one search. Smaller: searches that do not reach their maximum. Larger: searches that go on in
      !! rounding.

   integer, parameter, public :: expansion_order = 8
      !! Of the Taylor series that a series of waves is evaluated by. Smaller: the search follows its errors. Larger:
      !! more to add up for each wave.
   real(dp), parameter, public :: noise_part = 1e-3_dp
      !! A known series serves a model if its error there is below this part of what the stress changes by over the
      !! model's reach. Larger: the search follows errors of the series. Smaller: more of them.

   ! Estimates of errors.

   real(dp), parameter, public :: octave_factor = 2.0_dp
      !! Error of a grid's stress near the edge of contact over the waves of its last octave, (S5). Smaller: estimates
      !! below the true error. Larger: estimates that are too large.
   real(dp), parameter, public :: error_of_invariant = 2.0_dp
      !! Error of a von Mises stress or a shear stress over that of the components, (S7). As octave_factor.
end module wavycon_stress_tuning
