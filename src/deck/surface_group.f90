!> The &surface group: the gap between the bodies. Its keys are those of the kinds of surface.
module wavycon_surface_group
   use wavycon_ball_kind, only: ball_kind, ball_surface
   use wavycon_constants, only: largest_number, smallest_number
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_values, only: group_values
   use wavycon_height_map_kind, only: height_map_kind, surface_of_file, surface_of_heights
   use wavycon_key_relations, only: alternative_group, alternative_type, check_relations
   use wavycon_key_table, only: key_group_type
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_self_affine_kind, only: check_self_affine, self_affine_kind, self_affine_of
   use wavycon_surface, only: surface_type
   use wavycon_wave_kinds, only: check_sum, get_wave_kinds, number_of_wave_kinds, wave_surface
   implicit none (type, external)
   private

   public :: get_surface_kinds, surface_table, check_surface_group, check_sides, make_surface

   integer, parameter, public :: number_of_kinds = 8

   !> Largest ratio of the sides of a cell. The iterations on a grid grow as the square root of the longer side over the
   !> shortest step. Up to this ratio waves, sums of waves and random maps of up to 128 x 128 points were all solved,
   !> with at most 1700 iterations a load; not all maps at ten times the ratio.
   real(dp), parameter :: largest_ratio = 1000.0_dp

contains

   !> All kinds, in the order of the key reference. A key that two of them read must have the same type, unit and bounds
   !> in both; its meaning may differ.
   subroutine get_surface_kinds(kinds)
      type(alternative_type), intent(out) :: kinds(number_of_kinds)

      call get_wave_kinds(kinds(:number_of_wave_kinds))
      kinds(6) = height_map_kind()
      kinds(7) = self_affine_kind()
      kinds(8) = ball_kind()
   end subroutine get_surface_kinds

   !> The table of keys of &surface: `kind` and the keys of all kinds of surface.
   function surface_table() result(table)
      type(key_group_type) :: table

      type(alternative_type) :: kinds(number_of_kinds)

      call get_surface_kinds(kinds)
      table = alternative_group('surface', 'which waves or heights the bodies carry', 'kind', '', kinds, &
                                required=.true.)
   end function surface_table

   !> Checks the keys against the kind and sets the defaults that depend on it.
   subroutine check_surface_group(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(*), parameter :: radii(*) = [character(11) :: 'radius', 'form_radius']
      real(dp), parameter :: largest_ratio_of_radii = 1e4_dp
      character(:), allocatable :: x, y
      integer :: k

      call check_relations(values, problems)
      select case (values%text('kind'))
      case ('sum')
         call check_sum(values, problems)
      case ('self_affine')
         call check_self_affine(values, problems)
      case ('ball')
         if (values%has('length_y') .and. .not. values%has('length_x')) &
            call values%complain(problems, 'length_y', 'length_y needs length_x beside it')
      end select
      do k = 1, size(radii)
         x = trim(radii(k))//'_x'
         y = trim(radii(k))//'_y'
         associate (least => min(values%real(x), values%real(y)), most => max(values%real(x), values%real(y)))
            if (least > 0.0_dp .and. most > largest_ratio_of_radii*least) call values%complain(problems, x, &
               x//' and '//y//' must be within a factor of '//short_number(largest_ratio_of_radii)// &
               '; for a roller give a profile')
         end associate
      end do
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
      key = 'kind'
      keys = 'both sides'
      if (values%has('file')) then
         key = 'file'
         keys = 'the sides in '//escaped(values%text('file'))
      end if
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

      if (values%text('kind') == '') return
      allocate (surface)
      if (present(heights)) then
         call surface_of_heights(values, heights, surface, map, error)
      else
         select case (values%text('kind'))
         case ('file')
            call surface_of_file(values, surface, map, error)
         case ('self_affine')
            call self_affine_of(values, surface, map, error)
         case ('ball')
            surface = ball_surface(values)
         case default
            surface = wave_surface(values)
         end select
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
