!> What a deck says about a solver: its name, its keys of &method, what it refuses, and how the values of the keys start
!> it. src/README.md describes how to add a solver.
module wavycon_solver_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: solver_method

   !> A value of the key `solver`. Of the procedures below the deferred ones must be written; the others have defaults.
   !>
   !> N.B. A method has no components: `get_methods` makes its list by copying.
   type, abstract :: solver_method
   contains
      procedure(words_interface), deferred, nopass :: name
      procedure(words_interface), deferred, nopass :: meaning
      procedure(keys_interface), deferred, nopass :: keys
      procedure, nopass :: refusal => no_refusal
      procedure, nopass :: is_default_for => never
      procedure, nopass :: set_defaults => no_defaults
      procedure, nopass :: check => no_check
      procedure, nopass :: advice => no_advice
      procedure(traits_interface), deferred, nopass :: traits
      procedure(make_interface), deferred, nopass :: make
      procedure(describe_interface), deferred, nopass :: describe
      procedure, nopass :: why_no_area => no_reason
   end type solver_method

   abstract interface
      !> `name`: the value of the key `solver` in decks, at most 12 characters. `meaning`: one clause for the key
      !> reference.
      pure function words_interface() result(words)
         character(:), allocatable :: words
      end function words_interface

      !> `keys`: the keys of &method that the solver reads, besides `solver`. A key that two solvers read must have
      !> the same type, unit and bounds in both; its meaning may differ.
      function keys_interface() result(keys)
         import :: key_type
         type(key_type), allocatable :: keys(:)
      end function keys_interface

      !> `traits`: those of the solver before it is started.
      function traits_interface() result(traits)
         import :: solver_traits
         type(solver_traits) :: traits
      end function traits_interface

      !> `make`: starts the solver with the values of &method.
      subroutine make_interface(values, surface, keep_fields, solver)
         import :: contact_solver, group_values, surface_type
         type(group_values), intent(in) :: values      !! of &method, after `set_defaults` and `check`, without problems
         type(surface_type), intent(in) :: surface     !! for which `refusal` is empty
         logical, intent(in) :: keep_fields            !! whether fields, edges or details of solutions will be needed
         class(contact_solver), allocatable, intent(out) :: solver
      end subroutine make_interface

      !> `describe`: the discretisation in words, for the log and the heads of tables.
      function describe_interface(values, surface, traits) result(words)
         import :: group_values, solver_traits, surface_type
         type(group_values), intent(in) :: values      !! as of `make`
         type(surface_type), intent(in) :: surface
         type(solver_traits), intent(in) :: traits     !! of the started solver
         character(:), allocatable :: words
      end function describe_interface
   end interface

contains

   !> `refusal`: why the solver cannot solve a surface, as the end of a sentence such as 'is for the 1-D wave'; empty
   !> if it can. Here it is empty.
   function no_refusal(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => surface); end associate
      words = ''
   end function no_refusal

   !> `is_default_for`: whether this solver is the default for a surface. If several are, the first of the list is
   !> taken. Here it is not.
   logical function never(surface, kind)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind           !! of the surface, as the deck names it

      associate (unused => surface, unused_too => kind); end associate
      never = .false.
   end function never

   !> `set_defaults`: sets the defaults that depend on the surface and leaves keys without a meaning for it out of the
   !> resolved deck. Here there are none.
   subroutine no_defaults(values, surface)
      type(group_values), intent(inout) :: values   !! of &method
      type(surface_type), intent(in) :: surface

      associate (unused => values, unused_too => surface); end associate
   end subroutine no_defaults

   !> `check`: reports values that contradict each other or the surface. Here there are none.
   subroutine no_check(values, surface, problems)
      type(group_values), intent(in) :: values           !! after `set_defaults`
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems   !! to which they are added

      associate (unused => values, unused_too => surface, also_unused => problems); end associate
   end subroutine no_check

   !> `advice`: what to give instead of a key of another solver, or why this one has no such key, as the end of a
   !> sentence such as ': it has no grid'. Here it is empty.
   function no_advice(key) result(words)
      character(*), intent(in) :: key   !! that other solvers read
      character(:), allocatable :: words

      words = key(:0)
   end function no_advice

   !> `why_no_area`: why a converged solution may have no contact area, such as 'no pressure reaches 0.1 p*'; empty if it
   !> always has one. Here it is empty.
   function no_reason(values) result(words)
      type(group_values), intent(in) :: values   !! of &method
      character(:), allocatable :: words

      associate (unused => values); end associate
      words = ''
   end function no_reason

end module wavycon_solver_method
