!> <case>.theory_lines.dat: closed forms along the lines of <case>.lines.dat.
!>
!> In 1-D Westergaard's solution and the Dundurs-Tsai-Keer series with as many terms as the solver's; in 2-D the Hertz
!> pressure about the nearest crest (light load), and the pressure and the opening of the penny-shaped crack about the
!> nearest trough (heavy load).
module wavycon_theory_lines_table
   use wavycon_constants, only: pi
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_light_load, only: hertz_point_pressure_over_pstar
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_penny_crack, only: penny_crack_opening_over_amplitude, penny_crack_pressure_over_pstar, &
      penny_crack_radius_over_wavelength
   use wavycon_results, only: not_a_number, results_type
   use wavycon_scene, only: scene_type
   use wavycon_surface_lines, only: put_surface_line, start_surface_line, surface_line
   use wavycon_table, only: table_type
   use wavycon_theory_table, only: refuse_other_waves
   use wavycon_westergaard, only: westergaard_displacement_over_amplitude, westergaard_gap_over_amplitude, &
      westergaard_pressure_over_pstar
   implicit none (type, external)
   private

   public :: theory_lines_table

   character(45), parameter :: columns(*) = [character(45) :: &
      'load[-]', 'line[-]', 'distance[length]', 'x[length]', 'y[length]', 'pbar_over_pstar[-]', &
      'westergaard_pressure_over_pstar[-]', 'westergaard_displacement_over_amplitude[-]', &
      'westergaard_gap_over_amplitude[-]', 'dundurs_pressure_over_pstar[-]', 'hertz_pressure_over_pstar[-]', &
      'crack_pressure_over_pstar[-]', 'crack_gap_over_amplitude[-]']
   !> The closed forms of the wave in one dimension, and of that in two. Those of the other are NaN.
   integer, parameter :: closed_forms(2) = [4, 3]

contains

   type(table_type) function theory_lines_table() result(table)
      table%file = 'theory_lines'
      table%meaning = 'Closed forms along lines.'
      call table%set_columns(columns)
      table%requested => asks_for_lines_and_theory
      table%refuse => refuse_other_waves
      table%put_load => put_theory_lines
   end function theory_lines_table

   logical function asks_for_lines_and_theory(scene) result(asks)
      type(scene_type), intent(in) :: scene

      asks = scene%output%logical('lines') .and. scene%output%logical('theory')
   end function asks_for_lines_and_theory

   subroutine put_theory_lines(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(surface_line) :: line
      real(dp) :: dundurs(series_terms(results)), phi, theta
      real(dp), allocatable :: values(:, :)
      integer :: k, number

      call results%begin_block(file, load)
      associate (surface => results%solver%surface, load_p => results%loads(load)%pbar_over_pstar)
         if (surface%dimension == 1) dundurs = dundurs_coefficients(load_p, size(dundurs))
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            allocate (values(sum(closed_forms), 0:ubound(line%distance, 1)), source=not_a_number())
            do k = 0, ubound(values, 2)
               call surface%paper_angles(line%angle(1, k), line%angle(2, k), phi, theta)
               if (surface%dimension == 1) then
                  values(:closed_forms(1), k) = [westergaard_pressure_over_pstar(phi/2, load_p), &
                                                 westergaard_displacement_over_amplitude(phi/2, load_p), &
                                                 westergaard_gap_over_amplitude(phi/2, load_p), &
                                                 dundurs_pressure_over_pstar(phi, load_p, dundurs)]
               else
                  values(closed_forms(1) + 1:, k) = &
                     [hertz_point_pressure_over_pstar(nearest_crest(phi, theta), load_p), &
                      crack_pressure(nearest_crest(phi - pi, theta), load_p), &
                      crack_opening(nearest_crest(phi - pi, theta), load_p)]
               end if
            end do
            call put_surface_line(line, results, load, values, file)
            deallocate (values)
         end do
      end associate
   end subroutine put_theory_lines

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

end module wavycon_theory_lines_table
