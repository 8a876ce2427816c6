!> The area of contact of a solution on the points of a grid, by the edge between the points: eqs. (C11), (C12) of
!> src/contact/README.md. In 1-D also the edges.
module wavycon_grid_area
   use wavycon_assertion, only: assert
   use wavycon_constants, only: pi
   use wavycon_grid_edge, only: aligned_part, angle_steps, balance, grid_edge
   use wavycon_grid_points, only: point_angle
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: length_inside
   implicit none (type, external)
   private

   public :: grid_contact_area, grid_strip_edges

contains

   !> The fraction of the surface in contact: (C11) in 1-D, (C12) in 2-D. After `fetch_neighbours`.
   real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      real(dp), allocatable :: areas(:, :), edges(:)
      integer :: j

      if (edge%slab%points(2) == 1) then
         call grid_strip_edges(edge, edges)
         if (edge%even) then
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, pi)/pi
         else
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, 2*pi)/(2*pi)
         end if
         return
      end if

      allocate (areas(1, edge%slab%columns()))
      do j = edge%slab%first, edge%slab%last
         areas(1, j - edge%slab%first + 1) = area_of_cells(edge, j)
      end do
      ! The mirror line divides the cells at the rim of the quarter.
      if (edge%even .and. edge%slab%first == 1 .and. edge%slab%columns() > 0) &
         areas(1, 1) = areas(1, 1) + area_of_cells(edge, 0)
      fraction = max(sum(edge%slab%column_totals(areas)), 0.0_dp)/edge%number_of_points()
   end function grid_contact_area

   !> The area in contact of a column of cells [cells], by (C12).
   pure real(dp) function area_of_cells(edge, l) result(area)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: l   !! the column of points before

      logical :: high(0:edge%slab%points(1) + 1), low(0:edge%slab%points(1) + 1)
      real(dp) :: share, steps(2)
      integer :: i, m

      m = edge%slab%points(1)
      steps = angle_steps(edge)
      low = edge%column(l) > 0.0_dp
      high = edge%column(l + 1) > 0.0_dp
      area = 0.0_dp
      if (.not. any(low) .and. .not. any(high)) return
      do i = merge(0, 1, edge%even), m
         share = 1.0_dp
         if (edge%even) then
            ! The mirror lines divide the cells at the rim of the quarter: half of each counts.
            share = merge(0.5_dp, 1.0_dp, i == 0 .or. i == m) &
                    *merge(0.5_dp, 1.0_dp, l == 0 .or. l == edge%slab%points(2))
         end if
         if (all([low(i:i + 1), high(i:i + 1)])) then
            area = area + share
         else if (any([low(i:i + 1), high(i:i + 1)])) then
            area = area + share*(edge%cell_area(i, l)/product(steps) &
                                 + edge%rule%turn_area*turns(low(i:i + 1), high(i:i + 1)) &
                                 + aligned_part(edge, i, l, low(i:i + 1), high(i:i + 1)))
         end if
      end do
   end function area_of_cells

   !> Turns of the edge in one cell, positive where the contact is convex; their sum over a closed edge is 1 or -1.
   !> Parts in contact that meet at a corner are taken as connected, as in cell_area.
   pure real(dp) function turns(low, high)
      logical, intent(in) :: low(2), high(2)   !! whether the corners are in contact

      select case (count([low, high]))
      case (1)
         turns = 0.25_dp
      case (2)
         turns = merge(-0.5_dp, 0.0_dp, (low(1) .eqv. high(2)) .and. (low(1) .neqv. low(2)))
      case default
         turns = -0.25_dp
      end select
   end function turns

   !> The edges of contact in 1-D, ascending [rad]: between 0 and pi of an even surface, otherwise within a period from
   !> the first point.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge
      real(dp), allocatable, intent(out) :: edges(:)

      real(dp) :: found(edge%slab%points(1)), step
      integer :: i, count

      call assert(edge%slab%points(2) == 1, 'the grid is one of 1-D')
      count = 0
      step = angle(2) - angle(1)
      do i = 1, size(found) - merge(1, 0, edge%even)
         if (edge%in_contact(i, 1) .eqv. edge%in_contact(i + 1, 1)) cycle
         count = count + 1
         if (edge%in_contact(i, 1)) then
            found(count) = angle(i) + step*distance_to_edge(edge, i, 1)
         else
            found(count) = angle(i + 1) - step*distance_to_edge(edge, i + 1, -1)
         end if
      end do
      allocate (edges, source=found(:count))

   contains

      pure real(dp) function angle(k)
         integer, intent(in) :: k

         angle = point_angle(k, edge%slab%points(1), edge%even)
      end function angle

   end subroutine grid_strip_edges

   !> The distance of the edge from a point in contact towards its neighbour outside in 1-D, in steps (C11).
   pure real(dp) function distance_to_edge(edge, k, dk) result(distance)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: k    !! the point in contact
      integer, intent(in) :: dk   !! the step to its neighbour, 1 or -1

      distance = balance(edge, k, 1, k + dk, 1, edge%rule%aligned_weight) - edge%rule%aligned_offset
      ! A contact of one point has no negative width.
      if (.not. edge%in_contact(k - dk, 1)) distance = max(distance, 0.0_dp)
   end function distance_to_edge

end module wavycon_grid_area
