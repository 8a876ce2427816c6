!> How large a height map may be, and whether there is memory for it.
module wavycon_map_size
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_plain_text, only: escaped, integer_text
   implicit none (type, external)
   private

   public :: check_map_size, check_room, laid_along_x

   !> Fewest and most points along a side.
   integer, parameter :: least_points = 3
   integer, parameter, public :: most_points = 1048576

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
                             integer_text(most_points)//' along each side, or one row or column for a profile')
      end associate
   end subroutine check_map_size

   !> The points of a map; of one column those of a profile along x.
   pure function laid_along_x(points) result(laid)
      integer, intent(in) :: points(2)
      integer :: laid(2)

      laid = points
      if (points(1) == 1) laid = points(2:1:-1)
   end function laid_along_x

   !> Checks that there is memory for a map and its surface besides what is in use, because later allocations have no
   !> error handling. Errors: exit_file_trouble, of this process alone.
   subroutine check_room(source, points, error, slab)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: points(2)     !! along x and y
      type(error_type), allocatable, intent(out) :: error
      type(grid_slab), intent(in), optional :: slab   !! of a map that may be distributed; absent: of a whole one

      !> Real numbers for each height: the map, the Fourier coefficients, work space of the transforms.
      integer, parameter :: copies = 5
      character(:), allocatable :: words
      type(grid_slab) :: part

      part = grid_slab(points=points, width=points(2))
      if (present(slab)) part = slab
      words = ''
      if (int(points(1), int64)*part%width > huge(0)) then
         words = 'more than 2^31 points on a process: more processes are needed'
      else if (.not. part%has_memory(copies)) then
         words = 'there is not the memory for a map of this size'
      end if
      if (words /= '') call fatal_error(error, exit_file_trouble, escaped(source)//': '//words)
   end subroutine check_room

end module wavycon_map_size
