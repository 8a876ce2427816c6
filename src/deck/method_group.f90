!> The &method group: the solver and its parameters. Its keys are those of the solvers.
module wavycon_method_group
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: is_misplaced, leave_out_other_keys, merged_keys, names_reading, selector_key
   use wavycon_key_table, only: key_group, key_group_type
   use wavycon_problems, only: problem_list_type
   use wavycon_method_list, only: default_solver, get_methods, number_of_methods, refusal, solvers_for
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: method_table, check_method_group

contains

   !> The table of keys of &method: `solver` and the keys of all solvers.
   function method_table() result(table)
      type(key_group_type) :: table

      type(solver_method) :: methods(number_of_methods)

      call get_methods(methods)
      associate (alternatives => methods%alternative_type)
         table = key_group('method', 'how the contact is computed', &
                           [selector_key('solver', 'by the surface', alternatives), merged_keys(alternatives)])
      end associate
   end function method_table

   !> Sets the defaults that depend on the surface and checks the keys against the solver.
   subroutine check_method_group(values, kind, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: kind                           !! of the surface, as the deck names it
      type(surface_type), allocatable, intent(in) :: surface     !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      type(solver_method) :: methods(number_of_methods)
      character(:), allocatable :: advice, key, words
      integer :: chosen, k

      call get_methods(methods)
      if (allocated(surface)) call values%set_default('solver', default_solver(surface, kind))
      if (values%is_bad('solver')) return
      chosen = findloc(methods%name == values%text('solver'), .true., dim=1)
      if (chosen == 0) return
      associate (alternatives => methods%alternative_type, method => methods(chosen))
         do k = 1, size(values%table%keys)
            key = trim(values%table%keys(k)%name)
            if (.not. is_misplaced(alternatives, chosen, key, values)) cycle
            advice = ''
            if (key == 'accuracy') advice = trim(method%no_accuracy)
            if (key == 'grid_points') advice = trim(method%no_grid)
            call values%complain(problems, key, key//' is a key of solver = '//names_reading(alternatives, key)// &
                                 ", not of '"//values%text('solver')//"'"//advice)
         end do
         call leave_out_other_keys(alternatives, chosen, values)
         ! Without a surface the remaining checks would report problems that are not there.
         if (.not. allocated(surface)) return
         words = refusal(method, surface)
         if (words /= '') then
            call values%complain(problems, 'solver', "solver = '"//values%text('solver')//"' "//words//'. Give '// &
                                 solvers_for(surface))
            return
         end if
         if (associated(method%set_defaults)) call method%set_defaults(values, surface)
         if (associated(method%check)) call method%check(values, surface, problems)
      end associate
   end subroutine check_method_group

end module wavycon_method_group
