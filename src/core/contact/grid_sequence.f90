!> Solves one load on a sequence of grids, each with half the step of the one before, until the error estimates are
!> within an accuracy or the last grid of the plan is solved.
!>
!> The solution on one grid is the start on the next one, and the error estimates follow from the changes from grid to
!> grid. Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_sequence
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: change_safety, iteration_limit, iterations_of_root, largest_change, most_open
   use wavycon_grid_area, only: abrupt_edges, corrected_area_fraction, counted_area_fraction, edge_crossings, &
      grid_contact_area, lone_approach
   use wavycon_free_level, only: complete_gap, solve_free_level
   use wavycon_grid_edge, only: grid_edge, join, make_grid_edge, pressure_per_gap, start_grid_edge
   use wavycon_grid_error, only: change_history, estimate_errors, implied_errors, unresolved_errors
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_grid_plan, only: fits_memory, grid_plan, plan_grids
   use wavycon_grid_refinement, only: refine_pressure
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_solver, only: solve_on_grid
   use wavycon_grid_state, only: grid_state
   use wavycon_hidden_gap, only: hidden_gap_errors
   use wavycon_kinds, only: dp
   use wavycon_measure_tuning, only: resolved_points
   use wavycon_pressure_load, only: has_points_at, set_load
   use wavycon_quantities, only: approach, area_at_hardness, contact_area, contact_area_corrected, &
      contact_area_counted, elastic_energy, is_known, known_errors, main_quantities, mean_gap, &
      peak_pressure, quantities, scaled, unknown
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_start, sequence_answer, solve_by_sequence

   !> The pressure on one grid at another load of a search, from which a load near by may start.
   type :: grid_start
      real(dp) :: mean_pressure = 0.0_dp         !! load P of this pressure; 0: there is none
      real(dp), allocatable :: pressure(:, :)    !! p/p*, as in grid_state
   end type grid_start

   type, extends(quantities) :: sequence_answer
      type(grid_state) :: state            !! solution on the finest grid that was solved, without the gap
      !> Pressures and gaps on this grid. Not allocated if the first grid did not fit into memory, or if `progress`
      !> stopped the solver.
      type(grid_edge), allocatable :: edge
      !> Main values on the last three grids. With a hardness the area is that before its bound P/H is applied.
      type(change_history) :: history
      !> Mean residual indentation over the largest that the surface can have, and the area at the hardness, on the last
      !> three grids; (3) is not used.
      type(change_history), private :: at_hardness
      logical :: accurate = .false.        !! whether all error estimates are within the accuracy
      logical :: out_of_memory = .false.   !! whether a grid was needed that does not fit into memory
      integer :: iterations = 0            !! number of iterations on all grids
      real(dp) :: transform_pairs = 0.0_dp !! transforms there and back, in units of one pair on the finest grid
   end type sequence_answer

contains

   !> Solves one load, to an accuracy or up to a given grid. For each grid of the plan the loop solves (`solve_level`),
   !> measures (`measure_level`), and either ends or interpolates the start of the next grid (`refine_pressure`). The
   !> sequence ends early if the next grid does not fit into memory (`out_of_memory`), if the iteration on a grid does
   !> not converge (`state%converged` is false), or if `progress` stops the solver (`state%interrupted`; there is no
   !> edge then).
   subroutine solve_by_sequence(surface, mean_pressure, accuracy, points, answer, progress, residual, needs_gap, &
                                starts)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure           !! P in (0, 1), or in (0, H) if the surface has a hardness
      !> Largest error estimate that is allowed, >= 0: of mean gap [Delta], area fraction and peak pressure [p*]; with
      !> free edges relative to the values.
      real(dp), intent(in) :: accuracy
      integer, intent(in) :: points(2)                !! points of the last grid on the whole cell; or zeros
      type(sequence_answer), intent(out) :: answer
      !> `grid_solved` is called after each grid, `shall_stop` before each iteration.
      class(solver_progress), intent(in), optional :: progress
      !> Residual (C9) of the last grid if `points` are given; absent or 0: the tolerance (C10).
      real(dp), intent(in), optional :: residual
      !> Whether answer%edge of a surface with free edges needs the gap at points far from the contact too.
      logical, intent(in), optional :: needs_gap
      !> Pressures of the last load of a search on each grid of the plan, from the coarsest. On return they are those of
      !> this load, moved from answer%state, whose pressure is then not allocated.
      type(grid_start), intent(inout), optional :: starts(:)

      real(dp), allocatable :: h(:, :)   ! undeformed gap [Delta]
      type(grid_plan) :: plan
      real(dp) :: errors(3), level_residual, unit(3), values(3)   ! unit: units of the errors
      logical :: ends
      integer :: i

      plan = plan_grids(surface, points)
      answer%out_of_memory = .not. fits_memory(plan%grids(:, 1))
      if (answer%out_of_memory) return
      call answer%state%slab%start(plan%grids(:, 1))
      allocate (answer%state%pressure(plan%grids(1, 1), answer%state%slab%columns()), source=mean_pressure)
      answer%state%hardness = surface%hardness
      do i = 1, size(plan%grids, 2)
         ends = i == size(plan%grids, 2)
         if (present(starts)) then
            ! If the loads differ by more, the solution on the coarser grid is the better start.
            answer%state%starts_near = abs(mean_pressure - starts(i)%mean_pressure) <= largest_change*mean_pressure
            if (answer%state%starts_near) call move_alloc(starts(i)%pressure, answer%state%pressure)
         end if
         level_residual = 0.0_dp
         if (present(residual) .and. all(points > 0) .and. ends) level_residual = residual
         call solve_level(surface, mean_pressure, level_residual, h, answer, progress)
         if (answer%state%interrupted) return
         ! A solution that has not converged is no start for a finer grid.
         ends = ends .or. .not. answer%state%converged
         if (.not. ends) answer%out_of_memory = .not. fits_memory(plan%grids(:, i + 1))
         ends = ends .or. answer%out_of_memory
         ! Errors are estimated only where this grid may be the last one.
         call measure_level(surface, mean_pressure, h, ends .or. i >= plan%trusted, answer)
         if (present(starts)) then
            starts(i)%mean_pressure = mean_pressure
            call move_alloc(answer%state%pressure, starts(i)%pressure)
         end if
         values = answer%main_values(surface)
         errors = answer%error(main_quantities)
         unit = 1.0_dp
         if (surface%has_free_edges) unit = values
         answer%accurate = answer%state%converged .and. i >= plan%trusted .and. &
            all(errors <= accuracy*unit .or. .not. is_known(values)) .and. &
            answer%error(area_at_hardness) <= accuracy*unit(2) .and. &
            errors(1) + answer%error(approach) <= accuracy*max(unit(1), answer%value(approach))
         if (present(progress)) &
            call progress%grid_solved(plan%grids(:, i)*merge(2, 1, surface%shape%is_even() .and. plan%grids(:, i) > 1) &
                                      /surface%maps_in_cell(), answer%state%iterations, answer%state%residual)
         answer%out_of_memory = answer%out_of_memory .and. .not. answer%accurate
         if (answer%accurate .or. ends) exit
         call answer%state%slab%start(plan%grids(:, i + 1))
         call refine_pressure(answer%edge, answer%state%slab, answer%state%pressure)
         deallocate (answer%edge)
      end do
      if (surface%has_free_edges) then
         if (present(needs_gap)) then
            if (needs_gap) call complete_gap(surface, h, answer%state%approach, answer%edge%pressure_or_gap)
         end if
      else
         errors = known_errors(errors, surface%full_contact_peak)
      end if
      if (plan%lacks_waves) then
         errors = unknown
         answer%error(area_at_hardness) = unknown
      end if
      ! No pressure is negative: an error estimate as large as the peak pressure says nothing. With free edges the same
      ! is true of approach and area. Such errors are unknown.
      where ((.not. answer%accurate .and. errors >= max(values, tiny(unit)) .and. &
              [surface%has_free_edges, surface%has_free_edges, .true.]) .or. .not. is_known(values)) &
         errors = unknown
      answer%error(main_quantities) = errors
      ! (C22a): so far this is the error of the residual indentation.
      answer%error(approach) = answer%error(approach) + errors(1)
      if (.not. all(is_known([errors(1), answer%error(approach)]))) answer%error(approach) = unknown
      answer%error(elastic_energy) = scaled(answer%error(approach), 2*mean_pressure)
   end subroutine solve_by_sequence

   !> Solves (C1) on one grid, from the pressure answer%state%pressure. The pressure is first multiplied by a factor
   !> that gives it the right mean.
   subroutine solve_level(surface, mean_pressure, residual, h, answer, progress)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure           !! P
      real(dp), intent(in) :: residual                !! largest residual, as in solve_on_grid
      real(dp), allocatable, intent(out) :: h(:, :)   !! undeformed gap [Delta], shape (M, slab%columns())
      type(sequence_answer), intent(inout) :: answer
      class(solver_progress), intent(in), optional :: progress

      type(compliance_operator) :: half_space
      integer :: most                                 ! largest number of iterations
      real(dp) :: carried, load                       ! sums of the pressures of the start and of the solution
      real(dp) :: cell(surface%dimension), ratio      ! sides of the cell; the longest of them over the shortest step

      associate (slab => answer%state%slab, pressure => answer%state%pressure)
         allocate (h(slab%points(1), slab%columns()))
         call surface%sample_gap(slab, h)
         load = mean_pressure*product(real(slab%points, dp))
         carried = slab%sum_of(pressure)
         if (carried > 0.0_dp) then
            pressure = pressure*(load/carried)
         else
            ! No point of this grid lies in the contact of the coarser grid.
            pressure = mean_pressure
         end if
         if (has_points_at(slab, surface%hardness, pressure)) call set_load(slab, pressure, load, surface%hardness)
         cell = surface%length(:surface%dimension)
         ratio = maxval(cell)/minval(cell/slab%points(:surface%dimension))
         if (surface%shape%is_even()) ratio = 2*ratio
         most = max(iteration_limit, nint(iterations_of_root*sqrt(ratio)))
      end associate
      answer%transform_pairs = answer%transform_pairs/2**surface%dimension
      if (surface%has_free_edges) then
         call solve_free_level(surface, h, residual, most, answer%state, answer%transform_pairs, progress)
      else
         call half_space%start(surface, answer%state%slab%points)
         call solve_on_grid(half_space, h, residual, most, answer%state, progress)
         answer%transform_pairs = answer%transform_pairs + half_space%transform_pairs
      end if
      if (.not. answer%state%interrupted) answer%value(elastic_energy) = energy_of(answer%state, h)
      answer%iterations = answer%iterations + answer%state%iterations
   end subroutine solve_level

   !> The elastic energy per area [p* Delta], the mean of p u/2 with u = gap - h + approach. It is summed column by
   !> column, as another field of the largest grids would take gigabytes.
   real(dp) function energy_of(state, undeformed_gap)
      type(grid_state), intent(in) :: state          !! solution with its gap
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h [Delta], shape of the gap

      integer :: j
      real(dp) :: column_sums(1, size(undeformed_gap, 2))

      do j = 1, size(undeformed_gap, 2)
         column_sums(1, j) = dot_product(state%pressure(:, j), &
                                         state%gap(:, j) - undeformed_gap(:, j) + state%approach)
      end do
      energy_of = 0.5_dp*sum(state%slab%column_totals(column_sums))/product(real(state%slab%points, dp))
   end function energy_of

   !> Computes mean gap, contact area (C11), (C12) and peak pressure (C13) on the present grid, and their error
   !> estimates (C14) to (C17b), (C22b), (C22c). With a hardness the area is P/H at least, the smallest that carries
   !> the load; its error is estimated before this bound is applied, because the bound would hide changes. The area's
   !> error is unknown where (C12) gives no area although there is contact. The area at which p = H is measured in the
   !> same way. On return answer%state%gap is not allocated: answer%edge has taken over its memory.
   subroutine measure_level(surface, mean_pressure, h, estimated, answer)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure   !! P
      real(dp), intent(in) :: h(:, :)         !! undeformed gap [Delta], shape of answer%state%gap
      logical, intent(in) :: estimated        !! whether errors are estimated; otherwise they are unknown
      type(sequence_answer), intent(inout) :: answer

      real(dp) :: area, bend, capped_errors(3), errors(3), shown(3)   ! shown: by `abrupt_edges`
      real(dp) :: deepest   ! mean indentation if all points are pressed down to the lowest one [Delta]
      real(dp) :: below_hardness   ! largest pressure of the grid over the hardness, at most 1
      logical :: has_corners, resolved
      type(grid_edge) :: capped   ! H - p, or the overlap where p = H: its edge is that of the area at the hardness
      type(grid_edge) :: uncertain   ! 1 at points whose contact does not follow from their height, elsewhere -h

      answer%value(mean_gap) = answer%state%open_gap()
      answer%value(approach) = answer%state%approach
      if (.not. allocated(answer%edge)) allocate (answer%edge)
      ! H - p and minus the gap behave at the edge of the area at which p = H as gap and pressure do at the edge of
      ! contact (C23).
      if (surface%has_hardness()) call start_grid_edge( &
         capped, surface%hardness - answer%state%pressure, -answer%state%gap, surface%shape%is_even(), &
         pressure_per_gap(surface, answer%state%slab%points), answer%state%slab, surface%has_free_edges)
      call join(answer%state%pressure, answer%state%gap)
      call make_grid_edge(answer%edge, answer%state%gap, surface%shape%is_even(), &
                          pressure_per_gap(surface, answer%state%slab%points), answer%state%slab, &
                          surface%has_free_edges)
      call answer%edge%fetch_neighbours()
      answer%value(contact_area_counted) = counted_area_fraction(answer%edge)
      area = grid_contact_area(answer%edge)
      ! At a step of the heights contact ends with the block. The pressure beside the step does not show this place.
      if (surface%has_steps) area = answer%value(contact_area_counted)
      answer%value(contact_area) = area
      if (surface%dimension == 2 .and. estimated) &
         answer%value(contact_area_corrected) = corrected_area_fraction(answer%edge)
      resolved = resolves_waves(surface, answer%state%slab)
      if (resolved) then
         call grid_peak_pressure(answer%edge, answer%value(peak_pressure), bend)
      else
         call grid_peak_pressure(answer%edge, answer%value(peak_pressure), bend, surface)
      end if
      below_hardness = min(answer%value(peak_pressure)/surface%hardness, 1.0_dp)
      has_corners = ends_at_corners(surface, answer%edge%pressure_or_gap)
      ! The pressure at a corner is infinite, and with a hardness it is the hardness.
      if (has_corners .and. surface%has_hardness()) answer%value(peak_pressure) = surface%hardness
      if (answer%value(peak_pressure) >= surface%hardness) bend = 0.0_dp
      answer%value(peak_pressure) = min(answer%value(peak_pressure), surface%hardness)
      call answer%history%push(answer%main_values(surface))
      errors = unknown
      if (estimated) then
         errors = estimate_errors(answer%history, surface, mean_pressure, answer%edge, bend)
         if (surface%is_height_map() .and. 1.0_dp - area < most_open(surface%dimension) .and. .not. resolved) &
            errors = max(errors, hidden_gap_errors(surface, answer%state%slab%points, mean_pressure, 1.0_dp - area))
      end if
      associate (p => answer%edge%pressure_or_gap)
         if (surface%has_steps) then
            ! Where contact ends with a block the points in contact give the area exactly. Where contact or height alone
            ! changes between two neighbours, the edge is uncertain by half a step.
            call start_grid_edge(uncertain, merge(1.0_dp, 0.0_dp, (p > 0.0_dp) .neqv. (2*h < maxval(h))), h, &
                                 even=.true.)
            errors(2) = max(errors(2), 0.5_dp*edge_crossings(uncertain)/size(h))
         else if (has_corners .and. surface%dimension == 2) then
            errors(2) = max(errors(2), errors(1)/max(answer%history%values(1), tiny(area))*area)
         end if
      end associate
      if (.not. area > 0.0_dp) errors(2) = unknown
      answer%error(main_quantities) = errors
      if (has_corners .and. .not. surface%has_hardness()) answer%value(peak_pressure) = unknown
      if (.not. surface%has_hardness()) return
      answer%value(contact_area) = max(area, mean_pressure/surface%hardness)
      call capped%fetch_neighbours()
      area = 1.0_dp - grid_contact_area(capped)
      answer%value(area_at_hardness) = min(area, mean_pressure/surface%hardness)
      deepest = maxval(answer%state%slab%largest([maxval(h)])) - 1.0_dp
      call answer%at_hardness%push([answer%state%residual_indentation/deepest, area, 0.0_dp])
      capped_errors = answer%at_hardness%errors()
      ! Between the points the pressure may reach H although no point does.
      if (answer%value(peak_pressure) >= surface%hardness) &
         capped_errors = max(capped_errors, unresolved_errors(surface, capped, bend=0.0_dp))
      if (has_corners) &
         capped_errors(2) = max(capped_errors(2), hidden_strip(below_hardness, answer%edge))
      if (surface%dimension == 1 .and. estimated) then
         shown = abrupt_edges(answer%edge, capped)
         ! The bound P/H may have corrected the areas.
         shown(:2) = abs(shown(:2) + [answer%history%values(2) - answer%value(contact_area), &
                                      answer%value(area_at_hardness) - area])
         answer%error(contact_area) = max(answer%error(contact_area), change_safety*shown(1))
         answer%error(mean_gap) = max(answer%error(mean_gap), change_safety*shown(3)*(1 - answer%value(contact_area)))
         shown(3) = max(shown(3), lone_approach(capped, surface%waves_on_step(capped%slab%points)))
         shown(3) = answer%value(area_at_hardness)/deepest*shown(3)
         capped_errors(:2) = max(capped_errors(:2), change_safety*shown([3, 2]))
      end if
      answer%error(area_at_hardness) = capped_errors(2)
      ! With free edges the errors are those of the approach.
      if (surface%has_free_edges) return
      capped_errors = max(capped_errors, implied_errors(surface%dimension, [ &
         answer%state%residual_indentation/deepest, 1.0_dp - area, 0.0_dp], capped_errors(2), 0.0_dp))
      answer%error(approach) = scaled(capped_errors(1), deepest)
   end subroutine measure_level

   !> Whether the peak pressure needs no interpolation by the pressure of full contact, (C13a). With free edges the
   !> pressure is uniform on cells of the grid, and is never interpolated so.
   pure logical function resolves_waves(surface, slab)
      type(surface_type), intent(in) :: surface
      type(grid_slab), intent(in) :: slab   !! the grid, on a quarter of the cell of an even surface

      integer :: waves(2)

      waves = surface%points/2
      if (.not. surface%is_height_map()) waves = surface%shape%last([1, 2])
      if (surface%shape%is_even()) waves = (waves + 1)/2
      if (surface%dimension == 1) waves(2) = 0
      resolves_waves = surface%has_free_edges .or. all(slab%points >= resolved_points*waves)
   end function resolves_waves

   !> Whether contact ends at the border of a map with free edges or at a step of its heights. The pressure is infinite
   !> there, as at the edge of a punch.
   pure logical function ends_at_corners(surface, p)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p(:, :)   !! > 0 at points in contact; used for surfaces with free edges only

      associate (m => size(p, 1), n => size(p, 2))
         ends_at_corners = surface%has_free_edges .and. &
            (surface%has_steps .or. any(p([1, m], :) > 0.0_dp) .or. (n > 1 .and. any(p(:, [1, n]) > 0.0_dp)))
      end associate
   end function ends_at_corners

   !> The area fraction at the hardness that a grid may miss at corners, (C23a).
   real(dp) function hidden_strip(below_hardness, edge)
      real(dp), intent(in) :: below_hardness   !! largest pressure of the grid over the hardness
      type(grid_edge), intent(in) :: edge      !! after `fetch_neighbours`

      real(dp) :: steps   ! length of the edge of contact in steps

      associate (p => edge%pressure_or_gap, m => size(edge%pressure_or_gap, 1), n => size(edge%pressure_or_gap, 2))
         steps = edge_crossings(edge) + count(p([1, m], :) > 0.0_dp)
         if (n > 1) steps = steps + count(p(:, [1, n]) > 0.0_dp)
         hidden_strip = 0.5_dp*below_hardness**2*steps/size(p)
      end associate
   end function hidden_strip

end module wavycon_grid_sequence
