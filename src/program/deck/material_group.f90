!> The &material group: the stiffness of the two bodies, and the pressure at which they yield.
module wavycon_material_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type, real_value
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_material_group, plane_strain_modulus, take_ratios

   !> Largest ratio of hardness and p*: a hardness farther away is most likely a mistake of units.
   real(dp), parameter :: most_hardness = 1.0e6_dp

   !> The keys of &material.
   type(key_type), parameter, public :: material_keys(*) = [ &
      key_type(real_value, 'e_star', '1.0', 'pressure', &
         'Plane-strain modulus E* of the pair, 1/E* = (1 - nu1^2)/e1 + (1 - nu2^2)/e2.', above=0, way=10), &
      key_type(real_value, 'e1', '', 'pressure', &
         "Young's modulus of the first body.", above=0, way=11, needs='nu1'), &
      key_type(real_value, 'nu1', '', '-', &
         "Poisson's ratio of the first body.", above=-1, most=0.5_dp, way=11, needs='e1'), &
      key_type(real_value, 'e2', '', 'pressure', &
         "Young's modulus of the second body. Without it the second body is rigid.", above=0, way=11, &
         needs='nu2 e1'), &
      key_type(real_value, 'nu2', '', '-', &
         "Poisson's ratio of the second body.", above=-1, most=0.5_dp, way=11, needs='e2'), &
      key_type(real_value, 'hardness', '', 'unit of e_star', &
         'Largest contact pressure: where it is reached the softer body flows, and an indentation is left. '// &
         'Without it the bodies stay elastic. Mean pressures must be lower. Within a factor of 1e6 of p*.', &
         above=0)]

contains

   !> Checks the keys. Finds E* and, where there is a surface, p*
   !> and its hardness: not one of a flat surface, nor one so far from p* that its unit is most likely wrong.
   subroutine check_material_group(values, surface, e_star, p_star, problems)
      type(group_values), intent(inout) :: values
      type(surface_type), allocatable, intent(inout) :: surface   !! not allocated if it has problems
      real(dp), intent(out) :: e_star, p_star                      !! E*, p* [pressure]; 0 if there are problems
      type(problem_list_type), intent(inout) :: problems

      integer :: before
      real(dp) :: hardness

      e_star = 0.0_dp
      p_star = 0.0_dp
      before = problems%number
      call values%check_relations(problems)
      if (problems%number > before .or. values%any_bad() .or. .not. allocated(surface)) return
      e_star = plane_strain_modulus(values)
      p_star = surface%full_contact_pressure(e_star)
      if (.not. values%has('hardness')) return
      hardness = values%real('hardness')
      if (p_star <= 0.0_dp) then
         call values%complain(problems, 'hardness', &
            'the surface is flat: its pressure is the mean pressure, and a hardness means nothing')
      else if (hardness > most_hardness*p_star .or. hardness < p_star/most_hardness) then
         call values%complain(problems, 'hardness', &
            'hardness = '//short_number(hardness)//' is not within a factor of '// &
            short_number(most_hardness)//' of p* = '//short_number(p_star)//'. Do the units agree?')
      else
         surface%hardness = hardness/p_star
      end if
   end subroutine check_material_group

   !> E* of the pair [pressure]: as given, or from 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, without the second term if
   !> the second body is rigid.
   pure real(dp) function plane_strain_modulus(values) result(e_star)
      type(group_values), intent(in) :: values   !! of a &material group without problems

      real(dp) :: compliance

      if (values%has('e1')) then
         compliance = (1 - values%real('nu1')**2)/values%real('e1')
         if (values%has('e2')) compliance = compliance + (1 - values%real('nu2')**2)/values%real('e2')
         e_star = 1/compliance
      else
         e_star = values%real('e_star')
      end if
   end function plane_strain_modulus

   !> Sets the key nu of another group, Poisson's ratios, to those of &material. Reports that both or none give them.
   subroutine take_ratios(values, material, problems)
      type(group_values), intent(inout) :: values    !! of the group, which the deck gives
      type(group_values), intent(in) :: material
      type(problem_list_type), intent(inout) :: problems

      if (material%any_bad() .or. values%has_unknown .or. values%is_bad('nu')) return
      ! Then &material lacks nu1, which has been reported.
      if (material%has('e1') .and. .not. material%has('nu1')) return
      if (material%has('nu1')) then
         if (values%has('nu')) call values%complain(problems, 'nu', 'nu contradicts nu1 of &material: leave it out')
         call values%set_default('nu', [material%reals('nu1'), material%reals('nu2')])
         call values%leave_out('nu')
      else if (.not. values%has('nu')) then
         call problems%add(values%place, '&'//trim(values%table%name)// &
                           " needs nu, Poisson's ratio: &material does not give nu1")
      end if
   end subroutine take_ratios

end module wavycon_material_group
