!> kind = 'file': the surface is a height map, read from a file or given in memory.
module wavycon_height_map_kind
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_formula_kinds, only: radii_of
   use wavycon_grid_slab, only: grid_slab
   use wavycon_height_map, only: surface_of_map
   use wavycon_kinds, only: dp
   use wavycon_length_unit, only: convert_lengths
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics
   use wavycon_measured_map, only: check_map_size, check_room, laid_along_x, measured_map
   use wavycon_plain_text, only: clauses, escaped, integer_text, short_number
   use wavycon_prepare_map, only: map_preparation
   use wavycon_scene_groups, only: surface_group
   use wavycon_surface, only: surface_type
   use wavycon_system, only: full_path, path_absent, path_kind
   implicit none (type, external)
   private

   public :: surface_of_file, surface_of_heights

contains

   !> Reads the height map of a file and makes the surface. Errors: exit_file_trouble if the file cannot be read.
   !> exit_bad_input if the file is not a map, if heights are missing and are not to be filled, if heights are out of
   !> range, if the unit is unknown, or if deck and file both give the sides of the cell: their units may differ.
   subroutine surface_of_file(values, surface, map, error)
      type(surface_group), intent(inout) :: values     !! the values of &surface, without problems
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(measured_map) :: heights
      character(:), allocatable :: file, path
      real(dp), allocatable :: missing_value   ! if not allocated, the optional argument is absent

      file = values%file%text
      ! The file is beside the deck or, if not, in the directory where the program was started.
      path = file
      if (file(1:1) /= '/') path = values%deck_path(:index(values%deck_path, '/', back=.true.))//file
      if (path_kind(path) == path_absent) then
         if (path_kind(file) /= path_absent) path = file
      end if
      if (values%missing_value%is_given) missing_value = values%missing_value%number
      ! To fill holes, to crop borders and to find spikes each rank needs the whole map; otherwise the map is read in
      ! slabs, one for each rank.
      call read_height_map(path, values%file_format%text, heights, error, missing_value, &
                           in_slabs=values%fill_missing%text == 'none' .and. .not. &
                                    (values%crop_missing%is_true .or. values%despike%is_true))
      if (.not. allocated(error)) call convert_lengths(path, values%deck_unit, heights, error)
      if (path_kind(path) == path_absent .and. allocated(error) .and. file(1:1) /= '/') error%message = &
         escaped(file)//': there is no such file beside the deck, nor where the program was started'
      if (.not. allocated(error)) call make_of(path, values, heights, surface, map, error)
      if (allocated(error)) then
         error%message = error%message//' (the height map of '//escaped(values%deck_path)//')'
         return
      end if
      map%path = full_path(path)
      map%lacks_missing_value = values%missing_value%is_given .and. .not. heights%has_missing_value
      if (allocated(heights%length_unit)) map%length_unit = heights%length_unit
   end subroutine surface_of_file

   !> Makes the surface of heights in memory. They take the place of those of the key `file`, whose value serves as a
   !> name in messages. Errors: exit_bad_input for another kind of surface, for keys that only a file can have, and as
   !> in `surface_of_file`; exit_file_trouble if there is not enough memory.
   subroutine surface_of_heights(values, heights, surface, map, error)
      type(surface_group), intent(inout) :: values     !! the values of &surface, without problems
      !> Heights, upwards to the other body, NaN where a height is missing, shape (points along x, points along y). One
      !> row or one column is a profile.
      real(dp), intent(in) :: heights(:, :)
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: source
      integer :: points(2)
      type(measured_map) :: measured

      if (values%missing_value%is_given) &
         call fatal_error(error, exit_bad_input, 'missing_value is not for heights in memory')
      if (values%file_format%is_given) &
         call fatal_error(error, exit_bad_input, 'file_format is not for heights in memory')
      if (values%kind%text /= 'file') call fatal_error(error, exit_bad_input, &
         "heights in memory are for kind = 'file', not '"//values%kind%text//"'")
      if (allocated(error)) return
      source = values%file%text
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

   !> Prepares heights as the keys say, and makes the surface. Errors: those of `surface_of_file`.
   subroutine make_of(source, values, heights, surface, map, error)
      character(*), intent(in) :: source              !! name of the heights' file, for messages
      type(surface_group), intent(inout) :: values    !! the values of &surface
      type(measured_map), intent(inout) :: heights
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: assumed_sides
      type(map_preparation) :: preparation
      real(dp) :: length(2)

      call take_sides(values, source, heights, length, assumed_sides, error)
      if (allocated(error)) return
      preparation = map_preparation(values%detrend%text, values%fill_missing%text, values%edges%text, &
                                    values%window_width%number, values%crop_missing%is_true, &
                                    values%despike%is_true)
      if (values%short_wavelength%is_given) preparation%short_wavelength = values%short_wavelength%number
      call surface_of_map(source, preparation, values%height_scale%number, length, heights, surface, map, error, &
                          radii_of(values%form_radius, values%form_radius_x, values%form_radius_y))
      if (.not. allocated(error)) map%assumed_sides = assumed_sides
   end subroutine make_of

   !> Finds the sides of the cell: those of the file, or those of the deck, or assumed ones. A side for which the file
   !> has its format's default may be given by the deck. Errors: exit_bad_input if file and deck both give a side.
   subroutine take_sides(values, path, heights, length, assumed, error)
      type(surface_group), intent(inout) :: values   !! the values of &surface
      character(*), intent(in) :: path               !! name of the file, for messages
      type(measured_map), intent(in) :: heights      !! the map with the steps that its file gives
      real(dp), intent(out) :: length(2)             !! L_x, L_y [length]; of a profile the second is not used
      !> Words about sides that neither file nor deck gives; empty if there are none.
      character(:), allocatable, intent(out) :: assumed
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: names(2) = ['length_x', 'length_y']
      character(:), allocatable :: sides, unit
      integer :: d
      logical :: is_given(2)   ! whether the deck gives length_x, length_y
      type(grid_slab) :: slab

      assumed = ''
      unit = values%deck_unit
      if (allocated(heights%length_unit)) unit = heights%length_unit
      if (unit /= '') unit = ' ['//escaped(unit)//']'
      is_given = [values%length_x%is_given, values%length_y%is_given]
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
            do d = 1, min(n, 2)   ! a profile, n = 1, has one side
               if (is_given(d) .or. .not. heights%is_usual_side(d)) cycle
               assumed = clauses(assumed, names(d)//' = '//short_number(length(d))// &
                  unit//' is assumed: the file does not give it, and 1 is the default of .gsf files')
            end do
            if (is_given(1)) length(1) = values%length_x%number
            if (is_given(2) .and. n > 1) length(2) = values%length_y%number
            values%length_x%in_effect = is_given(1)
            values%length_y%in_effect = is_given(2) .and. n > 1
            return
         end if
         length = values%length_x%number
         if (.not. is_given(1)) assumed = 'length_x = '//short_number(length(1))//unit// &
                                          ' is assumed: neither the deck nor the file gives it'
         if (n > 1 .and. .not. is_given(2)) then
            length(2) = length(1)*n/m
            sides = 'length_y = length_x'
            if (m /= n) sides = sides//'*'//integer_text(n)//'/'//integer_text(m)
            assumed = clauses(assumed, sides//': the points are equally far apart along x and y')
         end if
         call values%length_y%set_default(length(2:))
         length(2) = values%length_y%number
      end associate
   end subroutine take_sides

end module wavycon_height_map_kind
