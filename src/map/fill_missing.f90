!> Fills the holes of a height map.
module wavycon_fill_missing
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_hole_equations, only: fill_by_neighbours
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: fill_holes

contains

   !> Fills all holes by the solution of Laplace's equation (M3), the surface of least slope (rms) through the heights
   !> around them: it has no hill and no valley within a hole. Errors: exit_file_trouble without memory.
   subroutine fill_holes(source, step, periodic, map, error)
      character(*), intent(in) :: source          !! of the map, for the message
      real(dp), intent(in) :: step(2)             !! between points along x and y, in one unit, > 0
      logical, intent(in) :: periodic             !! whether the map is continued periodically; if not, holes at its
                                                  !! border end there with slope zero across it
      type(measured_map), intent(inout) :: map    !! with at least one height that is there; `missing` is deallocated
      type(error_type), allocatable, intent(out) :: error

      !> Real numbers for each missing height: the equations and the vectors of the iteration, on coarser maps too.
      integer(int64), parameter :: numbers_a_hole = 16

      if (.not. has_memory_for(numbers_a_hole*count(map%missing) + size(map%missing))) then
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory to fill its holes')
         return
      end if
      call fill_by_neighbours(map%height, map%missing, step, periodic)
      deallocate (map%missing)
   end subroutine fill_holes

end module wavycon_fill_missing
