!> The constraints that hold with equality at the minimum of a programme of many terms and points, by an interior-point
!> method: that of S. Mehrotra, SIAM J. Optim. 2 (1992) 575-601, with the matrix (Q14) of README.md in this directory.
!>
!> It takes some 20 to 40 steps, whatever the load, where the dual method takes thousands of exchanges. Its multipliers
!> have few digits; so they are only a start for the dual method.
module wavycon_interior_point
   use wavycon_gsl, only: ascending_order
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv, dpotrf, dtrsv
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: likely_active

   !> Part of the constraints violated at the minimum without any from which the start pays: contact at P < 0.55.
   real(dp), parameter :: least_violated = 0.17_dp
   !> Guard: the paper's programmes take at most 42 steps, at P = 0.001.
   integer, parameter :: most_steps = 80
   !> Share of the step at which a slack or a multiplier would vanish.
   real(dp), parameter :: step_share = 0.995_dp
   !> A constraint is likely to be active if its multiplier is so many times its slack. D and C are of order one.
   real(dp), parameter :: likely_ratio = 1e3_dp

contains

   !> The constraints that are likely to be active, the likeliest first, and approximate multipliers of all. The steps
   !> end where rounding does not leave the matrix positive. There are no steps and no constraints where exchanges take
   !> less time: without rows as sums, where x = 0 does not satisfy all constraints with some room, and where the
   !> minimum without constraints violates few of them.
   subroutine likely_active(problem, list, multipliers, steps)
      type(qp_problem), intent(in) :: problem
      integer, allocatable, intent(out) :: list(:)
      real(dp), intent(out) :: multipliers(:)               !! > 0 if there are steps, shape (m)
      integer, intent(out) :: steps

      real(dp), dimension(size(multipliers)) :: slack, slack_change, change, products
      real(dp), dimension(size(problem%linear)) :: x, x_change
      real(dp), allocatable :: matrix(:, :)
      integer :: i, info, m, n, pass
      real(dp) :: mean, step

      n = size(x)
      m = size(multipliers)
      steps = 0
      allocate (list(0))
      if (.not. allocated(problem%rows)) return
      call problem%slacks(problem%linear/problem%hessian, slack)
      if (any(problem%bounds >= 0.0_dp) .or. count(slack < 0.0_dp) < least_violated*m) return
      allocate (matrix(n, n))
      x = 0.0_dp
      slack = -problem%bounds
      multipliers = 1.0_dp/m
      do steps = 0, most_steps - 1
         call problem%rows%squares(multipliers/slack, matrix)
         do i = 1, n
            matrix(i, i) = matrix(i, i) + problem%hessian(i)
         end do
         call dpotrf('L', n, matrix, n, info)
         if (info /= 0) exit
         products = slack*multipliers
         mean = sum(products)/m
         ! First towards products of 0; then, with what that says of their curvature, towards equal ones.
         do pass = 1, 2
            x_change = problem%linear - problem%hessian*x
            call dgemv('N', n, m, 1.0_dp, problem%normals, n, multipliers - products/slack, 1, 1.0_dp, x_change, 1)
            call dtrsv('L', 'N', 'N', n, matrix, n, x_change, 1)
            call dtrsv('L', 'T', 'N', n, matrix, n, x_change, 1)
            call problem%rows%of(x_change, slack_change)
            change = -(products + multipliers*slack_change)/slack
            step = 1.0_dp/max(1.0_dp, maxval(-slack_change/slack), maxval(-change/multipliers))
            if (pass == 1) products = products + slack_change*change - mean* &
               (dot_product(slack + step*slack_change, multipliers + step*change)/(m*mean))**3
         end do
         step = step_share*step
         x = x + step*x_change
         slack = slack + step*slack_change
         multipliers = multipliers + step*change
      end do
      list = ascending_order(slack/multipliers)
      list = list(:count(multipliers > likely_ratio*slack))
   end subroutine likely_active

end module wavycon_interior_point
