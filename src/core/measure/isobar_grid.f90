!> The isobar p = level of a Fourier series of the pressure, taken as the edge of contact.
!>
!> The grid has N intervals on [0, pi] in phi and in theta. The series is even and periodic, so every grid cell of the
!> plane is the image of one of these. Where the isobar crosses a line of the grid, the point is computed to rounding,
!> and with it the gradient of the pressure. Between two such points the edge is the cubic curve with the tangents of
!> the isobar at both. The error of areas then falls as the fourth power of the grid's step. With straight lines it
!> would fall as the second power.
module wavycon_isobar_grid
   use wavycon_contact_edge, only: contact_edge, edge_point
   use wavycon_cosine_table, only: cosine_table, folded
   use wavycon_fourier_series, only: evaluate_line, fourier_series
   use wavycon_kinds, only: dp, pi
   use wavycon_line_zeros, only: zero_between
   implicit none (type, external)
   private

   public :: isobar_grid, start_isobar_grid

   type, extends(contact_edge) :: isobar_grid
      integer :: intervals = 0                           !! N
      real(dp), allocatable :: pressure(:, :)            !! p - level at the nodes, shape (0:N, 0:N)
      !> Cosine coefficients along the lines of the grid of p - level and of its derivative across the line, shape
      !> (0:n, 0:N, 2). The last index is 1 for the lines theta = theta_l and 2 for the lines phi = phi_k.
      real(dp), allocatable :: along(:, :, :), across(:, :, :)
   contains
      procedure :: in_contact, set_edge_point, area_fraction
      procedure, private :: node
   end type isobar_grid

contains

   !> Evaluates the series of a pressure on the nodes and along the lines of the grid.
   subroutine start_isobar_grid(grid, pressure, level, intervals)
      type(isobar_grid), intent(out) :: grid
      type(fourier_series), intent(in) :: pressure   !! p/p*, even, in 2-D
      real(dp), intent(in) :: level                  !! pressure of the isobar [p*]
      integer, intent(in) :: intervals               !! N >= 1

      real(dp), dimension(0:ubound(pressure%c, 1), 0:intervals) :: cosines, sines
      real(dp) :: sine(0:2*intervals - 1)
      integer :: i, k, n

      n = ubound(pressure%c, 1)
      grid%intervals = intervals
      grid%period = 2*intervals
      grid%step = pi/intervals
      call pressure%evaluate_on_grid(intervals, grid%pressure)
      grid%pressure = grid%pressure - level
      cosines = transpose(cosine_table(intervals, n))
      sine = [(sin(pi*k/intervals), k=0, 2*intervals - 1)]
      do i = 0, n
         sines(i, :) = [(-i*sine(modulo(i*k, 2*intervals)), k=0, intervals)]
      end do
      allocate (grid%along(0:n, 0:intervals, 2), grid%across(0:n, 0:intervals, 2))
      grid%along(:, :, 1) = matmul(pressure%c, cosines)
      grid%across(:, :, 1) = matmul(pressure%c, sines)
      grid%along(:, :, 2) = matmul(transpose(pressure%c), cosines)
      grid%across(:, :, 2) = matmul(transpose(pressure%c), sines)
      grid%along(0, :, :) = grid%along(0, :, :) - level
   end subroutine start_isobar_grid

   !> Whether a node of the plane is within the isobar, p >= level.
   pure logical function in_contact(self, k, l)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%node(k, l) >= 0.0_dp
   end function in_contact

   !> p - level at any node of the plane.
   pure real(dp) function node(self, k, l)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l   !! any integers; the node is phi = pi k/N, theta = pi l/N

      node = self%pressure(folded(k, self%intervals), folded(l, self%intervals))
   end function node

   !> Sets the point between two nodes where p = level, and the gradient of the pressure there.
   pure subroutine set_edge_point(self, point)
      class(isobar_grid), intent(in) :: self
      type(edge_point), intent(inout) :: point   !! on entry `inner` and `outer` are set

      integer :: along, across, low(2), high(2), line
      real(dp) :: unused

      along = merge(1, 2, point%inner(2) == point%outer(2))
      across = 3 - along
      low = min(point%inner, point%outer)
      high = max(point%inner, point%outer)
      line = folded(low(across), self%intervals)
      call zero_between(self%along(:, line, along), low(along)*self%step(along), self%step(along), &
                        self%node(low(1), low(2)), self%node(high(1), high(2)), point%angle(along), point%slope(along))
      point%angle(across) = low(across)*self%step(across)
      call evaluate_line(self%across(:, line, along), point%angle(along), point%slope(across), unused)
      ! A line beyond pi is the mirror image of the line that `folded` gives: the derivative across it changes its sign.
      if (modulo(low(across), self%period(1)) > self%intervals) point%slope(across) = -point%slope(across)
   end subroutine set_edge_point

   !> The fraction of the surface with p >= level.
   pure real(dp) function area_fraction(self)
      class(isobar_grid), intent(in) :: self

      integer :: corners(0:self%intervals - 1, 0:self%intervals - 1)   ! of each cell that are in contact
      integer :: inside(0:self%intervals, 0:self%intervals), k, l
      real(dp) :: area

      inside = merge(1, 0, self%pressure >= 0.0_dp)
      associate (n => self%intervals)
         corners = inside(:n - 1, :n - 1) + inside(1:, :n - 1) + inside(:n - 1, 1:) + inside(1:, 1:)
      end associate
      area = 0.0_dp
      do l = 0, self%intervals - 1
         do k = 0, self%intervals - 1
            ! Most grid cells lie entirely inside or outside of the isobar. The others are computed by `cell_area`.
            if (mod(corners(k, l), 4) > 0) area = area + self%cell_area(k, l)
         end do
      end do
      area_fraction = area/pi**2 + count(corners == 4)/real(self%intervals, dp)**2
   end function area_fraction

end module wavycon_isobar_grid
