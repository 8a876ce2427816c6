!> Beale's method for  min 1/2 x'Dx - c'x  subject to  Cx >= b,  D positive definite, b <= 0.
!>
!> E. M. L. Beale, J. R. Statist. Soc. B 17 (1955) 173-184; Naval Res. Logist. Quart. 6 (1959) 227-243.
!>
!> Start at x = 0: x is non-basic and free of sign, the slacks s = Cx - b >= 0 are basic. Free non-basic variables
!> with a derivative are changed first (in either direction), then an active slack with a negative derivative (it
!> grows), so that the objective falls, up to the first of two events: (a) a basic slack reaches zero and takes the
!> place of the variable that was changed; (b) the derivative reaches zero and a new free variable u, proportional
!> to that derivative, takes the place.
!>
!> N.B. Three departures. The free variables change together (see the table). An active slack gives way to its u
!> before the step, not after it: the path is the same. And the table, which Beale carries in exact arithmetic, only
!> finds the set of active constraints: the answer is then solved for from the problem's own data, its
!> Karush-Kuhn-Tucker conditions are checked, and where the table has drifted or Beale's way is long it is made
!> afresh from that set and the dual pass ends the work.
!>
!> Inside, constraints of unlike units are multiplied by powers of two that bring their normals to order one: slacks
!> are compared with each other, and what is rounding of a large one would hide that a small one is violated.
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

   !> A slack that falls slower than this fraction of the fastest does not stop a step: it depends on active ones.
   real(dp), parameter :: pivot_tolerance = 1e-11_dp
   !> Slacks within this fraction of the first to reach zero tie with it; the fastest of them is taken.
   real(dp), parameter :: tie_tolerance = 1e-13_dp
   !> After so many steps of length zero in a row the least index decides all choices, so that none recurs
   !> (Chang & Cottle, Math. Program. 18 (1980) 127-138), until a step has length again.
   integer, parameter :: patience = 12
   !> Beale's own steps end after so many pivots times n, and the dual pass goes on from their active constraints:
   !> by then the way leads through vertices of nearly dependent constraints.
   integer, parameter :: own_pivots = 8

   !> A solver that keeps its table, so that the next problem, which differs in the bounds alone, starts from it.
   type :: beale_solver
      private
      type(qp_problem) :: problem               !! its constraints scaled
      integer, allocatable :: row_powers(:)     !! they were multiplied by two to these, shape (m)
      type(working_set) :: set
      type(table_type) :: table
   contains
      procedure :: solve
      procedure :: pass_to
   end type beale_solver

contains

   !> Solves a problem. Every outcome is a status; nothing loops for ever.
   subroutine solve(self, problem, solution, pivot_limit)
      class(beale_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution    !! where the problem itself is refused only `status` is set
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
      call descend(self%table, min(limit, own_pivots*n), solution%pivots, optimal)
      if (optimal) then
         status = qp_converged
      else
         status = qp_iteration_limit
      end if
      call settle(self, limit, status, solution)
      call unscale_multipliers(self%row_powers, solution)
   end subroutine solve

   !> Solves the last problem with other bounds, starting from its answer.
   subroutine pass_to(self, bounds, solution)
      class(beale_solver), intent(inout) :: self      !! `solve` has been called and has not refused the problem
      real(dp), intent(in) :: bounds(:)               !! b, shape (m)
      type(qp_solution), intent(out) :: solution

      real(dp) :: scaled(size(bounds))
      integer :: status

      scaled = scale(bounds, self%row_powers)
      call self%table%move_bounds(scaled - self%problem%bounds)
      self%problem%bounds = scaled
      call restore_optimum(self%table, default_limit(self%problem), solution%pivots, status)
      call settle(self, default_limit(self%problem), status, solution)
      call unscale_multipliers(self%row_powers, solution)
   end subroutine pass_to

   !> Brings the largest component of each normal to between 1/2 and 1, unless they are all of about one size as
   !> they are.
   pure subroutine scale_constraints(problem, powers)
      type(qp_problem), intent(inout) :: problem
      integer, allocatable, intent(out) :: powers(:)  !! of two, that the constraints are multiplied by, shape (m)

      integer, parameter :: most_power = maxexponent(1.0_dp)/2   ! bounds of whatever size up to that stay finite
      ! Of sizes within 2^10 only rounding is hidden, and the way is shorter without.
      integer, parameter :: alike = 10
      real(dp) :: largest(size(problem%bounds))
      integer :: i

      allocate (powers(size(largest)), source=0)
      do i = 1, size(largest)
         largest(i) = maxval(abs(problem%normals(:, i)))
      end do
      if (.not. any(largest > 0.0_dp)) return
      if (maxval(largest) <= scale(minval(largest, mask=largest > 0.0_dp), alike)) return
      where (largest > 0.0_dp) powers = min(most_power, -exponent(largest))
      do i = 1, size(largest)
         problem%normals(:, i) = scale(1.0_dp, powers(i))*problem%normals(:, i)
         problem%bounds(i) = scale(problem%bounds(i), powers(i))
      end do
   end subroutine scale_constraints

   !> From the multipliers of the scaled constraints to those of the constraints as they were given.
   pure subroutine unscale_multipliers(powers, solution)
      integer, intent(in) :: powers(:)
      type(qp_solution), intent(inout) :: solution

      solution%multipliers = scale(solution%multipliers, powers(solution%active))
   end subroutine unscale_multipliers

   !> Takes the answer from the table's active constraints. Where it does not hold good the table is made afresh
   !> from them and mended, as long as that changes anything.
   subroutine settle(self, limit, status, solution)
      class(beale_solver), intent(inout) :: self
      integer, intent(in) :: limit                   !! of the pivots
      integer, intent(in) :: status                  !! that the table's own steps ended with
      type(qp_solution), intent(inout) :: solution

      integer :: pivots_before, last_status
      logical :: active(size(self%problem%bounds)), active_before(size(self%problem%bounds))

      last_status = status
      active_before = .false.
      self%set%careful = .false.
      do
         pivots_before = solution%pivots
         call finish_on_active_set(self%problem, self%set, self%table%active(:self%table%active_count), solution)
         if (solution%status == qp_converged) return
         if (solution%pivots >= limit) exit
         ! What is left to do may hang on the last digits of the slacks.
         if (.not. self%set%careful) then
            self%set%careful = .true.
            cycle
         end if
         ! Of nearly dependent constraints only those that push are kept: the dual pass needs multipliers >= 0, and
         ! a table of the others loses its digits when they are exchanged.
         do while (any(solution%multipliers < 0.0_dp))
            call finish_on_active_set(self%problem, self%set, &
                                      pack(solution%active, solution%multipliers > 0.0_dp), solution)
         end do
         if (solution%status == qp_converged) return
         call self%table%rebuild(self%problem, self%set, solution)
         ! From the same constraints the same steps would follow: then the digits that stopped them are given up.
         active = .false.
         active(solution%active) = .true.
         self%table%may_drift = all(active .eqv. active_before)
         active_before = active
         call restore_optimum(self%table, limit, solution%pivots, last_status)
         if (solution%pivots == pivots_before .or. last_status == qp_infeasible) exit
      end do
      if (last_status == qp_infeasible) then
         solution%status = qp_inaccurate
         if (is_excluded(self%problem, self%table, solution%x)) solution%status = qp_infeasible
      else if (last_status /= qp_converged) then
         solution%status = last_status
      end if
   end subroutine settle

   !> Whether a constraint is excluded by the active ones, by the problem's own data and not by the table's word:
   !> with weights w >= 0 every allowed x satisfies  (C_i + sum_j w_j C_j) x >= b_i + sum_j w_j b_j,  on the left of
   !> which next to nothing is left (Farkas' lemma). Only an x that is larger by far than the problem's could then
   !> satisfy it.
   pure logical function is_excluded(problem, table, x)
      type(qp_problem), intent(in) :: problem
      type(table_type), intent(in) :: table
      real(dp), intent(in) :: x(:)   !! the minimiser on the active constraints, for its size

      real(dp), parameter :: by_far = 1000.0_dp
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
      is_excluded = bound > by_far*max(sum(abs(normal))*maxval(abs(x)), epsilon(1.0_dp)*bound_terms)
   end function is_excluded

   pure integer function default_limit(problem)
      type(qp_problem), intent(in) :: problem

      default_limit = 20*(size(problem%linear) + size(problem%bounds))
   end function default_limit

   !> Changes non-basic variables until none can lower the objective, or, the pivot limit passed, until the free
   !> ones can't: the point is then the minimiser on the active constraints.
   subroutine descend(table, pivot_limit, pivots, optimal)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots
      logical, intent(out) :: optimal  !! false: the pivot limit was reached, or the table has drifted

      integer :: idle_steps, leaving, released
      real(dp) :: step

      idle_steps = 0
      do
         do while (norm2(table%gradient(table%active_count + 1:)) > table%zero_descent)
            call move_free(table, idle_steps > patience, step, leaving)
            if (leaving == 0) exit
            idle_steps = merge(0, idle_steps + 1, step > 0.0_dp)
            call table%exchange_with_slack(leaving)
            pivots = pivots + 1
         end do
         table%gradient(table%active_count + 1:) = 0.0_dp

         released = table%steepest_slack(idle_steps > patience)
         optimal = released == 0
         if (optimal .or. pivots >= pivot_limit) return
         call table%exchange_with_derivative(released)
         optimal = .false.
         if (table%drifted) return
         pivots = pivots + 1
      end do
   end subroutine descend

   !> Changes the free variables along their steepest descent to the minimum or to the first slack that vanishes.
   subroutine move_free(table, least_index, step, leaving)
      type(table_type), intent(inout) :: table
      logical, intent(in) :: least_index
      real(dp), intent(out) :: step       !! fraction of the way to the minimum, 0 .. 1
      integer, intent(out) :: leaving     !! the place in `basic` of the slack that vanishes, 0 if none does

      real(dp) :: rates(table%basic_count), slowest, fastest
      integer :: i

      associate (values => table%values(:table%basic_count), &
                 free_gradient => table%gradient(table%active_count + 1:))
         ! The free Hessian is the unit matrix: the way to the minimum is minus the gradient.
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
