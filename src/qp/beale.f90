!> Minimises 1/2 x'Dx - c'x subject to Cx >= b by Beale's method, D positive definite, b <= 0.
!>
!> E. M. L. Beale, J. R. Statist. Soc. B 17 (1955) 173-184; Naval Res. Logist. Quart. 6 (1959) 227-243. Numbers (Q..)
!> are the equations of README.md in this directory.
!>
!> At the start x = 0 is non-basic and free of sign, and the slacks s = Cx - b >= 0 are basic. Each step changes
!> non-basic variables so that the objective falls: the free ones first, then an active slack with a negative
!> derivative, which grows. It ends at the first of two events: (a) a basic slack reaches zero and takes the place of
!> a variable that was changed; (b) the derivative reaches zero and a new free variable u, proportional to that
!> derivative, takes the place.
!>
!> N.B. Three departures from Beale. The free variables are changed together (see the table). An active slack is
!> exchanged for its u before the step, not after it: the path is the same. And the table, which he carries in exact
!> arithmetic, is used only to find the set of active constraints. The solution on that set is computed from D, c, C
!> and b, and its Karush-Kuhn-Tucker conditions are checked. Where the table has lost digits, or Beale's method takes
!> many steps, the table is made afresh from that set and the dual pass finishes.
!>
!> Constraints of unlike units are multiplied by powers of two that bring their normals to order one: slacks are
!> compared with each other, and the rounding of a large one would hide the violation of a small one.
module wavycon_beale
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_beale_table, only: table_type
   use wavycon_dual_pass, only: restore_optimum
   use wavycon_kinds, only: dp
   use wavycon_kkt, only: finish_on_active_set
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged, qp_infeasible, qp_infeasible_start, &
                                 qp_inaccurate, qp_iteration_limit, qp_not_convex, qp_not_finite
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: beale_solver

   !> A slack that falls slower than this fraction of the fastest does not limit a step: its constraint depends on
   !> active ones, and the rate is rounding.
   real(dp), parameter :: pivot_tolerance = 1e-11_dp
   !> Slacks within this fraction of the first to reach zero tie with it; the fastest of them is taken.
   real(dp), parameter :: tie_tolerance = 1e-13_dp
   !> After so many steps of length zero in a row the least index decides all choices, so that no set of active
   !> constraints recurs (Chang & Cottle, Math. Program. 18 (1980) 127-138), until a step is longer than zero.
   integer, parameter :: most_zero_steps = 12
   !> Beale's method ends after so many pivots times n, and the dual pass continues from its active constraints: a path
   !> that long passes through vertices of nearly dependent constraints, which cost digits.
   integer, parameter :: pivots_per_unknown = 8

   !> Keeps its table, so that a problem that differs in the bounds alone starts from the last solution.
   type :: beale_solver
      private
      type(qp_problem) :: problem               !! with scaled constraints
      integer, allocatable :: row_powers(:)     !! constraint i was multiplied by 2**row_powers(i), shape (m)
      type(working_set) :: set
      type(table_type) :: table
   contains
      procedure :: solve
      procedure :: pass_to
   end type beale_solver

contains

   !> Solves (Q1). Ends in any case: `solution%status` is one of the statuses of wavycon_qp_problem.
   subroutine solve(self, problem, solution, pivot_limit)
      class(beale_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution    !! only `status` is set if the problem is refused
      integer, intent(in), optional :: pivot_limit  !! > 0; 20 (n + m) if absent

      integer :: n, limit, status
      logical :: positive_definite, optimal

      n = size(problem%linear)
      limit = default_limit(problem)
      if (present(pivot_limit)) limit = pivot_limit

      if (.not. (all(ieee_is_finite(problem%hessian)) .and. all(ieee_is_finite(problem%linear)) &
                 .and. all(ieee_is_finite(problem%normals)) .and. all(ieee_is_finite(problem%bounds)))) then
         solution%status = qp_not_finite
         return
      end if
      if (any(problem%bounds > 0.0_dp)) then
         solution%status = qp_infeasible_start
         return
      end if
      call self%set%start(problem, positive_definite)
      if (.not. positive_definite) then
         solution%status = qp_not_convex
         return
      end if
      self%problem = problem
      call scale_constraints(self%problem, self%row_powers)

      call self%table%start(self%problem, self%set)
      call descend(self%table, min(limit, pivots_per_unknown*n), solution%pivots, optimal)
      if (optimal) then
         status = qp_converged
      else
         status = qp_iteration_limit
      end if
      call finish(self, limit, status, solution)
      call unscale_multipliers(self%row_powers, solution)
   end subroutine solve

   !> Solves the last problem with other bounds, from its solution, by the dual pass (Q11), (Q12).
   subroutine pass_to(self, bounds, solution)
      class(beale_solver), intent(inout) :: self      !! after a call of `solve` that has not refused the problem
      real(dp), intent(in) :: bounds(:)               !! b, of either sign, shape (m)
      type(qp_solution), intent(out) :: solution

      real(dp) :: scaled(size(bounds))
      integer :: status

      scaled = scale(bounds, self%row_powers)
      call self%table%move_bounds(scaled - self%problem%bounds)
      self%problem%bounds = scaled
      call restore_optimum(self%table, default_limit(self%problem), solution%pivots, status)
      call finish(self, default_limit(self%problem), status, solution)
      call unscale_multipliers(self%row_powers, solution)
   end subroutine pass_to

   !> Brings the largest component of each normal to between 1/2 and 1, unless those of all normals are of similar size.
   pure subroutine scale_constraints(problem, powers)
      type(qp_problem), intent(inout) :: problem
      integer, allocatable, intent(out) :: powers(:)  !! of two by which the constraints are multiplied, shape (m)

      integer, parameter :: most_power = maxexponent(1.0_dp)/2   ! bounds up to 2**most_power stay finite
      ! Sizes within 2**10 hide no violation above rounding, and fewer pivots are needed without the scaling.
      integer, parameter :: similar_powers = 10
      real(dp) :: largest(size(problem%bounds))
      integer :: i

      allocate (powers(size(largest)), source=0)
      do i = 1, size(largest)
         largest(i) = maxval(abs(problem%normals(:, i)))
      end do
      if (.not. any(largest > 0.0_dp)) return
      if (maxval(largest) <= scale(minval(largest, mask=largest > 0.0_dp), similar_powers)) return
      where (largest > 0.0_dp) powers = min(most_power, -exponent(largest))
      do i = 1, size(largest)
         problem%normals(:, i) = scale(1.0_dp, powers(i))*problem%normals(:, i)
         problem%bounds(i) = scale(problem%bounds(i), powers(i))
      end do
   end subroutine scale_constraints

   !> Converts the multipliers of the scaled constraints to those of the given ones.
   pure subroutine unscale_multipliers(powers, solution)
      integer, intent(in) :: powers(:)
      type(qp_solution), intent(inout) :: solution

      solution%multipliers = scale(solution%multipliers, powers(solution%active))
   end subroutine unscale_multipliers

   !> Computes the solution on the table's active constraints and checks it (Q3). While the check fails, the table is
   !> made afresh from these constraints and the dual pass continues, as long as that changes anything.
   subroutine finish(self, limit, status, solution)
      class(beale_solver), intent(inout) :: self
      integer, intent(in) :: limit                   !! on the pivots
      integer, intent(in) :: status                  !! of the steps on the table before
      type(qp_solution), intent(inout) :: solution

      integer :: pivots_before, last_status
      logical :: active(size(self%problem%bounds)), active_before(size(self%problem%bounds))

      last_status = status
      active_before = .false.
      self%set%extended_residuals = .false.
      do
         pivots_before = solution%pivots
         call finish_on_active_set(self%problem, self%set, self%table%active(:self%table%active_count), solution)
         if (solution%status == qp_converged) return
         if (solution%pivots >= limit) exit
         ! Which constraints are violated may depend on the last digits of the slacks.
         if (.not. self%set%extended_residuals) then
            self%set%extended_residuals = .true.
            cycle
         end if
         ! Of nearly dependent constraints those with positive multipliers are kept: the dual pass needs multipliers
         ! >= 0, and a table with the others would lose its digits when they are exchanged.
         do while (any(solution%multipliers < 0.0_dp))
            call finish_on_active_set(self%problem, self%set, &
                                      pack(solution%active, solution%multipliers > 0.0_dp), solution)
         end do
         if (solution%status == qp_converged) return
         call self%table%rebuild(self%problem, self%set, solution)
         ! From the same constraints the same steps would follow, up to the exchange that was refused: allow it now.
         active = .false.
         active(solution%active) = .true.
         self%table%accept_drift = all(active .eqv. active_before)
         active_before = active
         call restore_optimum(self%table, limit, solution%pivots, last_status)
         if (solution%pivots == pivots_before .or. last_status == qp_infeasible) exit
      end do
      if (last_status == qp_infeasible) then
         solution%status = qp_inaccurate
         if (is_infeasible(self%problem, self%table, solution%x)) solution%status = qp_infeasible
      else if (last_status /= qp_converged) then
         solution%status = last_status
      end if
   end subroutine finish

   !> Whether no x satisfies the table's excluded constraint i together with the active ones, checked with the problem's
   !> data. With weights w >= 0 every allowed x satisfies  (C_i + sum_j w_j C_j) x >= b_i + sum_j w_j b_j.  If the left
   !> side vanishes but for rounding and the right side is positive, there is none (Farkas' lemma), or only one that is
   !> far larger than the present x.
   pure logical function is_infeasible(problem, table, x)
      type(qp_problem), intent(in) :: problem
      type(table_type), intent(in) :: table
      real(dp), intent(in) :: x(:)   !! the minimiser on the active constraints, for its size

      real(dp), parameter :: far_larger = 1000.0_dp
      real(dp) :: normal(size(x)), bound, bound_terms
      integer :: j

      normal = problem%normals(:, table%excluded)
      bound = problem%bounds(table%excluded)
      bound_terms = abs(bound)
      do j = 1, table%active_count
         normal = normal + table%weights(j)*problem%normals(:, table%active(j))
         bound = bound + table%weights(j)*problem%bounds(table%active(j))
         bound_terms = bound_terms + abs(table%weights(j)*problem%bounds(table%active(j)))
      end do
      is_infeasible = bound > far_larger*max(sum(abs(normal))*maxval(abs(x)), epsilon(1.0_dp)*bound_terms)
   end function is_infeasible

   pure integer function default_limit(problem)
      type(qp_problem), intent(in) :: problem

      default_limit = 20*(size(problem%linear) + size(problem%bounds))
   end function default_limit

   !> Beale's method: changes non-basic variables until none lowers the objective. At the pivot limit it stops where the
   !> free ones do not: the point is then the minimum on the active constraints.
   subroutine descend(table, pivot_limit, pivots, optimal)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots
      logical, intent(out) :: optimal  !! false: the pivot limit was reached, or the table has drifted

      integer :: zero_steps, leaving, released
      real(dp) :: step

      zero_steps = 0
      do
         do while (norm2(table%gradient(table%active_count + 1:)) > table%zero_descent)
            call move_free(table, zero_steps > most_zero_steps, step, leaving)
            if (leaving == 0) exit
            zero_steps = merge(0, zero_steps + 1, step > 0.0_dp)
            call table%exchange_with_slack(leaving)
            pivots = pivots + 1
         end do
         table%gradient(table%active_count + 1:) = 0.0_dp

         released = table%steepest_slack(zero_steps > most_zero_steps)
         optimal = released == 0
         if (optimal .or. pivots >= pivot_limit) return
         call table%exchange_with_derivative(released)
         optimal = .false.
         if (table%drifted) return
         pivots = pivots + 1
      end do
   end subroutine descend

   !> Changes the free variables towards their minimum, up to the first slack that vanishes.
   subroutine move_free(table, least_index, step, leaving)
      type(table_type), intent(inout) :: table
      logical, intent(in) :: least_index  !! of slacks that vanish together, take that of the first constraint
      real(dp), intent(out) :: step       !! fraction of the distance to the minimum, 0 .. 1
      integer, intent(out) :: leaving     !! the place in `basic` of the slack that vanishes, 0 if none does

      real(dp) :: rates(table%basic_count), slowest, fastest
      integer :: i

      associate (values => table%values(:table%basic_count), &
                 free_gradient => table%gradient(table%active_count + 1:))
         ! The Hessian of the free variables is the unit matrix: the minimum lies at minus the gradient.
         call table%free_rates(-free_gradient, rates)
         slowest = pivot_tolerance*maxval(abs(rates))
         step = 1.0_dp
         do i = 1, size(rates)
            if (-rates(i) > slowest) then
               if (max(values(i), 0.0_dp) < -step*rates(i)) step = max(values(i), 0.0_dp)/(-rates(i))
            end if
         end do

         leaving = 0
         fastest = 0.0_dp
         do i = 1, size(rates)
            if (step >= 1.0_dp) exit
            if (-rates(i) <= slowest) cycle
            if (values(i) > -step*(1.0_dp + tie_tolerance)*rates(i)) cycle
            if (least_index) then
               if (leaving /= 0) then
                  if (table%basic(i) > table%basic(leaving)) cycle
               end if
               leaving = i
            else if (-rates(i) > fastest) then
               leaving = i
               fastest = -rates(i)
            end if
         end do
         values = values + step*rates
         free_gradient = (1.0_dp - step)*free_gradient
      end associate
   end subroutine move_free

end module wavycon_beale
