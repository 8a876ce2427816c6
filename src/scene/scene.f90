!> What a deck describes, in the program's own normalisation: pressures in p*, displacements and gaps in Delta.
module wavycon_scene
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: scene_type, target_words

   !> What the loads are given by.
   integer, parameter, public :: by_pressure = 1, by_mean_gap = 2, by_contact_area = 3

   type :: scene_type
      character(:), allocatable :: deck_path        !! the deck's file, as the caller named it
      character(:), allocatable :: title            !! one line for the heads of tables; may be empty
      character(:), allocatable :: case             !! stem of the names of result files
      character(:), allocatable :: directory        !! of the results
      character(:), allocatable :: resolved_deck    !! the deck with every key's value in effect, ready to be run again
      character(:), allocatable :: essence          !! the same without the places of deck and results
      character(:), allocatable :: surface_kind     !! name in the deck
      type(surface_type), allocatable :: surface
      type(map_statistics), allocatable :: map      !! of a height map
      real(dp) :: e_star = 1.0_dp                   !! plane-strain modulus [pressure]
      real(dp) :: p_star = 0.0_dp                   !! p*, mean pressure that just closes the gap [pressure]
      integer :: loads_by = by_pressure             !! one of the names above
      real(dp), allocatable :: target(:)            !! in the deck's order: P, G or the contact area fraction
      real(dp), allocatable :: mean_pressure(:)     !! [pressure]; allocated where loads are given by pressure
      type(group_values) :: method, output          !! the groups &method and &output
   end type scene_type

contains

   !> What the loads are given by, as a heading.
   pure function target_words(loads_by) result(words)
      integer, intent(in) :: loads_by   !! one of the names above
      character(:), allocatable :: words

      select case (loads_by)
      case (by_mean_gap)
         words = 'gap/Delta'
      case (by_contact_area)
         words = 'area/A0'
      case default
         words = 'pbar/p*'
      end select
   end function target_words

end module wavycon_scene
