!> The edge of contact of a solution on the points of a grid, placed between the points: eqs. (C11), (C12) of
!> src/contact/README.md.
!>
!> The points are those of wavycon_grid_transform: M x N on a quarter of the cell, whose mirror images fill the
!> plane, or on the whole cell. Of a grid that is spread over ranks, each has the edge in its own columns; its area is
!> that of the grid, and needs the columns of the neighbours that `fetch_neighbours` gets. The pressure of the last point in contact and the gap of the first outside are both
!> linear in the place of the edge between them, so that their ratio gives the place.
module wavycon_grid_edge
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, corner_k, corner_l, edge_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: image_of_point, point_angle
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: length_inside
   use wavycon_measure_tuning, only: aligned_slope, edge_offset, gap_weight, turn_area
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_edge, grid_contact_area, grid_strip_edges, joined, make_grid_edge, pressure_per_gap, start_grid_edge

   type, extends(contact_edge) :: grid_edge
      !> The pressure, > 0, in contact, minus the gap, <= 0, elsewhere, in any unit, at the own columns of the grid, shape
      !> (M, slab%columns()): all N of them unless it is spread; N = 1 in 1-D.
      real(dp), allocatable :: pressure_or_gap(:, :)
      !> The same at the columns before and after the own ones, shape (M, reach); only of a grid that is spread.
      real(dp), allocatable, private :: low(:, :), high(:, :)
      type(grid_slab) :: slab
      real(dp) :: stiffness(2) = 1.0_dp   !! E*/(2 h), h the steps along phi and theta, in these units
      logical :: even = .true.   !! whether the points are those of a quarter
   contains
      procedure :: in_contact
      procedure :: angles
      procedure :: side
      procedure :: beside_chord
      procedure :: area_correction
      procedure :: place
      procedure :: at
      procedure :: column
      procedure :: contact_of_column
      procedure :: points_in_contact
      procedure :: number_of_points
      procedure :: fetch_neighbours
   end type grid_edge

   !> Columns of the neighbours that area and peak pressure of a spread grid need.
   integer, parameter :: reach = 3

   !> Of an edge that runs along a line of the grid (C11): the weight of the first gap, times E*/(2 h), against the last
   !> pressure; and how far inside the last point in contact the edge lies when that pressure vanishes, in steps.
   real(dp), parameter :: aligned_weight = pi/exp(1.0_dp), aligned_offset = 0.19000928592905364_dp

contains

   pure subroutine start_grid_edge(edge, pressure, gap, even, stiffness, slab)
      type(grid_edge), intent(out) :: edge
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, zero elsewhere, in any unit, shape (M, columns)
      real(dp), intent(in) :: gap(:, :)        !! in any unit, of the same shape
      logical, intent(in) :: even
      !> From `pressure_per_gap`, in the units of pressure and gap. Only the place of the edge depends on it; absent: 1.
      real(dp), intent(in), optional :: stiffness(2)
      type(grid_slab), intent(in), optional :: slab   !! whose columns these are; absent: all columns of a grid

      real(dp), allocatable :: field(:, :)
      integer :: j

      allocate (field, mold=gap)
      do j = 1, size(gap, 2)
         field(:, j) = joined(pressure(:, j), gap(:, j))
      end do
      call make_grid_edge(edge, field, even, stiffness, slab)
   end subroutine start_grid_edge

   !> As start_grid_edge, from pressure and gap in one field, whose memory it takes.
   pure subroutine make_grid_edge(edge, field, even, stiffness, slab)
      type(grid_edge), intent(out) :: edge
      real(dp), allocatable, intent(inout) :: field(:, :)   !! as edge%pressure_or_gap; not allocated afterwards
      logical, intent(in) :: even
      real(dp), intent(in), optional :: stiffness(2)
      type(grid_slab), intent(in), optional :: slab

      if (present(slab)) then
         edge%slab = slab
      else
         edge%slab = grid_slab(points=shape(field), width=size(field, 2), last=size(field, 2))
      end if
      call move_alloc(field, edge%pressure_or_gap)
      edge%even = even
      edge%period = merge(2, 1, even)*edge%slab%points
      if (present(stiffness)) edge%stiffness = stiffness
   end subroutine make_grid_edge

   !> Pressure and gap of a point in one number.
   elemental real(dp) function joined(pressure, gap)
      real(dp), intent(in) :: pressure, gap

      ! Overlaps by rounding are no pressures: the pressures of the lightest loads are as small.
      joined = merge(pressure, -max(gap, 0.0_dp), pressure > 0.0_dp)
   end function joined

   !> Gets the columns of the neighbours if the grid is spread; all ranks must call it.
   subroutine fetch_neighbours(self)
      class(grid_edge), intent(inout) :: self

      if (.not. self%slab%is_spread) return
      if (allocated(self%low)) deallocate (self%low, self%high)
      allocate (self%low(self%slab%points(1), reach), self%high(self%slab%points(1), reach))
      call self%slab%halo(self%pressure_or_gap, self%even, self%low, self%high)
   end subroutine fetch_neighbours

   !> E*/(2 h) of the steps h along phi and theta [p*/Delta].
   pure function pressure_per_gap(surface, points) result(stiffness)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! of the part of the cell that is solved
      real(dp) :: stiffness(2)

      ! sigma = pi E* by (C2) and eq. (22) of Johnson, Greenwood & Higginson (1985).
      stiffness = surface%stiffness/(2*pi)*merge(2, 1, surface%shape%is_even())*points/surface%length
   end function pressure_per_gap

   pure logical function in_contact(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%at(k, l) > 0.0_dp
   end function in_contact

   !> Pressure or minus the gap at any point of the plane; of a grid that is spread, at the own columns and those of the
   !> neighbours.
   pure real(dp) function at(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      integer :: row

      row = self%place(k, 1)
      if (.not. self%slab%is_spread) then
         at = self%pressure_or_gap(row, self%place(l, 2))
      else if (l < self%slab%first) then
         at = self%low(row, reach + 1 - (self%slab%first - l))
      else if (l > self%slab%last) then
         at = self%high(row, l - self%slab%last)
      else
         at = self%pressure_or_gap(row, l - self%slab%first + 1)
      end if
   end function at

   !> Pressure or minus the gap of a column, from the last point of the period before to the first one of the next.
   pure function column(self, l) result(values)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! as of `at`
      real(dp) :: values(0:self%slab%points(1) + 1)

      integer :: m

      m = self%slab%points(1)
      if (.not. self%slab%is_spread) then
         values(1:m) = self%pressure_or_gap(:, self%place(l, 2))
      else if (l < self%slab%first) then
         values(1:m) = self%low(:, reach + 1 - (self%slab%first - l))
      else if (l > self%slab%last) then
         values(1:m) = self%high(:, l - self%slab%last)
      else
         values(1:m) = self%pressure_or_gap(:, l - self%slab%first + 1)
      end if
      values(0) = values(self%place(0, 1))
      values(m + 1) = values(self%place(m + 1, 1))
   end function column

   !> Which points of a column are in contact, likewise.
   pure function contact_of_column(self, l) result(inside)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! as of `at`
      logical :: inside(0:self%slab%points(1) + 1)

      real(dp) :: values(0:self%slab%points(1) + 1)

      values = self%column(l)
      inside = values > 0.0_dp
   end function contact_of_column

   !> The number of points of the grid in contact.
   integer(int64) function points_in_contact(self) result(number)
      class(grid_edge), intent(in) :: self

      integer(int64) :: total(1)

      total = count(self%pressure_or_gap > 0.0_dp, kind=int64)
      call self%slab%add(total)
      number = total(1)
   end function points_in_contact

   !> The number of points of the grid.
   pure integer(int64) function number_of_points(self) result(number)
      class(grid_edge), intent(in) :: self

      number = product(int(self%slab%points, int64))
   end function number_of_points

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

      angle = point_angle(k, edge%slab%points(direction), edge%even)
   end function angle

   !> The step of the grid along phi and theta [rad].
   pure function angle_steps(edge) result(steps)
      class(grid_edge), intent(in) :: edge
      real(dp) :: steps(2)

      steps = 2*pi/edge%period
   end function angle_steps

   !> The index of the grid's point of which a point of the plane is the image.
   elemental integer function place(self, k, direction)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k           !! any
      integer, intent(in) :: direction   !! 1 or 2

      place = image_of_point(k, self%slab%points(direction), self%even)
   end function place

   !> Where pressure and weighted gap balance between two points: the edge is `edge_offset` steps further inside.
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
      t = balance(self, k_in, l_in, k_out, l_out, gap_weight)
      call self%angles(k_in, l_in, phi_in, theta_in)
      call self%angles(k_out, l_out, phi_out, theta_out)
      point%phi = phi_in + t*(phi_out - phi_in)
      point%theta = theta_in + t*(theta_out - theta_in)
   end function side

   !> The distance of the place where pressure and weighted gap balance from a point in contact, in steps, 0 .. 1.
   pure real(dp) function balance(edge, k_in, l_in, k_out, l_out, weight)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: k_in, l_in     !! the point in contact
      integer, intent(in) :: k_out, l_out   !! its neighbour outside
      real(dp), intent(in) :: weight        !! of the gap

      real(dp) :: slope(2), stiffness
      integer :: k, l

      stiffness = edge%stiffness(1)
      if (abs(edge%stiffness(2) - stiffness) > epsilon(stiffness)*stiffness) then
         ! That of the step along the normal, whose direction follows from the differences along and across the step.
         k = abs(l_out - l_in)
         l = abs(k_out - k_in)
         slope(1) = 4*(height(k_in, l_in) - height(k_out, l_out))
         slope(2) = height(k_in + k, l_in + l) - height(k_in - k, l_in - l) &
                    + height(k_out + k, l_out + l) - height(k_out - k, l_out - l)
         stiffness = norm2(slope*edge%stiffness([1 + k, 1 + l]))/norm2(slope)
      end if
      associate (pressure => edge%at(k_in, l_in), gap => -edge%at(k_out, l_out))
         balance = pressure/(pressure + weight*stiffness*gap)
      end associate

   contains

      !> Pressure, or minus the weighted gap.
      pure real(dp) function height(k, l)
         integer, intent(in) :: k, l

         height = edge%at(k, l)
         if (height <= 0.0_dp) height = height*weight*edge%stiffness(1)
      end function height

   end function balance

   !> The area of the strip between balance and edge [rad^2] (C12).
   pure real(dp) function beside_chord(self, from, to)
      class(grid_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to

      associate (steps => angle_steps(self))
         beside_chord = edge_offset*product(steps)*norm2([to%phi - from%phi, to%theta - from%theta]/steps)
      end associate
   end function beside_chord

   !> The terms of (C12) besides the polygon and the strip along it, for one passage of the edge [rad^2].
   pure real(dp) function area_correction(self, k, l, turns) result(area)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l
      real(dp), intent(in) :: turns

      logical :: low(2), high(2)
      integer :: i

      low = [(self%in_contact(k + i, l), i=0, 1)]
      high = [(self%in_contact(k + i, l + 1), i=0, 1)]
      area = product(angle_steps(self))*(turn_area*turns + aligned_part(self, k, l, low, high))
   end function area_correction

   !> The fraction of the surface in contact: (C11) in 1-D, (C12) in 2-D. Of a grid that is spread, after
   !> `fetch_neighbours`; all ranks must call it.
   real(dp) function grid_contact_area(edge) result(fraction)
      type(grid_edge), intent(in) :: edge

      real(dp), allocatable :: areas(:, :), edges(:)
      integer :: j

      if (edge%slab%points(2) == 1) then
         call grid_strip_edges(edge, edges)
         if (edge%even) then
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, pi)/pi
         else
            fraction = length_inside(edges, edge%in_contact(1, 1), 0.0_dp, 2*pi)/(2*pi)
         end if
         return
      end if

      allocate (areas(1, edge%slab%columns()))
      do j = edge%slab%first, edge%slab%last
         areas(1, j - edge%slab%first + 1) = area_of_cells(edge, j)
      end do
      ! The mirror line divides the cells at the rim of the quarter.
      if (edge%even .and. edge%slab%first == 1 .and. edge%slab%columns() > 0) &
         areas(1, 1) = areas(1, 1) + area_of_cells(edge, 0)
      fraction = max(sum(edge%slab%column_totals(areas)), 0.0_dp)/edge%number_of_points()
   end function grid_contact_area

   !> The area in contact of a column of cells [cells], by (C12).
   pure real(dp) function area_of_cells(edge, l) result(area)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: l   !! the column of points before

      logical :: high(0:edge%slab%points(1) + 1), low(0:edge%slab%points(1) + 1)
      real(dp) :: share, steps(2)
      integer :: i, m

      m = edge%slab%points(1)
      steps = angle_steps(edge)
      low = edge%contact_of_column(l)
      high = edge%contact_of_column(l + 1)
      area = 0.0_dp
      if (.not. any(low) .and. .not. any(high)) return
      do i = merge(0, 1, edge%even), m
         share = 1.0_dp
         if (edge%even) then
            ! The mirror lines divide the cells at the rim of the quarter: half of each counts.
            share = merge(0.5_dp, 1.0_dp, i == 0 .or. i == m) &
                    *merge(0.5_dp, 1.0_dp, l == 0 .or. l == edge%slab%points(2))
         end if
         if (all([low(i:i + 1), high(i:i + 1)])) then
            area = area + share
         else if (any([low(i:i + 1), high(i:i + 1)])) then
            area = area + share*(edge%cell_area(i, l)/product(steps) &
                                 + turn_area*turns(low(i:i + 1), high(i:i + 1)) &
                                 + aligned_part(edge, i, l, low(i:i + 1), high(i:i + 1)))
         end if
      end do
   end function area_of_cells

   !> Turns of the edge in one cell, positive where the contact is convex; their sum over a closed edge is 1 or -1.
   !> Parts in contact that meet at a corner are taken as connected, as in cell_area.
   pure real(dp) function turns(low, high)
      logical, intent(in) :: low(2), high(2)   !! whether the corners are in contact

      select case (count([low, high]))
      case (1)
         turns = 0.25_dp
      case (2)
         turns = merge(-0.5_dp, 0.0_dp, (low(1) .eqv. high(2)) .and. (low(1) .neqv. low(2)))
      case default
         turns = -0.25_dp
      end select
   end function turns

   !> What (C11) adds to the area of a cell, in cells, where the edge runs along a line of the grid.
   pure real(dp) function aligned_part(edge, k, l, low, high) result(change)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: k, l              !! the cell
      logical, intent(in) :: low(2), high(2)   !! whether its corners are in contact

      real(dp) :: aligned(2), any_direction(2), slope
      integer :: i, k_in(2), k_out(2), l_in(2), l_out(2)

      change = 0.0_dp
      if ((low(1) .eqv. low(2)) .and. (high(1) .eqv. high(2))) then
         k_in = [k, k + 1]
         k_out = k_in
         l_in = merge(l, l + 1, low(1))
         l_out = merge(l + 1, l, low(1))
      else if ((low(1) .eqv. high(1)) .and. (low(2) .eqv. high(2))) then
         k_in = merge(k, k + 1, low(1))
         k_out = merge(k + 1, k, low(1))
         l_in = [l, l + 1]
         l_out = l_in
      else
         return
      end if
      any_direction = [(balance(edge, k_in(i), l_in(i), k_out(i), l_out(i), gap_weight), i=1, 2)]
      slope = abs(any_direction(2) - any_direction(1))
      if (slope >= aligned_slope) return
      aligned = [(balance(edge, k_in(i), l_in(i), k_out(i), l_out(i), aligned_weight), i=1, 2)]
      change = (1.0_dp - slope/aligned_slope)*(0.5_dp*sum(aligned - any_direction) - aligned_offset + edge_offset)
   end function aligned_part

   !> The edges of contact in 1-D, ascending [rad]: between 0 and pi of an even surface, otherwise within a period from
   !> the first point.
   pure subroutine grid_strip_edges(edge, edges)
      type(grid_edge), intent(in) :: edge
      real(dp), allocatable, intent(out) :: edges(:)

      real(dp) :: found(edge%slab%points(1)), step
      integer :: i, count

      count = 0
      step = angle(edge, 2, 1) - angle(edge, 1, 1)
      do i = 1, size(found) - merge(1, 0, edge%even)
         if (edge%in_contact(i, 1) .eqv. edge%in_contact(i + 1, 1)) cycle
         count = count + 1
         if (edge%in_contact(i, 1)) then
            found(count) = angle(edge, i, 1) + step*distance_to_edge(edge, i, 1)
         else
            found(count) = angle(edge, i + 1, 1) - step*distance_to_edge(edge, i + 1, -1)
         end if
      end do
      allocate (edges, source=found(:count))
   end subroutine grid_strip_edges

   !> The distance of the edge from a point in contact towards its neighbour outside in 1-D, in steps (C11).
   pure real(dp) function distance_to_edge(edge, k, dk) result(distance)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: k    !! the point in contact
      integer, intent(in) :: dk   !! the step to its neighbour, 1 or -1

      distance = balance(edge, k, 1, k + dk, 1, aligned_weight) - aligned_offset
      ! A contact of one point has no negative width.
      if (.not. edge%in_contact(k - dk, 1)) distance = max(distance, 0.0_dp)
   end function distance_to_edge

   elemental subroutine swap(a, b)
      integer, intent(inout) :: a, b

      integer :: c

      c = a
      a = b
      b = c
   end subroutine swap

end module wavycon_grid_edge
