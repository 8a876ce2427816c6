!> The &output group: which files are written, and where.
module wavycon_output_group
   use wavycon_cell_file, only: text_side
   use wavycon_key_group, only: key_list
   use wavycon_kinds, only: dp
   use wavycon_key_table, only: choice_value, integer_value, key_type, logical_value, text_value
   use wavycon_methods, only: points_of_grid, traits_of
   use wavycon_plain_text, only: integer_text
   use wavycon_scene_groups, only: method_group, output_group
   use wavycon_surface, only: surface_type
   use wavycon_table, only: table_type
   use wavycon_tables, only: all_tables
   implicit none (type, external)
   private

   public :: check_output_group, list_output_keys

   !> Most points of lines and maps along a side of the cell.
   integer, parameter :: most_points = 8192
   !> Points of maps along a side of the cell if neither deck nor surface nor method give a number; by default lines
   !> have at least as many intervals.
   integer, parameter :: usual_points = 128

   !> Most bins of histograms, whose table is a text.
   integer, parameter :: most_bins = 10000

   !> Most bytes of a directory's name. The default, 'outputs/' and the name of the case, must fit.
   integer, parameter, public :: longest_directory = 250

contains

   !> The keys of &output: the directory, and a logical key for each table that can be requested.
   subroutine list_output_keys(values, keys)
      type(output_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      type(table_type), allocatable :: tables(:)
      integer :: i

      keys = key_list('output', 'which files are written, and where', values%key_group)
      call keys%add(values%directory, key_type(text_value, 'directory', "'outputs/<case>'", '', &
         'Where the results go, relative to where the program is started; made if it is not there.', &
         longest=longest_directory))
      call all_tables(tables)
      do i = 1, size(tables)
         if (tables(i)%key == '' .or. tables(i)%group /= 'output') cycle
         call keys%add(values%tables(i), key_type(logical_value, tables(i)%key, '.false.', '', tables(i)%meaning))
      end do
      call keys%add(values%csv, key_type(logical_value, 'csv', '.false.', '', &
         'whether each table is also written as <case>.<table>.csv, with commas and one line of names and units, '// &
         "for spreadsheets. Maps and planes in numpy's format are not: map_format = 'text' makes them texts."))
      call keys%add(values%line_points, key_type(integer_value, 'line_points', "128, or the grid's", '', &
         'intervals of the lines along a side of the cell; both ends are points. The default is the larger number '// &
         'of points of the grid, if it is given, or of the file, multiplied to be at least 128.', 8, most_points))
      call keys%add(values%map_points, key_type(integer_value, 'map_points', "128, or the grid's", '', &
         'points of the map along x and y; one number for both. The default is that of the grid, if it is given, '// &
         'or of the file. Where they are those of the grid that was solved the map shows its points, otherwise '// &
         'what lies between them.', 3, most_points, most_values=2))
      call keys%add(values%map_format, key_type(choice_value, 'map_format', "'auto'", '', &
         "'text'; 'npy', a file of numpy, short and fast to read; 'auto', text up to "//integer_text(text_side)// &
         ' x '//integer_text(text_side)//' points, npy beyond.', choices='auto text npy'))
      call keys%add(values%histogram_bins, key_type(integer_value, 'histogram_bins', '100', '', &
         'bins of the histograms of pressure and of gap, of equal width.', 4, most_bins))
   end subroutine list_output_keys

   !> Sets the directory and the points of lines and maps. Tables that the solver or the surface cannot have are
   !> reported.
   subroutine check_output_group(values, case_name, method, surface)
      type(output_group), intent(inout) :: values
      character(*), intent(in) :: case_name     !! the default directory is outputs/<case>
      type(method_group), intent(in) :: method   !! the values of &method after check_method_group
      type(surface_type), allocatable, intent(in) :: surface   !! not allocated if it could not be made

      type(table_type), allocatable :: tables(:)
      character(:), allocatable :: directory, refusal
      integer :: i

      call values%directory%set_default(text='outputs/'//case_name)
      ! A '/' follows the directory in the names of files.
      directory = values%directory%text
      call values%directory%set(text=directory(:max(1, verify(directory, '/', back=.true.))))
      if (.not. allocated(surface)) return
      if (.not. method%grid_points%is_bad) call set_points(values, method, surface)
      if (method%solver%is_bad .or. .not. any(values%tables%is_true)) return
      call all_tables(tables)
      do i = 1, size(tables)
         if (.not. values%tables(i)%is_true) cycle
         refusal = tables(i)%refusal(traits_of(method%solver%text), surface)
         if (refusal /= '') call values%complain(values%tables(i), trim(tables(i)%key)//' cannot be written: '//refusal)
      end do
   end subroutine check_output_group

   !> Sets the numbers of points of maps along x and y, and the intervals of lines. Defaults follow from the grid that
   !> the deck gives or, without one, from the height map. On a mirrored surface they count the map without its mirror
   !> images, not the cell.
   subroutine set_points(values, method, surface)
      type(output_group), intent(inout) :: values
      type(method_group), intent(in) :: method   !! the values of &method after check_method_group
      type(surface_type), intent(in) :: surface

      integer :: finest, grid(2)
      real(dp) :: points(2)

      grid = points_of_grid(method, surface)
      if (all(grid == 0)) grid = surface%points
      grid = grid/surface%maps_in_cell()
      ! Lines take a multiple of the grid's points: on a square height map they then pass through the map's points and
      ! do not miss peaks.
      finest = max(1, maxval(grid))
      call values%line_points%set_default([real(finest*((max(usual_points, finest) + finest - 1)/finest), dp)])
      if (values%map_points%is_bad) return
      points = real(grid, dp)
      if (all(grid == 0)) points = real(usual_points, dp)
      if (values%map_points%is_given) points = values%map_points%pair
      call values%map_points%set(points(:surface%dimension))
   end subroutine set_points

end module wavycon_output_group
