!> <case>.theory.dat: the closed forms at the loads of the scene, a line for each load.
!>
!> Of a ball, and of a map with free edges on a ball: Hertz's contact of the ball.
!>
!> In 1-D: the exact solution (eqs. 4, 7, 20) and its limits (8), (11). In 2-D: the asymptotes (23), (24), (29), (30)
!> of the paper; (29) with the coefficient of the whole lattice; asymptotes with further terms; and the radii of the
!> contact spot at light load and of the crack at heavy load.
module wavycon_theory_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_hertz_ball, only: hertz_ball, hertz_of_force, hertz_roller
   use wavycon_hertz_line, only: hertz_line_contact_area_fraction
   use wavycon_hertz_point, only: hertz_point_contact_area_fraction, hertz_point_peak_pressure_over_pstar, &
                                  hertz_point_radius_over_wavelength
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov, only: kuznetsov_mean_gap_over_amplitude
   use wavycon_light_load, only: light_load_contact_area_longer, light_load_mean_gap_lattice, &
                                 light_load_mean_gap_longer, light_load_mean_gap_one_square
   use wavycon_line_crack, only: line_crack_contact_area_fraction
   use wavycon_near_closure, only: near_closure_contact_area_fraction, near_closure_mean_gap_over_amplitude
   use wavycon_output_file, only: output_file
   use wavycon_penny_crack, only: penny_crack_contact_area_fraction, penny_crack_mean_gap_over_amplitude, &
                                  penny_crack_radius_over_wavelength
   use wavycon_results, only: not_a_number, results_type
   use wavycon_surface, only: surface_type
   use wavycon_wave_kinds, only: paper_waves
   use wavycon_table, only: table_type
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   implicit none (type, external)
   private

   public :: refuse_other_waves, theory_table

   character(45), parameter :: columns(*) = [character(45) :: &
      'load[-]', 'pbar_over_pstar[-]', 'force[force]', &
      'kuznetsov_mean_gap_over_amplitude[-]', 'westergaard_contact_area_fraction[-]', &
      'westergaard_peak_pressure_over_pstar[-]', 'hertz_line_contact_area_fraction[-]', &
      'line_crack_contact_area_fraction[-]', &
      'hertz_contact_area_fraction[-]', 'crack_contact_area_fraction[-]', 'light_eq29_mean_gap_over_amplitude[-]', &
      'light_lattice_mean_gap_over_amplitude[-]', 'crack_mean_gap_over_amplitude[-]', &
      'light_longer_contact_area_fraction[-]', 'light_longer_mean_gap_over_amplitude[-]', &
      'closure_longer_contact_area_fraction[-]', 'closure_longer_mean_gap_over_amplitude[-]', &
      'hertz_peak_pressure_over_pstar[-]', 'hertz_radius[length]', 'crack_radius[length]', &
      'ball_contact_area[area]', 'ball_approach[length]', 'ball_peak_pressure[pressure]', 'ball_half_axis_x[length]', &
      'ball_half_axis_y[length]']
   !> Columns for the wave in one dimension, for that in two and for a ball, after the first three columns. Those of
   !> the others are NaN.
   integer, parameter :: closed_forms(3) = [5, 12, 5]

contains

   type(table_type) function theory_table() result(table)
      table%file = 'theory'
      table%key = 'theory'
      table%meaning = 'The closed forms beside the numbers.'
      call table%set_columns(columns)
      table%refuse => refuse_without_theory
      table%put_load => put_theory
   end function theory_table

   subroutine refuse_without_theory(traits, surface, words)
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      call refuse_other_waves(traits, surface, words)
      if (words /= '' .and. has_ball(surface)) words = ''
      if (words /= '') words = words//', and for a ball'
   end subroutine refuse_without_theory

   !> Whether the surface is a ball, with or without roughness; in 1-D a roller.
   pure logical function has_ball(surface)
      type(surface_type), intent(in) :: surface

      has_ball = surface%has_free_edges .and. all(surface%form(:surface%dimension) > 0.0_dp)
   end function has_ball

   subroutine refuse_other_waves(traits, surface, words)
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      associate (unused => traits); end associate
      words = ''
      if (.not. surface%is_paper_wave()) words = 'closed forms exist only for the waves of the paper: '//paper_waves
   end subroutine refuse_other_waves

   subroutine put_theory(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      real(dp) :: values(sum(closed_forms))

      values = not_a_number()
      associate (p => results%loads(load)%pbar_over_pstar, wavelength => results%solver%surface%paper_wavelength())
         if (has_ball(results%solver%surface)) then
            values(sum(closed_forms(:2)) + 1:) = values_of_ball(results, load)
         else if (results%solver%surface%dimension == 1) then
            values(:closed_forms(1)) = &
               [kuznetsov_mean_gap_over_amplitude(p), westergaard_contact_area_fraction(p), &
                westergaard_peak_pressure_over_pstar(p), hertz_line_contact_area_fraction(p), &
                line_crack_contact_area_fraction(p)]
         else
            values(closed_forms(1) + 1:sum(closed_forms(:2))) = &
               [hertz_point_contact_area_fraction(p), penny_crack_contact_area_fraction(p), &
                light_load_mean_gap_one_square(p), light_load_mean_gap_lattice(p), &
                penny_crack_mean_gap_over_amplitude(p), light_load_contact_area_longer(p), &
                light_load_mean_gap_longer(p), near_closure_contact_area_fraction(p), &
                near_closure_mean_gap_over_amplitude(p), hertz_point_peak_pressure_over_pstar(p), &
                wavelength*hertz_point_radius_over_wavelength(p), &
                wavelength*penny_crack_radius_over_wavelength(p)]
         end if
         call file%add(load)
         call file%add([results%in_p_star(p), results%solver%surface%nominal_area()*results%mean_pressure(load), &
                        values])
      end associate
      call file%end_row()
   end subroutine put_theory

   !> Area, approach, peak pressure and half axes of Hertz's contact.
   function values_of_ball(results, load) result(values)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      real(dp) :: values(closed_forms(3))

      type(hertz_ball) :: contact
      real(dp) :: radii(2), roller(2)

      associate (surface => results%solver%surface, &
                 force => results%solver%surface%nominal_area()*results%mean_pressure(load))
         radii = surface%radii()
         values = not_a_number()
         if (surface%dimension == 1) then
            roller = hertz_roller(radii(1), results%scene%e_star, force)
            values([1, 3, 4]) = [2*roller(1), roller(2), roller(1)]
         else
            contact = hertz_of_force(radii, results%scene%e_star, force)
            values = [contact%contact_area(), contact%approach, contact%peak_pressure, contact%half_axis]
         end if
      end associate
   end function values_of_ball

end module wavycon_theory_table
