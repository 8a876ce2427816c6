!> The edge of contact of a solution on the points of a grid, placed between the points: eqs. (C11), (C12) of
!> src/contact/README.md.
!>
!> The points are those of wavycon_grid_transform: M x N on a quarter of the cell, whose mirror images fill the
!> plane, or on the whole cell. Outside the contact the gap grows as the power 3/2 of the distance d from the edge, so
!> gap^(2/3) is linear in d, and its values at two points outside give the place d = 0.
module wavycon_grid_edge
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, corner_k, corner_l, edge_point
   use wavycon_grid_transform, only: point_angle
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: length_inside
   implicit none (type, external)
   private

   public :: grid_edge, grid_contact_area, grid_strip_edges, start_grid_edge

   type, extends(contact_edge) :: grid_edge
      !> The pressure, > 0, in contact, minus the gap, <= 0, elsewhere, in any unit, shape (M, N); N = 1 in 1-D.
      real(dp), allocatable :: pressure_or_gap(:, :)
      logical :: even = .true.   !! whether the points are those of a quarter
   contains
      procedure :: in_contact
      procedure :: angles
      procedure :: side
      procedure :: place
   end type grid_edge

contains

   pure subroutine start_grid_edge(edge, pressure, gap, even)
      type(grid_edge), intent(out) :: edge
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, zero elsewhere, in any unit, shape (M, N)
      real(dp), intent(in) :: gap(:, :)        !! in any unit, shape (M, N)
      logical, intent(in) :: even

      allocate (edge%pressure_or_gap(size(gap, 1), size(gap, 2)))
      ! Overlaps by rounding are no pressures: the pressures of the lightest loads are as small.
      edge%pressure_or_gap = merge(pressure, -max(gap, 0.0_dp), pressure > 0.0_dp)
      edge%even = even
      edge%period = merge(2, 1, even)*shape(gap)
   end subroutine start_grid_edge

   pure logical function in_contact(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%pressure_or_gap(self%place(k, 1), self%place(l, 2)) > 0.0_dp
   end function in_contact

   pure subroutine angles(self, k, l, phi, theta)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l
      real(dp), intent(out) :: phi, theta

      phi = angle(self, k, 1)
      theta = angle(self, l, 2)
   end subroutine angles

   elemental real(dp) function angle(edge, k, direction)
      class(grid_edge), intent(in) :: edge
      integer, intent(in) :: k, direction

      angle = point_angle(k, size(edge%pressure_or_gap, direction), edge%even)
   end function angle

   !> The index of the grid's point of which a point of the plane is the image.
   elemental integer function place(self, k, direction)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k           !! any
      integer, intent(in) :: direction   !! 1 or 2

      associate (n => size(self%pressure_or_gap, direction))
         if (self%even) then
            place = modulo(k - 1, 2*n)
            place = min(place, 2*n - 1 - place) + 1
         else
            place = modulo(k - 1, n) + 1
         end if
      end associate
   end function place

   pure type(edge_point) function side(self, k, l, number) result(point)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l, number

      integer :: k_in, l_in, k_out, l_out
      real(dp) :: phi_in, theta_in, phi_out, theta_out, t

      k_in = k + corner_k(number)
      l_in = l + corner_l(number)
      k_out = k + corner_k(number + 1)
      l_out = l + corner_l(number + 1)
      point%exists = self%in_contact(k_in, l_in) .neqv. self%in_contact(k_out, l_out)
      if (.not. point%exists) return
      if (self%in_contact(k_out, l_out)) then
         call swap(k_in, k_out)
         call swap(l_in, l_out)
      end if
      t = distance_to_edge(self, k_in, l_in, k_out - k_in, l_out - l_in)
      call self%angles(k_in, l_in, phi_in, theta_in)
      call self%angles(k_out, l_out, phi_out, theta_out)
      point%phi = phi_in + t*(phi_out - phi_in)
      point%theta = theta_in + t*(theta_out - theta_in)
   end function side

   !> The distance of the edge from a point in contact towards its neighbour outside, in steps, 0 .. 1 (C11).
   pure real(dp) function distance_to_edge(edge, k, l, dk, dl) result(distance)
      class(grid_edge), intent(in) :: edge
      integer, intent(in) :: k, l     !! the point in contact
      integer, intent(in) :: dk, dl   !! the step to its neighbour

      real(dp) :: first, second

      first = gap_root(1)
      second = gap_root(2)
      if (second >= 2*first) then
         distance = 1.0_dp
         if (first > 0.0_dp) distance = 1.0_dp - first/(second - first)
      else
         ! The gap is one or two points wide: linear from 0, where the line above ends, to half a step.
         distance = 0.25_dp*(2.0_dp - second/first)
      end if

   contains

      pure real(dp) function gap_root(steps)
         integer, intent(in) :: steps

         gap_root = max(-edge%pressure_or_gap(edge%place(k + steps*dk, 1), edge%place(l + steps*dl, 2)), &
                        0.0_dp)**(2.0_dp/3)
      end function gap_root

   end function distance_to_edge

   !> The fraction of the surface in contact (C12).
   pure real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      real(dp), allocatable :: edges(:)
      real(dp) :: area, share
      integer :: i, j, m, n

      m = size(edge%pressure_or_gap, 1)
      n = size(edge%pressure_or_gap, 2)
      if (n == 1) then
         call grid_strip_edges(edge, edges)
         if (edge%even) then
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, pi)/pi
         else
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, 2*pi)/(2*pi)
         end if
         return
      end if

      area = 0.0_dp
      if (edge%even) then
         ! The mirror lines divide the cells at the rim of the quarter: half of each counts.
         do j = 0, n
            do i = 0, m
               share = merge(0.5_dp, 1.0_dp, i == 0 .or. i == m)*merge(0.5_dp, 1.0_dp, j == 0 .or. j == n)
               area = area + share*edge%cell_area(i, j)
            end do
         end do
         fraction = area/pi**2
      else
         do j = 1, n
            do i = 1, m
               area = area + edge%cell_area(i, j)
            end do
         end do
         fraction = area/(2*pi)**2
      end if
   end function grid_contact_area

   !> The edges of contact in 1-D, ascending [rad]: between 0 and pi of an even surface, otherwise within a period from
   !> the first point.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge
      real(dp), allocatable, intent(out) :: edges(:)

      real(dp) :: found(size(edge%pressure_or_gap, 1))
      integer :: i, count

      count = 0
      do i = 1, size(found) - merge(1, 0, edge%even)
         if (edge%in_contact(i, 1) .eqv. edge%in_contact(i + 1, 1)) cycle
         count = count + 1
         if (edge%in_contact(i, 1)) then
            found(count) = angle(edge, i, 1) &
                           + distance_to_edge(edge, i, 1, 1, 0)*(angle(edge, 2, 1) - angle(edge, 1, 1))
         else
            found(count) = angle(edge, i + 1, 1) &
                           - distance_to_edge(edge, i + 1, 1, -1, 0)*(angle(edge, 2, 1) - angle(edge, 1, 1))
         end if
      end do
      allocate (edges, source=found(:count))
   end subroutine grid_strip_edges

   elemental subroutine swap(a, b)
      integer, intent(inout) :: a, b

      integer :: c

      c = a
      a = b
      b = c
   end subroutine swap

end module wavycon_grid_edge
