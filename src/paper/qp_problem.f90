!> The convex quadratic programme  minimise 1/2 x'Dx - c'x  subject to  Cx >= b,  D diagonal, its
!> solution, and the Karush-Kuhn-Tucker conditions of that. Numbers (Q..) are the equations of README.md in this
!> directory.
module wavycon_qp_problem
   use wavycon_cosine_rows, only: cosine_rows
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   implicit none (type, external)
   private

   public :: kkt_residual, qp_problem, qp_solution

   !> A solution is accepted if its relative KKT residual (Q3) is at most this, some thousand roundings.
   real(dp), parameter, public :: kkt_tolerance = 1e-12_dp

   !> How a solver ended.
   integer, parameter, public :: qp_converged = 0
   integer, parameter, public :: qp_iteration_limit = 1
   integer, parameter, public :: qp_inaccurate = 2   !! the KKT residual exceeds its tolerance

   !> A problem of n unknowns and m constraints.
   type :: qp_problem
      real(dp), allocatable :: hessian(:)     !! the diagonal of D, all > 0, shape (n)
      real(dp), allocatable :: linear(:)      !! c, shape (n)
      real(dp), allocatable :: normals(:, :)  !! C': column i is the gradient of constraint i, shape (n, m)
      real(dp), allocatable :: bounds(:)      !! b, shape (m)
      type(cosine_rows), allocatable :: rows  !! a faster way to Cx than by the elements of C, if there is one
   contains
      procedure :: slacks
   end type qp_problem

   !> Its solution.
   type :: qp_solution
      integer :: status = qp_iteration_limit   !! one of the names above
      integer :: pivots = 0                    !! number of exchanges of variables
      real(dp) :: kkt_residual = huge(1.0_dp)  !! largest relative violation of the KKT conditions
      real(dp), allocatable :: x(:)            !! shape (n)
      integer, allocatable :: active(:)        !! the active constraints, which hold with equality, shape (k)
      real(dp), allocatable :: multipliers(:)  !! of the active constraints, in the same order, shape (k)
   end type qp_solution

contains

   !> Cx - b, by the fastest way there is.
   subroutine slacks(self, x, values)
      class(qp_problem), intent(in) :: self
      real(dp), intent(in), contiguous :: x(:)          !! shape (n)
      real(dp), intent(out), contiguous :: values(:)    !! shape (m)

      if (allocated(self%rows)) then
         call self%rows%of(x, values)
         values = values - self%bounds
      else
         values = -self%bounds
         call dgemv('T', size(x), size(values), 1.0_dp, self%normals, size(x), x, 1, 1.0_dp, values, 1)
      end if
   end subroutine slacks

   !> Largest relative violation (Q3) of the Karush-Kuhn-Tucker conditions (Q2)
   !>
   !>     Dx - c = C'y,   Cx >= b,   y >= 0,   y (Cx - b) = 0.
   !>
   !> Each is divided by the largest of the terms that must cancel in it, so that the units of x, of the objective and
   !> of the constraints do not matter. The exact solution, rounded, has a residual of some machine precisions.
   real(dp) function kkt_residual(problem, x, active, multipliers) result(residual)
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: x(:)            !! the solution to check, shape (n)
      integer, intent(in) :: active(:)        !! constraints with a multiplier, each once
      real(dp), intent(in) :: multipliers(:)  !! y of the active constraints, shape (size(active))

      real(dp), parameter :: smallest_scale = tiny(1.0_dp)   ! terms that are all 0 have no violation
      real(dp) :: gradient(size(x)), term(size(x)), slack(size(problem%bounds))
      real(dp) :: gradient_scale, force(size(active)), x_size
      integer :: i, n, m

      n = size(x)
      m = size(problem%bounds)

      gradient = problem%hessian*x
      gradient_scale = max(maxval(abs(gradient)), maxval(abs(problem%linear)))
      gradient = gradient - problem%linear
      do i = 1, size(active)
         term = multipliers(i)*problem%normals(:, active(i))
         gradient_scale = max(gradient_scale, maxval(abs(term)))
         gradient = gradient - term
      end do
      gradient_scale = max(gradient_scale, smallest_scale)
      residual = maxval(abs(gradient))/gradient_scale
      if (m == 0) return

      ! Each constraint has its own scale, so that large units of one do not hide the violation of another.
      slack = -problem%bounds
      call dgemv('T', n, m, 1.0_dp, problem%normals, n, x, 1, 1.0_dp, slack, 1)
      x_size = maxval(abs(x))
      do i = 1, m
         if (slack(i) < 0.0_dp) residual = max(residual, -slack(i)/slack_scale(i))
      end do
      if (size(active) == 0) return

      ! A multiplier is measured by its term in the gradient.
      force = multipliers*maxval(abs(problem%normals(:, active)), dim=1)
      residual = max(residual, -minval(force)/gradient_scale)
      do i = 1, size(active)
         residual = max(residual, abs(force(i)*slack(active(i)))/ &
                                  max(gradient_scale*slack_scale(active(i)), smallest_scale))
      end do

   contains

      !> The largest of the terms that cancel in the slack of constraint i.
      pure real(dp) function slack_scale(i)
         integer, intent(in) :: i

         slack_scale = max(abs(problem%bounds(i)) + x_size*maxval(abs(problem%normals(:, i))), smallest_scale)
      end function slack_scale

   end function kkt_residual

end module wavycon_qp_problem
