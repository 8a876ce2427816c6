!> The public interface of the library: the core's surfaces, solvers and solutions, decks, and the closed forms. All
!> other modules are internal and may change in any release. README.md in this directory has examples.
!>
!> Numbers of the core are in units of p* and Delta and in angles of the cell; `scale_of` gives the factors that convert
!> them. A `deck_session` takes and gives numbers in the deck's units.
module wavycon
   use wavycon_auto_contact, only: auto_contact
   use wavycon_series_contact, only: series_contact, qp_options
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_spots, only: connected_region, contact_spots
   use wavycon_deck_session, only: deck_session, solved_load
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_contact_contours, only: contact_contour
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, exit_fine, exit_not_converged
   use wavycon_find_load, only: solve_for
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_key_reference, only: key_json
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_memory_table, only: column_type, memory_table, of_integers, of_reals, of_words
   use wavycon_quantities, only: approach, area_at_hardness, contact_area, contact_area_corrected, &
      contact_area_counted, elastic_energy, is_known, load_at_hardness, mean_gap, min_pressure, peak_pressure, &
      perimeter, quantities, quantity_list, saddle_gap, saddle_pressure, trough_gap, unknown
   use wavycon_run_scene, only: run_deck
   use wavycon_session_fields, only: bounds_from_fields, fields_at, fields_on_grid, own_points, stresses_at, &
      stresses_on_plane
   use wavycon_solution_record, only: above_hardness, closed_form, converged, full_contact, interrupted, &
      is_good_status, iteration_limit, no_load, no_memory, not_accurate, not_finite, not_found, other_failure, &
      status_code, status_name, status_of_programme, unresolved
   use wavycon_solver_progress, only: solver_progress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_tensor, only: elastic_body, hydrostatic, largest_shear, laterally_constrained, laterally_free, &
      principal_stresses, von_mises
   use wavycon_surface, only: surface_type
   use wavycon_surface_of_points, only: surface_of_points
   use wavycon_threads, only: set_threads
   use wavycon_unit_scale, only: scale_of, unit_scale
   use wavycon_version, only: revision, version
   use wavycon_wave_2d_limits
   use wavycon_westergaard
   use wavycon_wave_surfaces, only: crossed_1d, hexagonal, surface_of_series, wave_1d, wave_2d, wave_sum
   implicit none (type, external)
   public
end module wavycon
