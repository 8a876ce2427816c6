!> The sequence of grids, each with half the step of the one before, and whether there is memory for one.
!>
!> Grids are counted by the points of the part of the cell that is solved: in 2-D a quarter, in 1-D a half of an even
!> surface's cell, the whole cell of any other. In 1-D the second number is 1.
module wavycon_grid_plan
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_tuning, only: first_points, most_points_line, most_points_plane
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: fast_size, finer_grid, fits_memory, grid_plan, plan_grids

   type :: grid_plan
      integer :: first(2) = 1     !! the coarsest grid
      integer :: trusted(2) = 1   !! the first grid whose changes contain errors of all waves of the surface
      integer :: last(2) = 1      !! the finest grid
   end type grid_plan

contains

   !> Plans the grids of a surface.
   !>
   !> N.B. A height map is a sum of waves down to twice the step of its own points. Coarser grids leave the shortest
   !> waves out, and the map's own grid has only two points to each of them: no change up to there contains their
   !> error. So the first trusted grid has half the step of the map's.
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
         plan%first = coarsest(plan%last, least)
      else if (all(surface%points > 0)) then
         plan%last = finest(surface%points/parts, surface)
         plan%trusted = min(2*surface%points/parts, plan%last)
         plan%first = coarsest(surface%points/parts, least)
      else
         plan%first = least*fast_size(max(1, ubound(surface%shape%c)))
         if (surface%dimension == 1) plan%first(2) = 1
         plan%trusted = plan%first
         plan%last = finest(plan%first, surface)
      end if
   end function plan_grids

   !> The grid with half the step.
   pure function finer_grid(grid) result(finer)
      integer, intent(in) :: grid(2)
      integer :: finer(2)

      finer = merge(2*grid, 1, grid > 1)
   end function finer_grid

   !> A grid halved as often as its points are even and no fewer than the least are left.
   pure function coarsest(grid, least)
      integer, intent(in) :: grid(2), least(2)
      integer :: coarsest(2)

      coarsest = grid
      do while (all((mod(coarsest, 2) == 0 .and. coarsest/2 >= least) .or. coarsest == 1))
         if (all(coarsest == 1)) exit
         coarsest = max(coarsest/2, 1)
      end do
   end function coarsest

   !> A grid doubled as often as it keeps within the most points.
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
      do while (product(finest) <= most/product(twice))
         finest = twice*finest
      end do
   end function finest

   !> The next number of points whose Fourier transform is fast: 1, 3 or 5 times a power of two.
   !>
   !> With the least power p of two that 5 p reaches the number, the candidates are 5 p, 4 p and 3 p, and below
   !> them, of the numbers up to 5, 2 and 1.
   elemental integer function fast_size(number)
      integer, intent(in) :: number   !! >= 1

      integer :: power

      power = 1
      do while (5*power < number)
         power = 2*power
      end do
      fast_size = 5*power
      if (4*power >= number) fast_size = 4*power
      if (3*power >= number) fast_size = 3*power
      if (2*power >= number) fast_size = 2*power
      if (power >= number) fast_size = power
   end function fast_size

   !> Whether there is memory for the solution on a grid.
   logical function fits_memory(grid)
      integer, intent(in) :: grid(2)

      !> Numbers a point: pressure, gap, undeformed gap, four fields of the iteration, spectrum, the refined start, the
      !> edge.
      integer, parameter :: numbers = 10

      fits_memory = has_memory_for(numbers*product(int(grid, int64)))
   end function fits_memory

end module wavycon_grid_plan
