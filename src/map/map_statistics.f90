!> Size, format and statistics of a height map.
module wavycon_map_statistics
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_map_tuning, only: border_ratio
   use wavycon_prepare_map, only: map_changes
   implicit none (type, external)
   private

   public :: map_statistics, statistics_of

   type :: map_statistics
      integer :: points(2) = 0                                      !! along x and y
      character(7) :: format = ''                                   !! as of measured_map
      real(dp) :: lowest = 0.0_dp, highest = 0.0_dp, rms = 0.0_dp   !! of the heights over their mean [length]
      real(dp) :: skewness = 0.0_dp, kurtosis = 0.0_dp              !! eq. (M20); 0 of a flat map
      !> Root mean square of the steps between neighbours along x and y, across the line within the map where it is
      !> largest [length].
      real(dp) :: largest_step(2) = 0.0_dp
      !> Root mean square of the steps from the last points to the first, which are their neighbours because the map is
      !> continued periodically [length].
      real(dp) :: border_step(2) = 0.0_dp
      !> Of a map that does not repeat: slope and curvature by differences within it, see `differences_within`.
      real(dp) :: differences(2) = 0.0_dp
      integer :: spikes = 0                      !! heights far from all around them, if they were looked for
      logical :: lacks_missing_value = .false.   !! whether the deck gives a missing_value that no height has
      character(:), allocatable :: assumed_sides   !! sides that neither deck nor file gives, in words; empty if none
      character(:), allocatable :: length_unit                      !! that the file names, or the deck in its place
      type(map_changes) :: changes                                  !! of the measured map
      character(:), allocatable :: path                             !! absolute
   contains
      procedure :: is_broken_along
   end type map_statistics

contains

   !> The statistics of a map. The last digit of largest_step(1) may depend on how the map is distributed.
   type(map_statistics) function statistics_of(height, format, path, points) result(statistics)
      real(dp), intent(in) :: height(:, :)   !! over the mean [length], shape (M, N) or (M, columns of the grid's slab)
      character(*), intent(in) :: format     !! as of measured_map
      character(*), intent(in) :: path       !! absolute
      integer, intent(in), optional :: points(2)   !! M, N if the map may be distributed; shape of height if absent

      type(grid_slab) :: slab
      real(dp) :: extremes(2)

      statistics%points = shape(height)
      if (present(points)) statistics%points = points
      call slab%start(statistics%points)
      statistics%format = format
      extremes = [-minval(height), maxval(height)]
      call slab%largest(extremes)
      statistics%lowest = -extremes(1)
      statistics%highest = extremes(2)
      call take_moments(slab, height, statistics)
      call take_steps(slab, height, statistics)
      statistics%path = path
      statistics%assumed_sides = ''
   end function statistics_of

   !> Finds the root mean square, skewness and kurtosis of the heights, eq. (M20).
   subroutine take_moments(slab, height, statistics)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: height(:, :)                  !! over the mean, own columns [length]
      type(map_statistics), intent(inout) :: statistics     !! with the lowest and the highest

      real(dp) :: column(size(height, 1)), moments(2:4), parts(3, size(height, 2)), unit
      integer :: j

      ! Powers of heights over the largest one do not overflow.
      unit = max(statistics%highest, -statistics%lowest)
      if (.not. unit > 0.0_dp) return
      do j = 1, size(height, 2)
         column = height(:, j)/unit
         parts(:, j) = [sum(column**2), sum(column**3), sum(column**4)]
      end do
      moments = slab%column_totals(parts)/product(real(slab%points, dp))
      statistics%rms = unit*sqrt(moments(2))
      statistics%skewness = moments(3)/(moments(2)*sqrt(moments(2)))
      statistics%kurtosis = moments(4)/moments(2)**2
   end subroutine take_moments

   !> Finds the steps between neighbours.
   subroutine take_steps(slab, height, statistics)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: height(:, :)                  !! own columns [length]
      type(map_statistics), intent(inout) :: statistics

      real(dp) :: low(size(height, 1), 1), next(size(height, 1), 1)
      real(dp) :: across_border(1, size(height, 2))   ! squares of the steps from the last points along x to the first
      real(dp), allocatable :: squares(:)                ! sums over the steps across each line along y
      real(dp) :: step, steps(2)                         ! largest within the map along y, and that across its border
      integer :: j

      associate (m => slab%points(1), n => slab%points(2))
         call slab%halo(height, .false., low, next)
         allocate (squares(m - 1), source=0.0_dp)
         steps = 0.0_dp
         do j = 1, size(height, 2)
            squares = squares + (height(2:, j) - height(:m - 1, j))**2
            across_border(1, j) = (height(1, j) - height(m, j))**2
            if (j < size(height, 2)) then
               step = root_mean_square(height(:, j + 1) - height(:, j))
            else
               step = root_mean_square(next(:, 1) - height(:, j))
            end if
            if (slab%first - 1 + j < n) steps(1) = max(steps(1), step)
            if (slab%first - 1 + j == n) steps(2) = step
         end do
         call slab%add(squares)
         call slab%largest(steps)
         statistics%largest_step = [sqrt(maxval(squares)/n), steps(1)]
         statistics%border_step = [sqrt(sum(slab%column_totals(across_border))/n), steps(2)]
      end associate
   end subroutine take_steps

   !> Whether the steps across the border are much larger than those across any line inside: in a periodic map they are
   !> like the others, in a tilted or cut patch as large as its heights. A mirrored map has none.
   elemental logical function is_broken_along(self, direction)
      class(map_statistics), intent(in) :: self
      integer, intent(in) :: direction   !! 1 or 2: along x or y

      is_broken_along = all(self%changes%edges /= ['mirror', 'free  ']) .and. &
                        self%border_step(direction) > border_ratio*self%largest_step(direction)
   end function is_broken_along

   pure real(dp) function root_mean_square(values)
      real(dp), intent(in) :: values(:)

      root_mean_square = sqrt(sum(values**2)/size(values))
   end function root_mean_square

end module wavycon_map_statistics
