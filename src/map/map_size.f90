!> How large a height map may be, and whether there is memory for it.
module wavycon_map_size
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_plain_text, only: escaped, integer_text
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: check_map_size, check_room

   !> Fewest and most points along a side; more do not fit into the memory of most machines.
   integer, parameter, public :: least_points = 4, most_points = 8192

contains

   !> Checks the number of points. Errors: exit_bad_input for a map that is too small or too large.
   subroutine check_map_size(source, points, error)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: points(2)     !! along x and y; the second is 1 for a profile
      type(error_type), allocatable, intent(out) :: error

      associate (m => points(1), n => points(2))
         if (m < least_points .or. (n < least_points .and. n /= 1) .or. max(m, n) > most_points) &
            call fatal_error(error, exit_bad_input, escaped(source)//': a map of '//integer_text(m)//' x '// &
                             integer_text(n)//' points: there must be '//integer_text(least_points)//' to '// &
                             integer_text(most_points)//' along each side, or one row for a profile')
      end associate
   end subroutine check_map_size

   !> Checks that there is memory for a map and its surface besides what is in use, because later allocations have no
   !> error handling. Errors: exit_file_trouble.
   subroutine check_room(source, heights, error)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: heights       !! of the map
      type(error_type), allocatable, intent(out) :: error

      !> Real numbers for each height: the map, the Fourier coefficients and their copies, work space of the transforms.
      integer(int64), parameter :: copies = 5

      if (.not. has_memory_for(copies*heights)) &
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory for a map of this size')
   end subroutine check_room

end module wavycon_map_size
