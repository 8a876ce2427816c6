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
      real(dp), allocatable :: gap(:), p(:), shape(:), u(:), values(:, :)
      integer :: number

      call results%begin_block(file, load)
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         call results%loads(load)%fields(surface, fields)
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            associate (n => ubound(line%distance, 1))
               allocate (values(7, 0:n), p(0:n), u(0:n), gap(0:n))
               shape = surface%shape%on_line(line%angle(:, 0), line%direction, line%parameter()) &
                       - surface%form_gap(line%angle(1, :), line%angle(2, :))
            end associate
            call fields%at_points(line%angle, shape, p, u, gap)
            values(1, :) = results%in_p_star(p)
            values(2, :) = u
            values(3, :) = gap
            values(4, :) = 1.0_dp - shape
            values(5, :) = p_star*p
            values(6, :) = surface%amplitude*u
            values(7, :) = surface%amplitude*gap
            call put_surface_line(line, results, load, values, file)
            deallocate (values, p, u, gap)
         end do
      end associate
   end subroutine put_lines

end module wavycon_lines_table
