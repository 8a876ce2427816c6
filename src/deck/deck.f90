!> A deck: the values of its groups, checked, with every default set, and the surface that it describes.
module wavycon_deck
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_group_type
   use wavycon_interface_group, only: interface_table
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: load_table
   use wavycon_map_statistics, only: map_statistics
   use wavycon_material_group, only: material_table
   use wavycon_methods, only: method_table
   use wavycon_output_group, only: output_table
   use wavycon_scene_group, only: scene_table
   use wavycon_stress_group, only: stress_table
   use wavycon_surface, only: surface_type
   use wavycon_surface_group, only: surface_table
   implicit none (type, external)
   private

   public :: deck_type, deck_tables

   !> The groups of a deck, in the order in which they are documented and written.
   integer, parameter, public :: scene_number = 1, material_number = 2, surface_number = 3, load_number = 4, &
      stress_number = 5, interface_number = 6, method_number = 7, output_number = 8, number_of_groups = 8

   type :: deck_type
      character(:), allocatable :: path            !! the deck's file, as the caller named it
      type(group_values) :: scene, material, surface_values, load, stress, interface, method, output
      real(dp) :: e_star = 0.0_dp, p_star = 0.0_dp !! E*, p* [pressure]
      type(surface_type), allocatable :: surface   !! `make_scene` moves it into the scene
      type(map_statistics), allocatable :: map     !! allocated for a height map; `make_scene` moves it too
   end type deck_type

contains

   !> The tables of keys of all groups, indexed by the numbers above.
   function deck_tables() result(tables)
      type(key_group_type) :: tables(number_of_groups)

      tables(scene_number) = scene_table()
      tables(material_number) = material_table()
      tables(surface_number) = surface_table()
      tables(load_number) = load_table()
      tables(stress_number) = stress_table()
      tables(interface_number) = interface_table()
      tables(method_number) = method_table()
      tables(output_number) = output_table()
   end function deck_tables

end module wavycon_deck
