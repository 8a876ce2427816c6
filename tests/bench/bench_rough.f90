!> Solves one load of a height map on the map's own grid, for tests/bench/rough_runs.py.
!>
!>    bench_rough HEIGHTS POINTS LOAD RESIDUAL PRESSURES
!>
!> HEIGHTS holds POINTS x POINTS heights, 8 bytes each, on a cell of side 1; LOAD is the mean pressure where E* = 1/pi,
!> and RESIDUAL the tolerance (C9) of src/core/contact/README.md. PRESSURES gets the pressures in the format of HEIGHTS.
!> The line of standard output: whether it converged (T or F), processor time [s] from the heights to the pressures,
!> iterations on all grids and on the last, and transforms there and back in units of one on the last grid.
program bench_rough
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp, pi
   use wavycon_surface, only: surface_type
   use wavycon_surface_of_points, only: surface_of_points
   use wavycon_system, only: prepare_process
   implicit none (type, external)

   type(surface_type) :: surface
   type(sequence_answer) :: answer
   real(dp), allocatable :: height(:, :)
   character(1000) :: argument(5)
   real(dp) :: load, residual, full, start, finish
   integer :: i, points, unit

   if (command_argument_count() /= size(argument)) then
      write (error_unit, '(a)') 'usage: bench_rough HEIGHTS POINTS LOAD RESIDUAL PRESSURES'
      stop 1
   end if
   do i = 1, size(argument)
      call get_command_argument(i, argument(i))
   end do
   read (argument(2), *) points
   read (argument(3), *) load
   read (argument(4), *) residual
   allocate (height(points, points))
   open (newunit=unit, file=trim(argument(1)), access='stream', form='unformatted', action='read', status='old')
   read (unit) height
   close (unit)

   ! As the program does.
   call prepare_process()
   call cpu_time(start)
   surface = surface_of_points([1.0_dp, 1.0_dp], height)
   deallocate (height)
   full = surface%full_contact_pressure(1.0_dp/pi)
   call solve_by_sequence(surface, load/full, 0.0_dp, surface%points, answer, residual=residual)
   call cpu_time(finish)
   if (answer%out_of_memory) then
      write (error_unit, '(a)') 'bench_rough: the grid does not fit into memory'
      stop 1
   end if

   open (newunit=unit, file=trim(argument(5)), access='stream', form='unformatted', action='write', status='replace')
   write (unit) full*answer%state%pressure
   close (unit)
   write (output_unit, '(l1,f12.4,2i8,f10.2)') answer%state%converged, finish - start, answer%iterations, &
      answer%state%iterations, answer%transform_pairs
end program bench_rough
