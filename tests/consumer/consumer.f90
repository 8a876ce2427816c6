!> A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.
program consumer
   use wavycon, only: dp, error_type, make_solver, make_wave_2d, wavy_edge, wavy_measures, wavy_solution, wavy_solver, &
      wavy_surface
   implicit none (type, external)

   type(error_type), allocatable :: error
   type(wavy_surface) :: surface
   type(wavy_solver) :: solver
   type(wavy_solution) :: solution
   type(wavy_measures) :: m
   type(wavy_edge), allocatable :: edges(:)
   real(dp), allocatable :: pressure(:, :), gap(:, :), displacement(:, :)
   real(dp), parameter :: e_star = 210e9_dp/(1 - 0.3_dp**2), loads(*) = [0.9_dp, 0.5_dp, 0.2_dp]
   integer :: i

   call make_wave_2d(1e-6_dp, 1e-3_dp, surface=surface, error=error)
   call make_solver(surface, e_star, "solver = 'auto', accuracy = 1e-4", .true., solver, error)
   if (allocated(error)) error stop error%message
   do i = 1, size(loads)
      call solver%solve('pbar_over_pstar', loads(i), solution, error)
      if (allocated(error)) error stop error%message
      m = solution%measures()
      print '(5es24.16, 1x, a)', m%pbar_over_pstar, m%mean_gap, m%contact_area_fraction, m%peak_pressure, &
         m%peak_pressure_over_pstar_error, solution%status()
   end do
   call solution%map([48, 32], pressure, gap, displacement, error)
   call solution%edges(edges, error)
   print '(3es24.16, i4)', maxval(pressure), pressure(2, 3), gap(24, 3), size(edges)
end program consumer
