!> <case>.lines.dat: pressure, displacement and gap along lines, a block for each load.
!>
!> Line 1 runs from a crest along x; in 2-D line 2 runs from the same crest along the diagonal of the cell, after a
!> blank line. Lines end after half a cell if the surface has a mirror line there, otherwise after a whole cell. With
!> `theory` further columns hold closed forms: in 1-D Westergaard's solution and the Dundurs-Tsai-Keer series with as
!> many terms as the solver's; in 2-D the Hertz pressure about the nearest crest (light load), and the pressure and
!> the opening of the penny-shaped crack about the nearest trough (heavy load).
module wavycon_lines_table
   use wavycon_constants, only: pi
   use wavycon_contact_fields, only: contact_fields
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_error, only: error_type
   use wavycon_hertz_point, only: hertz_point_pressure_over_pstar
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_penny_crack, only: penny_crack_opening_over_amplitude, penny_crack_pressure_over_pstar, &
                                  penny_crack_radius_over_wavelength
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   use wavycon_westergaard, only: westergaard_displacement_over_amplitude, westergaard_gap_over_amplitude, &
                                  westergaard_pressure_over_pstar
   implicit none (type, external)
   private

   public :: lines_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'pbar_over_pstar[-]', 'line[-]', 'distance[length]', 'x[length]', 'y[length]', 'pressure_over_pstar[-]', &
      'displacement_over_amplitude[-]', 'gap_over_amplitude[-]']
   character(40), parameter :: columns_1d(*) = [character(40) :: &
      'westergaard_pressure[p*]', 'westergaard_displace[Delta]', 'westergaard_gap[Delta]', 'dundurs_pressure[p*]']
   character(40), parameter :: columns_2d(*) = [character(40) :: &
      'hertz_pressure[p*]', 'crack_pressure[p*]', 'crack_opening[Delta]']

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

      call results%open_table('lines', file)
      if (.not. results%scene%output%logical('theory')) then
         call file%put_columns(columns)
      else if (results%scene%surface%dimension == 1) then
         call file%put_columns([columns, columns_1d])
      else
         call file%put_columns([columns, columns_2d])
      end if
      do load = 1, size(results%loads)
         call results%put_load_heading(file, load, first=load == 1)
         call results%loads(load)%solution%fields(results%scene%surface, fields)
         do line = 1, results%scene%surface%dimension
            if (line > 1) call file%put('')
            call put_line(results, file, load, line, fields)
         end do
      end do
      call file%finish(error)
   end subroutine write_lines_table

   !> Writes one line of one load.
   subroutine put_line(results, file, load, line, fields)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load, line
      class(contact_fields), intent(inout) :: fields   !! of the load

      real(dp), allocatable :: beside(:)
      real(dp) :: dundurs(series_terms(results)), start(2), way(2), angles(2), phi, theta, p, u, gap, load_p
      integer :: k, intervals

      load_p = results%loads(load)%solution%pbar_over_pstar
      dundurs = 0.0_dp
      if (results%scene%output%logical('theory') .and. results%scene%surface%dimension == 1) &
         dundurs = dundurs_coefficients(load_p, size(dundurs))
      intervals = results%scene%output%integer('points_per_wavelength')
      associate (surface => results%scene%surface)
         start = surface%crest
         if (surface%shape%is_even() .and. all(abs(start) <= 0.0_dp)) intervals = intervals/2
         way = 2*pi*[1, merge(1, 0, line == 2)]/results%scene%output%integer('points_per_wavelength')
         do k = 0, intervals
            angles = start + k*way
            call surface%paper_angles(angles(1), angles(2), phi, theta)
            call fields%at(angles(1), angles(2), p, u, gap)
            if (.not. results%scene%output%logical('theory')) then
               beside = [real(dp) ::]
            else if (surface%dimension == 1) then
               beside = [westergaard_pressure_over_pstar(phi/2, load_p), &
                         westergaard_displacement_over_amplitude(phi/2, load_p), &
                         westergaard_gap_over_amplitude(phi/2, load_p), &
                         dundurs_pressure_over_pstar(phi, load_p, dundurs)]
            else
               beside = [hertz_point_pressure_over_pstar(nearest_crest(phi, theta), load_p), &
                         crack_pressure(nearest_crest(phi - pi, theta), load_p), &
                         crack_opening(nearest_crest(phi - pi, theta), load_p)]
            end if
            call file%add(load_p)
            call file%add(line)
            call file%add([norm2(surface%length*k*way)/(2*pi), surface%length*angles/(2*pi), &
                           p, u, gap, beside])
            call file%end_row()
         end do
      end associate
   end subroutine put_line

   !> Number of terms of the Dundurs-Tsai-Keer series: as many as the solver's series has, otherwise as in the paper.
   pure integer function series_terms(results)
      type(results_type), intent(in) :: results

      integer, parameter :: terms_of_the_paper = 10

      series_terms = terms_of_the_paper
      if (results%scene%method%in_effect('harmonics')) series_terms = results%scene%method%integer('harmonics')
   end function series_terms

   !> Distance of a point from the nearest crest of the wave (21), over its wavelength. With phi - pi for phi, from the
   !> nearest trough.
   pure real(dp) function nearest_crest(phi, theta)
      real(dp), intent(in) :: phi, theta

      nearest_crest = min(hypot(reduced(phi), reduced(theta)), hypot(reduced(phi - pi), reduced(theta - pi)))/(2*pi)
   end function nearest_crest

   !> An angle between -pi and pi.
   elemental real(dp) function reduced(angle)
      real(dp), intent(in) :: angle

      reduced = angle - 2*pi*nint(angle/(2*pi))
   end function reduced

   !> Pressure in the penny-shaped crack over p*, (A4); zero outside the crack.
   pure real(dp) function crack_pressure(r_over_wavelength, pbar_over_pstar) result(pressure)
      real(dp), intent(in) :: r_over_wavelength, pbar_over_pstar

      pressure = 0.0_dp
      if (r_over_wavelength < penny_crack_radius_over_wavelength(pbar_over_pstar)) &
         pressure = penny_crack_pressure_over_pstar(r_over_wavelength, pbar_over_pstar)
   end function crack_pressure

   !> Opening of the penny-shaped crack over Delta, (A6); zero outside the crack and if there is none.
   pure real(dp) function crack_opening(r_over_wavelength, pbar_over_pstar) result(opening)
      real(dp), intent(in) :: r_over_wavelength, pbar_over_pstar

      real(dp) :: b

      b = penny_crack_radius_over_wavelength(pbar_over_pstar)
      opening = 0.0_dp
      if (r_over_wavelength < b) &
         opening = penny_crack_opening_over_amplitude(r_over_wavelength/b, b, pbar_over_pstar)
   end function crack_opening

end module wavycon_lines_table
