!> <case>.map.dat: the fields over one cell, a block for each load with a blank line between rows (gnuplot's grid
!> format). Or <case>.map.npy: the same as an array of records for numpy.
module wavycon_map_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_column_text, only: column_name
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_npy_header, only: npy_header
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: integer_text
   use wavycon_results, only: results_type
   use wavycon_series_samples, only: sample_series
   use wavycon_shared_file, only: shared_file
   use wavycon_system, only: has_memory_for
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: is_text, map_offset, map_points, map_table

   !> A map of more points than the square of this is written in numpy's format, unless the deck says otherwise.
   integer, parameter, public :: text_side = 257

   !> Numbers for each point of a map: three fields and the surface, the spectrum of one, and those of the solution.
   integer(int64), parameter :: numbers_a_point = 7

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'x[length]', 'y[length]', 'pressure[pressure]', 'gap[length]', 'displacement[length]', &
      'undeformed_gap[length]']

   type, extends(table_type) :: map_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure :: is_written_by_all
      procedure, nopass :: write => write_map_table
   end type map_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'map'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Pressures and gaps over the whole cell.'
   end function meaning

   pure logical function needs_fields(self)
      class(map_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> All ranks write a map in numpy's format at the points of the grid that all loads are solved on.
   logical function is_written_by_all(self, results)
      class(map_table), intent(in) :: self
      type(results_type), intent(in) :: results

      class(contact_fields), allocatable :: fields
      integer :: grid(2), load, points(2)
      integer(int64) :: number

      associate (unused => self); end associate
      points = map_points(results)
      is_written_by_all = .not. is_text(results%scene%output%text('map_format'), points)
      if (.not. is_written_by_all) return
      if (.not. allocated(results%loads)) then
         grid = results%traits%given_grid
         is_written_by_all = all(points == grid .or. points == 2*grid)
         return
      end if
      number = results%loads(1)%spread_points()
      is_written_by_all = number > 0 .and. &
         all([(results%loads(load)%spread_points() == number, load=1, size(results%loads))])
      if (.not. is_written_by_all) return
      call results%loads(1)%fields(results%solver%surface, fields)
      is_written_by_all = all(points == fields%own_points)
   end function is_written_by_all

   !> Errors: exit_file_trouble.
   subroutine write_map_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      logical :: as_text
      integer :: load, points(2)
      real(dp) :: offset(2)

      points = map_points(results)
      if (results%loads(1)%spread_points() > 0) then
         call write_by_all(results, points, error)
         return
      end if
      as_text = is_text(results%scene%output%text('map_format'), points)
      if (as_text) then
         call results%open_table('map', columns, file, in_blocks=.true.)
      else
         call file%open(results%scene%directory, results%scene%case//'.map.npy', binary=.true.)
         ! The first index of the file's array is the load.
         call file%put_raw(npy_header(column_name(columns(2:)), [size(results%loads), points(2), points(1)]))
      end if
      if (.not. has_memory_for(numbers_a_point*product(int(points, int64)))) call file%note_trouble( &
         'there is not enough memory for '//integer_text(points(1))//' x '//integer_text(points(2))//' points')
      if (file%is_open()) offset = map_offset(results, points)
      do load = 1, size(results%loads)
         if (.not. file%is_open()) exit
         if (as_text) call results%begin_block(file, load)
         call put_map(results, load, points, offset, as_text, file)
      end do
      call file%finish(error)
   end subroutine write_map_table

   !> Writes the file of numpy by all ranks, each from its columns of the grids. Errors: exit_file_trouble.
   subroutine write_by_all(results, points, error)
      type(results_type), intent(in) :: results
      integer, intent(in) :: points(2)
      type(error_type), allocatable, intent(out) :: error

      class(contact_fields), allocatable :: fields
      type(grid_slab) :: slab
      type(shared_file) :: file
      integer :: image, load
      real(dp), allocatable :: shape(:, :)
      type(grid_transform) :: transform

      call results%loads(1)%fields(results%solver%surface, fields)
      slab = fields%own_slab
      allocate (shape(slab%points(1), slab%columns()))
      associate (series => results%solver%surface%shape)
         call transform%start(slab%points, series%is_even())
         call transform%sample(series, shape)
      end associate
      call file%open(results%scene%directory, results%scene%case//'.map.npy', &
                     npy_header(column_name(columns(2:)), [size(results%loads), points(2), points(1)]))
      do load = 1, size(results%loads)
         if (load > 1) call results%loads(load)%fields(results%solver%surface, fields)
         ! The mirror images of the columns follow those of a quarter of the cell.
         do image = 1, points(2)/slab%points(2)
            call put_columns(results, load, points, slab, fields, shape, image == 2, file)
         end do
      end do
      call file%finish(error)
   end subroutine write_by_all

   !> Writes the own columns of a load or their mirror images, some at a time.
   subroutine put_columns(results, load, points, slab, fields, shape, is_image, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      integer, intent(in) :: points(2)
      type(grid_slab), intent(in) :: slab
      class(contact_fields), intent(in) :: fields
      real(dp), intent(in) :: shape(:, :)     !! 1 - h/Delta, shape (M, slab%columns())
      logical, intent(in) :: is_image
      type(shared_file), intent(inout) :: file

      !> Numbers that are written at a time: 64 MB of them.
      integer, parameter :: most_numbers = 2**23
      integer :: block, c, first, k, l, last, numbers, place, step
      real(dp) :: side(2)
      real(dp), allocatable :: gap(:), p(:), rows(:, :, :), u(:)

      numbers = size(columns) - 1
      block = max(1, most_numbers/(numbers*points(1)))
      allocate (rows(numbers, points(1), block))
      allocate (gap(slab%points(1)), p(slab%points(1)), u(slab%points(1)))
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         side = surface%sides()
         ! Ranks with fewer columns take part with none.
         do step = 1, (slab%width - 1)/block + 1
            first = slab%first + (step - 1)*block
            last = min(first + block - 1, slab%last)
            place = first
            if (is_image) place = points(2) + 1 - last
            do l = first, last
               associate (own => shape(:, l - slab%first + 1))
                  call fields%at_own_column(l, own, p, u, gap)
                  c = merge(last - l, l - first, is_image)
                  do k = 1, points(1)
                     associate (row => image_of_point(k, slab%points(1), points(1) > slab%points(1)))
                        rows(:, k, c + 1) = [side*([k, place + c] - 1 + fields%own_offset)/points, p_star*p(row), &
                                             surface%amplitude*[gap(row), u(row), 1.0_dp - own(row)]]
                     end associate
                  end do
               end associate
            end do
            call file%put_columns(int(load - 1, int64)*numbers*points(1)*points(2), numbers*points(1), place, &
                                  max(last - first + 1, 0), rows)
         end do
      end associate
   end subroutine put_columns

   !> The points of the map along x and y.
   function map_points(results) result(points)
      type(results_type), intent(in) :: results
      integer :: points(2)

      points = 1
      associate (given => results%scene%output%integers('map_points'))
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
      ! Of a mirrored map the points are in the middle of their steps, so that none lies on a border.
      offset = merge(0.5_dp, 0.0_dp, results%solver%surface%parts() > 1)
   end function map_offset

   !> Writes the map of a load. The point after the last of a row is the first again and is not written.
   subroutine put_map(results, load, points, offset, as_text, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)       !! of the first point, in steps
      logical, intent(in) :: as_text
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      real(dp) :: side(2)
      real(dp), allocatable :: gap(:, :), p(:, :), rows(:, :), shape(:, :), u(:, :)
      integer :: k, l

      allocate (rows(size(columns) - 1, points(1)))
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         call results%loads(load)%fields(surface, fields)
         call fields%on_grid(points, offset, p, u, gap)
         call sample_series(surface%shape, points, offset, shape, surface%parts())
         side = surface%sides()
         do l = 1, points(2)
            do k = 1, points(1)
               rows(:, k) = [side*([k, l] - 1 + offset)/points, p_star*p(k, l), &
                             surface%amplitude*[gap(k, l), u(k, l), 1.0_dp - shape(k, l)]]
            end do
            if (as_text) then
               if (l > 1) call file%put('')
               call file%put_rows([load], rows)
            else
               call file%put_raw(rows)
            end if
         end do
      end associate
   end subroutine put_map

end module wavycon_map_table
