!> Tables of numbers at the points of a grid over the whole cell: a text in gnuplot's grid format, with a blank line
!> between rows, or an array of records for numpy.
module wavycon_cell_file
   use, intrinsic :: iso_fortran_env, only: int64, int8
   use wavycon_contact_fields, only: contact_fields
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_list, column_type, of_integers
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: integer_text, newline
   use wavycon_results, only: results_type
   use wavycon_system, only: has_memory_for
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: cell_file, check_memory, is_text, map_offset, map_points, npy_header

   !> A map of more points than the square of this, or planes of more points together, are written in numpy's format,
   !> unless the deck says otherwise.
   integer, parameter, public :: text_side = 257

   !> The header of numpy's format, version 1.0 (numpy.lib.format), is a multiple of so many bytes, the same for all
   !> maps of a kind, so that readers that do not know the format skip it.
   integer, parameter :: npy_header_step = 256

   type :: cell_file
      type(output_file) :: file
      logical :: as_text = .true.
      integer :: points(2) = 0                !! along x and y
      real(dp) :: offset(2) = 0.0_dp          !! of the first point, in steps
      real(dp), private :: side(2) = 0.0_dp   !! of the cell [length]
      logical :: is_here = .true.             !! whether this rank writes it
   contains
      procedure :: open => open_cell_file
      procedure :: put_row
   end type cell_file

contains

   !> Opens <case>.<kind>.dat or <case>.<kind>.npy, on the first rank. `file%is_open` says whether there is the memory
   !> too.
   subroutine open_cell_file(self, results, table, planes, numbers_a_point, what)
      class(cell_file), intent(out) :: self
      type(results_type), intent(in) :: results
      !> With columns of integers, which the file of numpy does not have, x, y and others.
      class(table_type), intent(in) :: table
      integer, intent(in) :: planes(:)          !! their number along each of the first indices of the file of numpy
      integer, intent(in) :: numbers_a_point    !! that are in memory at a time
      character(*), intent(in) :: what          !! before the number of points, for the message on memory

      type(column_type), allocatable :: columns(:)

      self%points = map_points(results)
      ! A table with more than one plane a load counts all of them.
      self%as_text = is_text(results%scene%output%map_format%text, &
                             self%points*[1, merge(product(planes), 1, size(planes) > 1)])
      self%side = results%solver%surface%sides()
      self%offset = map_offset(results, self%points)
      self%is_here = results%sharing%is_first
      if (.not. self%is_here) return
      if (self%as_text) then
         call results%open_table(trim(table%file), table%columns, self%file)
      else
         columns = column_list(table%columns)
         columns = pack(columns, columns%kind /= of_integers)
         call self%file%open(results%scene%directory, results%scene%case//'.'//trim(table%file)//'.npy', &
                             npy_header([planes, self%points([2, 1])], columns%name))
      end if
      call check_memory(self%file, self%points, numbers_a_point, what)
   end subroutine open_cell_file

   !> Notes trouble if there is not the memory for a grid.
   subroutine check_memory(file, points, numbers_a_point, what)
      type(output_file), intent(inout) :: file
      integer, intent(in) :: points(2)
      integer, intent(in) :: numbers_a_point
      character(*), intent(in) :: what         !! before the number of points

      if (has_memory_for(numbers_a_point*product(int(points, int64)))) return
      call file%note_trouble('there is not enough memory for '//what//integer_text(points(1))//' x '// &
                             integer_text(points(2))//' points')
   end subroutine check_memory

   !> Writes a row of points along x. The point after the last is the first again and is not written.
   subroutine put_row(self, integers, row, values)
      class(cell_file), intent(inout) :: self
      integer, intent(in) :: integers(:)     !! of the first columns
      integer, intent(in) :: row             !! its number, from 1
      real(dp), intent(in) :: values(:, :)   !! of the columns after x and y, shape (columns, points)

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

   !> The points of maps along x and y.
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
      character(*), intent(in) :: map_format   !! the key
      integer, intent(in) :: points(2)

      is_text = map_format == 'text' .or. (map_format == 'auto' .and. product(int(points, int64)) <= text_side**2)
   end function is_text

   !> The place of the first point, in steps, the same for all loads: that of a grid that was solved with as many
   !> points.
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
      ! The points of a mirrored map are in the middle of their steps, so that none lies on a border.
      offset = merge(0.5_dp, 0.0_dp, results%solver%surface%parts() > 1)
   end function map_offset

   !> The bytes of numpy's file format before the elements, double precision numbers or records of them. These follow
   !> with the last index changing fastest.
   pure function npy_header(elements, names) result(header)
      integer, intent(in) :: elements(:)     !! their number along each index
      !> Names of the numbers of a record, short enough for the header; absent: the elements are numbers.
      character(*), intent(in), optional :: names(:)
      character(:), allocatable :: header

      !> Followed by two bytes for the length of the rest, the lower one first.
      character(*), parameter :: magic = char(147)//'NUMPY'//char(1)//char(0)
      integer, parameter :: before_words = len(magic) + 2
      character(:), allocatable :: number, words
      integer :: i, length

      ! '<' where the lowest byte of a number is the first, '>' elsewhere.
      number = "'"//merge('<', '>', transfer(1, 1_int8) == 1_int8)//"f8'"
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
