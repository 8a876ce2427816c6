!> <case>.summary.dat: mean gap, contact area, pressures, iterations, residual and status, a line for each load.
module wavycon_summary_table
   use wavycon_contact_measures, only: or_nan
   use wavycon_kinds, only: dp
   use wavycon_linear_area, only: linear_area_fraction
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: summary_table

   !> With free edges numbers in p* are NaN. The errors are estimates, NaN if unknown or if the solver has none. NaN
   !> too: what is at the hardness without a hardness, areas by points without a grid, the linear law if the surface is
   !> no map.
   character(45), parameter, public :: summary_columns(*) = [character(45) :: &
      'load[-]', 'pbar_over_pstar[-]', 'mean_gap_over_amplitude[-]', 'approach_over_amplitude[-]', &
      'contact_area_fraction[-]', 'peak_pressure_over_pstar[-]', 'min_pressure_over_pstar[-]', &
      'mean_gap_over_amplitude_error[-]', 'contact_area_fraction_error[-]', 'peak_pressure_over_pstar_error[-]', &
      'area_at_hardness_fraction[-]', 'load_at_hardness_fraction[-]', &
      'area_at_hardness_fraction_error[-]', 'load_at_hardness_fraction_error[-]', &
      'contact_area_counted_fraction[-]', 'contact_area_corrected_fraction[-]', 'linear_area_fraction[-]', &
      'mean_pressure[pressure]', 'force[force]', 'mean_gap[length]', 'approach[length]', 'approach_error[length]', &
      'contact_area[area]', 'contact_area_error[area]', 'peak_pressure[pressure]', 'peak_pressure_error[pressure]', &
      'elastic_energy_over_pstar_amplitude[-]', 'elastic_energy_over_pstar_amplitude_error[-]', &
      'elastic_energy[force*length]', 'elastic_energy_error[force*length]', &
      'active_constraints[-]', 'iterations[-]', 'residual[-]', 'solver[-]', &
      'status_code[-]', 'status[-]']

contains

   type(table_type) function summary_table() result(table)
      table%file = 'summary'
      table%meaning = 'A line for each load: mean gap, contact area, pressures.'
      call table%set_columns(summary_columns)
      table%needs_surface = .false.
      table%is_for_flat_surfaces = .true.
      table%put_load => put_summary_row
   end function summary_table

   !> Writes the row of a load.
   subroutine put_summary_row(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file   !! with summary_columns

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
         call file%add(load)
         call file%add([results%in_p_star(solution%pbar_over_pstar), &
                        measures%mean_gap_over_amplitude, approach(1), &
                        measures%contact_area_fraction, results%in_p_star(measures%peak_pressure_over_pstar), &
                        results%in_p_star(measures%min_pressure_over_pstar), errors(:2), &
                        results%in_p_star(errors(3)), at_hardness, &
                        or_nan(measures%contact_area_counted_fraction), &
                        or_nan(measures%contact_area_corrected_fraction), &
                        or_nan(linear_area_fraction(surface, scene%roughness%slope, solution%pbar_over_pstar)), &
                        results%mean_pressure(load), surface%nominal_area()*results%mean_pressure(load), &
                        surface%amplitude*[measures%mean_gap_over_amplitude, approach], &
                        surface%nominal_area()*[measures%contact_area_fraction, errors(2)], &
                        results%peak_pressure(load), scene%p_star*errors(3), results%in_p_star(energy), &
                        scene%p_star*surface%amplitude*surface%nominal_area()*energy])
         call file%add(solution%active_constraints)
         call file%add(solution%iterations)
         call file%add(solution%residual)
         call file%add(trim(solver_names(solution%solver)))
      end associate
      call results%end_row(file, load)
   end subroutine put_summary_row

end module wavycon_summary_table
