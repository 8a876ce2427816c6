!> The &surface group: the gap between the bodies. Its keys are those of the kinds of surface.
module wavycon_surface_group
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type, is_misplaced, leave_out_other_keys, merged_keys, &
      names_reading, report_missing_keys, selector_key
   use wavycon_key_table, only: key_group, key_group_type
   use wavycon_map_statistics, only: map_statistics
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_kinds, only: get_surface_kinds, keys_of_kinds, surface_kind_item
   implicit none (type, external)
   private

   public :: surface_table, check_surface_group, make_surface

contains

   !> The table of keys of &surface: `kind` and the keys of all kinds of surface.
   function surface_table() result(table)
      type(key_group_type) :: table

      type(surface_kind_item), allocatable :: kinds(:)
      type(alternative_type), allocatable :: alternatives(:)

      call get_surface_kinds(kinds)
      call keys_of_kinds(kinds, alternatives)
      table = key_group('surface', 'which waves or heights the bodies carry', &
                        [selector_key('kind', '', alternatives, required=.true.), merged_keys(alternatives)], &
                        required=.true.)
   end function surface_table

   !> Checks the keys against the kind and sets the defaults that depend on it.
   subroutine check_surface_group(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      type(surface_kind_item), allocatable :: kinds(:)
      type(alternative_type), allocatable :: alternatives(:)
      character(:), allocatable :: key
      integer :: chosen, k

      call get_surface_kinds(kinds)
      call keys_of_kinds(kinds, alternatives)
      chosen = findloc(alternatives%name == values%text('kind'), .true., dim=1)
      if (chosen == 0) return
      call report_missing_keys(alternatives(chosen), 'kind', values, problems)
      do k = 1, size(values%table%keys)
         key = trim(values%table%keys(k)%name)
         if (is_misplaced(alternatives, chosen, key, values)) call values%complain(problems, key, &
            key//' is a key of '//names_reading(alternatives, key)//", not of '"//values%text('kind')//"'"// &
            kinds(chosen)%kind%advice(key))
      end do
      call leave_out_other_keys(alternatives, chosen, values)
      call kinds(chosen)%kind%set_defaults(values)
      call kinds(chosen)%kind%check(values, problems)
   end subroutine check_surface_group

   !> Makes the surface. Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for a bad one.
   subroutine make_surface(values, surface, map, error)
      !> Without problems. Keys that have no effect beside what a file says are left out of the resolved deck.
      type(group_values), intent(inout) :: values
      type(surface_type), allocatable, intent(out) :: surface   !! not allocated in case of an error
      type(map_statistics), allocatable, intent(out) :: map     !! allocated for a height map
      type(error_type), allocatable, intent(out) :: error

      type(surface_kind_item), allocatable :: kinds(:)
      integer :: i

      call get_surface_kinds(kinds)
      do i = 1, size(kinds)
         if (kinds(i)%kind%name() /= values%text('kind')) cycle
         allocate (surface)
         call kinds(i)%kind%make(values, surface, map, error)
         if (allocated(error)) deallocate (surface)
         return
      end do
   end subroutine make_surface

end module wavycon_surface_group
