!> <case>.map.dat: the fields over one cell, a block for each load with a blank line between rows (gnuplot's grid
!> format).
module wavycon_map_table
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_series_samples, only: sample_series
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: map_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'x[length]', 'y[length]', 'pressure[pressure]', 'gap[length]', 'displacement[length]', &
      'undeformed_gap[length]']

   type, extends(table_type) :: map_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
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

   !> Errors: exit_file_trouble.
   subroutine write_map_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: load

      call results%open_table('map', columns, file, in_blocks=.true.)
      do load = 1, size(results%loads)
         call results%begin_block(file, load)
         call put_map(results, file, load)
      end do
      call file%finish(error)
   end subroutine write_map_table

   !> Writes the map of a load. The point after the last of a row is the first again and is not written.
   subroutine put_map(results, file, load)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load

      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: gap(:, :), p(:, :), shape(:, :), u(:, :)
      integer :: k, l, points(2)

      points = results%scene%output%integer('points_per_wavelength')
      associate (surface => results%scene%surface, solution => results%loads(load)%solution)
         if (surface%dimension == 1) points(2) = 1
         call solution%fields(surface, fields)
         call fields%on_grid(points, [0.0_dp, 0.0_dp], p, u, gap)
         call sample_series(surface%shape, points, [0.0_dp, 0.0_dp], shape)
         do l = 1, points(2)
            if (l > 1) call file%put('')
            do k = 1, points(1)
               call file%add(load)
               call file%add([surface%length*([k, l] - 1)/points, results%scene%p_star*p(k, l), &
                              surface%amplitude*[gap(k, l), u(k, l), 1.0_dp - shape(k, l)]])
               call file%end_row()
            end do
         end do
      end associate
   end subroutine put_map

end module wavycon_map_table
