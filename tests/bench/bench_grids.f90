!> Measures the grids: time, cost and true error of the two-dimensional wave at a number of accuracies, and how the
!> errors of the one- and the two-dimensional wave fall with the step of the grid.
program bench_grids
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_fitted_solver, only: fitted_answer, solve_fitted, square_lattice
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp
   use wavycon_kuznetsov, only: kuznetsov_mean_gap_over_amplitude
   use wavycon_surface, only: surface_type
   use wavycon_wave_surfaces, only: wave_1d, wave_2d
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   implicit none (type, external)

   real(dp), parameter :: accuracies(*) = [1e-2_dp, 1e-3_dp, 1e-4_dp]
   !> Solves of one load at one accuracy, of which the median is reported.
   integer, parameter :: repeats = 5

   type(surface_type) :: whole, wave
   real(dp), allocatable :: loads(:), references(:, :)
   logical :: all_accurate
   integer :: i, k

   call read_reference(loads, references)
   whole = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
   wave = whole%smaller_cell()
   all_accurate = .true.
   write (output_unit, '(a)') '# Grids: a load of the 2-D wave to an accuracy of mean gap, '// &
         'area and peak pressure. Pairs of', &
      '# transforms are counted in units of one on the finest grid. Errors are true, estimates the program''s own.', &
      '# accuracy      P points grids iterations  pairs  time[ms]     least  gap_error  estimate area_error  estimate '// &
      'peak_error  estimate'
   do k = 1, size(accuracies)
      do i = 1, size(loads)
         call measure(loads(i), references(:, i), accuracies(k))
      end do
   end do
   call measure_orders(1)
   call measure_orders(2)
   if (.not. all_accurate) then
      write (error_unit, '(a)') 'bench: a load is not as accurate as asked for'
      stop 1
   end if

contains

   subroutine measure(load, reference, accuracy)
      real(dp), intent(in) :: load, reference(3), accuracy

      type(sequence_answer) :: answer
      type(sample_set) :: times
      real(dp) :: start, errors(2, 3)
      integer :: run

      do run = 1, repeats
         start = clock_ms()
         call solve_by_sequence(wave, load, accuracy, [0, 0], answer)
         call times%add(clock_ms() - start)
      end do
      errors(1, :) = answer%values - reference
      errors(2, :) = answer%errors
      all_accurate = all_accurate .and. answer%accurate
      write (output_unit, '(es10.1, f7.2, 2i6, i11, f7.1, 2f10.3, 6es11.1)') accuracy, load, &
         size(answer%state%pressure, 1), answer%grids, answer%iterations, answer%transform_pairs, times%median(), &
         times%least(), errors
   end subroutine measure

   !> Root mean square errors over nine loads, against Westergaard's solution and collocation fitted to the edge, on
   !> grids of ever more points; and the slopes of straight lines through their logarithms.
   subroutine measure_orders(dimension)
      integer, intent(in) :: dimension   !! 1 or 2

      integer, parameter :: many = 9, grids = 5
      integer, parameter :: first_points(2) = [64, 16]
      type(sequence_answer) :: answer
      type(surface_type) :: surface
      real(dp) :: errors(3, grids), load, slopes(3), steps(grids), truth(3, many)
      integer :: i, k, points

      do i = 1, many
         call solve_exactly(dimension, 0.1_dp*i, truth(:, i))
      end do
      surface = wave
      if (dimension == 1) surface = wave_1d(1.0_dp, 1.0_dp)
      errors = 0.0_dp
      write (output_unit, '(/, /, a, i0, a, /, a)') '# Grids: errors of the ', dimension, '-D wave, '// &
            'root mean squares over '// &
         'nine loads P = 0.1 .. 0.9, and their orders', '# points a side   mean_gap       area       peak'
      do k = 1, grids
         points = 2*first_points(dimension)*2**(k - 1)
         do i = 1, many
            load = 0.1_dp*i
            call solve_by_sequence(surface, load, 0.0_dp, [points, merge(1, points, dimension == 1)], answer)
            errors(:, k) = errors(:, k) + (answer%values - truth(:, i))**2/many
         end do
         errors(:, k) = sqrt(errors(:, k))
         steps(k) = -log(real(points, dp))
         write (output_unit, '(i12, 3es11.1)') points, errors(:, k)
      end do
      steps = steps - sum(steps)/grids
      slopes = matmul(log(errors), steps)/sum(steps**2)
      write (output_unit, '(a, 3f11.1)') '#    order:  ', slopes
   end subroutine measure_orders

   subroutine solve_exactly(dimension, load, values)
      integer, intent(in) :: dimension
      real(dp), intent(in) :: load
      real(dp), intent(out) :: values(3)   !! mean gap, contact area and peak pressure

      type(fitted_answer) :: answer

      if (dimension == 1) then
         values = [kuznetsov_mean_gap_over_amplitude(load), westergaard_contact_area_fraction(load), &
                   westergaard_peak_pressure_over_pstar(load)]
      else
         call solve_fitted(square_lattice(), load, 1e-9_dp, answer)
         values = [answer%mean_gap, answer%area_fraction, answer%peak_pressure]
      end if
   end subroutine solve_exactly

   !> The loads of the reference table and their mean gap, contact area and peak pressure, shape (3, loads).
   subroutine read_reference(loads, values)
      real(dp), allocatable, intent(out) :: loads(:), values(:, :)

      character(200) :: line, path
      real(dp) :: row(4)
      integer :: unit, status

      call get_command_argument(1, path)
      open (newunit=unit, file=trim(path), status='old', action='read')
      allocate (loads(0), values(3, 0))
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (line == '' .or. line(1:1) == '#' .or. index(line, 'pbar_over_pstar') > 0) cycle
         read (line, *) row
         loads = [loads, row(1)]
         values = reshape([values, row(2:)], [3, size(loads)])
      end do
      close (unit)
   end subroutine read_reference

end program bench_grids
