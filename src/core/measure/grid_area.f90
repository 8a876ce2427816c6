!> The contact area of a solution on the points of a grid, interpolated between the points: eqs. (C11), (C12) of
!> src/core/contact/README.md, and in 1-D the edges of contact.
!>
!> For comparison with other programs also the counted area, the number of points in contact over the number of points,
!> and its correction (C26). Another number says how concentrated the load is in the cell.
module wavycon_grid_area
   use wavycon_assertion, only: assert
   use wavycon_contact_edge, only: edge_point
   use wavycon_grid_edge, only: balance, grid_edge
   use wavycon_kinds, only: dp, int64, pi
   use wavycon_line_zeros, only: part_inside
   implicit none (type, external)
   private

   public :: abrupt_edges, corrected_area_fraction, counted_area_fraction, edge_crossings, edge_spread, &
      grid_contact_area, grid_strip_edges, load_concentration, lone_approach, lone_points

   !> The coefficient c_p of (C26): the area, in grid cells, by which the counted area is too large for each pair of
   !> neighbouring points of which one is in contact and the other is not.
   real(dp), parameter :: area_of_change = (pi - 1.0_dp + log(2.0_dp))/24

contains

   !> The fraction of the surface in contact: (C11) in 1-D, (C12) in 2-D.
   real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`

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
      ! On a quarter of the cell the mirror line divides the grid cells before the first column of points: they are
      ! those of the column 0.
      first = edge%slab%first
      if (edge%even .and. first == 1) first = 0
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

   !> The area in contact within a column of grid cells, by (C12), in units of a grid cell.
   pure real(dp) function area_of_cells(edge, l, corners) result(area)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: l             !! the column of points before the cells
      !> For each cell how many of its corners are in contact. Cell 0 lies before the first point.
      integer, intent(in) :: corners(0:)

      real(dp) :: of_cell
      integer :: i, m

      m = edge%slab%points(1)
      area = 0.0_dp
      do i = merge(0, 1, edge%even), m
         if (corners(i) == 0) cycle
         of_cell = 1.0_dp
         if (corners(i) < 4) of_cell = edge%cell_area(i, l)/product(edge%step)
         ! The mirror lines divide the grid cells along the border of the quarter in halves, one of which counts.
         if (edge%even .and. (i == 0 .or. i == m)) of_cell = 0.5_dp*of_cell
         area = area + of_cell
      end do
      if (edge%even .and. (l == 0 .or. l == edge%slab%points(2))) area = 0.5_dp*area
   end function area_of_cells

   !> The edges of contact in 1-D, by (C11): on an even surface those between 0 and pi, otherwise those of one period
   !> from the first point on.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge              !! of a grid in 1-D
      real(dp), allocatable, intent(out) :: edges(:)   !! ascending [rad]

      real(dp) :: angle(2), distance, crossings(edge%slab%points(1))
      integer :: found, i, outwards(2)
      type(edge_point) :: point

      call assert(edge%slab%points(2) == 1, 'the grid is one of 1-D')
      found = 0
      do i = 1, size(crossings) - merge(1, 0, edge%even)
         point = edge%side(i, 1, 1)
         if (point%number == 0) cycle
         found = found + 1
         ! Distance of the edge from the point in contact, in grid steps, (C11).
         distance = balance(edge, point, edge%rule%aligned_weight) - edge%rule%aligned_offset
         outwards = point%outer - point%inner
         ! Without this bound the two edges of a contact of one point could be exchanged.
         if (.not. edge%in_contact(point%inner(1) - outwards(1), 1)) distance = max(distance, 0.0_dp)
         angle = edge%angles(point%inner + distance*outwards)
         crossings(found) = angle(1)
      end do
      allocate (edges, source=crossings(:found))
   end subroutine grid_strip_edges

   !> The number of points in contact over the number of points.
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

   !> The counted area, less c_p grid cells for each pair of neighbours that `edge_crossings` counts, (C26).
   real(dp) function corrected_area_fraction(edge) result(fraction)
      type(grid_edge), intent(in) :: edge   !! in 2-D: (C26) needs grid lines in two directions

      fraction = counted_area_fraction(edge) - area_of_change*edge_crossings(edge)/product(real(edge%slab%points, dp))
   end function corrected_area_fraction

   !> The number of pairs of neighbouring points, along both directions of the grid, of which one is in contact and the
   !> other is not. On a whole cell the last points are neighbours of the first ones. On a quarter of the cell the
   !> points next to a mirror line have their own images as neighbours.
   integer(int64) function edge_crossings(edge) result(crossings)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`

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

   !> The sum of (C17b) over the pairs of neighbours that `edge_crossings` counts: of (s(1 - s) - 1/6)/(E*/(2 l)), with
   !> the place s of the edge (C11), in the unit of gap over pressure. Along an edge in any direction the terms have the
   !> mean zero. Where the edge runs along a line of the grid they are alike and add up.
   real(dp) function edge_spread(edge) result(spread)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`

      real(dp), allocatable :: sums(:, :)
      real(dp), dimension(0:edge%slab%points(1) + 1) :: here, next
      integer :: i, j

      allocate (sums(1, edge%slab%columns()), source=0.0_dp)
      if (size(sums) > 0) next = edge%column(edge%slab%first)
      do j = edge%slab%first, edge%slab%last
         here = next
         next = edge%column(j + 1)
         if (.not. (edge%may_touch(j) .or. edge%may_touch(j + 1))) cycle
         associate (column_sum => sums(1, j - edge%slab%first + 1))
            do i = 1, edge%slab%points(1)
               if (here(i) > 0.0_dp .neqv. here(i + 1) > 0.0_dp) column_sum = column_sum + term(here(i), here(i + 1), 1)
               if (here(i) > 0.0_dp .neqv. next(i) > 0.0_dp) column_sum = column_sum + term(here(i), next(i), 2)
            end do
         end associate
      end do
      spread = sum(edge%slab%column_totals(sums))

   contains

      !> Of two neighbours along a direction, of one of them the pressure and of the other minus the gap.
      pure real(dp) function term(one, other, direction)
         real(dp), intent(in) :: one, other
         integer, intent(in) :: direction

         real(dp) :: place

         associate (pressure => max(one, other), gap => -min(one, other), stiffness => edge%stiffness(direction))
            place = pressure/(pressure + edge%rule%aligned_weight*stiffness*gap)
            term = (place*(1.0_dp - place) - 1.0_dp/6)/stiffness
         end associate
      end function term

   end function edge_spread

   !> The width, in grid steps, that (C11) misses of contacts and pools of one point on parallel ridges, summed over the
   !> lines of the grid that run most nearly across them: (C15a), (C15c).
   real(dp) function lone_points(edge, ridges) result(missed)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`
      real(dp), intent(in) :: ridges(2)     !! `waves_on_step` of the surface, not both 0

      real(dp), parameter :: of_own_load = 1.0492_dp, of_own_gap = pi + 4/pi   ! constants of (C15a)
      real(dp), allocatable :: sums(:, :)
      real(dp) :: curvature, here, sides(2), values(edge%slab%points(1), -1:1)
      real(dp) :: stiffness   ! E*/(2 l') of (C15c)
      integer :: i, j

      stiffness = stiffness_across(edge, ridges)
      allocate (sums(1, edge%slab%columns()), source=0.0_dp)
      do j = 1, edge%slab%columns()
         values = edge%beside(edge%slab%first - 1 + j, maxloc(ridges, 1))
         where (values < 0.0_dp) values = values*stiffness
         do i = 1, edge%slab%points(1)
            here = abs(values(i, 0))
            sides = abs(values(i, [-1, 1]))
            if (any(values(i, [-1, 1]) > 0.0_dp .eqv. values(i, 0) > 0.0_dp)) cycle
            if (values(i, 0) > 0.0_dp) then
               sums(1, j) = sums(1, j) + sqrt(8/pi*here/(sum(sides) + of_own_load*here)) &
                            - sum(max(here/(here + edge%rule%aligned_weight*sides) - edge%rule%aligned_offset, 0.0_dp))
            else
               curvature = sum(sides) + of_own_gap*here
               sums(1, j) = sums(1, j) + 2.0_dp &
                            - sum(sides/(sides + edge%rule%aligned_weight*here) - edge%rule%aligned_offset) &
                            - sqrt(8*pi*here/curvature + 2*((sides(2) - sides(1))/curvature)**2)
            end if
         end do
      end do
      missed = sum(edge%slab%column_totals(sums))
   end function lone_points

   !> E*/(2 l') of (C15c), in the unit of pressure over gap.
   pure real(dp) function stiffness_across(edge, ridges) result(stiffness)
      type(grid_edge), intent(in) :: edge
      real(dp), intent(in) :: ridges(2)   !! `waves_on_step` of the surface, not both 0

      stiffness = norm2(ridges*edge%stiffness)/maxval(ridges)
   end function stiffness_across

   !> The error of the approach from contacts of one or two points on parallel ridges, (C15b), in the unit of the gap,
   !> on the lines of the grid that run most nearly across them.
   real(dp) function lone_approach(edge, ridges) result(error)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`
      real(dp), intent(in) :: ridges(2)     !! `waves_on_step` of the surface, not both 0

      !> Constants of (C15b) for one point and for two.
      real(dp), parameter :: beside(2) = [1.0492_dp, 0.7759_dp], of_load(2) = [0.5288_dp, -0.2953_dp], tilt = 0.2513_dp
      real(dp), allocatable :: sums(:, :)   ! errors and contacts, half of each from either edge of a contact
      real(dp) :: bend, field(-1:2), load, middle, square, totals(2)
      real(dp) :: stiffness   ! E*/(2 l') of (C15c)
      integer :: i, inwards(2), j, k, n, side

      stiffness = stiffness_across(edge, ridges)
      allocate (sums(2, edge%slab%columns()), source=0.0_dp)
      do j = 1, edge%slab%columns()
         do i = 1, edge%slab%points(1)
            if (edge%pressure_or_gap(i, j) <= 0.0_dp) cycle
            do side = -1, 1, 2
               inwards = side*cshift([1, 0], maxloc(ridges, 1) - 1)
               field = [(edge%value_at(i + k*inwards(1), edge%slab%first - 1 + j + k*inwards(2)), k=-1, 2)]
               if (field(-1) > 0.0_dp) cycle
               sums(2, j) = sums(2, j) + 0.5_dp
               n = merge(2, 1, field(1) > 0.0_dp)
               if (field(n) > 0.0_dp) cycle
               load = sum(field(0:n - 1))/stiffness
               bend = (beside(n)*load - field(-1) - field(n))/n
               middle = (field(n) - field(-1) + tilt*(field(n - 1) - field(0))/stiffness)/((n + 1)*bend)
               square = 2/pi*load/bend
               sums(1, j) = sums(1, j) + 0.25_dp*bend*abs(0.25_dp*(n - 1) + middle**2 &
                                                          + square*(of_load(n) + 0.5_dp*log(square)))
            end do
         end do
      end do
      totals = edge%slab%column_totals(sums)
      error = totals(1)/max(totals(2), 0.5_dp)
   end function lone_approach

   !> What edges show at which the pressure falls from the hardness to zero within a step, in 1-D: what (C11) misses of
   !> the contact and of the area below the hardness, over the nominal area, (C22c), and the error of the approach, in
   !> the unit of the gap, (C22b).
   pure function abrupt_edges(contact, capped) result(missed)
      type(grid_edge), intent(in) :: contact   !! of a grid in 1-D, with p or minus the gap
      type(grid_edge), intent(in) :: capped    !! of the same grid, with H - p or minus the overlap
      real(dp) :: missed(3)

      !> Constants of (C22b), (C22c), the second for no free point and for one.
      real(dp), parameter :: of_own_load = 0.2623_dp, of_width(0:1) = [0.3574_dp, 0.8149_dp]
      real(dp) :: gaps(2), hardness, miss, place, pressures(2), values(0:contact%slab%points(1) + 1)
      integer :: edges, free, i, inner, outer

      values = contact%column(1)
      edges = 0
      missed = 0.0_dp
      do i = 1, contact%slab%points(1)
         if (values(i) > 0.0_dp .eqv. values(i + 1) > 0.0_dp) cycle
         edges = edges + 1
         inner = merge(i, i + 1, values(i) > 0.0_dp)
         outer = 2*i + 1 - inner
         free = merge(1, 0, capped%in_contact(inner, 1))
         gaps = -contact%stiffness(1)*[values(outer), capped%value_at(inner - free*(outer - inner), 1)]
         if (gaps(2) < 0.0_dp) cycle   ! two points or more are free
         pressures = [values(inner), capped%value_at(outer - free*(outer - inner), 1)]
         hardness = pressures(1) + free*pressures(2)
         place = pressures(1)/hardness - 0.5_dp
         miss = 0.5_dp*(gaps(1) - gaps(2))
         if (free == 1) miss = place*max(0.5_dp*sum(gaps) - of_own_load*hardness, 0.0_dp)
         missed = missed + [[place, (1 - 2*free)*place] + of_width(free)*exp(-pi*sum(gaps)/((1 + free)*hardness)) &
                            + contact%rule%aligned_offset &
                            - pressures/(pressures + contact%rule%aligned_weight*gaps), miss]
      end do
      missed = [missed(:2)/contact%slab%points(1), abs(missed(3))/contact%stiffness(1)/max(edges, 1)]
   end function abrupt_edges

   !> How concentrated the load is in the periodic cell: the smaller of |mean of exp(i X)| and |mean of exp(i Y)|, with
   !> the pressure as the weight of the means. The result is 1 if all load is at one point and 0 if the load is uniform.
   !> A load with the small standard deviation d along a side L has about 1 - (2 pi d/L)^2/2.
   real(dp) function load_concentration(edge) result(least)
      type(grid_edge), intent(in) :: edge   !! on the whole cell or, of an even surface, on its quarter

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
      ! Summed over the four quarters of an even load the sines cancel.
      if (edge%even) sums([3, 5]) = 0.0_dp
      least = min(norm2(sums(2:3)), norm2(sums(4:5)))
   end function load_concentration

end module wavycon_grid_area
