!> <case>.height.npy: the heights of the surface that was solved, for numpy and for kind = 'file'.
module wavycon_height_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_cell_file, only: check_memory, map_points
   use wavycon_error, only: error_type
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_npy_header, only: npy_header
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_shared_file, only: shared_file
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: height_table

   !> Numbers for each point: the height and its spectrum.
   integer, parameter :: numbers_a_point = 2

   !> Columns of the table in memory.
   character(16), parameter :: columns(*) = [character(16) :: 'x[length]', 'y[length]', 'height[length]']

contains

   type(table_type) function height_table() result(table)
      table%file = 'height'
      table%key = 'height'
      table%meaning = "The heights that are solved, as a file of numpy that kind = 'file' reads."
      call table%set_columns(columns)
      table%written_by_all => is_written_by_all
      table%write_all => write_height_table
   end function height_table

   !> All ranks write the heights of a map that is distributed over them.
   logical function is_written_by_all(results)
      type(results_type), intent(in) :: results

      is_written_by_all = results%solver%surface%is_distributed()
   end function is_written_by_all

   !> Writes rows of heights along x, over their mean [length]: of a map at its own points, of waves at those of maps.
   !> A table in memory has their places too. Errors: exit_file_trouble.
   subroutine write_height_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      real(dp), allocatable :: height(:, :)
      integer :: points(2)
      real(dp) :: first

      if (results%solver%surface%is_distributed()) then
         call write_by_all(results, error)
         return
      end if
      associate (surface => results%solver%surface)
         points = surface%points/surface%parts()
         if (all(points == 0)) points = map_points(results)
         if (associated(results%memory)) then
            call results%open_table('height', columns, file)
         else
            call file%open(results%scene%directory, results%scene%case//'.height.npy', npy_header(points([2, 1])))
         end if
         call check_memory(file, points, numbers_a_point, '')
         if (file%is_open()) then
            first = merge(0.5_dp, 0.0_dp, surface%mirrored)
            call surface%sample_shape(points, [first, first], height)
            height = surface%amplitude*height
            if (.not. associated(results%memory)) call file%put_numbers(height)
            if (associated(results%memory)) call put_places(height, surface%sides(), first, file)
         end if
      end associate
      call file%finish(error)
   end subroutine write_height_table

   !> Writes a row of the table in memory for each point.
   subroutine put_places(height, sides, first, file)
      real(dp), intent(in) :: height(:, :), sides(2)   !! [length]
      real(dp), intent(in) :: first                    !! place of the first point along both directions, in steps
      type(output_file), intent(inout) :: file

      integer :: k, l

      do l = 1, size(height, 2)
         do k = 1, size(height, 1)
            call file%add([sides*([k, l] - 1 + first)/shape(height), height(k, l)])
            call file%end_row()
         end do
      end do
   end subroutine put_places

   !> Writes the heights at the points of a map that is distributed over the ranks. Errors: exit_file_trouble.
   subroutine write_by_all(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(shared_file) :: file
      type(grid_slab) :: slab
      type(grid_transform) :: transform
      real(dp), allocatable :: height(:, :)

      associate (surface => results%solver%surface)
         call slab%start(surface%points/surface%parts())
         allocate (height(slab%points(1), slab%columns()))
         call transform%start(slab%points, surface%shape%is_even())
         call transform%sample(surface%shape, height)
         height = surface%amplitude*height
      end associate
      call file%open(results%scene%directory, results%scene%case//'.height.npy', &
                     npy_header(slab%points([2, 1])))
      call file%put_columns(0_int64, slab%points(1), slab%first, slab%columns(), height)
      call file%finish(error)
   end subroutine write_by_all

end module wavycon_height_table
