!> The &material group: the stiffness of the two bodies, the pressure at which they yield, and a layer in place of the
!> first body.
module wavycon_material_group
   use wavycon_elastic_layer, only: elastic_layer
   use wavycon_full_contact, only: set_closure
   use wavycon_key_group, only: key_group, key_list, key_value
   use wavycon_key_table, only: choice_value, key_type, real_value
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_scene_groups, only: material_group
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_material_group, list_material_keys, plane_strain_modulus, take_ratios

   !> Largest ratio of the hardness to p*, and of p* to the hardness. A larger ratio is most likely a mistake of units.
   real(dp), parameter :: most_hardness = 1.0e6_dp
   !> Largest ratio of a layer's thickness and the longer side of the cell, and of the stiffness of layer and base, for
   !> the same reason.
   real(dp), parameter :: most_of_layer = 1.0e6_dp

contains

   !> The keys of &material.
   subroutine list_material_keys(values, keys)
      type(material_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('material', 'how stiff the two bodies are: e_star, or e1 and nu1 (and e2, nu2)', values%key_group)
      call keys%add(values%e_star, key_type(real_value, 'e_star', '1.0', 'pressure', &
         'Plane-strain modulus E* of the pair, 1/E* = (1 - nu1^2)/e1 + (1 - nu2^2)/e2.', above=0, way=100))
      call keys%add(values%e1, key_type(real_value, 'e1', '', 'pressure', &
         "Young's modulus of the first body.", above=0, way=101, needs='nu1'))
      call keys%add(values%nu1, key_type(real_value, 'nu1', '', '-', &
         "Poisson's ratio of the first body.", above=-1, most=0.5_dp, way=101, needs='e1'))
      call keys%add(values%e2, key_type(real_value, 'e2', '', 'pressure', &
         "Young's modulus of the second body. Without it the second body is rigid.", above=0, way=101, needs='nu2 e1'))
      call keys%add(values%nu2, key_type(real_value, 'nu2', '', '-', &
         "Poisson's ratio of the second body.", above=-1, most=0.5_dp, way=101, needs='e2'))
      call keys%add(values%hardness, key_type(real_value, 'hardness', '', 'unit of e_star', &
         'Largest contact pressure: where it is reached the softer body flows, and an indentation is left. '// &
         'Without it the bodies stay elastic. Mean pressures must be lower. Within a factor of 1e6 of p*.', above=0))
      call keys%add(values%layer_thickness, key_type(real_value, 'layer_thickness', '', 'length', &
         'Thickness of an elastic layer, which is the first body: e1 and nu1, or e_star and layer_nu, are its own. '// &
         'Without it the bodies are half-spaces. Within a factor of 1e6 of the longer side of the cell.', above=0))
      call keys%add(values%layer_base, key_type(choice_value, 'layer_base', "'bonded'", '', &
         "What the layer lies on: 'bonded', on a body that it is bonded to, rigid unless base_e is given; "// &
         "'smooth', on a rigid body on which it slides without friction.", choices='bonded smooth', &
         needs='layer_thickness'))
      call keys%add(values%layer_nu, key_type(real_value, 'layer_nu', '', '-', &
         "Poisson's ratio of a bonded layer, if e_star is given.", above=-1, most=0.5_dp, way=100, &
         needs='layer_thickness'))
      call keys%add(values%base_e, key_type(real_value, 'base_e', '', 'pressure', &
         "Young's modulus of the half-space that the layer is bonded to. Its shear modulus must be within a factor "// &
         "of 1e6 of the layer's. Without it the base is rigid.", above=0, &
         needs='base_nu layer_thickness'))
      call keys%add(values%base_nu, key_type(real_value, 'base_nu', '', '-', &
         "Poisson's ratio of this half-space.", above=-1, most=0.5_dp, needs='base_e'))
   end subroutine list_material_keys

   !> Checks the keys, lays the surface on a layer if there is one, finds E* and p*, and sets the hardness of the
   !> surface. A hardness of a flat surface is reported, and one that is not within `most_hardness` of p*.
   subroutine check_material_group(values, surface, e_star, p_star)
      type(material_group), intent(inout) :: values
      type(surface_type), allocatable, intent(inout) :: surface   !! not allocated if it could not be made
      real(dp), intent(out) :: e_star, p_star                      !! E*, p* [pressure]; 0 if there are problems

      real(dp) :: hardness

      e_star = 0.0_dp
      p_star = 0.0_dp
      if (values%layer_thickness%is_given) call check_layer(values, surface)
      if (.not. allocated(surface)) return
      if (values%hardness%is_given .and. surface%full_contact_pressure(1.0_dp) <= 0.0_dp) call values%complain( &
         values%hardness, 'the surface is flat: its pressure is the mean pressure, and a hardness means nothing')
      if (values%problems%number > 0 .or. values%any_bad) return
      e_star = plane_strain_modulus(values)
      if (values%layer_thickness%is_given) call lay_on_base(values, e_star, surface)
      p_star = surface%full_contact_pressure(e_star)
      if (values%hardness%is_given .and. values%problems%number == 0) then
         hardness = values%hardness%number
         if (hardness > most_hardness*p_star .or. hardness < p_star/most_hardness) then
            call values%complain(values%hardness, &
               'hardness = '//short_number(hardness)//' is not within a factor of '// &
               short_number(most_hardness)//' of p* = '//short_number(p_star)//'. Do the units agree?')
         else
            surface%hardness = hardness/p_star
         end if
      end if
      if (values%problems%number == 0) return
      ! A modulus or a length in another unit has been reported: loads are not compared with it.
      e_star = 0.0_dp
      p_star = 0.0_dp
   end subroutine check_material_group

   !> Reports a layer that lacks a key or contradicts another, and surfaces that have none. Other keys may be bad.
   subroutine check_layer(values, surface)
      type(material_group), intent(inout) :: values   !! with a layer
      type(surface_type), allocatable, intent(in) :: surface   !! not allocated if it could not be made

      real(dp) :: longest, sides(2), thickness

      if (.not. (values%layer_base%is_bad .or. values%has_unknown)) then
         if (values%layer_base%text == 'smooth') then
            if (values%base_e%is_given) call values%complain(values%base_e, &
               "a layer slides on rigid bases only: leave base_e out, or layer_base = 'smooth'")
            if (values%layer_nu%is_given) call values%complain(values%layer_nu, &
               'the compliance of a layer that slides follows from e_star alone: leave layer_nu out')
         else if (.not. (values%nu1%is_given .or. values%e1%is_given .or. values%layer_nu%is_given)) then
            ! e1 without nu1 is reported elsewhere.
            call values%complain(values%layer_base, &
               "a bonded layer needs layer_nu, Poisson's ratio: its compliance follows from it")
         end if
      end if
      if (.not. allocated(surface)) return
      sides = surface%sides()
      longest = maxval(sides(:surface%dimension))
      thickness = values%layer_thickness%number
      if (surface%has_free_edges) then
         call values%complain(values%layer_thickness, &
            'layers are for surfaces that are repeated, and this one has free edges: leave layer_thickness out')
      else if (surface%amplitude <= 0.0_dp) then
         call values%complain(values%layer_thickness, &
            'the surface is flat: its pressure is the mean pressure on any layer. Leave layer_thickness out')
      else if ((thickness > most_of_layer*longest .or. thickness < longest/most_of_layer) .and. &
               .not. values%layer_thickness%is_bad) then
         call values%complain(values%layer_thickness, 'layer_thickness = '//short_number(thickness)// &
            ' is not within a factor of '//short_number(most_of_layer)//' of the side of the cell, '// &
            short_number(longest)//'. Do the units agree?')
      end if
   end subroutine check_layer

   !> Puts a layer under the surface, which gets another p*. Reports a layer and a base of very different stiffness.
   subroutine lay_on_base(values, e_star, surface)
      type(material_group), intent(inout) :: values   !! with a layer, without problems
      real(dp), intent(in) :: e_star                  !! of the pair [pressure]
      type(surface_type), intent(inout) :: surface

      type(elastic_layer) :: layer

      layer%slides = values%layer_base%text == 'smooth'
      layer%thickness = values%layer_thickness%number
      if (values%layer_nu%is_given) layer%nu = values%layer_nu%number
      if (values%nu1%is_given) layer%nu = values%nu1%number
      ! Without a second body it is one to the last digit: the rest counts beside the factor of a thin layer.
      if (values%e2%is_given) layer%share = e_star*(1 - layer%nu**2)/values%e1%number
      if (values%base_e%is_given) then
         layer%base_nu = values%base_nu%number
         layer%shear_ratio = e_star*(1 - layer%nu)*(1 + layer%base_nu)/(layer%share*values%base_e%number)
         if (abs(log(layer%shear_ratio)) > log(most_of_layer)) call values%complain(values%base_e, &
            'layer and base differ in stiffness by more than '//short_number(most_of_layer)//'. Do the units agree?')
      end if
      if (values%problems%number > 0) return
      surface%kernel%layer = layer
      call set_closure(surface)
   end subroutine lay_on_base

   !> The modulus E* of the pair of bodies [pressure]: the deck's e_star, or 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. If
   !> the deck gives no E2 the second body is rigid, and the second term is left out.
   pure real(dp) function plane_strain_modulus(values) result(e_star)
      type(material_group), intent(in) :: values   !! without problems

      real(dp) :: compliance

      e_star = values%e_star%number
      if (.not. values%e1%is_given) return
      compliance = (1 - values%nu1%number**2)/values%e1%number
      if (values%e2%is_given) compliance = compliance + (1 - values%nu2%number**2)/values%e2%number
      e_star = 1/compliance
   end function plane_strain_modulus

   !> Sets the key nu of another group, Poisson's ratios, to the ratios of &material. If both groups give ratios, or
   !> neither, a problem is reported.
   subroutine take_ratios(group, name, nu, material)
      class(key_group), intent(inout) :: group       !! the other group, which the deck has
      character(*), intent(in) :: name               !! its name
      type(key_value), intent(inout) :: nu           !! its key nu
      type(material_group), intent(in) :: material

      if (material%any_bad .or. group%has_unknown .or. nu%is_bad) return
      ! Here &material lacks nu1, which has been reported.
      if (material%e1%is_given .and. .not. material%nu1%is_given) return
      if (material%nu1%is_given) then
         if (nu%is_given) call group%complain(nu, 'nu contradicts nu1 of &material: leave it out')
         call nu%set_default([material%nu1%numbers, material%nu2%numbers])
         nu%in_effect = .false.
      else if (.not. nu%is_given) then
         call group%complain(nu, '&'//name//" needs nu, Poisson's ratio: &material does not give nu1")
      end if
   end subroutine take_ratios

end module wavycon_material_group
