!> What a deck says about a kind of surface: its name, its keys of &surface, and how their values make it. src/README.md
!> describes how to add a kind.
module wavycon_surface_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_relations, only: alternative_type
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_radii, form_radius_keys, length_x_key, length_y_key, radii_of, radius_keys, surface_kind

   !> A value of the key `kind`. A key that two kinds read must have the same type, unit and bounds in both; its meaning
   !> may differ.
   type, extends(alternative_type) :: surface_kind
      procedure(make_interface), pointer, nopass :: make => null()
      procedure(check_interface), pointer, nopass :: check => null()   !! null: there is nothing to check or to set
   end type surface_kind

   abstract interface
      !> `make`: makes the surface. Leaves keys out of the resolved deck that have no effect beside what a file says.
      !> Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for a bad one.
      subroutine make_interface(values, surface, map, error)
         import :: error_type, group_values, map_statistics, surface_type
         type(group_values), intent(inout) :: values   !! of &surface, after `check`, no problems
         type(surface_type), intent(out) :: surface
         type(map_statistics), allocatable, intent(out) :: map   !! allocated for a height map
         type(error_type), allocatable, intent(out) :: error
      end subroutine make_interface

      !> `check`: sets the defaults that depend on other keys, and reports values that contradict each other.
      subroutine check_interface(values, problems)
         import :: group_values, problem_list_type
         type(group_values), intent(inout) :: values          !! of &surface, after check_relations
         type(problem_list_type), intent(inout) :: problems   !! to which they are added
      end subroutine check_interface
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

   !> The radii of a ball, by the name of the first key.
   pure function radius_keys(name, of_what, tens, needs, required) result(keys)
      character(*), intent(in) :: name, of_what
      integer, intent(in) :: tens               !! of their ways
      character(*), intent(in) :: needs         !! of each
      logical, intent(in) :: required           !! whether one or two must be given
      type(key_type) :: keys(3)

      keys(1) = real_key(name, '', 'length', 'radius of '//of_what//'.', above=0.0_dp, required=required, &
                         way=tens, needs=needs)
      keys(2) = real_key(name//'_x', '', 'length', 'radius of curvature along x of '//of_what//'.', above=0.0_dp, &
                         way=tens + 1, needs=trim(name//'_y '//needs))
      keys(3) = real_key(name//'_y', '', 'length', 'radius of curvature along y.', above=0.0_dp, way=tens + 1, &
                         needs=trim(name//'_x '//needs))
   end function radius_keys

   !> Those of the ball that a map with free edges lies on.
   pure function form_radius_keys(what) result(keys)
      character(*), intent(in) :: what   !! lies on it
      type(key_type) :: keys(3)

      keys = radius_keys('form_radius', 'a ball that '//what//" lies on, with edges = 'free'", 30, "edges='free'", &
                         required=.false.)
   end function form_radius_keys

   !> Reports radii too unlike each other.
   subroutine check_radii(values, problems, name)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: name   !! as of radius_keys

      real(dp), parameter :: largest_ratio = 1e4_dp
      real(dp) :: radii(2)

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
