!> A height map from a file.
module wavycon_height_map
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, key_type, largest_number, real_key, smallest_number, text_key
   use wavycon_kinds, only: dp
   use wavycon_length_unit, only: convert_lengths
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_surface_keys, only: length_x_key, length_y_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_system, only: full_path, path_absent, path_kind
   implicit none (type, external)
   private

   public :: height_map_kind, surface_of_heights

   type, extends(surface_kind) :: height_map_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
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
            "'matrix', a row of heights for each y; 'xyz', lines of x, y, z on a regular grid; 'npy' of numpy; "// &
            "'gsf' of Gwyddion; 'gnuplot', its binary matrix; 'auto', what the file looks like, xyz if "// &
            'all lines have three numbers. xyz and gnuplot give the sides of the cell, gsf also units: leave out '// &
            'length_x and length_y.', &
            [character(7) :: 'auto', 'matrix', 'xyz', 'npy', 'gsf', 'gnuplot']), &
         real_key('missing_value', '', '-', 'heights of the file that have this value are missing, as are nan and '// &
            'empty fields between commas, semicolons or tabs.'), &
         real_key('height_scale', '1.0', 'length', "length of one unit of the file's heights; beside a file with "// &
            'units a factor.', above=0.0_dp)]
   end function keys

   !> Reads the map. Errors: exit_file_trouble if the file cannot be read, exit_bad_input if it is not a map or has
   !> holes, its heights are out of range, its unit is unknown, or the deck gives sides of the cell beside those of the
   !> file, which may be in another unit.
   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(measured_map) :: heights
      character(:), allocatable :: path
      real(dp) :: length(2)
      logical :: is_equal_spacing

      path = place_of_map(values%deck_path, values%text('file'))
      call read_map(values, path, heights, error)
      if (.not. allocated(error)) call take_sides(values, path, heights, length, is_equal_spacing, error)
      if (.not. allocated(error)) call refuse_holes(path, heights, error)
      if (.not. allocated(error)) &
         call surface_of_heights(path, length, values%real('height_scale'), heights%height, surface, error)
      if (allocated(error)) then
         error%message = error%message//' (the height map of '//escaped(values%deck_path)//')'
         return
      end if
      map = statistics_of(heights%height, heights%format, full_path(path))
      map%is_equal_spacing = is_equal_spacing
      if (allocated(heights%length_unit)) map%length_unit = heights%length_unit
   end subroutine make

   !> Reads the map and converts its lengths to the deck's unit. Errors: as of `make`.
   subroutine read_map(values, path, heights, error)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: path
      type(measured_map), intent(out) :: heights
      type(error_type), allocatable, intent(out) :: error

      if (values%has('missing_value')) then
         call read_height_map(path, values%text('file_format'), heights, error, values%real('missing_value'))
      else
         call read_height_map(path, values%text('file_format'), heights, error)
      end if
      if (allocated(error)) return
      if (allocated(values%length_unit)) then
         call convert_lengths(path, values%length_unit, heights, error)
      else
         call convert_lengths(path, '', heights, error)
      end if
   end subroutine read_map

   !> The sides of the cell: those of the file, or those of the deck. Errors: exit_bad_input if both give them.
   subroutine take_sides(values, path, heights, length, is_equal_spacing, error)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: path
      type(measured_map), intent(in) :: heights
      real(dp), intent(out) :: length(2)           !! L_x, L_y [length]; of a profile the second is not used
      logical, intent(out) :: is_equal_spacing     !! whether L_y follows from equal steps along x and y
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: sides

      is_equal_spacing = .false.
      associate (m => size(heights%height, 1), n => size(heights%height, 2), step => heights%step)
         if (step(1) > 0.0_dp) then
            length = step*[m, n]
            if (n == 1) length(2) = length(1)
            sides = short_number(length(1))
            if (n > 1) sides = sides//' x '//short_number(length(2))
            if (allocated(heights%length_unit)) sides = sides//' ['//escaped(heights%length_unit)//']'
            if (values%has('length_x') .or. values%has('length_y')) &
               call fatal_error(error, exit_bad_input, escaped(path)//': the file gives the sides of the cell, '// &
                                sides//': leave out length_x and length_y')
            call values%leave_out('length_x')
            call values%leave_out('length_y')
            return
         end if
         length = values%real('length_x')
         is_equal_spacing = n > 1 .and. m /= n .and. .not. values%has('length_y')
         if (is_equal_spacing) length(2) = length(1)*n/m
         call values%set_default('length_y', length(2))
         length(2) = values%real('length_y')
      end associate
   end subroutine take_sides

   !> Refuses a map with missing heights. Errors: exit_bad_input.
   subroutine refuse_holes(path, heights, error)
      character(*), intent(in) :: path
      type(measured_map), intent(in) :: heights
      type(error_type), allocatable, intent(out) :: error

      integer :: first(2)

      if (.not. allocated(heights%missing)) return
      first = findloc(heights%missing, .true.)
      call fatal_error(error, exit_bad_input, escaped(path)//': '//integer_text(count(heights%missing))//' of '// &
                       integer_text(size(heights%missing))//' heights are missing, the first in row '// &
                       integer_text(first(2))//', column '//integer_text(first(1))// &
                       ": fill_missing = 'harmonic' fills them")
   end subroutine refuse_holes

   !> Makes the surface of heights in memory. Errors: exit_bad_input for heights that are not finite or out of range.
   subroutine surface_of_heights(source, length, scale, height, surface, error)
      character(*), intent(in) :: source                    !! of the heights, for messages
      real(dp), intent(in) :: length(2)                     !! L_x, L_y [length], > 0
      real(dp), intent(in) :: scale                         !! length of one unit of the heights, > 0
      !> Upwards to the other body, shape (M, N), N = 1 for a profile; becomes the heights over their mean [length].
      real(dp), intent(inout), contiguous :: height(:, :)
      type(surface_type), intent(inout) :: surface
      type(error_type), allocatable, intent(out) :: error

      if (.not. all(ieee_is_finite(height))) then
         call fatal_error(error, exit_bad_input, escaped(source)//': not all heights are finite numbers')
         return
      end if
      if (maxval(abs(height)) <= largest_number) then
         if (maxval(height) <= minval(height)) then
            ! Equal heights less their rounded mean would not be zero.
            height = 0.0_dp
         else
            height = scale*(height - sum(height)/size(height))
         end if
      end if
      associate (largest => maxval(abs(height)))
         if (largest > largest_number .or. (largest < smallest_number .and. largest > 0.0_dp)) then
            call fatal_error(error, exit_bad_input, escaped(source)//': the heights over their mean, times '// &
                             'height_scale, are up to '//short_number(largest)//' [length]: lengths may be '// &
                             'from '//short_number(smallest_number)//' to '//short_number(largest_number))
            return
         end if
      end associate
      surface = surface_of_points(length, height)
   end subroutine surface_of_heights

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
