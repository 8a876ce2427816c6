!> Beale's method for  minimise 1/2 x'Dx - c'x  subject to  Cx >= b,  D diagonal and positive, b <= 0.
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
!> N.B. Beale carries the objective and the basic slacks in a table. Here the factors of the active constraints give
!> the numbers of that table which decide on the exchanges: the path from set to set of active constraints is his.
!> The free variables are changed together, towards the minimum on the active constraints.
module wavycon_beale
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv, dtrsv
   use wavycon_qp_problem, only: qp_problem
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: descend

   !> A slack that falls slower than this fraction of the fastest does not limit a step: its constraint depends on
   !> active ones, and the rate is rounding.
   real(dp), parameter :: pivot_tolerance = 1e-11_dp
   !> Slacks within this fraction of the first to reach zero tie with it; the fastest of them is taken.
   real(dp), parameter :: tie_tolerance = 1e-13_dp
   !> A derivative counts as zero if it is less than this fraction of that at x = 0, both over the root of the second
   !> derivative: rounding.
   real(dp), parameter :: derivative_tolerance = 64*epsilon(1.0_dp)
   !> Beale's method ends after so many exchanges times n, and the dual pass continues from its active constraints. A
   !> path that long passes through vertices of nearly dependent constraints, or does not move at all.
   integer, parameter :: pivots_per_unknown = 4

contains

   !> Changes the active constraints from none until no change of non-basic variables lowers the objective.
   subroutine descend(problem, set, pivots)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(inout) :: set   !! the empty set on entry
      integer, intent(inout) :: pivots          !! exchanges, counted up

      real(dp), dimension(size(problem%linear)) :: components, move, rest, x
      real(dp) :: rates(size(problem%bounds)), slacks(size(problem%bounds)), step, zero_descent
      integer :: leaving, m, n, released

      n = size(x)
      m = size(slacks)
      x = 0.0_dp
      slacks = -problem%bounds
      zero_descent = derivative_tolerance*norm2(set%inverse*problem%linear)
      do while (pivots < pivots_per_unknown*n)
         move = set%inverse*(problem%linear - problem%hessian*x)
         call set%split(move, components(:set%count))
         if (set%count < n .and. norm2(move) > zero_descent) then
            move = set%inverse*move
            call dgemv('T', n, m, 1.0_dp, problem%normals, n, move, 1, 0.0_dp, rates, 1)
            call find_limit(set%active(:set%count), slacks, rates, step, leaving)
            x = x + step*move
            slacks = slacks + step*rates
            if (leaving > 0) then
               rest = set%inverse*problem%normals(:, leaving)
               call set%split(rest, components(:set%count))
               call set%add(leaving, components(:set%count), rest)
               pivots = pivots + 1
               cycle
            end if
            move = set%inverse*(problem%linear - problem%hessian*x)
            call set%split(move, components(:set%count))
         end if
         released = steepest_slack(set, components(:set%count), zero_descent)
         if (released == 0) return
         call set%remove(released)
         pivots = pivots + 1
      end do
   end subroutine descend

   !> The first slack that vanishes on the way to the minimum on the active constraints, event (a).
   pure subroutine find_limit(active, slacks, rates, step, leaving)
      integer, intent(in) :: active(:)
      real(dp), intent(in) :: slacks(:), rates(:)   !! shape (m)
      real(dp), intent(out) :: step                 !! fraction of the way, 0 .. 1
      integer, intent(out) :: leaving               !! its constraint, 0 if none vanishes

      real(dp) :: parts(size(slacks))
      logical :: falls(size(slacks))

      falls = -rates > pivot_tolerance*maxval(abs(rates))
      falls(active) = .false.
      parts = 1.0_dp
      where (falls) parts = max(slacks, 0.0_dp)/(-rates)
      step = min(1.0_dp, minval(parts))
      leaving = 0
      if (step < 1.0_dp) leaving = minloc(rates, dim=1, &
                                          mask=falls .and. slacks <= -step*(1.0_dp + tie_tolerance)*rates)
   end subroutine find_limit

   !> The place of the active slack whose growth lowers the objective most, exchange (b), measured by (Q7), which has no
   !> unit of the slack; 0 if there is none.
   integer function steepest_slack(set, components, zero_descent) result(steepest)
      type(working_set), intent(in) :: set
      real(dp), intent(in) :: components(:)   !! Q'U^-1 (c - Dx), shape (k)
      real(dp), intent(in) :: zero_descent    !! less is rounding

      real(dp) :: largest, multipliers(size(components)), row(size(components))
      integer :: i, k, n

      n = size(set%active)
      k = size(components)
      steepest = 0
      if (k == 0) return
      largest = zero_descent
      multipliers = -components
      call dtrsv('U', 'N', 'N', k, set%triangle, n, multipliers, 1)
      do i = 1, k
         if (multipliers(i) >= 0.0_dp) cycle
         ! A row of R^-1, from its diagonal element on.
         row(i:) = 0.0_dp
         row(i) = 1.0_dp
         call dtrsv('U', 'T', 'N', k - i + 1, set%triangle(i, i), n, row(i), 1)
         if (-multipliers(i) <= largest*norm2(row(i:))) cycle
         largest = -multipliers(i)/norm2(row(i:))
         steepest = i
      end do
   end function steepest_slack

end module wavycon_beale
