!> The edge of contact as closed curves, contact contours, which are traced through the cells of a grid.
module wavycon_contact_contours
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_contact_edge, only: contact_edge, corner, cross, edge_point, quarter_turns
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: unknown
   use wavycon_region_numbers, only: find_region_numbers, region_numbers
   implicit none (type, external)
   private

   public :: contact_contour, keep_curves_of_quarter, make_strips, rotate_contours, shift_contour, trace_edges

   !> A curve along the edge of contact, with the contact on its left. The last point of a closed curve equals the first
   !> one. A curve that goes through the whole plane ends one or more periods from its start. In 1-D the points are the
   !> two ends of a strip of contact.
   type :: contact_contour
      real(dp), allocatable :: phi(:), theta(:)   !! [rad], not reduced to one cell, so that the curve does not jump
      !> 1: closed, around contact; -1: closed, around a gap; 0: the curve winds around the periodic cell.
      integer :: turns = 0
      !> Numbers, from 1, of the spot on the left of the curve and the pool on the right; in 1-D of the strip and of the
      !> gap after the strip. On a mirrored height map in 2-D a region and its mirror images have the same number.
      integer :: spot = 0, pool = 0
      real(dp) :: load = unknown      !! the part of the load that the spot carries
      real(dp) :: area = 0.0_dp       !! the area (A1) [rad^2]; in 1-D the width of the strip times 2 pi
      real(dp) :: length = 0.0_dp     !! length [length] if the solver knows it better than the points; otherwise 0
   end type contact_contour

contains

   !> Traces all curves of one periodic cell. By default this cell is the period of phi and theta.
   subroutine trace_edges(edge, curves, cell, skew, numbers, with_images)
      class(contact_edge), intent(in) :: edge
      type(contact_contour), allocatable, intent(out) :: curves(:)
      !> The periodic cell: its numbers of points along phi and theta, and the steps along phi by which a row of cells
      !> is shifted against the row below. Absent: the period of the edge, and 0.
      integer, intent(in), optional :: cell(2), skew
      type(region_numbers), intent(out), optional :: numbers   !! numbers of the regions that the points belong to
      logical, intent(in), optional :: with_images             !! as for find_region_numbers

      type(contact_contour), allocatable :: found(:)
      type(region_numbers) :: regions
      integer(int8), allocatable :: seen(:, :)   ! a bit for each side of a grid cell
      integer :: at_corner(5)   ! numbers of the regions at the corners of a grid cell; the fifth is the first one
      integer :: curve, k, l, number, point(2), points(2), steps

      points = edge%period
      if (present(cell)) points = cell
      steps = 0
      if (present(skew)) steps = skew
      call find_region_numbers(edge, points, steps, regions, with_images)
      ! There are at most as many curves as regions. A number may stand for a region and its three mirror images.
      allocate (found(4*(regions%spots + regions%pools)), seen(0:points(1) - 1, 0:points(2) - 1))
      seen = 0_int8
      curve = 0
      do l = 0, points(2) - 1
         do k = 0, points(1) - 1
            ! The edge does not pass through most grid cells: all their corners belong to the same region.
            if (k < points(1) - 1 .and. l < points(2) - 1) then
               if (all(regions%region_at(k:k + 1, l:l + 1) == regions%region_at(k, l))) cycle
            end if
            do number = 1, 5
               point = regions%wrap(k + corner(1, number), l + corner(2, number))
               at_corner(number) = regions%region_at(point(1), point(2))
            end do
            do number = 1, 4
               ! Follow the boundary of the grid cell counter-clockwise. A curve with the contact on its left enters the
               ! cell on the side where the boundary leaves the contact.
               if (btest(seen(k, l), number) .or. at_corner(number) < 0 .or. at_corner(number + 1) > 0) cycle
               curve = curve + 1
               call trace(edge, regions, [k, l], number, seen, found(curve))
               found(curve)%spot = at_corner(number)
               found(curve)%pool = -at_corner(number + 1)
            end do
         end do
      end do
      curves = found(:curve)
      if (present(numbers)) numbers = regions
   end subroutine trace_edges

   !> Keeps the curves of an even contact that have a point in the quarter 0 <= phi, theta <= pi of the cell. Each curve
   !> is moved by whole periods so that the most of its points lie in the quarter. A curve that crosses the border of
   !> the quarter is its own mirror image; its part beyond the border is kept.
   subroutine keep_curves_of_quarter(curves)
      type(contact_contour), allocatable, intent(inout) :: curves(:)

      type(contact_contour), allocatable :: kept(:)
      integer :: i, k, l, last, most, number, shift(2)

      allocate (kept(size(curves)))
      last = 0
      do i = 1, size(curves)
         associate (phi => curves(i)%phi, theta => curves(i)%theta)
            most = 0
            do l = floor(minval(theta)/(2*pi)), floor(maxval(theta)/(2*pi))
               do k = floor(minval(phi)/(2*pi)), floor(maxval(phi)/(2*pi))
                  number = count(phi >= 2*pi*k .and. phi <= 2*pi*k + pi .and. &
                                 theta >= 2*pi*l .and. theta <= 2*pi*l + pi)
                  if (number <= most) cycle
                  most = number
                  shift = [k, l]
               end do
            end do
            if (most == 0) cycle
            phi = phi - 2*pi*shift(1)
            theta = theta - 2*pi*shift(2)
         end associate
         last = last + 1
         kept(last) = curves(i)
      end do
      curves = kept(:last)
   end subroutine keep_curves_of_quarter

   !> Transforms curves to axes at 45 degrees: the new angles are factor*(phi + theta) and factor*(phi - theta).
   pure subroutine rotate_contours(curves, factor)
      type(contact_contour), intent(inout) :: curves(:)   !! their areas become those in the new angles
      real(dp), intent(in) :: factor

      real(dp), allocatable :: rotated(:)
      integer :: i

      do i = 1, size(curves)
         associate (x => curves(i)%phi, y => curves(i)%theta)
            ! The transformation contains a reflection. So the order of the points is reversed, which keeps the contact
            ! on the left.
            rotated = factor*(x(size(x):1:-1) + y(size(y):1:-1))
            y = factor*(x(size(x):1:-1) - y(size(y):1:-1))
            x = rotated
            curves(i)%area = 2*factor**2*curves(i)%area
         end associate
      end do
   end subroutine rotate_contours

   !> Makes the strips of a 1-D contact over one whole period, as curves of two points each.
   pure subroutine make_strips(edges, starts_in_contact, even, curves)
      !> Edges of contact, ascending, between 0 and 2 pi or, of an even contact, between 0 and pi [rad].
      real(dp), intent(in) :: edges(:)
      logical, intent(in) :: starts_in_contact    !! whether there is contact at phi = 0
      logical, intent(in) :: even                 !! whether the contact is symmetric to phi = 0 and phi = pi
      type(contact_contour), allocatable, intent(out) :: curves(:)

      real(dp), allocatable :: ends(:)
      integer :: i

      allocate (ends, source=edges)
      if (even) ends = [edges, 2*pi - edges(size(edges):1:-1)]
      if (starts_in_contact .and. size(ends) > 0) then
         ends = [ends(size(ends)) - 2*pi, ends(:size(ends) - 1)]
         ! 2 pi - edge - 2 pi would not be exactly -edge.
         if (even) ends(1) = -edges(1)
      end if
      allocate (curves(size(ends)/2))
      do i = 1, size(curves)
         allocate (curves(i)%phi, source=ends(2*i - 1:2*i))
         allocate (curves(i)%theta(2), source=0.0_dp)
         curves(i)%spot = i
         curves(i)%pool = i
         curves(i)%area = 2*pi*(ends(2*i) - ends(2*i - 1))
      end do
   end subroutine make_strips

   !> Moves each point of a curve into the contact, along the normal of the curve in coordinates in which the steps of
   !> the grid are 1. The distance is `shift` steps, but at most half of the mean radius of the curve (area over
   !> length): by more, the curve of the smallest contact would be turned inside out.
   pure subroutine shift_contour(curve, period, shift)
      type(contact_contour), intent(inout) :: curve
      integer, intent(in) :: period(2)   !! numbers of points in a period of phi and theta
      real(dp), intent(in) :: shift      !! >= 0 [steps of the grid]

      real(dp), dimension(size(curve%phi)) :: along_x, along_y, x, y
      real(dp) :: distance, sides
      integer :: n

      n = size(x)
      x = curve%phi*period(1)/(2*pi)
      y = curve%theta*period(2)/(2*pi)
      ! Central differences. The last point is the first one, perhaps one or more periods on.
      along_x(2:n - 1) = x(3:) - x(:n - 2)
      along_y(2:n - 1) = y(3:) - y(:n - 2)
      along_x([1, n]) = x(2) - x(1) + x(n) - x(n - 1)
      along_y([1, n]) = y(2) - y(1) + y(n) - y(n - 1)
      sides = sum(hypot(x(2:) - x(:n - 1), y(2:) - y(:n - 1)))
      distance = shift
      if (norm2([x(n) - x(1), y(n) - y(1)]) < 0.5_dp) distance = min(shift, &
         abs(0.5_dp*sum(x(:n - 1)*y(2:) - x(2:)*y(:n - 1)))/max(sides, tiny(sides)))
      associate (length => max(hypot(along_x, along_y), tiny(sides)))
         curve%phi = curve%phi - distance*along_y/length*(2*pi/period(1))
         curve%theta = curve%theta + distance*along_x/length*(2*pi/period(2))
      end associate
   end subroutine shift_contour

   !> Follows one curve from a side of a grid cell until the curve comes back to that side, perhaps a period on.
   subroutine trace(edge, numbers, first_cell, first_number, seen, curve)
      class(contact_edge), intent(in) :: edge
      type(region_numbers), intent(in) :: numbers
      integer, intent(in) :: first_cell(2)               !! the grid cell that the curve enters first
      integer, intent(in) :: first_number                !! number of the side through which the curve enters this cell
      integer(int8), intent(inout) :: seen(0:, 0:)       !! bit n: a curve has entered the grid cell through side n
      type(contact_contour), intent(out) :: curve        !! without the numbers of its spot and pool

      !> The step to the grid cell beyond each side.
      integer, parameter :: step(2, 4) = reshape([0, -1, 1, 0, 0, 1, -1, 0], [2, 4])
      real(dp), allocatable :: points(:, :)   ! phi, theta of the points so far, shape (2, *)
      type(edge_point) :: first, last, next
      integer :: cell(2), found, in_period(2), number, quarters

      allocate (points(2, 64))
      cell = first_cell
      number = first_number
      first = edge%side(cell(1), cell(2), number)
      last = first
      found = 0
      quarters = 0
      do
         found = found + 1
         if (found > size(points, 2)) points = reshape(points, [2, 2*size(points, 2)], pad=[0.0_dp])
         points(:, found) = last%angle
         in_period = numbers%wrap(cell(1), cell(2))
         if (btest(seen(in_period(1), in_period(2)), number)) exit
         seen(in_period(1), in_period(2)) = ibset(seen(in_period(1), in_period(2)), number)

         ! The curve leaves the cell through the next side, counter-clockwise, that the edge crosses. If the edge
         ! crosses all four sides, this joins the two parts in contact, as `cell_area` does.
         do
            number = mod(number, 4) + 1
            next = edge%side(cell(1), cell(2), number)
            if (next%number > 0) exit
         end do
         quarters = quarters + quarter_turns(last, next)
         curve%area = curve%area - edge%beside_chord(last, next) &
                      + 0.5_dp*cross(last%angle - first%angle, next%angle - first%angle)
         cell = cell + step(:, number)
         ! The curve enters the next cell through that cell's opposite side.
         number = mod(number + 1, 4) + 1
         last = next
         last%number = number
      end do
      curve%turns = quarters/4
      ! The last term of (A1), which is not zero if the curve winds around the periodic cell.
      curve%area = curve%area - cross(last%angle - first%angle, first%angle)
      allocate (curve%phi, source=points(1, :found))
      allocate (curve%theta, source=points(2, :found))
   end subroutine trace

end module wavycon_contact_contours
