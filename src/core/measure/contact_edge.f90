!> The edge of contact on a grid of points, of which some are in contact and some are not.
!>
!> The extensions compute where the edge crosses the line between two neighbouring points, and its direction there:
!> as an isobar of a series, or from a solution on the grid itself.
module wavycon_contact_edge
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_edge, cross, edge_point, quarter_turns

   !> A point of the edge of contact on the side of a cell.
   type :: edge_point
      integer :: number = 0                    !! of the side, 1 .. 4; 0: the edge does not cross it
      integer :: inner(2) = 0, outer(2) = 0    !! (k, l) of its ends in contact and outside
      real(dp) :: angle(2) = 0.0_dp            !! phi, theta [rad], in the plane
      real(dp) :: slope(2) = 0.0_dp            !! gradient of the pressure, into the contact; zero if not known
   end type edge_point

   !> Points (k, l) of the whole plane; a cell has the numbers of its lower left point. Its sides are numbered
   !> counter-clockwise: 1 from (k, l) to (k+1, l), 2 up, 3 back, 4 down.
   type, abstract :: contact_edge
      integer :: period(2) = 1         !! points to a period of phi and theta
      real(dp) :: step(2) = 2*pi       !! of the grid along phi and theta, 2 pi/period [rad]
      real(dp) :: origin(2) = 0.0_dp   !! the place of phi = theta = 0 among the points, in steps
   contains
      procedure(point_in_contact), deferred :: in_contact
      procedure(edge_between_points), deferred :: place_edge
      procedure :: angles
      procedure :: side
      procedure :: cell_area
      procedure :: beside_chord
   end type contact_edge

   abstract interface
      !> Whether a point is in contact.
      pure logical function point_in_contact(self, k, l)
         import :: contact_edge
         class(contact_edge), intent(in) :: self
         integer, intent(in) :: k, l
      end function point_in_contact

      !> Sets the place of the edge between two neighbours, and the gradient there if it is known.
      pure subroutine edge_between_points(self, point)
         import :: contact_edge, edge_point
         class(contact_edge), intent(in) :: self
         type(edge_point), intent(inout) :: point   !! its neighbours are set
      end subroutine edge_between_points
   end interface

   !> Steps from the lower left point of a cell to the first point of each side; the fifth side is the first again.
   integer, parameter, public :: corner(2, 5) = reshape([0, 0, 1, 0, 1, 1, 0, 1, 0, 0], [2, 5])

contains

   !> phi, theta of a place [rad].
   pure function angles(self, place)
      class(contact_edge), intent(in) :: self
      real(dp), intent(in) :: place(2)   !! among the points, in steps: (k, l) of a point
      real(dp) :: angles(2)

      angles = (place - self%origin)*self%step
   end function angles

   !> The point of the edge on a side of a cell, if there is one.
   pure type(edge_point) function side(self, k, l, number) result(point)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l      !! the cell
      integer, intent(in) :: number    !! of the side, 1 .. 4

      integer :: first(2), last(2)
      logical :: inside

      first = [k, l] + corner(:, number)
      last = [k, l] + corner(:, number + 1)
      inside = self%in_contact(first(1), first(2))
      if (inside .eqv. self%in_contact(last(1), last(2))) return
      point%number = number
      point%inner = merge(first, last, inside)
      point%outer = merge(last, first, inside)
      call self%place_edge(point)
   end function side

   !> The area in contact of one cell that the edge crosses [rad^2]: that of the polygon of its corners in contact and
   !> the edge's points on its sides, less what `beside_chord` gives. In a cell that the edge enters twice the two parts
   !> in contact are taken as connected.
   pure real(dp) function cell_area(self, k, l) result(area)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l

      type(edge_point) :: points(9)
      integer :: number, count, i, next
      real(dp) :: origin(2)

      count = 0
      do number = 1, 4
         associate (first => [k, l] + corner(:, number))
            if (self%in_contact(first(1), first(2))) then
               count = count + 1
               points(count) = edge_point(angle=self%angles(real(first, dp)))
            end if
         end associate
         points(count + 1) = self%side(k, l, number)
         if (points(count + 1)%number > 0) count = count + 1
      end do

      ! From the corner of the cell: products of angles of the whole plane would lose digits.
      origin = self%angles(real([k, l], dp))
      area = 0.0_dp
      do i = 1, count
         next = mod(i, count) + 1
         area = area + 0.5_dp*cross(points(i)%angle - origin, points(next)%angle - origin)
         ! No corner in contact lies between two points of the edge where the boundary of the cell leaves the contact.
         if (points(i)%number > 0 .and. points(next)%number > 0) &
            area = area - self%beside_chord(points(i), points(next))
      end do
   end function cell_area

   !> How many right angles the edge turns by from one side of a cell to another, positive where the contact is convex;
   !> their sum over a closed edge is 4 or -4.
   pure integer function quarter_turns(from, to)
      type(edge_point), intent(in) :: from, to

      quarter_turns = modulo(to%number - from%number, 4) - 2
   end function quarter_turns

   !> Area between the chord from one point of the edge to the next in a cell and the edge, on the side of the contact,
   !> which is on the left [rad^2]. The edge is the cubic curve with the directions at its ends, or straight where they
   !> are not known.
   pure real(dp) function beside_chord(self, from, to) result(lens)
      class(contact_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to   !! `number` as of sides of this cell

      real(dp), parameter :: steepest = 3.0_dp   ! a curve steeper than this against its chord is not resolved: straight
      real(dp) :: chord(2), slopes(2)

      associate (unused => self); end associate
      chord = to%angle - from%angle
      slopes = [slope(from%slope), slope(to%slope)]
      lens = 0.0_dp
      if (maxval(abs(slopes)) < steepest) lens = dot_product(chord, chord)*(slopes(1) - slopes(2))/12

   contains

      !> The slope of the curve against the chord. The tangent has the gradient on its left.
      pure real(dp) function slope(gradient)
         real(dp), intent(in) :: gradient(2)

         slope = huge(slope)
         if (cross(chord, gradient) > 0.0_dp) slope = -dot_product(gradient, chord)/cross(chord, gradient)
      end function slope

   end function beside_chord

   !> The component of a cross product out of the plane.
   pure real(dp) function cross(a, b)
      real(dp), intent(in) :: a(2), b(2)

      cross = a(1)*b(2) - a(2)*b(1)
   end function cross

end module wavycon_contact_edge
