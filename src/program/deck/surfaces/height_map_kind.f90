!> kind = 'file': the surface is a height map, read from a file or given in memory.
module wavycon_height_map_kind
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_formula_kinds, only: radii_of
   use wavycon_grid_slab, only: grid_slab
   use wavycon_height_map, only: surface_of_map
   use wavycon_key_group, only: key_value
   use wavycon_kinds, only: dp, ieee_is_nan
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

   !> Reads the height map of a file, or of two, and makes the surface. Errors: exit_file_trouble if a file cannot be
   !> read. exit_bad_input if a file is not a map, if heights are missing and are not to be filled, if heights are out
   !> of range, if the unit is unknown, if deck and file both give the sides of the cell, as their units may differ, and
   !> if the two maps do not have the same points and sides.
   subroutine surface_of_file(values, surface, map, two_maps, error)
      type(surface_group), intent(inout) :: values     !! the values of &surface, without problems
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(map_statistics), allocatable, intent(out) :: two_maps(:)   !! of the first and second map; only for two files
      type(error_type), allocatable, intent(out) :: error

      type(measured_map) :: heights, second
      character(:), allocatable :: path, path2, unit

      unit = values%deck_unit
      call read_map(values, values%file%text, values%missing_value, unit, heights, path, error)
      if (.not. allocated(error)) then
         if (values%file2%is_given) then
            call read_map(values, values%file2%text, values%file2_missing_value, unit, second, path2, error)
            ! The scale of a map without a unit is none of a map whose file has units.
            if (.not. values%file2_scale%is_given .and. &
                (allocated(heights%length_unit) .neqv. allocated(second%length_unit))) &
               call values%file2_scale%set_default([1.0_dp])
            if (.not. allocated(error)) &
               call make_of_two(path, path2, values, heights, second, surface, map, two_maps, error)
         else
            call make_of(path, values, heights, surface, map, error)
         end if
      end if
      if (allocated(error)) then
         error%message = error%message//' (the height map of '//escaped(values%deck_path)//')'
         return
      end if
      map%path = full_path(path)
      map%scales_unit = values%height_scale%is_given .and. allocated(heights%length_unit)
      if (values%file2%is_given) then
         map%scales_unit = map%scales_unit .or. (values%file2_scale%is_given .and. allocated(second%length_unit))
         if (allocated(heights%length_unit) .and. .not. (allocated(second%length_unit) .or. &
                                                         values%file2_scale%is_given)) map%without_unit = path2
         if (allocated(second%length_unit) .and. .not. (allocated(heights%length_unit) .or. &
                                                        values%height_scale%is_given)) map%without_unit = path
      end if
      associate (own => values%file2_missing_value%is_given)
         map%lacks_missing_value = (own .and. .not. second%has_missing_value) .or. &
                                   (values%missing_value%is_given .and. &
                                    .not. (heights%has_missing_value .or. (second%has_missing_value .and. .not. own)))
      end associate
      if (unit /= '' .and. (allocated(heights%length_unit) .or. allocated(second%length_unit))) map%length_unit = unit
   end subroutine surface_of_file

   !> Reads the height map of a file, which is beside the deck or, if not, in the directory where the program was
   !> started. Errors: those of read_height_map and convert_lengths.
   subroutine read_map(values, file, missing, unit, heights, path, error)
      type(surface_group), intent(in) :: values            !! the values of &surface
      character(*), intent(in) :: file                     !! name of the file as the deck gives it
      type(key_value), intent(in) :: missing               !! the height that stands for a missing one, if in effect
      !> The deck's unit of lengths; empty if it is unknown. It is then the unit of the file on exit, if that names one.
      character(:), allocatable, intent(inout) :: unit
      type(measured_map), intent(out) :: heights
      character(:), allocatable, intent(out) :: path       !! where the file was found
      type(error_type), allocatable, intent(out) :: error

      real(dp), allocatable :: missing_value   ! if not allocated, the optional argument is absent

      path = file
      if (file(1:1) /= '/') path = values%deck_path(:index(values%deck_path, '/', back=.true.))//file
      if (path_kind(path) == path_absent) then
         if (path_kind(file) /= path_absent) path = file
      end if
      if (missing%in_effect) missing_value = missing%number
      ! To fill holes, to crop borders and to find spikes each rank needs the whole map; otherwise the map is read in
      ! slabs, one for each rank.
      call read_height_map(path, values%file_format%text, heights, error, missing_value, &
                           in_slabs=values%fill_missing%text == 'none' .and. .not. &
                                    (values%crop_missing%is_true .or. values%despike%is_true))
      if (.not. allocated(error)) call convert_lengths(path, unit, heights, error)
      if (path_kind(path) == path_absent .and. allocated(error) .and. file(1:1) /= '/') error%message = &
         escaped(file)//': there is no such file beside the deck, nor where the program was started'
      if (allocated(heights%length_unit)) unit = heights%length_unit
   end subroutine read_map

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
      if (values%file2%is_given) call fatal_error(error, exit_bad_input, 'file2 is not for heights in memory')
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
      real(dp) :: length(2)

      call take_sides(values, source, heights, length, assumed_sides, error)
      if (allocated(error)) return
      call surface_of_map(source, preparation_of(values), values%height_scale%number, length, heights, surface, map, &
                          error, radii_of(values%form_radius, values%form_radius_x, values%form_radius_y))
      if (allocated(error)) return
      map%has_sides = values%length_x%is_given .or. any(heights%step > 0.0_dp)
      map%assumed_sides = assumed_sides
   end subroutine make_of

   !> Prepares each of two maps as the keys say, turns the second one over, and makes the surface of the sum of their
   !> heights. Errors: those of `surface_of_file`.
   subroutine make_of_two(source, source2, values, first, second, surface, map, two_maps, error)
      character(*), intent(in) :: source, source2     !! names of the maps' files, for messages
      type(surface_group), intent(inout) :: values    !! the values of &surface
      type(measured_map), intent(inout) :: first      !! on exit the sum
      type(measured_map), intent(inout) :: second
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map, two_maps(:)
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: assumed_sides, unused
      type(map_preparation) :: preparation, preparation2, preparation_of_sum
      real(dp) :: sides(2, 2)
      integer :: points(2, 2)
      type(grid_slab) :: slab

      ! A map without sides has those of the other one.
      if (.not. values%length_x%is_given) then
         if (all(first%step <= 0.0_dp)) first%step = second%step
         if (all(second%step <= 0.0_dp)) second%step = first%step
      end if
      slab = first%columns()
      points(:, 1) = slab%points
      slab = second%columns()
      points(:, 2) = slab%points
      call take_sides(values, source, first, sides(:, 1), assumed_sides, error)
      if (.not. allocated(error)) call take_sides(values, source2, second, sides(:, 2), unused, error)
      if (allocated(error)) return
      ! Sides of files are rounded. Points of the two maps may be half a step apart, which is at the last of them.
      if (any(points(:, 1) /= points(:, 2)) .or. &
          any(2*points(:, 1)*abs(sides(:, 1) - sides(:, 2)) > sides(:, 1) .and. points(:, 1) > 1)) then
         call fatal_error(error, exit_bad_input, map_words(source, 1)//', and '//map_words(source2, 2)// &
                          ': two maps must have the same points and sides')
         return
      end if
      preparation = preparation_of(values)
      preparation2 = preparation
      preparation2%detrend = values%file2_detrend%text
      allocate (two_maps(2))
      call surface_of_map(source, preparation, values%height_scale%number, sides(:, 1), first, statistics=map, &
                          error=error)
      if (allocated(error)) return
      two_maps(1) = map
      call surface_of_map(source2, preparation2, values%file2_scale%number, sides(:, 1), second, statistics=map, &
                          error=error)
      if (allocated(error)) return
      two_maps(2) = map
      two_maps(2)%path = full_path(source2)
      if (values%file2_flip%is_true) second%height = second%height(size(second%height, 1):1:-1, :)
      first%height = first%height + second%height
      if (allocated(first%missing)) deallocate (first%missing)
      ! The sum of two tapered maps is tapered.
      if (preparation%edges /= 'window') preparation_of_sum%edges = preparation%edges
      call surface_of_map(source//' and '//source2, preparation_of_sum, 1.0_dp, sides(:, 1), first, &
                          surface, map, error, radii_of(values%form_radius, values%form_radius_x, values%form_radius_y))
      if (allocated(error)) return
      map%has_sides = values%length_x%is_given .or. any(first%step > 0.0_dp)
      map%assumed_sides = assumed_sides
      map%changes%map_preparation = preparation
      ! A remedy of the sum's borders is the trend of the map that still has one.
      if (all(preparation2%detrend /= ['plane    ', 'quadratic'])) map%changes%detrend = preparation2%detrend
      if (preparation%despike) map%spikes = 0

   contains

      !> The name of a map with its points and sides.
      function map_words(source, i) result(words)
         character(*), intent(in) :: source
         integer, intent(in) :: i   !! 1 or 2
         character(:), allocatable :: words

         words = escaped(source)//' has '//integer_text(points(1, i))
         if (points(2, i) == 1) words = words//' points and the length '//short_number(sides(1, i))
         if (points(2, i) > 1) words = words//' x '//integer_text(points(2, i))//' points and the sides '// &
                                       short_number(sides(1, i))//' x '//short_number(sides(2, i))
      end function map_words

   end subroutine make_of_two

   !> The preparation of a map that the keys ask for.
   pure type(map_preparation) function preparation_of(values) result(preparation)
      type(surface_group), intent(in) :: values    !! the values of &surface

      preparation = map_preparation(values%detrend%text, values%fill_missing%text, values%edges%text, &
                                    values%window_width%number, values%crop_missing%is_true, &
                                    values%despike%is_true)
      if (values%short_wavelength%is_given) preparation%short_wavelength = values%short_wavelength%number
      if (values%long_wavelength%is_given) preparation%long_wavelength = values%long_wavelength%number
      preparation%filter = values%filter%text
      preparation%may_crop = .not. values%file2%is_given
   end function preparation_of

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
