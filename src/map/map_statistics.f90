!> Size, format and statistics of a height map, for the log.
module wavycon_map_statistics
   use wavycon_kinds, only: dp
   use wavycon_map_changes, only: map_changes
   use wavycon_map_tuning, only: border_ratio
   implicit none (type, external)
   private

   public :: map_statistics, statistics_of

   type :: map_statistics
      integer :: points(2) = 0                                      !! along x and y
      character(7) :: format = ''                                   !! as of measured_map
      real(dp) :: lowest = 0.0_dp, highest = 0.0_dp, rms = 0.0_dp   !! of the heights over their mean [length]
      real(dp) :: largest_step(2) = 0.0_dp   !! between neighbours within the map, along x and y [length]
      !> Root mean square of the steps from the last points to the first, which are their neighbours because the map is
      !> continued periodically [length].
      real(dp) :: border_step(2) = 0.0_dp
      type(map_changes) :: changes                                  !! of the measured map
      character(:), allocatable :: path                             !! absolute
   contains
      procedure :: is_broken_along
   end type map_statistics

contains

   !> The statistics of a map.
   type(map_statistics) function statistics_of(height, format, path) result(statistics)
      real(dp), intent(in) :: height(:, :)   !! over the mean [length]
      character(*), intent(in) :: format     !! as of measured_map
      character(*), intent(in) :: path       !! absolute

      statistics%points = shape(height)
      statistics%format = format
      statistics%lowest = minval(height)
      statistics%highest = maxval(height)
      statistics%rms = root_mean_square(height)
      associate (m => size(height, 1), n => size(height, 2))
         statistics%largest_step = [largest(height(2:, :) - height(:m - 1, :)), &
                                    largest(height(:, 2:) - height(:, :n - 1))]
         statistics%border_step = [root_mean_square(height(:1, :) - height(m:, :)), &
                                   root_mean_square(height(:, :1) - height(:, n:))]
      end associate
      statistics%path = path
   end function statistics_of

   !> Whether the steps at the border are larger than all others: in a periodic map they are like the others, in a
   !> tilted or cut patch as large as its heights.
   elemental logical function is_broken_along(self, direction)
      class(map_statistics), intent(in) :: self
      integer, intent(in) :: direction   !! 1 or 2: along x or y

      is_broken_along = self%border_step(direction) > self%largest_step(direction)
   end function is_broken_along

   !> The largest size of values, 0 of none.
   pure real(dp) function largest(values)
      real(dp), intent(in) :: values(:, :)

      largest = maxval([0.0_dp, maxval(abs(values))])
   end function largest

   !> 0 of no values.
   pure real(dp) function root_mean_square(values)
      real(dp), intent(in) :: values(:, :)

      root_mean_square = sqrt(sum(values**2)/max(1, size(values)))
   end function root_mean_square

end module wavycon_map_statistics
