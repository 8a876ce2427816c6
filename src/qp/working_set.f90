!> The minimum on a set of active constraints taken as equations, by factorisations of LAPACK.
!>
!> For the active rows C_W the factorisation is  J'DJ = I,  J'C_W' = (R; 0),  R upper triangular (Q4)
!> (Goldfarb & Idnani, Math. Program. 27 (1983) 1-33, section 4). With x = Jw the minimum on C_W x = b_W is (Q5)
!>
!>     w_1 = R^-T b_W,   w_2 = J_2'c,   multipliers = R^-1 (w_1 - J_1'c),
!>
!> where J_1 is the first k columns of J, k the number of active constraints. Numbers (Q..) are the equations of
!> README.md in this directory.
module wavycon_working_set
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm, dgemv, dgeqp3, dormqr, dpotrf, dtrsv, dtrtri
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: working_set

   !> A constraint counts as dependent on other active ones if the part of its normal outside their span is less than
   !> this fraction of it: such a part is rounding.
   real(dp), parameter :: dependence = 1e-13_dp
   !> The kind of extended residuals: quadruple precision where the compiler has it.
   integer, parameter :: long = merge(selected_real_kind(30), dp, selected_real_kind(30) > 0)
   !> Refinement ends earlier, when a step is more than half of the one before: no digits are left to gain.
   integer, parameter :: most_refinements = 10

   type :: working_set
      integer, allocatable :: active(:)              !! the active constraints, shape (k)
      real(dp), allocatable :: directions(:, :)      !! J, shape (n, n)
      real(dp), allocatable :: triangle(:, :)        !! R, zero below its diagonal, shape (k, k)
      real(dp), allocatable :: free_directions(:, :) !! J of the empty set, D^-1 = JJ'
      logical :: extended_residuals = .false.        !! whether `solve` refines with residuals of the kind `long`
   contains
      procedure :: start
      procedure :: assign_active
      procedure :: solve
   end type working_set

contains

   !> Factorises D for the empty set of active constraints.
   subroutine start(self, problem, positive_definite)
      class(working_set), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      logical, intent(out) :: positive_definite  !! false: D is not, and the set cannot be used

      integer :: i, n, info

      n = size(problem%linear)
      self%free_directions = problem%hessian
      call dpotrf('U', n, self%free_directions, n, info)
      if (info == 0) call dtrtri('U', 'N', n, self%free_directions, n, info)
      positive_definite = info == 0
      do i = 1, n - 1
         self%free_directions(i + 1:, i) = 0.0_dp
      end do
      self%directions = self%free_directions
      allocate (self%active(0), self%triangle(0, 0))
   end subroutine start

   !> Factorises a set of active constraints (Q4), without those that depend on the others. `start` comes first.
   subroutine assign_active(self, problem, list)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: list(:)  !! constraints, each once

      real(dp) :: columns(size(problem%linear), size(list)), normals(size(problem%linear), size(list))
      real(dp) :: tau(size(list)), size_of(size(list)), work(64*(size(problem%linear) + size(list) + 1))
      integer :: order(size(list))
      integer :: i, n, k, info

      n = size(problem%linear)
      normals = problem%normals(:, list)
      call dgemm('T', 'N', n, size(list), n, 1.0_dp, self%free_directions, n, normals, n, 0.0_dp, columns, n)
      size_of = norm2(columns, dim=1)
      order = 0
      call dgeqp3(n, size(list), columns, n, order, tau, work, size(work), info)
      k = 0
      do i = 1, min(n, size(list))
         if (abs(columns(i, i)) <= dependence*size_of(order(i))) exit
         k = i
      end do

      self%directions = self%free_directions
      call dormqr('R', 'N', n, n, k, columns, n, tau, self%directions, n, work, size(work), info)
      self%active = list(order(:k))
      self%triangle = columns(:k, :k)
      do i = 1, k - 1
         self%triangle(i + 1:, i) = 0.0_dp
      end do
   end subroutine assign_active

   !> The minimum on the active constraints and their multipliers (Q5).
   !>
   !> N.B. The factors contain D as its inverse square root, so errors grow as the square root of its condition number,
   !> unless `extended_residuals` is set.
   subroutine solve(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(out) :: x(:)            !! shape (n)
      real(dp), intent(out) :: multipliers(:)  !! of the active constraints in the order of `active`, shape (k)

      call solve_equations(self, problem%linear, problem%bounds(self%active), x, multipliers)
      if (self%extended_residuals) call refine(self, problem, x, multipliers)
   end subroutine solve

   !> Iterative refinement (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., chapter 12): the residuals
   !> of the equations are computed from D, c, C and b with more digits, and solved for, while the steps get shorter.
   subroutine refine(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(inout) :: x(:), multipliers(:)

      real(long) :: forces(size(x)), gap(size(multipliers))
      real(dp) :: x_change(size(x)), change(size(multipliers)), step, step_before
      integer :: i, j, round

      step_before = huge(step_before)
      do round = 1, most_refinements
         forces = problem%linear
         do j = 1, size(x)
            forces = forces - real(x(j), long)*problem%hessian(:, j)
         end do
         do i = 1, size(multipliers)
            associate (normal => problem%normals(:, self%active(i)))
               forces = forces + real(multipliers(i), long)*normal
               gap(i) = problem%bounds(self%active(i)) - sum(real(x, long)*normal)
            end associate
         end do
         call solve_equations(self, real(forces, dp), real(gap, dp), x_change, change)
         step = maxval(abs(x_change))
         if (step > step_before/2) exit
         x = x + x_change
         multipliers = multipliers + change
         step_before = step
      end do
   end subroutine refine

   !> Solves  Dx - C_W'y = c,  C_W x = b_W  by the factors.
   subroutine solve_equations(self, linear, bounds, x, multipliers)
      type(working_set), intent(in) :: self
      real(dp), intent(in) :: linear(:)        !! c, shape (n)
      real(dp), intent(in) :: bounds(:)        !! b_W, shape (k)
      real(dp), intent(out) :: x(:)            !! shape (n)
      real(dp), intent(out) :: multipliers(:)  !! y, shape (k)

      real(dp) :: y(size(x)), image(size(x))
      integer :: n, k

      n = size(x)
      k = size(self%active)
      call dgemv('T', n, n, 1.0_dp, self%directions, n, linear, 1, 0.0_dp, image, 1)
      y = image
      y(:k) = bounds
      call dtrsv('U', 'T', 'N', k, self%triangle, max(k, 1), y, 1)
      call dgemv('N', n, n, 1.0_dp, self%directions, n, y, 1, 0.0_dp, x, 1)
      multipliers = y(:k) - image(:k)
      call dtrsv('U', 'N', 'N', k, self%triangle, max(k, 1), multipliers, 1)
   end subroutine solve_equations

end module wavycon_working_set
