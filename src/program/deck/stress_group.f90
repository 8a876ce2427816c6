!> The &stress group: stresses below the surface. Without it nothing of this is computed.
module wavycon_stress_group
   use wavycon_elastic_body, only: elastic_body, hydrostatic, laterally_constrained, laterally_free
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_value, integer_value, key_type, logical_value, real_value
   use wavycon_kinds, only: dp
   use wavycon_material_group, only: take_ratios
   use wavycon_problems, only: problem_list_type
   use wavycon_stress_setting, only: stress_setting
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_stress_group, make_stress_setting

   !> Most depths of a list or a range.
   integer, parameter :: most_depths = 10000

   !> The choices of `lateral`, in the order of its key.
   integer, parameter :: lateral_is(*) = [laterally_constrained, laterally_free, hydrostatic]

   !> The keys of &stress.
   type(key_type), parameter, public :: stress_keys(*) = [ &
      key_type(logical_value, 'largest', '.true.', '', &
         'A table of the largest von Mises stress and the largest shear stress of each load, and where they are.'), &
      key_type(logical_value, 'line', '.false.', '', 'A table of the stresses on the line below the crest.'), &
      key_type(choice_value, 'section', "'none'", '', &
         "a table of the stresses on a vertical section through the crest, along 'x', 'y' or the 'diagonal' of "// &
         'the cell.', choices='none x y diagonal'), &
      key_type(logical_value, 'planes', '.false.', '', &
         'A table of the stresses on the planes at the given depths, with the points and in the format of maps.'), &
      key_type(real_value, 'depths', '', 'length', &
         'Depths of the planes; also of the points of line and section unless a range is given.', least=0, &
         most_values=most_depths, way=10), &
      key_type(real_value, 'depths_over_cell_x', '', '-', &
         'The same over the side of the cell along x, which is the wavelength of a wave.', least=0, &
         most_values=most_depths, way=11), &
      key_type(real_value, 'depth_from', '0.0', '-', &
         'First depth of a range in equal steps, over the side of the cell along x, for line and section; also '// &
         'for the planes unless depths are given.', least=0), &
      key_type(real_value, 'depth_to', '1.0', '-', 'Last depth of the range.', least=0), &
      key_type(integer_value, 'depth_steps', '65', '', &
         'Number of depths of the range, both ends included.', 1, most_depths), &
      key_type(real_value, 'nu', 'nu1, nu2', '-', &
         "Poisson's ratios of the first and the second body; one number: of both. The default is that of "// &
         '&material. Where they differ the stresses of both bodies are computed.', above=-1, most=0.5_dp, &
         most_values=2), &
      key_type(choice_value, 'lateral', "'constrained'", '', &
         "the lateral stresses of the mean pressure pbar. 'constrained': no lateral strain, -nu pbar/(1 - nu); "// &
         "'free': 0; 'hydrostatic': -pbar.", choices='constrained free hydrostatic'), &
      key_type(real_value, 'yield_stress', '', 'unit of e_star', &
         'Yield stresses of the first and the second body in uniaxial tension; one number: of both.', above=0, &
         most_values=2), &
      key_type(choice_value, 'yield_criterion', "'von_mises'", '', &
         "which stress reaches the yield stress: 'von_mises', the von Mises stress; 'tresca', twice the largest "// &
         'shear stress.', choices='von_mises tresca', needs='yield_stress')]

contains

   !> Sets the defaults that depend on &material and reports what is missing or contradicts.
   subroutine check_stress_group(values, material, load, problems, surface)
      type(group_values), intent(inout) :: values
      type(group_values), intent(in) :: material, load
      type(problem_list_type), intent(inout) :: problems
      type(surface_type), intent(in), optional :: surface   !! absent if it is not known, or its keys are bad

      logical :: has_range

      if (load%has('yield') .and. .not. (values%has('yield_stress') .or. values%has_unknown)) &
         call load%complain(problems, 'yield', 'yield needs yield_stress in the group &stress')
      if (values%place == 0) return
      call values%check_relations(problems)
      has_range = values%has('depth_from') .or. values%has('depth_to') .or. values%has('depth_steps')
      if (.not. has_range .and. (values%has('depths') .or. values%has('depths_over_cell_x'))) then
         call values%leave_out('depth_from')
         call values%leave_out('depth_to')
         call values%leave_out('depth_steps')
      else if (values%logical('planes') .and. .not. (has_range .or. values%has_unknown)) then
         call values%complain(problems, 'planes', 'planes needs depths, depths_over_cell_x or a range of depths')
      end if
      call take_ratios(values, material, problems)
      if (present(surface)) then
         if (surface%has_free_edges) then
            if (surface%dimension == 1) call problems%add(values%place, &
               'stresses below a profile with free edges are not computed: leave &stress out')
            if (values%has('lateral')) call values%complain(problems, 'lateral', &
               'a surface with free edges has no mean pressure far below it: leave lateral out')
            call values%set('lateral', text='free')
            call values%leave_out('lateral')
         end if
         if (surface%dimension == 1 .and. any(values%text('section') == ['y       ', 'diagonal'])) &
            call values%complain(problems, 'section', &
            "the surface does not change along y: section must be 'none' or 'x'")
      end if
   end subroutine check_stress_group

   !> What the group asks for. A rigid body has no stresses, and a body that is like the other is left out.
   subroutine make_stress_setting(values, material, p_star, setting)
      type(group_values), intent(in) :: values      !! of a &stress group without problems
      type(group_values), intent(in) :: material
      real(dp), intent(in) :: p_star                !! p* [pressure]; 0 if the surface is flat
      type(stress_setting), allocatable, intent(out) :: setting   !! not allocated if the deck has no group &stress

      real(dp) :: nu(2)
      integer :: lateral
      logical :: are_alike

      if (values%place == 0) return
      allocate (setting)
      nu = values%pair('nu')
      lateral = lateral_is(values%choice('lateral'))
      allocate (setting%body, source=[elastic_body(nu(1), lateral), elastic_body(nu(2), lateral)])
      setting%by_shear = values%text('yield_criterion') == 'tresca'
      if (values%has('yield_stress') .and. p_star > 0.0_dp) setting%yield_stress = values%pair('yield_stress')/p_star
      are_alike = maxval(nu) <= minval(nu)
      if (allocated(setting%yield_stress)) are_alike = are_alike .and. &
         maxval(setting%yield_stress) <= minval(setting%yield_stress)
      ! Without e2 the second body is rigid.
      if (are_alike .or. (material%has('e1') .and. .not. material%has('e2'))) then
         setting%body = setting%body(:1)
         if (allocated(setting%yield_stress)) setting%yield_stress = setting%yield_stress(:1)
      end if
   end subroutine make_stress_setting

end module wavycon_stress_group
