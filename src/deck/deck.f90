!> A deck: everything that a deck file says, checked, with every default filled in.
module wavycon_deck
   use wavycon_load_group, only: load_group_type
   use wavycon_material_group, only: material_group_type
   use wavycon_method_group, only: method_group_type
   use wavycon_output_group, only: output_group_type
   use wavycon_scene_group, only: scene_group_type
   use wavycon_surface_group, only: surface_group_type
   implicit none (type, external)
   private

   public :: deck_type

   type :: deck_type
      character(:), allocatable :: path  !! the deck's file, as the caller named it
      type(scene_group_type) :: scene
      type(material_group_type) :: material
      type(surface_group_type) :: surface
      type(load_group_type) :: load
      type(method_group_type) :: method
      type(output_group_type) :: output
   end type deck_type

end module wavycon_deck
