!> Tables of the numbers of each load.
!>
!> <case>.summary.dat: mean gap, contact area, pressures, iterations, residual and status, a line for each load.
!> <case>.details.dat: numbers that the summary does not have, with error estimates, from solvers that compute them, a
!> row for each load. What a load without details (no load, full contact, no solution) does not have is NaN, its degree
!> 0.
!> <case>.coefficients.dat: the Fourier coefficients of the pressure, A_i of eq. (12) or A_ij of eq. (25), a block for
!> each load; in 1-D j = 0.
module wavycon_summary_tables
   use wavycon_contact_measures, only: contact_details, linear_area_fraction, or_nan
   use wavycon_contact_status, only: status_code, status_name
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: longest_word
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: summary_tables

   !> With free edges numbers in p* are NaN. The errors are estimates, NaN if unknown or if the solver has none. NaN
   !> too: what is at the hardness without a hardness, areas by points without a grid, the linear law if the surface is
   !> no map.
   character(*), parameter, public :: summary_columns = &
      'load[#] pbar_over_pstar[-] mean_gap_over_amplitude[-] approach_over_amplitude[-] contact_area_fraction[-] '// &
      'peak_pressure_over_pstar[-] min_pressure_over_pstar[-] mean_gap_over_amplitude_error[-] '// &
      'contact_area_fraction_error[-] peak_pressure_over_pstar_error[-] area_at_hardness_fraction[-] '// &
      'load_at_hardness_fraction[-] area_at_hardness_fraction_error[-] load_at_hardness_fraction_error[-] '// &
      'contact_area_counted_fraction[-] contact_area_corrected_fraction[-] linear_area_fraction[-] '// &
      'mean_pressure[pressure] force[force] mean_gap[length] approach[length] approach_error[length] '// &
      'contact_area[area] contact_area_error[area] peak_pressure[pressure] peak_pressure_error[pressure] '// &
      'elastic_energy_over_pstar_amplitude[-] elastic_energy_over_pstar_amplitude_error[-] '// &
      'elastic_energy[force*length] elastic_energy_error[force*length] active_constraints[#] iterations[#] '// &
      'residual[-] solver[word] status_code[#] status[word]'

contains

   !> The tables of this file.
   function summary_tables() result(tables)
      type(table_type) :: tables(3)

      tables(1) = table_type('summary', needs_surface=.false., put_load=put_summary_row, columns=summary_columns)
      ! The energy is per nominal area. The perimeter is that of one contact spot or, above merging, of one open pool;
      ! the paper's cell has two of each.
      tables(2) = table_type('details', 'details', needs_fields=.true., put_load=put_details, &
         columns='load[#] pbar_over_pstar[-] '// &
         'mean_gap_over_amplitude[-] mean_gap_over_amplitude_error[-] contact_area_fraction[-] '// &
         'contact_area_fraction_error[-] peak_pressure_over_pstar[-] peak_pressure_over_pstar_error[-] '// &
         'trough_gap_over_amplitude[-] trough_gap_over_amplitude_error[-] saddle_gap_over_amplitude[-] '// &
         'saddle_gap_over_amplitude_error[-] saddle_pressure_over_pstar[-] saddle_pressure_over_pstar_error[-] '// &
         'elastic_energy_over_pstar_amplitude[-] elastic_energy_over_pstar_amplitude_error[-] perimeter[length] '// &
         'perimeter_error[length] degree[#] status_code[#] status[word]', &
         meaning='Gaps at trough and saddle, strain energy, perimeter and the numbers of the '// &
         'summary, each with its error estimate.')
      tables(3) = table_type('coefficients', 'coefficients', put_load=put_coefficients, &
         columns='load[#] i[#] j[#] pressure_over_pstar[-]', &
         meaning='The Fourier coefficients of the pressure.')
   end function summary_tables

   subroutine put_summary_row(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      character(longest_word) :: words(2)
      real(dp) :: approach(2), at_hardness(4), energy(2), errors(3)

      associate (scene => results%scene, surface => results%solver%surface, solution => results%loads(load), &
                 measures => results%loads(load)%measures)
         errors = not_a_number()
         if (results%traits%has_errors) errors = or_nan(measures%errors())
         energy = or_nan([measures%elastic_energy, measures%elastic_energy_error])
         if (.not. results%traits%has_errors) energy(2) = not_a_number()
         approach = results%approach_over_amplitude(load)
         at_hardness = not_a_number()
         if (surface%has_hardness()) then
            at_hardness(:2) = [measures%area_at_hardness_fraction, measures%load_at_hardness_fraction]
            if (results%traits%has_errors) &
               at_hardness(3:) = or_nan([measures%area_at_hardness_error, measures%load_at_hardness_error])
         end if
         words(1) = solver_names(solution%solver)
         words(2) = status_name(solution%status)
         call file%put_row( &
            [real(dp) :: load, results%in_p_star(solution%pbar_over_pstar), measures%mean_gap_over_amplitude, &
             approach(1), measures%contact_area_fraction, results%in_p_star(measures%peak_pressure_over_pstar), &
             results%in_p_star(measures%min_pressure_over_pstar), errors(:2), results%in_p_star(errors(3)), &
             at_hardness, or_nan(measures%contact_area_counted_fraction), &
             or_nan(measures%contact_area_corrected_fraction), &
             or_nan(linear_area_fraction(surface, scene%roughness%slope, solution%pbar_over_pstar)), &
             results%mean_pressure(load), surface%nominal_area()*results%mean_pressure(load), &
             surface%amplitude*[measures%mean_gap_over_amplitude, approach], &
             surface%nominal_area()*[measures%contact_area_fraction, errors(2)], &
             results%peak_pressure(load), scene%p_star*errors(3), results%in_p_star(energy), &
             scene%p_star*surface%amplitude*surface%nominal_area()*energy, solution%active_constraints, &
             solution%iterations, solution%residual, status_code(solution%status)], words)
      end associate
   end subroutine put_summary_row

   subroutine put_details(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_details) :: details
      real(dp) :: numbers(10)
      logical :: found

      associate (solution => results%loads(load), measures => results%loads(load)%measures)
         call solution%details(details, found)
         numbers = not_a_number()
         if (found) numbers = [details%trough_gap, details%trough_gap_error, &
                               details%saddle_gap, details%saddle_gap_error, &
                               details%saddle_pressure, details%saddle_pressure_error, &
                               details%energy, details%energy_error, details%perimeter, details%perimeter_error]
         call file%put_row([real(dp) :: load, solution%pbar_over_pstar, measures%mean_gap_over_amplitude, &
                            or_nan(measures%mean_gap_error), measures%contact_area_fraction, &
                            or_nan(measures%contact_area_error), measures%peak_pressure_over_pstar, &
                            or_nan(measures%peak_pressure_error), or_nan(numbers), &
                            details%degree, status_code(solution%status)], [status_name(solution%status)])
      end associate
   end subroutine put_details

   subroutine put_coefficients(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(fourier_series) :: pressure
      integer :: i, j

      call results%begin_block(file, load)
      call results%loads(load)%coefficients(results%solver%surface, pressure)
      if (.not. allocated(pressure%c)) return
      do i = 0, ubound(pressure%c, 1)
         do j = 0, ubound(pressure%c, 2)
            if (i + j == 0) cycle
            call file%put_row([real(dp) :: load, i, j, pressure%c(i, j)])
         end do
      end do
   end subroutine put_coefficients

end module wavycon_summary_tables
