!> Plans the sequence of grids, each with half the step of the one before, and estimates whether a grid fits into
!> memory. Below a given grid of an odd number of points the step is a little less than twice as large.
!>
!> Numbers of points are those of the part of the cell that is solved: of an even surface half the cell in 1-D and a
!> quarter in 2-D, of any other surface the whole cell. In 1-D the second number is 1.
module wavycon_grid_plan
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_tuning, only: first_points, most_points_line, most_points_plane
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: bytes_of_grid, fast_size, fits_memory, grid_plan, plan_grids

   !> Real numbers for each point besides the surface: pressure, undeformed gap, and the memory of a correction or of
   !> the measures. On maps of 2048 x 2048 points 5.5 were measured, with a hardness 6.5.
   integer, parameter :: numbers_of_point = 7

   type :: grid_plan
      integer :: first(2) = 1     !! the coarsest grid
      integer :: trusted(2) = 1   !! the first grid whose error estimates include the shortest waves of the surface
      integer :: last(2) = 1      !! the finest grid
      integer, private :: base(2) = 1   !! the grid that the coarser ones follow from
   contains
      procedure :: next
   end type grid_plan

contains

   !> Plans the grids of a surface.
   !>
   !> N.B. The shortest waves of a height map have two steps of its own grid. Coarser grids lack these waves, and the
   !> map's own grid has only two points to each: changes from grid to grid do not show their error before the step is
   !> halved once more. So the first trusted grid has half the step of the map's.
   pure type(grid_plan) function plan_grids(surface, points) result(plan)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! of the last grid's whole cell; zeros: the accuracy decides

      integer :: least(2), parts(2)

      parts = merge(2, 1, surface%shape%is_even())
      if (surface%dimension == 1) parts(2) = 1
      least = 2*first_points/parts
      if (surface%dimension == 1) least(2) = 1
      if (all(points > 0)) then
         plan%last = points/parts
         plan%trusted = plan%last
         plan%base = plan%last
         plan%first = coarsest(plan%base, least)
      else if (all(surface%points > 0)) then
         plan%last = finest(surface%points/parts, surface)
         plan%trusted = min(2*surface%points/parts, plan%last)
         plan%base = surface%points/parts
         plan%first = coarsest(plan%base, least)
      else
         plan%first = least*fast_size(max(1, surface%shape%last([1, 2])))
         if (surface%dimension == 1) plan%first(2) = 1
         plan%trusted = plan%first
         plan%base = plan%first
         plan%last = finest(plan%first, surface)
      end if
   end function plan_grids

   !> The grid after another one of the sequence.
   pure function next(self, grid)
      class(grid_plan), intent(in) :: self
      integer, intent(in) :: grid(2)   !! first .. last
      integer :: next(2)

      next = merge(2*grid, 1, grid > 1)
      if (product(int(grid, int64)) >= product(int(self%base, int64))) return
      next = self%base
      do while (any(coarser(next) /= grid))
         next = coarser(next)
      end do
   end function next

   !> The grid of half the points each way.
   pure function coarser(grid)
      integer, intent(in) :: grid(2)
      integer :: coarser(2)

      coarser = (grid + 1)/2
   end function coarser

   !> Halves the numbers of points as often as at least `least` are left.
   pure function coarsest(grid, least)
      integer, intent(in) :: grid(2), least(2)
      integer :: coarsest(2)

      coarsest = grid
      do while (all(coarser(coarsest) >= least) .and. any(coarsest > 1))
         coarsest = coarser(coarsest)
      end do
   end function coarsest

   !> Doubles the numbers of points as often as the limits of wavycon_contact_tuning allow.
   pure function finest(grid, surface)
      integer, intent(in) :: grid(2)
      type(surface_type), intent(in) :: surface
      integer :: finest(2)

      integer :: most, twice(2)

      if (surface%dimension == 1) then
         twice = [2, 1]
         most = most_points_line
         if (.not. surface%shape%is_even()) most = 2*most
      else
         twice = 2
         most = most_points_plane
         if (.not. surface%shape%is_even()) most = 4*most
      end if
      finest = grid
      do while (product(int(finest, int64)) <= most/product(twice))
         finest = twice*finest
      end do
   end function finest

   !> The least number of points, not below a given one, whose Fourier transform is fast: 1, 3 or 5 times a power of
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

   !> Whether the available memory is enough to solve on a grid. The answer is the same on all ranks that have a slab of
   !> the grid.
   logical function fits_memory(grid)
      integer, intent(in) :: grid(2)   !! points of the part of the cell that is solved

      type(grid_slab) :: slab
      integer(int64) :: points

      call slab%start(grid)
      points = int(grid(1), int64)*slab%width
      ! Arrays of a slab have default integers as indices.
      fits_memory = points <= huge(grid)
      if (fits_memory) fits_memory = slab%has_memory(numbers_of_point)
      fits_memory = .not. slab%any(.not. fits_memory)
   end function fits_memory

   !> The memory that it takes to solve on a grid [byte].
   pure integer(int64) function bytes_of_grid(grid)
      integer, intent(in) :: grid(2)   !! points of the part of the cell that is solved

      bytes_of_grid = storage_size(1.0_dp)/8*numbers_of_point*product(int(grid, int64))
   end function bytes_of_grid

end module wavycon_grid_plan
