!> The source of fields, contact contours and stresses of a load that was solved on a grid. The data are the pressures
!> and gaps at the points of the grid.
module wavycon_grid_source
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_contours, only: contact_contour, make_strips, rotate_contours, shift_contour, trace_edges
   use wavycon_field_source, only: field_source
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_area, only: grid_strip_edges
   use wavycon_grid_derivatives, only: differentiate_on_grid
   use wavycon_grid_edge, only: grid_edge, make_grid_edge
   use wavycon_grid_error, only: change_history
   use wavycon_grid_fields, only: grid_fields, start_grid_fields
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_stress_fields, only: grid_stress_fields
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, int64
   use wavycon_region_numbers, only: find_region_numbers, region_numbers
   use wavycon_rotated_series, only: in_other_angles, to_difference_angles
   use wavycon_series_stress_fields, only: start_series_stress_fields
   use wavycon_paper_wave, only: smaller_cell
   use wavycon_quantities, only: approach, is_known, or_nan, peak_pressure, quantities
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: grid_source

   type, extends(field_source) :: grid_source
      type(grid_edge), allocatable :: edge    !! pressures and gaps at the points; allocated after take_edge
      logical :: rotated = .false.            !! whether the grid covers the smaller cell, rotated by 45 degrees
      type(change_history) :: history         !! main values on the last three grids
   contains
      procedure :: take_edge, fields, contact_contours, stresses, derivatives, collect
      procedure :: pack => pack_source
      procedure :: unpack => unpack_source
   end type grid_source

   !> Number of values in the array of pack_source before those of the field.
   integer, parameter :: own_values = 17

contains

   !> Takes over the pressures and gaps without copying them.
   pure subroutine take_edge(self, edge)
      class(grid_source), intent(inout) :: self
      type(grid_edge), allocatable, intent(inout) :: edge   !! not allocated afterwards

      call move_alloc(edge, self%edge)
      self%distributed_points = 0
      if (self%edge%slab%is_distributed) self%distributed_points = product(int(self%edge%slab%points, int64))
   end subroutine take_edge

   !> Gathers the pressures and gaps of a distributed grid on the rank that writes the tables.
   subroutine collect(self, is_here)
      class(grid_source), intent(inout) :: self
      logical, intent(out) :: is_here

      type(grid_edge), allocatable :: whole
      real(dp), allocatable :: values(:, :)

      is_here = .true.
      if (self%distributed_points == 0) return
      call self%edge%slab%gather_whole(self%edge%pressure_or_gap, values, first_only=.true.)
      is_here = allocated(values)
      if (.not. is_here) return
      allocate (whole)
      call make_grid_edge(whole, values, self%edge%even, self%edge%stiffness, of_cells=self%edge%of_cells)
      call self%take_edge(whole)
   end subroutine collect

   !> Makes the fields, which interpolate between the points (`grid_fields`).
   subroutine fields(self, surface, answer)
      class(grid_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(grid_fields), allocatable :: own

      allocate (own)
      call start_grid_fields(own, surface, self%edge, self%record%value(approach), self%rotated)
      call move_alloc(own, answer)
   end subroutine fields

   !> The edge of contact (C11), (C12), and the loads of the spots. In 2-D the polygons are moved into the contact by
   !> the offset of (C12).
   subroutine contact_contours(self, surface, curves)
      class(grid_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)

      type(region_numbers) :: numbers
      real(dp), allocatable :: edges(:), loads(:)
      integer :: i

      if (surface%dimension == 2) then
         if (self%rotated) then
            ! The surface's cell consists of two cells of the grid.
            call trace_edges(self%edge, curves, self%edge%period*[2, 1], self%edge%period(1), numbers)
         else
            call trace_edges(self%edge, curves, numbers=numbers, with_images=surface%mirrored)
         end if
         do i = 1, size(curves)
            call shift_contour(curves(i), self%edge%period, self%edge%rule%offset)
         end do
         if (self%rotated) call rotate_contours(curves, factor=0.5_dp)
      else
         call grid_strip_edges(self%edge, edges)
         call make_strips(edges, self%edge%in_contact(1, 1), self%edge%even, curves)
         call find_region_numbers(self%edge, [self%edge%period(1), 1], 0, numbers)
      end if
      call spot_loads(self%edge, numbers, loads)
      ! make_strips begins with the strip of the first point, the numbers begin with that of the point before. They
      ! differ if that point is in contact and the first one is not.
      if (surface%dimension == 1 .and. self%edge%in_contact(0, 1) .and. .not. self%edge%in_contact(1, 1)) &
         loads = cshift(loads, 1)
      curves%load = loads(curves%spot)
   end subroutine contact_contours

   !> The stresses below the Fourier series that interpolates the pressures at the points. Their error estimate has two
   !> parts: the error of the peak pressure, and the stresses of the waves in the series' last octave. It is unknown if
   !> the error of the peak is. With free edges the pressure is continued by zeros to twice the points each way, and the
   !> stresses of the periodic images are removed. If the memory is not enough for the series, no stresses exist.
   subroutine stresses(self, surface, answer)
      class(grid_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: pressure
      type(grid_transform) :: transform
      type(grid_stress_fields), allocatable :: own
      !> Real numbers for each point of the whole cell: pressures, their fields, series and waves. From a rotated cell
      !> the series has twice as many.
      integer(int64), parameter :: numbers_a_point = 10
      integer :: cells   ! cells along x and y of the series: the map alone, or the map and as many zeros
      integer :: j
      real(dp) :: crossings       ! pairs of neighbouring points between which contact ends, over the points
      real(dp) :: edge_pressure   ! mean pressure of those of them that are in contact [p*]
      real(dp) :: error
      real(dp), allocatable :: of_approach   ! error of the approach [Delta]; if not allocated, the argument is absent
      real(dp), allocatable :: values(:, :)

      if (.not. has_memory_for(numbers_a_point*product(int(self%edge%period, int64)))) then
         allocate (answer, source=stress_fields(exist=.false.))
         return
      end if
      cells = 1
      if (surface%has_free_edges) cells = 2
      associate (points => self%edge%slab%points)
         allocate (values(cells*points(1), cells*points(2)), source=0.0_dp)
         values(:points(1), :points(2)) = max(self%edge%pressure_or_gap, 0.0_dp)
      end associate
      ! If all points are in contact at P < 1, there is a gap between the points. In full contact the pressure at this
      ! place would be P - 1, so that the error is at least 1 - P.
      error = self%record%error(peak_pressure)
      if (all(values > 0.0_dp)) then
         error = max(error, 1.0_dp - self%record%pbar_over_pstar)
      else if (is_known(self%record%error(approach)) .and. .not. surface%kernel%has_layer()) then
         of_approach = self%record%error(approach)
      end if
      crossings = 0.0_dp
      edge_pressure = 0.0_dp
      do j = 1, size(values, 2)
         call add_crossings(values(2:, j), values(:size(values, 1) - 1, j))
         if (j > 1) call add_crossings(values(:, j), values(:, j - 1))
      end do
      edge_pressure = edge_pressure/max(crossings, 1.0_dp)
      crossings = crossings/real(size(values, kind=int64), dp)
      call transform%start(shape(values), self%edge%even .and. cells == 1, whole=.true.)
      call transform%series(values, pressure)
      deallocate (values)
      if (self%rotated) pressure = in_other_angles(pressure, to_difference_angles)
      allocate (own)
      call start_grid_fields(own%fields, surface, self%edge, self%record%value(approach), self%rotated)
      call start_series_stress_fields(own%series_stress_fields, surface, pressure, &
                                      self%record%pbar_over_pstar/cells**2, or_nan(error), is_sampled=.true., &
                                      approach_error=of_approach, crossings=crossings, edge_pressure=edge_pressure)
      if (cells > 1) call own%remove_images(point_angle(1, self%edge%slab%points, self%edge%even))
      call move_alloc(own, answer)

   contains

      !> Adds pairs of neighbouring points between which contact ends, and their pressures.
      subroutine add_crossings(here, next)
         real(dp), intent(in) :: here(:), next(:)   !! pressures of the points and of their neighbours [p*]

         associate (crosses => (here > 0.0_dp) .neqv. (next > 0.0_dp))
            crossings = crossings + count(crosses)
            edge_pressure = edge_pressure + sum(here + next, mask=crosses)
         end associate
      end subroutine add_crossings

   end subroutine stresses

   !> Derivatives with respect to the load, from solutions on the same grid at loads near by. They are unknown with a
   !> hardness and on a distributed grid.
   subroutine derivatives(self, surface, answer)
      class(grid_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(quantities), intent(out) :: answer

      if (self%distributed_points > 0 .or. surface%has_hardness()) return
      if (self%rotated) then
         call differentiate_on_grid(smaller_cell(surface), self%edge%period, self%record, self%history, answer)
      else
         call differentiate_on_grid(surface, self%edge%period, self%record, self%history, answer)
      end if
   end subroutine derivatives

   !> Packs the source into one array for a checkpoint: (1:2) the stiffness of `edge`, (3:4) the points along x and y,
   !> (5) the first column of this rank, (6:8) whether the cell is rotated, the grid covers a quarter of the cell, and
   !> pressures are uniform on cells, as 1 or 0, (9:17) `history`, and then the pressures and gaps in the columns of
   !> this rank.
   pure subroutine pack_source(self, values)
      class(grid_source), intent(in) :: self
      real(dp), allocatable, intent(out) :: values(:)   !! not allocated if there is not enough memory

      integer :: j, status
      integer(int64) :: rows

      associate (edge => self%edge, slab => self%edge%slab)
         rows = size(edge%pressure_or_gap, 1)
         allocate (values(own_values + size(edge%pressure_or_gap, kind=int64)), stat=status)
         if (status /= 0) return
         values(:own_values) = [edge%stiffness, real([slab%points, slab%first], dp), &
                                merge(1.0_dp, 0.0_dp, [self%rotated, edge%even, edge%of_cells]), &
                                self%history%values, self%history%before]
         do j = 1, size(edge%pressure_or_gap, 2)
            values(own_values + (j - 1)*rows + 1:own_values + j*rows) = edge%pressure_or_gap(:, j)
         end do
      end associate
   end subroutine pack_source

   !> Takes those columns from an array of pack_source that this rank needs. The array may come from any rank; calls for
   !> the arrays of all ranks restore the source. Columns that have not been found are huge, so that the edge, which
   !> is made before they are known, passes none of them over.
   subroutine unpack_source(self, values, whole, complete)
      class(grid_source), intent(inout) :: self   !! before the first call `edge` is not allocated
      real(dp), intent(in) :: values(:)           !! array of pack_source
      logical, intent(in) :: whole                !! whether this rank needs all columns of the grid
      logical, intent(out) :: complete            !! whether all columns that this rank needs have been found

      integer :: first, j, points(2)
      integer(int64) :: before, rows
      real(dp), allocatable :: field(:, :)
      type(grid_edge), allocatable :: edge
      type(grid_slab) :: slab

      points = nint(values(3:4))
      first = nint(values(5))
      rows = points(1)
      if (.not. allocated(self%edge)) then
         self%rotated = values(6) > 0.0_dp
         self%history = change_history(values(9:11), reshape(values(12:17), [3, 2]))
         call slab%start(points, whole)
         allocate (field(rows, slab%columns()), source=huge(1.0_dp))
         allocate (edge)
         call make_grid_edge(edge, field, values(7) > 0.0_dp, values(1:2), slab, values(8) > 0.0_dp)
         call self%take_edge(edge)
      end if
      associate (own => self%edge%slab, field => self%edge%pressure_or_gap)
         do j = max(first, own%first), min(first + int((size(values, kind=int64) - own_values)/rows) - 1, own%last)
            before = own_values + (j - first)*rows
            field(:, j - own%first + 1) = values(before + 1:before + rows)
         end do
         complete = all(field(1, :) < huge(1.0_dp))
      end associate
   end subroutine unpack_source

   !> The part of the load that each spot carries: the sum of the pressures at the spot's points over the sum of all.
   pure subroutine spot_loads(edge, numbers, loads)
      type(grid_edge), intent(in) :: edge             !! pressures and gaps at the points
      type(region_numbers), intent(in) :: numbers     !! number of the spot of each point
      real(dp), allocatable, intent(out) :: loads(:)  !! parts of the load, shape (number of spots)

      integer :: k, l

      allocate (loads(numbers%spots), source=0.0_dp)
      do l = 0, ubound(numbers%region_at, 2)
         do k = 0, ubound(numbers%region_at, 1)
            associate (spot => numbers%region_at(k, l))
               if (spot > 0) loads(spot) = loads(spot) &
                                           + edge%pressure_or_gap(edge%index_in_grid(k, 1), edge%index_in_grid(l, 2))
            end associate
         end do
      end do
      if (numbers%spots > 0) loads = loads/sum(loads)
   end subroutine spot_loads

end module wavycon_grid_source
