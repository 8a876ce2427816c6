!> Derivatives of mean gap and area with respect to the load, for a solution on a grid. They are differences of
!> solutions on the same grid at loads near by: (C29) to (C29c) of README.md in this directory.
module wavycon_grid_derivatives
   use wavycon_contact_tuning, only: area_kept_change, change_safety, kept_scatter, load_difference
   use wavycon_grid_error, only: change_history
   use wavycon_grid_sequence, only: grid_start, sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: area_slope, contact_area, contact_area_counted, gap_curvature, gap_slope, is_known, &
      quantities, unknown
   use wavycon_solution_record, only: solution_record
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: differentiate_on_grid

contains

   !> Solves two loads below and two above that of a solution, and takes differences. The grid before the last shows
   !> whether the four loads are too far from one another (C29e). If they are not, the inner two are solved on the last
   !> grid too; else two nearer loads are, and the inner two take the place of the outer two. Derivatives that the
   !> differences do not show are unknown; all are unknown if one of the loads is not solved.
   subroutine differentiate_on_grid(surface, points, record, history, answer)
      type(surface_type), intent(in) :: surface      !! surface on the cell that was solved
      integer, intent(in) :: points(2)               !! points of the grid on the whole cell; in 1-D the first counts
      type(solution_record), intent(in) :: record    !! solution on this grid, neither without load nor in full contact
      type(change_history), intent(in) :: history    !! main values of this solution on the last three grids
      type(quantities), intent(out) :: answer        !! gap_slope, area_slope and gap_curvature with their errors

      integer :: coarse(2), fine(2)   ! points on the whole cell of the grid before the last one and of the last one
      integer :: i, maps_in_cell(2)
      real(dp) :: bound   ! theta of (C29)
      real(dp) :: kept    ! part of an error on the grid `coarse` that is left on the last grid
      real(dp) :: step    ! eta of (C29a)
      !> y of approach and area on three grids, the finest first, at the five loads. `before` begins with the grid
      !> `coarse`, on which the load in the middle has two grids alone.
      real(dp), dimension(3, 2, -2:2) :: before, y
      real(dp) :: counted(-2:2)   ! number of points in contact over number of points, at the five loads
      real(dp), dimension(3) :: errors, far_values, near_values, unused, values   ! G', A', G''
      logical :: is_unused, solved, too_far, with_changes
      type(grid_start) :: starts(bit_size(points), -1:1)   ! pressures of the inner loads on the grids up to `coarse`

      fine = points
      if (surface%dimension == 1) fine(2) = 1
      coarse = fine
      maps_in_cell = 1
      if (surface%shape%is_even()) maps_in_cell(:surface%dimension) = 2
      with_changes = all(is_known(history%before(:2, :)))
      if (with_changes) coarse = maps_in_cell*((fine/maps_in_cell + 1)/2)
      kept = merge(kept_scatter, 1.0_dp, with_changes)
      bound = 1.0_dp
      if (surface%has_free_edges) bound = 0.0_dp
      ! On a map with gaps between its points P may be 1 and more. At 1 there is no x, beyond it falls with the load.
      if (abs(1.0_dp - bound*record%pbar_over_pstar) <= 0.0_dp) return
      y(:, :, 0) = y_of(history)
      before(:, :, 0) = without_last(y(:, :, 0))
      counted(0) = record%value(contact_area_counted)
      solved = .true.
      do i = -2, 2
         if (abs(i) == 1) call solve_near(i*load_difference, coarse, before(:, :, i), counted(i), starts(:, i))
         if (abs(i) == 2) call solve_near(i*load_difference, coarse, before(:, :, i), counted(i))
      end do
      if (.not. solved) return
      call differentiate(record%pbar_over_pstar, bound, before, load_difference, kept, far_values, unused, too_far)
      step = merge(0.5_dp, 1.0_dp, too_far)*load_difference
      y(:, :, [-2, 2]) = before(:, :, merge([-1, 1], [-2, 2], too_far))
      do i = -1, 1, 2
         call solve_near(i*step, fine, y(:, :, i), counted(i), starts(:, i))
      end do
      if (.not. solved) return
      if (with_changes) call add_changes(y)
      call differentiate(record%pbar_over_pstar, bound, y, step, 1.0_dp, values, errors, is_unused)
      if (too_far) then
         ! Where a derivative grows without bound the two steps give values that differ by more than either's error.
         before(:, :, [-2, 2]) = before(:, :, [-1, 1])
         before(:, :, -1) = without_last(y(:, :, -1))
         before(:, :, 1) = without_last(y(:, :, 1))
         call differentiate(record%pbar_over_pstar, bound, before, step, kept, near_values, unused, is_unused)
         errors = max(errors, abs(near_values - far_values))
      end if
      ! If all solutions on the last grid have the same points in contact the gap is linear in the load, and the
      ! differences show nothing of the growth of the contact: A' and G'' are unknown.
      if (all(abs(counted(-1:1) - counted(0)) <= 0.0_dp)) values(2:) = unknown
      ! A contact of one or two points has a size, and so a stiffness, that depends on the step alone.
      if (record%error(contact_area) >= record%value(contact_area)) errors = unknown
      where (.not. is_known(values)) errors = unknown
      answer%value([gap_slope, area_slope, gap_curvature]) = values
      answer%error([gap_slope, area_slope, gap_curvature]) = errors

   contains

      !> Solves a load near that of the record. On return `solved` tells whether this and all loads so far were solved;
      !> after a load that was not, nothing is done.
      subroutine solve_near(difference, grid, y, counted, starts)
         real(dp), intent(in) :: difference     !! x of the load less that of the record
         integer, intent(in) :: grid(2)         !! points of the last grid on the whole cell
         real(dp), intent(inout) :: y(3, 2)     !! y of approach and area on the last three grids
         real(dp), intent(inout) :: counted     !! number of points in contact over number of points
         type(grid_start), intent(inout), optional :: starts(:)   !! as in solve_by_sequence

         real(dp) :: odds
         type(sequence_answer) :: nearby

         if (.not. solved) return
         odds = exp(difference)*record%pbar_over_pstar/(1.0_dp - bound*record%pbar_over_pstar)
         call solve_by_sequence(surface, odds/(1.0_dp + bound*odds), 0.0_dp, grid, nearby, starts=starts)
         solved = nearby%state%converged .and. allocated(nearby%edge)
         if (.not. solved) return
         y = y_of(nearby%history)
         counted = nearby%value(contact_area_counted)
      end subroutine solve_near

      !> y of approach and area on the last three grids of a load.
      pure function y_of(history) result(y)
         type(change_history), intent(in) :: history
         real(dp) :: y(3, 2)

         real(dp) :: grids(3, 3)

         grids = reshape([history%values, history%before], [3, 3])
         y(:, 2) = log_ratio(grids(2, :), 1.0_dp - bound*grids(2, :))
         y(:, 1) = log_ratio(1.0_dp - grids(1, :), grids(1, :))
         if (surface%has_free_edges) y(:, 1) = log_ratio(grids(1, :), 1.0_dp)
      end function y_of

      !> y on the grids from `coarse` on.
      pure function without_last(y) result(before)
         real(dp), intent(in) :: y(3, 2)   !! on the last three grids
         real(dp) :: before(3, 2)

         before = y
         if (with_changes) before = eoshift(y, 1, boundary=unknown)
      end function without_last

   end subroutine differentiate_on_grid

   !> Moves y of the outer two loads, which are on the three grids from the last but one on, to the grids of the others.
   !> On the last grid they follow from the changes at the inner three loads, (C29d).
   pure subroutine add_changes(y)
      real(dp), intent(inout) :: y(3, 2, -2:2)   !! as in differentiate_on_grid

      integer :: q

      y(2:, :, [-2, 2]) = y(:2, :, [-2, 2])
      y(1, :, [-2, 2]) = unknown
      do q = 1, 2
         if (.not. (all(is_known(y(2, q, :))) .and. all(is_known(y(1, q, -1:1))))) cycle
         associate (change => y(1, q, -1:1) - y(2, q, -1:1))
            y(1, q, -2) = y(2, q, -2) + 3*(change(1) - change(2)) + change(3)
            y(1, q, 2) = y(2, q, 2) + 3*(change(3) - change(2)) + change(1)
         end associate
      end do
   end subroutine add_changes

   !> ln(part/rest). It is unknown unless both are positive and known.
   elemental real(dp) function log_ratio(part, rest)
      real(dp), intent(in) :: part, rest

      log_ratio = unknown
      if (min(part, rest) > 0.0_dp .and. is_known(part)) log_ratio = log(part/rest)
   end function log_ratio

   !> G', A', G'' and their errors from y at equal steps of x: (C29) to (C29c).
   pure subroutine differentiate(p, bound, y, step, kept, values, errors, too_far)
      real(dp), intent(in) :: p                 !! P of the load in the middle
      real(dp), intent(in) :: bound             !! theta of (C29)
      real(dp), intent(in) :: y(3, 2, -2:2)     !! y of approach and area on the last three grids, the finest first
      real(dp), intent(in) :: step              !! step of x, eta of (C29a)
      real(dp), intent(in) :: kept              !! part of the errors due to the grid that counts in `too_far`
      real(dp), intent(out) :: values(3)        !! G', A', G''
      real(dp), intent(out) :: errors(3)        !! their error estimates
      logical, intent(out) :: too_far           !! whether the differences' own error is more than a third of the error

      real(dp) :: error(0:2), first, part, second, terms(0:2), truncated, x1, x2
      integer :: q

      x1 = 1.0_dp/(p*(1.0_dp - bound*p))
      x2 = -(1.0_dp - 2*bound*p)*x1**2
      values = unknown
      errors = unknown
      too_far = .false.
      do q = 1, 2
         if (.not. all(is_known(y(1, q, :)))) cycle
         call differences(y(:, q, :), terms, error, truncated)
         too_far = too_far .or. truncated > 0.5_dp*kept*error(1)
         error(1:) = (error(1:) + truncated*[1.0_dp, 2.0_dp])/step**[1, 2]
         part = 1.0_dp/(bound + exp(-terms(0)))
         associate (y1 => terms(1)/step, y2 => terms(2)/step**2, bend => 1.0_dp - 2*bound*part, &
                    slope => part*(1.0_dp - bound*part))
            first = slope*y1*x1
            second = slope*((bend*y1**2 + y2)*x1**2 + y1*x2)
            ! G is one less the approach.
            values(q) = first
            if (q == 1) values([1, 3]) = [-first, -second]
            if (.not. all(is_known(y(2, q, :)))) cycle
            errors(q) = slope*abs(x1)*error(1) + abs(bend*first)*error(0)
            if (q == 1) errors(3) = slope*(abs(2*bend*y1*x1**2 + x2)*error(1) + x1**2*error(2)) &
                                    + abs(bend*second)*error(0)
         end associate
      end do
   end subroutine differentiate

   !> Value and first two differences of y at five loads (C29a), with both parts of their errors.
   pure subroutine differences(y, terms, error, truncated)
      real(dp), intent(in) :: y(3, -2:2)      !! y on the last three grids, the finest first, at the five loads
      real(dp), intent(out) :: terms(0:2)     !! y, y' step and y'' step^2 on the last grid
      real(dp), intent(out) :: error(0:2)     !! their errors due to the grid (C29b)
      real(dp), intent(out) :: truncated      !! truncation error of y' step (C29c), half of that of y'' step^2

      !> Weights of the five y in the value, in the first two differences, and in Taylor's third and fourth terms.
      real(dp), parameter :: weights(5, 0:4) = reshape([ &
         0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 1/12.0_dp, -8/12.0_dp, 0.0_dp, 8/12.0_dp, -1/12.0_dp, &
         -1/12.0_dp, 16/12.0_dp, -30/12.0_dp, 16/12.0_dp, -1/12.0_dp, &
         -1/12.0_dp, 2/12.0_dp, 0.0_dp, -2/12.0_dp, 1/12.0_dp, &
         1/24.0_dp, -4/24.0_dp, 6/24.0_dp, -4/24.0_dp, 1/24.0_dp], [5, 5])
      !> Root of the sum of squares of each set of weights: its factor on independent random errors of y.
      real(dp), parameter :: of_random(0:4) = sqrt(sum(weights**2, dim=1))
      !> Least ratios of Taylor's fifth term to the fourth and to the third. Where y' grows as the logarithm of the
      !> distance from the middle load the fourth term is zero, and only the third shows the truncation.
      real(dp), parameter :: least_ratio(2) = [0.1_dp, 0.3_dp]
      real(dp) :: change(0:4), scatter, sums(3, 0:4), third, fourth

      sums = matmul(y, weights)
      terms = sums(1, :2)
      change = abs(sums(1, :) - sums(2, :))
      error = change_safety*change(:2)
      scatter = maxval(change(3:)/of_random(3:))
      if (all(is_known(y(3, :)))) then
         error = max(error, change_safety*area_kept_change*abs(sums(2, :2) - sums(3, :2)))
         scatter = max(scatter, kept_scatter*maxval(abs(sums(2, 3:) - sums(3, 3:))/of_random(3:)))
      end if
      error(1:) = max(error(1:), scatter*of_random(1:2))
      third = abs(sums(1, 3))
      fourth = abs(sums(1, 4))
      truncated = 4*max(least_ratio(1)*fourth, least_ratio(2)*third, fourth**2/max(third, fourth, tiny(third)))
   end subroutine differences

end module wavycon_grid_derivatives
