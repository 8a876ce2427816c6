!> The tables of keys of all groups of a deck.
module wavycon_deck_tables
   use wavycon_key_table, only: key_group_type
   use wavycon_interface_group, only: interface_table
   use wavycon_load_group, only: load_table
   use wavycon_material_group, only: material_table
   use wavycon_methods, only: method_table
   use wavycon_output_group, only: output_table
   use wavycon_scene_group, only: scene_table
   use wavycon_stress_group, only: stress_table
   use wavycon_surface_group, only: surface_table
   implicit none (type, external)
   private

   public :: deck_tables

   !> The groups of a deck, in the order in which they are documented and written.
   integer, parameter, public :: scene_number = 1, material_number = 2, surface_number = 3, load_number = 4, &
      stress_number = 5, interface_number = 6, method_number = 7, output_number = 8, number_of_groups = 8

contains

   !> The tables of keys of all groups, indexed by the numbers above. They are made once and stay.
   function deck_tables() result(tables)
      type(key_group_type), pointer :: tables(:)

      type(key_group_type), allocatable, target, save :: made(:)

      if (.not. allocated(made)) then
         allocate (made(number_of_groups))
         made(scene_number) = scene_table()
         made(material_number) = material_table()
         made(surface_number) = surface_table()
         made(load_number) = load_table()
         made(stress_number) = stress_table()
         made(interface_number) = interface_table()
         made(method_number) = method_table()
         made(output_number) = output_table()
      end if
      tables => made
   end function deck_tables

end module wavycon_deck_tables
