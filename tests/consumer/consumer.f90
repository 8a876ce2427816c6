!> A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.
program consumer
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon, only: deck_session, dp, error_type, fields_on_grid, largest_shear, memory_table, principal_stresses, &
      solved_load, stresses_at, stresses_on_plane, von_mises
   implicit none (type, external)

   character(*), parameter :: wave = "&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 / "// &
      "&material e1 = 210e9, nu1 = 0.3 / &method solver = 'auto', accuracy = 1e-4 / &stress yield_stress = 1e9 /"
   character(*), parameter :: rough = "&surface kind = 'file', file = 'heights', length_x = 4e-3, length_y = 3e-3, "// &
      "detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror' / &material e_star = 1e9 / "// &
      "&method residual = 1e-10 /"
   character(30), parameter :: of_load(5) = [character(30) :: 'pbar_over_pstar', 'mean_gap', 'contact_area_fraction', &
      'peak_pressure', 'peak_pressure_over_pstar_error']
   character(34), parameter :: of_stress(6) = [character(34) :: 'largest_von_mises', 'von_mises_x', 'von_mises_y', &
      'von_mises_depth', 'largest_von_mises_over_pstar_error', 'largest_shear']
   real(dp), parameter :: nu = 0.3_dp, depths(2) = [1e-4_dp, 3e-4_dp], crest(2) = 0.0_dp
   real(dp), parameter :: loads(*) = [0.9_dp, 0.5_dp, 0.2_dp]
   type(deck_session) :: session
   type(error_type), allocatable :: error
   type(memory_table) :: table
   type(solved_load) :: solved
   real(dp) :: gap(48, 32), heights(0:15, 0:11), plane(6, 48, 32), pressure(48, 32), stress(6, 2), stress_error(2)
   integer :: i, j

   call session%open(wave, 'wave', .true., error)
   call stop_on_error()
   do i = 1, size(loads)
      call session%solve('pbar_over_pstar', loads(i), solved, error)
      call stop_on_error()
      call print_named(of_load)
   end do
   call fields_on_grid(session, solved, [48, 32], [0.0_dp, 0.0_dp], error, pressure, gap)
   call stop_on_error()
   call session%make_table('contours', solved, table, error)
   call stop_on_error()
   print '(3es24.16, i4)', maxval(pressure), pressure(2, 3), gap(24, 3), &
      nint(maxval(table%values(table%find_column('curve'), :table%rows)))

   ! The stresses of this load below a crest, on a plane, and the largest ones.
   call stresses_at(session, solved, 2, crest, crest, depths, nu, 'constrained', stress, error, stress_error)
   call stop_on_error()
   do i = 1, 2
      print '(12es24.16)', stress(:, i), stress_error(i), von_mises(stress(:, i)), largest_shear(stress(:, i)), &
         principal_stresses(stress(:, i))
   end do
   call stresses_on_plane(session, solved, [48, 32], [0.0_dp, 0.0_dp], depths(1), nu, 'constrained', plane, error)
   call stop_on_error()
   print '(6es24.16)', plane(:, 8, 5)
   call session%make_table('stress_largest', solved, table, error)
   call stop_on_error()
   print '(6es24.16)', (table%values(table%find_column(trim(of_stress(i))), 1), i=1, size(of_stress))

   ! The load at which steel yields, of a session of its own, whose digits do not depend on other loads.
   call session%open(wave, 'wave', .true., error)
   call stop_on_error()
   call session%solve('yield', 1.0_dp, solved, error)
   call stop_on_error()
   call print_named([character(21) :: 'mean_pressure', 'contact_area_fraction'])

   ! A measured map with a tilt and a hole.
   do j = 0, 11
      do i = 0, 15
         heights(i, j) = (mod(7*i*i + 3*j*j + i*j, 11) + 0.25_dp*i)/1048576
      end do
   end do
   heights(5, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
   call session%open(rough, 'rough', .true., error, heights)
   call stop_on_error()
   call session%solve('pbar_over_pstar', 0.2_dp, solved, error)
   call stop_on_error()
   call print_named([character(13) :: 'mean_gap', 'contact_area', 'mean_pressure'])

contains

   !> Prints numbers of the solved load by their names, and its status.
   subroutine print_named(names)
      character(*), intent(in) :: names(:)

      character(:), allocatable :: status
      real(dp) :: numbers(size(names))
      integer :: k

      do k = 1, size(names)
         call session%number(trim(names(k)), numbers(k), error, solved)
         call stop_on_error()
      end do
      call session%text('status', status, error, solved)
      write (*, '(*(es24.16))', advance='no') numbers
      print '(1x, a)', status
   end subroutine print_named

   subroutine stop_on_error()
      if (allocated(error)) error stop error%message
   end subroutine stop_on_error

end program consumer
