!> Makes the scene that a deck describes; converts its loads to the program's normalisation.
module wavycon_make_scene
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: given_loads, largest_pbar_over_pstar
   use wavycon_material_group, only: plane_strain_modulus
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_resolved_deck, only: resolved_deck_text
   use wavycon_scene, only: by_pressure, scene_type
   implicit none (type, external)
   private

   public :: make_scene, take_loads

contains

   !> Makes the scene. Errors: exit_bad_input for a mean gap above that before load, for a pressure of more than
   !> largest_pbar_over_pstar p*, and for a gap or an area on a flat surface.
   subroutine make_scene(deck, scene, error)
      type(deck_type), intent(inout) :: deck   !! surface and map, which may be large, are moved into the scene
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error

      type(deck_type) :: essence

      call move_alloc(deck%surface, scene%surface)
      call move_alloc(deck%map, scene%map)
      scene%e_star = plane_strain_modulus(deck%material)
      scene%gives_modulus = deck%material%has('e_star') .or. deck%material%has('e1')
      scene%p_star = scene%surface%full_contact_pressure(scene%e_star)
      call take_loads(deck%load, deck%path, scene%surface%amplitude, scene%p_star, scene%loads_by, scene%target, &
                      scene%mean_pressure, error)
      if (allocated(error)) return
      scene%deck_path = deck%path
      scene%title = deck%scene%text('title')
      scene%case = deck%scene%text('case')
      scene%pressure_unit = deck%scene%text('pressure_unit')
      scene%length_unit = deck%scene%text('length_unit')
      scene%directory = deck%output%text('directory')
      scene%surface_kind = deck%surface_values%text('kind')
      scene%method = deck%method
      scene%output = deck%output
      essence = deck
      essence%path = ''
      call essence%output%set('directory', '')
      scene%essence = resolved_deck_text(essence)
      essence = deck
      ! A copy of the resolved deck in another directory must find the map.
      if (allocated(scene%map)) call essence%surface_values%set('file', scene%map%path)
      scene%resolved_deck = resolved_deck_text(essence)
   end subroutine make_scene

   !> Converts loads to the program's normalisation. Errors: exit_bad_input, as of make_scene.
   subroutine take_loads(values, path, amplitude, p_star, loads_by, target, mean_pressure, error)
      type(group_values), intent(in) :: values                   !! of a &load group without problems
      character(*), intent(in) :: path                           !! of the deck, for messages
      real(dp), intent(in) :: amplitude                          !! Delta [length]
      real(dp), intent(in) :: p_star                             !! p* [pressure]; 0: the surface is flat
      integer, intent(out) :: loads_by                           !! by_pressure, by_mean_gap or by_contact_area
      real(dp), allocatable, intent(out) :: target(:)            !! P, G or the contact area fraction
      real(dp), allocatable, intent(out) :: mean_pressure(:)     !! [pressure]; allocated for by_pressure
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: key
      real(dp), allocatable :: loads(:)
      real(dp) :: worst

      call given_loads(values, key, loads_by, loads)
      if (loads_by /= by_pressure .and. p_star <= 0.0_dp) then
         call fatal_error(error, exit_bad_input, escaped(path)// &
                          ': the surface is flat: give its loads by pressure, not by gap or area')
         return
      end if
      worst = maxval(loads)
      select case (key)
      case ('pbar_over_pstar')
         mean_pressure = p_star*loads
         if (p_star <= 0.0_dp) loads = in_p_star(mean_pressure, p_star)
      case ('mean_pressure')
         ! Checked before the division by p*, which may overflow.
         if (p_star > 0.0_dp .and. worst > largest_pbar_over_pstar*p_star) then
            call fatal_error(error, exit_bad_input, escaped(path)//': mean_pressure = '//short_number(worst)// &
                             ' is more than '//short_number(largest_pbar_over_pstar)//' times p* = '// &
                             short_number(p_star)// &
                             '. Do its unit and that of e_star agree, and those of the lengths?')
            return
         end if
         mean_pressure = loads
         loads = in_p_star(loads, p_star)
      case ('mean_gap')
         if (worst > amplitude) then
            call fatal_error(error, exit_bad_input, escaped(path)//': mean_gap = '//short_number(worst)// &
                             ' is more than the mean gap before load, '//short_number(amplitude)// &
                             '. Do the units of the lengths agree?')
            return
         end if
         loads = loads/amplitude
      end select
      call move_alloc(loads, target)
   end subroutine take_loads

   !> A mean pressure over p*. On a flat surface p* = 0 and contact is full at every load: the result is 1 without
   !> load and infinity otherwise.
   elemental real(dp) function in_p_star(mean_pressure, p_star)
      real(dp), intent(in) :: mean_pressure, p_star   !! both >= 0

      if (p_star > 0.0_dp) then
         in_p_star = mean_pressure/p_star
      else if (mean_pressure > 0.0_dp) then
         in_p_star = ieee_value(1.0_dp, ieee_positive_inf)
      else
         in_p_star = 1.0_dp
      end if
   end function in_p_star

end module wavycon_make_scene
