!> From the minimum on a set of active constraints to that of the programme.
!>
!> Constraints with negative multipliers are released. Then violated constraints are made active one by one, while no
!> multiplier may change sign: the dual method of Goldfarb & Idnani (Math. Program. 27 (1983) 1-33), equations (Q11),
!> (Q12) of README.md in this directory. Beale's method keeps the slacks >= 0 and lowers the objective; the dual method
!> keeps the multipliers >= 0 and raises it. Each full step raises the objective, and between two full steps the active
!> set shrinks, so the method ends.
module wavycon_dual_pass
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: ddot, dgemv, dtrsv
   use wavycon_qp_problem, only: qp_problem, qp_converged, qp_inaccurate, qp_infeasible, qp_iteration_limit
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: dual_obstacle, restore_optimum

   !> A negative slack smaller than this fraction of its terms, or of the largest slack, is rounding.
   real(dp), parameter :: zero_slack = 32*epsilon(1.0_dp)
   real(dp), parameter :: candidate_part = 0.3_dp
   !> So many constraints in a row with small violations, n, suggest that the violations are rounding, which makes the
   !> active set cycle.
   real(dp), parameter :: small_slack = sqrt(epsilon(1.0_dp))
   !> A constraint depends on the active ones if the rest of U^-T C_i' is less than this fraction of it, or of
   !> |U^-1||C_i|: such a rest is rounding.
   real(dp), parameter :: zero_rest = 1e-13_dp

   !> A constraint that the active ones seem to exclude.
   type :: dual_obstacle
      integer :: constraint = 0               !! 0: there is none
      integer, allocatable :: active(:)       !! the active constraints, shape (k)
      real(dp), allocatable :: weights(:)     !! of their normals, whose weighted sum is minus its normal, shape (k)
   end type dual_obstacle

contains

   !> Changes the active constraints to those of the programme's minimum, but for rounding.
   subroutine restore_optimum(problem, set, pivot_limit, pivots, status, obstacle)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set       !! any set of active constraints; on return that of the minimum
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots              !! constraints made active and released, counted up
      integer, intent(out) :: status                !! qp_converged, qp_infeasible, qp_iteration_limit or qp_inaccurate
      type(dual_obstacle), intent(out) :: obstacle  !! if the status is qp_infeasible

      real(dp) :: x(size(problem%linear)), multipliers(size(problem%linear)), slacks(size(problem%bounds))
      real(dp) :: slack, slack_terms, kept_slack
      real(dp), allocatable :: normals(:, :)       ! those of the candidates
      integer :: candidates(size(problem%bounds))
      integer :: count, i, n, place, violated, small_steps

      n = size(x)
      allocate (normals(n, 0))
      small_steps = 0
      count = 0
      kept_slack = 0.0_dp
      call release_negative(problem, set, x, multipliers, pivots)
      do
         ! The most violated constraint of the candidates, or of all if none of these is violated by much.
         slack = 0.0_dp
         place = 0
         if (count > 0) then
            slacks(:count) = -problem%bounds(candidates(:count))
            call dgemv('T', n, count, 1.0_dp, normals, n, x, 1, 1.0_dp, slacks, 1)
            place = minloc(slacks(:count), dim=1)
            slack = slacks(place)
         end if
         if (slack < kept_slack) then
            violated = candidates(place)
            candidates(place) = candidates(count)
            normals(:, place) = normals(:, count)
            count = count - 1
         else
            call problem%slacks(x, slacks)
            slacks(set%active(:set%count)) = 0.0_dp
            violated = minloc(slacks, dim=1)
            status = qp_converged
            if (violated == 0) return
            slack = slacks(violated)
            kept_slack = candidate_part*slack
            count = 0
            do i = 1, size(slacks)
               if (slacks(i) > kept_slack .or. i == violated) cycle
               count = count + 1
               candidates(count) = i
            end do
            normals = problem%normals(:, candidates(:count))
         end if
         status = qp_converged
         slack_terms = abs(problem%bounds(violated)) + maxval(abs(x))*maxval(abs(problem%normals(:, violated)))
         if (slack >= -zero_slack*slack_terms) return
         small_steps = merge(small_steps + 1, 0, -slack < small_slack*slack_terms)
         status = qp_inaccurate
         if (small_steps > size(x) .and. .not. set%extended_residuals) return
         call make_active(problem, set, violated, slack, x, multipliers, pivot_limit, pivots, status, obstacle)
         if (status /= qp_converged) return
         if (.not. set%extended_residuals) cycle
         call set%solve(problem, x, multipliers(:set%count))
         multipliers(:set%count) = max(multipliers(:set%count), 0.0_dp)
      end do
   end subroutine restore_optimum

   !> Computes the minimum on the set, and releases the constraints with negative multipliers until there are none.
   subroutine release_negative(problem, set, x, multipliers, pivots)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set
      real(dp), intent(out), contiguous :: x(:), multipliers(:)   !! shape (n)
      integer, intent(inout) :: pivots

      integer :: i, count_before

      do
         call set%solve(problem, x, multipliers(:set%count))
         count_before = set%count
         do i = count_before, 1, -1
            if (multipliers(i) < 0.0_dp) call set%remove(i)
         end do
         pivots = pivots + count_before - set%count
         if (set%count == count_before) return
      end do
   end subroutine release_negative

   !> Raises the multiplier of a violated constraint until its slack is zero (Q12). Active constraints whose multipliers
   !> vanish before are released.
   subroutine make_active(problem, set, constraint, first_slack, x, multipliers, pivot_limit, pivots, status, obstacle)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set
      integer, intent(in) :: constraint
      real(dp), intent(in) :: first_slack                !! its slack at x, < 0
      real(dp), intent(inout), contiguous :: x(:), multipliers(:)   !! shape (n)
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots
      integer, intent(out) :: status
      type(dual_obstacle), intent(inout) :: obstacle

      real(dp) :: components(size(x)), rest(size(x)), move(size(x)), rates(size(x))
      real(dp) :: multiplier, slack, full_step, step, stiffness, zero, zero_rate
      integer :: released, i, k, n

      ! With the multiplier mu the point moves along U^-1 of the rest of the normal, and the multipliers of the active
      ! constraints fall by mu R^-1 of its components.
      n = size(x)
      multiplier = 0.0_dp
      slack = first_slack
      rest = set%scaled(problem%normals(:, constraint))
      zero = zero_rest*sqrt(max(sum(rest**2), set%inverse_size**2*sum(problem%normals(:, constraint)**2)))
      call set%split(rest, components(:set%count))
      do
         status = qp_iteration_limit
         if (pivots >= pivot_limit) return

         k = set%count
         rates(:k) = components(:k)
         call dtrsv('U', 'N', 'N', k, set%triangle, n, rates, 1)
         stiffness = ddot(n, rest, 1, rest, 1)
         full_step = huge(full_step)
         if (k < n .and. sqrt(stiffness) > zero) full_step = -slack/stiffness

         step = full_step
         released = 0
         zero_rate = zero_rest*maxval(abs(rates(:k)))
         do i = 1, k
            if (rates(i) <= zero_rate) cycle
            if (multipliers(i)/rates(i) < step) then
               step = multipliers(i)/rates(i)
               released = i
            end if
         end do
         status = qp_infeasible
         if (step >= huge(step)) then
            obstacle%constraint = constraint
            obstacle%active = set%active(:k)
            obstacle%weights = max(-rates(:k), 0.0_dp)
            return
         end if

         pivots = pivots + 1
         multiplier = multiplier + step
         multipliers(:k) = max(multipliers(:k) - step*rates(:k), 0.0_dp)
         if (full_step < huge(full_step)) then
            slack = slack + step*stiffness
            move = step*rest
            call set%unscale(move)
            x = x + move
         end if
         status = qp_converged
         if (released == 0) exit
         call set%remove(released, components(:k), rest)
         multipliers(released:k - 1) = multipliers(released + 1:k)
      end do
      call set%add(constraint, components(:set%count), rest)
      multipliers(set%count) = multiplier
   end subroutine make_active

end module wavycon_dual_pass
