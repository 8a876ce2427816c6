!> kind = 'ball': a ball, or a body with two radii of curvature, pressed on a half-space.
module wavycon_ball_kind
   use wavycon_group_values, only: group_values
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_of_ball, surface_type
   implicit none (type, external)
   private

   public :: ball_surface, radii_of, set_ball_sides

   !> Sides of the rectangle that is computed, over the half axes of Hertz's contact under the largest load: twice the
   !> contact, so that a hardness or a rough estimate of the load does not bring its edge to the border.
   real(dp), parameter :: sides_over_half_axes = 4.0_dp

contains

   !> Sets the default sides: some half axes of Hertz's contact at the largest load, or what carries it at the hardness.
   subroutine set_ball_sides(values, e_star, hardness, key, largest)
      type(group_values), intent(inout) :: values
      real(dp), intent(in) :: e_star, hardness    !! [pressure]; the second huge if there is none
      character(*), intent(in) :: key             !! of the loads: 'force', 'approach', 'contact_area' or another
      real(dp), intent(in) :: largest             !! load, in its unit

      real(dp) :: half_axis(2), radii(2)
      type(hertz_ball) :: contact

      if (values%has('length_x')) then
         if (.not. values%has('length_y')) call values%set_default('length_y', [values%real('length_x')])
         return
      end if
      radii = radii_of(values, 'radius')
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
      if (hardness < huge(hardness)) half_axis = half_axis &
         *max(1.0_dp, sqrt(contact%force/(hardness*contact%contact_area())))
      ! Without load any rectangle will do.
      if (.not. minval(half_axis) > 0.0_dp) half_axis = minval(radii)/10
      call values%set_default('length_x', sides_over_half_axes*half_axis(1:1))
      call values%set_default('length_y', sides_over_half_axes*half_axis(2:2))
   end subroutine set_ball_sides

   function ball_surface(values) result(surface)
      type(group_values), intent(in) :: values   !! of &surface, after set_ball_sides
      type(surface_type) :: surface

      surface = surface_of_ball([values%real('length_x'), values%real('length_y')], radii_of(values, 'radius'), 2)
      if (values%has('points')) surface%points = surface%parts()*nint(values%pair('points'))
   end function ball_surface

   !> The radii along x and y that the keys `name`, or `name_x` and `name_y`, give [length]; huge where they give none.
   pure function radii_of(values, name) result(radii)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: name
      real(dp) :: radii(2)

      radii = huge(radii)
      if (values%has(name)) radii = values%real(name)
      if (values%has(name//'_x')) radii(1) = values%real(name//'_x')
      if (values%has(name//'_y')) radii(2) = values%real(name//'_y')
   end function radii_of

end module wavycon_ball_kind
