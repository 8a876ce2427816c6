!> Height maps from files: gnuplot's matrix, or lines of x, y and z.
!>
!> What stands behind a '#' and empty lines are left out; numbers are parted by blanks, tabs, commas or semicolons.
module wavycon_height_map_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, excerpt, integer_text, short_number
   use wavycon_system, only: parse_number
   implicit none (type, external)
   private

   public :: height_map_type, read_height_map

   !> A periodic map: the last row and column are not copies of the first.
   type :: height_map_type
      real(dp), allocatable :: height(:, :)   !! as in the file, shape (M, N): along x, along y; N = 1 for a profile
      real(dp) :: step(2) = 0.0_dp            !! between points; zero, where the file does not tell
      character(6) :: format = ''             !! 'matrix' or 'xyz'
   end type height_map_type

   !> Points along a side; fewer are no surface, more would not fit the memory.
   integer, parameter :: least_points = 4, most_points = 8192
   integer, parameter :: most_bytes = 2000000000

   !> The numbers of a file, line by line.
   type :: number_table
      character(:), allocatable :: path
      real(dp), allocatable :: values(:)
      integer, allocatable :: first(:)   !! of each line that has numbers, its first; and one behind the last
      integer, allocatable :: line(:)    !! of these lines, the number in the file
   end type number_table

contains

   !> Reads a map. Errors: exit_file_trouble if the file cannot be read, exit_bad_input if it is no map.
   subroutine read_height_map(path, format, map, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: format   !! 'matrix', 'xyz' or 'auto'
      type(height_map_type), intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text
      type(number_table) :: table
      integer :: columns

      call read_deck_text(path, text, error, most_bytes)
      if (allocated(error)) return
      call read_numbers(text, table, error)
      if (allocated(error)) return
      map%format = format
      if (format == 'auto') then
         columns = table%first(2) - table%first(1)
         map%format = 'matrix'
         if (columns == 3 .and. size(table%line) > 3 .and. size(table%values) == 3*size(table%line)) map%format = 'xyz'
      end if
      if (map%format == 'xyz') then
         call take_points(table, map, error)
      else
         call take_matrix(table, map, error)
      end if
      if (.not. allocated(error)) call check_size(path, map, error)
   end subroutine read_height_map

   !> Errors: exit_bad_input for what is no finite number, and if there is none at all.
   subroutine read_numbers(text, table, error)
      type(deck_text_type), intent(inout) :: text   !! its content is ended by a null character
      type(number_table), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: separators = ' ,;'//achar(9)
      real(dp) :: value
      integer :: first, last, length, line, place, lines, values

      table%path = text%path
      text%content = text%content//c_null_char
      ! A number takes two bytes at least.
      allocate (table%values(len(text%content)/2 + 1), table%first(size(text%line_start) + 1), &
                table%line(size(text%line_start)))
      lines = 0
      values = 0
      do line = 1, size(text%line_start)
         call text%line_bounds(line, first, last)
         if (last == len(text%content)) last = last - 1
         if (lines > 0) then
            if (table%first(lines) /= values + 1) lines = lines + 1
         else
            lines = 1
         end if
         table%first(lines) = values + 1
         table%line(lines) = line
         place = first
         do while (place <= last)
            if (text%content(place:place) == '#') exit
            if (index(separators, text%content(place:place)) > 0) then
               place = place + 1
               cycle
            end if
            length = int(parse_number(text%content(place:), value))
            if (.not. ends_there(place + length) .or. length == 0) then
               call bad_number('is no number')
               return
            else if (.not. ieee_is_finite(value)) then
               call bad_number('is no height: a map must be whole')
               return
            end if
            values = values + 1
            table%values(values) = value
            place = place + length
         end do
      end do
      if (values == 0) then
         call fatal_error(error, exit_bad_input, escaped(text%path)//': there are no numbers in this file')
         return
      end if
      if (table%first(lines) == values + 1) lines = lines - 1
      table%first(lines + 1) = values + 1
      table%values = table%values(:values)
      table%first = table%first(:lines + 1)
      table%line = table%line(:lines)

   contains

      pure logical function ends_there(behind)
         integer, intent(in) :: behind

         ends_there = behind > last
         if (.not. ends_there) ends_there = index(separators//'#', text%content(behind:behind)) > 0
      end function ends_there

      subroutine bad_number(words)
         character(*), intent(in) :: words

         integer :: behind

         behind = place
         do while (.not. ends_there(behind))
            behind = behind + 1
         end do
         call fatal_error(error, exit_bad_input, escaped(text%path)//':'//integer_text(line)//": '"// &
                          excerpt(text%content(place:max(place, behind - 1)))//"' "//words)
      end subroutine bad_number

   end subroutine read_numbers

   !> A row a line. Errors: exit_bad_input for rows of unlike length.
   subroutine take_matrix(table, map, error)
      type(number_table), intent(in) :: table
      type(height_map_type), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      integer :: columns, j

      columns = table%first(2) - table%first(1)
      do j = 2, size(table%line)
         if (table%first(j + 1) - table%first(j) == columns) cycle
         call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(table%line(j))//': this row has '// &
                          integer_text(table%first(j + 1) - table%first(j))//' heights, the first has '// &
                          integer_text(columns)//": all must have the same number. Is it file_format = 'xyz'?")
         return
      end do
      map%height = reshape(table%values, [columns, size(table%line)])
   end subroutine take_matrix

   !> A point a line, x or y running first. Errors: exit_bad_input for what is no regular grid.
   subroutine take_points(table, map, error)
      type(number_table), intent(in) :: table
      type(height_map_type), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      !> Of a step: coordinates are often rounded.
      real(dp), parameter :: tolerance = 0.01_dp
      real(dp), allocatable :: xyz(:, :)
      integer :: fast, i, j, k, m, n, slow

      do k = 1, size(table%line)
         if (table%first(k + 1) - table%first(k) /= 3) then
            call bad_line(k, 'this line has '//integer_text(table%first(k + 1) - table%first(k))// &
                          " numbers: file_format = 'xyz' wants x, y and z")
            return
         end if
      end do
      allocate (xyz(3, size(table%line)), source=reshape(table%values, [3, size(table%line)]))
      if (size(xyz, 2) < 2) then
         call bad_line(1, 'one point is no map')
         return
      end if
      fast = merge(1, 2, abs(xyz(1, 2) - xyz(1, 1)) > abs(xyz(2, 2) - xyz(2, 1)))
      slow = 3 - fast
      map%step(fast) = xyz(fast, 2) - xyz(fast, 1)
      m = 1
      do while (m < size(xyz, 2))
         if (.not. abs(xyz(fast, m + 1) - xyz(fast, 1) - m*map%step(fast)) <= tolerance*abs(map%step(fast))) exit
         m = m + 1
      end do
      n = (size(xyz, 2) + m - 1)/m
      if (m > 1 .and. n > 1) map%step(slow) = xyz(slow, m + 1) - xyz(slow, 1)
      do k = 1, size(xyz, 2)
         i = modulo(k - 1, m)
         j = (k - 1)/m
         if (abs(xyz(fast, k) - xyz(fast, 1) - i*map%step(fast)) <= tolerance*abs(map%step(fast)) .and. &
             abs(xyz(slow, k) - xyz(slow, 1) - j*map%step(slow)) <= tolerance*abs(map%step(slow))) cycle
         call bad_line(k, 'x = '//short_number(xyz(1, k))//', y = '//short_number(xyz(2, k))// &
                       ' is out of step: the points must form a regular grid, '//integer_text(m)//' to a row as it seems')
         return
      end do
      if (m*n /= size(xyz, 2)) then
         call bad_line(size(table%line), 'the last row ends short: '//integer_text(size(xyz, 2))// &
                       ' points are no multiple of the '//integer_text(m)//' of the first row')
         return
      end if
      if (fast == 1) then
         map%height = reshape(xyz(3, :), [m, n])
      else
         map%height = transpose(reshape(xyz(3, :), [m, n]))
      end if
      ! The cell runs on in the same direction as the points, so that a falling coordinate mirrors nothing but the
      ! origin.
      map%step = abs(map%step)

   contains

      subroutine bad_line(number, words)
         integer, intent(in) :: number
         character(*), intent(in) :: words

         call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(table%line(number))//': '//words)
      end subroutine bad_line

   end subroutine take_points

   !> Errors: exit_bad_input for a map that is too small or too large.
   subroutine check_size(path, map, error)
      character(*), intent(in) :: path
      type(height_map_type), intent(in) :: map
      type(error_type), allocatable, intent(out) :: error

      associate (m => size(map%height, 1), n => size(map%height, 2))
         if (m < least_points .or. (n < least_points .and. n > 1) .or. max(m, n) > most_points) &
            call fatal_error(error, exit_bad_input, escaped(path)//': a map of '//integer_text(m)//' x '// &
                             integer_text(n)//' points: there must be '//integer_text(least_points)//' to '// &
                             integer_text(most_points)//' along each side, or one row for a profile')
      end associate
   end subroutine check_size

end module wavycon_height_map_file
