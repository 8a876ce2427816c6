!> The &surface group: the gap between the bodies. Its keys are those of the kinds of surface.
module wavycon_surface_group
   use wavycon_constants, only: largest_number, smallest_number
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_values, only: group_values
   use wavycon_height_map_kind, only: surface_of_heights
   use wavycon_key_relations, only: alternative_group, alternative_type, check_relations
   use wavycon_key_table, only: key_group_type
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: surface_kind
   use wavycon_surface_kinds, only: get_surface_kinds, kind_of, number_of_kinds
   implicit none (type, external)
   private

   public :: surface_table, check_surface_group, check_sides, make_surface

   !> Largest ratio of the sides of a cell. The iterations on a grid grow as the square root of the longer side over the
   !> shortest step. Up to this ratio waves, sums of waves and random maps of up to 128 x 128 points were all solved,
   !> with at most 1700 iterations a load; not all maps at ten times the ratio.
   real(dp), parameter :: largest_ratio = 1000.0_dp

contains

   !> The table of keys of &surface: `kind` and the keys of all kinds of surface.
   function surface_table() result(table)
      type(key_group_type) :: table

      type(alternative_type) :: alternatives(number_of_kinds)
      type(surface_kind) :: kinds(number_of_kinds)

      call get_surface_kinds(kinds)
      alternatives = kinds%alternative_type
      table = alternative_group('surface', 'which waves or heights the bodies carry', 'kind', '', alternatives, &
                                required=.true.)
   end function surface_table

   !> Checks the keys against the kind and sets the defaults that depend on it.
   subroutine check_surface_group(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      type(surface_kind) :: kind

      call check_relations(values, problems)
      kind = kind_of(values)
      if (associated(kind%check)) call kind%check(values, problems)
   end subroutine check_surface_group

   !> Reports a cell that is so long that loads would take too many iterations.
   subroutine check_sides(values, surface, problems)
      type(group_values), intent(in) :: values         !! with which the surface was made
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems

      character(12), parameter :: pairs(2, 3) = reshape([character(12) :: 'length_x', 'length_y', 'wavelength', &
         'wavelength_y', 'wavelength1', 'wavelength2'], [2, 3])
      character(:), allocatable :: key, keys
      real(dp) :: side(2)
      integer :: k

      if (surface%dimension == 1) return
      side = surface%sides()
      if (maxval(side) <= largest_ratio*minval(side)) return
      key = 'file'
      keys = 'the sides in '//escaped(values%text('file'))
      do k = 1, size(pairs, 2)
         if (.not. any([values%in_effect(trim(pairs(1, k))), values%in_effect(trim(pairs(2, k)))])) cycle
         key = trim(pairs(merge(2, 1, values%has(trim(pairs(2, k)))), k))
         keys = trim(pairs(1, k))//' and '//trim(pairs(2, k))
      end do
      call values%complain(problems, key, 'the cell is '//short_number(side(1))//' x '//short_number(side(2))// &
         ', one side '//short_number(maxval(side)/minval(side))//' times the other; at most '// &
         short_number(largest_ratio)//' times is allowed. Are '//keys//' in one unit?')
   end subroutine check_sides

   !> Makes the surface. Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for a bad one
   !> and for heights of a kind that has no file.
   subroutine make_surface(values, surface, map, error, heights)
      !> Without problems. Keys that have no effect beside what a file says are left out of the resolved deck.
      type(group_values), intent(inout) :: values
      type(surface_type), allocatable, intent(out) :: surface   !! not allocated in case of an error
      type(map_statistics), allocatable, intent(out) :: map     !! allocated for a height map
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: heights(:, :)   !! in place of those of the file, as of surface_of_heights

      type(surface_kind) :: kind

      kind = kind_of(values)
      if (kind%name == '') return
      allocate (surface)
      if (present(heights)) then
         call surface_of_heights(values, heights, surface, map, error)
      else
         call kind%make(values, surface, map, error)
      end if
      if (.not. allocated(error)) then
         if (surface%has_free_edges .and. surface%amplitude > 0.0_dp .and. &
             (surface%amplitude < smallest_number .or. surface%amplitude > largest_number)) &
            call fatal_error(error, exit_bad_input, escaped(values%deck_path)//': the mean gap before load is '// &
                             short_number(surface%amplitude)//' [length]: lengths may be from '// &
                             short_number(smallest_number)//' to '//short_number(largest_number))
      end if
      if (allocated(error)) deallocate (surface)
   end subroutine make_surface

end module wavycon_surface_group
