!> Reads height maps from files: a matrix in gnuplot's format, or lines of x, y and z.
module wavycon_map_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_key_table, only: smallest_number
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_number_table, only: number_table, read_number_table
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_system, only: has_memory_for, path_device, path_kind
   implicit none (type, external)
   private

   public :: read_height_map, check_map_size, check_room

   !> Fewest and most points along a side; more do not fit into the memory of most machines.
   integer, parameter :: least_points = 4, most_points = 8192
   !> Most bytes of a file, near the largest default integer.
   integer, parameter :: most_bytes = 2000000000

contains

   !> Reads a map. Errors: exit_file_trouble if the file cannot be read, exit_bad_input if it is not a map.
   subroutine read_height_map(path, format, map, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: format   !! 'matrix', 'xyz' or 'auto'
      type(measured_map), intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      type(number_table), target :: table

      ! A pipe may block, a device may never end, and a run of the resolved deck could not read either again.
      if (path_kind(path) == path_device) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': this is a pipe or a device, not a file')
         return
      end if
      call read_number_table(path, most_bytes, table, error)
      if (allocated(error)) return
      map%format = format
      if (format == 'auto') then
         map%format = 'matrix'
         if (table%length(1) == 3 .and. table%rows() > 3 .and. size(table%values) == 3*table%rows()) &
            map%format = 'xyz'
      end if
      call check_room(path, size(table%values)/merge(3, 1, map%format == 'xyz'), error)
      if (allocated(error)) return
      if (map%format == 'xyz') then
         call take_points(table, map, error)
      else
         call take_matrix(table, map, error)
      end if
      if (.not. allocated(error)) call check_map_size(path, shape(map%height), error)
   end subroutine read_height_map

   !> Checks that there is memory for a map and its surface besides the numbers read, because later allocations have no
   !> error handling. Errors: exit_file_trouble.
   subroutine check_room(source, heights, error)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: heights       !! of the map
      type(error_type), allocatable, intent(out) :: error

      !> Real numbers for each height: the map, the Fourier coefficients and their copies, work space of the transforms.
      integer(int64), parameter :: copies = 5

      if (.not. has_memory_for(copies*heights)) &
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory for a map of this size')
   end subroutine check_room

   !> Makes a map from lines with a row of heights each. Errors: exit_bad_input for rows of unequal length.
   subroutine take_matrix(table, map, error)
      type(number_table), intent(in) :: table
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      integer :: columns, j

      columns = table%length(1)
      do j = 2, table%rows()
         if (table%length(j) == columns) cycle
         call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(table%line(j))// &
                          ': this row has '//integer_text(table%length(j))//' heights, the first has '// &
                          integer_text(columns)//": all must have the same number. Is it file_format = 'xyz'?")
         return
      end do
      map%height = reshape(table%values, [columns, table%rows()])
      map%missing = ieee_is_nan(map%height)
      if (any(map%missing)) then
         where (map%missing) map%height = 0.0_dp
      else
         deallocate (map%missing)
      end if
   end subroutine take_matrix

   !> Makes a map from lines of x, y and z; x or y varies fastest. Errors: exit_bad_input if the points do not form a
   !> regular grid.
   subroutine take_points(table, map, error)
      type(number_table), intent(in), target :: table
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      !> Largest deviation of a point from the grid, in steps: coordinates in files are often rounded.
      real(dp), parameter :: tolerance = 0.01_dp
      real(dp), pointer :: xyz(:, :)
      integer :: fast, i, j, k, m, n, slow

      do k = 1, table%rows()
         if (table%length(k) /= 3) then
            call bad_line(k, 'this line has '//integer_text(table%length(k))// &
                          " numbers: file_format = 'xyz' needs x, y and z")
            return
         end if
      end do
      xyz(1:3, 1:table%rows()) => table%values
      if (size(xyz, 2) < 2) then
         call bad_line(1, 'one point is no map')
         return
      end if
      fast = merge(1, 2, abs(xyz(1, 2) - xyz(1, 1)) > abs(xyz(2, 2) - xyz(2, 1)))
      slow = 3 - fast
      call take_steps(xyz(fast, :), m, map%step(fast))
      n = (size(xyz, 2) + m - 1)/m
      if (n > 1) call take_steps(xyz(slow, ::m), k, map%step(slow))
      if (.not. abs(map%step(fast)) >= smallest_number) then
         call bad_line(2, 'this point is where the first one is')
         return
      end if
      do k = 1, size(xyz, 2)
         i = modulo(k - 1, m)
         j = (k - 1)/m
         if (abs(xyz(fast, k) - xyz(fast, 1) - i*map%step(fast)) <= tolerance*abs(map%step(fast)) .and. &
             abs(xyz(slow, k) - xyz(slow, 1) - j*map%step(slow)) <= tolerance*abs(map%step(slow))) cycle
         call bad_line(k, 'x = '//short_number(xyz(1, k))//', y = '//short_number(xyz(2, k))// &
                       ' is out of step: the points must form a regular grid, '//integer_text(m)// &
                       ' to a row as it seems')
         return
      end do
      if (n > 1 .and. .not. abs(map%step(slow)) >= smallest_number) then
         call bad_line(m + 1, 'this point is where the first one is')
         return
      else if (m*n /= size(xyz, 2)) then
         call bad_line(table%rows(), 'the last row ends short: '//integer_text(size(xyz, 2))// &
                       ' points are no multiple of the '//integer_text(m)//' of the first row')
         return
      end if
      if (fast == 1) then
         map%height = reshape(xyz(3, :), [m, n])
      else
         map%height = transpose(reshape(xyz(3, :), [m, n]))
      end if
      ! Falling coordinates are treated as rising: this mirrors the map and moves pressures and gaps, but does not
      ! change their values.
      map%step = abs(map%step)

   contains

      subroutine bad_line(number, words)
         integer, intent(in) :: number
         character(*), intent(in) :: words

         call fatal_error(error, exit_bad_input, escaped(table%path)//':'//integer_text(table%line(number))// &
                          ': '//words)
      end subroutine bad_line

   end subroutine take_points

   !> Counts the coordinates that follow each other in equal steps. The step is the mean of these: the rounding error
   !> of a single step would add up.
   pure subroutine take_steps(coordinate, number, step)
      real(dp), intent(in) :: coordinate(:)   !! shape (n), n >= 2
      integer, intent(out) :: number          !! >= 2
      real(dp), intent(out) :: step

      !> Steps count as equal if they differ from the first one by less than this fraction of it.
      real(dp), parameter :: tolerance = 0.1_dp

      step = coordinate(2) - coordinate(1)
      number = 2
      do while (number < size(coordinate))
         if (.not. abs(coordinate(number + 1) - coordinate(number) - step) <= tolerance*abs(step)) exit
         number = number + 1
      end do
      step = (coordinate(number) - coordinate(1))/(number - 1)
   end subroutine take_steps

   !> Checks the number of points. Errors: exit_bad_input for a map that is too small or too large.
   subroutine check_map_size(source, points, error)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: points(2)     !! along x and y; the second is 1 for a profile
      type(error_type), allocatable, intent(out) :: error

      associate (m => points(1), n => points(2))
         if (m < least_points .or. (n < least_points .and. n /= 1) .or. max(m, n) > most_points) &
            call fatal_error(error, exit_bad_input, escaped(source)//': a map of '//integer_text(m)//' x '// &
                             integer_text(n)//' points: there must be '//integer_text(least_points)//' to '// &
                             integer_text(most_points)//' along each side, or one row for a profile')
      end associate
   end subroutine check_map_size

end module wavycon_map_file
