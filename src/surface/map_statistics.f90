!> Size, format and statistics of a height map, for the log.
module wavycon_map_statistics
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: map_statistics, statistics_of

   type :: map_statistics
      integer :: points(2) = 0                                      !! along x and y
      character(6) :: format = ''                                   !! 'matrix' or 'xyz'
      real(dp) :: lowest = 0.0_dp, highest = 0.0_dp, rms = 0.0_dp   !! of the heights over their mean [length]
      character(:), allocatable :: path                             !! absolute
   end type map_statistics

contains

   !> The statistics of a map.
   type(map_statistics) function statistics_of(height, format, path) result(statistics)
      real(dp), intent(in) :: height(:, :)   !! over the mean [length]
      character(*), intent(in) :: format     !! of the file: 'matrix' or 'xyz'
      character(*), intent(in) :: path       !! absolute

      statistics%points = shape(height)
      statistics%format = format
      statistics%lowest = minval(height)
      statistics%highest = maxval(height)
      statistics%rms = sqrt(sum(height**2)/size(height))
      statistics%path = path
   end function statistics_of

end module wavycon_map_statistics
