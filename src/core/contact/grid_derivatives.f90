!> How a solution on a grid changes with the load, from solutions of the same grid at loads near by: (C29) to (C29c) of
!> README.md in this directory.
module wavycon_grid_derivatives
   use wavycon_contact_tuning, only: area_kept_change, change_safety, load_difference
   use wavycon_grid_error, only: change_history
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: area_slope, contact_area, contact_area_counted, gap_curvature, gap_slope, is_known, &
      quantities, unknown
   use wavycon_solution_record, only: solution_record
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: differentiate_on_grid

contains

   !> Solves the four loads about that of a solution, and two nearer ones where these are too far from one another, and
   !> takes differences. What they do not show is unknown, all of it if a load is not solved.
   subroutine differentiate_on_grid(surface, points, record, history, answer)
      type(surface_type), intent(in) :: surface      !! whose cell was solved
      integer, intent(in) :: points(2)               !! of the grid on the whole cell; the second is ignored in 1-D
      type(solution_record), intent(in) :: record    !! of the solution on this grid, between no load and full contact
      type(change_history), intent(in) :: history    !! its values on the last three grids
      type(quantities), intent(out) :: answer

      integer :: grid(2), i
      real(dp) :: bound   !! theta of (C29)
      real(dp) :: y(3, 2, -2:2)   !! of approach and area on the last three grids, the last first, at the five loads
      real(dp) :: counted(-2:2)   !! the points in contact over all points
      real(dp), dimension(3) :: errors, moved, near_errors, near_values, values   !! G', A', G''
      logical :: solved, too_far, unused

      grid = points
      if (surface%dimension == 1) grid(2) = 1
      bound = merge(0.0_dp, 1.0_dp, surface%has_free_edges)
      solved = .true.
      do i = -2, 2
         if (solved) call solve_near(i, i*load_difference)
      end do
      if (.not. solved) return
      call differentiate(record%pbar_over_pstar, bound, y, load_difference, values, errors, too_far)
      ! In the same contact solutions are linear in the load, and show nothing of its growth.
      if (all(abs(counted - counted(0)) <= 0.0_dp)) values(2:) = unknown
      if (too_far) then
         y(:, :, [-2, 2]) = y(:, :, [-1, 1])
         call solve_near(-1, -0.5_dp*load_difference)
         if (solved) call solve_near(1, 0.5_dp*load_difference)
         if (.not. solved) return
         call differentiate(record%pbar_over_pstar, bound, y, 0.5_dp*load_difference, near_values, near_errors, unused)
         ! Where a derivative grows without bound the two differ by more than either shows.
         moved = abs(near_values - values)
         where (is_known(values) .and. near_errors < errors) values = near_values
         errors = max(min(errors, near_errors), moved)
      end if
      ! A contact of a point or two has the size, and with it the stiffness, of the step.
      if (record%error(contact_area) >= record%value(contact_area)) errors = unknown
      where (.not. is_known(values)) errors = unknown
      answer%value([gap_slope, area_slope, gap_curvature]) = values
      answer%error([gap_slope, area_slope, gap_curvature]) = errors

   contains

      !> Solves the load whose x differs from that of the record by this much, as number i of the five; 0 is solved.
      subroutine solve_near(i, difference)
         integer, intent(in) :: i
         real(dp), intent(in) :: difference

         real(dp) :: grids(3, 3), odds
         type(sequence_answer) :: nearby

         if (i == 0) then
            nearby%history = history
            nearby%value = record%value
         else
            odds = exp(difference)*record%pbar_over_pstar/(1.0_dp - bound*record%pbar_over_pstar)
            call solve_by_sequence(surface, odds/(1.0_dp + bound*odds), 0.0_dp, grid, nearby)
            solved = nearby%state%converged .and. allocated(nearby%edge)
            if (.not. solved) return
         end if
         counted(i) = nearby%value(contact_area_counted)
         grids = reshape([nearby%history%values, nearby%history%before], [3, 3])
         y(:, 2, i) = log_ratio(grids(2, :), 1.0_dp - bound*grids(2, :))
         y(:, 1, i) = log_ratio(1.0_dp - grids(1, :), grids(1, :))
         if (surface%has_free_edges) y(:, 1, i) = log_ratio(grids(1, :), 1.0_dp)
      end subroutine solve_near

   end subroutine differentiate_on_grid

   !> ln(part/rest), unknown unless both are positive.
   elemental real(dp) function log_ratio(part, rest)
      real(dp), intent(in) :: part, rest

      log_ratio = unknown
      if (min(part, rest) > 0.0_dp .and. is_known(part)) log_ratio = log(part/rest)
   end function log_ratio

   !> G', A', G'' and their errors from y at equal steps of x: (C29) to (C29c).
   pure subroutine differentiate(p, bound, y, step, values, errors, too_far)
      real(dp), intent(in) :: p                 !! P at the middle
      real(dp), intent(in) :: bound             !! theta
      real(dp), intent(in) :: y(3, 2, -2:2)     !! of approach and area on the last three grids, the last first
      real(dp), intent(in) :: step              !! of x
      real(dp), intent(out) :: values(3), errors(3)
      logical, intent(out) :: too_far           !! whether a third of the error or more is that of the differences

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
         too_far = too_far .or. truncated > 0.5_dp*error(1)
         error(1:) = (error(1:) + truncated*[1.0_dp, 2.0_dp])/step**[1, 2]
         part = 1.0_dp/(bound + exp(-terms(0)))
         associate (y1 => terms(1)/step, y2 => terms(2)/step**2, bend => 1.0_dp - 2*bound*part, &
                    slope => part*(1.0_dp - bound*part))
            first = slope*y1*x1
            second = slope*((bend*y1**2 + y2)*x1**2 + y1*x2)
            values(q) = merge(-first, first, q == 1)
            if (q == 1) values(3) = -second
            if (.not. all(is_known(y(2, q, :)))) cycle
            errors(q) = slope*x1*error(1) + abs(bend*first)*error(0)
            if (q == 1) errors(3) = slope*(abs(2*bend*y1*x1**2 + x2)*error(1) + x1**2*error(2)) &
                                    + abs(bend*second)*error(0)
         end associate
      end do
   end subroutine differentiate

   !> Value, y' step and y'' step^2 on the last grid, by (C29a), and what their errors are from.
   pure subroutine differences(y, terms, error, truncated)
      real(dp), intent(in) :: y(3, -2:2)      !! on the last three grids, the last first
      real(dp), intent(out) :: terms(0:2)
      real(dp), intent(out) :: error(0:2)     !! of the grid (C29b)
      real(dp), intent(out) :: truncated      !! of the first difference (C29c), half of that of the second

      !> Of value and first two differences, and Taylor's third and fourth terms.
      real(dp), parameter :: weights(5, 0:4) = reshape([ &
         0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 1/12.0_dp, -8/12.0_dp, 0.0_dp, 8/12.0_dp, -1/12.0_dp, &
         -1/12.0_dp, 16/12.0_dp, -30/12.0_dp, 16/12.0_dp, -1/12.0_dp, &
         -1/12.0_dp, 2/12.0_dp, 0.0_dp, -2/12.0_dp, 1/12.0_dp, &
         1/24.0_dp, -4/24.0_dp, 6/24.0_dp, -4/24.0_dp, 1/24.0_dp], [5, 5])
      !> The roots of the sums of squares of these.
      real(dp), parameter :: of_random(0:4) = sqrt(sum(weights**2, dim=1))
      !> Least ratio of Taylor's fifth term to the fourth, and to the third, which is all that a logarithm in the middle
      !> shows.
      real(dp), parameter :: least_ratio(2) = [0.1_dp, 0.3_dp]
      real(dp) :: change(0:4), scatter, sums(3, 0:4), third, fourth

      sums = matmul(y, weights)
      terms = sums(1, :2)
      change = abs(sums(1, :) - sums(2, :))
      error = change_safety*change(:2)
      if (all(is_known(y(3, :)))) error = max(error, change_safety*area_kept_change*abs(sums(2, :2) - sums(3, :2)))
      scatter = maxval(change(3:)/of_random(3:))
      error(1:) = max(error(1:), scatter*of_random(1:2))
      third = abs(sums(1, 3))
      fourth = abs(sums(1, 4))
      truncated = 4*max(least_ratio(1)*fourth, least_ratio(2)*third, fourth**2/max(third, fourth, tiny(third)))
   end subroutine differences

end module wavycon_grid_derivatives
