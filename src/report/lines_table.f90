!> <case>.lines.dat: pressure, displacement and gap along lines, a block for each load with a blank line between lines.
module wavycon_lines_table
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_surface_lines, only: start_surface_line, surface_line
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: lines_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'line[-]', 'distance[length]', 'x[length]', 'y[length]', 'pbar_over_pstar[-]', &
      'pressure_over_pstar[-]', 'displacement_over_amplitude[-]', 'gap_over_amplitude[-]', &
      'undeformed_gap_over_amplitude[-]', 'pressure[pressure]', 'displacement[length]', 'gap[length]']

   type, extends(table_type) :: lines_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure, nopass :: write => write_lines_table
   end type lines_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'lines'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Pressures and gaps along lines.'
   end function meaning

   pure logical function needs_fields(self)
      class(lines_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_lines_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      class(contact_fields), allocatable :: fields
      integer :: load, line

      call results%open_table('lines', columns, file, in_blocks=.true.)
      do load = 1, size(results%loads)
         call results%begin_block(file, load)
         call results%loads(load)%fields(results%solver%surface, fields)
         do line = 1, results%solver%surface%dimension
            if (line > 1) call file%put('')
            call put_line(results, file, load, line, fields)
         end do
      end do
      call file%finish(error)
   end subroutine write_lines_table

   !> Writes one line of one load.
   subroutine put_line(results, file, load, number, fields)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load, number
      class(contact_fields), intent(inout) :: fields   !! of the load

      type(surface_line) :: line
      real(dp) :: gap, p, u, undeformed_gap
      integer :: k

      call start_surface_line(line, results, number)
      associate (surface => results%solver%surface, solution => results%loads(load), &
                 p_star => results%scene%p_star)
         do k = 0, ubound(line%distance, 1)
            associate (x => line%angle(1, k), y => line%angle(2, k))
               call fields%at(x, y, p, u, gap)
               undeformed_gap = surface%undeformed_gap_over_amplitude(x, y)
            end associate
            call file%add(load)
            call file%add(number)
            call file%add([line%distance(k), line%place(:, k), solution%pbar_over_pstar, p, u, gap, undeformed_gap, &
                           p_star*p, surface%amplitude*u, surface%amplitude*gap])
            call file%end_row()
         end do
      end associate
   end subroutine put_line

end module wavycon_lines_table
