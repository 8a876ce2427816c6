!> The edge of contact on a grid of points, some of which are in contact.
!>
!> The edge crosses the line between two neighbouring points if exactly one of them is in contact. Extensions compute
!> where on the line, and the direction of the edge there: `isobar_grid` from a Fourier series, `grid_edge` from a
!> solution on the points themselves.
module wavycon_contact_edge
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: contact_edge, cross, edge_point, quarter_turns

   !> The point where the edge of contact crosses a side of a grid cell.
   type :: edge_point
      integer :: number = 0                    !! number of the side, 1 .. 4; 0 if the edge does not cross the side
      integer :: inner(2) = 0, outer(2) = 0    !! (k, l) of the side's end in contact and of the end outside
      real(dp) :: angle(2) = 0.0_dp            !! phi, theta of the point [rad], not reduced to one period
      real(dp) :: slope(2) = 0.0_dp            !! gradient of the pressure, which points into the contact; 0 if unknown
   end type edge_point

   !> The grid has the points (k, l) of the whole plane. A grid cell has the numbers (k, l) of its lower left corner.
   !> Its sides are numbered counter-clockwise: 1 from (k, l) to (k+1, l), 2 up, 3 back, 4 down.
   type, abstract :: contact_edge
      integer :: period(2) = 1         !! numbers of points in a period of phi and theta
      real(dp) :: step(2) = 2*pi       !! steps of the grid along phi and theta, 2 pi/period [rad]
      real(dp) :: origin(2) = 0.0_dp   !! the numbers k and l, not always integers, of phi = 0 and theta = 0
   contains
      procedure(point_in_contact), deferred :: in_contact
      procedure(edge_between_points), deferred :: set_edge_point
      procedure :: angles, side, cell_area, beside_chord
   end type contact_edge

   abstract interface
      !> Whether a point is in contact.
      pure logical function point_in_contact(self, k, l)
         import :: contact_edge
         class(contact_edge), intent(in) :: self
         integer, intent(in) :: k, l
      end function point_in_contact

      !> Sets the angles of the edge's point between two neighbouring grid points, and the gradient there if it is
      !> known.
      pure subroutine edge_between_points(self, point)
         import :: contact_edge, edge_point
         class(contact_edge), intent(in) :: self
         type(edge_point), intent(inout) :: point   !! on entry `inner` and `outer` are set
      end subroutine edge_between_points
   end interface

   !> Steps from the lower left corner of a grid cell to the first point of each side. The fifth side is the first one.
   integer, parameter, public :: corner(2, 5) = reshape([0, 0, 1, 0, 1, 1, 0, 1, 0, 0], [2, 5])

contains

   !> The angles phi, theta [rad] of a position in grid steps.
   pure function angles(self, place)
      class(contact_edge), intent(in) :: self
      real(dp), intent(in) :: place(2)   !! (k, l); fractions lie between the points
      real(dp) :: angles(2)

      angles = (place - self%origin)*self%step
   end function angles

   !> The point where the edge crosses a side of a grid cell; point%number is 0 if the edge does not cross the side.
   pure type(edge_point) function side(self, k, l, number) result(point)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l      !! the grid cell
      integer, intent(in) :: number    !! number of the side, 1 .. 4

      integer :: first(2), last(2)
      logical :: inside

      first = [k, l] + corner(:, number)
      last = [k, l] + corner(:, number + 1)
      inside = self%in_contact(first(1), first(2))
      if (inside .eqv. self%in_contact(last(1), last(2))) return
      point%number = number
      point%inner = merge(first, last, inside)
      point%outer = merge(last, first, inside)
      call self%set_edge_point(point)
   end function side

   !> The area in contact within one grid cell that the edge crosses [rad^2].
   !>
   !> The corners of the cell in contact and the edge's points on its sides form a polygon. The result is its area, less
   !> the area `beside_chord` between each chord and the edge. If the edge crosses the cell twice, the two parts in
   !> contact are taken as connected.
   pure real(dp) function cell_area(self, k, l) result(area)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l   !! the grid cell

      type(edge_point) :: points(9)
      integer :: found, number, i, next
      real(dp) :: origin(2)

      found = 0
      do number = 1, 4
         associate (first => [k, l] + corner(:, number))
            if (self%in_contact(first(1), first(2))) then
               found = found + 1
               points(found) = edge_point(angle=self%angles(real(first, dp)))
            end if
         end associate
         points(found + 1) = self%side(k, l, number)
         if (points(found + 1)%number > 0) found = found + 1
      end do

      ! Vectors start at the corner of the cell: products of the angles themselves would lose digits far from zero.
      origin = self%angles(real([k, l], dp))
      area = 0.0_dp
      do i = 1, found
         next = mod(i, found) + 1
         area = area + 0.5_dp*cross(points(i)%angle - origin, points(next)%angle - origin)
         ! Where two successive points both lie on the edge, the polygon's side between them is a chord of the edge.
         if (points(i)%number > 0 .and. points(next)%number > 0) &
            area = area - self%beside_chord(points(i), points(next))
      end do
   end function cell_area

   !> The number of right angles by which the edge turns to the left from one side of a grid cell to another. The sum
   !> over a closed edge is 4 around contact and -4 around a gap.
   pure integer function quarter_turns(from, to)
      type(edge_point), intent(in) :: from, to   !! where the edge enters and leaves the grid cell

      quarter_turns = modulo(to%number - from%number, 4) - 2
   end function quarter_turns

   !> The area between the edge within a grid cell and its chord [rad^2], positive where the edge lies on the left of
   !> the chord, which is the side of the contact. The edge is the cubic curve with the given directions at its ends. It
   !> is straight where the directions are not known or the cubic is too steep.
   pure real(dp) function beside_chord(self, from, to) result(lens)
      class(contact_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to   !! where the edge enters and leaves; `number` counts this cell's sides

      !> Largest slope of the cubic against the chord. A steeper curve is not resolved by the grid.
      real(dp), parameter :: steepest = 3.0_dp
      real(dp) :: chord(2), slopes(2)

      associate (unused => self); end associate
      chord = to%angle - from%angle
      slopes = [slope(from%slope), slope(to%slope)]
      lens = 0.0_dp
      if (maxval(abs(slopes)) < steepest) lens = dot_product(chord, chord)*(slopes(1) - slopes(2))/12

   contains

      !> The slope of the edge against the chord at a point. The gradient is at right angles to the edge, on its left.
      pure real(dp) function slope(gradient)
         real(dp), intent(in) :: gradient(2)   !! gradient of the pressure

         slope = huge(slope)
         if (cross(chord, gradient) > 0.0_dp) slope = -dot_product(gradient, chord)/cross(chord, gradient)
      end function slope

   end function beside_chord

   !> The cross product of two vectors of the plane: its component normal to the plane.
   pure real(dp) function cross(a, b)
      real(dp), intent(in) :: a(2), b(2)

      cross = a(1)*b(2) - a(2)*b(1)
   end function cross

end module wavycon_contact_edge
