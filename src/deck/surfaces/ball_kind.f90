!> kind = 'ball': a ball, or a body with two radii of curvature, pressed on a half-space.
module wavycon_ball_kind
   use wavycon_constants, only: pi
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_hertz_ball, only: hertz_ball, hertz_of_approach, hertz_of_area, hertz_of_force, hertz_of_peak_pressure
   use wavycon_key_table, only: integer_key, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: most_points
   use wavycon_map_statistics, only: map_statistics
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_of_ball, surface_type
   use wavycon_surface_kind, only: check_radii, length_x_key, length_y_key, radii_of, radius_keys, surface_kind
   implicit none (type, external)
   private

   public :: ball_kind, set_ball_sides

   !> Sides of the rectangle that is computed, over the half axes of Hertz's contact under the largest load: twice the
   !> contact, so that a hardness or a rough estimate of the load does not bring its edge to the border.
   real(dp), parameter :: sides_over_half_axes = 4.0_dp

contains

   type(surface_kind) function ball_kind() result(kind)
      kind%name = 'ball'
      kind%meaning = 'a ball on a half-space, not repeated'
      allocate (kind%keys, source=[ &
         radius_keys('radius', 'the ball', 20, '', required=.true.), length_x_key(), length_y_key(), &
         integer_key('points', 'as kind says', 'points of the rectangle length_x x length_y along x and y on which '// &
                     'the ball is solved; one number for both. Without it grids are refined to the accuracy of '// &
                     '&method.', &
                     1, most_points, most_values=2)])
      kind%make => make
      kind%check => check
   end function ball_kind

   !> Reports radii too unlike each other, and one side without the other.
   subroutine check(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      call check_radii(values, problems, 'radius')
      if (values%has('length_y') .and. .not. values%has('length_x')) &
         call values%complain(problems, 'length_y', 'length_y needs length_x beside it')
   end subroutine check

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
         contact = hertz_of_force(radii, e_star, largest)
      case ('approach')
         contact = hertz_of_approach(radii, e_star, largest)
      case ('contact_area')
         contact = hertz_of_area(radii, e_star, largest)
      case default
         contact = hertz_of_peak_pressure(radii, e_star, largest)
      end select
      half_axis = contact%half_axis
      if (hardness < huge(hardness)) half_axis = half_axis &
         *max(1.0_dp, sqrt(contact%force/(hardness*contact%contact_area())))
      ! Without load any rectangle will do.
      if (.not. minval(half_axis) > 0.0_dp) half_axis = minval(radii)/10
      call values%set_default('length_x', sides_over_half_axes*half_axis(1:1))
      call values%set_default('length_y', sides_over_half_axes*half_axis(2:2))
   end subroutine set_ball_sides

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      if (allocated(map) .or. allocated(error)) return
      surface = surface_of_ball([values%real('length_x'), values%real('length_y')], radii_of(values, 'radius'), 2)
      if (values%has('points')) surface%points = surface%parts()*nint(values%pair('points'))
   end subroutine make

end module wavycon_ball_kind
