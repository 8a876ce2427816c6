!> Minimises 1/2 x'Dx - c'x subject to Cx >= b by the dual method of Goldfarb & Idnani (Math. Program. 27 (1983) 1-33),
!> D diagonal and positive.
!>
!> It starts from the minimum without constraints, or on a given set of active constraints. Constraints with negative
!> multipliers are released. Then violated constraints are made active one by one, while no multiplier may change sign:
!> equations (Q11), (Q12) of README.md in this directory; (Q1) to (Q5) are those of src/paper/README.md. Beale's method
!> keeps the slacks >= 0 and lowers the objective; the dual method keeps the multipliers >= 0 and raises it. Each full
!> step raises the objective, and between two full steps the active set shrinks, so the method ends.
!>
!> The factors that are changed from exchange to exchange are used to find the set of active constraints. The solution
!> on that set is computed from D, c, C and b, and its Karush-Kuhn-Tucker conditions are checked. Where the factors have
!> lost digits the set is factorised afresh and the pass continues.
module wavycon_dual_solver
   use wavycon_interior_point, only: likely_active
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: ddot, dgemv, dtrsv
   use wavycon_qp_problem, only: kkt_tolerance, qp_converged, qp_iteration_limit, qp_problem, qp_solution
   use wavycon_working_set, only: dependence, working_set
   implicit none (type, external)
   private

   public :: dual_solver

   !> A solution by factors that were changed from exchange to exchange is kept if its KKT residual is at most this;
   !> otherwise fresh factors give a better one.
   real(dp), parameter :: fresh_residual = 0.01_dp*kkt_tolerance
   !> A solver that needs more exchanges than this times n + m gives up.
   integer, parameter :: most_pivots = 20
   !> A negative slack smaller than this fraction of its terms, or of the largest slack, is rounding.
   real(dp), parameter :: zero_slack = 32*epsilon(1.0_dp)
   !> Constraints whose violation is more than this part of the largest are the candidates for the next ones.
   real(dp), parameter :: candidate_part = 0.3_dp
   !> So many constraints in a row with small violations, n, suggest that the violations are rounding, which makes the
   !> active set cycle.
   real(dp), parameter :: small_slack = sqrt(epsilon(1.0_dp))

   !> Keeps its active constraints, so that a problem that differs in the bounds alone starts from the last solution.
   type :: dual_solver
      type(qp_problem) :: problem
      type(working_set) :: set
   contains
      procedure :: solve, pass_to
   end type dual_solver

contains

   !> Solves (Q1).
   subroutine solve(self, problem, solution)
      class(dual_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution

      integer, allocatable :: list(:)
      real(dp) :: all_multipliers(size(problem%bounds)), multipliers(size(problem%linear)), x(size(problem%linear))

      self%problem = problem
      call self%set%start(problem)
      call likely_active(problem, list, all_multipliers, solution%pivots)
      call self%set%assign_active(problem, list)
      multipliers(:self%set%count) = all_multipliers(self%set%active(:self%set%count))
      call release_negative(problem, self%set, x, multipliers, solution%pivots)
      call finish(self, solution)
   end subroutine solve

   !> Solves the last problem with other bounds, from its active constraints.
   subroutine pass_to(self, bounds, solution)
      class(dual_solver), intent(inout) :: self       !! after a call of `solve`
      real(dp), intent(in) :: bounds(:)               !! b, shape (m)
      type(qp_solution), intent(out) :: solution

      self%problem%bounds = bounds
      call finish(self, solution)
   end subroutine pass_to

   !> The pass from the active constraints of `set`, whatever they are, to the solution, which is checked (Q3). While
   !> the check fails the set is factorised afresh, and the pass continues, as long as that changes anything.
   subroutine finish(self, solution)
      class(dual_solver), intent(inout) :: self
      type(qp_solution), intent(inout) :: solution   !! `pivots` counts on, all else is set

      integer :: limit, pivots_before
      logical :: was_fresh

      limit = most_pivots*(size(self%problem%linear) + size(self%problem%bounds))
      was_fresh = .false.
      do
         pivots_before = solution%pivots
         call restore_optimum(self%problem, self%set, limit, solution%pivots)
         call self%set%check(self%problem, solution)
         if (solution%kkt_residual <= fresh_residual) return
         call self%set%refresh(self%problem)
         call self%set%check(self%problem, solution)
         if (solution%status == qp_converged) return
         if (solution%pivots >= limit) solution%status = qp_iteration_limit
         if (solution%pivots >= limit .or. was_fresh .and. solution%pivots == pivots_before) return
         was_fresh = .true.
      end do
   end subroutine finish

   !> Changes the active constraints to those of the programme's minimum, but for rounding.
   subroutine restore_optimum(problem, set, pivot_limit, pivots)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set       !! any set of active constraints; on return that of the minimum
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots              !! constraints made active and released, counted up

      real(dp) :: x(size(problem%linear)), multipliers(size(problem%linear)), slacks(size(problem%bounds))
      real(dp) :: slack, slack_terms, kept_slack
      real(dp), allocatable :: normals(:, :)       ! those of the candidates
      integer, allocatable :: candidates(:)
      integer :: listed, i, n, place, violated, small_steps
      logical :: is_active

      n = size(x)
      allocate (normals(n, 0))
      small_steps = 0
      listed = 0
      kept_slack = 0.0_dp
      multipliers = 0.0_dp
      call release_negative(problem, set, x, multipliers, pivots)
      do while (pivots < pivot_limit)
         ! The most violated constraint of the candidates, or of all if none of these is violated by much.
         slack = 0.0_dp
         place = 0
         if (listed > 0) then
            slacks(:listed) = -problem%bounds(candidates(:listed))
            call dgemv('T', n, listed, 1.0_dp, normals, n, x, 1, 1.0_dp, slacks, 1)
            place = minloc(slacks(:listed), dim=1)
            slack = slacks(place)
         end if
         if (slack < kept_slack) then
            violated = candidates(place)
            candidates(place) = candidates(listed)
            normals(:, place) = normals(:, listed)
            listed = listed - 1
         else
            call problem%slacks(x, slacks)
            slacks(set%active(:set%count)) = 0.0_dp
            violated = minloc(slacks, dim=1)
            if (violated == 0) return
            slack = slacks(violated)
            kept_slack = candidate_part*slack
            slacks(violated) = 0.0_dp
            candidates = pack([(i, i=1, size(slacks))], slacks <= kept_slack)
            listed = size(candidates)
            normals = problem%normals(:, candidates)
         end if
         slack_terms = abs(problem%bounds(violated)) + maxval(abs(x))*maxval(abs(problem%normals(:, violated)))
         if (slack >= -zero_slack*slack_terms) return
         small_steps = merge(small_steps + 1, 0, -slack < small_slack*slack_terms)
         if (small_steps > n) return
         call make_active(problem, set, violated, slack, x, multipliers, pivots, is_active)
         if (.not. is_active) return
      end do
   end subroutine restore_optimum

   !> Goes from the multipliers given towards those of the minimum on the set, and releases the constraints whose
   !> multipliers vanish first, until none is negative at the minimum: (Q13). From multipliers of 0 all negative ones
   !> are released at once.
   subroutine release_negative(problem, set, x, multipliers, pivots)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set
      real(dp), intent(out), contiguous :: x(:)              !! shape (n)
      real(dp), intent(inout), contiguous :: multipliers(:)  !! >= 0 in the order of the set, shape (n)
      integer, intent(inout) :: pivots

      real(dp) :: minimum(size(x)), vanishing(size(x))   ! vanishing: part of the way at which a multiplier is 0
      integer :: i, k

      do
         k = set%count
         call set%solve(problem, x, minimum(:k))
         vanishing(:k) = 1.0_dp
         where (minimum(:k) < 0.0_dp) vanishing(:k) = multipliers(:k)/(multipliers(:k) - minimum(:k))
         associate (step => minval(vanishing(:k)))
            if (.not. step < 1.0_dp) exit
            multipliers(:k) = multipliers(:k) + step*(minimum(:k) - multipliers(:k))
            do i = k, 1, -1
               if (vanishing(i) > step) cycle
               call set%remove(i)
               multipliers(i:set%count) = multipliers(i + 1:set%count + 1)
            end do
         end associate
         pivots = pivots + k - set%count
      end do
      multipliers(:k) = minimum(:k)
   end subroutine release_negative

   !> Raises the multiplier of a violated constraint until its slack is zero (Q11). Active constraints whose multipliers
   !> vanish before are released (Q12).
   subroutine make_active(problem, set, constraint, first_slack, x, multipliers, pivots, is_active)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set
      integer, intent(in) :: constraint
      real(dp), intent(in) :: first_slack                !! its slack at x, < 0
      real(dp), intent(inout), contiguous :: x(:), multipliers(:)   !! shape (n)
      integer, intent(inout) :: pivots
      logical, intent(out) :: is_active   !! false: the active ones exclude it, or rounding makes it seem so

      real(dp) :: components(size(x)), rest(size(x)), rates(size(x))
      real(dp) :: multiplier, slack, full_step, step, stiffness, zero, zero_rate
      integer :: released, i, k, n

      ! With the multiplier mu the point moves along U^-1 of the rest of the normal, and the multipliers of the active
      ! constraints fall by mu R^-1 of its components.
      n = size(x)
      multiplier = 0.0_dp
      slack = first_slack
      rest = set%inverse*problem%normals(:, constraint)
      zero = dependence*norm2(rest)
      call set%split(rest, components(:set%count))
      do
         k = set%count
         rates(:k) = components(:k)
         call dtrsv('U', 'N', 'N', k, set%triangle, n, rates, 1)
         stiffness = ddot(n, rest, 1, rest, 1)
         full_step = huge(full_step)
         if (k < n .and. sqrt(stiffness) > zero) full_step = -slack/stiffness

         step = full_step
         released = 0
         zero_rate = dependence*maxval(abs(rates(:k)))
         do i = 1, k
            if (rates(i) <= zero_rate) cycle
            if (multipliers(i)/rates(i) < step) then
               step = multipliers(i)/rates(i)
               released = i
            end if
         end do
         is_active = step < huge(step)
         if (.not. is_active) return

         pivots = pivots + 1
         multiplier = multiplier + step
         multipliers(:k) = max(multipliers(:k) - step*rates(:k), 0.0_dp)
         if (full_step < huge(full_step)) then
            slack = slack + step*stiffness
            x = x + step*(set%inverse*rest)
         end if
         if (released == 0) exit
         call set%remove(released, components(:k), rest)
         multipliers(released:k - 1) = multipliers(released + 1:k)
      end do
      call set%add(constraint, components(:set%count), rest)
      multipliers(set%count) = multiplier
   end subroutine make_active

end module wavycon_dual_solver
