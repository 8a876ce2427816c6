!> Beale's method for  minimise 1/2 x'Dx - c'x  subject to  Cx >= b,  D diagonal and positive, b <= 0.
!>
!> E. M. L. Beale, J. R. Statist. Soc. B 17 (1955) 173-184; Naval Res. Logist. Quart. 6 (1959) 227-243. Numbers (Q..)
!> are the equations of README.md in this directory.
!>
!> At the start x = 0 is non-basic and free of sign, and the slacks z = Cx - b >= 0 are basic. Each step changes
!> non-basic variables so that the objective falls: the free ones first, then an active slack with a negative
!> derivative, which grows. It ends at the first of two events: (a) a basic slack reaches zero and takes the place of
!> a variable that was changed; (b) the derivative reaches zero and a new free variable, proportional to that
!> derivative, takes the place.
!>
!> N.B. Where this departs from Beale:
!> - He carries the objective and the basic slacks in a table. Here the factors of the active constraints give the
!>   numbers of that table which decide on the exchanges.
!> - He changes the free variables one at a time. Here they change together, towards the minimum on the active
!>   constraints.
!> - He changes an active slack until its derivative is zero, and releases it then. Here it is released first.
!> - He lets no slack fall below zero. Here a slack may fall a little below zero on the way (Q8); the answer is taken
!>   if none is below zero but by rounding. On the paper's programmes this takes from a fifth of the exchanges, at
!>   0.01 p*, to three quarters, at 0.9 p*.
module wavycon_beale
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv, dtrsv
   use wavycon_qp_problem, only: qp_converged, qp_iteration_limit, qp_problem, qp_solution
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: solve_by_beale

   !> How far a slack may fall below zero in each pass, as a fraction of -b (Q8).
   integer, parameter :: slack_digits(*) = [2, 4, 7, 10, 3, 6, 9, 12, 4, 8, 11, 13]
   !> A slack that falls slower than this fraction of the fastest does not limit a step: its constraint depends on
   !> active ones, and the rate is rounding.
   real(dp), parameter :: pivot_tolerance = 1e-11_dp
   !> Slacks within this fraction of the first to reach zero tie with it; the fastest of them is taken.
   real(dp), parameter :: tie_tolerance = 1e-13_dp
   !> A derivative counts as zero if it is less than this fraction of that at x = 0, both over the root of the second
   !> derivative: rounding.
   real(dp), parameter :: derivative_tolerance = 64*epsilon(1.0_dp)
   !> A pass ends after so many exchanges times n. The paper's programmes take 7 n in all passes together, and 18
   !> harmonics with 54 points at most 61 n.
   integer, parameter :: most_pivots = 20

contains

   !> Solves (Q1). The status is `qp_converged` if the Karush-Kuhn-Tucker conditions hold to `kkt_tolerance`,
   !> `qp_iteration_limit` if the last pass did not end, otherwise `qp_inaccurate`.
   subroutine solve_by_beale(problem, solution)
      type(qp_problem), intent(in) :: problem   !! b <= 0
      type(qp_solution), intent(out) :: solution

      type(working_set) :: set
      real(dp) :: unit, x(size(problem%linear)), slacks(size(problem%bounds))
      integer :: pass, pivots
      logical :: has_ended

      call set%start(problem)
      x = 0.0_dp
      pivots = 0
      do pass = 1, size(slack_digits)
         set%count = 0
         call descend(problem, 10.0_dp**(-slack_digits(pass)), x, set, pivots, has_ended)
         call set%refresh(problem)
         call set%check(problem, solution)
         solution%pivots = pivots
         if (solution%status == qp_converged) return
         ! On the way from here to x = 0 the slacks that are below zero rise to it.
         call problem%slacks(solution%x, slacks)
         unit = 1.0_dp
         if (any(slacks < 0.0_dp)) unit = minval(problem%bounds/(problem%bounds + slacks), mask=slacks < 0.0_dp)
         x = unit*solution%x
      end do
      if (.not. has_ended) solution%status = qp_iteration_limit
   end subroutine solve_by_beale

   !> One pass: changes the active constraints from none until no change of non-basic variables lowers the objective.
   subroutine descend(problem, relaxation, x, set, pivots, has_ended)
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: relaxation        !! how far slacks may fall below zero, as a fraction of -b
      real(dp), intent(in) :: x(:)              !! the start, where no slack is negative
      type(working_set), intent(inout) :: set   !! the empty set on entry
      integer, intent(inout) :: pivots          !! exchanges, counted up
      logical, intent(out) :: has_ended         !! at a minimum; not by too many exchanges

      real(dp), dimension(size(problem%linear)) :: components, descent, move, normal, split
      real(dp) :: rates(size(problem%bounds)), slacks(size(problem%bounds)), step, zero_descent
      integer :: k, limit, leaving, m, n, released

      n = size(x)
      m = size(slacks)
      limit = pivots + most_pivots*n
      call problem%slacks(x, slacks)
      zero_descent = derivative_tolerance*norm2(set%inverse*problem%linear)
      ! U^-1 (c - Dx) = Q components + descent. Each exchange changes the split, and a step shortens `descent`.
      descent = set%inverse*(problem%linear - problem%hessian*x)
      do
         if (set%count < n .and. norm2(descent) > zero_descent) then
            move = set%inverse*descent
            call dgemv('T', n, m, 1.0_dp, problem%normals, n, move, 1, 0.0_dp, rates, 1)
            call find_limit(problem, relaxation, set, slacks, rates, step, leaving)
            slacks = slacks + step*rates
            descent = (1.0_dp - step)*descent
            if (leaving > 0) then
               normal = set%inverse*problem%normals(:, leaving)
               call set%split(normal, split(:set%count))
               call set%add(leaving, split(:set%count), normal)
               k = set%count
               components(k) = dot_product(set%span(:, k), descent)
               descent = descent - components(k)*set%span(:, k)
               pivots = pivots + 1
               cycle
            end if
         end if
         released = steepest_slack(set, components(:set%count), zero_descent)
         has_ended = released == 0
         if (has_ended .or. pivots >= limit) return
         call set%remove(released, components(:set%count), descent)
         pivots = pivots + 1
      end do
   end subroutine descend

   !> The end of a step on the way to the minimum on the active constraints, event (a). The way to `leaving` is at most
   !> that on which a slack reaches its relaxed limit (Q8); of the slacks that have reached zero by then the fastest is
   !> taken, so that the active constraints depend on one another as little as possible.
   pure subroutine find_limit(problem, relaxation, set, slacks, rates, step, leaving)
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: relaxation
      type(working_set), intent(in) :: set
      real(dp), intent(in) :: slacks(:), rates(:)   !! shape (m)
      real(dp), intent(out) :: step                 !! fraction of the way, 0 .. 1
      integer, intent(out) :: leaving               !! its constraint, 0 if none ends the step

      real(dp) :: fastest, least_rate, longest, reach(size(slacks))
      integer :: i
      logical :: is_active(size(slacks))

      is_active = .false.
      is_active(set%active(:set%count)) = .true.
      least_rate = pivot_tolerance*maxval(abs(rates))
      longest = 1.0_dp
      reach = max(slacks, 0.0_dp) - relaxation*problem%bounds
      do i = 1, size(slacks)
         if (-rates(i) <= least_rate .or. is_active(i)) cycle
         if (reach(i) < -longest*rates(i)) longest = reach(i)/(-rates(i))
      end do
      step = 1.0_dp
      leaving = 0
      if (longest >= 1.0_dp) return
      longest = longest*(1.0_dp + tie_tolerance)
      fastest = 0.0_dp
      do i = 1, size(slacks)
         if (-rates(i) <= max(least_rate, fastest) .or. is_active(i)) cycle
         if (slacks(i) > -longest*rates(i)) cycle
         fastest = -rates(i)
         leaving = i
      end do
      step = max(slacks(leaving), 0.0_dp)/fastest
   end subroutine find_limit

   !> The place of the active slack whose growth lowers the objective most, exchange (b), measured by (Q7), which has no
   !> unit of the slack; 0 if there is none.
   integer function steepest_slack(set, components, zero_descent) result(steepest)
      type(working_set), intent(in) :: set
      real(dp), intent(in) :: components(:)   !! Q'U^-1 (c - Dx), shape (k)
      real(dp), intent(in) :: zero_descent    !! less is rounding

      real(dp) :: descent, largest, multipliers(size(components))
      integer :: i

      steepest = 0
      if (size(components) == 0) return
      multipliers = -components
      call dtrsv('U', 'N', 'N', size(components), set%triangle, size(set%active), multipliers, 1)
      largest = zero_descent
      do i = 1, size(components)
         if (multipliers(i) >= 0.0_dp) cycle
         descent = -multipliers(i)*norm2(set%triangle(:i, i))
         if (descent <= largest) cycle
         largest = descent
         steepest = i
      end do
   end function steepest_slack

end module wavycon_beale
