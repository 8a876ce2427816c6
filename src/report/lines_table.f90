!> <case>.lines.dat: pressure, displacement and gap along lines, a block for each load with a blank line between lines.
module wavycon_lines_table
   use wavycon_contact_fields, only: contact_fields
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_surface_lines, only: put_surface_line, start_surface_line, surface_line
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: lines_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'line[-]', 'distance[length]', 'x[length]', 'y[length]', 'pbar_over_pstar[-]', &
      'pressure_over_pstar[-]', 'displacement_over_amplitude[-]', 'gap_over_amplitude[-]', &
      'undeformed_gap_over_amplitude[-]', 'pressure[pressure]', 'displacement[length]', 'gap[length]']

contains

   type(table_type) function lines_table() result(table)
      table%file = 'lines'
      table%key = 'lines'
      table%meaning = 'Pressures and gaps along lines.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%put_load => put_lines
   end function lines_table

   subroutine put_lines(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      type(surface_line) :: line
      real(dp) :: gap, p, u
      real(dp), allocatable :: values(:, :)
      integer :: k, number

      call results%begin_block(file, load)
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         call results%loads(load)%fields(surface, fields)
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            allocate (values(7, 0:ubound(line%distance, 1)))
            do k = 0, ubound(values, 2)
               associate (x => line%angle(1, k), y => line%angle(2, k))
                  call fields%at(x, y, p, u, gap)
                  values(:, k) = [p, u, gap, surface%undeformed_gap_over_amplitude(x, y), &
                                  p_star*p, surface%amplitude*u, surface%amplitude*gap]
               end associate
            end do
            call put_surface_line(line, results, load, values, file)
            deallocate (values)
         end do
      end associate
   end subroutine put_lines

end module wavycon_lines_table
