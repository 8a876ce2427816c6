!> Solves one load on a sequence of grids, each with half the step of the one before, until the error estimates are
!> within an accuracy.
!>
!> The solution on one grid is the start on the next, and the error estimates follow from the changes from grid to grid.
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_sequence
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_measures, only: contact_measures, is_known, known_errors, scaled_error, unknown
   use wavycon_contact_tuning, only: iteration_limit, iterations_of_root
   use wavycon_grid_area, only: corrected_area_fraction, counted_area_fraction, edge_crossings, grid_contact_area
   use wavycon_free_level, only: complete_gap, solve_free_level
   use wavycon_grid_edge, only: grid_edge, joined, make_grid_edge, pressure_per_gap, start_grid_edge
   use wavycon_grid_error, only: change_history, estimate_errors, unresolved_errors
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_grid_plan, only: fits_memory, grid_plan, plan_grids
   use wavycon_grid_refinement, only: refine_pressure
   use wavycon_grid_solver, only: solve_on_grid
   use wavycon_grid_state, only: grid_state
   use wavycon_kinds, only: dp
   use wavycon_pressure_load, only: set_load, sum_of_field
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: sequence_answer, solve_by_sequence

   type :: sequence_answer
      type(grid_state) :: state            !! on the finest grid, without the gap
      !> On the finest grid; not allocated if the first did not fit into memory, or if `progress` stopped the solver.
      type(grid_edge), allocatable :: edge
      !> Mean gap, with free edges in 2-D the approach [Delta], contact area fraction, peak pressure [p*].
      real(dp) :: values(3) = 0.0_dp
      real(dp) :: errors(3) = unknown      !! their error estimates, in the same units, or `unknown`
      type(contact_measures) :: measures   !! the values, their errors and what else the grid has
      type(change_history) :: history      !! the values on the last three grids, without the bound of a hardness
      logical :: accurate = .false.        !! whether all error estimates are within the accuracy
      logical :: out_of_memory = .false.   !! whether a grid was needed that does not fit into memory
      integer :: grids = 0
      integer :: iterations = 0            !! on all grids
      real(dp) :: transform_pairs = 0.0_dp !! in both precisions, in units of one on the finest grid
   end type sequence_answer

contains

   !> Solves one load, to an accuracy or up to a given grid. The sequence ends early if a grid does not fit into memory
   !> (`out_of_memory`), the iteration on it does not converge (`state%converged` is false), or `progress` says that it
   !> shall stop (`state%interrupted`): then there is no edge.
   subroutine solve_by_sequence(surface, mean_pressure, accuracy, points, answer, progress, residual, needs_gap)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure           !! P in (0, 1), or in (0, H) if the surface has a hardness
      !> Largest error estimate allowed of the three values, with free edges over these, >= 0.
      real(dp), intent(in) :: accuracy
      integer, intent(in) :: points(2)                !! of the last grid, on the whole cell; zeros: to the accuracy
      type(sequence_answer), intent(out) :: answer
      !> Is called after each grid, and asked in its iterations whether to stop.
      class(solver_progress), intent(in), optional :: progress
      !> Residual (C9) of the last grid that `points` gives; absent or 0: as its edge needs it (C10).
      real(dp), intent(in), optional :: residual
      !> Whether the edge of a surface with free edges is to have the gap at points far from the contact too.
      logical, intent(in), optional :: needs_gap

      real(dp), allocatable :: h(:, :)
      type(change_history) :: history_at_hardness
      type(grid_edge), allocatable :: edge_at_hardness
      type(grid_plan) :: plan
      real(dp) :: last_residual, scale(3)
      logical :: ends, has_room, last
      integer :: grid(2)

      plan = plan_grids(surface, points)
      grid = plan%first
      last_residual = 0.0_dp
      if (present(residual) .and. all(points > 0)) last_residual = residual
      answer%out_of_memory = .not. fits_memory(grid)
      if (answer%out_of_memory) return
      call answer%state%slab%start(grid)
      allocate (answer%state%pressure(grid(1), answer%state%slab%columns()), source=mean_pressure)
      answer%state%hardness = surface%hardness
      do
         last = all(grid == plan%last)
         call solve_level(surface, mean_pressure, merge(last_residual, 0.0_dp, last), h, answer, progress)
         if (answer%state%interrupted) return
         ! No finer grid starts from a solution that has not converged.
         ends = last .or. .not. answer%state%converged
         has_room = .true.
         if (.not. ends) has_room = fits_memory(plan%next(grid))
         if (surface%has_hardness()) call find_edge_at_hardness(surface, answer%state, edge_at_hardness)
         ! Only the errors of an answer are of interest.
         call measure_level(surface, mean_pressure, h, ends .or. .not. has_room .or. all(grid >= plan%trusted), answer)
         if (surface%has_hardness()) then
            call measure_at_hardness(surface, mean_pressure, edge_at_hardness, history_at_hardness, answer)
            deallocate (edge_at_hardness)
         end if
         scale = 1.0_dp
         if (surface%has_free_edges) scale = answer%values
         answer%accurate = answer%state%converged .and. all(grid >= plan%trusted) .and. &
            all(answer%errors <= accuracy*scale .or. .not. is_known(answer%values)) .and. &
            answer%measures%area_at_hardness_error <= accuracy*scale(2)
         if (present(progress)) &
            call progress%grid_solved(grid*merge(2, 1, surface%shape%is_even() .and. grid > 1)/surface%parts(), &
                                      answer%state%iterations, answer%state%residual)
         if (answer%accurate .or. ends) exit
         answer%out_of_memory = .not. has_room
         if (answer%out_of_memory) exit
         grid = plan%next(grid)
         call answer%state%slab%start(grid)
         call refine_pressure(answer%edge, answer%state%slab, answer%state%pressure)
         deallocate (answer%edge)
      end do
      if (surface%has_free_edges) then
         if (present(needs_gap)) then
            if (needs_gap) call complete_gap(surface, h, answer%state%approach, answer%edge%pressure_or_gap)
         end if
      else
         answer%errors = known_errors(answer%errors, surface%full_contact_peak)
      end if
      ! No pressure is negative: an estimate as large as the peak says nothing of it. With free edges the same is true
      ! of the approach and of the area.
      where ((.not. answer%accurate .and. answer%errors >= max(answer%values, tiny(scale)) .and. &
              [surface%has_free_edges, surface%has_free_edges, .true.]) .or. .not. is_known(answer%values)) &
         answer%errors = unknown
      associate (measures => answer%measures)
         measures%mean_gap_over_amplitude = answer%state%open_gap()
         measures%approach_over_amplitude = answer%state%approach
         measures%contact_area_fraction = answer%values(2)
         measures%peak_pressure_over_pstar = answer%values(3)
         measures%mean_gap_error = answer%errors(1)
         measures%contact_area_error = answer%errors(2)
         measures%peak_pressure_error = answer%errors(3)
         measures%elastic_energy_error = scaled_error(answer%errors(1), 2*mean_pressure)
      end associate
   end subroutine solve_by_sequence

   !> Solves on one grid, that of answer%state%pressure, and starts from that pressure.
   subroutine solve_level(surface, mean_pressure, residual, h, answer, progress)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure, residual
      real(dp), allocatable, intent(out) :: h(:, :)   !! undeformed gap [Delta]
      type(sequence_answer), intent(inout) :: answer
      class(solver_progress), intent(in), optional :: progress

      type(compliance_operator) :: half_space
      integer :: most
      real(dp) :: carried, highest(1), load

      associate (slab => answer%state%slab, pressure => answer%state%pressure)
         allocate (h(slab%points(1), slab%columns()))
         call surface%sample_gap(slab, h)
         load = mean_pressure*product(real(slab%points, dp))
         carried = sum_of_field(slab, pressure)
         if (carried > 0.0_dp) then
            pressure = pressure*(load/carried)
         else
            ! The contact of the coarser grid lies between these points.
            pressure = mean_pressure
         end if
         if (surface%has_hardness()) then
            highest = maxval(pressure)
            call slab%largest(highest)
            if (highest(1) >= surface%hardness) call set_load(slab, pressure, load, surface%hardness)
         end if
         most = most_iterations(surface, slab%points)
      end associate
      answer%transform_pairs = answer%transform_pairs/2**surface%dimension
      if (surface%has_free_edges) then
         call solve_free_level(surface, h, residual, most, answer%state, answer%transform_pairs, progress)
      else
         call half_space%start(surface, answer%state%slab%points)
         call solve_on_grid(half_space, h, residual, most, answer%state, progress)
         answer%transform_pairs = answer%transform_pairs + half_space%transform_pairs
      end if
      if (.not. answer%state%interrupted) answer%measures%elastic_energy = energy_of(answer%state, h)
      answer%grids = answer%grids + 1
      answer%iterations = answer%iterations + answer%state%iterations
   end subroutine solve_level

   !> The mean of p u/2, u = gap - h + approach.
   real(dp) function energy_of(state, undeformed_gap)
      type(grid_state), intent(in) :: state   !! solved, with the gap
      real(dp), intent(in) :: undeformed_gap(:, :)

      integer :: j
      real(dp) :: parts(1, size(undeformed_gap, 2)), total(1)

      do j = 1, size(undeformed_gap, 2)
         parts(1, j) = dot_product(state%pressure(:, j), state%gap(:, j) - undeformed_gap(:, j) + state%approach)
      end do
      total = state%slab%column_totals(parts)
      energy_of = 0.5_dp*total(1)/product(real(state%slab%points, dp))
   end function energy_of

   !> The iterations that a grid may take.
   pure integer function most_iterations(surface, points)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! of the grid

      real(dp) :: step(2)

      step = surface%length/(merge(2, 1, surface%shape%is_even())*points)
      associate (n => surface%dimension)
         most_iterations = nint(iterations_of_root*sqrt(maxval(surface%length(:n))/minval(step(:n))))
      end associate
      most_iterations = max(most_iterations, iteration_limit)
   end function most_iterations

   !> Computes mean gap, contact area (C11), (C12) and peak pressure (C13) on the present grid, and their error
   !> estimates (C14) to (C17). The area is at least P/H, the smallest that carries the load at the hardness; its error
   !> is estimated before this bound is applied, which would hide changes. The error is unknown where (C12) gives no
   !> area although there is contact. The edge takes over the memory of the gap, which no longer exists afterwards.
   subroutine measure_level(surface, mean_pressure, h, estimated, answer)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure
      real(dp), intent(in) :: h(:, :)    !! undeformed gap [Delta], of the columns of answer%state%gap
      logical, intent(in) :: estimated   !! whether the errors are wanted
      type(sequence_answer), intent(inout) :: answer

      real(dp) :: area
      integer :: j
      logical :: has_corners, peak_resolved
      type(grid_edge) :: astray

      answer%values(1) = merge(answer%state%approach, answer%state%open_gap(), &
                                surface%has_free_edges .and. surface%dimension == 2)
      if (.not. allocated(answer%edge)) allocate (answer%edge)
      do j = 1, size(answer%state%gap, 2)
         answer%state%gap(:, j) = joined(answer%state%pressure(:, j), answer%state%gap(:, j))
      end do
      call make_grid_edge(answer%edge, answer%state%gap, surface%shape%is_even(), &
                          pressure_per_gap(surface, answer%state%slab%points), answer%state%slab, &
                          surface%has_free_edges)
      call answer%edge%fetch_neighbours()
      answer%measures%contact_area_counted_fraction = counted_area_fraction(answer%edge)
      area = grid_contact_area(answer%edge)
      ! At a step the pressure next to it does not say where the contact ends: it ends with the block.
      if (surface%has_steps) area = answer%measures%contact_area_counted_fraction
      answer%values(2) = area
      if (surface%dimension == 2) answer%measures%contact_area_corrected_fraction = corrected_area_fraction(answer%edge)
      call grid_peak_pressure(answer%edge, answer%values(3), peak_resolved)
      peak_resolved = peak_resolved .or. answer%values(3) >= surface%hardness
      answer%values(3) = min(answer%values(3), surface%hardness)
      call answer%history%push(answer%values)
      if (estimated) answer%errors = estimate_errors(answer%history, surface, answer%edge, peak_resolved)
      associate (errors => answer%errors, p => answer%edge%pressure_or_gap)
         has_corners = ends_at_corners(surface, p)
         if (surface%has_steps) then
            ! The cells in contact are the area where contact ends with a block, and else to half a step: where only one
            ! of contact and height changes between two points.
            call start_grid_edge(astray, merge(1.0_dp, 0.0_dp, (p > 0.0_dp) .neqv. (2*h < maxval(h))), h, even=.true.)
            errors(2) = max(errors(2), 0.5_dp*edge_crossings(astray)/size(h))
         else if (has_corners .and. surface%dimension == 2) then
            errors(2) = max(errors(2), errors(1)/max(answer%values(1), tiny(area))*area)
         end if
      end associate
      if (.not. area > 0.0_dp) answer%errors(2) = unknown
      if (has_corners .and. answer%values(3) < surface%hardness) answer%values(3) = unknown
      if (surface%has_hardness()) answer%values(2) = max(area, mean_pressure/surface%hardness)
   end subroutine measure_level

   !> Whether contact ends at the border of the map or at a step, where the pressure grows beyond all bounds as at the
   !> edge of a punch.
   pure logical function ends_at_corners(surface, p)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p(:, :)   !! > 0 in contact; with free edges at the points of the map

      associate (m => size(p, 1), n => size(p, 2))
         ends_at_corners = surface%has_free_edges .and. &
            (surface%has_steps .or. any(p([1, m], :) > 0.0_dp) .or. (n > 1 .and. any(p(:, [1, n]) > 0.0_dp)))
      end associate
   end function ends_at_corners

   !> The edge of the area at which p = H. H - p and minus the gap behave there as gap and pressure do at the edge of
   !> contact (C23).
   subroutine find_edge_at_hardness(surface, state, edge)
      type(surface_type), intent(in) :: surface
      type(grid_state), intent(in) :: state   !! solved, with the gap
      type(grid_edge), allocatable, intent(out) :: edge

      allocate (edge)
      call start_grid_edge(edge, surface%hardness - state%pressure, -state%gap, surface%shape%is_even(), &
                           pressure_per_gap(surface, state%slab%points), state%slab, surface%has_free_edges)
      call edge%fetch_neighbours()
   end subroutine find_edge_at_hardness

   !> The area at which p = H, and its error estimate. The area is at most P/H, the area that carries the load at the
   !> hardness; its error is estimated before this bound is applied.
   subroutine measure_at_hardness(surface, mean_pressure, edge, history, answer)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure
      type(grid_edge), intent(in) :: edge             !! from find_edge_at_hardness
      type(change_history), intent(inout) :: history
      type(sequence_answer), intent(inout) :: answer

      real(dp) :: area, errors(3)

      area = 1.0_dp - grid_contact_area(edge)
      answer%measures%area_at_hardness_fraction = min(area, mean_pressure/surface%hardness)
      call history%push([0.0_dp, area, 0.0_dp])
      errors = history%errors()
      ! Between the points the pressure may reach H although it does so at none of them.
      if (answer%values(3) >= surface%hardness) errors = max(errors, unresolved_errors(surface, edge, .true.))
      answer%measures%area_at_hardness_error = errors(2)
   end subroutine measure_at_hardness

end module wavycon_grid_sequence
