!> The public interface of the library.
module wavycon
   use wavycon_auto_contact, only: auto_contact
   use wavycon_beale, only: beale_solver
   use wavycon_beale_contact, only: beale_contact, beale_solution
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status
   use wavycon_crossed_1d, only: crossed_1d
   use wavycon_deck, only: deck_type
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_edge_curves, only: edge_curve
   use wavycon_error, only: error_type
   use wavycon_find_load, only: solve_for_contact_area, solve_for_mean_gap
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_grid_contact, only: grid_contact, grid_solution
   use wavycon_hertz_line
   use wavycon_hertz_point
   use wavycon_hexagonal, only: hexagonal
   use wavycon_kinds, only: dp
   use wavycon_kkt, only: kkt_residual
   use wavycon_kuznetsov
   use wavycon_light_load
   use wavycon_line_crack
   use wavycon_make_scene, only: make_scene
   use wavycon_near_closure
   use wavycon_penny_crack
   use wavycon_qp_problem
   use wavycon_read_deck, only: read_deck
   use wavycon_scene, only: scene_type
   use wavycon_solver_list, only: start_solver
   use wavycon_surface, only: surface_of_points, surface_of_series, surface_type
   use wavycon_threads, only: set_threads
   use wavycon_version, only: revision, version
   use wavycon_wave_1d, only: wave_1d
   use wavycon_wave_2d, only: wave_2d
   use wavycon_wave_sum, only: wave_sum
   use wavycon_westergaard
   implicit none (type, external)
   public
end module wavycon
