!> What a kind of surface declares of itself: a deck's `kind` names it, &surface holds its keys.
!>
!> To add a kind: extend this type in a file of its own and add it to the list in surface_kinds.f90.
module wavycon_surface_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_map_statistics, only: map_statistics
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: surface_kind

   !> N.B. Without components: the list of kinds copies what it is given.
   type, abstract :: surface_kind
   contains
      procedure(words_interface), deferred, nopass :: name
      procedure(words_interface), deferred, nopass :: meaning
      procedure(keys_interface), deferred, nopass :: keys
      procedure(make_interface), deferred, nopass :: make
      procedure, nopass :: set_defaults => no_defaults
      procedure, nopass :: check => no_check
      procedure, nopass :: advice => no_advice
      procedure, nopass :: paper_wave_if => never
   end type surface_kind

   abstract interface
      !> `name`: as a deck gives it, at most 12 characters. `meaning`: one clause for the key reference.
      function words_interface() result(words)
         character(:), allocatable :: words
      end function words_interface

      !> The keys that the kind reads, besides `kind`. `required` ones it cannot do without. A key that two kinds read
      !> must have the same type, unit and bounds in both; its meaning may differ.
      function keys_interface() result(keys)
         import :: key_type
         type(key_type), allocatable :: keys(:)
      end function keys_interface

      !> Makes the surface of a group without problems. Errors: exit_file_trouble for a file that cannot be read,
      !> exit_bad_input for what it holds.
      subroutine make_interface(values, surface, map, error)
         import :: error_type, group_values, map_statistics, surface_type
         type(group_values), intent(in) :: values   !! after `set_defaults`, without problems
         type(surface_type), intent(out) :: surface
         type(map_statistics), allocatable, intent(out) :: map   !! allocated for a height map
         type(error_type), allocatable, intent(out) :: error
      end subroutine make_interface
   end interface

contains

   !> `set_defaults`: sets the defaults that depend on other keys. Here there are none.
   subroutine no_defaults(values)
      type(group_values), intent(inout) :: values

      associate (unused => values)
      end associate
   end subroutine no_defaults

   !> `check`: reports values that contradict each other. Here there are none.
   subroutine no_check(values, problems)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems

      associate (unused_values => values, unused_problems => problems)
      end associate
   end subroutine no_check

   !> `advice`: what to give instead of a key of another kind, as the end of a sentence such as ': give amplitudes'.
   !> Here there is none.
   function no_advice(key) result(words)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      words = key(:0)
   end function no_advice

   !> `paper_wave_if`: when the kind is a wave of Johnson, Greenwood & Higginson (1985), such as 'wave_2d with one
   !> wavelength'. Empty for a kind that is none by its form.
   function never() result(words)
      character(:), allocatable :: words

      words = ''
   end function never

end module wavycon_surface_kind
