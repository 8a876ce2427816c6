!> Size, format and statistics of a height map, for the log and the heads of tables.
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
      real(dp) :: skewness = 0.0_dp, kurtosis = 0.0_dp              !! eq. (M20); 0 of a flat map
      !> Between neighbours along x and y, across that line within the map where their root mean square is largest
      !> [length].
      real(dp) :: largest_step(2) = 0.0_dp
      !> Root mean square of the steps from the last points to the first, which are their neighbours because the map is
      !> continued periodically [length].
      real(dp) :: border_step(2) = 0.0_dp
      logical :: lacks_missing_value = .false.   !! whether the deck gives a missing_value that no height has
      logical :: is_equal_spacing = .false.   !! whether the side along y follows from equal steps along x and y
      character(:), allocatable :: length_unit                      !! that the file names, or the deck in its place
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

      real(dp), allocatable :: squares(:)   ! sums over the steps across each line along y
      integer :: j

      statistics%points = shape(height)
      statistics%format = format
      statistics%lowest = minval(height)
      statistics%highest = maxval(height)
      call take_moments(height, statistics)
      associate (m => size(height, 1), n => size(height, 2))
         allocate (squares(m - 1), source=0.0_dp)
         do j = 1, n
            squares = squares + (height(2:, j) - height(:m - 1, j))**2
            if (j < n) statistics%largest_step(2) = max(statistics%largest_step(2), &
                                                        root_mean_square(height(:, j + 1:j + 1) - height(:, j:j)))
         end do
         statistics%largest_step(1) = sqrt(maxval(squares)/n)
         statistics%border_step = [root_mean_square(height(:1, :) - height(m:, :)), &
                                   root_mean_square(height(:, :1) - height(:, n:))]
      end associate
      statistics%path = path
   end function statistics_of

   !> Finds the root mean square, skewness and kurtosis of the heights, eq. (M20).
   pure subroutine take_moments(height, statistics)
      real(dp), intent(in) :: height(:, :)                  !! over the mean [length]
      type(map_statistics), intent(inout) :: statistics     !! with the lowest and the highest

      real(dp) :: column(size(height, 1)), moments(2:4), unit
      integer :: j

      ! Powers of heights over the largest one do not overflow.
      unit = max(statistics%highest, -statistics%lowest)
      if (.not. unit > 0.0_dp) return
      moments = 0.0_dp
      do j = 1, size(height, 2)
         column = height(:, j)/unit
         moments = moments + [sum(column**2), sum(column**3), sum(column**4)]
      end do
      moments = moments/size(height)
      statistics%rms = unit*sqrt(moments(2))
      statistics%skewness = moments(3)/(moments(2)*sqrt(moments(2)))
      statistics%kurtosis = moments(4)/moments(2)**2
   end subroutine take_moments

   !> Whether the steps across the border are much larger than those across any line inside: in a periodic map they are
   !> like the others, in a tilted or cut patch as large as its heights. A mirrored map has none.
   elemental logical function is_broken_along(self, direction)
      class(map_statistics), intent(in) :: self
      integer, intent(in) :: direction   !! 1 or 2: along x or y

      is_broken_along = self%changes%edges /= 'mirror' .and. &
                        self%border_step(direction) > border_ratio*self%largest_step(direction)
   end function is_broken_along

   !> 0 of no values.
   pure real(dp) function root_mean_square(values)
      real(dp), intent(in) :: values(:, :)

      root_mean_square = sqrt(sum(values**2)/max(1, size(values)))
   end function root_mean_square

end module wavycon_map_statistics
