!> Tables of numbers at the points of a grid over the whole cell. Such a table is a text in gnuplot's grid format, with
!> a blank line between rows, or a file of numpy: an array of records.
module wavycon_cell_file
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_contact_fields, only: contact_fields
   use wavycon_kinds, only: dp, int64
   use wavycon_memory_table, only: column_list, column_type, of_integers
   use wavycon_output_file, only: npy_mark, output_file, table_mark
   use wavycon_plain_text, only: integer_text, newline
   use wavycon_results, only: results_type
   use wavycon_system, only: has_memory_for
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: cell_file, check_memory, is_text, map_offset, map_points, npy_header

   !> A map of more than text_side^2 points, and planes with more points in total, are written in numpy's format, unless
   !> the deck names the format.
   integer, parameter, public :: text_side = 257

   !> The length of the header of numpy's format, version 1.0 (numpy.lib.format), is a multiple of `npy_header_step`
   !> bytes. It is then the same for all maps of a kind, and readers that do not know the format can skip it.
   integer, parameter :: npy_header_step = 256

   type :: cell_file
      type(output_file) :: file
      logical :: as_text = .true.
      integer :: points(2) = 0                !! numbers of points along x and y
      real(dp) :: offset(2) = 0.0_dp          !! position of the first point along x and y, in steps of the grid
      real(dp), private :: side(2) = 0.0_dp   !! sides of the cell [length]
      logical :: is_here = .true.             !! whether this rank writes the file
   contains
      procedure :: open => open_cell_file
      procedure :: put_row
   end type cell_file

contains

   !> Opens <case>.<file>.dat or <case>.<file>.npy, `file` being that of the table, on the first rank. When it is
   !> complete it also replaces the other one, and a table with commas, of an earlier run. Afterwards
   !> `file%is_open` says whether the file could be opened and whether there is enough memory for a grid of its points.
   subroutine open_cell_file(self, results, table, planes, numbers_a_point, subject)
      class(cell_file), intent(out) :: self
      type(results_type), intent(in) :: results
      !> The table, whose columns are integers, then x, y and others. A file of numpy does not have the integers.
      class(table_type), intent(in) :: table
      !> Shape of the array of planes in the file of numpy: the number of loads, then of planes of a load if there are
      !> several.
      integer, intent(in) :: planes(:)
      integer, intent(in) :: numbers_a_point    !! how many numbers are in memory for each point
      character(*), intent(in) :: subject       !! words before the number of points in the message on memory

      integer :: counted
      type(column_type), allocatable :: columns(:)

      self%points = map_points(results)
      ! A map counts as one plane, a table with several planes for each load with all of them.
      counted = merge(product(planes), 1, size(planes) > 1)
      self%as_text = is_text(results%scene%output%map_format%text, self%points*[1, counted])
      self%side = results%solver%surface%sides()
      self%offset = map_offset(results, self%points)
      self%is_here = results%sharing%is_first
      if (.not. self%is_here) return
      if (self%as_text) then
         call results%open_table(trim(table%file), table%columns, self%file)
         call self%file%replace('.npy', npy_mark)
      else
         columns = column_list(table%columns)
         columns = pack(columns, columns%kind /= of_integers)
         call self%file%open(results%scene%directory//'/'//results%scene%case//'.'//trim(table%file)//'.npy', &
                             npy_header([planes, self%points([2, 1])], columns%name))
         call self%file%replace('.dat', table_mark)
         call self%file%replace('.csv', table%columns(:index(table%columns, '[') - 1))
      end if
      call check_memory(self%file, self%points, numbers_a_point, subject)
   end subroutine open_cell_file

   !> Notes trouble of a file if there is not enough memory for a grid.
   subroutine check_memory(file, points, numbers_a_point, subject)
      type(output_file), intent(inout) :: file
      integer, intent(in) :: points(2)         !! numbers of points of the grid along x and y
      integer, intent(in) :: numbers_a_point   !! how many double precision numbers each point takes
      character(*), intent(in) :: subject      !! words before the number of points in the message

      if (has_memory_for(numbers_a_point*product(int(points, int64)))) return
      call file%note_trouble('there is not enough memory for '//subject//integer_text(points(1))//' x '// &
                             integer_text(points(2))//' points')
   end subroutine check_memory

   !> Writes a row of points along x. The surface is periodic: the point behind the last one would be the first one
   !> again and is not written.
   subroutine put_row(self, integers, row, values)
      class(cell_file), intent(inout) :: self
      integer, intent(in) :: integers(:)     !! values of the columns before x and y
      integer, intent(in) :: row             !! number of the row along y, from 1
      real(dp), intent(in) :: values(:, :)   !! values of the columns after x and y, shape (columns, points)

      real(dp), allocatable :: rows(:, :)
      integer :: k

      if (.not. self%is_here) return
      allocate (rows(size(values, 1) + 2, size(values, 2)))
      do k = 1, size(rows, 2)
         rows(:2, k) = self%side*([k, row] - 1 + self%offset)/self%points
      end do
      rows(3:, :) = values
      if (self%as_text) then
         if (row > 1) call self%file%put('')
         do k = 1, size(rows, 2)
            call self%file%put_row([real(integers, dp), rows(:, k)])
         end do
      else
         call self%file%put_numbers(rows)
      end if
   end subroutine put_row

   !> The numbers of points of maps along x and y; in 1-D the second is 1.
   function map_points(results) result(points)
      type(results_type), intent(in) :: results
      integer :: points(2)

      points = 1
      associate (given => nint(results%scene%output%map_points%numbers))
         points(:size(given)) = given
      end associate
   end function map_points

   !> Whether a map is written as a text.
   pure logical function is_text(map_format, points)
      character(*), intent(in) :: map_format   !! value of the key map_format: 'text', 'auto' or another
      integer, intent(in) :: points(2)         !! two factors of the number of points

      is_text = map_format == 'text' .or. (map_format == 'auto' .and. product(int(points, int64)) <= text_side**2)
   end function is_text

   !> The position of the first point of maps along x and y, in steps of the grid, the same for all loads. If a load was
   !> solved on a grid of as many points as the map, the map takes the points of that grid.
   function map_offset(results, points) result(offset)
      type(results_type), intent(in) :: results
      integer, intent(in) :: points(2)
      real(dp) :: offset(2)

      class(contact_fields), allocatable :: fields
      integer :: load

      do load = 1, size(results%loads)
         call results%loads(load)%fields(results%solver%surface, fields)
         offset = fields%own_offset
         if (all(points == fields%own_points)) return
      end do
      ! Otherwise the points of a mirrored surface are in the middle of their steps, so that none lies on a border.
      offset = merge(0.5_dp, 0.0_dp, results%solver%surface%maps_in_cell() > 1)
   end function map_offset

   !> The header of a file in numpy's format: the bytes before the elements. Elements are double precision numbers or
   !> records of such numbers; they follow with the last index changing fastest.
   pure function npy_header(elements, names) result(header)
      integer, intent(in) :: elements(:)     !! shape of the array of elements
      !> Names of the numbers of a record; all of them must fit into a header of 65 kB. Absent: elements are numbers.
      character(*), intent(in), optional :: names(:)
      character(:), allocatable :: header

      !> The first bytes. Two bytes with the length of the rest of the header follow, the lower one first.
      character(*), parameter :: magic = npy_mark//char(1)//char(0)
      integer, parameter :: before_words = len(magic) + 2
      character(:), allocatable :: number, words
      integer :: i, length

      ! '<' says that the lowest byte of a number comes first in memory, '>' that the highest does.
      number = "'>f8'"
      if (transfer(1, 1_int8) == 1_int8) number = "'<f8'"
      words = number
      if (present(names)) then
         words = '['
         do i = 1, size(names)
            words = words//"('"//trim(names(i))//"', "//number//'), '
         end do
         words = words//']'
      end if
      words = "{'descr': "//words//", 'fortran_order': False, 'shape': ("
      do i = 1, size(elements)
         words = words//integer_text(elements(i))//', '
      end do
      words = words//'), }'
      length = npy_header_step*((before_words + len(words) + npy_header_step)/npy_header_step)
      header = magic//char(modulo(length - before_words, 256))//char((length - before_words)/256)//words
      header = header//repeat(' ', length - len(header) - 1)//newline
   end function npy_header

end module wavycon_cell_file
