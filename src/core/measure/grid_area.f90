!> The area of contact of a solution on the points of a grid, by the edge between the points: eqs. (C11), (C12) of
!> src/core/contact/README.md; in 1-D also the edges. For comparison with other programs the number of points in
!> contact, and its correction by the number of changes along the lines of the grid: (C26). How closely the load stands
!> together.
module wavycon_grid_area
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_assertion, only: assert
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: edge_point
   use wavycon_grid_edge, only: balance, grid_edge
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: part_inside
   implicit none (type, external)
   private

   public :: corrected_area_fraction, counted_area_fraction, edge_crossings, grid_contact_area, grid_strip_edges, &
      load_concentration

   !> c_p of (C26), the area by which each change makes the counted area too large, in cells of the grid.
   real(dp), parameter :: area_of_change = (pi - 1.0_dp + log(2.0_dp))/24

contains

   !> The fraction of the surface in contact: (C11) in 1-D, (C12) in 2-D. After `fetch_neighbours`.
   real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      real(dp), allocatable :: areas(:, :), edges(:)
      integer, dimension(0:edge%slab%points(1) + 1) :: here, next   ! 1 at points in contact, else 0
      integer :: first, j, m

      if (edge%slab%points(2) == 1) then
         call grid_strip_edges(edge, edges)
         fraction = part_inside(edges, edge%in_contact(1, 1), merge(pi, 2*pi, edge%even))
         return
      end if

      m = edge%slab%points(1)
      allocate (areas(1, edge%slab%columns()), source=0.0_dp)
      ! The mirror line divides the cells at the rim of the quarter.
      first = merge(0, edge%slab%first, edge%even .and. edge%slab%first == 1)
      if (size(areas) > 0) next = edge%marks(first)
      do j = first, edge%slab%last
         here = next
         next = edge%marks(j + 1)
         if (.not. (edge%may_touch(j) .or. edge%may_touch(j + 1))) cycle
         associate (area => areas(1, max(j - edge%slab%first + 1, 1)))
            area = area + area_of_cells(edge, j, here(:m) + here(1:) + next(:m) + next(1:))
         end associate
      end do
      fraction = max(sum(edge%slab%column_totals(areas)), 0.0_dp)/product(real(edge%slab%points, dp))
   end function grid_contact_area

   !> The area in contact of a column of cells [cells], by (C12).
   pure real(dp) function area_of_cells(edge, l, corners) result(area)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: l             !! the column of points before
      integer, intent(in) :: corners(0:)   !! of each cell that are in contact, from the cell before the first point

      real(dp) :: of_cell
      integer :: i, m

      m = edge%slab%points(1)
      area = 0.0_dp
      do i = merge(0, 1, edge%even), m
         if (corners(i) == 0) cycle
         of_cell = 1.0_dp
         if (corners(i) < 4) of_cell = edge%cell_area(i, l)/product(edge%step)
         ! The mirror lines divide the cells at the rim of the quarter: half of each counts.
         if (edge%even .and. (i == 0 .or. i == m)) of_cell = 0.5_dp*of_cell
         area = area + of_cell
      end do
      if (edge%even .and. (l == 0 .or. l == edge%slab%points(2))) area = 0.5_dp*area
   end function area_of_cells

   !> The edges of contact in 1-D, ascending [rad]: between 0 and pi of an even surface, otherwise within a period from
   !> the first point.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge
      real(dp), allocatable, intent(out) :: edges(:)

      real(dp) :: distance, found(edge%slab%points(1)), place(2)
      integer :: count, i
      type(edge_point) :: point

      call assert(edge%slab%points(2) == 1, 'the grid is one of 1-D')
      count = 0
      do i = 1, size(found) - merge(1, 0, edge%even)
         point = edge%side(i, 1, 1)
         if (point%number == 0) cycle
         count = count + 1
         ! In steps from the point in contact, (C11).
         distance = balance(edge, point, edge%rule%aligned_weight) - edge%rule%aligned_offset
         associate (way => point%outer - point%inner)
            ! A contact of one point has no negative width.
            if (.not. edge%in_contact(point%inner(1) - way(1), 1)) distance = max(distance, 0.0_dp)
            place = edge%angles(point%inner + distance*way)
         end associate
         found(count) = place(1)
      end do
      allocate (edges, source=found(:count))
   end subroutine grid_strip_edges

   !> Points in contact over all points.
   real(dp) function counted_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      integer(int64) :: own
      integer :: j

      own = 0
      do j = 1, edge%slab%columns()
         if (edge%may_touch(edge%slab%first - 1 + j)) own = own + count(edge%pressure_or_gap(:, j) > 0.0_dp)
      end do
      fraction = edge%slab%total_count(own)/product(real(edge%slab%points, dp))
   end function counted_area_fraction

   !> The counted area less c_p for each change from contact to gap (C26).
   real(dp) function corrected_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge   !! of a surface: a profile has no lines in a second direction

      fraction = counted_area_fraction(edge) - area_of_change*edge_crossings(edge)/product(real(edge%slab%points, dp))
   end function corrected_area_fraction

   !> Number of pairs of neighbouring points of the grid, along both directions, of which one is in contact and the
   !> other is not. On a whole cell the last points are neighbours of the first; on a quarter those next to a mirror
   !> line have their own images as neighbours.
   integer(int64) function edge_crossings(edge) result(crossings)
      type(grid_edge), intent(in) :: edge   !! with the columns of the neighbours, if the grid is distributed

      integer, dimension(0:edge%slab%points(1) + 1) :: here, next
      integer :: j, m

      m = edge%slab%points(1)
      crossings = 0
      if (edge%slab%columns() > 0) next = edge%marks(edge%slab%first)
      do j = edge%slab%first, edge%slab%last
         here = next
         next = edge%marks(j + 1)
         if (.not. (edge%may_touch(j) .or. edge%may_touch(j + 1))) cycle
         crossings = crossings + sum(abs(here(1:m) - here(2:))) + sum(abs(here(1:m) - next(1:m)))
      end do
      crossings = edge%slab%total_count(crossings)
   end function edge_crossings

   !> |mean of exp(i X)| with the pressure as weight, or of exp(i Y) if that is less: 1 if all load is at one place,
   !> about 1 - (2 pi d/L)^2/2 if it has the standard deviation d along a side L, 0 if it is distributed evenly.
   real(dp) function load_concentration(edge) result(least)
      type(grid_edge), intent(in) :: edge   !! on the whole cell or, of an even surface, its quarter

      real(dp) :: angle(2), p, sums(5)
      integer :: j, k

      sums = 0.0_dp
      do j = edge%slab%first, edge%slab%last
         if (.not. edge%may_touch(j)) cycle
         do k = 1, edge%slab%points(1)
            p = edge%pressure_or_gap(k, j - edge%slab%first + 1)
            if (p <= 0.0_dp) cycle
            angle = edge%angles(real([k, j], dp))
            sums = sums + p*[1.0_dp, cos(angle(1)), sin(angle(1)), cos(angle(2)), sin(angle(2))]
         end do
      end do
      sums = edge%slab%total(sums)
      least = 0.0_dp
      if (.not. sums(1) > 0.0_dp) return
      sums = sums/sums(1)
      ! The sines of the other quarters are those of the first with the other sign.
      if (edge%even) sums([3, 5]) = 0.0_dp
      least = min(norm2(sums(2:3)), norm2(sums(4:5)))
   end function load_concentration

end module wavycon_grid_area
