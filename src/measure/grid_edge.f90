!> The edge of contact of a solution on the points of a grid, placed better than between two points.
!>
!> The grid has M x N points of a quarter of the cell at phi = pi (i - 1/2)/M, theta = pi (j - 1/2)/N; its mirror images
!> fill the plane. Outside the contact the gap grows as the power 3/2 of the distance d from the edge, so that
!> gap^(2/3) over two points outside leads back to d = 0.
module wavycon_grid_edge
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, corner_k, corner_l, edge_point
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: length_inside
   implicit none (type, external)
   private

   public :: grid_edge, grid_contact_area, grid_crest_pressure, grid_strip_edges, start_grid_edge

   type, extends(contact_edge) :: grid_edge
      real(dp), allocatable :: pressure(:, :)   !! positive in contact, else zero, shape (M, N)
      real(dp), allocatable :: gap(:, :)        !! in any unit
   contains
      procedure :: in_contact
      procedure :: angles
      procedure :: side
   end type grid_edge

contains

   pure subroutine start_grid_edge(edge, pressure, gap)
      type(grid_edge), intent(out) :: edge
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, else zero, shape (M, N); N = 1 for a 1-D wave
      real(dp), intent(in) :: gap(:, :)        !! in any unit

      allocate (edge%pressure, source=pressure)
      allocate (edge%gap, source=gap)
      edge%period = 2*shape(pressure)
   end subroutine start_grid_edge

   pure logical function in_contact(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%pressure(mirrored(k, size(self%gap, 1)), mirrored(l, size(self%gap, 2))) > 0.0_dp
   end function in_contact

   pure subroutine angles(self, k, l, phi, theta)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l
      real(dp), intent(out) :: phi, theta

      phi = pi*(k - 0.5_dp)/size(self%gap, 1)
      theta = pi*(l - 0.5_dp)/size(self%gap, 2)
   end subroutine angles

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
      t = way_to_edge(self%gap, k_in, l_in, k_out - k_in, l_out - l_in)
      call self%angles(k_in, l_in, phi_in, theta_in)
      call self%angles(k_out, l_out, phi_out, theta_out)
      point%phi = phi_in + t*(phi_out - phi_in)
      point%theta = theta_in + t*(theta_out - theta_in)
   end function side

   !> How far the edge is from a point in contact towards its neighbour out of it, 0 .. 1.
   pure real(dp) function way_to_edge(gap, i, j, di, dj) result(way)
      real(dp), intent(in) :: gap(:, :)
      integer, intent(in) :: i, j     !! the point in contact
      integer, intent(in) :: di, dj   !! the step to its neighbour

      real(dp) :: near, far
      integer :: m, n

      m = size(gap, 1)
      n = size(gap, 2)
      near = max(gap(mirrored(i + di, m), mirrored(j + dj, n)), 0.0_dp)**(2.0_dp/3)
      far = max(gap(mirrored(i + 2*di, m), mirrored(j + 2*dj, n)), 0.0_dp)**(2.0_dp/3)
      way = 0.5_dp
      if (far > near) way = min(max(1.0_dp - near/(far - near), 0.0_dp), 1.0_dp)
   end function way_to_edge

   !> The part of the surface in contact.
   pure real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      real(dp), allocatable :: edges(:)
      real(dp) :: area, part
      integer :: i, j, m, n

      m = size(edge%gap, 1)
      n = size(edge%gap, 2)
      if (n == 1) then
         call grid_strip_edges(edge, edges)
         fraction = length_inside(edges, edge%in_contact(1, 1))/pi
         return
      end if

      area = 0.0_dp
      ! Of the cells between points those at the rim of the quarter are cut by its mirrors: half of each counts.
      do j = 0, n
         do i = 0, m
            part = merge(0.5_dp, 1.0_dp, i == 0 .or. i == m)*merge(0.5_dp, 1.0_dp, j == 0 .or. j == n)
            area = area + part*edge%cell_area(i, j)
         end do
      end do
      fraction = area/pi**2
   end function grid_contact_area

   !> The edges of contact between phi = 0 and pi of a 1-D wave [rad], ascending.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge
      real(dp), allocatable, intent(out) :: edges(:)

      real(dp) :: found(size(edge%gap, 1))
      integer :: i, m, count

      m = size(edge%gap, 1)
      count = 0
      do i = 1, m - 1
         if (edge%in_contact(i, 1) .eqv. edge%in_contact(i + 1, 1)) cycle
         count = count + 1
         if (edge%in_contact(i, 1)) then
            found(count) = pi*(i - 0.5_dp + way_to_edge(edge%gap, i, 1, 1, 0))/m
         else
            found(count) = pi*(i + 0.5_dp - way_to_edge(edge%gap, i + 1, 1, -1, 0))/m
         end if
      end do
      allocate (edges, source=found(:count))
   end subroutine grid_strip_edges

   !> The pressure at the crest, the origin, which the half-step grid leaves out: by the even polynomial through the nearest
   !> three points each way.
   pure real(dp) function grid_crest_pressure(pressure) result(peak)
      real(dp), intent(in) :: pressure(:, :)   !! shape (m, n), m >= 3, n >= 3 or n = 1

      real(dp), parameter :: weights(3) = [150, -25, 3]/128.0_dp

      if (size(pressure, 2) == 1) then
         peak = dot_product(weights, pressure(:3, 1))
      else
         peak = dot_product(weights, matmul(pressure(:3, :3), weights))
      end if
   end function grid_crest_pressure

   !> The point of 1..n that a point beyond the mirrors at 1/2 and n + 1/2 stands for.
   elemental integer function mirrored(i, n)
      integer, intent(in) :: i, n

      mirrored = modulo(i - 1, 2*n)
      mirrored = min(mirrored, 2*n - 1 - mirrored) + 1
   end function mirrored

   elemental subroutine swap(a, b)
      integer, intent(inout) :: a, b

      integer :: c

      c = a
      a = b
      b = c
   end subroutine swap

end module wavycon_grid_edge
