!> The edge of contact as closed curves.
module wavycon_edge_curves
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, corner_k, corner_l, edge_point
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: edge_curve, keep_curves_of_quarter, shift_curve, strip_ends, trace_edges, turn_curves, whole_strips

   !> A curve with the contact on its left. Its last point is the first again; that of a curve through the whole plane
   !> is one period on.
   type :: edge_curve
      real(dp), allocatable :: phi(:), theta(:)   !! [rad], not reduced to one cell, so that the curve does not jump
   end type edge_curve

contains

   !> All curves of one period of phi and theta.
   subroutine trace_edges(edge, curves)
      class(contact_edge), intent(in) :: edge
      type(edge_curve), allocatable, intent(out) :: curves(:)

      logical :: seen(4, 0:edge%period(1) - 1, 0:edge%period(2) - 1)
      type(edge_curve) :: curve
      integer :: k, l, number

      allocate (curves(0))
      seen = .false.
      do l = 0, edge%period(2) - 1
         do k = 0, edge%period(1) - 1
            do number = 1, 4
               if (seen(number, k, l) .or. .not. leaves_contact(edge, k, l, number)) cycle
               call trace(edge, k, l, number, seen, curve)
               curves = [curves, curve]
            end do
         end do
      end do
   end subroutine trace_edges

   !> The strips of an even 1-D contact with edges in 0..pi, as curves of two points each. A strip about 0 or pi extends
   !> to the mirror image of its edge.
   pure subroutine strip_ends(edges, crest_in_contact, curves)
      real(dp), intent(in) :: edges(:)             !! ascending [rad]
      logical, intent(in) :: crest_in_contact
      type(edge_curve), allocatable, intent(out) :: curves(:)

      real(dp) :: ends(size(edges) + 2)
      integer :: i, count

      count = size(edges) + merge(1, 0, crest_in_contact .and. size(edges) > 0)
      if (count > size(edges)) ends(1) = -edges(1)
      ends(count - size(edges) + 1:count) = edges
      if (mod(count, 2) == 1) then
         count = count + 1
         ends(count) = 2*pi - edges(size(edges))
      end if
      allocate (curves(count/2))
      do i = 1, count/2
         allocate (curves(i)%phi, source=ends(2*i - 1:2*i))
         allocate (curves(i)%theta(2), source=0.0_dp)
      end do
   end subroutine strip_ends

   !> Keeps the curves of an even contact that have a point in the quarter 0 <= phi, theta <= pi of the cell. Each is
   !> moved by whole periods to where it has the most points there. A curve across the border of the quarter is its own
   !> mirror image and extends beyond it.
   subroutine keep_curves_of_quarter(curves)
      type(edge_curve), allocatable, intent(inout) :: curves(:)

      type(edge_curve), allocatable :: kept(:)
      integer :: i, k, l, most, number, shift(2)
      logical :: keep(size(curves))

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
            keep(i) = most > 0
            if (.not. keep(i)) cycle
            phi = phi - 2*pi*shift(1)
            theta = theta - 2*pi*shift(2)
         end associate
      end do
      allocate (kept(count(keep)))
      number = 0
      do i = 1, size(curves)
         if (.not. keep(i)) cycle
         number = number + 1
         kept(number) = curves(i)
      end do
      call move_alloc(kept, curves)
   end subroutine keep_curves_of_quarter

   !> Transforms curves to axes turned by 45 degrees: factor times the sum and the difference of the angles.
   pure subroutine turn_curves(curves, factor)
      type(edge_curve), intent(inout) :: curves(:)
      real(dp), intent(in) :: factor

      real(dp), allocatable :: turned(:)
      integer :: i

      do i = 1, size(curves)
         associate (x => curves(i)%phi, y => curves(i)%theta)
            ! The new axes mirror the old ones: the points are reversed, so that the contact stays on the left.
            turned = factor*(x(size(x):1:-1) + y(size(y):1:-1))
            y = factor*(x(size(x):1:-1) - y(size(y):1:-1))
            x = turned
         end associate
      end do
   end subroutine turn_curves

   !> The strips of a 1-D contact over a whole period, as curves of two points each.
   pure subroutine whole_strips(edges, starts_in_contact, curves)
      real(dp), intent(in) :: edges(:)   !! an even number, ascending, within a period [rad]
      logical, intent(in) :: starts_in_contact
      type(edge_curve), allocatable, intent(out) :: curves(:)

      real(dp) :: ends(size(edges))
      integer :: i

      ends = edges
      if (starts_in_contact .and. size(edges) > 0) ends = [edges(size(edges)) - 2*pi, edges(:size(edges) - 1)]
      allocate (curves(size(edges)/2))
      do i = 1, size(curves)
         allocate (curves(i)%phi, source=ends(2*i - 1:2*i))
         allocate (curves(i)%theta(2), source=0.0_dp)
      end do
   end subroutine whole_strips

   !> Moves a curve into the contact, at right angles to it where the steps of the grid are 1: by the given number of
   !> steps, but at most by half of its mean radius, so that the curve of the smallest contact stays about it.
   pure subroutine shift_curve(curve, period, shift)
      type(edge_curve), intent(inout) :: curve
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
   end subroutine shift_curve

   !> Follows one curve from an edge of a cell back to it.
   subroutine trace(edge, first_k, first_l, first_number, seen, curve)
      class(contact_edge), intent(in) :: edge
      integer, intent(in) :: first_k, first_l, first_number
      logical, intent(inout) :: seen(:, 0:, 0:)
      type(edge_curve), intent(out) :: curve

      integer, parameter :: step_k(4) = [0, 1, 0, -1], step_l(4) = [-1, 0, 1, 0]
      integer, parameter :: opposite(4) = [3, 4, 1, 2]
      real(dp), allocatable :: phi(:), theta(:)
      type(edge_point) :: point
      integer :: k, l, number, count, wrapped_k, wrapped_l

      allocate (phi(size(seen) + 1), theta(size(seen) + 1))
      k = first_k
      l = first_l
      number = first_number
      count = 0
      do
         point = edge%side(k, l, number)
         count = count + 1
         phi(count) = point%phi
         theta(count) = point%theta
         wrapped_k = modulo(k, edge%period(1))
         wrapped_l = modulo(l, edge%period(2))
         if (seen(number, wrapped_k, wrapped_l)) exit
         seen(number, wrapped_k, wrapped_l) = .true.

         ! The curve leaves the cell through the next side, counter-clockwise, that the edge crosses (see cell_area).
         do
            number = mod(number, 4) + 1
            point = edge%side(k, l, number)
            if (point%exists) exit
         end do
         k = k + step_k(number)
         l = l + step_l(number)
         number = opposite(number)
      end do
      allocate (curve%phi, source=phi(:count))
      allocate (curve%theta, source=theta(:count))
   end subroutine trace

   !> Whether the boundary of a cell, followed counter-clockwise, leaves the contact along a side: a curve with the
   !> contact on its left enters the cell there.
   pure logical function leaves_contact(edge, k, l, number)
      class(contact_edge), intent(in) :: edge
      integer, intent(in) :: k, l, number

      leaves_contact = edge%in_contact(k + corner_k(number), l + corner_l(number)) .and. &
                       .not. edge%in_contact(k + corner_k(number + 1), l + corner_l(number + 1))
   end function leaves_contact

end module wavycon_edge_curves
