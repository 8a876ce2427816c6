!> Measures what maps of fields cost beside the solution that they show: of the expansions of the two-dimensional and of
!> the hexagonal wave to two accuracies, of the grid and of the closed form. Writing the map's file is not in the times.
program bench_maps
   use, intrinsic :: iso_fortran_env, only: output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_fitted_contact, only: fitted_contact, fitted_options
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_kinds, only: dp
   use wavycon_wave_surfaces, only: hexagonal, wave_1d, wave_2d
   implicit none (type, external)

   integer, parameter :: sides(*) = [128, 257, 1025]
   !> Maps of one size, of which the median is reported, and their time limit [ms].
   integer, parameter :: repeats = 15
   real(dp), parameter :: enough = 1500.0_dp
   real(dp), parameter :: loads(*) = [0.05_dp, 0.2_dp, 0.3_dp, 0.6_dp, 0.9_dp]

   type(closed_form_contact) :: closed
   type(fitted_contact) :: fitted
   type(grid_contact) :: grid

   write (output_unit, '(a)') '# Maps: a load solved, and its fields on the points of a map; medians and least times'
   write (output_unit, '(a)') '# solver      surface   accuracy      P  solve[ms] points    map[ms]      least'
   call measure_fitted(1e-4_dp)
   call measure_fitted(1e-10_dp)
   call grid%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), grid_options(), keep_fields=.true.)
   call measure(grid, 'grid', 'wave_2d', 1e-3_dp)
   call closed%start(wave_1d(1.0_dp, 1.0_dp))
   call measure(closed, 'closed_form', 'wave_1d', epsilon(1.0_dp))

contains

   subroutine measure_fitted(accuracy)
      real(dp), intent(in) :: accuracy

      call fitted%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), fitted_options(accuracy), keep_fields=.true.)
      call measure(fitted, 'fitted', 'wave_2d', accuracy)
      call fitted%start(hexagonal(1.0_dp, 1.0_dp), fitted_options(accuracy), keep_fields=.true.)
      call measure(fitted, 'fitted', 'hexagonal', accuracy)
   end subroutine measure_fitted

   subroutine measure(solver, name, surface_name, accuracy)
      class(contact_solver), intent(inout) :: solver   !! started
      character(*), intent(in) :: name, surface_name
      real(dp), intent(in) :: accuracy

      class(contact_fields), allocatable :: fields
      type(contact_solution) :: solution
      type(sample_set) :: times
      real(dp), allocatable, dimension(:, :) :: displacement, gap, pressure
      real(dp) :: solve, spent, start
      integer :: i, k

      do i = 1, size(loads)
         start = clock_ms()
         call solver%solve(loads(i), solution)
         solve = clock_ms() - start
         do k = 1, size(sides)
            times = sample_set()
            spent = 0.0_dp
            do while (times%count < repeats .and. spent < enough)
               start = clock_ms()
               call solution%fields(solver%surface, fields)
               call fields%on_grid([sides(k), merge(1, sides(k), surface_name == 'wave_1d')], [0.0_dp, 0.0_dp], &
                                   pressure, displacement, gap)
               call times%add(clock_ms() - start)
               spent = spent + clock_ms() - start
            end do
            write (output_unit, '(2x, a11, 1x, a9, es9.1, f7.2, f11.2, i7, 2f11.2)') name, surface_name, accuracy, &
               loads(i), solve, sides(k), times%median(), times%least()
         end do
      end do
   end subroutine measure

end program bench_maps
