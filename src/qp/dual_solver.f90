!> Minimises 1/2 x'Dx - c'x subject to Cx >= b by the dual pass, D positive definite.
!>
!> It starts from the minimum without constraints, or on a given set of active constraints. The factors that are
!> changed from exchange to exchange are used to find the set of active constraints. The solution on that set is
!> computed from D, c, C and b, and its Karush-Kuhn-Tucker conditions are checked. Where the factors have lost digits
!> the set is factorised afresh and the pass continues. Numbers (Q..) are the equations of README.md in this
!> directory.
!>
!> Constraints in different units are multiplied by powers of two that bring their normals to order one: slacks are
!> compared with each other, and the rounding of a large one would hide the violation of a small one.
module wavycon_dual_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_dual_pass, only: dual_obstacle, restore_optimum
   use wavycon_kinds, only: dp
   use wavycon_kkt, only: check_on_active_set, kkt_tolerance
   use wavycon_lapack, only: dasum
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged, qp_infeasible, &
                                 qp_iteration_limit, qp_not_convex, qp_not_finite
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: dual_solver, default_pivot_limit

   !> A solution by factors that were changed from exchange to exchange is kept if its KKT residual is at most this;
   !> otherwise fresh factors give a better one.
   real(dp), parameter :: fresh_residual = 0.01_dp*kkt_tolerance

   !> Keeps its active constraints, so that a problem that differs in the bounds alone starts from the last solution.
   type :: dual_solver
      type(qp_problem) :: problem                         !! with scaled constraints
      type(working_set) :: set
      integer, allocatable, private :: row_powers(:)      !! constraint i was multiplied by 2**row_powers(i), shape (m)
   contains
      procedure :: start
      procedure :: solve
      procedure :: pass_to
      procedure :: finish
   end type dual_solver

contains

   !> Starts with a problem and no active constraint.
   subroutine start(self, problem, status)
      class(dual_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(out) :: status             !! qp_converged, or why it is refused: qp_not_finite, qp_not_convex

      real(dp) :: sums(size(problem%bounds))
      logical :: positive_definite

      ! Sums are finite only if all elements of C and b are.
      call problem%slacks(spread(1.0_dp, 1, size(problem%linear)), sums)
      status = qp_not_finite
      if (.not. (all(ieee_is_finite(problem%hessian)) .and. all(ieee_is_finite(problem%linear)) &
                 .and. all(ieee_is_finite(sums)))) return
      status = qp_not_convex
      call self%set%start(problem, positive_definite)
      if (.not. positive_definite) return
      status = qp_converged
      self%problem = problem
      allocate (self%row_powers(size(problem%bounds)), source=0)
      if (.not. are_similar(problem%normals)) call scale_constraints(self%problem, self%row_powers)
   end subroutine start

   !> Solves (Q1). Ends in any case: `solution%status` is one of the statuses of wavycon_qp_problem.
   subroutine solve(self, problem, solution, pivot_limit)
      class(dual_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution    !! only `status` is set if the problem is refused
      integer, intent(in), optional :: pivot_limit  !! > 0; `default_pivot_limit` if absent

      integer :: limit

      limit = default_pivot_limit(problem)
      if (present(pivot_limit)) limit = pivot_limit
      call self%start(problem, solution%status)
      if (solution%status == qp_converged) call self%finish(limit, solution)
   end subroutine solve

   !> Solves the last problem with other bounds, from its active constraints.
   subroutine pass_to(self, bounds, solution)
      class(dual_solver), intent(inout) :: self       !! after a call of `solve` that has not refused the problem
      real(dp), intent(in) :: bounds(:)               !! b, shape (m)
      type(qp_solution), intent(out) :: solution

      self%problem%bounds = scale(bounds, self%row_powers)
      call self%finish(default_pivot_limit(self%problem), solution)
   end subroutine pass_to

   !> The pass from the active constraints of `set`, whatever they are, to the solution, which is checked (Q3). While
   !> the check fails the set is factorised afresh, then solved with extended residuals, and the pass continues, as
   !> long as that changes anything.
   subroutine finish(self, pivot_limit, solution)
      class(dual_solver), intent(inout) :: self
      integer, intent(in) :: pivot_limit
      type(qp_solution), intent(inout) :: solution   !! `pivots` counts on, all else is set

      type(dual_obstacle) :: obstacle
      integer :: pivots_before, status
      logical :: was_fresh

      self%set%extended_residuals = .false.
      was_fresh = .false.
      do
         pivots_before = solution%pivots
         call restore_optimum(self%problem, self%set, pivot_limit, solution%pivots, status, obstacle)
         call check_on_active_set(self%problem, self%set, solution)
         if (status == qp_infeasible) then
            if (is_infeasible(self%problem, obstacle, solution%x)) then
               solution%status = qp_infeasible
               exit
            end if
         end if
         if (solution%status == qp_converged .and. solution%kkt_residual <= fresh_residual) exit
         call self%set%factorise_afresh(self%problem)
         call check_on_active_set(self%problem, self%set, solution)
         if (solution%status == qp_converged) exit
         ! Which constraints are violated may depend on the last digits of the slacks.
         self%set%extended_residuals = .true.
         call check_on_active_set(self%problem, self%set, solution)
         if (solution%status == qp_converged) exit
         if (solution%pivots >= pivot_limit) solution%status = qp_iteration_limit
         if (solution%pivots >= pivot_limit .or. was_fresh .and. solution%pivots == pivots_before) exit
         was_fresh = .true.
      end do
      solution%multipliers = scale(solution%multipliers, self%row_powers(solution%active))
   end subroutine finish

   !> Whether the normals' sizes are within 2**10: no violation above rounding is hidden, and scaling costs pivots.
   pure logical function are_similar(normals)
      real(dp), intent(in), contiguous :: normals(:, :)   !! shape (n, m)

      integer, parameter :: similar_powers = 10
      real(dp) :: sizes(size(normals, 2))
      integer :: i

      do i = 1, size(sizes)
         sizes(i) = dasum(size(normals, 1), normals(:, i), 1)
      end do
      are_similar = scale(maxval(sizes), -similar_powers) <= minval(sizes, mask=sizes > 0.0_dp)
   end function are_similar

   !> Brings the largest component of each normal to between 1/2 and 1.
   subroutine scale_constraints(problem, powers)
      type(qp_problem), intent(inout) :: problem
      integer, intent(inout) :: powers(:)  !! of two by which the constraints are multiplied, 0 on entry, shape (m)

      integer, parameter :: most_power = maxexponent(1.0_dp)/2   ! bounds up to 2**most_power stay finite
      real(dp) :: largest(size(problem%bounds))
      integer :: i

      do i = 1, size(largest)
         largest(i) = maxval(abs(problem%normals(:, i)))
      end do
      if (allocated(problem%rows)) deallocate (problem%rows)
      where (largest > 0.0_dp) powers = min(most_power, -exponent(largest))
      do i = 1, size(largest)
         problem%normals(:, i) = scale(1.0_dp, powers(i))*problem%normals(:, i)
         problem%bounds(i) = scale(problem%bounds(i), powers(i))
      end do
   end subroutine scale_constraints

   !> Whether no x satisfies the obstacle's constraint i together with the active ones, checked with the problem's data.
   !> With weights w >= 0 every allowed x satisfies  (C_i + sum_j w_j C_j) x >= b_i + sum_j w_j b_j.  If the left side
   !> vanishes but for rounding and the right side is positive, there is no such x (Farkas' lemma), or only one that is
   !> far larger than the present x.
   pure logical function is_infeasible(problem, obstacle, x)
      type(qp_problem), intent(in) :: problem
      type(dual_obstacle), intent(in) :: obstacle
      real(dp), intent(in) :: x(:)   !! the minimiser on the active constraints, for its size

      real(dp), parameter :: far_larger = 1000.0_dp
      real(dp) :: normal(size(x)), bound, bound_terms
      integer :: j

      normal = problem%normals(:, obstacle%constraint)
      bound = problem%bounds(obstacle%constraint)
      bound_terms = abs(bound)
      do j = 1, size(obstacle%active)
         normal = normal + obstacle%weights(j)*problem%normals(:, obstacle%active(j))
         bound = bound + obstacle%weights(j)*problem%bounds(obstacle%active(j))
         bound_terms = bound_terms + abs(obstacle%weights(j)*problem%bounds(obstacle%active(j)))
      end do
      is_infeasible = bound > far_larger*max(sum(abs(normal))*maxval(abs(x)), epsilon(1.0_dp)*bound_terms)
   end function is_infeasible

   !> A solver that needs more exchanges than this gives up.
   pure integer function default_pivot_limit(problem)
      type(qp_problem), intent(in) :: problem

      default_pivot_limit = 20*(size(problem%linear) + size(problem%bounds))
   end function default_pivot_limit

end module wavycon_dual_solver
