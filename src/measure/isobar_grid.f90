!> The isobar p = level of a pressure series as the edge of contact.
!>
!> The grid has N intervals on [0, pi] in phi and theta. The series is even and periodic, so every cell of the plane is
!> the image of one of these. Where the isobar crosses a grid line the point is solved for to rounding, and the gradient
!> of the pressure is computed there. Between two crossings the curve is the cubic through both with its tangents. The
!> error of areas then falls as the fourth power of the step; with a polygon it would fall as the second.
module wavycon_isobar_grid
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, edge_point
   use wavycon_fourier_series, only: fourier_series, cosine_table, evaluate_line, folded
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_line_zeros, only: zero_between
   implicit none (type, external)
   private

   public :: isobar_grid, start_isobar_grid

   type, extends(contact_edge) :: isobar_grid
      integer :: intervals = 0                           !! N
      real(dp), allocatable :: pressure(:, :)            !! p - level at the nodes, shape (0:N, 0:N)
      real(dp), allocatable :: along_phi(:, :)           !! series in phi on the line theta_l, shape (0:n, 0:N)
      real(dp), allocatable :: along_phi_slope(:, :)     !! its derivative across the line
      real(dp), allocatable :: along_theta(:, :)         !! series in theta on the line phi_k, shape (0:n, 0:N)
      real(dp), allocatable :: along_theta_slope(:, :)   !! its derivative across the line
   contains
      procedure :: in_contact
      procedure :: angles
      procedure :: side
      procedure :: area_fraction
      procedure, private :: node
   end type isobar_grid

contains

   !> Evaluates a pressure series on the grid.
   subroutine start_isobar_grid(grid, pressure, level, intervals)
      type(isobar_grid), intent(out) :: grid
      type(fourier_series), intent(in) :: pressure   !! p/p* in 2-D
      real(dp), intent(in) :: level                 !! over p*
      integer, intent(in) :: intervals              !! N >= 1

      real(dp), dimension(0:intervals, 0:ubound(pressure%c, 1)) :: cosines, sines
      real(dp) :: sine(0:2*intervals - 1)
      integer :: i, k, n

      n = ubound(pressure%c, 1)
      grid%intervals = intervals
      grid%period = 2*intervals
      call pressure%evaluate_on_grid(intervals, grid%pressure)
      grid%pressure = grid%pressure - level
      cosines = cosine_table(intervals, n)
      sine = [(sin(pi*k/intervals), k=0, 2*intervals - 1)]
      do i = 0, n
         sines(:, i) = [(-i*sine(modulo(i*k, 2*intervals)), k=0, intervals)]
      end do
      allocate (grid%along_phi(0:n, 0:intervals), grid%along_phi_slope(0:n, 0:intervals), &
                grid%along_theta(0:n, 0:intervals), grid%along_theta_slope(0:n, 0:intervals))
      call line_series('N', cosines, grid%along_phi)
      call line_series('N', sines, grid%along_phi_slope)
      call line_series('T', cosines, grid%along_theta)
      call line_series('T', sines, grid%along_theta_slope)
      grid%along_phi(0, :) = grid%along_phi(0, :) - level
      grid%along_theta(0, :) = grid%along_theta(0, :) - level

   contains

      subroutine line_series(trans, table, series)
         character, intent(in) :: trans
         real(dp), intent(in) :: table(0:intervals, 0:n)
         real(dp), intent(out) :: series(0:n, 0:intervals)

         call dgemm(trans, 'T', n + 1, intervals + 1, n + 1, 1.0_dp, pressure%c, n + 1, table, intervals + 1, &
                    0.0_dp, series, n + 1)
      end subroutine line_series

   end subroutine start_isobar_grid

   pure logical function in_contact(self, k, l)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%node(k, l) >= 0.0_dp
   end function in_contact

   pure subroutine angles(self, k, l, phi, theta)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l
      real(dp), intent(out) :: phi, theta   !! [rad]

      phi = k*(pi/self%intervals)
      theta = l*(pi/self%intervals)
   end subroutine angles

   !> p - level at any node of the plane.
   pure real(dp) function node(self, k, l)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l   !! any: phi = pi k/N, theta = pi l/N

      node = self%pressure(folded(k, self%intervals), folded(l, self%intervals))
   end function node

   !> The point of the isobar on a side of a cell.
   pure type(edge_point) function side(self, k, l, number) result(point)
      class(isobar_grid), intent(in) :: self
      integer, intent(in) :: k, l      !! any
      integer, intent(in) :: number    !! 1 .. 4

      real(dp) :: step, low, high
      integer :: line, first

      step = pi/self%intervals
      select case (number)
      case (1, 3)
         first = k
         line = merge(l, l + 1, number == 1)
         low = self%node(k, line)
         high = self%node(k + 1, line)
      case default
         first = l
         line = merge(k + 1, k, number == 2)
         low = self%node(line, l)
         high = self%node(line, l + 1)
      end select
      point%exists = (low >= 0.0_dp) .neqv. (high >= 0.0_dp)
      if (.not. point%exists) return

      associate (i => folded(line, self%intervals), away => mirrored(line, self%intervals))
         if (number == 1 .or. number == 3) then
            call zero_between(self%along_phi(:, i), first*step, step, low, high, point%phi, point%p_phi)
            point%theta = line*step
            point%p_theta = away*across(self%along_phi_slope(:, i), point%phi)
         else
            call zero_between(self%along_theta(:, i), first*step, step, low, high, point%theta, point%p_theta)
            point%phi = line*step
            point%p_phi = away*across(self%along_theta_slope(:, i), point%theta)
         end if
      end associate
   end function side

   pure real(dp) function across(c, x)
      real(dp), intent(in) :: c(0:), x

      real(dp) :: slope

      call evaluate_line(c, x, across, slope)
   end function across

   !> The part of the surface with p >= level.
   pure real(dp) function area_fraction(self)
      class(isobar_grid), intent(in) :: self

      real(dp) :: area, widths(0:self%intervals - 1)
      integer :: inside, k, l

      widths = [((k + 1)*(pi/self%intervals) - k*(pi/self%intervals), k=0, self%intervals - 1)]
      area = 0.0_dp
      do l = 0, self%intervals - 1
         do k = 0, self%intervals - 1
            ! Most cells are whole or empty: the general formula is for those of the edge.
            inside = count(self%pressure(k:k + 1, l:l + 1) >= 0.0_dp)
            if (inside == 4) area = area + widths(k)*widths(l)
            if (mod(inside, 4) > 0) area = area + self%cell_area(k, l)
         end do
      end do
      area_fraction = area/pi**2
   end function area_fraction

   !> The sign of a derivative after `folded`: -1 on the mirror image.
   elemental real(dp) function mirrored(k, intervals)
      integer, intent(in) :: k, intervals

      mirrored = merge(-1.0_dp, 1.0_dp, modulo(k, 2*intervals) > intervals)
   end function mirrored

end module wavycon_isobar_grid
