!> <case>.lines.dat: pressure, displacement and gap along lines, a block for each load with a blank line between lines;
!> and these lines, for other tables.
!>
!> Line 1 runs from a crest along x; in 2-D line 2 runs from the same crest along the diagonal of the cell, and line 3,
!> which only sections of stresses use, along y. Lines end after half a cell if the surface has a mirror line there,
!> otherwise after a whole cell. Of a mirrored height map they run through the crest from border to border of the map.
module wavycon_line_tables
   use wavycon_constants, only: pi
   use wavycon_contact_fields, only: contact_fields
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: line_tables, put_surface_line, start_surface_line, surface_line

   !> Columns of a line, before those of its values.
   character(*), parameter, public :: line_columns = &
      'load[#] line[#] distance[length] x[length] y[length] pbar_over_pstar[-]'

   type :: surface_line
      integer :: number = 0
      integer :: direction(2) = 0             !! of the line in X, Y
      real(dp), allocatable :: angle(:, :)    !! X, Y of each point, shape (2, n) [rad]
      real(dp), allocatable :: distance(:)    !! from the first point, shape (n) [length]
      real(dp), allocatable :: t(:)           !! the angles are those of the first point and t times the direction [rad]
   end type surface_line

contains

   !> The tables of this file.
   function line_tables() result(tables)
      type(table_type) :: tables(1)

      tables(1) = table_type('lines', 'lines', needs_fields=.true., put_load=put_lines, &
         columns=line_columns//' pressure_over_pstar[-] displacement_over_amplitude[-] '// &
         'gap_over_amplitude[-] undeformed_gap_over_amplitude[-] pressure[pressure] displacement[length] gap[length]', &
         meaning='Pressures and gaps along lines.')
   end function line_tables

   subroutine put_lines(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      type(surface_line) :: line
      real(dp), allocatable :: gap(:), p(:), shape(:), u(:)
      integer :: number

      call results%begin_block(file, load)
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         call results%loads(load)%fields(surface, fields)
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            allocate (p, u, gap, mold=line%t)
            shape = surface%shape%on_line(line%angle(:, 0), line%direction, line%t) &
                    - surface%form%gap(line%angle(1, :), line%angle(2, :))
            if (surface%has_steps) shape = surface%shape_at(line%angle(1, :), line%angle(2, :))
            call fields%at_points(line%angle, shape, p, u, gap)
            call put_surface_line(line, results, load, transpose(reshape( &
               [results%in_p_star(p), u, gap, 1.0_dp - shape, p_star*p, surface%amplitude*u, surface%amplitude*gap], &
               [size(p), 7])), file)
            deallocate (p, u, gap)
         end do
      end associate
   end subroutine put_lines

   subroutine start_surface_line(line, results, number)
      type(surface_line), intent(out) :: line
      type(results_type), intent(in) :: results
      integer, intent(in) :: number             !! of the line: 1, or in 2-D 2 or 3

      real(dp) :: start(2), way(2)
      integer :: before, intervals, k

      line%number = number
      intervals = nint(results%scene%output%line_points%number)
      line%direction = [merge(0, 1, number == 3), merge(0, 1, number == 1)]
      associate (surface => results%solver%surface)
         way = 2*pi*line%direction/(surface%parts()*intervals)
         start = surface%crest
         if (surface%mirrored) then
            before = steps_before(surface%crest, way)
            intervals = before + steps_before(pi - surface%crest, way)
            start = surface%crest - before*way
         else if (surface%shape%is_even() .and. all(abs(surface%crest) <= 0.0_dp)) then
            intervals = intervals/2
         end if
         allocate (line%angle(2, 0:intervals), line%distance(0:intervals), line%t(0:intervals))
         do k = 0, intervals
            line%angle(:, k) = start + k*way
            line%distance(k) = norm2(surface%length*k*way)/(2*pi)
            line%t(k) = maxval(line%angle(:, k) - start)
         end do
      end associate
   end subroutine start_surface_line

   !> Writes a row for each point of a line: load, line, distance, x, y, mean pressure and values. A blank line is
   !> between the lines of a load.
   subroutine put_surface_line(line, results, load, values, file)
      type(surface_line), intent(in) :: line
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      real(dp), intent(in) :: values(:, 0:)      !! at the points, shape (columns, n)
      type(output_file), intent(inout) :: file

      integer :: k

      if (line%number > 1) call file%put('')
      do k = 0, ubound(values, 2)
         call file%put_row([real(dp) :: load, line%number, line%distance(k), &
                            results%solver%surface%length*line%angle(:, k)/(2*pi), &
                            results%in_p_star(results%loads(load)%pbar_over_pstar), values(:, k)])
      end do
   end subroutine put_surface_line

   !> How many steps fit into a way to the border of a mirrored map.
   pure integer function steps_before(to_border, way)
      real(dp), intent(in) :: to_border(2)   !! along X and Y [rad]
      real(dp), intent(in) :: way(2)         !! a step [rad]; 0 in a direction in which the line does not go

      !> A point so close behind the border, in steps, is on it but for rounding.
      real(dp), parameter :: rounding = 1e-9_dp

      real(dp) :: steps(2)

      steps = huge(steps_before)
      where (way > 0.0_dp) steps = to_border/way
      steps_before = floor(minval(steps) + rounding)
   end function steps_before

end module wavycon_line_tables
