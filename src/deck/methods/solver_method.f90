!> What a deck says about a solver: its name, its keys of &method, what it refuses, and how their values start it.
!> src/README.md describes how to add a solver.
module wavycon_solver_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_group_values, only: group_values
   use wavycon_key_relations, only: alternative_type
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: solver_method

   !> A value of the key `solver`. A key that two solvers read must have the same type, unit and bounds in both; its
   !> meaning may differ.
   type, extends(alternative_type) :: solver_method
      type(solver_traits) :: traits         !! of the solver before it is started
      procedure(refusal_interface), pointer, nopass :: refusal => null()   !! null: it refuses no surface
      procedure(check_interface), pointer, nopass :: check => null()   !! null: there is nothing to check or to set
      procedure(make_interface), pointer, nopass :: make => null()
   end type solver_method

   abstract interface
      !> `refusal`: why the solver cannot solve a surface, as the end of a sentence such as 'is for the 1-D wave'; empty
      !> if it can.
      subroutine refusal_interface(surface, words)
         import :: surface_type
         type(surface_type), intent(in) :: surface
         character(:), allocatable, intent(out) :: words
      end subroutine refusal_interface

      !> `check`: sets the defaults that depend on the surface, leaves keys without a meaning for it out of the resolved
      !> deck, and reports values that contradict each other or the surface.
      subroutine check_interface(values, surface, problems)
         import :: group_values, problem_list_type, surface_type
         type(group_values), intent(inout) :: values          !! of &method, after check_relations
         type(surface_type), intent(in) :: surface            !! for which `refusal` is empty
         type(problem_list_type), intent(inout) :: problems   !! to which they are added
      end subroutine check_interface

      !> `make`: starts the solver with the values of &method.
      subroutine make_interface(values, surface, keep_fields, solver, description)
         import :: contact_solver, group_values, surface_type
         type(group_values), intent(in) :: values      !! of &method, after `check`, without problems
         type(surface_type), intent(in) :: surface     !! for which `refusal` is empty
         logical, intent(in) :: keep_fields            !! whether fields, edges or details of solutions will be needed
         class(contact_solver), allocatable, intent(out) :: solver
         character(:), allocatable, intent(out) :: description   !! the discretisation, for log and heads of tables
      end subroutine make_interface
   end interface

end module wavycon_solver_method
