!> kind = 'file': a height map.
module wavycon_height_map_kind
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_formula_kinds, only: radii_of
   use wavycon_grid_slab, only: grid_slab
   use wavycon_group_values, only: group_values
   use wavycon_height_map, only: surface_of_map
   use wavycon_kinds, only: dp
   use wavycon_length_unit, only: convert_lengths
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics
   use wavycon_measured_map, only: check_map_size, check_room, laid_along_x, measured_map
   use wavycon_plain_text, only: clauses, escaped, integer_text, short_number
   use wavycon_prepare_map, only: map_preparation
   use wavycon_surface, only: surface_type
   use wavycon_system, only: full_path, path_absent, path_kind
   implicit none (type, external)
   private

   public :: surface_of_file, surface_of_heights

contains

   !> Reads the map. Errors: exit_file_trouble if the file cannot be read, exit_bad_input if it is not a map, its holes
   !> are not to be filled, its heights are out of range, its unit is unknown, or the deck gives sides of the cell
   !> beside those of the file, which may be in another unit.
   subroutine surface_of_file(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(measured_map) :: heights
      character(:), allocatable :: file, path
      real(dp), allocatable :: missing_value   ! not allocated: the argument is absent

      file = values%text('file')
      ! Beside the deck or, if it is not there, where the program was started.
      path = file
      if (file(1:1) /= '/') path = values%deck_path(:index(values%deck_path, '/', back=.true.))//file
      if (path_kind(path) == path_absent) then
         if (path_kind(file) /= path_absent) path = file
      end if
      if (values%has('missing_value')) missing_value = values%real('missing_value')
      ! Holes, their frame and spikes are found in the whole map.
      call read_height_map(path, values%text('file_format'), heights, error, missing_value, &
                           in_slabs=values%text('fill_missing') == 'none' .and. .not. &
                                    (values%logical('crop_missing') .or. values%logical('despike')))
      if (.not. allocated(error)) call convert_lengths(path, values%length_unit, heights, error)
      if (path_kind(path) == path_absent .and. file(1:1) /= '/') then
         if (allocated(error)) error%message = escaped(file)// &
            ': there is no such file beside the deck, nor where the program was started'
      end if
      if (.not. allocated(error)) call make_of(path, values, heights, surface, map, error)
      if (allocated(error)) then
         error%message = error%message//' (the height map of '//escaped(values%deck_path)//')'
         return
      end if
      map%path = full_path(path)
      map%lacks_missing_value = values%has('missing_value') .and. .not. heights%has_missing_value
      if (allocated(heights%length_unit)) map%length_unit = heights%length_unit
   end subroutine surface_of_file

   !> The surface of heights in memory in place of those of the file, whose name messages use. Errors: exit_bad_input
   !> for another kind of surface, for keys that only a file can have, and as of `surface_of_file`; exit_file_trouble
   !> without memory. One row or column is a profile.
   subroutine surface_of_heights(values, heights, surface, map, error)
      type(group_values), intent(inout) :: values     !! of &surface, as for `surface_of_file`
      real(dp), intent(in) :: heights(:, :)   !! upwards to the other body, NaN: missing; x first
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: of_files(*) = [character(13) :: 'missing_value', 'file_format']
      character(:), allocatable :: source
      integer :: i, points(2)
      type(measured_map) :: measured

      do i = 1, size(of_files)
         if (values%has(trim(of_files(i)))) &
            call fatal_error(error, exit_bad_input, trim(of_files(i))//' is not for heights in memory')
      end do
      if (values%text('kind') /= 'file') call fatal_error(error, exit_bad_input, &
         "heights in memory are for kind = 'file', not '"//values%text('kind')//"'")
      if (allocated(error)) return
      source = values%text('file')
      points = laid_along_x(shape(heights))
      call check_map_size(source, points, error)
      if (.not. allocated(error)) call check_room(source, points, error)
      if (allocated(error)) return
      measured%height = reshape(heights, points)
      if (any(ieee_is_nan(measured%height))) then
         measured%missing = ieee_is_nan(measured%height)
         where (measured%missing) measured%height = 0.0_dp
      end if
      call make_of(source, values, measured, surface, map, error)
   end subroutine surface_of_heights

   !> Makes the surface of heights, prepared as the keys say. Errors: as of `surface_of_file`.
   subroutine make_of(source, values, heights, surface, map, error)
      character(*), intent(in) :: source              !! of the heights, for messages
      type(group_values), intent(inout) :: values
      type(measured_map), intent(inout) :: heights
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: assumed_sides
      type(map_preparation) :: preparation
      real(dp) :: length(2)

      call take_sides(values, source, heights, length, assumed_sides, error)
      if (allocated(error)) return
      preparation = map_preparation(values%text('detrend'), values%text('fill_missing'), values%text('edges'), &
                                    values%real('window_width'), values%logical('crop_missing'), &
                                    values%logical('despike'))
      if (values%has('short_wavelength')) preparation%short_wavelength = values%real('short_wavelength')
      call surface_of_map(source, preparation, values%real('height_scale'), length, heights, surface, map, error, &
                          radii_of(values, 'form_radius'))
      if (.not. allocated(error)) map%assumed_sides = assumed_sides
   end subroutine make_of

   !> The sides of the cell: those of the file, those of the deck, or assumed ones. Errors: exit_bad_input if file and
   !> deck give one.
   subroutine take_sides(values, path, heights, length, assumed, error)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: path
      type(measured_map), intent(in) :: heights
      real(dp), intent(out) :: length(2)           !! L_x, L_y [length]; of a profile the second is not used
      character(:), allocatable, intent(out) :: assumed   !! the sides that neither gives, in words; empty if none
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: keys(2) = ['length_x', 'length_y']
      character(:), allocatable :: sides, unit
      integer :: d
      logical :: is_given(2)   ! by the deck
      type(grid_slab) :: slab

      assumed = ''
      unit = values%length_unit
      if (allocated(heights%length_unit)) unit = heights%length_unit
      if (unit /= '') unit = ' ['//escaped(unit)//']'
      is_given = [values%has(keys(1)), values%has(keys(2))]
      slab = heights%columns()
      associate (m => slab%points(1), n => slab%points(2), step => heights%step)
         if (step(1) > 0.0_dp .and. .not. (all(heights%is_usual_side) .and. any(is_given))) then
            length = step*[m, n]
            if (n == 1) length(2) = length(1)
            sides = short_number(length(1))
            if (n > 1) sides = sides//' x '//short_number(length(2))
            if (any(is_given .and. .not. heights%is_usual_side)) &
               call fatal_error(error, exit_bad_input, escaped(path)//': the file gives the sides of the cell, '// &
                                sides//unit//': leave out length_x and length_y')
            do d = 1, merge(1, 2, n == 1)
               if (is_given(d)) length(d) = values%real(keys(d))
               if (is_given(d)) cycle
               call values%leave_out(keys(d))
               if (heights%is_usual_side(d)) assumed = clauses(assumed, keys(d)//' = '//short_number(length(d))// &
                  unit//' is assumed: the file does not give it, and 1 is the default of .gsf files')
            end do
            if (n == 1) call values%leave_out('length_y')
            return
         end if
         length = values%real('length_x')
         if (.not. is_given(1)) assumed = 'length_x = '//short_number(length(1))//unit// &
                                          ' is assumed: neither the deck nor the file gives it'
         if (n > 1 .and. .not. is_given(2)) then
            length(2) = length(1)*n/m
            sides = 'length_y = length_x'
            if (m /= n) sides = sides//'*'//integer_text(n)//'/'//integer_text(m)
            assumed = clauses(assumed, sides//': the points are equally far apart along x and y')
         end if
         call values%set_default('length_y', length(2:))
         length(2) = values%real('length_y')
      end associate
   end subroutine take_sides

end module wavycon_height_map_kind
