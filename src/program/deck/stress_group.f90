!> The &stress group: stresses below the surface. They are computed only if the deck has this group.
module wavycon_stress_group
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: choice_value, integer_value, key_type, logical_value, real_value
   use wavycon_kinds, only: dp
   use wavycon_material_group, only: take_ratios
   use wavycon_scene_groups, only: load_group, material_group, stress_group
   use wavycon_stress_setting, only: stress_setting
   use wavycon_stress_tensor, only: elastic_body, hydrostatic, laterally_constrained, laterally_free
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_stress_group, lateral_of, list_stress_keys

   !> Most depths of a list or a range.
   integer, parameter :: most_depths = 10000

contains

   !> The keys of &stress.
   subroutine list_stress_keys(values, keys)
      type(stress_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('stress', 'stresses below the surface, and when it yields', values%key_group)
      call keys%add(values%largest, key_type(logical_value, 'largest', '.true.', '', &
         'A table of the largest von Mises stress and the largest shear stress of each load, and where they are.'))
      call keys%add(values%line, key_type(logical_value, 'line', '.false.', '', &
         'A table of the stresses on the line below the crest.'))
      call keys%add(values%section, key_type(choice_value, 'section', "'none'", '', &
         "a table of the stresses on a vertical section through the crest, along 'x', 'y' or the 'diagonal' of "// &
         'the cell.', choices='none x y diagonal'))
      call keys%add(values%planes, key_type(logical_value, 'planes', '.false.', '', &
         'A table of the stresses on the planes at the given depths, with the points and in the format of maps.'))
      call keys%add(values%depths, key_type(real_value, 'depths', '', 'length', &
         'Depths of the planes; also of the points of line and section unless a range is given.', least=0, &
         most_values=most_depths, way=100))
      call keys%add(values%depths_over_cell_x, key_type(real_value, 'depths_over_cell_x', '', '-', &
         'The same over the side of the cell along x, which is the wavelength of a wave.', least=0, &
         most_values=most_depths, way=101))
      call keys%add(values%depth_from, key_type(real_value, 'depth_from', '0.0', '-', &
         'First depth of a range in equal steps, over the side of the cell along x, for line and section; also '// &
         'for the planes unless depths are given.', least=0))
      call keys%add(values%depth_to, key_type(real_value, 'depth_to', '1.0', '-', 'Last depth of the range.', least=0))
      call keys%add(values%depth_steps, key_type(integer_value, 'depth_steps', '65', '', &
         'Number of depths of the range, both ends included.', 1, most_depths))
      call keys%add(values%nu, key_type(real_value, 'nu', 'nu1, nu2', '-', &
         "Poisson's ratios of the first and the second body; one number: of both. The default is that of "// &
         '&material. Where they differ the stresses of both bodies are computed.', above=-1, most=0.5_dp, &
         most_values=2))
      call keys%add(values%lateral, key_type(choice_value, 'lateral', "'constrained'", '', &
         "the lateral stresses of the mean pressure pbar. 'constrained': no lateral strain, -nu pbar/(1 - nu); "// &
         "'free': 0; 'hydrostatic': -pbar.", choices='constrained free hydrostatic'))
      call keys%add(values%yield_stress, key_type(real_value, 'yield_stress', '', 'unit of e_star', &
         'Yield stresses of the first and the second body in uniaxial tension; one number: of both.', above=0, &
         most_values=2))
      call keys%add(values%yield_criterion, key_type(choice_value, 'yield_criterion', "'von_mises'", '', &
         "which stress reaches the yield stress: 'von_mises', the von Mises stress; 'tresca', twice the largest "// &
         'shear stress.', choices='von_mises tresca', needs='yield_stress'))
   end subroutine list_stress_keys

   !> Sets the defaults that depend on &material, checks the keys, and makes the setting that the group asks for. The
   !> setting has one body instead of two if the second body is rigid, and so has no stresses, or if both bodies have
   !> the same Poisson's ratio and yield stress.
   subroutine check_stress_group(values, material, load, surface, p_star, setting)
      type(stress_group), intent(inout) :: values
      type(material_group), intent(in) :: material
      type(load_group), intent(inout) :: load
      type(surface_type), intent(in), optional :: surface   !! absent if it could not be made
      real(dp), intent(in) :: p_star                        !! p* [pressure]; 0 if the surface is flat
      type(stress_setting), allocatable, intent(out) :: setting   !! not allocated if the deck has no group &stress

      integer :: bodies, i
      logical :: has_layer, has_range

      has_layer = .false.
      if (present(surface)) has_layer = surface%kernel%has_layer()
      if (load%yield%is_given .and. has_layer) then
         call load%complain(load%yield, 'stresses are computed in half-spaces, not in a layer: leave yield out')
      else if (load%yield%is_given .and. .not. (values%yield_stress%is_given .or. values%has_unknown)) then
         call load%complain(load%yield, 'yield needs yield_stress in the group &stress')
      end if
      if (values%position == 0) return
      has_range = values%depth_from%is_given .or. values%depth_to%is_given .or. values%depth_steps%is_given
      if (.not. has_range .and. (values%depths%is_given .or. values%depths_over_cell_x%is_given)) then
         values%depth_from%in_effect = .false.
         values%depth_to%in_effect = .false.
         values%depth_steps%in_effect = .false.
      else if (values%planes%is_true .and. .not. (has_range .or. values%has_unknown)) then
         call values%complain(values%planes, 'planes needs depths, depths_over_cell_x or a range of depths')
      end if
      if (.not. has_layer) call take_ratios(values, 'stress', values%nu, material)
      if (present(surface)) then
         if (has_layer) call values%problems%add(values%position, &
            'stresses are computed in half-spaces, not in a layer: leave &stress or layer_thickness out')
         if (surface%has_free_edges) then
            if (surface%dimension == 1) call values%problems%add(values%position, &
               'stresses below a profile with free edges are not computed: leave &stress out')
            if (values%lateral%is_given) call values%complain(values%lateral, &
               'a surface with free edges has no mean pressure far below it: leave lateral out')
            call values%lateral%set(text='free')
            values%lateral%in_effect = .false.
         end if
         if (surface%dimension == 1 .and. any(values%section%text == ['y       ', 'diagonal'])) &
            call values%complain(values%section, &
            "the surface does not change along y: section must be 'none' or 'x'")
      end if
      allocate (setting)
      setting%by_shear = values%yield_criterion%text == 'tresca'
      bodies = 2
      associate (nu => values%nu%pair, yield => values%yield_stress%pair)
         if (maxval(nu) <= minval(nu) .and. maxval(yield) <= minval(yield)) bodies = 1
         ! The second body is rigid if the deck gives e1 without e2.
         if (material%e1%is_given .and. .not. material%e2%is_given) bodies = 1
         allocate (setting%body, source=[(elastic_body(nu(i), lateral_of(values)), i=1, bodies)])
         if (values%yield_stress%is_given .and. p_star > 0.0_dp) setting%yield_stress = yield(:bodies)/p_star
      end associate
   end subroutine check_stress_group

   !> How the mean pressure loads the bodies laterally: laterally_constrained, laterally_free or hydrostatic of
   !> wavycon_stress_tensor.
   pure integer function lateral_of(values) result(lateral)
      type(stress_group), intent(in) :: values

      lateral = laterally_constrained
      if (values%lateral%text == 'free') lateral = laterally_free
      if (values%lateral%text == 'hydrostatic') lateral = hydrostatic
   end function lateral_of

end module wavycon_stress_group
