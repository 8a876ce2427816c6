!> Reads a deck file and reports all problems in it at once.
!>
!> The text is scanned here rather than by Fortran's NAMELIST, whose errors mislead: gfortran 12 reports a misspelt
!> group as the end of the file, and does not report a repeated key or an empty value at all. The syntax is that of
!> NAMELIST.
module wavycon_read_deck
   use wavycon_ball_kind, only: set_ball_sides
   use wavycon_deck, only: deck_tables, deck_type, interface_number, load_number, material_number, method_number, &
      number_of_groups, output_number, scene_number, stress_number, surface_number
   use wavycon_deck_groups, only: take_groups
   use wavycon_deck_scanner, only: at_end, next_token, token_type
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_values, only: group_values
   use wavycon_interface_group, only: check_interface_group
   use wavycon_key_table, only: key_group_type
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: check_load_group, check_loads_of_surface, given_loads
   use wavycon_material_group, only: check_material_group, plane_strain_modulus
   use wavycon_method_group, only: check_method_group
   use wavycon_output_group, only: check_output_group
   use wavycon_plain_text, only: escaped
   use wavycon_problem_report, only: problem_report
   use wavycon_problems, only: problem_list_type
   use wavycon_scene_group, only: check_scene_group
   use wavycon_settings, only: name_case, setting_type
   use wavycon_stress_group, only: check_stress_group
   use wavycon_surface_group, only: check_sides, check_surface_group, make_surface
   implicit none (type, external)
   private

   public :: read_deck, parse_deck

contains

   !> Reads a deck file.
   !>
   !> Errors: exit_file_trouble if the deck or its height map cannot be read; exit_bad_input, with a report of all
   !> problems, for a bad deck; exit_bad_input for a bad height map.
   subroutine read_deck(path, deck, error, settings)
      character(*), intent(in) :: path
      type(deck_type), intent(out) :: deck  !! to be used only if there is no error
      type(error_type), allocatable, intent(out) :: error
      type(setting_type), intent(in), optional :: settings(:)   !! keys set in place of those of the deck

      type(deck_text_type) :: text

      call read_deck_text(path, text, error)
      if (allocated(error)) return
      call parse_deck(text, deck, error, settings)
   end subroutine read_deck

   !> Reads a deck from its text. Errors: as of `read_deck`, and exit_bad_input for heights of a kind that has no file.
   subroutine parse_deck(deck_text, deck, error, settings, heights, in_memory)
      type(deck_text_type), intent(in) :: deck_text
      type(deck_type), intent(out) :: deck  !! to be used only if there is no error
      type(error_type), allocatable, intent(out) :: error
      type(setting_type), intent(in), optional :: settings(:)   !! keys set in place of those of the deck

      !> Heights of the surface in place of those of its file: upwards to the other body, NaN where they are missing, x
      !> first, one column of a profile.
      real(dp), intent(in), optional :: heights(:, :)
      !> Whether the deck is no file: it may have no group &load, and its name need not serve as that of a case.
      logical, intent(in), optional :: in_memory

      type(group_values) :: groups(number_of_groups)
      type(key_group_type) :: tables(number_of_groups)
      type(problem_list_type) :: problems
      type(token_type) :: token
      type(deck_text_type) :: text
      logical :: is_file

      is_file = .true.
      if (present(in_memory)) is_file = .not. in_memory
      text = deck_text
      token = next_token(text%content, 1)
      if (token%kind == at_end) then
         call fatal_error(error, exit_bad_input, escaped(text%path)//': the deck is empty')
         return
      end if
      tables = deck_tables()
      tables(load_number)%required = is_file
      call take_groups(text, tables, groups, problems, settings)
      deck%path = text%path
      deck%scene = groups(scene_number)
      deck%material = groups(material_number)
      deck%surface_values = groups(surface_number)
      deck%load = groups(load_number)
      deck%stress = groups(stress_number)
      deck%interface = groups(interface_number)
      deck%method = groups(method_number)
      deck%output = groups(output_number)

      if (is_file) then
         call check_scene_group(deck%scene, problems)
      else
         call check_scene_group(deck%scene, problems, 'deck')
      end if
      if (present(settings)) call name_case(deck%scene, settings, problems)
      call read_surface(deck, problems, error, heights)
      call check_material_and_loads(deck, problems)
      call check_stress_group(deck%stress, deck%material, deck%load, problems, deck%surface)
      call check_method_group(deck%method, deck%surface_values%text('kind'), deck%surface, problems)
      call check_interface_group(deck%interface, deck%material, deck%method, problems, deck%surface)
      call check_output_group(deck%output, deck%scene%text('case'), deck%method, deck%surface, problems)
      ! Problems of the deck are reported rather than an error of its height map: the path of the map may be one of
      ! them.
      if (problems%number > 0) then
         if (allocated(error)) deallocate (error)
         call fatal_error(error, exit_bad_input, problem_report(problems, text))
      end if
   end subroutine parse_deck

   !> Checks &surface and, if it has no problems, makes the surface. A unit that its file names becomes the deck's label
   !> if the deck gives none. Errors: as of `make_surface`.
   subroutine read_surface(deck, problems, error, heights)
      type(deck_type), intent(inout) :: deck
      type(problem_list_type), intent(inout) :: problems
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: heights(:, :)   !! as of parse_deck

      integer :: before

      before = problems%number
      call check_surface_group(deck%surface_values, problems)
      if (problems%number > before .or. deck%surface_values%any_bad()) return
      call set_sides_of_loads(deck, problems)
      if (problems%number > before) return
      if (deck%scene%has('length_unit')) deck%surface_values%length_unit = deck%scene%text('length_unit')
      call make_surface(deck%surface_values, deck%surface, deck%map, error, heights)
      if (allocated(error)) return
      if (allocated(deck%surface)) call check_sides(deck%surface_values, deck%surface, problems)
      if (.not. allocated(deck%map)) return
      if (allocated(deck%map%length_unit)) call deck%scene%set('length_unit', deck%map%length_unit)
   end subroutine read_surface

   !> Sets the default sides of a ball, which follow from its loads. If &material or &load has problems, which are
   !> reported later, the sides stay as they are.
   subroutine set_sides_of_loads(deck, problems)
      type(deck_type), intent(inout) :: deck
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: key
      integer :: loads_by
      real(dp) :: hardness
      real(dp), allocatable :: loads(:)

      if (deck%surface_values%text('kind') /= 'ball') return
      if (deck%material%any_bad() .or. deck%load%any_bad()) return
      allocate (loads(0))
      if (deck%load%place > 0) call given_loads(deck%load, key, loads_by, loads)
      if (size(loads) == 0) then
         key = ''
         loads = [0.0_dp]
         if (deck%load%place == 0 .and. .not. deck%surface_values%has('length_x')) call deck%surface_values%complain( &
            problems, 'kind', "without loads kind = 'ball' needs length_x")
      end if
      hardness = huge(hardness)
      if (deck%material%has('hardness')) hardness = deck%material%real('hardness')
      ! A ball yields first at a peak pressure of 1.4 to 1.9 times its yield stress.
      if (key == 'yield' .and. .not. deck%stress%any_bad()) &
         loads = 2*loads*max(0.0_dp, deck%stress%real('yield_stress'))
      call set_ball_sides(deck%surface_values, plane_strain_modulus(deck%material), hardness, key, maxval(abs(loads)))
   end subroutine set_sides_of_loads

   !> Checks &material, which gives p* and the hardness of the surface, and &load and, where these and the surface have
   !> no problems, the loads against p* and Delta.
   subroutine check_material_and_loads(deck, problems)
      type(deck_type), intent(inout) :: deck   !! after read_surface
      type(problem_list_type), intent(inout) :: problems

      integer :: before

      before = problems%number
      call check_material_group(deck%material, deck%surface, deck%e_star, deck%p_star, problems)
      call check_load_group(deck%load, deck%interface%has('work_of_adhesion'), problems)
      if (problems%number > before .or. deck%material%any_bad() .or. deck%load%any_bad()) return
      if (deck%load%place == 0 .or. .not. allocated(deck%surface)) return
      call check_loads_of_surface(deck%load, deck%surface, deck%p_star, problems, &
                                  has_own_sides=deck%surface_values%text('kind') /= 'ball' .or. &
                                                deck%surface_values%has('length_x'))
   end subroutine check_material_and_loads

end module wavycon_read_deck
