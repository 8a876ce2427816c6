!> Measures the boundary-fitted expansions of the two-dimensional and of the hexagonal wave: time and errors of one
!> load, without a start, to six and to ten digits; and the time of a sweep.
program bench_expansions
   use, intrinsic :: iso_fortran_env, only: output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_fitted_solver, only: fitted_answer, hexagonal_lattice, solve_fitted, square_lattice, wave_lattice
   use wavycon_kinds, only: dp
   implicit none (type, external)

   real(dp), parameter :: accuracies(*) = [1e-6_dp, 1e-10_dp], finest = 1e-12_dp
   !> P of each surface; away from the loads at which spots merge, 0.2286 and 0.7119, and next to them.
   real(dp), parameter :: loads(8, 2) = reshape( &
      [0.01_dp, 0.05_dp, 0.1_dp, 0.2_dp, 0.3_dp, 0.5_dp, 0.7_dp, 0.9_dp, &
       0.01_dp, 0.1_dp, 0.3_dp, 0.5_dp, 0.7_dp, 0.75_dp, 0.8_dp, 0.9_dp], [8, 2])
   !> Solves of one load at one accuracy, of which the median is reported, and their time limit [ms].
   integer, parameter :: repeats = 25
   real(dp), parameter :: enough = 2000.0_dp
   !> Loads of the sweep, equidistant between 0 and 1.
   integer, parameter :: sweep = 99

   character(9), parameter :: names(2) = [character(9) :: 'wave_2d', 'hexagonal']
   type(wave_lattice) :: lattice
   integer :: i, k, s

   write (output_unit, '(a)') '# Expansions: a load to an accuracy of mean gap, area and peak pressure, '// &
         'relative. Errors are '// &
      'against an accuracy of', '# 1e-12, estimates the program''s own.', &
      '# surface   accuracy      P degree steps  time[ms]     least  gap_error  estimate area_error  estimate '// &
      'peak_error  estimate'
   do s = 1, size(names)
      lattice = square_lattice()
      if (s == 2) lattice = hexagonal_lattice()
      do k = 1, size(accuracies)
         do i = 1, size(loads, 1)
            call measure(names(s), loads(i, s), accuracies(k))
         end do
      end do
   end do
   write (output_unit, '(//a, i0, a)') '# The sweep of ', sweep, ' loads, each from the one before'
   write (output_unit, '(a)') '# surface   accuracy   time[s]'
   do s = 1, size(names)
      lattice = square_lattice()
      if (s == 2) lattice = hexagonal_lattice()
      do k = 1, size(accuracies)
         call measure_sweep(names(s), accuracies(k))
      end do
   end do

contains

   subroutine measure(name, p, accuracy)
      character(*), intent(in) :: name
      real(dp), intent(in) :: p, accuracy

      type(fitted_answer) :: answer, truth
      type(sample_set) :: times
      real(dp) :: spent, start, time, off(3)

      spent = 0.0_dp
      do while (times%count < repeats .and. spent < enough)
         start = clock_ms()
         call solve_fitted(lattice, p*lattice%closing_pressure, accuracy, answer)
         time = clock_ms() - start
         call times%add(time)
         spent = spent + time
      end do
      call solve_fitted(lattice, p*lattice%closing_pressure, finest, truth)
      off = [answer%mean_gap, answer%area_fraction, answer%peak_pressure] &
            - [truth%mean_gap, truth%area_fraction, truth%peak_pressure]
      write (output_unit, '(2x, a9, es9.1, f7.3, i7, i6, 2f10.3, 6es11.1)') name, accuracy, p, answer%degree, &
         answer%iterations, times%median(), times%least(), off(1), answer%mean_gap_error, off(2), answer%area_error, &
         off(3), answer%peak_error
   end subroutine measure

   subroutine measure_sweep(name, accuracy)
      character(*), intent(in) :: name
      real(dp), intent(in) :: accuracy

      type(fitted_answer) :: answer, last
      real(dp) :: start
      integer :: j

      start = clock_ms()
      do j = 1, sweep
         call solve_fitted(lattice, j*lattice%closing_pressure/(sweep + 1), accuracy, answer, last)
         last = answer
      end do
      write (output_unit, '(2x, a9, es9.1, f10.3)') name, accuracy, (clock_ms() - start)/1000
   end subroutine measure_sweep

end program bench_expansions
