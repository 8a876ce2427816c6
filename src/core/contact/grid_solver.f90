!> Solves (C1) or (C21) on one grid: minimises the complementary energy 1/2 (p, S p) + (p, h) over the pressures
!> 0 <= p <= H of given mean. H is the hardness; elastic bodies have none.
!>
!> Each step computes the gap of the present pressure at all points, in double precision, and verifies the conditions
!> of contact there. The step then selects the points in and near the contact, and corrects the pressure at these
!> points in single precision (`pressure_correction`). A step reduces the residual by some four digits.
!>
!> If the grid is distributed over processes, fields have the columns of this process, and the grid's slab provides sums
!> over the grid and neighbouring columns.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_solver
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: add_neighbours
   use wavycon_contact_tuning, only: approach_tolerance, correction_limit, correction_margin, correction_part, &
      edge_tolerance, halo
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_state, only: grid_state
   use wavycon_kinds, only: dp, sp
   use wavycon_pressure_correction, only: correct_pressure
   use wavycon_pressure_load, only: has_points_at
   use wavycon_solver_progress, only: solver_progress
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: rounding, solve_on_grid

   !> Limits of residuals due to rounding [Delta]. A residual below the first is rounding. One below the second is
   !> rounding if a step does not halve the residual: the rounding of gaps depends on the depth of the surface and on
   !> its longest wave.
   real(dp), parameter :: rounding = 32*epsilon(1.0_dp), most_rounding = 1e-12_dp

contains

   !> Solves (C1) on a grid. On return pressure, gap, approach and residual are those of the solution, and
   !> state%converged tells whether the residual is within the tolerance. If `progress` stops the solver,
   !> state%interrupted is true and the gap is not allocated.
   subroutine solve_on_grid(half_space, undeformed_gap, residual, most_iterations, state, progress)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (M, state%slab%columns())
      real(dp), intent(in) :: residual               !! largest residual (C9) that is allowed; 0: the tolerance (C10)
      integer, intent(in) :: most_iterations         !! iterations of all corrections after which the solver gives up
      !> On entry `slab` and `hardness` are set, and `pressure` is the start, 0 <= p <= H. Its mean P, in (0, H), is the
      !> load and does not change.
      type(grid_state), intent(inout) :: state
      class(solver_progress), intent(in), optional :: progress   !! `shall_stop` is called before each iteration

      logical :: touched(size(undeformed_gap, 2))   ! whether a column has points in contact
      real(dp) :: allowed, last_residual, start_part, touching
      real(sp), allocatable :: inside(:, :)
      integer :: j

      last_residual = huge(1.0_dp)
      state%iterations = 0
      do
         do j = 1, size(touched)
            touched(j) = any(state%pressure(:, j) > 0.0_dp)
         end do
         call compute_gap(half_space, undeformed_gap, touched, state)
         allowed = residual*state%size_of_gaps()
         if (residual <= 0.0_dp) then
            allowed = edge_tolerance*gap_at_edge(half_space%even, state)
            if (half_space%is_free) then
               ! With free edges the smaller of (C10) and (C28); the number of points in contact gives A of (C28).
               touching = state%slab%sum_of(merge(1.0_dp, 0.0_dp, state%pressure > 0.0_dp))
               allowed = min(allowed, approach_tolerance*abs(state%approach) &
                                      *sqrt(touching/product(real(state%slab%points, dp))))
            end if
         end if
         allowed = max(allowed, rounding)
         ! A start from a load near by may have an allowed residual at once. It is corrected nevertheless, unless the
         ! residual is as small as a correction would make it: otherwise a search for a load would see its error.
         start_part = 1.0_dp
         if (state%starts_near .and. last_residual >= huge(last_residual)) start_part = correction_margin
         state%converged = state%residual <= start_part*allowed .or. &
                           (state%residual <= most_rounding .and. 2*state%residual > last_residual)
         last_residual = state%residual
         if (state%converged .or. state%iterations >= most_iterations) exit
         call find_region(half_space%even, state, inside)
         call correct_pressure(half_space, inside, max(correction_part, correction_margin*allowed/state%residual), &
                               min(correction_limit, most_iterations - state%iterations), state, progress)
         if (state%interrupted) return
      end do
      state%residual = state%residual/max(state%size_of_gaps(), rounding)
   end subroutine solve_on_grid

   !> Whether a pressure lies between its bounds, 0 < p < H. At such free points the gap must be zero.
   elemental logical function is_free(pressure, hardness)
      real(dp), intent(in) :: pressure, hardness

      is_free = pressure > 0.0_dp .and. pressure < hardness
   end function is_free

   !> The part of a gap that violates (C1) or (C21): at free points all of it, at p = 0 an overlap, at p = H an open
   !> gap.
   elemental real(dp) function violation(gap, pressure, hardness)
      real(dp), intent(in) :: gap, pressure, hardness

      violation = gap
      if (pressure <= 0.0_dp) violation = min(gap, 0.0_dp)
      if (pressure >= hardness) violation = max(gap, 0.0_dp)
   end function violation

   !> Computes the gap h + S p - approach (C1) of the present pressure, the approach, and the residual times G. The
   !> approach is that whose mean gap over the free points is zero (C3). It is computed as the approach before plus a
   !> change: the change is the mean of gaps that are small, and so loses no digits.
   subroutine compute_gap(half_space, undeformed_gap, touched, state)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      real(dp), intent(in) :: undeformed_gap(:, :)             !! h/Delta, shape of the pressure
      logical, intent(in) :: touched(:)   !! whether a column has points in contact, shape (slab%columns())
      !> On entry with pressure and the approach before; on return with gap, approach, mean gap, residual [Delta] and
      !> residual indentation.
      type(grid_state), intent(inout) :: state

      real(dp) :: approach, change, extremes(2), free, free_sums(2, size(touched)), points, sums(4), total
      !> Sums over each column of squared violations, of overlaps and of open points with a hardness, and of gaps with
      !> free edges.
      real(dp) :: column_sums(4, size(touched))
      integer :: i, j, threads
      logical :: has_hardness

      threads = threads_for(size(undeformed_gap))
      points = product(real(state%slab%points, dp))
      has_hardness = state%hardness < huge(state%hardness)
      if (.not. allocated(state%gap)) allocate (state%gap, mold=undeformed_gap)
      approach = state%approach
      associate (gap => state%gap, p => state%pressure, h => undeformed_gap, hardness => state%hardness)
         do j = 1, size(gap, 2)
            if (touched(j)) gap(:, j) = p(:, j)
         end do
         call half_space%displacement(gap, nonzero=touched)
         !$omp parallel do num_threads(threads) private(free, total)
         do j = 1, size(gap, 2)
            total = 0.0_dp
            free = 0.0_dp
            !$omp simd reduction(+:free, total)
            do i = 1, size(gap, 1)
               gap(i, j) = gap(i, j) + (h(i, j) - approach)
               free = free + merge(1.0_dp, 0.0_dp, is_free(p(i, j), hardness))
               total = total + merge(gap(i, j), 0.0_dp, is_free(p(i, j), hardness))
            end do
            free_sums(:, j) = [total, free]
         end do
         sums(:2) = state%slab%column_totals(free_sums)
         if (.not. has_hardness .or. sums(2) > 0.0_dp) then
            change = sums(1)/sums(2)
         else
            extremes = state%slab%largest([-minval(gap, p <= 0.0_dp), maxval(gap, p >= hardness)])
            ! No point is free. The approach may lie anywhere between the largest gap at the hardness and the least gap
            ! at open points, and becomes the middle of both.
            change = extremes(2)
            if (-extremes(1) < huge(change)) change = 0.5_dp*(extremes(2) - extremes(1))
         end if
         if (has_points_at(state%slab, hardness, p)) call reduce_violation(state%slab, gap, p, hardness, change)
         !$omp parallel do num_threads(threads) private(total)
         do j = 1, size(gap, 2)
            total = 0.0_dp
            !$omp simd reduction(+:total)
            do i = 1, size(gap, 1)
               gap(i, j) = gap(i, j) - change
               total = total + violation(gap(i, j), p(i, j), hardness)**2
            end do
            column_sums(:, j) = [total, 0.0_dp, 0.0_dp, 0.0_dp]
            if (has_hardness) column_sums(2:3, j) = [sum(max(-gap(:, j), 0.0_dp), p(:, j) >= hardness), &
                                                     real(count(p(:, j) <= 0.0_dp), dp)]
            if (half_space%is_free) column_sums(4, j) = sum(gap(:, j))
         end do
         sums = state%slab%column_totals(column_sums)
      end associate
      state%residual = sqrt(sums(1)/points)
      state%residual_indentation = sums(2)/points
      state%is_open = sums(3) > 0.0_dp
      state%approach = approach + change
      state%mean_gap = 1.0_dp - state%approach
      if (half_space%is_free) state%mean_gap = sums(4)/points
   end subroutine compute_gap

   !> Changes the approach to that of the least residual, which is the mean gap over the free points and the points that
   !> violate their condition. This is used where points are at the hardness: if only a few points are free, their mean
   !> alone would make many other points violate their condition.
   subroutine reduce_violation(slab, gap, pressure, hardness, change)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: gap(:, :), pressure(:, :), hardness   !! gap [Delta] before the change; p and H [p*]
      real(dp), intent(inout) :: change   !! change of the approach [Delta]; on entry a first estimate

      !> The residual is a piecewise quadratic function of the approach; Newton's method ends in a few steps.
      integer, parameter :: most_steps = 20
      real(dp) :: column_sums(2, size(gap, 2)), next, sums(2)
      integer :: j, step

      do step = 1, most_steps
         do j = 1, size(gap, 2)
            associate (counts => abs(violation(gap(:, j) - change, pressure(:, j), hardness)) > 0.0_dp &
                       .or. is_free(pressure(:, j), hardness))
               column_sums(:, j) = [sum(gap(:, j), counts), real(count(counts), dp)]
            end associate
         end do
         sums = slab%column_totals(column_sums)
         if (sums(2) <= 0.0_dp) exit
         next = sums(1)/sums(2)
         if (abs(next - change) <= epsilon(change)*abs(change)) exit
         change = next
      end do
   end subroutine reduce_violation

   !> g_e A^(1/2) of (C10) [Delta]: the root mean square of the gap at the points next to free ones, times the square
   !> root of the free part of all points. It is zero if all points are free.
   real(dp) function gap_at_edge(even, state) result(gap)
      logical, intent(in) :: even             !! whether the grid continues by mirror images, otherwise periodically
      type(grid_state), intent(in) :: state   !! pressure and gap are used

      real(sp), allocatable :: near(:, :)     !! > 0 at free points and those next to them
      real(dp) :: beside, column_sums(3, size(state%gap, 2)), free, number, squares, sums(3)
      integer :: i, j

      allocate (near(size(state%gap, 1), size(state%gap, 2)))
      do j = 1, size(near, 2)
         near(:, j) = merge(1.0_sp, 0.0_sp, is_free(state%pressure(:, j), state%hardness))
      end do
      call add_neighbours(state%slab, even, near)
      do j = 1, size(near, 2)
         squares = 0.0_dp
         number = 0.0_dp
         free = 0.0_dp
         !$omp simd reduction(+:free, number, squares) private(beside)
         do i = 1, size(near, 1)
            beside = merge(1.0_dp, 0.0_dp, near(i, j) > 0.0_sp)
            free = free + merge(1.0_dp, 0.0_dp, is_free(state%pressure(i, j), state%hardness))
            beside = merge(0.0_dp, beside, is_free(state%pressure(i, j), state%hardness))
            squares = squares + beside*state%gap(i, j)**2
            number = number + beside
         end do
         column_sums(:, j) = [squares, number, free]
      end do
      sums = state%slab%column_totals(column_sums)
      gap = sqrt(sums(1)/max(sums(2), 1.0_dp)*sums(3)/product(real(state%slab%points, dp)))
   end function gap_at_edge

   !> Selects the region of the next correction: the points that may be free after it. These are the free points, points
   !> that violate their condition or whose open gap is below the residual, and all points within `halo` steps of them.
   subroutine find_region(even, state, inside)
      logical, intent(in) :: even             !! whether the grid continues by mirror images, otherwise periodically
      type(grid_state), intent(in) :: state   !! pressure, gap and residual [Delta] are used
      real(sp), allocatable, intent(out) :: inside(:, :)   !! > 0 at these points, shape (M, slab%columns())

      integer :: j, step

      allocate (inside(size(state%gap, 1), size(state%gap, 2)))
      do j = 1, size(inside, 2)
         associate (p => state%pressure(:, j), gap => state%gap(:, j))
            inside(:, j) = merge(1.0_sp, 0.0_sp, (p > 0.0_dp .or. gap < state%residual) .and. &
                                 (p < state%hardness .or. gap > 0.0_dp))
         end associate
      end do
      do step = 1, halo
         call add_neighbours(state%slab, even, inside)
      end do
   end subroutine find_region

end module wavycon_grid_solver
