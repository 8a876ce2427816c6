!> <case>.stress_planes.dat or .npy: stresses on planes below the whole cell, a block for each load, body and depth.
module wavycon_stress_planes_table
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_column_text, only: column_name
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_map_table, only: is_text, map_offset, map_points
   use wavycon_npy_header, only: npy_header
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: integer_text
   use wavycon_results, only: results_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, number_of_bodies, stress_columns, stress_depths, stress_numbers
   use wavycon_stress_table, only: stress_table_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: stress_planes_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'x[length]', 'y[length]', 'depth[length]', stress_columns]

   !> Numbers for each point of a plane: stresses, error, their spectra, and those of the solution.
   integer(int64), parameter :: numbers_a_point = 20

   type, extends(stress_table_type) :: stress_planes_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure, nopass :: write => write_stress_planes_table
   end type stress_planes_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'planes'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Stresses on planes.'
   end function meaning

   !> Errors: exit_file_trouble.
   subroutine write_stress_planes_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:)
      logical :: as_text
      integer :: body, i, load, points(2)
      real(dp) :: offset(2)

      points = map_points(results)
      call stress_depths(results%scene%stress, results%solver%surface, .true., depths)
      as_text = is_text(results%scene%output%text('map_format'), points)
      if (as_text) then
         call results%open_table('stress_planes', columns, file, in_blocks=.true.)
      else
         call file%open(results%scene%directory, results%scene%case//'.stress_planes.npy', binary=.true.)
         ! The first indices of the file's array are load, body and depth.
         call file%put_raw(npy_header(column_name(columns(3:)), &
                                      [size(results%loads), number_of_bodies(results), size(depths), &
                                       points(2), points(1)]))
      end if
      if (.not. has_memory_for(numbers_a_point*product(int(points, int64)))) call file%note_trouble( &
         'there is not enough memory for planes of '//integer_text(points(1))//' x '//integer_text(points(2))// &
         ' points')
      if (file%is_open()) offset = map_offset(results, points)
      do load = 1, size(results%loads)
         if (.not. file%is_open()) exit
         call results%loads(load)%stresses(results%solver%surface, fields)
         do body = 1, number_of_bodies(results)
            do i = 1, size(depths)
               if (as_text) call results%begin_block(file, load)
               call put_plane(results, fields, load, body, depths(i), points, offset, as_text, file)
            end do
         end do
      end do
      call file%finish(error)
   end subroutine write_stress_planes_table

   !> Writes one plane. The point after the last of a row is the first again and is not written.
   subroutine put_plane(results, fields, load, body, depth, points, offset, as_text, file)
      type(results_type), intent(in) :: results
      class(stress_fields), intent(inout) :: fields   !! of the load
      integer, intent(in) :: load, body
      real(dp), intent(in) :: depth                   !! [length]
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)               !! of the first point, in steps
      logical, intent(in) :: as_text
      type(output_file), intent(inout) :: file

      real(dp), allocatable :: errors(:, :), rows(:, :), stress(:, :, :)
      real(dp) :: here(6), side(2)
      integer :: k, l

      allocate (rows(size(columns) - 2, points(1)))
      associate (scene => results%scene, surface => results%solver%surface)
         side = surface%sides()
         call fields%on_plane(points, offset, angle_of_depth(surface, depth), scene%stress_setting%body(body), stress, &
                              errors)
         do l = 1, points(2)
            do k = 1, points(1)
               here = stress(k, l, :)
               rows(:, k) = [side*([k, l] - 1 + offset)/points, depth, &
                             stress_numbers(here, errors(k, l), scene%p_star)]
            end do
            if (as_text) then
               if (l > 1) call file%put('')
               call file%put_rows([load, body], rows)
            else
               call file%put_raw(rows)
            end if
         end do
      end associate
   end subroutine put_plane

end module wavycon_stress_planes_table
