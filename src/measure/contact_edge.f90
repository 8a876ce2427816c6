!> The edge of contact on a grid of points, of which some are in contact and some are not.
!>
!> The extensions compute where the edge crosses the line between two neighbouring points, and its direction there:
!> as an isobar of a series, or from a solution on the grid itself.
module wavycon_contact_edge
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_edge, edge_point

   !> A point of the edge of contact on the side of a cell.
   type :: edge_point
      logical :: exists = .false.
      real(dp) :: phi = 0.0_dp, theta = 0.0_dp       !! [rad], in the plane
      real(dp) :: p_phi = 0.0_dp, p_theta = 0.0_dp   !! gradient, into the contact; zero if not known
   end type edge_point

   !> Points (k, l) of the whole plane; a cell has the numbers of its lower left point. Its sides are numbered
   !> counter-clockwise: 1 from (k, l) to (k+1, l), 2 up, 3 back, 4 down.
   type, abstract :: contact_edge
      integer :: period(2) = 1   !! points to a period of phi and theta
   contains
      procedure(point_in_contact), deferred :: in_contact
      procedure(angles_of_point), deferred :: angles
      procedure(edge_on_side), deferred :: side
      procedure :: cell_area
      procedure :: beside_chord
      procedure :: area_correction
   end type contact_edge

   abstract interface
      !> Whether a point is in contact.
      pure logical function point_in_contact(self, k, l)
         import :: contact_edge
         class(contact_edge), intent(in) :: self
         integer, intent(in) :: k, l
      end function point_in_contact

      !> The angles of a point.
      pure subroutine angles_of_point(self, k, l, phi, theta)
         import :: contact_edge, dp
         class(contact_edge), intent(in) :: self
         integer, intent(in) :: k, l
         real(dp), intent(out) :: phi, theta   !! [rad]
      end subroutine angles_of_point

      !> The point of the edge on a side of a cell, if there is one.
      pure type(edge_point) function edge_on_side(self, k, l, number)
         import :: contact_edge, edge_point
         class(contact_edge), intent(in) :: self
         integer, intent(in) :: k, l      !! the cell
         integer, intent(in) :: number    !! of the side, 1 .. 4
      end function edge_on_side
   end interface

   !> Steps from the lower left point of a cell to the first point of each side; the fifth side is the first again.
   integer, parameter, public :: corner_k(5) = [0, 1, 1, 0, 0], corner_l(5) = [0, 0, 1, 1, 0]

contains

   !> The area in contact of one cell that the edge crosses [rad^2]: that of the polygon of its corners in contact and
   !> the edge's points on its sides, less what `beside_chord` gives, with `area_correction`. In a cell that the edge
   !> enters twice the two parts in contact are taken as connected.
   pure real(dp) function cell_area(self, k, l) result(area)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l

      type(edge_point) :: points(9)
      logical :: corners(4), leaves(9)
      integer :: number, count, i, next

      corners = [(self%in_contact(k + corner_k(number), l + corner_l(number)), number=1, 4)]
      area = 0.0_dp
      count = 0
      do number = 1, 4
         if (corners(number)) then
            count = count + 1
            points(count) = edge_point()
            call self%angles(k + corner_k(number), l + corner_l(number), points(count)%phi, points(count)%theta)
            leaves(count) = .false.
         end if
         points(count + 1) = self%side(k, l, number)
         if (points(count + 1)%exists) then
            count = count + 1
            ! Along this side the boundary leaves the contact if its first corner is in contact.
            leaves(count) = corners(number)
         end if
      end do

      do i = 1, count
         next = mod(i, count) + 1
         area = area + 0.5_dp*(points(i)%phi*points(next)%theta - points(next)%phi*points(i)%theta)
         if (leaves(i)) area = area - self%beside_chord(points(i), points(next))
      end do
      area = area + self%area_correction(k, l, turns(corners))
   end function cell_area

   !> Turns of the edge in one cell, positive where the contact is convex; their sum over a closed edge is 1 or -1.
   pure real(dp) function turns(corners)
      logical, intent(in) :: corners(4)   !! whether they are in contact, counter-clockwise

      select case (count(corners))
      case (1)
         turns = 0.25_dp
      case (2)
         turns = merge(-0.5_dp, 0.0_dp, (corners(1) .eqv. corners(3)) .and. (corners(1) .neqv. corners(2)))
      case default
         turns = -0.25_dp
      end select
   end function turns

   !> Area between the chord from one point of the edge to the next and the edge, on the side of the contact, which is
   !> on the left [rad^2]. The edge is the cubic curve with the directions at its ends, or straight where they are not
   !> known.
   pure real(dp) function beside_chord(self, from, to) result(lens)
      class(contact_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to

      real(dp), parameter :: steepest = 3.0_dp   ! a curve steeper than this against its chord is not resolved: straight
      real(dp) :: c_phi, c_theta, slopes(2)

      associate (unused => self); end associate
      c_phi = to%phi - from%phi
      c_theta = to%theta - from%theta
      slopes(1) = slope(from)
      slopes(2) = slope(to)
      lens = 0.0_dp
      if (maxval(abs(slopes)) < steepest) lens = (c_phi**2 + c_theta**2)*(slopes(1) - slopes(2))/12

   contains

      pure real(dp) function slope(point)
         type(edge_point), intent(in) :: point

         real(dp) :: along, sideways

         ! The tangent has the gradient on its left: (p_theta, -p_phi).
         along = point%p_theta*c_phi - point%p_phi*c_theta
         sideways = -point%p_theta*c_theta - point%p_phi*c_phi
         slope = huge(slope)
         if (along > 0.0_dp) slope = sideways/along
      end function slope

   end function beside_chord

   !> What is added to the area of a cell through which the edge runs once [rad^2]. Here nothing is.
   pure real(dp) function area_correction(self, k, l, turns) result(area)
      class(contact_edge), intent(in) :: self
      integer, intent(in) :: k, l       !! the cell
      real(dp), intent(in) :: turns     !! of the edge in the cell, positive where the contact is convex

      associate (unused => self, unused_too => [k, l], also_unused => turns); end associate
      area = 0.0_dp
   end function area_correction

end module wavycon_contact_edge
