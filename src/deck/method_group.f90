!> The &method group: the solver and its parameters. Its keys are those of the solvers.
module wavycon_method_group
   use wavycon_group_values, only: group_values
   use wavycon_key_relations, only: alternative_group, alternative_type, check_relations
   use wavycon_key_table, only: key_group_type
   use wavycon_problems, only: problem_list_type
   use wavycon_method_list, only: default_solver, get_methods, method_of, number_of_methods, refusal, solvers_for
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: method_table, check_method_group

contains

   !> The table of keys of &method: `solver` and the keys of all solvers.
   function method_table() result(table)
      type(key_group_type) :: table

      type(alternative_type) :: alternatives(number_of_methods)
      type(solver_method) :: methods(number_of_methods)

      call get_methods(methods)
      alternatives = methods%alternative_type
      table = alternative_group('method', 'how the contact is computed', 'solver', 'by the surface', &
                                alternatives, required=.false.)
   end function method_table

   !> Sets the defaults that depend on the surface and checks the keys against the solver.
   subroutine check_method_group(values, kind, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: kind                           !! of the surface, as the deck names it
      type(surface_type), allocatable, intent(in) :: surface     !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      type(solver_method) :: method
      character(:), allocatable :: words

      if (allocated(surface)) call values%set_default('solver', default_solver(surface, kind))
      call check_relations(values, problems)
      method = method_of(values)
      ! Without a surface the remaining checks would report problems that are not there.
      if (.not. allocated(surface) .or. method%name == '') return
      words = refusal(method, surface)
      if (words /= '') then
         call values%complain(problems, 'solver', "solver = '"//values%text('solver')//"' "//words//'. Give '// &
                              solvers_for(surface))
         return
      end if
      if (associated(method%check)) call method%check(values, surface, problems)
   end subroutine check_method_group

end module wavycon_method_group
