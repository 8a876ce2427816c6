!> The answer of a quadratic programme as its bounds move:  min 1/2 x'Dx - c'x  subject to  Cx >= b + t d.
!>
!> x(t) is piecewise linear: between two events the active constraints stay the same. An event is a slack that
!> reaches zero (its constraint becomes active) or a multiplier that does (its constraint is released). Following
!> the path costs one small linear solve an event.
module wavycon_parametric
   use wavycon_beale, only: finish_on_active_set
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged, qp_infeasible, qp_iteration_limit, &
                                 qp_not_convex
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: parametric_path

   !> A slope below this fraction of the largest is rounding.
   real(dp), parameter :: slope_tolerance = 1e-13_dp
   !> The factorisation is made afresh after so many events.
   integer, parameter :: refresh_interval = 100

   type :: parametric_path
      private
      type(working_set) :: set
      real(dp), allocatable :: bound_slopes(:)  !! d, shape (m)
      real(dp) :: parameter = 0.0_dp            !! t
   contains
      procedure :: start
      procedure :: advance
   end type parametric_path

contains

   !> Starts the path at a known answer.
   subroutine start(self, problem, bound_slopes, parameter, active, status)
      class(parametric_path), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: bound_slopes(:)  !! d, shape (m)
      real(dp), intent(in) :: parameter        !! t of the known answer
      integer, intent(in) :: active(:)         !! its active constraints
      integer, intent(out) :: status           !! qp_converged, qp_not_convex

      logical :: positive_definite

      call self%set%start(problem, positive_definite)
      status = merge(qp_converged, qp_not_convex, positive_definite)
      if (.not. positive_definite) return
      call self%set%assign_active(problem, active)
      self%bound_slopes = bound_slopes
      self%parameter = parameter
   end subroutine start

   !> Follows the path to another parameter. The answer there is solved for from the problem's data and its KKT
   !> residual decides the status, as for a single solve; an event that can't be passed ends with its name.
   subroutine advance(self, problem, parameter, solution)
      class(parametric_path), intent(inout) :: self
      type(qp_problem), intent(in) :: problem       !! the problem of `start`
      real(dp), intent(in) :: parameter             !! t to go to
      type(qp_solution), intent(out) :: solution    !! `pivots` counts the events passed

      real(dp) :: x(size(problem%linear)), x_slope(size(problem%linear))
      real(dp) :: multipliers(size(problem%linear)), multiplier_slopes(size(problem%linear))
      real(dp) :: slacks(size(problem%bounds)), slack_slopes(size(problem%bounds))
      real(dp) :: way, to_constraint, to_release
      integer :: constraint, release, n, m, limit, status

      n = size(problem%linear)
      m = size(problem%bounds)
      limit = 50*(n + m)
      status = qp_converged

      call self%set%solve(problem, problem%bounds + self%parameter*self%bound_slopes, x, multipliers)
      slacks = -problem%bounds - self%parameter*self%bound_slopes
      call dgemv('T', n, m, 1.0_dp, problem%normals, n, x, 1, 1.0_dp, slacks, 1)
      do
         way = parameter - self%parameter
         if (abs(way) <= 0.0_dp) exit
         associate (k => self%set%active_count)
            call self%set%solve_slope(sign(1.0_dp, way)*self%bound_slopes, x_slope, multiplier_slopes)
            slack_slopes = -sign(1.0_dp, way)*self%bound_slopes
            call dgemv('T', n, m, 1.0_dp, problem%normals, n, x_slope, 1, 1.0_dp, slack_slopes, 1)
            slack_slopes(self%set%active(:k)) = 0.0_dp
            call first_to_vanish(slacks, slack_slopes, constraint, to_constraint)
            call first_to_vanish(multipliers(:k), multiplier_slopes(:k), release, to_release)
            if (min(to_constraint, to_release) >= abs(way)) then
               self%parameter = parameter
               exit
            end if
            if (solution%pivots >= limit) then
               status = qp_iteration_limit
               exit
            end if

            self%parameter = self%parameter + sign(min(to_constraint, to_release), way)
            slacks = slacks + min(to_constraint, to_release)*slack_slopes
         end associate
         if (to_release <= to_constraint) then
            call self%set%drop(release)
         else
            call exchange(self%set, problem, multipliers, constraint, status)
            if (status /= qp_converged) exit
            slacks(constraint) = 0.0_dp
         end if
         solution%pivots = solution%pivots + 1
         if (mod(solution%pivots, refresh_interval) == 0) &
            call self%set%assign_active(problem, self%set%active(:self%set%active_count))
         call self%set%solve(problem, problem%bounds + self%parameter*self%bound_slopes, x, multipliers)
      end do

      call self%set%assign_active(problem, self%set%active(:self%set%active_count))
      call finish_on_active_set(problem, self%set, problem%bounds + self%parameter*self%bound_slopes, solution)
      if (status /= qp_converged) solution%status = status
   end subroutine advance

   !> The first of some values >= 0 to reach zero at given rates, and how far away that is.
   pure subroutine first_to_vanish(values, slopes, first, distance)
      real(dp), intent(in) :: values(:), slopes(:)
      integer, intent(out) :: first       !! 0 if none does
      real(dp), intent(out) :: distance   !! >= 0; huge if none does

      real(dp) :: zero
      integer :: i

      first = 0
      distance = huge(distance)
      if (size(slopes) == 0) return
      zero = slope_tolerance*maxval(abs(slopes))
      do i = 1, size(values)
         if (slopes(i) >= -zero) cycle
         if (max(values(i), 0.0_dp) < -distance*slopes(i)) then
            distance = max(values(i), 0.0_dp)/(-slopes(i))
            first = i
         end if
      end do
   end subroutine first_to_vanish

   !> Makes a constraint active. Where its gradient depends on those of the active ones, one of them is released:
   !> the first whose multiplier vanishes as the new one's grows.
   subroutine exchange(set, problem, multipliers, constraint, status)
      type(working_set), intent(inout) :: set
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: multipliers(:)
      integer, intent(in) :: constraint
      integer, intent(out) :: status  !! qp_converged, qp_infeasible

      real(dp) :: weights(set%active_count), distance
      integer :: release
      logical :: added

      status = qp_converged
      call set%add(problem, constraint, added)
      if (added) return
      call set%dependence_on_active(problem, constraint, weights)
      call first_to_vanish(multipliers(:size(weights)), -weights, release, distance)
      if (release /= 0) then
         call set%drop(release)
         call set%add(problem, constraint, added)
      end if
      if (.not. added) status = qp_infeasible
   end subroutine exchange

end module wavycon_parametric
