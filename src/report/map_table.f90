!> <case>.map.dat: the fields over one cell, a block for each load with a blank line between rows (gnuplot's grid
!> format). Or <case>.map.npy: the same as an array of records for numpy.
module wavycon_map_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_cell_file, only: cell_file, is_text, map_points
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_name
   use wavycon_npy_header, only: npy_header
   use wavycon_results, only: results_type
   use wavycon_shared_file, only: shared_file
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: map_table

   !> Numbers for each point of a map: three fields and the surface, the spectrum of one, and those of the solution.
   integer, parameter :: numbers_a_point = 7

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'x[length]', 'y[length]', 'pressure[pressure]', 'gap[length]', 'displacement[length]', &
      'undeformed_gap[length]']

contains

   type(table_type) function map_table() result(table)
      table%file = 'map'
      table%key = 'map'
      table%meaning = 'Pressures and gaps over the whole cell.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%written_by_all => is_written_by_all
      table%write_all => write_map_table
   end function map_table

   !> All ranks write a map in numpy's format at the points of the grid that all loads are solved on.
   logical function is_written_by_all(results)
      type(results_type), intent(in) :: results

      class(contact_fields), allocatable :: fields
      integer :: grid(2), load, points(2)
      integer(int64) :: number

      points = map_points(results)
      is_written_by_all = .not. is_text(results%scene%output%text('map_format'), points)
      if (.not. is_written_by_all) return
      if (.not. allocated(results%loads)) then
         grid = results%traits%given_grid
         is_written_by_all = all(points == grid .or. points == 2*grid)
         return
      end if
      number = results%loads(1)%distributed_points()
      is_written_by_all = number > 0 .and. &
         all([(results%loads(load)%distributed_points() == number, load=1, size(results%loads))])
      if (.not. is_written_by_all) return
      call results%loads(1)%fields(results%solver%surface, fields)
      is_written_by_all = all(points == fields%own_points)
   end function is_written_by_all

   !> Errors: exit_file_trouble.
   subroutine write_map_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: map
      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: gap(:, :), p(:, :), shape(:, :), u(:, :), values(:, :)
      integer :: l, load

      if (results%loads(1)%distributed_points() > 0) then
         call write_by_all(results, map_points(results), error)
         return
      end if
      call map%open(results, 'map', columns, 1, [size(results%loads)], numbers_a_point, '')
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         do load = 1, size(results%loads)
            if (.not. map%file%is_open()) exit
            if (map%as_text) call results%begin_block(map%file, load)
            call results%loads(load)%fields(surface, fields)
            call fields%on_grid(map%points, map%offset, p, u, gap)
            call surface%sample_shape(map%points, map%offset, shape)
            do l = 1, map%points(2)
               values = transpose(reshape([p_star*p(:, l), surface%amplitude*gap(:, l), surface%amplitude*u(:, l), &
                                           surface%amplitude*(1.0_dp - shape(:, l))], [map%points(1), 4]))
               call map%put_row([load], l, values)
            end do
         end do
      end associate
      call map%file%finish(error)
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
                     npy_header([size(results%loads), points(2), points(1)], column_name(columns(2:))))
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

end module wavycon_map_table
