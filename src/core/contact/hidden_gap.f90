!> Gaps between the points of a grid on which a height map is closed, or nearly so: eq. (C17c) of README.md in this
!> directory.
module wavycon_hidden_gap
   use wavycon_full_contact, only: full_contact_series
   use wavycon_grid_edge, only: grid_edge, make_grid_edge, pressure_per_gap
   use wavycon_grid_plan, only: fits_memory
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: unknown
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: full_contact_edge, hidden_gap_errors

   !> In 1-D and 2-D: pockets are larger than the places where the pressure of full contact is negative, and of one in
   !> 1-D a single point may be all that is seen (C17c).
   real(dp), parameter :: pocket_factor(2) = [3.0_dp, 2.0_dp]
   !> How much lower a wave of four points is midway between the two lowest of them, over the second difference there.
   real(dp), parameter :: dip = (sqrt(2.0_dp) - 1.0_dp)/2

contains

   !> The least errors of mean gap [Delta], contact area fraction and peak pressure [p*] from gaps that lie between the
   !> points, (C17c). They are `unknown` if a grid of half the step does not fit into memory.
   function hidden_gap_errors(surface, points, pbar_over_pstar, open_part, closes_at) result(errors)
      type(surface_type), intent(in) :: surface      !! a height map without free edges
      integer, intent(in) :: points(2)               !! of the grid: of a quarter of the cell if the surface is even
      real(dp), intent(in) :: pbar_over_pstar        !! P
      real(dp), intent(in) :: open_part              !! 1 - A on this grid; 0: it is closed
      real(dp), intent(out), optional :: closes_at   !! P from which on nothing is open between the points; if known
      real(dp) :: errors(3)

      integer :: fine(2)
      real(dp), dimension(3) :: between, at_points   ! as of `openings`

      fine = merge(2*points, 1, points > 1)
      errors = unknown
      if (present(closes_at)) closes_at = huge(closes_at)
      if (.not. fits_memory(fine)) return
      between = openings(surface, fine, pbar_over_pstar, is_between=.true.)
      if (present(closes_at)) closes_at = pbar_over_pstar + between(3)
      at_points = 0.0_dp
      if (open_part > 0.0_dp) at_points = openings(surface, points, pbar_over_pstar, is_between=.false.)
      errors = max([between(1) - at_points(1), pocket_factor(surface%dimension)*(between(2) - open_part), &
                    between(3) - max(at_points(3), 0.0_dp)], 0.0_dp)
   end function hidden_gap_errors

   !> Where the pressure of full contact is negative: mean gap [Delta], part of the points, the largest tension [p*]; of
   !> a grid without tension this is minus its least pressure.
   !> With `is_between` each point stands for the lowest pressure between it and its neighbours.
   function openings(surface, points, pbar_over_pstar, is_between)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: pbar_over_pstar
      logical, intent(in) :: is_between
      real(dp) :: openings(3)

      type(grid_edge) :: field
      real(dp), dimension(0:points(1) + 1) :: before, here, next
      real(dp) :: lowest(points(1))
      real(dp), allocatable :: sums(:, :)   ! of each column
      real(dp) :: deepest
      integer :: j, m

      call full_contact_edge(surface, points, pbar_over_pstar, field)
      m = points(1)
      allocate (sums(2, field%slab%columns()))
      deepest = -huge(deepest)
      do j = field%slab%first, field%slab%last
         here = field%column(j)
         lowest = here(1:m)
         if (is_between) then
            before = field%column(j - 1)
            next = field%column(j + 1)
            lowest = lowest - dip*max(here(:m - 1) + here(2:) + before(1:m) + next(1:m) - 4*lowest, 0.0_dp)
         end if
         sums(:, j - field%slab%first + 1) = [-sum(lowest, lowest < 0.0_dp), real(count(lowest < 0.0_dp), dp)]
         deepest = max(deepest, maxval(-lowest))
      end do
      openings(:2) = field%slab%column_totals(sums)/product(real(points, dp))
      openings(1) = openings(1)/minval(field%stiffness(:surface%dimension))
      openings(3:) = field%slab%largest([deepest])
   end function openings

   !> Samples the pressure of full contact [p*] on a grid, with the columns of neighbouring processes.
   subroutine full_contact_edge(surface, points, pbar_over_pstar, field)
      type(surface_type), intent(in) :: surface   !! a height map without free edges
      integer, intent(in) :: points(2)            !! of the grid: of a quarter of the cell if the surface is even
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(grid_edge), intent(out) :: field

      type(grid_transform) :: transform
      real(dp), allocatable :: pressure(:, :)

      call transform%start(points, even=surface%shape%is_even())
      allocate (pressure(transform%points(1), transform%slab%columns()))
      call transform%sample(full_contact_series(surface, pbar_over_pstar), pressure)
      call make_grid_edge(field, pressure, surface%shape%is_even(), pressure_per_gap(surface, points), transform%slab)
      call field%fetch_neighbours()
   end subroutine full_contact_edge

end module wavycon_hidden_gap
