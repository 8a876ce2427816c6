!> The &output group: which files are written, and where.
module wavycon_output_group
   use wavycon_cell_file, only: text_side
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_key_table, only: choice_value, integer_value, key_group_type, key_type, logical_value, text_value
   use wavycon_methods, only: points_of_grid, traits_of
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_table, only: table_type
   use wavycon_tables, only: all_tables
   implicit none (type, external)
   private

   public :: output_table, check_output_group, plain_directory

   !> Points of lines and maps along a side of the cell: as many as a height map may have.
   integer, parameter :: most_points = 8192
   !> Points of maps along a side of the cell where the deck, the surface and the method give none; fewest intervals of
   !> lines by default.
   integer, parameter :: usual_points = 128

   !> Bins of histograms: the table is a text.
   integer, parameter :: most_bins = 10000

   !> Bytes of a directory's name. The default, 'outputs/' and the name of the case, must fit.
   integer, parameter, public :: longest_directory = 250

contains

   !> The table of keys of &output: the directory, and a logical key for each table that can be requested.
   function output_table() result(table)
      type(key_group_type) :: table

      type(table_type), allocatable :: tables(:)
      type(key_type), allocatable :: rows(:)
      integer :: i

      call all_tables(tables)
      allocate (rows(0))
      do i = 1, size(tables)
         if (tables(i)%key == '' .or. tables(i)%group /= 'output') cycle
         rows = [rows, key_type(logical_value, trim(tables(i)%key), '.false.', '', trim(tables(i)%meaning))]
      end do
      table = key_group_type('output', 'which files are written, and where', [ &
         key_type(text_value, 'directory', "'outputs/<case>'", '', &
            'Where the results go, relative to where the program is started; made if it is not there.', &
            longest=longest_directory), rows, &
         key_type(integer_value, 'line_points', "128, or the grid's", '', &
            'intervals of the lines along a side of the cell; both ends are points. The default is the larger '// &
            'number of points of the grid, if it is given, or of the file, multiplied to be at least 128.', 8, &
            most_points), &
         key_type(integer_value, 'map_points', "128, or the grid's", '', &
            'points of the map along x and y; one number for both. The default is that of the grid, if it is '// &
            'given, or of the file. Where they are those of the grid that was solved the map shows its points, '// &
            'otherwise what lies between them.', 3, most_points, most_values=2), &
         key_type(choice_value, 'map_format', "'auto'", '', &
            "'text'; 'npy', a file of numpy, short and fast to read; 'auto', text up to "//integer_text(text_side)// &
            ' x '//integer_text(text_side)//' points, npy beyond.', choices='auto text npy'), &
         key_type(integer_value, 'histogram_bins', '100', '', &
            'bins of the histograms of pressure and of gap, of equal width.', 4, most_bins)])
   end function output_table

   !> Sets the directory and the points of lines and maps, and checks the tables against the solver and the surface.
   subroutine check_output_group(values, case, method, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: case     !! name of the case; the default directory is outputs/<case>
      type(group_values), intent(in) :: method   !! after its check
      type(surface_type), allocatable, intent(in) :: surface   !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      type(table_type), allocatable :: tables(:)
      character(:), allocatable :: key, refusal
      integer :: i

      call values%set_default('directory', text='outputs/'//case)
      call values%set('directory', text=plain_directory(values%text('directory')))
      if (.not. allocated(surface)) return
      if (.not. method%is_bad('grid_points')) call set_points(values, method, surface)
      if (method%is_bad('solver')) return
      call all_tables(tables)
      do i = 1, size(tables)
         key = trim(tables(i)%key)
         if (key == '' .or. tables(i)%group /= 'output') cycle
         if (.not. values%logical(key)) cycle
         refusal = tables(i)%refusal(traits_of(method%text('solver')), surface)
         if (refusal /= '') call values%complain(problems, key, key//' cannot be written: '//refusal)
      end do
   end subroutine check_output_group

   !> Sets the points of maps in full and those of lines: as given or, by default, from those of the grid to solve or,
   !> if the deck gives none, of the height map, on the part of the cell that decks refer to.
   subroutine set_points(values, method, surface)
      type(group_values), intent(inout) :: values
      type(group_values), intent(in) :: method   !! &method, after its check
      type(surface_type), intent(in) :: surface

      integer :: finest, grid(2)
      real(dp) :: points(2)

      grid = points_of_grid(method, surface)
      if (all(grid == 0)) grid = surface%points
      grid = grid/surface%parts()
      ! A multiple of the grid's points: lines on a square height map pass through its points and do not cut peaks.
      finest = max(1, maxval(grid))
      call values%set_default('line_points', [real(finest*((max(usual_points, finest) + finest - 1)/finest), dp)])
      if (values%is_bad('map_points')) return
      points = real(grid, dp)
      if (all(grid == 0)) points = real(usual_points, dp)
      if (values%has('map_points')) points = values%pair('map_points')
      call values%set('map_points', points(:surface%dimension))
   end subroutine set_points

   !> The path of a directory without superfluous './' and '/', so that equal paths are equal texts.
   pure function plain_directory(name) result(plain)
      character(*), intent(in) :: name
      character(:), allocatable :: plain

      character(*), parameter :: superfluous(*) = ['// ', '/./']   ! each is a '/'
      integer :: i, k

      plain = trim(name)//'/'
      do k = 1, size(superfluous)
         do
            i = index(plain, trim(superfluous(k)))
            if (i == 0) exit
            plain = plain(:i)//plain(i + len_trim(superfluous(k)):)
         end do
      end do
      if (index(plain, './') == 1) plain = plain(3:)
      if (plain == '') plain = './'
      if (len(plain) > 1) plain = plain(:len(plain) - 1)
   end function plain_directory

end module wavycon_output_group
