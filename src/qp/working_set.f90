!> The equality-constrained problem of a set of active constraints, factorised and kept up to date.
!>
!> For the active rows C_W the factorisation is  J'DJ = I,  J'C_W' = (R; 0),  R upper triangular
!> (Goldfarb & Idnani 1983, section 4). With x = Jy the minimiser on C_W x = b_W is
!>
!>     y_1 = R^-T b_W,   y_2 = J_2'c,   multipliers = R^-1 (y_1 - J_1'c),
!>
!> where J_1 holds the first columns of J, as many as there are active constraints. An orthogonal change of J
!> adds or removes a constraint: Householder's reflection and Givens' rotations, both from LAPACK.
module wavycon_working_set
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm, dgemv, dgeqrf, dger, dlarfg, dlartg, dnrm2, dormqr, dpotrf, drot, dtrsv, dtrtri
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: working_set

   !> A gradient whose part outside the span of the active ones is less than this fraction of it counts as
   !> dependent on them: beyond it the solution of R would lose the last half of the digits.
   real(dp), parameter :: dependence = sqrt(epsilon(1.0_dp))

   type :: working_set
      integer :: active_count = 0
      integer, allocatable :: active(:)              !! the active constraints are active(1:active_count)
      real(dp), allocatable :: directions(:, :)      !! J, shape (n, n)
      real(dp), allocatable :: triangle(:, :)        !! R in its leading part, shape (n, n)
      real(dp), allocatable :: free_directions(:, :) !! J of the empty set, D^-1 = JJ'
   contains
      procedure :: start
      procedure :: assign_active
      procedure :: add
      procedure :: drop
      procedure :: solve
      procedure :: solve_slope
      procedure :: dependence_on_active
   end type working_set

contains

   !> Factorises D for the empty set of active constraints.
   subroutine start(self, problem, positive_definite)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      logical, intent(out) :: positive_definite  !! false: D is not, and the set is of no use

      integer :: i, n, info

      n = size(problem%linear)
      self%active_count = 0
      self%free_directions = problem%hessian
      call dpotrf('U', n, self%free_directions, n, info)
      if (info == 0) call dtrtri('U', 'N', n, self%free_directions, n, info)
      positive_definite = info == 0
      do i = 1, n - 1
         self%free_directions(i + 1:, i) = 0.0_dp
      end do
      self%directions = self%free_directions
      if (.not. allocated(self%active)) allocate (self%active(n), self%triangle(n, n))
   end subroutine start

   !> Makes the set from a list, by one factorisation. Constraints that depend on those before them are left out.
   !> `start` must have been called.
   subroutine assign_active(self, problem, list)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: list(:)  !! constraints, each named once

      real(dp) :: columns(size(problem%linear), size(list)), tau(size(list)), size_of(size(list))
      real(dp) :: work(64*size(problem%linear))
      integer :: i, n, k, info
      logical :: added

      n = size(problem%linear)
      k = size(list)
      self%active_count = 0
      self%directions = self%free_directions
      if (k == 0) return

      if (k <= n) then
         call dgemm('T', 'N', n, k, n, 1.0_dp, self%directions, n, problem%normals(:, list), n, 0.0_dp, columns, n)
         do i = 1, k
            size_of(i) = dnrm2(n, columns(:, i), 1)
         end do
         call dgeqrf(n, k, columns, n, tau, work, size(work), info)
         if (all([(abs(columns(i, i)) > dependence*size_of(i), i=1, k)])) then
            call dormqr('R', 'N', n, n, k, columns, n, tau, self%directions, n, work, size(work), info)
            self%triangle(:, :k) = columns
            self%active(:k) = list
            self%active_count = k
            return
         end if
      end if

      do i = 1, k
         call self%add(problem, list(i), added)
      end do
   end subroutine assign_active

   !> Adds a constraint. One that depends on the active ones is not added.
   subroutine add(self, problem, constraint, added)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: constraint
      logical, intent(out) :: added

      real(dp) :: d(size(problem%linear)), v(size(problem%linear)), tau
      integer :: n, k

      n = size(problem%linear)
      k = self%active_count
      added = .false.
      if (k == n) return
      call dgemv('T', n, n, 1.0_dp, self%directions, n, problem%normals(:, constraint), 1, 0.0_dp, d, 1)
      if (dnrm2(n - k, d(k + 1:), 1) <= dependence*dnrm2(n, d, 1)) return

      ! d(k+1:) becomes (beta, v(2:)): the reflection I - tau v v' takes it to beta along the first axis.
      call dlarfg(n - k, d(k + 1), d(k + 2:), 1, tau)
      v(1) = 1.0_dp
      v(2:n - k) = d(k + 2:)
      associate (outside => self%directions(:, k + 1:))
         call reflect(n, n - k, tau, v, outside)
      end associate
      self%triangle(:k + 1, k + 1) = d(:k + 1)
      self%active_count = k + 1
      self%active(k + 1) = constraint
      added = .true.
   end subroutine add

   !> a = a (I - tau v v').
   subroutine reflect(rows, columns, tau, v, a)
      integer, intent(in) :: rows, columns
      real(dp), intent(in) :: tau, v(columns)
      real(dp), intent(inout) :: a(rows, columns)

      real(dp) :: image(rows)

      call dgemv('N', rows, columns, 1.0_dp, a, rows, v, 1, 0.0_dp, image, 1)
      call dger(rows, columns, -tau, image, 1, v, 1, a, rows)
   end subroutine reflect

   !> Removes the constraint at a position of the active list.
   subroutine drop(self, position)
      class(working_set), intent(inout) :: self
      integer, intent(in) :: position  !! 1 .. active_count

      real(dp) :: c, s, r
      integer :: j, n, k

      n = size(self%directions, 1)
      k = self%active_count
      do j = position, k - 1
         self%triangle(:j + 1, j) = self%triangle(:j + 1, j + 1)
         self%active(j) = self%active(j + 1)
      end do
      self%active_count = k - 1
      do j = position, k - 1
         call dlartg(self%triangle(j, j), self%triangle(j + 1, j), c, s, r)
         self%triangle(j, j) = r
         self%triangle(j + 1, j) = 0.0_dp
         if (j < k - 1) call drot(k - 1 - j, self%triangle(j, j + 1), n, self%triangle(j + 1, j + 1), n, c, s)
         call drot(n, self%directions(1, j), 1, self%directions(1, j + 1), 1, c, s)
      end do
   end subroutine drop

   !> The minimiser on the active constraints and their multipliers.
   subroutine solve(self, problem, bounds, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: bounds(:)        !! b of all constraints, shape (m)
      real(dp), intent(out) :: x(:)            !! shape (n)
      real(dp), intent(out) :: multipliers(:)  !! of the active constraints in the order of `active`

      real(dp) :: y(size(x)), image(size(x))
      integer :: n, k

      n = size(x)
      k = self%active_count
      call dgemv('T', n, n, 1.0_dp, self%directions, n, problem%linear, 1, 0.0_dp, image, 1)
      y = image
      y(:k) = bounds(self%active(:k))
      call dtrsv('U', 'T', 'N', k, self%triangle, n, y, 1)
      call dgemv('N', n, n, 1.0_dp, self%directions, n, y, 1, 0.0_dp, x, 1)
      multipliers(:k) = y(:k) - image(:k)
      call dtrsv('U', 'N', 'N', k, self%triangle, n, multipliers, 1)
   end subroutine solve

   !> Rates of change of the minimiser and the multipliers when the bounds move.
   subroutine solve_slope(self, bound_slopes, x_slope, multiplier_slopes)
      class(working_set), intent(in) :: self
      real(dp), intent(in) :: bound_slopes(:)        !! db of all constraints, shape (m)
      real(dp), intent(out) :: x_slope(:)            !! dx, shape (n)
      real(dp), intent(out) :: multiplier_slopes(:)  !! of the active constraints in the order of `active`

      integer :: n, k

      n = size(x_slope)
      k = self%active_count
      multiplier_slopes(:k) = bound_slopes(self%active(:k))
      call dtrsv('U', 'T', 'N', k, self%triangle, n, multiplier_slopes, 1)
      call dgemv('N', n, k, 1.0_dp, self%directions, n, multiplier_slopes, 1, 0.0_dp, x_slope, 1)
      call dtrsv('U', 'N', 'N', k, self%triangle, n, multiplier_slopes, 1)
   end subroutine solve_slope

   !> Weights that build a constraint's gradient from those of the active ones, in the least-squares sense of D^-1.
   subroutine dependence_on_active(self, problem, constraint, weights)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: constraint
      real(dp), intent(out) :: weights(:)  !! in the order of `active`

      integer :: n, k

      n = size(problem%linear)
      k = self%active_count
      call dgemv('T', n, k, 1.0_dp, self%directions, n, problem%normals(:, constraint), 1, 0.0_dp, weights, 1)
      call dtrsv('U', 'N', 'N', k, self%triangle, n, weights, 1)
   end subroutine dependence_on_active

end module wavycon_working_set
