!> What a deck says about a kind of surface: its name, its keys of &surface, and how their values make it. src/README.md
!> describes how to add a kind.
module wavycon_surface_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: length_x_key, length_y_key, surface_kind

   !> A value of the key `kind`. A key that two kinds read must have the same type, unit and bounds in both; its meaning
   !> may differ.
   type, extends(alternative_type) :: surface_kind
      !> On what condition the kind is a wave of Johnson, Greenwood & Higginson (1985), eq. (3) or (21), such as
      !> 'wave_2d with one wavelength'; empty if it is none by definition.
      character(40) :: paper_wave_if = ''
      procedure(make_interface), pointer, nopass :: make => null()
      procedure(defaults_interface), pointer, nopass :: set_defaults => null()   !! null: none depends on other keys
      procedure(check_interface), pointer, nopass :: check => null()             !! null: none contradicts another
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

end module wavycon_surface_kind
