!> Plans a sequence of grids, each with half the step of the one before, and estimates whether a grid fits into memory.
!> A grid of an odd number of points n cannot be halved exactly: the grid before it has (n + 1)/2 points, whose step is
!> a little less than twice as large.
!>
!> Numbers of points are those of the part of the cell that is solved: of an even surface half the cell in 1-D and a
!> quarter in 2-D, of any other surface the whole cell. In 1-D the second number is 1.
module wavycon_grid_plan
   use wavycon_contact_tuning, only: first_points, most_points_line, most_points_plane
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, int64
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: bytes_of_grid, fast_size, fits_memory, grid_plan, plan_grids

   !> Real numbers in memory for each point, without those of the surface: pressure, undeformed gap, and the arrays of a
   !> correction or of the measures. On maps of 2048 x 2048 points 5.5 were measured, and 6.5 with a hardness.
   integer, parameter :: numbers_of_point = 7

   type :: grid_plan
      integer, allocatable :: grids(:, :)   !! points along x and y of n grids, the coarsest first, shape (2, n)
      integer :: trusted = 1                !! first grid whose error estimates include the surface's shortest waves
      logical :: lacks_waves = .false.      !! whether the last grid has no such waves: its errors are unknown
   end type grid_plan

contains

   !> Plans the grids of a surface. If points are given, the last grid has these, and the others are found by halving.
   !> Otherwise a map's own grid, or one that resolves the shortest wave, is halved as often as possible; then grids are
   !> added up to the largest number of points.
   !>
   !> N.B. The shortest wave of a height map is two steps of the map's own grid long. Coarser grids lack this wave, and
   !> the own grid has only two points to the wave. So changes from grid to grid do not show the error of these waves
   !> before the step of the own grid is halved once more, and the first trusted grid has half the map's step.
   pure type(grid_plan) function plan_grids(surface, points) result(plan)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! points of the last grid on the whole cell; zeros: the accuracy decides

      integer :: grid(2), least(2), most, maps_in_cell(2)

      maps_in_cell = 1
      if (surface%shape%is_even()) maps_in_cell(:surface%dimension) = 2
      least = 2*first_points/maps_in_cell
      if (surface%dimension == 1) least(2) = 1
      if (all(points > 0)) then
         grid = points/maps_in_cell
      else if (surface%is_height_map()) then
         grid = surface%points/maps_in_cell
      else
         grid = least*fast_size(max(1, surface%shape%last([1, 2])))
         if (surface%dimension == 1) grid(2) = 1
         least = grid
      end if
      allocate (plan%grids(2, 1), source=reshape(grid, [2, 1]))
      do while (all((plan%grids(:, 1) + 1)/2 >= least))
         plan%grids = reshape([(plan%grids(:, 1) + 1)/2, plan%grids], [2, size(plan%grids, 2) + 1])
      end do
      plan%trusted = size(plan%grids, 2)
      if (all(points > 0)) then
         ! A wave of less than two points is left out on all grids, and changes between them do not show it.
         if (.not. surface%has_free_edges) plan%lacks_waves = any(2*surface%shape%last([1, 2]) > points)
         return
      end if
      most = most_points_plane/product(maps_in_cell)
      if (surface%dimension == 1) most = most_points_line/product(maps_in_cell)
      do while (product(int(grid, int64)) <= most)
         ! In 1-D the second number stays 1.
         grid = [2, surface%dimension]*grid
         plan%grids = reshape([plan%grids, grid], [2, size(plan%grids, 2) + 1])
      end do
      if (surface%is_height_map()) plan%trusted = min(plan%trusted + 1, size(plan%grids, 2))
   end function plan_grids

   !> The least number of points, not below a given number, whose Fourier transform is fast: 1, 3 or 5 times a power of
   !> two.
   elemental integer function fast_size(number)
      integer, intent(in) :: number   !! >= 1

      integer, parameter :: factors(*) = [1, 2, 3, 4, 5]
      integer :: power

      power = 1
      do while (5*power < number)
         power = 2*power
      end do
      fast_size = minval(factors*power, factors*power >= number)
   end function fast_size

   !> Whether the available memory is enough to solve on a grid. The answer is the same on all processes that have a
   !> slab of the grid.
   logical function fits_memory(grid)
      integer, intent(in) :: grid(2)   !! points along x and y of the part of the cell that is solved

      type(grid_slab) :: slab
      integer(int64) :: points

      call slab%start(grid)
      points = int(grid(1), int64)*slab%width
      ! The indices of a slab's arrays are default integers.
      fits_memory = points <= huge(grid)
      if (fits_memory) fits_memory = slab%has_memory(numbers_of_point)
      fits_memory = .not. slab%any(.not. fits_memory)
   end function fits_memory

   !> The memory that a solution on a grid takes [byte], without that of the surface.
   pure integer(int64) function bytes_of_grid(grid)
      integer, intent(in) :: grid(2)   !! points along x and y of the part of the cell that is solved

      bytes_of_grid = storage_size(1.0_dp)/8*numbers_of_point*product(int(grid, int64))
   end function bytes_of_grid

end module wavycon_grid_plan
