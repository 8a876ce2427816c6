!> A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.
program consumer
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon, only: dp, error_type, largest_shear, make_heights, make_solver, make_wave_2d, principal_stresses, &
      status_name, von_mises, wavy_edge, wavy_largest_stress, wavy_measures, wavy_solution, wavy_solver, wavy_surface
   implicit none (type, external)

   type(error_type), allocatable :: error
   type(wavy_surface) :: surface
   type(wavy_solver) :: solver
   type(wavy_solution) :: solution
   type(wavy_measures) :: m
   type(wavy_edge), allocatable :: edges(:)
   type(wavy_largest_stress) :: largest
   real(dp), allocatable :: pressure(:, :), gap(:, :), displacement(:, :), stress(:, :), stress_error(:), plane(:, :, :)
   real(dp), parameter :: nu = 0.3_dp, depths(2) = [1e-4_dp, 3e-4_dp], crest(2) = 0.0_dp
   real(dp), parameter :: e_star = 210e9_dp/(1 - 0.3_dp**2), loads(*) = [0.9_dp, 0.5_dp, 0.2_dp]
   real(dp) :: heights(0:15, 0:11)
   integer :: i, j

   call make_wave_2d(1e-6_dp, 1e-3_dp, surface=surface, error=error)
   call make_solver(surface, e_star, "solver = 'auto', accuracy = 1e-4", .true., solver, error)
   if (allocated(error)) error stop error%message
   do i = 1, size(loads)
      call solver%solve('pbar_over_pstar', loads(i), solution, error)
      if (allocated(error)) error stop error%message
      m = solution%measures()
      print '(5es24.16, 1x, a)', m%pbar_over_pstar, m%mean_gap, m%contact_area_fraction, m%peak_pressure, &
         m%peak_pressure_over_pstar_error, trim(status_name(solution%status()))
   end do
   call solution%map([48, 32], pressure, gap, displacement, error)
   call solution%edges(edges, error)
   print '(3es24.16, i4)', maxval(pressure), pressure(2, 3), gap(24, 3), size(edges)

   ! The stresses of this load below a crest, on a plane, the largest ones, and the load at which steel yields.
   call solution%stress(crest, crest, depths, nu, 'constrained', stress, error, stress_error)
   if (allocated(error)) error stop error%message
   do i = 1, 2
      print '(12es24.16)', stress(:, i), stress_error(i), von_mises(stress(:, i)), largest_shear(stress(:, i)), &
         principal_stresses(stress(:, i))
   end do
   call solution%stress_plane([48, 32], depths(1), nu, 'constrained', plane, error)
   if (allocated(error)) error stop error%message
   print '(6es24.16)', plane(:, 8, 5)
   call solution%largest_stress(nu, 'constrained', largest, error)
   if (allocated(error)) error stop error%message
   print '(6es24.16)', largest%largest_von_mises, largest%von_mises_x, largest%von_mises_y, largest%von_mises_depth, &
      largest%largest_von_mises_over_pstar_error, largest%largest_shear
   call make_solver(surface, e_star, "solver = 'auto', accuracy = 1e-4", .true., solver, error)
   call solver%set_stress("nu = 0.3, yield_stress = 1e9", error)
   call solver%solve('yield', 1.0_dp, solution, error)
   if (allocated(error)) error stop error%message
   m = solution%measures()
   print '(2es24.16, 1x, a)', m%mean_pressure, m%contact_area_fraction, trim(status_name(solution%status()))

   ! A measured map with a tilt and a hole.
   do j = 0, 11
      do i = 0, 15
         heights(i, j) = (mod(7*i*i + 3*j*j + i*j, 11) + 0.25_dp*i)/1048576
      end do
   end do
   heights(5, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
   call make_heights(heights, 4e-3_dp, 3e-3_dp, surface, error, &
                     "detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror'")
   call make_solver(surface, 1e9_dp, "residual = 1e-10", .true., solver, error)
   if (allocated(error)) error stop error%message
   call solver%solve('pbar_over_pstar', 0.2_dp, solution, error)
   if (allocated(error)) error stop error%message
   m = solution%measures()
   print '(3es24.16, 1x, a)', m%mean_gap, m%contact_area, m%mean_pressure, trim(status_name(solution%status()))
end program consumer
