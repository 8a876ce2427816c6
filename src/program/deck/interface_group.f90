!> The &interface group: stiffness and resistance of the contact, partial slip and adhesion. They are computed only if
!> the deck has this group.
module wavycon_interface_group
   use wavycon_fitted_frame, only: crests_form_lattice
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: choice_value, key_type, logical_value, real_value
   use wavycon_kinds, only: dp
   use wavycon_material_group, only: take_ratios
   use wavycon_paper_wave, only: is_paper_wave
   use wavycon_partial_slip, only: dundurs_beta, shear_factors
   use wavycon_plain_text, only: listed, short_number
   use wavycon_scene, only: interface_setting
   use wavycon_scene_groups, only: interface_group, material_group
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_interface_group, list_interface_keys

   integer, parameter :: most_loads = 1000

contains

   !> The keys of &interface.
   subroutine list_interface_keys(values, keys)
      type(interface_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('interface', 'stiffness and resistance of the contact, partial slip, adhesion', values%key_group)
      call keys%add(values%resistivity1, key_type(real_value, 'resistivity1', '', '-', &
         'Electric or thermal resistivity of the first body, in any unit: adds the constriction resistance to '// &
         'the table.', least=0, needs='resistivity2'))
      call keys%add(values%resistivity2, key_type(real_value, 'resistivity2', '', '-', &
         'That of the second body, in the same unit.', least=0, needs='resistivity1'))
      call keys%add(values%friction, key_type(real_value, 'friction', '', '-', &
         'Coefficient of friction: each load also bears the tangential loads, under which a part of the contact '// &
         'slips.', above=0))
      call keys%add(values%tangential_load, key_type(real_value, 'tangential_load', '', 'unit of e_star', &
         'Mean tangential tractions Q, over the nominal area, at most friction times the mean pressure.', least=0, &
         most_values=most_loads, way=100, needs='friction'))
      call keys%add(values%tangential_over_normal, key_type(real_value, 'tangential_over_normal', '', '-', &
         'The same over the mean pressure: at most the friction.', least=0, most_values=most_loads, way=101, &
         needs='friction'))
      call keys%add(values%shear_direction, key_type(choice_value, 'shear_direction', "'x'", '', &
         "direction of the tangential load on a surface that does not change along y: 'x', across its ridges; "// &
         "'y', along them.", choices='x y'))
      call keys%add(values%nu, key_type(real_value, 'nu', '', '-', &
         "Poisson's ratio of both bodies for tangential loads, if &material gives e_star.", above=-1, most=0.5_dp, &
         needs='friction'))
      call keys%add(values%slip_loop, key_type(logical_value, 'slip_loop', '.false.', '', &
         'A table of the tangential load against the displacement: loading, and a cycle between +Q and -Q.', &
         needs='friction'))
      call keys%add(values%slip_map, key_type(logical_value, 'slip_map', '.false.', '', &
         'A table of the tangential tractions over the cell, and where the contact sticks and slips; with the '// &
         'points and in the format of maps.', needs='friction'))
      call keys%add(values%work_of_adhesion, key_type(real_value, 'work_of_adhesion', '', &
         'unit of e_star times length', &
         'Work of adhesion w: adds the contact with adhesion in the limit of Johnson, Kendall & Roberts, of '// &
         'waves and round balls. The loads are then its mean pressures, and tensions if < 0.', above=0))
   end subroutine list_interface_keys

   !> Checks the keys and makes the setting that the group asks for. Keys that are missing, that contradict each other
   !> or &material, and that the surface cannot have are reported; the setting is then not made.
   subroutine check_interface_group(values, material, surface, p_star, setting)
      type(interface_group), intent(inout) :: values
      type(material_group), intent(in) :: material
      type(surface_type), intent(in), optional :: surface   !! absent if it could not be made
      real(dp), intent(in) :: p_star                !! p* [pressure]; 0 if the surface is flat or &material is bad
      !> Not allocated if the deck does not have the group, and after problems.
      type(interface_setting), allocatable, intent(out) :: setting

      character(16), allocatable :: of_half_spaces(:)   ! keys that are given and that a layer lacks
      real(dp) :: kappa(3)
      real(dp), allocatable :: e(:), nu(:)

      if (values%position == 0) return
      if (values%friction%is_given) then
         call take_ratios(values, 'interface', values%nu, material)
         if (.not. (values%tangential_load%is_given .or. values%tangential_over_normal%is_given .or. &
                    values%has_unknown)) call values%complain( &
            values%friction, 'friction needs tangential_load or tangential_over_normal')
         if (values%tangential_over_normal%is_given .and. .not. values%any_bad) then
            if (maxval(values%tangential_over_normal%numbers) > values%friction%number) &
               call values%complain(values%tangential_over_normal, &
               'a value of tangential_over_normal is more than friction = '// &
               short_number(values%friction%number)//': the whole contact would slip')
         end if
      else
         values%shear_direction%in_effect = .false.
      end if
      if (.not. present(surface)) return
      if (surface%has_hardness()) call values%problems%add(values%position, &
         '&interface takes elastic contacts: leave hardness or &interface out')
      of_half_spaces = pack([character(16) :: 'friction', 'resistivity1', 'work_of_adhesion'], &
         [values%friction%is_given, values%resistivity1%is_given, values%work_of_adhesion%is_given])
      if (surface%kernel%has_layer() .and. size(of_half_spaces) > 0) &
         call values%problems%add(values%position, 'with a layer &interface computes the stiffness alone: leave '// &
                                  listed(of_half_spaces, ', ')//' or layer_thickness out')
      if (.not. surface%amplitude > 0.0_dp) call values%problems%add(values%position, &
         'the surface is flat and in full contact: leave &interface out')
      if (surface%has_free_edges .and. surface%dimension == 1) call values%problems%add(values%position, &
         'the approach of a profile with free edges is not defined, and so is what &interface computes: leave it out')
      if (surface%dimension == 2) then
         if (values%shear_direction%text == 'y') call values%complain(values%shear_direction, &
            'shear_direction is for surfaces that do not change along y: leave it out')
         values%shear_direction%in_effect = .false.
      end if
      ! What a layer or a flat surface lacks has been reported.
      if (values%work_of_adhesion%is_given .and. surface%amplitude > 0.0_dp .and. .not. surface%kernel%has_layer()) then
         if (.not. has_adhesion(surface)) call values%complain( &
            values%work_of_adhesion, 'adhesion is computed for wave_1d, for the 2-D waves that solver = '// &
            "'fitted' takes and for a round ball: leave work_of_adhesion out")
      end if
      if (values%problems%number > 0 .or. values%any_bad .or. p_star <= 0.0_dp) return
      allocate (setting)
      if (values%resistivity1%is_given) setting%resistivity = values%resistivity1%number + values%resistivity2%number
      if (values%work_of_adhesion%is_given) setting%work = values%work_of_adhesion%number/(p_star*surface%amplitude)
      if (.not. values%friction%is_given) return
      setting%friction = values%friction%number
      setting%over_mean_pressure = values%tangential_over_normal%is_given
      setting%tangential = values%tangential_load%numbers/p_star
      if (setting%over_mean_pressure) setting%tangential = values%tangential_over_normal%numbers
      e = [1.0_dp]
      if (material%e2%is_given) e = [material%e1%number, material%e2%number]
      nu = values%nu%numbers
      kappa = shear_factors(e, nu)
      if (material%nu1%is_given) setting%beta = dundurs_beta(e, nu)
      setting%kappa = [kappa(3), minval(kappa), maxval(kappa)]
      ! On a profile the tangential load has one direction: across its ridges (1) or along them (2). In 2-D the
      ! direction 'y' was reported.
      if (surface%dimension == 1) setting%kappa = kappa(1)
      if (values%shear_direction%text == 'y') setting%kappa = kappa(2)
   end subroutine check_interface_group

   !> Whether adhesion is computed for a surface: a round ball and the 1-D wave of the paper by closed forms, 2-D waves
   !> that solver = 'fitted' takes by collocation.
   logical function has_adhesion(surface)
      type(surface_type), intent(in) :: surface

      if (is_ball(surface)) then
         has_adhesion = maxval(ball_radii(surface)) <= minval(ball_radii(surface))
      else if (surface%dimension == 1) then
         has_adhesion = is_paper_wave(surface)
      else
         has_adhesion = crests_form_lattice(surface)
      end if
   end function has_adhesion

end module wavycon_interface_group
