!> Measures time against error for the two-dimensional wave: the grids and the collocation fitted to the edge to ever
!> smaller accuracies, and the paper's method with ever more harmonics.
!>
!>    time_error_wave SECONDS LOAD...
!>
!> Each line of standard output is a run: solver, load, its measure of fineness (points along a side of the smallest
!> cell, degree of the polynomials, or harmonics), time [ms], solves behind that median, then mean gap, contact area
!> and peak pressure. The first line of a load, 'reference', has these values as accurately as the expansions give them,
!> and their error estimates. A series of runs ends before a run that would probably take longer than what is left
!> of SECONDS.
program time_error_wave
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_beale_contact, only: beale_contact, qp_options
   use wavycon_contact_solution, only: contact_solution
   use wavycon_fitted_solver, only: fitted_answer, solve_fitted, square_lattice, wave_lattice
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   !> The first accuracy of the grids; each is half of the last one.
   real(dp), parameter :: coarsest = 0.1_dp
   integer, parameter :: harmonics(*) = [5, 7, 9, 12, 15, 20, 25, 30]
   !> Most solves of a run, of which the median is reported, and the time limit of all but the first [ms].
   integer, parameter :: repeats = 5
   real(dp), parameter :: repeat_time = 1000.0_dp
   !> Largest ratio of the times of a run and the last one.
   real(dp), parameter :: growth = 6.0_dp

   !> Accuracy of the reference, the best that expansions reach.
   real(dp), parameter :: finest = 1e-13_dp

   type(surface_type) :: whole, wave
   type(wave_lattice) :: lattice
   real(dp) :: budget, load, end_time
   integer :: i

   budget = 1000*argument(1)
   whole = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
   wave = whole%smaller_cell()
   lattice = square_lattice()
   do i = 2, command_argument_count()
      load = argument(i)
      call write_reference(load)
      end_time = clock_ms() + budget
      call climb_grids(load, end_time)
      call climb_degrees(load)
      end_time = clock_ms() + budget
      call climb_harmonics(load, end_time)
   end do

contains

   !> The grids. Of accuracies with the same grid only the first is reported: the solution is the same.
   subroutine climb_grids(load, end_time)
      real(dp), intent(in) :: load       !! P
      real(dp), intent(in) :: end_time   !! [ms]

      type(sequence_answer) :: answer
      type(sample_set) :: times
      real(dp) :: accuracy
      integer :: points

      points = 0
      accuracy = coarsest
      do
         times = sample_set()
         call time_grids(load, accuracy, answer, times)
         if (.not. answer%accurate) exit
         ! A quarter of the cell is solved.
         if (2*size(answer%state%pressure, 1) > points) then
            points = 2*size(answer%state%pressure, 1)
            do while (again(times))
               call time_grids(load, accuracy, answer, times)
            end do
            call write_run('wavycon-grid', load, points, times, answer%values)
         end if
         if (ends_late(times, end_time)) exit
         accuracy = accuracy/2
      end do
   end subroutine climb_grids

   !> Solves on grids once more.
   subroutine time_grids(load, accuracy, answer, times)
      real(dp), intent(in) :: load       !! P
      real(dp), intent(in) :: accuracy   !! of all three values
      type(sequence_answer), intent(out) :: answer
      type(sample_set), intent(inout) :: times

      real(dp) :: start

      start = clock_ms()
      call solve_by_sequence(wave, load, accuracy, [0, 0], answer)
      call times%add(clock_ms() - start)
   end subroutine time_grids

   !> The expansions. Of accuracies with the same degree only the first is reported.
   subroutine climb_degrees(load)
      real(dp), intent(in) :: load       !! P

      integer, parameter :: last_power = 12
      type(fitted_answer) :: answer
      type(sample_set) :: times
      real(dp) :: start
      integer :: degree, power

      degree = 0
      do power = 2, last_power
         times = sample_set()
         do while (again(times))
            start = clock_ms()
            call solve_fitted(lattice, load, 10.0_dp**(-power), answer)
            call times%add(clock_ms() - start)
         end do
         if (answer%degree > degree) call write_run('wavycon-fitted', load, answer%degree, times, values_of(answer))
         degree = answer%degree
      end do
   end subroutine climb_degrees

   subroutine write_reference(load)
      real(dp), intent(in) :: load       !! P

      type(fitted_answer) :: answer

      call solve_fitted(lattice, load, finest, answer)
      write (output_unit, '(a,f6.3,6es22.14)') 'reference', load, values_of(answer), answer%mean_gap_error, &
         answer%area_error, answer%peak_error
   end subroutine write_reference

   pure function values_of(answer) result(values)
      type(fitted_answer), intent(in) :: answer
      real(dp) :: values(3)

      values = [answer%mean_gap, answer%area_fraction, answer%peak_pressure]
   end function values_of

   !> The paper's series, with constraint points on as many intervals as there are harmonics.
   subroutine climb_harmonics(load, end_time)
      real(dp), intent(in) :: load       !! P
      real(dp), intent(in) :: end_time   !! [ms]

      type(beale_contact) :: fresh, contact
      type(contact_solution) :: solution
      type(sample_set) :: times
      real(dp) :: start
      integer :: k

      do k = 1, size(harmonics)
         call fresh%start(whole, qp_options(harmonics(k), harmonics(k) + 1))
         times = sample_set()
         do while (again(times))
            contact = fresh
            start = clock_ms()
            call contact%solve(load, solution)
            call times%add(clock_ms() - start)
         end do
         if (.not. solution%is_good()) then
            write (error_unit, '(a,i0,a,f5.2)') 'time_error_wave: not solved with ', harmonics(k), &
               ' harmonics at P =', load
            cycle
         end if
         associate (m => solution%measures)
            call write_run('wavycon-beale', load, harmonics(k), times, &
                           [m%mean_gap_over_amplitude, m%contact_area_fraction, m%peak_pressure_over_pstar])
         end associate
         if (ends_late(times, end_time)) exit
      end do
   end subroutine climb_harmonics

   !> Whether a run should be solved once more.
   pure logical function again(times)
      type(sample_set), intent(in) :: times

      again = times%count == 0
      if (.not. again) again = times%count < repeats .and. (times%count + 1)*times%least() < repeat_time
   end function again

   !> Whether the run after this one would probably end too late.
   logical function ends_late(times, end_time)
      type(sample_set), intent(in) :: times   !! of this one
      real(dp), intent(in) :: end_time        !! [ms]

      real(dp) :: now

      now = clock_ms()
      ends_late = now + growth*times%least() > end_time
   end function ends_late

   subroutine write_run(solver, load, fineness, times, values)
      character(*), intent(in) :: solver
      real(dp), intent(in) :: load, values(3)
      integer, intent(in) :: fineness
      type(sample_set), intent(in) :: times

      write (output_unit, '(a,f6.3,i6,f12.4,i4,3es22.14)') solver, load, fineness, &
         times%median(), times%count, values
      flush (output_unit)
   end subroutine write_run

   !> An argument that is a number.
   real(dp) function argument(i)
      integer, intent(in) :: i   !! its place

      character(40) :: text

      call get_command_argument(i, text)
      read (text, *) argument
   end function argument

end program time_error_wave
