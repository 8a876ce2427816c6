!> Contact on grids, refined to an accuracy or with a given number of points.
!>
!> An even surface is solved on a quarter of its cell. The wave (21), and any surface with the same symmetry, is also
!> periodic on a square of half the area turned by 45 degrees; a quarter of that square is then enough, unless
!> the number of points, which refers to the user's cell, is given.
module wavycon_grid_contact
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: contact_measures, or_nan, unknown
   use wavycon_contact_solution, only: contact_solution, no_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: converged, iteration_limit, no_memory, not_accurate, unresolved
   use wavycon_contact_tuning, only: largest_spot, least_search_points, worst_search_accuracy
   use wavycon_edge_curves, only: edge_curve, shift_curve, strip_ends, trace_edges, turn_curves, whole_strips
   use wavycon_grid_cascade, only: cascade_answer, solve_by_cascade
   use wavycon_grid_edge, only: grid_edge, grid_strip_edges, make_grid_edge
   use wavycon_grid_fields, only: grid_fields, start_grid_fields
   use wavycon_grid_plan, only: grid_plan, plan_grids
   use wavycon_grid_slab, only: grid_slab
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_load_concentration, only: load_concentration
   use wavycon_measure_tuning, only: edge_offset
   use wavycon_ranks, only: gather_columns, is_first_rank
   use wavycon_region_numbers, only: region_numbers
   use wavycon_solution_record, only: by_grids
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   use wavycon_turned_series, only: to_difference_angles
   implicit none (type, external)
   private

   public :: grid_contact, grid_solution

   type, extends(contact_solver) :: grid_contact
      real(dp), private :: accuracy = 0.0_dp                 !! requested
      integer, private :: points(2) = 0                      !! requested
      real(dp), private :: residual = 0.0_dp                 !! requested on these points
      integer, private :: level = 0                          !! of `use_level`
      logical, private :: keep_fields = .true.
      !> The surface on its smaller cell, if that is solved: turned by 45 degrees.
      type(surface_type), allocatable, private :: smaller
   contains
      procedure :: start
      procedure :: solve_partial_contact
      procedure :: traits
      procedure :: use_level
      procedure :: new_kept_solution
   end type grid_contact

   type, extends(contact_solution) :: grid_solution
      type(grid_edge), allocatable :: edge    !! pressure and gap at the grid points; not allocated if not kept
      logical, private :: turned = .false.    !! the grid's cell is the smaller one, turned by 45 degrees
      real(dp) :: imprint = 0.0_dp            !! mean overlap where p = H [Delta] (C22)
   contains
      procedure :: fields
      procedure :: edge_curves
      procedure :: stresses
      procedure :: spread_points
      procedure :: collect_fields
      procedure :: is_kept
      procedure :: pack_kept
      procedure :: unpack_kept
   end type grid_solution

   !> Numbers in the array of pack_kept before the field.
   integer, parameter :: own_values = 9

contains

   !> Starts the solver.
   subroutine start(self, surface, accuracy, keep_fields, points, residual)
      class(grid_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: accuracy      !! of mean gap [Delta], contact area fraction and peak pressure [p*]
      logical, intent(in) :: keep_fields    !! whether solutions keep their fields and edges
      !> Points of the whole cell along x and y of the one grid to solve, in place of the accuracy; absent or zeros:
      !> solve to the accuracy. Even numbers for an even surface; the second is ignored in 1-D.
      integer, intent(in), optional :: points(2)
      !> Largest residual (C9) on the given points; absent or 0: that of (C10).
      real(dp), intent(in), optional :: residual

      self%surface = surface
      self%is_started = allocated(surface%shape%c)
      if (present(residual)) self%residual = residual
      self%accuracy = accuracy
      self%keep_fields = keep_fields
      if (present(points)) self%points = points
      if (surface%dimension == 1) self%points(2) = min(self%points(2), 1)
      if (any(self%points > 0) .or. .not. surface%has_smaller_cell()) return
      allocate (self%smaller)
      self%smaller = surface%smaller_cell()
   end subroutine start

   !> Each level has ten times the error of the one before it or, if the points are given, half the points each way.
   pure integer function coarser_levels(self) result(levels)
      class(grid_contact), intent(in) :: self

      levels = 0
      if (all(self%points > 0)) then
         do while (all(mod(self%points, 2**(levels + 2)) == 0 .or. self%points == 1) .and. &
                   maxval(self%points)/2**(levels + 1) >= least_search_points)
            levels = levels + 1
         end do
      else if (self%accuracy > 0.0_dp) then
         do while (self%accuracy*10.0_dp**levels < worst_search_accuracy)
            levels = levels + 1
         end do
      end if
   end function coarser_levels

   type(solver_traits) function traits(self)
      class(grid_contact), intent(in) :: self

      type(grid_plan) :: plan

      traits = solver_traits(solver=by_grids, coarser_levels=coarser_levels(self))
      if (.not. self%is_started) return
      if (allocated(self%smaller)) then
         plan = plan_grids(self%smaller, self%points)
      else
         plan = plan_grids(self%surface, self%points)
      end if
      traits%finest_grid = plan%last
      if (all(self%points > 0)) traits%given_grid = plan%last
   end function traits

   subroutine use_level(self, level)
      class(grid_contact), intent(inout) :: self
      integer, intent(in) :: level

      self%level = level
   end subroutine use_level

   !> Solves one load by solve_by_cascade.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(grid_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      class(contact_solution), allocatable, intent(out) :: solution

      type(cascade_answer) :: answer
      type(grid_solution), allocatable :: own

      if (allocated(self%smaller)) then
         call solve_cell(self, self%smaller, pbar_over_pstar, answer)
      else
         call solve_cell(self, self%surface, pbar_over_pstar, answer)
      end if
      if (.not. allocated(answer%edge)) then
         call no_solution(pbar_over_pstar, by_grids, no_memory, solution)
         return
      end if
      allocate (own)
      own%pbar_over_pstar = pbar_over_pstar
      own%solver = by_grids
      own%turned = allocated(self%smaller)
      own%measures = contact_measures(mean_gap_over_amplitude=answer%values(1), &
                                      approach_over_amplitude=1.0_dp - answer%state%mean_gap, &
                                      contact_area_fraction=answer%values(2), &
                                      peak_pressure_over_pstar=answer%values(3), &
                                      min_pressure_over_pstar=least_pressure(answer%edge), &
                                      mean_gap_error=answer%errors(1), contact_area_error=answer%errors(2), &
                                      peak_pressure_error=answer%errors(3), &
                                      area_at_hardness_fraction=answer%area_at_hardness, &
                                      area_at_hardness_error=answer%area_at_hardness_error, &
                                      contact_area_counted_fraction=answer%counted_area, &
                                      contact_area_corrected_fraction=answer%corrected_area)
      if (self%surface%has_hardness()) then
         associate (load_of_area => self%surface%hardness/pbar_over_pstar)
            own%measures%load_at_hardness_fraction = answer%area_at_hardness*load_of_area
            own%measures%load_at_hardness_error = answer%area_at_hardness_error*load_of_area
         end associate
         if (.not. own%measures%load_at_hardness_error < 1.0_dp) own%measures%load_at_hardness_error = unknown
      end if
      if (all(self%surface%points > 0) .and. answer%values(2) <= largest_spot) &
         own%measures%load_concentration = load_concentration(answer%edge)
      own%imprint = answer%state%imprint
      own%active_constraints = bound_points(answer%edge, self%surface%hardness)
      own%iterations = answer%iterations
      own%residual = answer%state%residual
      if (.not. answer%state%converged) then
         own%status = iteration_limit
      else if (answer%accurate) then
         own%status = converged
      else if (answer%out_of_memory) then
         own%status = no_memory
      else if (any(self%points == 0)) then
         own%status = not_accurate
      else if (all(own%measures%are_resolved())) then
         own%status = converged
      else
         own%status = unresolved
      end if
      if (self%keep_fields) call move_alloc(answer%edge, own%edge)
      call move_alloc(own, solution)
   end subroutine solve_partial_contact

   !> Solves a load on the surface or its smaller cell.
   subroutine solve_cell(self, surface, pbar_over_pstar, answer)
      class(grid_contact), intent(in) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar
      type(cascade_answer), intent(out) :: answer

      associate (accuracy => self%accuracy*10.0_dp**self%level, points => self%points/2**self%level)
         if (associated(self%progress)) then
            call solve_by_cascade(surface, pbar_over_pstar, accuracy, points, answer, self%progress, self%residual)
         else
            call solve_by_cascade(surface, pbar_over_pstar, accuracy, points, answer, residual=self%residual)
         end if
      end associate
   end subroutine solve_cell

   !> The least pressure at the points of the grid.
   real(dp) function least_pressure(edge) result(least)
      type(grid_edge), intent(in) :: edge

      real(dp) :: opposite(1)

      opposite = -minval(edge%pressure_or_gap)
      call edge%slab%largest(opposite)
      least = max(-opposite(1), 0.0_dp)
   end function least_pressure

   !> The number of points of the grid where the pressure is zero or the hardness.
   integer(int64) function bound_points(edge, hardness) result(number)
      type(grid_edge), intent(in) :: edge
      real(dp), intent(in) :: hardness

      integer(int64) :: total(1)

      total = count(edge%pressure_or_gap <= 0.0_dp, kind=int64) + count(edge%pressure_or_gap >= hardness, kind=int64)
      call edge%slab%add(total)
      number = total(1)
   end function bound_points

   pure integer(int64) function spread_points(self)
      class(grid_solution), intent(in) :: self

      spread_points = 0
      if (.not. allocated(self%edge)) return
      if (self%edge%slab%is_spread) spread_points = product(int(self%edge%slab%points, int64))
   end function spread_points

   !> Gathers the fields of a solution whose grid is spread over the ranks on the first of them; the others have none
   !> afterwards. All ranks must call it.
   subroutine collect_fields(self)
      class(grid_solution), intent(inout) :: self

      type(grid_edge), allocatable :: whole
      real(dp), allocatable :: values(:, :)

      if (.not. allocated(self%edge)) return
      associate (slab => self%edge%slab)
         if (.not. slab%is_spread) return
         allocate (values(slab%points(1), merge(slab%points(2), 0, is_first_rank())))
         call gather_columns(slab%columns_of_ranks(), self%edge%pressure_or_gap, values, first_only=.true.)
      end associate
      if (is_first_rank()) then
         allocate (whole)
         call make_grid_edge(whole, values, self%edge%even, self%edge%stiffness)
      end if
      deallocate (self%edge)
      if (allocated(whole)) call move_alloc(whole, self%edge)
   end subroutine collect_fields

   subroutine fields(self, surface, answer)
      class(grid_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(grid_fields), allocatable :: own

      if (.not. allocated(self%edge)) return
      allocate (own)
      call start_grid_fields(own, surface, self%edge, self%measures%mean_gap_over_amplitude - self%imprint, self%turned)
      call move_alloc(own, answer)
   end subroutine fields

   subroutine edge_curves(self, surface, curves, loads)
      class(grid_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out), optional :: loads(:)

      type(region_numbers) :: numbers
      real(dp), allocatable :: edges(:)
      integer :: i

      if (.not. allocated(self%edge)) then
         allocate (curves(0))
         if (present(loads)) allocate (loads(0))
      else if (surface%dimension == 2) then
         if (self%turned) then
            ! The surface's cell is two of the grid's.
            call trace_edges(self%edge, curves, self%edge%period*[2, 1], self%edge%period(1), numbers)
         else
            call trace_edges(self%edge, curves, numbers=numbers, with_images=surface%mirrored)
         end if
         do i = 1, size(curves)
            call shift_curve(curves(i), self%edge%period, edge_offset)
         end do
         if (self%turned) call turn_curves(curves, factor=0.5_dp)
         if (present(loads)) call spot_loads(self%edge, numbers, loads)
      else
         call grid_strip_edges(self%edge, edges)
         if (self%edge%even) then
            call strip_ends(edges, self%edge%in_contact(1, 1), curves)
         else
            call whole_strips(edges, self%edge%in_contact(1, 1), curves)
         end if
         if (present(loads)) call strip_loads(self%edge, size(curves), loads)
      end if
   end subroutine edge_curves

   !> Of the series that interpolates the pressures at the points. Its error is that of the peak pressure and the part
   !> of the series' last octave, or unknown as that of the peak is. Without the memory for the series there are no
   !> stresses.
   subroutine stresses(self, surface, answer)
      class(grid_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: pressure
      type(grid_transform) :: transform
      type(series_stress), allocatable :: own
      !> Of the whole cell: pressures, series, waves; twice as many from a turned cell.
      integer(int64), parameter :: numbers_a_point = 8
      real(dp) :: error
      real(dp), allocatable :: values(:, :)

      if (.not. allocated(self%edge)) return
      allocate (own)
      if (.not. has_memory_for(numbers_a_point*product(int(self%edge%period, int64)))) then
         own%exist = .false.
         call move_alloc(own, answer)
         return
      end if
      values = max(self%edge%pressure_or_gap, 0.0_dp)
      ! If all points are in contact below full contact, they miss a gap; with it closed the pressure there is P - 1.
      error = self%measures%peak_pressure_error
      if (all(values > 0.0_dp)) error = max(error, 1.0_dp - self%pbar_over_pstar)
      error = or_nan(error)
      call transform%start(shape(values), self%edge%even)
      call transform%series(values, pressure)
      deallocate (values)
      if (self%turned) pressure = to_difference_angles(pressure)
      call start_series_stress(own, surface, pressure, self%pbar_over_pstar, &
                               pressure_error=error, is_sampled=.true.)
      call move_alloc(own, answer)
   end subroutine stresses

   !> Solutions on grids are written to checkpoints: they may take minutes, those of other solvers take seconds.
   pure logical function is_kept(self)
      class(grid_solution), intent(in) :: self

      associate (unused => self); end associate
      is_kept = .true.
   end function is_kept

   subroutine new_kept_solution(self, solution)
      class(grid_contact), intent(in) :: self
      class(contact_solution), allocatable, intent(out) :: solution

      associate (unused => self); end associate
      allocate (grid_solution :: solution)
   end subroutine new_kept_solution

   !> The imprint, the stiffness of `edge`, the points along x and y (zeros if the
   !> fields were not kept), the width of the slabs and the first column of this rank's, whether the cell is turned,
   !> whether the grid covers a quarter of it, and the pressures and gaps at the own columns.
   pure subroutine pack_kept(self, values)
      class(grid_solution), intent(in) :: self
      real(dp), allocatable, intent(out) :: values(:)

      real(dp) :: stiffness(2)
      integer :: first, j, layout(4), status
      integer(int64) :: rows

      layout = 0
      rows = 0
      stiffness = 1.0_dp
      first = own_values
      if (allocated(self%edge)) then
         associate (slab => self%edge%slab)
            layout = [slab%points, slab%width, slab%first]
         end associate
         rows = size(self%edge%pressure_or_gap, 1)
         stiffness = self%edge%stiffness
         allocate (values(first + size(self%edge%pressure_or_gap, kind=int64)), stat=status)
      else
         allocate (values(first), stat=status)
      end if
      if (status /= 0) return
      values(:first) = [self%imprint, stiffness, real(layout, dp), 0.0_dp, 0.0_dp]
      if (self%turned) values(first - 1) = 1.0_dp
      if (.not. allocated(self%edge)) return
      if (self%edge%even) values(first) = 1.0_dp
      do j = 1, size(self%edge%pressure_or_gap, 2)
         values(first + (j - 1)*rows + 1:first + j*rows) = self%edge%pressure_or_gap(:, j)
      end do
   end subroutine pack_kept

   !> N.B. Without exchange: another rank may not understand its numbers.
   pure subroutine unpack_kept(self, values, understood)
      class(grid_solution), intent(inout) :: self
      real(dp), intent(in) :: values(:)
      logical, intent(out) :: understood

      integer :: columns, first, j, layout(4)
      integer(int64) :: rows
      real(dp), allocatable :: field(:, :)
      type(grid_slab) :: slab

      first = own_values
      understood = size(values) >= first
      if (understood) understood = all(values(first - 5:first - 2) >= 0.0_dp .and. &
                                       values(first - 5:first - 2) <= huge(layout))
      if (.not. understood) return
      layout = nint(values(first - 5:first - 2))
      slab = grid_slab(points=layout(:2), width=layout(3), first=layout(4), is_spread=layout(3) < layout(2))
      slab%last = min(slab%first - 1 + slab%width, slab%points(2))
      columns = slab%columns()
      rows = slab%points(1)
      if (all(layout == 0)) columns = 0
      understood = columns >= 0 .and. rows*columns == size(values, kind=int64) - first
      if (.not. understood) return
      self%imprint = values(first - 8)
      self%turned = values(first - 1) > 0.0_dp
      if (rows == 0) return
      allocate (field(rows, columns))
      do j = 1, columns
         field(:, j) = values(first + (j - 1)*rows + 1:first + j*rows)
      end do
      allocate (self%edge)
      call make_grid_edge(self%edge, field, values(first) > 0.0_dp, values(first - 7:first - 6), slab)
   end subroutine unpack_kept

   !> What each spot carries of the load: the pressures at its points.
   pure subroutine spot_loads(edge, numbers, loads)
      type(grid_edge), intent(in) :: edge
      type(region_numbers), intent(in) :: numbers   !! of the points
      real(dp), allocatable, intent(out) :: loads(:)

      integer :: k, l

      allocate (loads(numbers%spots), source=0.0_dp)
      do l = 0, ubound(numbers%at, 2)
         do k = 0, ubound(numbers%at, 1)
            associate (spot => numbers%at(k, l))
               if (spot > 0) loads(spot) = loads(spot) + edge%pressure_or_gap(edge%place(k, 1), edge%place(l, 2))
            end associate
         end do
      end do
      if (numbers%spots > 0) loads = loads/sum(loads)
   end subroutine spot_loads

   !> The same of the strips of a 1-D contact, which begin with the one of the first point.
   pure subroutine strip_loads(edge, strips, loads)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: strips   !! their number
      real(dp), allocatable, intent(out) :: loads(:)

      integer :: k, strip

      allocate (loads(strips), source=0.0_dp)
      if (strips == 0) return
      strip = merge(1, 0, edge%in_contact(1, 1))
      do k = 1, edge%period(1)
         if (.not. edge%in_contact(k, 1)) cycle
         if (k > 1 .and. .not. edge%in_contact(k - 1, 1)) strip = mod(strip, strips) + 1
         loads(strip) = loads(strip) + edge%pressure_or_gap(edge%place(k, 1), 1)
      end do
      loads = loads/sum(loads)
   end subroutine strip_loads

end module wavycon_grid_contact
