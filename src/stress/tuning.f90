!> The tuned constants of this room. README.md, "Constants", has what changing them does; `scripts/constants --room stress`
!> measures it.
module wavycon_stress_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   public

   !> Waves of a series of pressure with an error are left out where exp(-q Z) is less than that error [p*] over this.
   real(dp), parameter :: pressure_part = 1e3_dp

   !> An error above this [p*] counts as this: height maps solved on their own points may have errors of p*, far above the
   !> stresses at depth, and waves left out would show as steps.
   real(dp), parameter :: coarsest = 1e-3_dp

   !> Search on planes: the depth of a plane over that of the plane above it; the number of points across a cell times the
   !> depth Z; the fewest points of a plane along a side. The largest stress has a width of about its depth.
   real(dp), parameter :: plane_ratio = 1.5_dp, waves_in_depth = 14.0_dp
   integer, parameter :: plane_points = 24

   !> Start places of expansions: distances from the centre of a spot or island over that of its edge, depths over its
   !> radius, and depths over the distance of crests where spots have merged.
   real(dp), parameter :: edge_ratios(*) = [0.5_dp, 0.9_dp, 1.0_dp, 1.1_dp, 1.4_dp]
   real(dp), parameter :: depths_of_spot(*) = [0.0_dp, 0.1_dp, 0.25_dp, 0.5_dp, 0.9_dp]
   real(dp), parameter :: depths_of_cell(*) = [0.03_dp, 0.07_dp, 0.12_dp, 0.2_dp]

   !> Refinement: the number of best places that are refined, and how close to the best place their stress must be; the gain
   !> that ends the search over the error of the stress, at most over the stress; first distance of the points of its quadratic model over
   !> the width of the stress; the factor by which this falls; the most models.
   integer, parameter :: refined_places = 3
   real(dp), parameter :: close_to_largest = 0.75_dp, gain_part = 0.1_dp, &
                          search_accuracy = 1e-6_dp
   real(dp), parameter :: first_reach = 0.25_dp, reach_factor = 0.2_dp
   integer, parameter :: most_models = 8

   !> The error of a stress near the edge of contact over the waves of a grid's last octave there.
   real(dp), parameter :: octave_factor = 2.0_dp

   !> The error of a von Mises stress or a shear stress over that of the components.
   real(dp), parameter :: error_of_invariant = 2.0_dp
end module wavycon_stress_tuning
