!> Makes the scene that a deck describes; converts its loads to the program's normalisation.
module wavycon_make_scene
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_deck, only: deck_type
   use wavycon_group_values, only: group_values
   use wavycon_interface_group, only: make_interface_setting
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: given_loads, pressures_of_loads
   use wavycon_plain_text, only: newline
   use wavycon_resolved_deck, only: resolved_deck_text
   use wavycon_scene, only: scene_type
   use wavycon_stress_group, only: make_stress_setting
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: make_scene, take_loads

contains

   !> Makes the scene.
   subroutine make_scene(deck, scene)
      !> Read without errors. Surface and map, which may be large, are moved; the key `file` gets the whole path.
      type(deck_type), intent(inout) :: deck
      type(scene_type), intent(out) :: scene

      call move_alloc(deck%surface, scene%surface)
      call move_alloc(deck%map, scene%map)
      scene%roughness = scene%surface%roughness()
      scene%e_star = deck%e_star
      scene%p_star = deck%p_star
      scene%gives_modulus = deck%material%has('e_star') .or. deck%material%has('e1')
      scene%has_units = scene%gives_modulus .or. deck%scene%has('pressure_unit') .or. deck%scene%has('length_unit')
      if (allocated(scene%map)) scene%has_units = scene%has_units .or. allocated(scene%map%length_unit)
      if (deck%load%place > 0) then
         call take_loads(deck%load, scene%surface, scene%p_star, scene%loads_by, scene%target, &
                         scene%mean_pressure)
      else
         allocate (scene%target(0), scene%mean_pressure(0))
      end if
      call make_stress_setting(deck%stress, deck%material, scene%p_star, scene%stress_setting)
      call make_interface_setting(deck%interface, deck%material, scene%surface, scene%p_star, scene%interface_setting)
      scene%stress = deck%stress
      scene%interface = deck%interface
      scene%deck_path = deck%path
      scene%title = deck%scene%text('title')
      scene%case = deck%scene%text('case')
      scene%pressure_unit = deck%scene%text('pressure_unit')
      scene%length_unit = deck%scene%text('length_unit')
      scene%directory = deck%output%text('directory')
      scene%surface_kind = deck%surface_values%text('kind')
      scene%method = deck%method
      scene%output = deck%output
      call deck%output%set('directory', text='')
      scene%fingerprint = resolved_deck_text(deck)
      ! The first line has the path of the deck.
      scene%fingerprint = scene%fingerprint(index(scene%fingerprint, newline):)
      call deck%output%set('directory', text=scene%directory)
      ! A copy of the resolved deck in another directory must find the map. A map that was made has no file.
      if (allocated(scene%map)) then
         if (scene%map%path /= '') call deck%surface_values%set('file', text=scene%map%path)
      end if
      scene%resolved_deck = resolved_deck_text(deck)
   end subroutine make_scene

   !> Converts loads to the program's normalisation.
   subroutine take_loads(values, surface, p_star, loads_by, target, mean_pressure)
      type(group_values), intent(in) :: values                   !! after check_loads_of_surface, no problems
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star                             !! p* [pressure]; 0: the surface is flat
      integer, intent(out) :: loads_by                           !! a name of wavycon_scene
      real(dp), allocatable, intent(out) :: target(:)            !! as of scene_type
      real(dp), allocatable, intent(out) :: mean_pressure(:)     !! [pressure]; allocated for by_pressure

      character(:), allocatable :: key
      real(dp), allocatable :: loads(:)

      call given_loads(values, key, loads_by, loads)
      select case (key)
      case ('pbar_over_pstar', 'mean_pressure', 'force')
         mean_pressure = pressures_of_loads(key, loads, surface, p_star)
         if (p_star <= 0.0_dp) then
            ! On a flat surface contact is full at every load.
            loads = merge(ieee_value(1.0_dp, ieee_positive_inf), 1.0_dp, mean_pressure > 0.0_dp)
         else if (key /= 'pbar_over_pstar') then
            loads = mean_pressure/p_star
         end if
      case ('mean_gap', 'approach')
         loads = loads/surface%amplitude
      case ('contact_area')
         loads = loads/surface%nominal_area()
      end select
      call move_alloc(loads, target)
   end subroutine take_loads

end module wavycon_make_scene
