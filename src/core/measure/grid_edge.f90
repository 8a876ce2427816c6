!> The edge of contact of a solution on the points of a grid, interpolated between the points: eqs. (C11), (C12) of
!> src/core/contact/README.md.
!>
!> The points are those of wavycon_grid_points: M x N on a quarter of the cell, whose mirror images fill the plane, or
!> on the whole cell. On a line of the grid that the edge crosses, the pressure of the last point in contact and the gap
!> of the first point outside are both linear in the position of the edge between the two. So their ratio gives the
!> position.
!>
!> A grid may be distributed over processes, each of which has the pressures and gaps of its own columns. The edge is
!> then known in these columns and in those that `fetch_neighbours` copies from the neighbouring processes.
module wavycon_grid_edge
   use wavycon_contact_edge, only: contact_edge, edge_point, quarter_turns
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, pi
   use wavycon_measure_tuning, only: aligned_slope, cell_edge_offset, cell_gap_weight, cell_turn_area, edge_offset, &
      gap_weight, turn_area
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: edge_rule, grid_edge, balance, join, make_grid_edge, pressure_per_gap, start_grid_edge

   !> Constants of (C11), (C12). They depend on the discrete kernel of the half-space. The defaults hold for pressures
   !> that are sums of waves.
   type :: edge_rule
      !> For an edge along a line of the grid, (C11): the weight of the first gap outside, times E*/(2 l), against the
      !> last pressure inside [-]; the distance by which the edge lies inside the last point in contact when the
      !> pressure at this point vanishes [grid steps].
      real(dp) :: aligned_weight = pi/exp(1.0_dp), aligned_offset = 0.19000928592905364_dp
      !> For an edge of any direction, (C12): the weight of the gap [-]; the distance of the edge from the point where
      !> pressure and weighted gap balance, into the contact [grid steps]; the area that a full turn of the edge adds
      !> [grid cells].
      real(dp) :: gap_weight = gap_weight, offset = edge_offset, turn_area = turn_area
   end type edge_rule

   !> The constants for pressures that are uniform on grid cells, (C11a).
   type(edge_rule), parameter :: rule_of_cells = edge_rule(1.15987199_dp, 0.17465323_dp, cell_gap_weight, &
                                                           cell_edge_offset, cell_turn_area)

   type, extends(contact_edge) :: grid_edge
      !> At points in contact the pressure, > 0; elsewhere minus the gap, <= 0; in any units. The columns are the
      !> process's own, shape (M, slab%columns()): all N columns unless the grid is distributed; N = 1 in 1-D.
      real(dp), allocatable :: pressure_or_gap(:, :)
      !> The same at `reach` columns before and after the own ones, shape (M, reach). Allocated only if the grid is
      !> distributed.
      real(dp), allocatable, private :: low(:, :), high(:, :)
      logical, allocatable, private :: touched(:)   !! for each own column, whether it may have points in contact
      type(grid_slab) :: slab             !! which columns are the process's own
      real(dp) :: stiffness(2) = 1.0_dp   !! E*/(2 l), l the steps along phi and theta, in the units of pressure and gap
      logical :: even = .true.            !! whether the points are those of a quarter of the cell
      logical :: of_cells = .false.       !! true: pressures are uniform on grid cells, as with free edges; false: waves
      type(edge_rule) :: rule             !! the constants for this kind of pressures
   contains
      procedure :: in_contact, set_edge_point, beside_chord, index_in_grid
      procedure :: value_at, column, beside, may_touch, marks, fetch_neighbours
   end type grid_edge

   !> How many columns of the neighbouring processes the area and the peak pressure of a distributed grid need.
   integer, parameter :: reach = 3

contains

   !> Makes the edge from the pressures and gaps of a solution.
   pure subroutine start_grid_edge(edge, pressure, gap, even, stiffness, slab, of_cells)
      type(grid_edge), intent(out) :: edge
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, zero elsewhere, in any unit, shape (M, columns)
      real(dp), intent(in) :: gap(:, :)        !! in any unit, of the same shape
      logical, intent(in) :: even              !! whether the points are those of a quarter of the cell
      !> E*/(2 l) from `pressure_per_gap`, in the units of pressure and gap. It moves the edge between the points, and
      !> decides nothing else. Absent: 1.
      real(dp), intent(in), optional :: stiffness(2)
      type(grid_slab), intent(in), optional :: slab   !! which columns the arrays have; absent: all columns of the grid
      logical, intent(in), optional :: of_cells       !! whether pressures are uniform on cells; absent: .false.

      real(dp), allocatable :: field(:, :)

      allocate (field, source=gap)
      call join(pressure, field)
      call make_grid_edge(edge, field, even, stiffness, slab, of_cells)
   end subroutine start_grid_edge

   !> Makes the edge, as `start_grid_edge`, from pressures and gaps in one field, whose memory the edge takes over.
   pure subroutine make_grid_edge(edge, field, even, stiffness, slab, of_cells)
      type(grid_edge), intent(out) :: edge
      !> On entry the values of edge%pressure_or_gap; not allocated on exit.
      real(dp), allocatable, intent(inout) :: field(:, :)
      logical, intent(in) :: even   !! this and the following arguments are those of start_grid_edge
      real(dp), intent(in), optional :: stiffness(2)
      type(grid_slab), intent(in), optional :: slab
      logical, intent(in), optional :: of_cells

      integer :: j

      if (present(of_cells)) edge%of_cells = of_cells
      if (edge%of_cells) edge%rule = rule_of_cells
      edge%slab = grid_slab(points=shape(field), width=size(field, 2), last=size(field, 2))
      if (present(slab)) edge%slab = slab
      edge%touched = [(any(field(:, j) > 0.0_dp), j=1, size(field, 2))]
      call move_alloc(field, edge%pressure_or_gap)
      edge%even = even
      edge%period = merge(2, 1, even)*edge%slab%points
      edge%step = 2*pi/edge%period
      edge%origin = merge(0.5_dp, 1.0_dp, even)
      if (present(stiffness)) edge%stiffness = stiffness
   end subroutine make_grid_edge

   !> Joins pressure and gap to one field, as edge%pressure_or_gap.
   pure subroutine join(pressure, gap)
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, zero elsewhere
      real(dp), intent(inout) :: gap(:, :)     !! on entry the gap, on exit the joined field

      ! Gaps that rounding made negative are set to 0. Their negatives would count as pressures, and the pressures of
      ! the lightest loads are as small.
      gap = merge(pressure, -max(gap, 0.0_dp), pressure > 0.0_dp)
   end subroutine join

   !> Copies the columns next to the own ones from the neighbouring processes. Does nothing if the grid is whole.
   subroutine fetch_neighbours(self)
      class(grid_edge), intent(inout) :: self

      if (.not. self%slab%is_distributed) return
      if (allocated(self%low)) deallocate (self%low, self%high)
      allocate (self%low(self%slab%points(1), reach), self%high(self%slab%points(1), reach))
      call self%slab%halo(self%pressure_or_gap, self%even, self%low, self%high)
   end subroutine fetch_neighbours

   !> E*/(2 l) for the grid's steps l along phi and theta [p*/Delta].
   pure function pressure_per_gap(surface, points) result(stiffness)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! points of the grid: of a quarter of the cell if the surface is even
      real(dp) :: stiffness(2)

      ! sigma = pi E* by (C2) and eq. (22) of Johnson, Greenwood & Higginson (1985).
      stiffness = surface%stiffness/(2*pi)*merge(2, 1, surface%shape%is_even())*points/surface%length
   end function pressure_per_gap

   !> Whether a point of the plane is in contact.
   pure logical function in_contact(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      in_contact = self%value_at(k, l) > 0.0_dp
   end function in_contact

   !> Pressure, or minus the gap, at any point of the plane. If the grid is distributed, only at points of the own
   !> columns and of `reach` columns on either side.
   pure real(dp) function value_at(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      integer :: row

      row = k
      if (k < 1 .or. k > self%slab%points(1)) row = self%index_in_grid(k, 1)
      if (l >= self%slab%first .and. l <= self%slab%last) then
         value_at = self%pressure_or_gap(row, l - self%slab%first + 1)
      else if (.not. self%slab%is_distributed) then
         value_at = self%pressure_or_gap(row, self%index_in_grid(l, 2))
      else if (l < self%slab%first) then
         value_at = self%low(row, reach + 1 - (self%slab%first - l))
      else
         value_at = self%high(row, l - self%slab%last)
      end if
   end function value_at

   !> Pressure, or minus the gap, at the points 1 .. M of a column, and at the two points 0 and M + 1 beyond its ends,
   !> which are images of others.
   pure function column(self, l) result(values)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! any column that `value_at` may be called for
      real(dp) :: values(0:self%slab%points(1) + 1)

      integer :: m

      ! Whole columns are copied: calls of `value_at` for each point would take a tenth of the time of a solution.
      m = self%slab%points(1)
      if (.not. self%slab%is_distributed) then
         values(1:m) = self%pressure_or_gap(:, self%index_in_grid(l, 2))
      else if (l < self%slab%first) then
         values(1:m) = self%low(:, reach + 1 - (self%slab%first - l))
      else if (l > self%slab%last) then
         values(1:m) = self%high(:, l - self%slab%last)
      else
         values(1:m) = self%pressure_or_gap(:, l - self%slab%first + 1)
      end if
      values([0, m + 1]) = values(self%index_in_grid([0, m + 1], 1))
   end function column

   !> Pressure, or minus the gap, at the points 1 .. M of a column, and at their neighbours before and after them along
   !> one direction of the grid.
   pure function beside(self, l, direction) result(values)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l           !! an own column
      integer, intent(in) :: direction   !! 1: phi, 2: theta
      real(dp) :: values(self%slab%points(1), -1:1)

      real(dp) :: here(0:self%slab%points(1) + 1)
      integer :: i

      here = self%column(l)
      do i = -1, 1
         if (direction == 2) here = self%column(l + i)
         values(:, i) = here(1 + i*(2 - direction):self%slab%points(1) + i*(2 - direction))
      end do
   end function beside

   !> Whether a column has points in contact. If the grid is distributed the result is .true., as this is not known for
   !> columns of other processes.
   pure logical function may_touch(self, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! any column that `value_at` may be called for

      may_touch = self%slab%is_distributed
      if (.not. may_touch) may_touch = self%touched(self%index_in_grid(l, 2))
   end function may_touch

   !> At the points of `column`: 1 in contact, 0 elsewhere.
   pure function marks(self, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! as of `column`
      integer :: marks(0:self%slab%points(1) + 1)

      marks = 0
      if (.not. self%may_touch(l)) return
      where (self%column(l) > 0.0_dp) marks = 1
   end function marks

   !> The number, along one direction, of the grid's point of which a point of the plane is an image.
   elemental integer function index_in_grid(self, k, direction)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k           !! number of the point of the plane along this direction, any integer
      integer, intent(in) :: direction   !! 1: phi, 2: theta

      index_in_grid = image_of_point(k, self%slab%points(direction), self%even)
   end function index_in_grid

   !> Sets the angles of the point where pressure and weighted gap balance. The edge itself lies rule%offset steps
   !> farther inside the contact, which `beside_chord` takes into account.
   pure subroutine set_edge_point(self, point)
      class(grid_edge), intent(in) :: self
      type(edge_point), intent(inout) :: point   !! on entry `inner` and `outer` are set

      point%angle = self%angles(point%inner + balance(self, point, self%rule%gap_weight)*(point%outer - point%inner))
   end subroutine set_edge_point

   !> The distance of the point where pressure and weighted gap balance from the grid's point in contact, in grid steps,
   !> 0 to 1: p/(p + w s g), with the pressure p at the point in contact, the gap g at the point outside, the weight w
   !> and s = E*/(2 l).
   pure real(dp) function balance(edge, point, weight)
      type(grid_edge), intent(in) :: edge
      type(edge_point), intent(in) :: point       !! `inner` and `outer` are set
      real(dp), intent(in) :: weight              !! weight w of the gap [-]

      integer :: across(2)
      real(dp) :: slope(2), stiffness

      stiffness = edge%stiffness(1)
      if (abs(edge%stiffness(2) - stiffness) > epsilon(stiffness)*stiffness) then
         ! The steps along phi and theta differ. Take E*/(2 l) of the step l along the normal of the edge. The direction
         ! of the normal follows from the differences of the values along and across the line of the grid. Their gaps
         ! are weighted by the mean of both steps, so that exchanged directions have the same area.
         stiffness = sqrt(product(edge%stiffness))
         associate (inner => point%inner, outer => point%outer)
            across = abs([outer(2) - inner(2), outer(1) - inner(1)])
            slope(1) = 4*(height(inner) - height(outer))
            slope(2) = height(inner + across) - height(inner - across) + height(outer + across) - height(outer - across)
         end associate
         stiffness = norm2(slope*edge%stiffness(1 + across))/norm2(slope)
      end if
      associate (pressure => edge%value_at(point%inner(1), point%inner(2)), &
                 gap => -edge%value_at(point%outer(1), point%outer(2)))
         balance = pressure/(pressure + weight*stiffness*gap)
      end associate

   contains

      !> The pressure at a point of the grid, or minus the weighted gap.
      pure real(dp) function height(node)
         integer, intent(in) :: node(2)   !! (k, l)

         height = edge%value_at(node(1), node(2))
         if (height <= 0.0_dp) height = height*weight*stiffness
      end function height

   end function balance

   !> The terms of (C12) besides the area of the polygon, for one grid cell [rad^2]: the strip between the points of
   !> balance and the edge, less the area that a turn of the edge adds. Where the edge runs nearly along a line of the
   !> grid, the position by (C11) is taken, the more the smaller the angle between the two.
   pure real(dp) function beside_chord(self, from, to) result(area)
      class(grid_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to   !! where the edge enters and leaves the grid cell

      real(dp) :: aligned(2), any_direction(2), slope

      associate (rule => self%rule, turns => quarter_turns(from, to))
         area = rule%offset*norm2((to%angle - from%angle)/self%step) - 0.25_dp*turns*rule%turn_area
         if (turns == 0) then
            any_direction = [balance(self, from, rule%gap_weight), balance(self, to, rule%gap_weight)]
            slope = abs(any_direction(2) - any_direction(1))
            aligned = [balance(self, from, rule%aligned_weight), balance(self, to, rule%aligned_weight)]
            area = area - max(1.0_dp - slope/aligned_slope, 0.0_dp) &
                   *(0.5_dp*sum(aligned - any_direction) - rule%aligned_offset + rule%offset)
         end if
      end associate
      area = product(self%step)*area
   end function beside_chord

end module wavycon_grid_edge
