!> <case>.theory.dat: closed forms at the loads of the scene, a row for each load. For a ball, and for a map with free
!> edges on a ball, these are Hertz's contact of the ball. In 1-D they are the exact solution (eqs. 4, 7, 20) and its
!> limits (8), (11). In 2-D they are the asymptotes (23), (24), (29), (30) of the paper; (29) with the coefficient of
!> the whole lattice; asymptotes with further terms; and the radii of the contact spot at light load and of the crack at
!> heavy load.
!>
!> <case>.theory_lines.dat: closed forms along the lines of <case>.lines.dat. In 1-D they are Westergaard's solution and
!> the Dundurs-Tsai-Keer series with as many terms as the solver's series. In 2-D they are the Hertz pressure about the
!> nearest crest (light load), and the pressure and the opening of the penny-shaped crack about the nearest trough
!> (heavy load).
module wavycon_theory_tables
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_free_edges, only: ball_radii
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact, hertz_roller
   use wavycon_kinds, only: dp, not_a_number, pi
   use wavycon_line_tables, only: line_columns, put_surface_line, start_surface_line, surface_line
   use wavycon_output_file, only: output_file
   use wavycon_paper_wave, only: paper_angles, paper_wavelength
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   use wavycon_wave_2d_limits, only: hertz_point_contact_area_fraction, hertz_point_peak_pressure_over_pstar, &
      hertz_point_pressure_over_pstar, hertz_point_radius_over_wavelength, light_load_contact_area_longer, &
      light_load_mean_gap_lattice, light_load_mean_gap_longer, light_load_mean_gap_one_square, &
      near_closure_contact_area_fraction, near_closure_mean_gap_over_amplitude, penny_crack_contact_area_fraction, &
      penny_crack_mean_gap_over_amplitude, penny_crack_opening_over_amplitude, penny_crack_pressure_over_pstar, &
      penny_crack_radius_over_wavelength
   use wavycon_westergaard, only: hertz_line_contact_area_fraction, kuznetsov_mean_gap_over_amplitude, &
      line_crack_contact_area_fraction, westergaard_contact_area_fraction, westergaard_displacement_over_amplitude, &
      westergaard_gap_over_amplitude, westergaard_peak_pressure_over_pstar, westergaard_pressure_over_pstar
   implicit none (type, external)
   private

   public :: theory_tables

contains

   !> The tables of this file.
   function theory_tables() result(tables)
      type(table_type) :: tables(2)

      tables(1) = table_type('theory', 'theory', put_load=put_theory, &
         columns='load[#] pbar_over_pstar[-] force[force] '// &
         'kuznetsov_mean_gap_over_amplitude[-] westergaard_contact_area_fraction[-] '// &
         'westergaard_peak_pressure_over_pstar[-] hertz_line_contact_area_fraction[-] '// &
         'line_crack_contact_area_fraction[-] '// &
         'hertz_contact_area_fraction[-] crack_contact_area_fraction[-] light_eq29_mean_gap_over_amplitude[-] '// &
         'light_lattice_mean_gap_over_amplitude[-] crack_mean_gap_over_amplitude[-] '// &
         'light_longer_contact_area_fraction[-] light_longer_mean_gap_over_amplitude[-] '// &
         'closure_longer_contact_area_fraction[-] closure_longer_mean_gap_over_amplitude[-] '// &
         'hertz_peak_pressure_over_pstar[-] hertz_radius[length] crack_radius[length] '// &
         'ball_contact_area[area] ball_approach[length] ball_peak_pressure[pressure] ball_half_axis_x[length] '// &
         'ball_half_axis_y[length]', &
         meaning='The closed forms beside the numbers.')
      tables(2) = table_type('theory_lines', asked_by=[character(16) :: 'lines', 'theory'], &
         put_load=put_theory_lines, &
         columns=line_columns//' westergaard_pressure_over_pstar[-] '// &
         'westergaard_displacement_over_amplitude[-] westergaard_gap_over_amplitude[-] '// &
         'dundurs_pressure_over_pstar[-] hertz_pressure_over_pstar[-] crack_pressure_over_pstar[-] '// &
         'crack_gap_over_amplitude[-]')
   end function theory_tables

   !> Writes the row of a load. Closed forms that do not exist for the surface are NaN.
   subroutine put_theory(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(hertz_ball) :: contact
      !> Contact area, approach, peak pressure and half axes of Hertz's contact of the ball.
      real(dp) :: of_ball(5)
      real(dp) :: of_line(5), of_plane(12)   ! columns of waves in 1-D and in 2-D
      real(dp) :: roller(2)                  ! half width and peak pressure of Hertz's line contact
      real(dp) :: force, radii(2)

      of_ball = not_a_number()
      of_line = not_a_number()
      of_plane = not_a_number()
      force = results%solver%surface%nominal_area()*results%mean_pressure(load)
      associate (p => results%loads(load)%pbar_over_pstar, surface => results%solver%surface, &
                 wavelength => paper_wavelength(results%solver%surface))
         if (surface%has_free_edges) then
            radii = ball_radii(surface)
            if (surface%dimension == 1) then
               roller = hertz_roller(radii(1), results%scene%e_star, force)
               of_ball([1, 3, 4]) = [2*roller(1), roller(2), roller(1)]
            else
               contact = hertz_contact(radii, results%scene%e_star, force=force)
               of_ball = [contact%contact_area(), contact%approach, contact%peak_pressure, contact%half_axis]
            end if
         else if (surface%dimension == 1) then
            of_line = &
               [kuznetsov_mean_gap_over_amplitude(p), westergaard_contact_area_fraction(p), &
                westergaard_peak_pressure_over_pstar(p), hertz_line_contact_area_fraction(p), &
                line_crack_contact_area_fraction(p)]
         else
            of_plane = &
               [hertz_point_contact_area_fraction(p), penny_crack_contact_area_fraction(p), &
                light_load_mean_gap_one_square(p), light_load_mean_gap_lattice(p), &
                penny_crack_mean_gap_over_amplitude(p), light_load_contact_area_longer(p), &
                light_load_mean_gap_longer(p), near_closure_contact_area_fraction(p), &
                near_closure_mean_gap_over_amplitude(p), hertz_point_peak_pressure_over_pstar(p), &
                wavelength*hertz_point_radius_over_wavelength(p), &
                wavelength*penny_crack_radius_over_wavelength(p)]
         end if
         call file%put_row([real(dp) :: load, results%in_p_star(p), force, of_line, of_plane, of_ball])
      end associate
   end subroutine put_theory

   !> Writes the block of a load: the closed forms along the lines of the surface.
   subroutine put_theory_lines(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(surface_line) :: line
      real(dp) :: crack_radius, from_trough, phi, theta
      real(dp), allocatable :: dundurs(:)
      real(dp), allocatable :: values(:, :)   ! columns 1 to 4 exist in 1-D, 5 to 7 in 2-D
      integer :: k, number, terms

      ! The series has as many terms as the solver's, or 10 as in the paper.
      terms = 10
      if (results%scene%method%harmonics%in_effect) terms = nint(results%scene%method%harmonics%number)
      call results%begin_block(file, load)
      associate (surface => results%solver%surface, load_p => results%loads(load)%pbar_over_pstar)
         crack_radius = penny_crack_radius_over_wavelength(load_p)
         if (surface%dimension == 1) dundurs = dundurs_coefficients(load_p, terms)
         do number = 1, surface%dimension
            call start_surface_line(line, results, number)
            allocate (values(7, 0:ubound(line%distance, 1)), source=not_a_number())
            do k = 0, ubound(values, 2)
               call paper_angles(surface, line%angle(1, k), line%angle(2, k), phi, theta)
               if (surface%dimension == 1) then
                  values(:4, k) = [westergaard_pressure_over_pstar(phi/2, load_p), &
                                   westergaard_displacement_over_amplitude(phi/2, load_p), &
                                   westergaard_gap_over_amplitude(phi/2, load_p), &
                                   dundurs_pressure_over_pstar(phi, load_p, dundurs)]
               else
                  ! Pressure (A4) and opening (A6) of the crack are zero outside the crack.
                  from_trough = nearest_crest(phi - pi, theta)
                  values(5, k) = hertz_point_pressure_over_pstar(nearest_crest(phi, theta), load_p)
                  values(6:, k) = 0.0_dp
                  if (from_trough < crack_radius) values(6:, k) = &
                     [penny_crack_pressure_over_pstar(from_trough, load_p), &
                      penny_crack_opening_over_amplitude(from_trough/crack_radius, crack_radius, load_p)]
               end if
            end do
            call put_surface_line(line, results, load, values, file)
            deallocate (values)
         end do
      end associate
   end subroutine put_theory_lines

   !> Distance of a point from the nearest crest of the wave (21), over the wavelength. The wave has crests at phi =
   !> theta = 0 and at phi = theta = pi, and a trough at phi = pi, theta = 0: with phi - pi in place of phi the result
   !> is the distance from the nearest trough.
   pure real(dp) function nearest_crest(phi, theta)
      real(dp), intent(in) :: phi, theta   !! angles of eq. (21) [rad]

      real(dp) :: offset(4)   !! phi and theta relative to the two crests, between -pi and pi

      offset = [phi, theta, phi - pi, theta - pi]
      offset = offset - 2*pi*nint(offset/(2*pi))
      nearest_crest = min(hypot(offset(1), offset(2)), hypot(offset(3), offset(4)))/(2*pi)
   end function nearest_crest

end module wavycon_theory_tables
