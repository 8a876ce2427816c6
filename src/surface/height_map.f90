!> A height map from a file.
module wavycon_height_map
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, key_type, largest_number, real_key, smallest_number, text_key
   use wavycon_kinds, only: dp
   use wavycon_length_unit, only: convert_lengths
   use wavycon_map_changes, only: clauses, map_changes
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_map_tuning, only: usual_window_width
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_prepare_map, only: map_preparation, prepare_map
   use wavycon_ranks, only: share_error
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_surface_keys, only: length_x_key, length_y_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_system, only: full_path, path_absent, path_kind
   implicit none (type, external)
   private

   public :: height_map_kind, surface_of_map

   type, extends(surface_kind) :: height_map_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: check
      procedure, nopass :: make
   end type height_map_kind

   integer, parameter :: longest_path = 1000

contains

   function name() result(words)
      character(:), allocatable :: words

      words = 'file'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'a height map'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
         length_x_key(), &
         length_y_key('side of the periodic cell along y; without it points are equally far apart along x and y.'), &
         text_key('file', '', &
            'a periodic map of heights, upwards to the other body; looked for beside the deck, then where the '// &
            "program is started. The last row and column are the cell's last, not copies of the first.", &
            longest_path, required=.true.), &
         choice_key('file_format', "'auto'", &
            "'matrix', a row of heights for each y; 'xyz', lines of x, y, z on a regular grid; 'xz', lines of x "// &
            "and z of a profile; 'npy' of numpy; 'gsf' of Gwyddion; 'gnuplot', its binary matrix; 'auto', what the file "// &
            'looks like, xyz if all lines have three numbers, xz if all have two. xyz, xz and gnuplot give the '// &
            'sides of the cell, gsf and heads of texts also units: leave out length_x and length_y.', &
            [character(7) :: 'auto', 'matrix', 'xyz', 'xz', 'npy', 'gsf', 'gnuplot']), &
         real_key('missing_value', '', '-', 'heights of the file that have this value are missing, as are nan and '// &
            'empty fields between commas, semicolons or tabs.'), &
         real_key('height_scale', '1.0', 'length', "length of one unit of the file's heights; beside a file with "// &
            'units a factor.', above=0.0_dp), &
         choice_key('detrend', "'none'", &
            "what is subtracted first, fitted to the heights that are there by least squares: 'mean', 'plane' or "// &
            "'quadratic', a polynomial of the second degree.", &
            [character(9) :: 'none', 'mean', 'plane', 'quadratic']), &
         choice_key('fill_missing', "'none'", &
            "heights that are missing: 'none', they are an error; 'harmonic', filled after `detrend` by the "// &
            "smooth surface of Laplace's equation.", [character(8) :: 'none', 'harmonic']), &
         choice_key('edges', "'periodic'", &
            "how the map continues beyond its borders: 'periodic', its last points are neighbours of its first; "// &
            "'mirror', by its mirror images; 'window', periodic after a taper to the mean at the borders.", &
            [character(8) :: 'periodic', 'mirror', 'window']), &
         real_key('window_width', short_number(usual_window_width), '-', &
            "with edges = 'window': width of the taper at each border, over the side.", above=0.0_dp, most=0.5_dp)]
   end function keys

   subroutine check(values, problems)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems

      if (values%has('window_width') .and. values%text('edges') /= 'window') &
         call values%complain(problems, 'window_width', "window_width is for edges = 'window'")
   end subroutine check

   !> Reads the map. Errors: exit_file_trouble if the file cannot be read, exit_bad_input if it is not a map, its holes
   !> are not to be filled, its heights are out of range, its unit is unknown, or the deck gives sides of the cell beside
   !> those of the file, which may be in another unit.
   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(measured_map) :: heights
      character(:), allocatable :: assumed_sides, file, path
      real(dp) :: length(2)

      file = values%text('file')
      path = place_of_map(values%deck_path, file)
      if (path_kind(path) == path_absent .and. file(1:1) /= '/') then
         call fatal_error(error, exit_file_trouble, escaped(file)// &
                          ': there is no such file beside the deck, nor where the program was started')
      end if
      call share_error(error)
      if (.not. allocated(error)) call read_map(values, path, heights, error)
      call share_error(error)
      if (.not. allocated(error)) call take_sides(values, path, heights, length, assumed_sides, error)
      if (.not. allocated(error)) call surface_of_map(path, values, length, heights, surface, map, error)
      if (allocated(error)) then
         error%message = error%message//' (the height map of '//escaped(values%deck_path)//')'
         return
      end if
      map%path = full_path(path)
      map%assumed_sides = assumed_sides
      map%lacks_missing_value = values%has('missing_value') .and. .not. heights%has_missing_value
      if (allocated(heights%length_unit)) map%length_unit = heights%length_unit
   end subroutine make

   !> Reads the map and converts its lengths to the deck's unit. Errors: as of `make`.
   subroutine read_map(values, path, heights, error)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: path
      type(measured_map), intent(out) :: heights
      type(error_type), allocatable, intent(out) :: error

      logical :: in_slabs

      ! The equations of holes need the whole map.
      in_slabs = values%text('fill_missing') == 'none'
      if (values%has('missing_value')) then
         call read_height_map(path, values%text('file_format'), heights, error, values%real('missing_value'), &
                              in_slabs=in_slabs)
      else
         call read_height_map(path, values%text('file_format'), heights, error, in_slabs=in_slabs)
      end if
      if (allocated(error)) return
      if (allocated(values%length_unit)) then
         call convert_lengths(path, values%length_unit, heights, error)
      else
         call convert_lengths(path, '', heights, error)
      end if
   end subroutine read_map

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
      integer :: d, points(2)
      logical :: is_given(2)   ! by the deck

      assumed = ''
      unit = ''
      if (allocated(values%length_unit)) unit = ' ['//escaped(values%length_unit)//']'
      if (allocated(heights%length_unit)) unit = ' ['//escaped(heights%length_unit)//']'
      is_given = [values%has(keys(1)), values%has(keys(2))]
      points = heights%points()
      associate (m => points(1), n => points(2), step => heights%step)
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
         call values%set_default('length_y', length(2))
         length(2) = values%real('length_y')
      end associate
   end subroutine take_sides

   !> Makes the surface of a map as the keys of this kind say, but `file` and `file_format`. Errors: exit_bad_input for
   !> heights that are not finite or out of range, for missing ones that are not to be filled, and for too few to
   !> determine a trend; exit_file_trouble without memory.
   subroutine surface_of_map(source, values, sides, map, surface, statistics, error)
      character(*), intent(in) :: source            !! of the heights, for messages
      type(group_values), intent(inout) :: values   !! as of `make`
      real(dp), intent(in) :: sides(2)              !! of the map along x and y [length], > 0
      !> Heights upwards to the other body; then those of the surface over their mean [length], without holes.
      type(measured_map), intent(inout) :: map
      type(surface_type), intent(inout) :: surface
      type(map_statistics), allocatable, intent(out) :: statistics   !! without the path
      type(error_type), allocatable, intent(out) :: error

      type(grid_slab) :: slab
      type(map_changes) :: changes
      real(dp) :: largest(1)

      if (.not. all(ieee_is_finite(map%height))) &
         call fatal_error(error, exit_bad_input, escaped(source)//': not all heights are finite numbers')
      call share_error(error)
      if (allocated(error)) return
      associate (scale => values%real('height_scale'))
         ! Larger heights, which scale_heights refuses, would overflow here.
         slab = map%columns()
         largest = maxval(abs(map%height))
         call slab%largest(largest)
         if (largest(1) <= largest_number) then
            call prepare_map(source, map_preparation(values%text('detrend'), values%text('fill_missing'), &
                                                     values%text('edges'), values%real('window_width')), &
                             sides, map, changes, error)
            call share_error(error)
            if (allocated(error)) return
         end if
         if (changes%edges /= 'window') call values%leave_out('window_width')
         call map%keep_own_columns()
         slab = map%columns()
         call scale_heights(source, scale, slab, map%height, error)
         if (allocated(error)) return
         changes%rise = scale*changes%rise
      end associate
      statistics = statistics_of(map%height, map%format, '', map%points())
      surface = surface_of_points(sides, map%height, changes%edges == 'mirror', map%points())
      statistics%changes = changes
   end subroutine surface_of_map

   !> Subtracts the mean of the heights and converts them to lengths. Errors: exit_bad_input if they are out of range.
   subroutine scale_heights(source, scale, slab, height, error)
      character(*), intent(in) :: source           !! of the heights, for messages
      real(dp), intent(in) :: scale                !! length of one unit of the heights, > 0
      type(grid_slab), intent(in) :: slab          !! their columns
      real(dp), intent(inout) :: height(:, :)      !! then over their mean [length]
      type(error_type), allocatable, intent(out) :: error

      real(dp) :: extremes(2), largest(1), mean(1)

      extremes = [maxval(height), -minval(height)]
      call slab%largest(extremes)
      if (maxval(abs(extremes)) <= largest_number) then
         if (sum(extremes) <= 0.0_dp) then
            ! Equal heights less their rounded mean would not be zero.
            height = 0.0_dp
         else
            mean = slab%column_totals(reshape(sum(height, dim=1), [1, size(height, 2)]))/product(real(slab%points, dp))
            height = scale*(height - mean(1))
         end if
      end if
      largest = maxval(abs(height))
      call slab%largest(largest)
      if (largest(1) > largest_number .or. (largest(1) < smallest_number .and. largest(1) > 0.0_dp)) &
         call fatal_error(error, exit_bad_input, escaped(source)//': the heights over their mean, times '// &
                          'height_scale, are up to '//short_number(largest(1))//' [length]: lengths may be '// &
                          'from '//short_number(smallest_number)//' to '//short_number(largest_number))
   end subroutine scale_heights

   !> The path of the map: in the directory of the deck or, if it is not there, in the one the program was started in.
   function place_of_map(deck_path, file) result(path)
      character(*), intent(in) :: deck_path, file
      character(:), allocatable :: path

      path = deck_path(:index(deck_path, '/', back=.true.))//file
      if (file(1:1) == '/') path = file
      if (path_kind(path) /= path_absent) return
      if (path_kind(file) /= path_absent) path = file
   end function place_of_map

end module wavycon_height_map
