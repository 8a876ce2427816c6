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
!> arithmetic, is used only to find the set of active constraints, from which the dual pass finishes and checks. The
!> pass has exchanges left to make only where the table has lost digits or Beale's method takes many steps.
module wavycon_beale
   use wavycon_beale_table, only: table_type
   use wavycon_dual_solver, only: default_pivot_limit, dual_solver
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged, qp_infeasible_start
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

   !> Other bounds are solved by the dual pass from the last solution (`pass_to`).
   type, extends(dual_solver) :: beale_solver
   contains
      procedure :: solve
   end type beale_solver

contains

   !> Solves (Q1). Ends in any case: `solution%status` is one of the statuses of wavycon_qp_problem.
   subroutine solve(self, problem, solution, pivot_limit)
      class(beale_solver), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution    !! only `status` is set if the problem is refused
      integer, intent(in), optional :: pivot_limit  !! > 0; `default_pivot_limit` if absent

      type(table_type) :: table
      integer :: limit

      limit = default_pivot_limit(problem)
      if (present(pivot_limit)) limit = pivot_limit
      call self%start(problem, solution%status)
      if (solution%status /= qp_converged) return
      if (any(problem%bounds > 0.0_dp)) then
         solution%status = qp_infeasible_start
         return
      end if

      call table%start(self%problem, self%set)
      call descend(table, min(limit, pivots_per_unknown*size(problem%linear)), solution%pivots)
      call self%set%assign_active(self%problem, table%active(:table%active_count))
      call self%finish(limit, solution)
   end subroutine solve

   !> Beale's method: changes non-basic variables until none lowers the objective. At the pivot limit, or where the
   !> table has lost digits, it stops where the free variables change no more: the point is then the minimum on the
   !> active constraints.
   subroutine descend(table, pivot_limit, pivots)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots

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
         if (released == 0 .or. pivots >= pivot_limit) return
         call table%exchange_with_derivative(released)
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
