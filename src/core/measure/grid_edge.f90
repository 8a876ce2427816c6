!> The edge of contact of a solution on the points of a grid, placed between the points: eqs. (C11), (C12) of
!> src/core/contact/README.md.
!>
!> The points are those of wavycon_grid_points: M x N on a quarter of the cell, whose mirror images fill the
!> plane, or on the whole cell. The edge lies in the own columns and in those of the neighbours that
!> `fetch_neighbours` gets. The pressure of the last point in contact and the gap of the first
!> outside are both linear in the place of the edge between them, so that their ratio gives the place.
module wavycon_grid_edge
   use wavycon_constants, only: pi
   use wavycon_contact_edge, only: contact_edge, edge_point, quarter_turns
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_measure_tuning, only: aligned_slope, cell_edge_offset, cell_gap_weight, cell_turn_area, edge_offset, &
      gap_weight, turn_area
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: edge_rule, grid_edge, balance, join, make_grid_edge, pressure_per_gap, start_grid_edge

   !> Constants of (C11), (C12), which depend on the kernel of the half-space. The defaults are those of waves.
   type :: edge_rule
      !> For an edge that runs along a line of the grid (C11): the weight of the first gap, times E*/(2 l), against the
      !> last pressure; and how far inside the last point in contact the edge lies when that pressure vanishes [steps].
      real(dp) :: aligned_weight = pi/exp(1.0_dp), aligned_offset = 0.19000928592905364_dp
      !> The same for any direction, and what a turn adds to the area, in cells (C12).
      real(dp) :: gap_weight = gap_weight, offset = edge_offset, turn_area = turn_area
   end type edge_rule

   !> Those of uniform pressures on cells (C11a).
   type(edge_rule), parameter :: rule_of_cells = edge_rule(1.15987199_dp, 0.17465323_dp, cell_gap_weight, &
                                                           cell_edge_offset, cell_turn_area)

   type, extends(contact_edge) :: grid_edge
      !> The pressure, > 0, in contact, minus the gap, <= 0, elsewhere, in any unit, at the own columns of the grid,
      !> shape (M, slab%columns()): all N of them unless it is distributed; N = 1 in 1-D.
      real(dp), allocatable :: pressure_or_gap(:, :)
      !> The same at the columns before and after the own ones, shape (M, reach); only of a grid that is distributed.
      real(dp), allocatable, private :: low(:, :), high(:, :)
      logical, allocatable, private :: touched(:)   !! whether an own column has points in contact
      type(grid_slab) :: slab
      real(dp) :: stiffness(2) = 1.0_dp   !! E*/(2 l), l the steps along phi and theta, in these units
      logical :: even = .true.   !! whether the points are those of a quarter
      logical :: of_cells = .false.   !! whether pressures are uniform on cells, as with free edges; else sums of waves
      type(edge_rule) :: rule
   contains
      procedure :: in_contact
      procedure :: place_edge
      procedure :: beside_chord
      procedure :: place
      procedure :: at
      procedure :: column
      procedure :: may_touch
      procedure :: marks
      procedure :: fetch_neighbours
   end type grid_edge

   !> Columns of the neighbours that area and peak pressure of a distributed grid need.
   integer, parameter :: reach = 3

contains

   pure subroutine start_grid_edge(edge, pressure, gap, even, stiffness, slab, of_cells)
      type(grid_edge), intent(out) :: edge
      real(dp), intent(in) :: pressure(:, :)   !! positive in contact, zero elsewhere, in any unit, shape (M, columns)
      real(dp), intent(in) :: gap(:, :)        !! in any unit, of the same shape
      logical, intent(in) :: even
      !> From `pressure_per_gap`, in the units of pressure and gap. Only the place of the edge depends on it; absent: 1.
      real(dp), intent(in), optional :: stiffness(2)
      type(grid_slab), intent(in), optional :: slab   !! whose columns these are; absent: all columns of a grid
      logical, intent(in), optional :: of_cells       !! whether pressures are uniform on cells; absent: .false.

      real(dp), allocatable :: field(:, :)

      allocate (field, source=gap)
      call join(pressure, field)
      call make_grid_edge(edge, field, even, stiffness, slab, of_cells)
   end subroutine start_grid_edge

   !> As start_grid_edge, from pressure and gap in one field, whose memory it takes.
   pure subroutine make_grid_edge(edge, field, even, stiffness, slab, of_cells)
      type(grid_edge), intent(out) :: edge
      real(dp), allocatable, intent(inout) :: field(:, :)   !! as edge%pressure_or_gap; not allocated afterwards
      logical, intent(in) :: even
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

   !> Puts pressure and gap into one field.
   pure subroutine join(pressure, gap)
      real(dp), intent(in) :: pressure(:, :)
      real(dp), intent(inout) :: gap(:, :)   !! then as edge%pressure_or_gap

      ! Overlaps by rounding are no pressures: the pressures of the lightest loads are as small.
      gap = merge(pressure, -max(gap, 0.0_dp), pressure > 0.0_dp)
   end subroutine join

   !> Gets the columns of the neighbours, if the grid is distributed.
   subroutine fetch_neighbours(self)
      class(grid_edge), intent(inout) :: self

      if (.not. self%slab%is_distributed) return
      if (allocated(self%low)) deallocate (self%low, self%high)
      allocate (self%low(self%slab%points(1), reach), self%high(self%slab%points(1), reach))
      call self%slab%halo(self%pressure_or_gap, self%even, self%low, self%high)
   end subroutine fetch_neighbours

   !> E*/(2 l) of the steps l along phi and theta [p*/Delta].
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

   !> Pressure or minus the gap at any point of the plane; of a grid that is distributed, at the own columns and those
   !> of the neighbours.
   pure real(dp) function at(self, k, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k, l

      integer :: row

      row = k
      if (k < 1 .or. k > self%slab%points(1)) row = self%place(k, 1)
      if (l >= self%slab%first .and. l <= self%slab%last) then
         at = self%pressure_or_gap(row, l - self%slab%first + 1)
      else if (.not. self%slab%is_distributed) then
         at = self%pressure_or_gap(row, self%place(l, 2))
      else if (l < self%slab%first) then
         at = self%low(row, reach + 1 - (self%slab%first - l))
      else
         at = self%high(row, l - self%slab%last)
      end if
   end function at

   !> Pressure or minus the gap of a column, from the last point of the period before to the first one of the next.
   pure function column(self, l) result(values)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! as of `at`
      real(dp) :: values(0:self%slab%points(1) + 1)

      integer :: m

      ! One by one by `at` they would take a tenth of the time of a solution.
      m = self%slab%points(1)
      if (.not. self%slab%is_distributed) then
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

   !> Whether a column has points in contact; .true. if the grid is distributed, where neighbours have some columns.
   pure logical function may_touch(self, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l   !! as of `at`

      may_touch = self%slab%is_distributed
      if (.not. may_touch) may_touch = self%touched(self%place(l, 2))
   end function may_touch

   !> As `column`, 1 at points in contact and 0 at others.
   pure function marks(self, l)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: l
      integer :: marks(0:self%slab%points(1) + 1)

      marks = 0
      if (self%may_touch(l)) marks = merge(1, 0, self%column(l) > 0.0_dp)
   end function marks

   !> The index of the grid's point of which a point of the plane is the image.
   elemental integer function place(self, k, direction)
      class(grid_edge), intent(in) :: self
      integer, intent(in) :: k           !! any
      integer, intent(in) :: direction   !! 1 or 2

      place = image_of_point(k, self%slab%points(direction), self%even)
   end function place

   !> Where pressure and weighted gap balance: the edge is `edge_offset` steps further inside.
   pure subroutine place_edge(self, point)
      class(grid_edge), intent(in) :: self
      type(edge_point), intent(inout) :: point

      point%angle = self%angles(point%inner + balance(self, point, self%rule%gap_weight)*(point%outer - point%inner))
   end subroutine place_edge

   !> The distance of the place where pressure and weighted gap balance from the point in contact, in steps, 0 .. 1.
   pure real(dp) function balance(edge, point, weight)
      type(grid_edge), intent(in) :: edge
      type(edge_point), intent(in) :: point       !! its neighbours
      real(dp), intent(in) :: weight              !! of the gap

      integer :: across(2)
      real(dp) :: slope(2), stiffness

      stiffness = edge%stiffness(1)
      if (abs(edge%stiffness(2) - stiffness) > epsilon(stiffness)*stiffness) then
         ! That of the step along the normal, whose direction follows from the differences along and across the step.
         associate (inner => point%inner, outer => point%outer)
            across = abs([outer(2) - inner(2), outer(1) - inner(1)])
            slope(1) = 4*(height(inner) - height(outer))
            slope(2) = height(inner + across) - height(inner - across) + height(outer + across) - height(outer - across)
         end associate
         stiffness = norm2(slope*edge%stiffness(1 + across))/norm2(slope)
      end if
      associate (pressure => edge%at(point%inner(1), point%inner(2)), gap => -edge%at(point%outer(1), point%outer(2)))
         balance = pressure/(pressure + weight*stiffness*gap)
      end associate

   contains

      !> Pressure, or minus the weighted gap.
      pure real(dp) function height(place)
         integer, intent(in) :: place(2)

         height = edge%at(place(1), place(2))
         if (height <= 0.0_dp) height = height*weight*edge%stiffness(1)
      end function height

   end function balance

   !> The terms of (C12) besides the polygon [rad^2]: the strip between balance and edge, less what a turn of the edge
   !> adds and, where it runs along a line of the grid, (C11).
   pure real(dp) function beside_chord(self, from, to) result(area)
      class(grid_edge), intent(in) :: self
      type(edge_point), intent(in) :: from, to

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
