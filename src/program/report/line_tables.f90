!> <case>.lines.dat: pressure, displacement and gap along lines, a block for each load with a blank line between lines.
!> Other tables take the points of these lines from here too.
!>
!> Line 1 runs from a crest along x. In 2-D line 2 runs from the same crest along the diagonal of the cell, and line 3,
!> which only sections of stresses use, along y. A line ends after half a cell if the surface has a mirror line there,
!> otherwise after a whole cell. On a mirrored height map a line runs through the crest from border to border of the
!> map.
module wavycon_line_tables
   use wavycon_contact_fields, only: contact_fields
   use wavycon_kinds, only: dp, pi
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: line_tables, put_surface_line, start_surface_line, surface_line

   !> Columns of tables along lines, before the columns of the values.
   character(*), parameter, public :: line_columns = &
      'load[#] line[#] distance[length] x[length] y[length] pbar_over_pstar[-]'

   type :: surface_line
      integer :: number = 0                   !! 1: along x, 2: along the diagonal, 3: along y
      integer :: direction(2) = 0             !! direction in X, Y; components are 0 or 1
      real(dp), allocatable :: angle(:, :)    !! X, Y of each point, shape (2, 0:n - 1) [rad]
      real(dp), allocatable :: distance(:)    !! distance of each point from the first, shape (0:n - 1) [length]
      !> Parameter along the line, shape (0:n - 1) [rad]: angle(:, k) = angle(:, 0) + t(k)*direction.
      real(dp), allocatable :: t(:)
   end type surface_line

contains

   !> The table <case>.lines.dat.
   function line_tables() result(tables)
      type(table_type) :: tables(1)

      tables(1) = table_type('lines', 'lines', needs_fields=.true., put_load=put_lines, &
         columns=line_columns//' pressure_over_pstar[-] displacement_over_amplitude[-] '// &
         'gap_over_amplitude[-] undeformed_gap_over_amplitude[-] pressure[pressure] displacement[length] gap[length]', &
         meaning='Pressures and gaps along lines.')
   end function line_tables

   !> Writes the block of a load.
   subroutine put_lines(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      type(surface_line) :: line
      real(dp), allocatable :: gap(:), p(:), u(:)
      real(dp), allocatable :: height(:)   ! 1 - h/Delta, h being the undeformed gap
      integer :: number

      call results%begin_block(file, load)
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         call results%loads(load)%fields(surface, fields)
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            allocate (p, u, gap, mold=line%t)
            height = surface%shape%on_line(line%angle(:, 0), line%direction, line%t) &
                    - surface%form%gap(line%angle(1, :), line%angle(2, :))
            if (surface%has_steps) height = surface%shape_at(line%angle(1, :), line%angle(2, :))
            call fields%at_points(line%angle, height, p, u, gap)
            call put_surface_line(line, results, load, transpose(reshape( &
               [results%in_p_star(p), u, gap, 1.0_dp - height, p_star*p, surface%amplitude*u, surface%amplitude*gap], &
               [size(p), 7])), file)
            deallocate (p, u, gap)
         end do
      end associate
   end subroutine put_lines

   !> Sets the points of a line, which are equally spaced.
   subroutine start_surface_line(line, results, number)
      type(surface_line), intent(out) :: line
      type(results_type), intent(in) :: results
      integer, intent(in) :: number             !! number of the line: 1, in 2-D also 2 or 3

      real(dp) :: first(2), step(2)   ! X, Y of the first point, and their change from point to point [rad]
      integer :: intervals, k, to_crest

      line%number = number
      intervals = nint(results%scene%output%line_points%number)
      line%direction = 1
      if (number == 3) line%direction(1) = 0
      if (number == 1) line%direction(2) = 0
      associate (surface => results%solver%surface)
         step = 2*pi*line%direction/(surface%maps_in_cell()*intervals)
         first = surface%crest
         if (surface%mirrored) then
            to_crest = steps_within(surface%crest, step)
            intervals = to_crest + steps_within(pi - surface%crest, step)
            first = surface%crest - to_crest*step
         else if (surface%shape%is_even() .and. all(abs(surface%crest) <= 0.0_dp)) then
            intervals = intervals/2
         end if
         allocate (line%angle(2, 0:intervals), line%distance(0:intervals), line%t(0:intervals))
         do k = 0, intervals
            line%angle(:, k) = first + k*step
            line%distance(k) = norm2(surface%length*k*step)/(2*pi)
            line%t(k) = maxval(line%angle(:, k) - first)
         end do
      end associate
   end subroutine start_surface_line

   !> Writes a row for each point of a line: load, line, distance, x, y, mean pressure and the values. A blank line
   !> separates the lines of a load.
   subroutine put_surface_line(line, results, load, values, file)
      type(surface_line), intent(in) :: line
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      real(dp), intent(in) :: values(:, 0:)      !! values at the points, shape (columns, n)
      type(output_file), intent(inout) :: file

      integer :: k

      if (line%number > 1) call file%put('')
      do k = 0, ubound(values, 2)
         call file%put_row([real(dp) :: load, line%number, line%distance(k), &
                            results%solver%surface%length*line%angle(:, k)/(2*pi), &
                            results%in_p_star(results%loads(load)%pbar_over_pstar), values(:, k)])
      end do
   end subroutine put_surface_line

   !> How many steps of a line fit between its crest and a border of a mirrored map.
   pure integer function steps_within(to_border, step)
      real(dp), intent(in) :: to_border(2)   !! distances to the borders along X and Y, >= 0 [rad]
      real(dp), intent(in) :: step(2)        !! change of X and Y in a step, >= 0 [rad]

      !> A point that is behind the border by less than this part of a step is taken as on the border: it is rounding.
      real(dp), parameter :: rounding = 1e-9_dp

      real(dp) :: steps(2)

      steps = huge(steps_within)
      where (step > 0.0_dp) steps = to_border/step
      steps_within = floor(minval(steps) + rounding)
   end function steps_within

end module wavycon_line_tables
