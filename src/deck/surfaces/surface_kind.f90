!> What a deck says about a kind of surface: its name, its keys of &surface, and how their values make it. src/README.md
!> describes how to add a kind.
module wavycon_surface_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_form, check_radii, form_radius_keys, length_x_key, length_y_key, radii_of, surface_kind

   !> A value of the key `kind`. A key that two kinds read must have the same type, unit and bounds in both; its meaning
   !> may differ.
   type, extends(alternative_type) :: surface_kind
      !> On what condition the kind is a wave of Johnson, Greenwood & Higginson (1985), eq. (3) or (21), such as
      !> 'wave_2d with one wavelength'; empty if it is none by definition.
      character(40) :: paper_wave_if = ''
      procedure(make_interface), pointer, nopass :: make => null()
      procedure(defaults_interface), pointer, nopass :: set_defaults => null()   !! null: none depends on other keys
      procedure(check_interface), pointer, nopass :: check => null()             !! null: none contradicts another
      procedure(sides_interface), pointer, nopass :: set_sides => null()         !! null: no side depends on the loads
   end type surface_kind

   abstract interface
      !> `make`: makes the surface. Leaves keys out of the resolved deck that have no effect beside what a file says.
      !> Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for a bad one.
      subroutine make_interface(values, surface, map, error)
         import :: error_type, group_values, map_statistics, surface_type
         type(group_values), intent(inout) :: values   !! of &surface, after `set_defaults` and `check`, no problems
         type(surface_type), intent(out) :: surface
         type(map_statistics), allocatable, intent(out) :: map   !! allocated for a height map
         type(error_type), allocatable, intent(out) :: error
      end subroutine make_interface

      !> `set_defaults`: sets the defaults that depend on other keys.
      subroutine defaults_interface(values)
         import :: group_values
         type(group_values), intent(inout) :: values   !! of &surface
      end subroutine defaults_interface

      !> `check`: reports values that contradict each other.
      subroutine check_interface(values, problems)
         import :: group_values, problem_list_type
         type(group_values), intent(in) :: values             !! after `set_defaults`
         type(problem_list_type), intent(inout) :: problems   !! to which they are added
      end subroutine check_interface

      !> `set_sides`: sets the default sides, which depend on the loads.
      subroutine sides_interface(values, e_star, hardness, key, largest)
         import :: dp, group_values
         type(group_values), intent(inout) :: values   !! of &surface, without problems
         real(dp), intent(in) :: e_star, hardness      !! [pressure]; the second huge if there is none
         character(*), intent(in) :: key               !! of &load that gives the loads
         real(dp), intent(in) :: largest               !! of the loads, in the unit of the key
      end subroutine sides_interface
   end interface

contains

   !> Keys that several kinds read.
   pure type(key_type) function length_x_key() result(key)
      key = real_key('length_x', '1.0', 'length', 'side of the periodic cell along x.', above=0.0_dp)
   end function length_x_key

   pure type(key_type) function length_y_key(meaning) result(key)
      character(*), intent(in), optional :: meaning   !! if it is not only the side of the cell

      key = real_key('length_y', 'length_x', 'length', 'side of the periodic cell along y.', above=0.0_dp)
      if (present(meaning)) key%meaning = meaning
   end function length_y_key

   !> The radii of the ball that a map with free edges lies on, or of a ball, by the name of the first key.
   pure function form_radius_keys(name, of_what) result(keys)
      character(*), intent(in) :: name      !! 'radius' or 'form_radius'
      character(*), intent(in) :: of_what
      type(key_type) :: keys(3)

      keys(1) = real_key(name, '', 'length', 'radius of '//of_what//'.', above=0.0_dp, way=1)
      keys(2) = real_key(name//'_x', '', 'length', 'radius of curvature along x of '//of_what//'; needs '//name// &
                         '_y.', above=0.0_dp, way=2)
      keys(3) = real_key(name//'_y', '', 'length', 'radius of curvature along y; needs '//name//'_x.', above=0.0_dp, &
                         way=2)
   end function form_radius_keys

   !> Reports the radius of a form without free edges, and radii of which one is missing.
   subroutine check_form(values, problems)
      type(group_values), intent(in) :: values             !! of a kind with the keys `edges` and `form_radius`
      type(problem_list_type), intent(inout) :: problems

      character(13), parameter :: keys(3) = [character(13) :: 'form_radius', 'form_radius_x', 'form_radius_y']
      integer :: k

      do k = 1, size(keys)
         if (values%has(trim(keys(k))) .and. values%text('edges') /= 'free') call values%complain(problems, &
            trim(keys(k)), trim(keys(k))//" is for edges = 'free': a ball is not periodic")
      end do
      call check_radii(values, problems, 'form_radius')
   end subroutine check_form

   !> Reports one of two radii without the other, radii beside one for both, and radii too unlike each other.
   subroutine check_radii(values, problems, name)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: name   !! as of form_radius_keys

      real(dp), parameter :: largest_ratio = 1e4_dp
      real(dp) :: radii(2)

      call values%forbid(problems, name, name//'_x', 'give '//name//', or '//name//'_x and '//name//'_y')
      call values%forbid(problems, name, name//'_y', 'give '//name//', or '//name//'_x and '//name//'_y')
      call values%require(problems, name//'_x', name//'_y')
      call values%require(problems, name//'_y', name//'_x')
      if (values%any_bad() .or. .not. (values%has(name//'_x') .and. values%has(name//'_y'))) return
      radii = radii_of(values, name)
      if (maxval(radii) > largest_ratio*minval(radii)) call values%complain(problems, name//'_x', name//'_x and '// &
         name//'_y must be within a factor of '//short_number(largest_ratio)//'; for a roller give a profile')
   end subroutine check_radii

   !> The radii along x and y that these keys give [length]; huge where they give none.
   pure function radii_of(values, name) result(radii)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: name
      real(dp) :: radii(2)

      radii = huge(radii)
      if (values%has(name)) radii = values%real(name)
      if (values%has(name//'_x')) radii(1) = values%real(name//'_x')
      if (values%has(name//'_y')) radii(2) = values%real(name//'_y')
   end function radii_of

end module wavycon_surface_kind
