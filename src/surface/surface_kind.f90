!> The type that all kinds of surface of &surface extend. src/README.md describes how to add a kind.
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

   !> A kind of surface. Of the procedures below the deferred ones must be written; the others have defaults.
   !>
   !> N.B. A kind has no components: `get_surface_kinds` makes its list by copying.
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
      !> `name`: the value of the key `kind` in decks, at most 12 characters. `meaning`: one clause for the key
      !> reference.
      function words_interface() result(words)
         character(:), allocatable :: words
      end function words_interface

      !> `keys`: the keys of &surface that the kind reads, besides `kind`. A key that two kinds read must have the
      !> same type, unit and bounds in both; its meaning may differ.
      function keys_interface() result(keys)
         import :: key_type
         type(key_type), allocatable :: keys(:)
      end function keys_interface

      !> `make`: makes the surface. Leaves keys out of the resolved deck that have no effect beside what a file says.
      !> Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for a bad one.
      subroutine make_interface(values, surface, map, error)
         import :: error_type, group_values, map_statistics, surface_type
         type(group_values), intent(inout) :: values   !! of &surface, after `set_defaults` and `check`, no problems
         type(surface_type), intent(out) :: surface
         type(map_statistics), allocatable, intent(out) :: map   !! allocated for a height map
         type(error_type), allocatable, intent(out) :: error
      end subroutine make_interface
   end interface

contains

   !> `set_defaults`: sets the defaults that depend on other keys. Here there are none.
   subroutine no_defaults(values)
      type(group_values), intent(inout) :: values   !! of &surface

      associate (unused => values)
      end associate
   end subroutine no_defaults

   !> `check`: reports values that contradict each other. Here there are none.
   subroutine no_check(values, problems)
      type(group_values), intent(in) :: values             !! after `set_defaults`
      type(problem_list_type), intent(inout) :: problems   !! to which they are added

      associate (unused_values => values, unused_problems => problems)
      end associate
   end subroutine no_check

   !> `advice`: what to give instead of a key of another kind, or why this one has no such key, as the end of a sentence
   !> such as ': give amplitudes'. Here it is empty.
   function no_advice(key) result(words)
      character(*), intent(in) :: key   !! that other kinds read
      character(:), allocatable :: words

      words = key(:0)
   end function no_advice

   !> `paper_wave_if`: on what condition the kind is a wave of Johnson, Greenwood & Higginson (1985), eq. (3) or (21),
   !> such as 'wave_2d with one wavelength'; empty if it is none by definition. Here it is empty.
   function never() result(words)
      character(:), allocatable :: words

      words = ''
   end function never

end module wavycon_surface_kind
