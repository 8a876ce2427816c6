!> The edge of contact as closed curves.
module wavycon_contact_contours
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, corner, cross, edge_point, quarter_turns
   use wavycon_kinds, only: dp
   use wavycon_region_numbers, only: find_region_numbers, region_numbers
   implicit none (type, external)
   private

   public :: contact_contour, keep_curves_of_quarter, make_strips, rotate_contours, shift_contour, trace_edges

   !> A curve with the contact on its left. Its last point is the first again; that of a curve through the whole plane
   !> is one period on. In 1-D it is the two ends of a strip.
   type :: contact_contour
      real(dp), allocatable :: phi(:), theta(:)   !! [rad], not reduced to one cell, so that the curve does not jump
      !> 1: closed, about contact; -1: closed, about a gap; 0: it goes around the periodic cell.
      integer :: turns = 0
      !> Numbers, from 1, of the regions on its left and right; in 1-D inside and after. Of a mirrored height map in 2-D
      !> a region and its mirror images have one number.
      integer :: spot = 0, pool = 0
      real(dp) :: area = 0.0_dp       !! (A1), of a strip its width times 2 pi [rad^2]
      real(dp) :: length = 0.0_dp     !! [length] if it is known better than from the points; otherwise 0
   end type contact_contour

contains

   !> All curves of one cell, which is the period of phi and theta unless another is given.
   subroutine trace_edges(edge, curves, cell, skew, numbers, with_images)
      class(contact_edge), intent(in) :: edge
      type(contact_contour), allocatable, intent(out) :: curves(:)
      !> Points of the cell along phi and theta, and the steps along phi after which it comes again in the next row of
      !> cells. Absent: those of the period, 0.
      integer, intent(in), optional :: cell(2), skew
      type(region_numbers), intent(out), optional :: numbers   !! of the points
      logical, intent(in), optional :: with_images             !! as for find_region_numbers

      type(contact_contour), allocatable :: found(:)
      type(region_numbers) :: own
      integer(int8), allocatable :: seen(:, :)   ! a bit for each side of a cell
      integer :: count, k, l, number, place(2), points(2), regions(5), steps

      points = edge%period
      if (present(cell)) points = cell
      steps = 0
      if (present(skew)) steps = skew
      call find_region_numbers(edge, points, steps, own, with_images)
      ! There are no more curves than regions, of which four images may have one number.
      allocate (found(4*(own%spots + own%pools)), seen(0:points(1) - 1, 0:points(2) - 1))
      seen = 0_int8
      count = 0
      do l = 0, points(2) - 1
         do k = 0, points(1) - 1
            ! Most cells have no edge: their corners belong to one region.
            if (k < points(1) - 1 .and. l < points(2) - 1) then
               if (all(own%at(k:k + 1, l:l + 1) == own%at(k, l))) cycle
            end if
            do number = 1, 5
               place = own%wrap(k + corner(1, number), l + corner(2, number))
               regions(number) = own%at(place(1), place(2))
            end do
            do number = 1, 4
               ! A curve with the contact on its left enters the cell where its boundary, followed counter-clockwise,
               ! leaves the contact.
               if (btest(seen(k, l), number) .or. regions(number) < 0 .or. regions(number + 1) > 0) cycle
               count = count + 1
               call trace(edge, own, [k, l], number, seen, found(count))
               found(count)%spot = regions(number)
               found(count)%pool = -regions(number + 1)
            end do
         end do
      end do
      curves = found(:count)
      if (present(numbers)) numbers = own
   end subroutine trace_edges

   !> Keeps the curves of an even contact that have a point in the quarter 0 <= phi, theta <= pi of the cell. Each is
   !> moved by whole periods to where it has the most points there. A curve across the border of the quarter is its own
   !> mirror image and extends beyond it.
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

   !> Transforms curves to axes rotated by 45 degrees: factor times the sum and the difference of the angles.
   pure subroutine rotate_contours(curves, factor)
      type(contact_contour), intent(inout) :: curves(:)
      real(dp), intent(in) :: factor

      real(dp), allocatable :: rotated(:)
      integer :: i

      do i = 1, size(curves)
         associate (x => curves(i)%phi, y => curves(i)%theta)
            ! The new axes mirror the old ones: the points are reversed, so that the contact stays on the left.
            rotated = factor*(x(size(x):1:-1) + y(size(y):1:-1))
            y = factor*(x(size(x):1:-1) - y(size(y):1:-1))
            x = rotated
            curves(i)%area = 2*factor**2*curves(i)%area
         end associate
      end do
   end subroutine rotate_contours

   !> The strips of a 1-D contact over a whole period, as curves of two points each.
   pure subroutine make_strips(edges, starts_in_contact, even, curves)
      real(dp), intent(in) :: edges(:)            !! ascending, within a period or, of an even contact, its half [rad]
      logical, intent(in) :: starts_in_contact    !! whether 0 is
      logical, intent(in) :: even
      type(contact_contour), allocatable, intent(out) :: curves(:)

      real(dp) :: ends(merge(2, 1, even)*size(edges))
      integer :: i

      ends(:size(edges)) = edges
      if (even) ends(size(edges) + 1:) = 2*pi - edges(size(edges):1:-1)
      if (starts_in_contact .and. size(ends) > 0) then
         ends = [ends(size(ends)) - 2*pi, ends(:size(ends) - 1)]
         ! The difference of two periods is not exact.
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

   !> Moves a curve into the contact, at right angles to it where the steps of the grid are 1: by the given number of
   !> steps, but at most by half of its mean radius, so that the curve of the smallest contact stays about it.
   pure subroutine shift_contour(curve, period, shift)
      type(contact_contour), intent(inout) :: curve
      integer, intent(in) :: period(2)   !! points to a period of phi and theta
      real(dp), intent(in) :: shift      !! >= 0

      real(dp), dimension(size(curve%phi)) :: along_x, along_y, x, y
      real(dp) :: distance, sides
      integer :: n

      n = size(x)
      x = curve%phi*period(1)/(2*pi)
      y = curve%theta*period(2)/(2*pi)
      ! The last point is the first again, or one period on.
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

   !> Follows one curve from an edge of a cell back to it.
   subroutine trace(edge, numbers, first_cell, first_number, seen, curve)
      class(contact_edge), intent(in) :: edge
      type(region_numbers), intent(in) :: numbers
      integer, intent(in) :: first_cell(2), first_number
      integer(int8), intent(inout) :: seen(0:, 0:)
      type(contact_contour), intent(out) :: curve

      !> To the cell beyond each side.
      integer, parameter :: step(2, 4) = reshape([0, -1, 1, 0, 0, 1, -1, 0], [2, 4])
      real(dp), allocatable :: points(:, :)   ! shape (2, *)
      type(edge_point) :: first, last, next
      integer :: cell(2), number, count, place(2), quarters

      allocate (points(2, 64))
      cell = first_cell
      number = first_number
      first = edge%side(cell(1), cell(2), number)
      last = first
      count = 0
      quarters = 0
      do
         count = count + 1
         if (count > size(points, 2)) points = reshape(points, [2, 2*size(points, 2)], pad=[0.0_dp])
         points(:, count) = last%angle
         place = numbers%wrap(cell(1), cell(2))
         if (btest(seen(place(1), place(2)), number)) exit
         seen(place(1), place(2)) = ibset(seen(place(1), place(2)), number)

         ! The curve leaves the cell through the next side, counter-clockwise, that the edge crosses (see cell_area).
         do
            number = mod(number, 4) + 1
            next = edge%side(cell(1), cell(2), number)
            if (next%number > 0) exit
         end do
         quarters = quarters + quarter_turns(last, next)
         curve%area = curve%area - edge%beside_chord(last, next) &
                      + 0.5_dp*cross(last%angle - first%angle, next%angle - first%angle)
         cell = cell + step(:, number)
         ! The opposite side.
         number = mod(number + 1, 4) + 1
         last = next
         last%number = number
      end do
      curve%turns = quarters/4
      ! (A1): the curve may go around the cell.
      curve%area = curve%area - cross(last%angle - first%angle, first%angle)
      allocate (curve%phi, source=points(1, :count))
      allocate (curve%theta, source=points(2, :count))
   end subroutine trace

end module wavycon_contact_contours
