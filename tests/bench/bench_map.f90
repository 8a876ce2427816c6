!> Reads a height map and ends after a given phase, for tests/bench/own_solvers.py, which times the process.
!>
!>    bench_map FILE PHASE
!>
!> PHASE: 'start' reads nothing, 'read' reads the map, 'surface' also makes the surface on a cell of side 1,
!> 'statistics' also computes the statistics of the heights and the roughness of the surface, as the program does.
program bench_map
   use, intrinsic :: iso_fortran_env, only: error_unit
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_measured_map, only: measured_map
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_of_points, only: surface_of_points
   use wavycon_system, only: prepare_process
   implicit none (type, external)

   real(dp), parameter :: side(2) = 1.0_dp
   character(1000) :: path, phase
   type(error_type), allocatable :: error
   type(map_statistics) :: statistics
   type(measured_map) :: map
   type(roughness_type) :: roughness
   type(surface_type) :: surface

   call get_command_argument(1, path)
   call get_command_argument(2, phase)
   ! As the program does.
   call prepare_process()
   if (phase == 'start') stop
   call read_height_map(trim(path), 'auto', map, error)
   if (allocated(error)) then
      write (error_unit, '(a)') error%message
      stop 1
   end if
   map%height = map%height - sum(map%height)/size(map%height)
   if (phase == 'read') stop
   surface = surface_of_points(side, map%height)
   if (phase == 'surface') stop
   statistics = statistics_of(map%height, map%format, shape(map%height), side/shape(map%height), repeats=.true.)
   roughness = roughness_of(surface%shape, surface%amplitude, side, shape(map%height))
   ! Without output a compiler could leave the statistics out.
   if (.not. statistics%rms >= 0.0_dp .or. .not. roughness%height >= 0.0_dp) stop 1
end program bench_map
