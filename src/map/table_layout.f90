!> What the columns and rows of a text are, where neither the deck nor the file says it.
module wavycon_table_layout
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_number_table, only: number_table
   use wavycon_plain_text, only: integer_text
   use wavycon_point_map, only: rises_evenly, take_points
   implicit none (type, external)
   private

   public :: find_layout

   !> So many heights in equal steps, without a slope that goes on beside them, are no chance: they are coordinates. Of
   !> independent heights 1e-6 of the rows of five are so.
   integer, parameter :: least_values = 5
   !> The same of both axes of a table together, and of each.
   integer, parameter :: least_of_both = 7, least_of_each = 3
   !> Points may have other values behind their heights; with more columns they are a matrix.
   integer, parameter :: most_columns = 8

contains

   !> Finds the format of a text. Numbers of the lines before two or three columns of points are left out. Coordinates
   !> in the first row and column of a matrix are taken out of it and give its steps. Errors: exit_bad_input for a first
   !> row or column alone that are no heights, and for points with other values beside them.
   subroutine find_layout(table, map, error)
      type(number_table), intent(inout) :: table   !! then without what is no height and no coordinate of points
      type(measured_map), intent(inout) :: map     !! then with its format and perhaps its steps
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: advice = "leave out what is no height, or give file_format = 'matrix' if all are"
      integer :: columns, i, rows
      logical :: is_axis(2)   ! the first column, the first row
      real(dp), allocatable :: values(:, :)

      columns = size(table%values, 1)
      rows = size(table%values, 2)
      if (columns == 3 .or. columns == 4) then
         ! Points whose x is the number of their line are no grid.
         associate (v => table%values)
            if (rows > 3 .and. all(abs(v(1, :) - v(1, 1) - [(i, i=0, rows - 1)]) <= 0.0_dp) .and. &
                merge(all((v(2, 2:) - v(2, :rows - 1))*(v(2, rows) - v(2, 1)) > 0.0_dp), &
                      .not. rises_evenly(v(columns, :)), columns == 3)) then
               values = v(2:, :)
               columns = columns - 1
            end if
         end associate
         if (allocated(values)) call move_alloc(values, table%values)
      end if
      map%format = 'matrix'
      if (columns == 3 .and. rows > 3) map%format = 'xyz'
      if (columns == 2 .and. rows > 2) map%format = 'xz'
      if (columns < 4 .or. rows < 4) return
      associate (v => table%values)
         is_axis = [are_coordinates(v(1, 2:), v(2, 2:)), are_coordinates(v(2:, 1), v(2:, 2))]
         if (all(is_axis) .and. (columns + rows - 2 >= least_of_both .or. ieee_is_nan(v(1, 1)))) then
            map%step = abs([v(columns, 1) - v(2, 1), v(1, rows) - v(1, 2)])/[columns - 2, rows - 2]
            ! x and y of the map rise.
            values = v(merge([(i, i=2, columns)], [(i, i=columns, 2, -1)], v(columns, 1) > v(2, 1)), &
                       merge([(i, i=2, rows)], [(i, i=rows, 2, -1)], v(1, rows) > v(1, 2)))
         else if (is_axis(1) .and. rows > least_values) then
            call table%refuse(1, 'the first column rises in equal steps, as coordinates or numbers of lines do: '// &
                              advice, error)
         else if (is_axis(2) .and. columns > least_values) then
            call table%refuse(1, 'the numbers of the first row rise in equal steps, as coordinates or numbers of '// &
                              'columns do: '//advice, error)
         else if (columns <= most_columns) then
            do i = 1, 2
               if (.not. is_grid(table, i)) cycle
               call table%refuse(1, 'columns '//integer_text(i)//' and '//integer_text(i + 1)//' are x and y of a '// &
                                 'grid: leave out all but x, y and z, or give '// &
                                 "file_format = 'matrix' if all are heights", error)
               exit
            end do
         end if
      end associate
      if (allocated(values)) call move_alloc(values, table%values)
   end subroutine find_layout

   !> Whether a row or column has equal steps, and the next one does not go on with their slope, as on a tilted plane.
   pure logical function are_coordinates(values, next)
      real(dp), intent(in) :: values(:)
      real(dp), intent(in) :: next(:)   !! as many

      real(dp) :: from_mean(size(values)), squares
      logical :: is_there(size(values))

      are_coordinates = rises_evenly(values)
      is_there = .not. ieee_is_nan(next)
      if (.not. are_coordinates .or. .not. any(is_there)) return
      from_mean = values - sum(values, mask=is_there)/count(is_there)
      squares = sum(from_mean**2, mask=is_there)
      ! By least squares the slope of the next is below a half, or above two, of that of the values.
      are_coordinates = abs(2*sum(from_mean*next, mask=is_there) - 2.5_dp*squares) > 1.5_dp*squares
   end function are_coordinates

   !> Whether two columns are x and y of a grid, of which at least half is there.
   logical function is_grid(table, first)
      type(number_table), intent(in) :: table
      integer, intent(in) :: first   !! number of the column of x

      integer, parameter :: least_points = 9
      type(error_type), allocatable :: trouble
      type(measured_map) :: map
      type(number_table) :: points

      points = table
      points%values = table%values([first, first + 1, first], :)
      call take_points(points, map, trouble)
      is_grid = .not. allocated(trouble)
      if (is_grid) is_grid = size(map%height, 2) > 1 .and. size(points%line) >= least_points .and. &
                             2*size(points%line) >= size(map%height)
   end function is_grid

end module wavycon_table_layout
