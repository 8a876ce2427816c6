!> <case>.map.dat: the fields over one cell, a block for each load with a blank line between rows (gnuplot's grid
!> format).
module wavycon_map_table
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_surface, only: gap_over_amplitude
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

   !> Writes the map of a load. The first and the last point of a row are both written: each side has
   !> points_per_wavelength intervals.
   subroutine put_map(results, file, load)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load

      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: p(:, :), shape(:, :), u(:, :)
      real(dp) :: approach
      integer :: k, l, n

      n = results%scene%output%integer('points_per_wavelength')
      associate (surface => results%scene%surface, solution => results%loads(load)%solution)
         approach = solution%measures%approach_over_amplitude
         call solution%fields(surface, fields)
         call fields%on_cell(n, surface%dimension, p, u)
         call surface%shape%evaluate_on_cell(n, shape)
         do l = 0, merge(n, 0, surface%dimension == 2)
            if (l > 0) call file%put('')
            do k = 0, n
               call file%add(load)
               call file%add([surface%length(1)*k/n, surface%length(2)*l/n, results%scene%p_star*p(k, l), &
                              surface%amplitude*[gap_over_amplitude(1.0_dp - shape(k, l), u(k, l), approach), &
                                                 u(k, l), 1.0_dp - shape(k, l)]])
               call file%end_row()
            end do
         end do
      end associate
   end subroutine put_map

end module wavycon_map_table
