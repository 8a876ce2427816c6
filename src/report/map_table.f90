!> <case>.map.dat: the fields over one cell, a block for each load with a blank line between rows (gnuplot's grid
!> format). Or <case>.map.npy: the same as an array of records for numpy.
module wavycon_map_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_cell_file, only: cell_file, is_text, map_points
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_results, only: results_type
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
      real(dp), allocatable :: gap(:, :), p(:, :), shape(:, :), u(:, :)
      integer :: l, load
      logical :: by_all

      by_all = results%loads(1)%distributed_points() > 0
      call map%open(results, 'map', columns, 1, [size(results%loads)], merge(0, numbers_a_point, by_all), '')
      associate (surface => results%solver%surface)
         do load = 1, size(results%loads)
            if (.not. (map%file%is_open() .or. by_all)) exit
            if (map%as_text) call results%begin_block(map%file, load)
            call results%loads(load)%fields(surface, fields)
            if (by_all) then
               call put_distributed(results, load, fields, map)
               cycle
            end if
            call fields%on_grid(map%points, map%offset, p, u, gap)
            call surface%sample_shape(map%points, map%offset, shape)
            do l = 1, map%points(2)
               call map%put_row([load], l, row_of(results, p(:, l), gap(:, l), u(:, l), shape(:, l)))
            end do
         end do
      end associate
      if (map%is_here) call map%file%finish(error)
   end subroutine write_map_table

   !> Writes a load whose columns are distributed over the ranks: the first rank takes them one by one.
   subroutine put_distributed(results, load, fields, map)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      class(contact_fields), intent(in) :: fields
      type(cell_file), intent(inout) :: map

      integer :: column, k, l
      integer :: image(map%points(1))
      logical :: is_own
      real(dp), dimension(fields%own_slab%points(1)) :: gap, p, u
      real(dp), allocatable :: shape(:, :)
      real(dp) :: values(size(columns) - 3, map%points(1))
      type(grid_transform) :: transform

      associate (slab => fields%own_slab, series => results%solver%surface%shape)
         allocate (shape(slab%points(1), slab%columns()))
         call transform%start(slab%points, series%is_even())
         call transform%sample(series, shape)
         ! Of a quarter of the cell the mirror images follow.
         image = image_of_point([(k, k=1, size(image))], slab%points(1), size(image) > slab%points(1))
         do l = 1, map%points(2)
            column = image_of_point(l, slab%points(2), map%points(2) > slab%points(2))
            is_own = column >= slab%first .and. column <= slab%last
            if (is_own) then
               associate (own => shape(:, column - slab%first + 1))
                  call fields%at_own_column(column, own, p, u, gap)
                  values = row_of(results, p(image), gap(image), u(image), own(image))
               end associate
            end if
            call results%sharing%share_numbers(is_own, values)
            call map%put_row([load], l, values)
         end do
      end associate
   end subroutine put_distributed

   !> The numbers of a row of points, in the deck's units.
   pure function row_of(results, p, gap, u, shape) result(values)
      type(results_type), intent(in) :: results
      real(dp), intent(in) :: p(:), gap(:), u(:)   !! p/p*, gap/Delta and u/Delta
      real(dp), intent(in) :: shape(:)             !! 1 - h/Delta
      real(dp) :: values(size(columns) - 3, size(p))

      values(1, :) = results%scene%p_star*p
      values(2, :) = results%solver%surface%amplitude*gap
      values(3, :) = results%solver%surface%amplitude*u
      values(4, :) = results%solver%surface%amplitude*(1.0_dp - shape)
   end function row_of

end module wavycon_map_table
