!> A scene: all that a deck describes. It has the checked values of the deck's groups with every default set, the
!> surface, and the loads in the program's normalisation (pressures in p*, gaps in Delta).
module wavycon_scene
   use wavycon_key_table, only: name_length
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_roughness, only: roughness_type
   use wavycon_scene_groups, only: interface_group, load_group, material_group, method_group, output_group, &
      scene_group, stress_group, surface_group
   use wavycon_stress_setting, only: stress_setting
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: scene_type, interface_setting

   !> The quantity by which a deck gives its loads: the values of loads_by.
   integer, parameter, public :: by_pressure = 1, by_mean_gap = 2, by_contact_area = 3, by_yield = 4, by_approach = 5, &
      by_percolation = 6
   !> These quantities as headings of the log, in the same order.
   character(19), parameter, public :: target_words(6) = [character(19) :: 'pbar/p*', 'gap/Delta', 'area/A0', &
      'stress/yield stress', 'approach/Delta', 'percolation']

   !> The values of &interface that computations need. Equations (I..) are those of src/beyond/README.md.
   type :: interface_setting
      real(dp) :: resistivity = 0.0_dp   !! sum of the bodies' resistivities rho_1 + rho_2, in the deck's unit; 0: none
      real(dp) :: friction = 0.0_dp      !! coefficient of friction f; 0: not given
      !> Tangential loads Q: mean tangential tractions in p* or, if `over_mean_pressure`, over the mean pressure.
      real(dp), allocatable :: tangential(:)
      logical :: over_mean_pressure = .false.
      !> kappa, the tangential compliance of a wave over its normal compliance (I12): the value in use, and the least
      !> and the largest value over the directions of waves.
      real(dp) :: kappa(3) = 1.0_dp
      real(dp) :: beta = 0.0_dp          !! Dundurs' second parameter, which partial slip neglects
      real(dp) :: work = 0.0_dp          !! work of adhesion w' = w/(p* Delta); 0: not given
   end type interface_setting

   type :: scene_type
      character(:), allocatable :: deck_path        !! path of the deck's file as the caller gave it
      character(:), allocatable :: case             !! stem of the names of result files
      character(:), allocatable :: directory        !! directory of the results
      character(:), allocatable :: resolved_deck    !! text of a deck with the value in effect of every key
      !> The resolved deck without the paths of deck and results: checkpoints identify a run by it. Not allocated for a
      !> deck in memory, which is not run.
      character(:), allocatable :: fingerprint
      type(surface_type), allocatable :: surface    !! not allocated once start_results has given it to the solver
      type(map_statistics), allocatable :: map      !! statistics of a height map; not allocated for other surfaces
      !> Statistics of the first and the second of two maps, of which `map` is the sum; not allocated for other
      !> surfaces.
      type(map_statistics), allocatable :: two_maps(:)
      type(roughness_type) :: roughness             !! root mean squares of height, slope and curvature of the surface
      character(:), allocatable :: pressure_unit    !! label of the deck's unit of pressures, such as 'MPa'
      character(:), allocatable :: length_unit      !! label of the deck's unit of lengths, such as 'mm'
      real(dp) :: e_star = 1.0_dp                   !! plane-strain modulus [pressure]
      logical :: gives_modulus = .false.            !! whether the deck gives a modulus
      !> Whether the deck gives a modulus or labels of units: its numbers are then not normalised.
      logical :: has_units = .false.
      character(:), allocatable :: decimal_commas   !! names of keys with `has_decimal_commas`, ', ' before each
      real(dp) :: p_star = 0.0_dp                   !! p*, mean pressure that just closes the gap [pressure]
      integer :: loads_by = by_pressure             !! by_pressure or another of the names above
      !> The loads in the deck's order, by loads_by: P, G, the contact area fraction, the largest equivalent stress over
      !> the yield stress, the approach over Delta, or the place in `percolations`.
      real(dp), allocatable :: target(:)
      real(dp), allocatable :: mean_pressure(:)     !! the loads [pressure], if loads_by is by_pressure
      !> The values of the groups: `scene_values` and `surface_values` of &scene and &surface, the others of their
      !> names.
      type(scene_group) :: scene_values
      type(material_group) :: material
      type(surface_group) :: surface_values
      type(load_group) :: load
      type(stress_group) :: stress
      type(interface_group) :: interface
      type(method_group) :: method
      type(output_group) :: output
      character(2*name_length), allocatable :: asked_for(:)   !! 'group.key' of keys that request tables: key_list
      type(stress_setting), allocatable :: stress_setting   !! allocated if the deck has &stress
      type(interface_setting), allocatable :: interface_setting   !! allocated if the deck has &interface
   end type scene_type

end module wavycon_scene
