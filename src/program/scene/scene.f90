!> A scene: all that a deck describes, the checked values of its groups with every default set, the surface, and the
!> loads in the program's normalisation (pressures in p*, gaps in Delta).
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

   !> The quantity by which a deck gives its loads.
   integer, parameter, public :: by_pressure = 1, by_mean_gap = 2, by_contact_area = 3, by_yield = 4, by_approach = 5
   !> The same as headings.
   character(19), parameter, public :: target_words(5) = [character(19) :: 'pbar/p*', 'gap/Delta', 'area/A0', &
      'stress/yield stress', 'approach/Delta']

   !> What a scene asks of the interface. Equations (I..) are those of src/beyond/README.md.
   type :: interface_setting
      real(dp) :: resistivity = 0.0_dp   !! rho_1 + rho_2, in the deck's unit; 0: not given
      real(dp) :: friction = 0.0_dp      !! f; 0: not given
      !> Q, the mean tangential traction [p*] or, if `over_mean_pressure`, over the mean pressure.
      real(dp), allocatable :: tangential(:)
      logical :: over_mean_pressure = .false.
      !> kappa, the tangential compliance of a wave over the normal one (I12); its least and its largest value.
      real(dp) :: kappa(3) = 1.0_dp
      real(dp) :: beta = 0.0_dp          !! Dundurs' second parameter, which partial slip neglects
      real(dp) :: work = 0.0_dp          !! of adhesion, w' = w/(p* Delta); 0: not given
   end type interface_setting

   type :: scene_type
      character(:), allocatable :: deck_path        !! the deck's file, as the caller named it
      character(:), allocatable :: case             !! stem of the names of result files
      character(:), allocatable :: directory        !! of the results
      character(:), allocatable :: resolved_deck    !! text of a deck with the value in effect of every key
      character(:), allocatable :: fingerprint   !! the same without the paths of deck and results, for checkpoints
      type(surface_type), allocatable :: surface    !! not allocated once a solver is started, which has it
      type(map_statistics), allocatable :: map      !! allocated for a height map
      type(roughness_type) :: roughness             !! of the surface
      character(:), allocatable :: pressure_unit    !! label of the deck's unit of pressures, such as 'MPa'
      character(:), allocatable :: length_unit      !! label of its unit of lengths
      real(dp) :: e_star = 1.0_dp                   !! plane-strain modulus [pressure]
      logical :: gives_modulus = .false.            !! whether the deck gives it
      logical :: has_units = .false.                !! whether it gives a modulus or labels of units: not normalised
      real(dp) :: p_star = 0.0_dp                   !! p*, mean pressure that just closes the gap [pressure]
      integer :: loads_by = by_pressure             !! one of the names above
      !> P, G, the contact area fraction, the approach over Delta or the largest equivalent stress over the yield
      !> stress, in the deck's order.
      real(dp), allocatable :: target(:)
      real(dp), allocatable :: mean_pressure(:)     !! [pressure]; allocated where loads are given by pressure
      !> The groups of these names; `scene_values` and `surface_values` are &scene and &surface.
      type(scene_group) :: scene_values
      type(material_group) :: material
      type(surface_group) :: surface_values
      type(load_group) :: load
      type(stress_group) :: stress
      type(interface_group) :: interface
      type(method_group) :: method
      type(output_group) :: output
      character(2*name_length), allocatable :: asked_for(:)   !! 'group.key' of all keys that ask for something
      type(stress_setting), allocatable :: stress_setting   !! allocated if the deck has &stress
      type(interface_setting), allocatable :: interface_setting   !! allocated if the deck has &interface
   end type scene_type

end module wavycon_scene
