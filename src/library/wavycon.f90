!> The public interface of the library. All other modules are internal and may change in any release.
!>
!> A program makes a surface, makes a solver for it, and solves loads:
!>
!>     call make_wave_2d(amplitude, wavelength, surface=surface, error=error)
!>     call make_solver(surface, e_star, "solver = 'auto', accuracy = 1e-4", .true., solver, error)
!>     call solver%solve('mean_pressure', mean_pressure, solution, error)
!>
!> Errors are of bad arguments; a load that cannot be solved as requested has a status. README.md in this directory
!> explains both, units, and how to link.
module wavycon
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_status, only: above_hardness, closed_form, converged, full_contact, is_good_status, no_load, &
      no_memory, not_accurate, not_finite, not_found, status_code, status_name, unresolved
   use wavycon_deck_run, only: run_deck
   use wavycon_dundurs, only: dundurs_coefficients, dundurs_pressure_over_pstar
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, exit_fine, exit_not_converged
   use wavycon_hertz_line
   use wavycon_hertz_point
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov
   use wavycon_light_load
   use wavycon_line_crack
   use wavycon_near_closure
   use wavycon_penny_crack
   use wavycon_solution_stress, only: wavy_largest_stress
   use wavycon_stress_tensor, only: largest_shear, principal_stresses, von_mises
   use wavycon_threads, only: set_threads
   use wavycon_version, only: revision, version
   use wavycon_wavy_solution, only: wavy_edge, wavy_measures, wavy_solution
   use wavycon_wavy_solver, only: make_solver, make_solver_of_deck, make_solver_of_material, wavy_scales, &
                                  wavy_solver
   use wavycon_wavy_surface, only: make_crossed_1d, make_heights, make_hexagonal, make_surface_of_keys, make_wave_1d, &
      make_wave_2d, make_wave_sum, wavy_surface
   use wavycon_westergaard
   implicit none (type, external)
   public
end module wavycon
