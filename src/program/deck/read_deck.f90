!> Reads a deck and reports all its problems at once.
!>
!> The text is scanned here rather than by Fortran's NAMELIST, whose errors mislead: gfortran 12 reports a misspelt
!> group as the end of the file, and does not report a repeated key or an empty value at all. The syntax is a
!> part of NAMELIST's, which inputs/README.md describes: no elements or parts of arrays, and no null values.
module wavycon_read_deck
   use wavycon_deck_groups, only: list_keys, number_of_groups
   use wavycon_deck_parser, only: take_groups
   use wavycon_deck_text, only: at_end, deck_text_type, next_token, problem_report, token_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_formula_kinds, only: radii_of
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_interface_group, only: check_interface_group
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: allowed_values, choice_value, text_value
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: check_load_group, given_loads
   use wavycon_material_group, only: check_material_group, plane_strain_modulus
   use wavycon_methods, only: check_method_group
   use wavycon_output_group, only: check_output_group
   use wavycon_plain_text, only: escaped, newline, quoted
   use wavycon_problems, only: problem_list_type
   use wavycon_scene, only: scene_type
   use wavycon_scene_group, only: check_scene_group
   use wavycon_settings, only: name_case, setting_type
   use wavycon_stress_group, only: check_stress_group
   use wavycon_surface_group, only: check_sides, check_surface_group, make_surface
   implicit none (type, external)
   private

   public :: parse_deck

contains

   !> Reads a deck from its text: all that the deck describes becomes the scene. Each group's values are taken first,
   !> then the surface is made, then each group is checked against it. All problems of these steps are reported
   !> together. Errors: exit_file_trouble if the height map cannot be read; exit_bad_input, with a report of all
   !> problems, for a bad deck; exit_bad_input for a bad height map, and for `heights` beside a kind of surface that is
   !> not 'file'.
   subroutine parse_deck(deck_text, scene, error, settings, heights, in_memory)
      type(deck_text_type), intent(in) :: deck_text
      type(scene_type), intent(out), target :: scene  !! to be used only if there is no error
      type(error_type), allocatable, intent(out) :: error
      type(setting_type), intent(in), optional :: settings(:)   !! keys set in place of those of the deck

      !> Heights of the surface in place of those of its file, shape (points along x, points along y); upwards to the
      !> other body, NaN where a height is missing. A profile has one column or one row.
      real(dp), intent(in), optional :: heights(:, :)
      !> Whether the deck is text in memory, not a file. It then may have no group &load, and its path does not give the
      !> name of the case.
      logical, intent(in), optional :: in_memory

      type(key_list) :: lists(number_of_groups)
      type(problem_list_type) :: problems
      type(token_type) :: token
      type(deck_text_type) :: text
      integer :: i
      logical :: is_file

      is_file = .true.
      if (present(in_memory)) is_file = .not. in_memory
      text = deck_text
      ! The mark at the start of a text of two bytes a character.
      if (any([index(text%content, char(255)//char(254)), index(text%content, char(254)//char(255))] == 1)) &
         call fatal_error(error, exit_bad_input, escaped(text%path)// &
                          ': this text has two bytes a character (UTF-16): save it as UTF-8 or ASCII')
      if (allocated(error)) return
      token = next_token(text%content, 1)
      if (token%kind == at_end) call fatal_error(error, exit_bad_input, escaped(text%path)//': the deck is empty')
      if (allocated(error)) return
      call list_keys(scene, lists)
      call take_groups(text, lists, problems, settings)
      do i = 1, size(lists)
         if (lists(i)%required .and. lists(i)%group%position == 0 .and. .not. lists(i)%group%has_unknown .and. &
             (is_file .or. lists(i)%name /= 'load')) &
            call problems%add(0, 'the group &'//trim(lists(i)%name)//' ('//trim(lists(i)%meaning)//') is missing')
         call lists(i)%check_relations()
      end do
      scene%deck_path = text%path

      call check_scene_group(scene%scene_values, is_file)
      if (present(settings)) call name_case(scene%scene_values, settings)
      call read_surface(scene, error, heights)
      call check_material_group(scene%material, scene%surface, scene%e_star, scene%p_star)
      call check_load_group(scene%load, scene%surface, scene%e_star, scene%interface%work_of_adhesion%is_given, &
                            scene%interface%friction%is_given, scene%loads_by, scene%target, scene%mean_pressure)
      call check_stress_group(scene%stress, scene%material, scene%load, scene%surface, scene%p_star, &
                              scene%stress_setting)
      call check_method_group(scene%method, scene%load, scene%surface)
      call check_interface_group(scene%interface, scene%material, scene%surface, scene%p_star, scene%interface_setting)
      call check_output_group(scene%output, scene%scene_values%case%text, scene%method, scene%surface)
      if (.not. is_file) then
         ! A deck in memory has no name: the file that its resolved deck is written to gives one.
         scene%scene_values%case%in_effect = scene%scene_values%case%is_given
         scene%output%directory%in_effect = scene%output%directory%is_given
      end if
      do i = 1, size(lists)
         call problems%join(lists(i)%group%problems)
      end do
      ! Problems of the deck are reported rather than an error of its height map: the path of the map may be one of
      ! them.
      if (problems%number > 0) then
         if (allocated(error)) deallocate (error)
         call fatal_error(error, exit_bad_input, problem_report(problems, text))
      end if
      if (.not. allocated(error)) call complete(scene, lists, is_file)
   end subroutine parse_deck

   !> Checks &surface and, if it has no problems, makes the surface. If the deck does not label its unit of lengths, the
   !> unit that a height map's file names becomes the label. Errors: those of `make_surface`.
   subroutine read_surface(scene, error, heights)
      type(scene_type), intent(inout) :: scene
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: heights(:, :)   !! as in parse_deck

      associate (values => scene%surface_values, labels => scene%scene_values)
         call check_surface_group(values)
         if (values%problems%number > 0 .or. values%any_bad) return
         if (values%kind%text == 'ball') then
            call set_ball_sides(scene)
            ! A ball without sides cannot be made: the problem that left them unknown is reported elsewhere.
            if (values%problems%number + scene%load%problems%number > 0 .or. .not. values%length_y%in_effect) return
         end if
         values%deck_unit = ''
         if (labels%length_unit%is_given) values%deck_unit = labels%length_unit%text
         call make_surface(values, scene%surface, scene%map, scene%two_maps, error, heights)
         if (allocated(error)) return
         if (allocated(scene%surface)) call check_sides(values, scene%surface)
         if (.not. allocated(scene%map)) return
         if (allocated(scene%map%length_unit)) call labels%length_unit%set(text=scene%map%length_unit)
      end associate
   end subroutine read_surface

   !> Sets the default sides of a ball: a multiple of the half axes of Hertz's contact at the largest load. With a
   !> hardness the contact is enlarged until the hardness, as a uniform pressure, carries the load. If &material or
   !> &load has problems, which are reported elsewhere, the sides stay unknown.
   subroutine set_ball_sides(scene)
      type(scene_type), intent(inout) :: scene

      !> Sides of the cell over the half axes of the contact: the cell is twice as long as the contact. So the edge
      !> stays off the border even if a hardness or a rough estimate of the load makes the contact larger.
      real(dp), parameter :: sides_over_half_axes = 4.0_dp
      character(:), allocatable :: key
      integer :: loads_by, position
      real(dp) :: e_star, half_axis(2), largest, radii(2)
      real(dp), allocatable :: loads(:)
      type(hertz_ball) :: contact

      associate (ball => scene%surface_values)
         if (ball%length_x%is_given) call ball%length_y%set_default([ball%length_x%number])
         if (ball%length_x%is_given .or. scene%material%any_bad .or. scene%load%any_bad) return
         if (scene%load%position == 0) call ball%complain(ball%kind, "without loads kind = 'ball' needs length_x")
         call given_loads(scene%load, key, position, loads_by, loads)
         if (any(key == ['mean_pressure        ', 'contact_area_fraction'])) call scene%load%problems%add(position, &
            key//' needs the sides of the ball, length_x and length_y: give them, or force, approach or contact_area')
         largest = max(0.0_dp, maxval(abs(loads)))
         ! A ball yields first at a peak pressure of 1.4 to 1.9 times its yield stress: take 2 times.
         if (key == 'yield' .and. .not. scene%stress%any_bad) &
            largest = 2*largest*max(0.0_dp, scene%stress%yield_stress%number)
         e_star = plane_strain_modulus(scene%material)
         radii = radii_of(ball%radius, ball%radius_x, ball%radius_y)
         select case (key)
         case ('force')
            contact = hertz_contact(radii, e_star, force=largest)
         case ('approach')
            contact = hertz_contact(radii, e_star, approach=largest)
         case ('contact_area')
            contact = hertz_contact(radii, e_star, area=largest)
         case default
            contact = hertz_contact(radii, e_star, peak_pressure=largest)
         end select
         half_axis = contact%half_axis
         ! Without load there is no contact, and the sides are arbitrary.
         if (.not. minval(half_axis) > 0.0_dp) then
            half_axis = minval(radii)/10
         else if (scene%material%hardness%is_given) then
            half_axis = half_axis*max(1.0_dp, sqrt(contact%force/(scene%material%hardness%number &
                                                                   *contact%contact_area())))
         end if
         call ball%length_x%set_default(sides_over_half_axes*half_axis(1:1))
         call ball%length_y%set_default(sides_over_half_axes*half_axis(2:2))
      end associate
   end subroutine set_ball_sides

   !> Sets the components of the scene that follow from the values of a deck without problems: roughness, units, names,
   !> the resolved deck, and what the deck asks for.
   subroutine complete(scene, lists, is_run)
      type(scene_type), intent(inout), target :: scene
      type(key_list), intent(in) :: lists(:)   !! keys of all groups
      logical, intent(in) :: is_run            !! whether the scene may be run: a checkpoint needs its fingerprint

      character(:), allocatable :: file, file2
      integer :: i, k

      scene%roughness = scene%surface%roughness()
      scene%gives_modulus = scene%material%e_star%is_given .or. scene%material%e1%is_given
      scene%has_units = scene%gives_modulus .or. scene%scene_values%pressure_unit%is_given .or. &
                        scene%scene_values%length_unit%is_given
      if (allocated(scene%map)) scene%has_units = scene%has_units .or. allocated(scene%map%length_unit)
      if (scene%load%position == 0) allocate (scene%target(0), scene%mean_pressure(0))
      associate (labels => scene%scene_values, surface => scene%surface_values)
         scene%case = labels%case%text
         scene%pressure_unit = labels%pressure_unit%text
         scene%length_unit = labels%length_unit%text
         scene%directory = scene%output%directory%text
         if (is_run) then
            call scene%output%directory%set(text='')
            scene%fingerprint = text_of(scene, lists)
            ! Leave out the first line, which has the path of the deck.
            scene%fingerprint = scene%fingerprint(index(scene%fingerprint, newline):)
            call scene%output%directory%set(text=scene%directory)
         end if
         ! The resolved deck names the maps' files by their absolute paths, so that a copy of the deck in another
         ! directory finds the files. A map that was made, not read, has no file.
         file = surface%file%text
         file2 = surface%file2%text
         if (allocated(scene%two_maps)) call surface%file2%set(text=scene%two_maps(2)%path)
         if (allocated(scene%map)) then
            if (scene%map%path /= '') call surface%file%set(text=scene%map%path)
         end if
         scene%resolved_deck = text_of(scene, lists)
         if (file /= '') call surface%file%set(text=file)
         if (file2 /= '') call surface%file2%set(text=file2)
      end associate
      allocate (scene%asked_for(0))
      scene%decimal_commas = ''
      do i = 1, size(lists)
         do k = 1, size(lists(i)%rows)
            if (lists(i)%keys(k)%value%has_decimal_commas) &
               scene%decimal_commas = scene%decimal_commas//', '//trim(lists(i)%rows(k)%name)
         end do
         if (lists(i)%group%position == 0 .and. lists(i)%name /= 'output') cycle
         scene%asked_for = [scene%asked_for, lists(i)%asked_for()]
      end do
   end subroutine complete

   !> The resolved deck: every key that applies, with the value in effect. A run of the resolved deck gives the same
   !> results. The last line has no newline.
   function text_of(scene, lists) result(text)
      type(scene_type), intent(in), target :: scene
      type(key_list), intent(in) :: lists(:)   !! keys of all groups, which point to the values of the scene
      character(:), allocatable :: text

      integer :: i

      text = '! '//escaped(scene%deck_path)//' with the value in effect of every key that applies.'
      if (allocated(scene%map) .and. scene%surface_values%kind%text == 'file') then
         if (scene%map%path == '') text = text//newline//'! The heights were in memory: to run this deck write '// &
            'them to a file, as numpy.save does, and give its name.'
      end if
      do i = 1, size(lists)
         ! A group &load, &stress or &interface that the deck does not have is left out: the group alone would ask for
         ! computations.
         if (lists(i)%group%position > 0 .or. all(lists(i)%name /= ['load     ', 'stress   ', 'interface'])) &
            text = text//group_text(lists(i))
      end do
   end function text_of

   !> The text of a group in the resolved deck. A key has a line "key = value   ! [unit] allowed values", and a line for
   !> each further value. Each line has a newline before it.
   !>
   !> N.B. Values are not separated by commas: gfortran's NAMELIST reads a comma before a comment as an omitted value.
   function group_text(list) result(text)
      type(key_list), intent(in) :: list
      character(:), allocatable :: text

      character(*), parameter :: next_line = newline//'      '
      character(:), allocatable :: comment, words
      integer :: first, k

      text = newline//'&'//trim(list%name)//'   ! '//trim(list%meaning)
      do k = 1, size(list%rows)
         associate (key => list%rows(k))
            if (.not. list%keys(k)%value%in_effect) cycle
            comment = '   ! '
            if (key%unit /= '') comment = comment//'['//trim(key%unit)//'] '
            comment = comment//allowed_values(key)
            words = list%words(k, next_line)
            if (any(key%kind == [text_value, choice_value])) words = quoted(words)
            first = index(words//newline, newline) - 1
            text = text//newline//'   '//trim(key%name)//' = '//words(:first)//comment//words(first + 1:)
         end associate
      end do
      text = text//newline//'/'
   end function group_text

end module wavycon_read_deck
