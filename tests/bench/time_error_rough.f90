!> Measures the time that the grids take for a surface from a file, on the file's own grid.
!>
!>    time_error_rough FILE PRESSURE
!>
!> FILE holds a matrix of heights on a cell of side 1, PRESSURE the mean pressure over E*. The line of
!> standard output: solver, tolerance (0: the program's own), time [ms], solves behind that median,
!> residual, mean gap over the depth of the mean plane below the peak, and contact area.
program time_error_rough
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_error, only: error_type
   use wavycon_grid_cascade, only: cascade_answer, solve_by_cascade
   use wavycon_height_map_file, only: height_map_type, read_height_map
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_of_points, surface_type
   implicit none (type, external)

   integer, parameter :: repeats = 3

   type(height_map_type) :: map
   type(error_type), allocatable :: error
   type(surface_type) :: surface
   type(cascade_answer) :: answer
   type(sample_set) :: times
   character(1000) :: path, text
   real(dp) :: pressure, start
   integer :: i

   call get_command_argument(1, path)
   call get_command_argument(2, text)
   read (text, *) pressure
   call read_height_map(trim(path), 'matrix', map, error)
   if (allocated(error)) then
      write (error_unit, '(2a)') 'time_error_rough: cannot read ', trim(path)
      stop 1, quiet=.true.
   end if
   surface = surface_of_points([1.0_dp, 1.0_dp], map%height)
   do i = 1, repeats
      start = clock_ms()
      call solve_by_cascade(surface, pressure/surface%full_contact_pressure(1.0_dp), 0.0_dp, surface%points, &
                            answer)
      call times%add(clock_ms() - start)
   end do
   write (output_unit, '(a,f12.4,i4,es11.2,2es22.14)') 'wavycon-grid 0', times%median(), times%count, &
      answer%state%residual, answer%values(:2)
end program time_error_rough
