!> The fields of a solution on a grid. At the points of the grid they are the numbers of the solution. Between the
!> points (C19), (C20) of README.md in this directory interpolate them so that contact and gap exclude each other.
!>
!> Pressure and gap are joined to one smooth function psi, which is p^2 in contact and -Lambda gap^(2/3) elsewhere. Both
!> are proportional to the distance from the edge near it. The factor Lambda makes the mean slopes on both sides equal.
module wavycon_grid_fields
   use wavycon_contact_fields, only: contact_fields
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp, pi
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_fields, start_grid_fields

   type, extends(contact_fields) :: grid_fields
      private
      type(grid_edge) :: edge                !! pressure or -gap at the points
      type(surface_type), public :: surface
      real(dp) :: approach = 0.0_dp          !! [Delta]
      logical :: rotated = .false.           !! whether the angles of the grid are X + Y and X - Y
      real(dp) :: gap_factor = 1.0_dp        !! Lambda of (C19) [p*^2/Delta^(2/3)]
      !> psi [p*^2] at the points of the grid and at two more beyond each side, shape (-1:M+2, -1:N+2). The first
      !> interpolation allocates it.
      real(dp), allocatable :: psi(:, :)
   contains
      procedure :: at, on_grid, at_own_column, at_points
   end type grid_fields

   !> Positions are rounded. One whose distance from a point of the grid is below this, in steps, is taken as that
   !> point.
   real(dp), parameter :: rounding = 1e-9_dp

contains

   !> Sets the data of the fields. psi is computed later, when it is first needed.
   subroutine start_grid_fields(fields, surface, edge, approach, rotated)
      type(grid_fields), intent(out) :: fields
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge       !! pressure [p*] and gap [Delta] at the points
      real(dp), intent(in) :: approach          !! [Delta]
      logical, intent(in) :: rotated            !! whether the angles of the grid are X + Y and X - Y

      fields%surface = surface
      fields%edge = edge
      fields%approach = approach
      fields%rotated = rotated
      fields%own_slab = edge%slab
      ! The points of a rotated grid are only every other point of a grid of the cell: it has no own points.
      if (rotated) return
      fields%own_points = edge%slab%points
      if (.not. edge%even) return
      ! The points of a quarter, midway between the lines of the grid; in 1-D only along x.
      where (edge%slab%points > 1)
         fields%own_points = 2*edge%slab%points/surface%maps_in_cell()
         fields%own_offset = 0.5_dp
      end where
   end subroutine start_grid_fields

   !> The fields at the points of one own column: the solution's numbers, without interpolation.
   subroutine at_own_column(self, column, shape_values, pressure, displacement, gap)
      class(grid_fields), intent(in) :: self
      integer, intent(in) :: column
      real(dp), intent(in) :: shape_values(:)
      real(dp), intent(out) :: pressure(:), displacement(:), gap(:)

      associate (values => self%edge%pressure_or_gap(:, column - self%edge%slab%first + 1))
         pressure = max(values, 0.0_dp)
         gap = max(-values, 0.0_dp)
      end associate
      displacement = gap - (1.0_dp - self%approach) + shape_values
   end subroutine at_own_column

   !> The fields at one point, interpolated by (C20).
   subroutine at(self, x, y, pressure, displacement, gap)
      class(grid_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      call interpolate(self, [x, y]/(2*pi), pressure, gap)
      displacement = gap - (1.0_dp - self%approach) + self%surface%shape_at(x, y)
   end subroutine at

   !> The fields at many points, interpolated by (C20), with the surface's shape that the caller knows.
   subroutine at_points(self, angle, shape_values, pressure, displacement, gap)
      class(grid_fields), intent(inout) :: self
      real(dp), intent(in) :: angle(:, :), shape_values(:)
      real(dp), intent(out) :: pressure(:), displacement(:), gap(:)

      integer :: k

      do k = 1, size(gap)
         call interpolate(self, angle(:, k)/(2*pi), pressure(k), gap(k))
      end do
      displacement = gap - (1.0_dp - self%approach) + shape_values
   end subroutine at_points

   !> The fields on a grid of the cell: the solution's numbers if this is its own grid, otherwise interpolated.
   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(grid_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      integer :: k, l
      real(dp) :: value
      logical :: at_own

      allocate (pressure(points(1), points(2)), gap(points(1), points(2)))
      at_own = all(points == self%own_points) .and. all(abs(offset - self%own_offset) <= rounding)
      do l = 1, points(2)
         do k = 1, points(1)
            if (at_own) then
               value = self%edge%pressure_or_gap(self%edge%index_in_grid(k, 1), self%edge%index_in_grid(l, 2))
               pressure(k, l) = max(value, 0.0_dp)
               gap(k, l) = max(-value, 0.0_dp)
            else
               call interpolate(self, ([k, l] - 1 + offset)/(self%surface%maps_in_cell()*points), pressure(k, l), &
                                gap(k, l))
            end if
         end do
      end do
      call self%surface%sample_shape(points, offset, displacement)
      displacement = gap - (1.0_dp - self%approach) + displacement
   end subroutine on_grid

   !> Computes psi at the points, and the factor of gaps in it: (C19).
   subroutine find_psi(fields)
      type(grid_fields), intent(inout) :: fields

      real(dp) :: inside, outside
      integer :: k, l, m, n

      m = size(fields%edge%pressure_or_gap, 1)
      n = size(fields%edge%pressure_or_gap, 2)
      allocate (fields%psi(-1:m + 2, -1:n + 2))
      do l = -1, n + 2
         do k = -1, m + 2
            associate (value => fields%edge%value_at(k, l))
               fields%psi(k, l) = value**2
               if (value <= 0.0_dp) fields%psi(k, l) = -abs(value)**(2.0_dp/3)
            end associate
         end do
      end do
      inside = 0.0_dp
      outside = 0.0_dp
      do l = 1, n
         do k = 1, m
            call add_slopes(fields%psi(k - 1:k + 2, l))
            call add_slopes(fields%psi(k, l - 1:l + 2))
         end do
      end do
      if (inside > 0.0_dp .and. outside > 0.0_dp) fields%gap_factor = inside/outside
      where (fields%psi < 0.0_dp) fields%psi = fields%gap_factor*fields%psi

   contains

      !> Adds the slopes of p^2 and of gap^(2/3) on both sides of the edge to their sums, if the edge lies in the middle
      !> of four adjacent points.
      subroutine add_slopes(psi)
         real(dp), intent(in) :: psi(:)   !! p^2 or -gap^(2/3) at four points of a line, shape (4)

         real(dp) :: outwards(4)

         outwards = psi
         if (psi(4) > 0.0_dp) outwards = psi(4:1:-1)
         if (any((outwards > 0.0_dp) .neqv. [.true., .true., .false., .false.])) return
         inside = inside + (outwards(1) - outwards(2))
         outside = outside + (outwards(3) - outwards(4))
      end subroutine add_slopes

   end subroutine find_psi

   !> Interpolates pressure and gap at a point.
   subroutine interpolate(fields, place, pressure, gap)
      type(grid_fields), intent(inout) :: fields
      real(dp), intent(in) :: place(2)            !! X, Y in sides of the surface's cell
      real(dp), intent(out) :: pressure, gap

      real(dp) :: psi, s(2), t(2)
      integer :: node(2)

      if (.not. allocated(fields%psi)) call find_psi(fields)
      s = place
      if (fields%rotated) s = [sum(place), place(1) - place(2)]
      call locate(s(1), size(fields%edge%pressure_or_gap, 1), fields%edge%even, node(1), t(1))
      call locate(s(2), size(fields%edge%pressure_or_gap, 2), fields%edge%even, node(2), t(2))
      psi = cubic(fields%psi(node(1) - 1:node(1) + 2, node(2) - 1:node(2) + 2), t(1), t(2))
      pressure = 0.0_dp
      gap = 0.0_dp
      if (psi > 0.0_dp) then
         pressure = min(sqrt(psi), fields%surface%hardness)
      else
         gap = sqrt(-psi/fields%gap_factor)**3
      end if
   end subroutine interpolate

   !> Finds the point of the grid before a position along one axis, and the distance from this point in steps.
   pure subroutine locate(place, points, even, node, rest)
      real(dp), intent(in) :: place      !! position over the side of the cell; any number, cells repeat
      integer, intent(in) :: points      !! number of points along this axis, M or N
      logical, intent(in) :: even        !! whether the points lie on half of the side, mirrored at both ends
      integer, intent(out) :: node       !! number of the point, 0 .. points
      real(dp), intent(out) :: rest      !! distance from the point, 0 .. 1 [step]

      real(dp) :: steps

      node = 1
      rest = 0.0_dp
      if (points == 1) return
      if (even) then
         steps = modulo(2*points*place, 2.0_dp*points)
         steps = min(steps, 2*points - steps) + 0.5_dp
      else
         steps = modulo(points*place + rounding, real(points, dp)) + 1.0_dp - rounding
      end if
      node = floor(steps + rounding)
      rest = steps - node
      if (rest <= rounding) rest = 0.0_dp
   end subroutine locate

   !> The cubic (C20) in the cell of four points. Slopes at the points are computed from the 16 points about the cell.
   pure real(dp) function cubic(psi, s, t)
      real(dp), intent(in) :: psi(-1:, -1:)      !! psi at the 16 points, shape (-1:2, -1:2); the cell has 0 and 1
      real(dp), intent(in) :: s, t               !! xi_1, xi_2: position in the cell, 0 .. 1 [step]

      real(dp) :: linear, value_s(0:1), value_t(0:1), slope_s(0:1), slope_t(0:1)
      integer :: i, j

      value_s = [(1.0_dp - s)**2*(1.0_dp + 2*s), s**2*(3.0_dp - 2*s)]
      value_t = [(1.0_dp - t)**2*(1.0_dp + 2*t), t**2*(3.0_dp - 2*t)]
      slope_s = [s*(1.0_dp - s)**2, -s**2*(1.0_dp - s)]
      slope_t = [t*(1.0_dp - t)**2, -t**2*(1.0_dp - t)]
      cubic = 0.0_dp
      do j = 0, 1
         do i = 0, 1
            cubic = cubic + value_s(i)*value_t(j)*psi(i, j) &
               + slope_s(i)*value_t(j)*slope(psi(i - 1:i + 1, j)) + value_s(i)*slope_t(j)*slope(psi(i, j - 1:j + 1))
         end do
      end do
      ! The cubic may overshoot. But between four points in contact there is no gap, and between four open points no
      ! contact: there psi keeps the sign and at least half the size of the bilinear interpolation.
      linear = (1.0_dp - t)*((1.0_dp - s)*psi(0, 0) + s*psi(1, 0)) + t*((1.0_dp - s)*psi(0, 1) + s*psi(1, 1))
      if (all(psi(0:1, 0:1) > 0.0_dp)) then
         cubic = max(cubic, 0.5_dp*linear)
      else if (all(psi(0:1, 0:1) <= 0.0_dp)) then
         cubic = min(cubic, 0.5_dp*linear)
      end if
   end function cubic

   !> The slope of psi at a point, per step: the mean of the differences to those of the two neighbours that are on the
   !> same side of the edge; zero if neither is.
   pure real(dp) function slope(psi)
      real(dp), intent(in) :: psi(-1:)   !! psi at the point, 0, and at its neighbours on a line, shape (-1:1)

      logical :: left, right   ! whether the neighbour is on the same side

      left = (psi(-1) > 0.0_dp) .eqv. (psi(0) > 0.0_dp)
      right = (psi(1) > 0.0_dp) .eqv. (psi(0) > 0.0_dp)
      slope = 0.0_dp
      if (left) slope = psi(0) - psi(-1)
      if (right) slope = slope + psi(1) - psi(0)
      if (left .and. right) slope = 0.5_dp*slope
   end function slope

end module wavycon_grid_fields
