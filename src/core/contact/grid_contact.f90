!> The solver 'grid'. Grids are refined until an accuracy is met, or one grid of a given number of points is solved.
!>
!> An even surface is solved on a quarter of its cell. The wave (21), and any surface with the same symmetry, is also
!> periodic on a smaller square of half the area, rotated by 45 degrees. Then a quarter of the smaller square is solved,
!> unless the number of points is given, which refers to the cell of the deck.
module wavycon_grid_contact
   use wavycon_assertion, only: assert
   use wavycon_contact_measures, only: full_contact_quantities
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, default_accuracy, solver_traits
   use wavycon_contact_tuning, only: border, largest_spot, least_search_points, worst_search_accuracy
   use wavycon_grid_sequence, only: grid_start, sequence_answer, solve_by_sequence
   use wavycon_grid_edge, only: grid_edge
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_grid_plan, only: grid_plan, plan_grids
   use wavycon_grid_source, only: grid_source
   use wavycon_grid_area, only: load_concentration
   use wavycon_hidden_gap, only: full_contact_edge, hidden_gap_errors
   use wavycon_kinds, only: dp, int64
   use wavycon_paper_wave, only: has_smaller_cell, smaller_cell
   use wavycon_quantities, only: approach, area_at_hardness, border_load, concentrated_load, contact_area, &
      elastic_energy, load_at_hardness, mean_gap, min_pressure, peak_pressure, scaled, unknown
   use wavycon_solution_record, only: by_grid, converged, full_contact, interrupted, iteration_limit, no_memory, &
      no_solution, not_accurate, unresolved
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_contact, grid_options

   type :: grid_options
      !> Largest error of mean gap [Delta], contact area fraction and peak pressure [p*], > 0. It is ignored if `points`
      !> are given.
      real(dp) :: accuracy = default_accuracy
      !> Points along x and y of the one grid to solve, on the whole cell, in place of the accuracy: > 0, even numbers
      !> for an even surface; the second one is ignored in 1-D. Zeros: grids are refined to the accuracy.
      integer :: points(2) = 0
      !> Largest residual (C9) on the grid of these points, >= 0; 0: the tolerance (C10).
      real(dp) :: residual = 0.0_dp
   end type grid_options

   type, extends(contact_solver) :: grid_contact
      type(grid_options), private :: options
      logical, private :: keep_fields = .true.
      !> The surface on its smaller cell, rotated by 45 degrees. Not allocated if the cell itself is solved.
      type(surface_type), allocatable, private :: smaller
      !> The pressures of the last load of a search on each grid, from the coarsest. Allocated within a search only.
      type(grid_start), allocatable, private :: starts(:)
      !> P from which on a map in full contact has no gap between its points; huge before a load of full contact.
      real(dp), private :: closes_at = huge(1.0_dp)
   contains
      procedure :: start, solve_partial_contact, measure_full_contact, set_search, traits
   end type grid_contact

contains

   !> Starts the solver. Any surface with a series of heights can be solved.
   subroutine start(self, surface, options, keep_fields)
      class(grid_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      type(grid_options), intent(in) :: options
      logical, intent(in) :: keep_fields    !! whether solutions keep their fields and edges

      self%options = options
      if (surface%dimension == 1) self%options%points(2) = min(options%points(2), 1)
      if (any(options%points > 0)) self%options%accuracy = 0.0_dp
      associate (points => self%options%points)
         call assert(all(points > 0) .or. all(points == 0), 'points > 0')
         call assert(all(points > 0) .or. options%accuracy > 0.0_dp, 'accuracy > 0')
         call assert(all(mod(points(:surface%dimension), 2) == 0) .or. .not. surface%shape%is_even(), &
                     'even points of an even surface')
         call assert(options%residual >= 0.0_dp, 'residual >= 0')
      end associate
      self%surface = surface
      self%closes_at_pstar = .not. surface%is_height_map() .or. all(self%options%points == surface%points)
      self%is_started = surface%shape%last(1) >= 0
      self%keep_fields = keep_fields
      if (any(self%options%points > 0) .or. .not. has_smaller_cell(surface)) return
      allocate (self%smaller)
      self%smaller = smaller_cell(surface)
   end subroutine start

   !> The traits. The grids are the first trusted one and the last one of the plan, on the cell that is solved. Each
   !> coarser level of a search has ten times the error or, if the points are given, half the points each way.
   type(solver_traits) function traits(self)
      class(grid_contact), intent(in) :: self

      type(grid_plan) :: plan

      traits = solver_traits(solver=by_grid)
      associate (points => self%options%points, accuracy => self%options%accuracy, levels => traits%coarser_levels)
         if (all(points > 0)) then
            do while (all(mod(points, 2**(levels + 2)) == 0 .or. points == 1) .and. &
                      maxval(points)/2**(levels + 1) >= least_search_points)
               levels = levels + 1
            end do
         else if (accuracy > 0.0_dp) then
            do while (accuracy*10.0_dp**levels < worst_search_accuracy)
               levels = levels + 1
            end do
         end if
      end associate
      if (.not. self%is_started) return
      plan = plan_grids(self%surface, self%options%points)
      if (allocated(self%smaller)) plan = plan_grids(self%smaller, self%options%points)
      traits%coarsest_grid = plan%grids(:, plan%trusted)
      traits%finest_grid = plan%grids(:, size(plan%grids, 2))
      traits%lacks_waves = plan%lacks_waves
      if (all(self%options%points > 0)) traits%given_grid = traits%finest_grid
   end function traits

   !> The peak pressure of a map that is closed at its points lies between them: (C13a), where p is the series p_full.
   !> Gaps may lie there, too.
   subroutine measure_full_contact(self, solution)
      class(grid_contact), intent(inout) :: self
      type(contact_solution), intent(inout) :: solution

      !> Loads that are closer than this to that at which the last gap closes are measured: it is rounded.
      real(dp), parameter :: rounding = 1e-9_dp
      !> Largest error of the polynomials through fifths of a step of the map over that of a constant, in 1-D and 2-D:
      !> (C13b).
      real(dp), parameter :: interpolation_error(2) = [1.45e-3_dp, 5.93e-3_dp]
      type(grid_edge) :: edge
      real(dp) :: bend, errors(3), peak
      real(dp) :: finer   ! longer step of the grid over that of the map

      associate (surface => self%surface)
         if (.not. (surface%is_height_map() .and. surface%amplitude > 0.0_dp)) return
         call full_contact_edge(surface, self%options%points/surface%maps_in_cell(), solution%pbar_over_pstar, edge)
         call grid_peak_pressure(edge, peak, bend, surface)
         solution%value(peak_pressure) = min(peak, surface%hardness)
         errors = 0.0_dp
         if (solution%pbar_over_pstar < self%closes_at + rounding) errors = hidden_gap_errors( &
            surface, edge%slab%points, solution%pbar_over_pstar, open_part=0.0_dp, closes_at=self%closes_at)
         finer = maxval(surface%points(:surface%dimension)/real(self%options%points(:surface%dimension), dp))
         solution%error(peak_pressure) = max(bend, errors(3), interpolation_error(surface%dimension)*finer**6 &
                                             *0.5_dp*(peak - solution%value(min_pressure)))
         solution%error([mean_gap, approach]) = errors(1)
         solution%error(contact_area) = errors(2)
         solution%error(elastic_energy) = scaled(errors(1), 2*solution%pbar_over_pstar)
      end associate
   end subroutine measure_full_contact

   !> Solves one load by solve_by_sequence, measures the edge of contact and sets the status. The status is no_memory or
   !> interrupted if not even the coarsest grid was solved.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(grid_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      type(sequence_answer) :: answer
      type(grid_source), allocatable :: source
      real(dp) :: least_pressure   ! [p*]

      if (allocated(self%smaller)) then
         call solve_cell(self, self%smaller, pbar_over_pstar, answer)
      else
         call solve_cell(self, self%surface, pbar_over_pstar, answer)
      end if
      if (.not. allocated(answer%edge)) then
         solution%solution_record = no_solution(pbar_over_pstar, by_grid, &
                                                merge(interrupted, no_memory, answer%state%interrupted))
         return
      end if
      solution%pbar_over_pstar = pbar_over_pstar
      solution%solver = by_grid
      solution%quantities = answer%quantities
      call measure_edge(self%surface, answer%edge, solution)
      if (self%surface%has_hardness()) then
         associate (load_of_area => self%surface%hardness/pbar_over_pstar)
            solution%value(load_at_hardness) = answer%value(area_at_hardness)*load_of_area
            solution%error(load_at_hardness) = answer%error(area_at_hardness)*load_of_area
         end associate
         if (.not. solution%error(load_at_hardness) < 1.0_dp) solution%error(load_at_hardness) = unknown
      end if
      solution%iterations = answer%iterations
      solution%residual = answer%state%residual
      if (.not. answer%state%converged) then
         solution%status = iteration_limit
      else if (answer%accurate) then
         solution%status = converged
      else if (answer%out_of_memory) then
         solution%status = no_memory
      else if (any(self%options%points == 0)) then
         solution%status = not_accurate
      else if (is_closed_map(self, solution)) then
         least_pressure = solution%value(min_pressure)
         solution%quantities = full_contact_quantities(self%surface, pbar_over_pstar)
         solution%value(min_pressure) = least_pressure
         call self%measure_full_contact(solution)
         solution%status = full_contact
         return
      else if (all(solution%are_resolved(self%surface))) then
         solution%status = converged
      else
         solution%status = unresolved
      end if
      if (.not. self%keep_fields) return
      allocate (source)
      source%rotated = allocated(self%smaller)
      source%history = answer%history
      call source%take_edge(answer%edge)
      call move_alloc(source, solution%source)
   end subroutine solve_partial_contact

   !> Whether a height map is in contact at all points of a given grid that has all of its waves. Its pressure is then
   !> the series p_full, as on its own points.
   logical function is_closed_map(self, solution)
      class(grid_contact), intent(in) :: self
      type(contact_solution), intent(in) :: solution   !! after measure_edge

      type(grid_plan) :: plan

      plan = plan_grids(self%surface, self%options%points)
      is_closed_map = self%surface%is_height_map() .and. .not. self%surface%has_free_edges .and. self%level == 0 .and. &
                      solution%pbar_over_pstar >= 1.0_dp .and. solution%active_constraints == 0 .and. &
                      .not. plan%lacks_waves
   end function is_closed_map

   !> Begins or ends a search: allocates or deletes the pressures from which its loads start.
   subroutine set_search(self, begins)
      class(grid_contact), intent(inout) :: self
      logical, intent(in) :: begins

      if (allocated(self%starts)) deallocate (self%starts)
      ! No sequence has more grids than an integer has bits: each grid has at least twice the points of the one before.
      if (begins) allocate (self%starts(bit_size(self%options%points)))
   end subroutine set_search

   !> Solves a load on the cell of the surface or on its smaller cell, at the level of a search.
   subroutine solve_cell(self, surface, pbar_over_pstar, answer)
      class(grid_contact), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar
      type(sequence_answer), intent(out) :: answer

      ! In 1-D the second number of points stays 1.
      associate (accuracy => self%options%accuracy*10.0_dp**self%level, &
                 points => max(self%options%points/2**self%level, min(self%options%points, 1)), &
                 residual => self%options%residual)
         ! `progress` may be a pointer that is not associated, and `starts` an array that is not allocated. By the rules
         ! of Fortran such optional arguments are absent.
         call solve_by_sequence(surface, pbar_over_pstar, accuracy, points, answer, self%progress, residual, &
                                self%keep_fields, self%starts)
      end associate
   end subroutine solve_cell

   !> Measures what tables and log tell besides area and peak: the number of points whose pressure is zero or the
   !> hardness, the least pressure, how concentrated the load is, and the part of the load near the border of the map.
   subroutine measure_edge(surface, edge, solution)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge   !! pressures and gaps; with free edges not distributed
      type(contact_solution), intent(inout) :: solution

      integer :: inner(2)
      real(dp) :: extremes(2)

      associate (p => edge%pressure_or_gap, points => edge%slab%points)
         solution%active_constraints = edge%slab%total_count(count(p <= 0.0_dp, kind=int64) &
                                                             + count(p >= surface%hardness, kind=int64))
         extremes = edge%slab%extremes(p)
         solution%value(min_pressure) = max(-extremes(2), 0.0_dp)
         if (surface%is_height_map() .and. solution%value(contact_area) <= largest_spot) &
            solution%value(concentrated_load) = load_concentration(edge)
         if (.not. surface%has_free_edges) return
         ! The part of the load whose distance from the border of the map is below `border` times the side.
         inner = ceiling(border*points)
         if (points(2) == 1) inner(2) = 0
         associate (middle => p(1 + inner(1):points(1) - inner(1), 1 + inner(2):points(2) - inner(2)))
            solution%value(border_load) = 1.0_dp - sum(middle, middle > 0.0_dp)/sum(p, p > 0.0_dp)
         end associate
      end associate
   end subroutine measure_edge

end module wavycon_grid_contact
