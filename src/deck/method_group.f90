!> The &method group: the solver and its parameters. Its keys are those of the solvers.
module wavycon_method_group
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type, is_misplaced, leave_out_other_keys, merged_keys, &
      names_reading, selector_key
   use wavycon_key_table, only: key_group, key_group_type
   use wavycon_problems, only: problem_list_type
   use wavycon_method_list, only: default_solver, get_methods, keys_of_methods, method_item, solvers_for
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: method_table, check_method_group

contains

   !> The table of keys of &method: `solver` and the keys of all solvers.
   function method_table() result(table)
      type(key_group_type) :: table

      type(method_item), allocatable :: methods(:)
      type(alternative_type), allocatable :: alternatives(:)

      call get_methods(methods)
      call keys_of_methods(methods, alternatives)
      table = key_group('method', 'how the contact is computed', &
                        [selector_key('solver', 'by the surface', alternatives), merged_keys(alternatives)])
   end function method_table

   !> Sets the defaults that depend on the surface and checks the keys against the solver.
   subroutine check_method_group(values, kind, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: kind                           !! of the surface, as the deck names it
      type(surface_type), allocatable, intent(in) :: surface     !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      type(method_item), allocatable :: methods(:)
      type(alternative_type), allocatable :: alternatives(:)
      character(:), allocatable :: key, refusal
      integer :: chosen, k

      call get_methods(methods)
      call keys_of_methods(methods, alternatives)
      if (allocated(surface)) call values%set_default('solver', default_solver(surface, kind))
      if (values%is_bad('solver')) return
      chosen = findloc(alternatives%name == values%text('solver'), .true., dim=1)
      if (chosen == 0) return
      do k = 1, size(values%table%keys)
         key = trim(values%table%keys(k)%name)
         if (is_misplaced(alternatives, chosen, key, values)) call values%complain(problems, key, &
            key//' is a key of solver = '//names_reading(alternatives, key)//", not of '"// &
            values%text('solver')//"'"//methods(chosen)%method%advice(key))
      end do
      call leave_out_other_keys(alternatives, chosen, values)
      ! Without a surface the remaining checks would report problems that are not there.
      if (.not. allocated(surface)) return
      refusal = methods(chosen)%method%refusal(surface)
      if (refusal /= '') then
         call values%complain(problems, 'solver', "solver = '"//values%text('solver')//"' "//refusal//'. Give '// &
                              solvers_for(surface))
         return
      end if
      call methods(chosen)%method%set_defaults(values, surface)
      call methods(chosen)%method%check(values, surface, problems)
   end subroutine check_method_group

end module wavycon_method_group
