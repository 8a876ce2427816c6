!> Measures how the errors of the boundary-fitted expansions fall with the degree of their polynomials, and what a
!> degree costs.
!>
!> N.B. The degree of a solution is not an input. The accuracy is tightened by steps, and each degree is listed once, at
!> the tightest accuracy that it meets.
program bench_degrees
   use, intrinsic :: iso_fortran_env, only: output_unit
   use samples, only: clock_ms
   use wavycon_fitted_solver, only: fitted_answer, hexagonal_lattice, solve_fitted, square_lattice, wave_lattice
   use wavycon_kinds, only: dp
   implicit none (type, external)

   !> Mean pressures over p*; spots merge at 0.2286 and, of the hexagonal wave, at 0.7119.
   real(dp), parameter :: square_loads(*) = [0.01_dp, 0.05_dp, 0.1_dp, 0.15_dp, 0.2_dp, 0.22_dp, 0.228_dp, 0.23_dp, &
                                             0.24_dp, 0.3_dp, 0.5_dp, 0.7_dp, 0.9_dp]
   real(dp), parameter :: hexagonal_loads(*) = [0.05_dp, 0.3_dp, 0.6_dp, 0.7_dp, 0.72_dp, 0.8_dp, 0.95_dp]
   !> The accuracies, each so many times the one before, and the solution that errors are taken against.
   real(dp), parameter :: loosest = 1e-1_dp, tightest = 2e-13_dp, ratio = 0.5_dp, finest = 1e-14_dp

   type(wave_lattice) :: lattice
   integer :: i

   write (output_unit, '(a)') '# Errors of expansions against the degree of their polynomials, relative, '// &
         'against the '// &
      'highest degree; the time of a load', &
      '# from nothing, all lower degrees included.', &
      '# surface         P degree terms shape_terms steps  time[ms]  gap_error area_error peak_error  largest_estimate'
   lattice = square_lattice()
   do i = 1, size(square_loads)
      call measure('wave_2d', square_loads(i))
   end do
   lattice = hexagonal_lattice()
   do i = 1, size(hexagonal_loads)
      call measure('hexagonal', hexagonal_loads(i))
   end do

contains

   subroutine measure(name, p)
      character(*), intent(in) :: name
      real(dp), intent(in) :: p

      type(fitted_answer) :: answer, last, truth
      real(dp) :: accuracy, last_time, start, time

      call solve_fitted(lattice, p*lattice%closing_pressure, finest, truth)
      last%degree = 0
      last_time = 0.0_dp
      accuracy = loosest
      do while (accuracy > tightest)
         start = clock_ms()
         call solve_fitted(lattice, p*lattice%closing_pressure, accuracy, answer)
         time = clock_ms() - start
         if (last%degree > 0 .and. answer%degree /= last%degree) call write_row(name, p, last, truth, last_time)
         ! The degree of the reference itself would show no error.
         if (answer%degree == truth%degree) return
         last = answer
         last_time = time
         accuracy = ratio*accuracy
      end do
      call write_row(name, p, last, truth, last_time)
   end subroutine measure

   subroutine write_row(name, p, answer, truth, time)
      character(*), intent(in) :: name
      real(dp), intent(in) :: p
      type(fitted_answer), intent(in) :: answer, truth
      real(dp), intent(in) :: time                      !! [ms]

      real(dp) :: off(3), estimate

      off = abs([answer%mean_gap/truth%mean_gap, answer%area_fraction/truth%area_fraction, &
                 answer%peak_pressure/truth%peak_pressure] - 1.0_dp)
      estimate = max(answer%mean_gap_error/truth%mean_gap, answer%area_error/truth%area_fraction, &
                     answer%peak_error/truth%peak_pressure)
      write (output_unit, '(2x, a9, f9.3, i7, i6, i12, i6, f10.2, 3es11.1, es18.1)') name, p, answer%degree, &
         answer%solution%basis%terms, size(answer%solution%shape%b), answer%iterations, time, off, estimate
   end subroutine write_row

end program bench_degrees
