!> The minimum on a set of active constraints taken as equations, by factorisations of LAPACK.
!>
!> For the active rows C_W the factorisation is  D = U'U,  U^-T C_W' = QR,  Q'Q = I of k columns, R upper triangular
!> (Q4). With x = U^-1 w the minimum on C_W x = b_W is (Q5)
!>
!>     v = R^-T b_W - Q'U^-T c,   w = U^-T c + Qv,   multipliers = R^-1 v.
!>
!> A constraint is added by Gram-Schmidt's method with reorthogonalisation and removed by rotations, without a new
!> factorisation (Daniel, Gragg, Kaufman & Stewart, Math. Comp. 30 (1976) 772-795). Numbers (Q..) are the equations of
!> README.md in this directory.
module wavycon_working_set
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: ddot, dgemv, dgeqp3, dorgqr, dpotrf, drot, dsymv, dtrsm, dtrsv
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: working_set

   !> A constraint counts as dependent on other active ones if the part of its normal outside their span is less than
   !> this fraction of it: such a part is rounding.
   real(dp), parameter :: dependence = 1e-13_dp
   !> A vector is projected once if this part of its square remains [DGKS]. With 1e-4 so much orthogonality is lost that
   !> the pass finds n + 1 independent constraints.
   real(dp), parameter :: square_kept = 0.5_dp
   !> The kind of extended residuals: quadruple precision where the compiler has it.
   integer, parameter :: long = merge(selected_real_kind(30), dp, selected_real_kind(30) > 0)
   !> Refinement ends earlier, when a step is more than half of the one before: no digits are left to gain.
   integer, parameter :: most_refinements = 10

   type :: working_set
      integer :: count = 0                           !! k
      integer, allocatable :: active(:)              !! the active constraints, active(:k), shape (n)
      real(dp), allocatable :: span(:, :)            !! Q in span(:, :k), shape (n, n)
      real(dp), allocatable :: triangle(:, :)        !! R in the upper triangle of triangle(:k, :k), shape (n, n)
      real(dp), allocatable :: root(:, :)            !! U in the upper triangle, shape (n, n)
      real(dp), allocatable :: inverse(:)            !! U^-1, if it is diagonal, shape (n)
      real(dp) :: inverse_size = 0.0_dp              !! estimate of |U^-1|: one over the least diagonal element
      logical :: extended_residuals = .false.        !! whether `solve` refines with residuals of the kind `long`
   contains
      procedure :: start
      procedure :: assign_active
      procedure :: factorise_afresh
      procedure :: scaled
      procedure :: unscale
      procedure :: split
      procedure :: add
      procedure :: remove
      procedure :: solve
   end type working_set

contains

   !> Factorises D for the empty set of active constraints.
   subroutine start(self, problem, positive_definite)
      class(working_set), intent(out) :: self
      type(qp_problem), intent(in) :: problem
      logical, intent(out) :: positive_definite  !! false: D is not, and the set cannot be used

      integer :: i, n, info
      logical :: diagonal

      n = size(problem%linear)
      allocate (self%active(n), self%triangle(n, n), self%span(n, n))
      self%root = problem%hessian
      diagonal = .true.
      do i = 2, n
         diagonal = diagonal .and. all(abs(self%root(:i - 1, i)) <= 0.0_dp)
      end do
      if (diagonal) then
         info = count([(self%root(i, i) <= 0.0_dp, i=1, n)])
         do i = 1, n
            self%root(i, i) = sqrt(max(self%root(i, i), 0.0_dp))
         end do
      else
         call dpotrf('U', n, self%root, n, info)
      end if
      positive_definite = info == 0
      if (.not. positive_definite) return
      self%inverse_size = 1.0_dp/minval([(self%root(i, i), i=1, n)])
      if (diagonal) self%inverse = [(1.0_dp/self%root(i, i), i=1, n)]
   end subroutine start

   !> Factorises a set of active constraints (Q4), without those that depend on the others. `start` comes first.
   subroutine assign_active(self, problem, list)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: list(:)  !! constraints, each once

      real(dp) :: columns(size(problem%linear), size(list))
      real(dp) :: tau(size(list)), size_of(size(list)), work(64*(size(problem%linear) + size(list) + 1))
      integer :: order(size(list))
      integer :: i, n, k, info

      n = size(problem%linear)
      columns = problem%normals(:, list)
      call dtrsm('L', 'U', 'T', 'N', n, size(list), 1.0_dp, self%root, n, columns, n)
      size_of = norm2(columns, dim=1)
      order = 0
      call dgeqp3(n, size(list), columns, n, order, tau, work, size(work), info)
      k = 0
      do i = 1, min(n, size(list))
         if (abs(columns(i, i)) <= dependence*size_of(order(i))) exit
         k = i
      end do

      self%count = k
      self%active(:k) = list(order(:k))
      do i = 1, k
         self%triangle(:i, i) = columns(:i, i)
      end do
      call dorgqr(n, k, k, columns, n, tau, work, size(work), info)
      self%span(:, :k) = columns(:, :k)
   end subroutine assign_active

   !> Factorises the active constraints anew, without the rounding of past changes.
   subroutine factorise_afresh(self, problem)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem

      integer :: list(self%count)

      list = self%active(:self%count)
      call self%assign_active(problem, list)
   end subroutine factorise_afresh

   !> U^-T v of a normal or another gradient v.
   function scaled(self, v) result(w)
      class(working_set), intent(in) :: self
      real(dp), intent(in) :: v(:)   !! shape (n)
      real(dp) :: w(size(v))

      if (allocated(self%inverse)) then
         w = self%inverse*v
      else
         w = v
         call dtrsv('U', 'T', 'N', size(v), self%root, size(v), w, 1)
      end if
   end function scaled

   !> x = U^-1 w, in place.
   subroutine unscale(self, x)
      class(working_set), intent(in) :: self
      real(dp), intent(inout), contiguous :: x(:)   !! w on entry, shape (n)

      if (allocated(self%inverse)) then
         x = self%inverse*x
      else
         call dtrsv('U', 'N', 'N', size(x), self%root, size(x), x, 1)
      end if
   end subroutine unscale

   !> Splits a vector w into Q components + rest, the rest orthogonal to Q to rounding: where it is much shorter than w
   !> it is projected again.
   subroutine split(self, w, components)
      class(working_set), intent(in) :: self
      real(dp), intent(inout), contiguous :: w(:)          !! on return the rest, shape (n)
      real(dp), intent(out), contiguous :: components(:)   !! shape (k)

      real(dp) :: again(self%count), square
      integer :: n, k

      n = size(w)
      k = self%count
      if (k == 0) return
      square = ddot(n, w, 1, w, 1)
      call dgemv('T', n, k, 1.0_dp, self%span, n, w, 1, 0.0_dp, components, 1)
      call dgemv('N', n, k, -1.0_dp, self%span, n, components, 1, 1.0_dp, w, 1)
      if (ddot(n, w, 1, w, 1) > square_kept*square) return
      call dgemv('T', n, k, 1.0_dp, self%span, n, w, 1, 0.0_dp, again, 1)
      call dgemv('N', n, k, -1.0_dp, self%span, n, again, 1, 1.0_dp, w, 1)
      components = components + again
   end subroutine split

   !> Adds a constraint that does not depend on the active ones.
   subroutine add(self, constraint, components, rest)
      class(working_set), intent(inout) :: self
      integer, intent(in) :: constraint
      real(dp), intent(in) :: components(:), rest(:)   !! U^-T C_i' split, shapes (k) and (n)

      integer :: k
      real(dp) :: length

      k = self%count
      length = sqrt(dot_product(rest, rest))
      self%span(:, k + 1) = rest/length
      self%triangle(:k, k + 1) = components
      self%triangle(k + 1, k + 1) = length
      self%active(k + 1) = constraint
      self%count = k + 1
   end subroutine add

   !> Removes an active constraint. Rotations of neighbouring columns of Q restore the triangle.
   subroutine remove(self, place, components, rest)
      class(working_set), intent(inout) :: self
      integer, intent(in) :: place                         !! in `active`
      !> A vector that is split, shapes (k) and (n). On return it is split with respect to the smaller set, in the first
      !> k - 1 components.
      real(dp), intent(inout), optional, contiguous :: components(:), rest(:)

      real(dp) :: cosine, sine, radius
      integer :: i, k, n

      n = size(self%active)
      k = self%count
      do i = place, k - 1
         self%active(i) = self%active(i + 1)
         self%triangle(:i + 1, i) = self%triangle(:i + 1, i + 1)
      end do
      do i = place, k - 1
         radius = sqrt(self%triangle(i, i)**2 + self%triangle(i + 1, i)**2)
         cosine = self%triangle(i, i)/radius
         sine = self%triangle(i + 1, i)/radius
         self%triangle(i, i) = radius
         if (i < k - 1) call drot(k - 1 - i, self%triangle(i, i + 1), n, self%triangle(i + 1, i + 1), n, cosine, sine)
         call drot(n, self%span(1, i), 1, self%span(1, i + 1), 1, cosine, sine)
         if (.not. present(components)) cycle
         components(i:i + 1) = [cosine*components(i) + sine*components(i + 1), &
                                cosine*components(i + 1) - sine*components(i)]
      end do
      if (present(rest)) rest = rest + components(k)*self%span(:, k)
      self%count = k - 1
   end subroutine remove

   !> The minimum on the active constraints and their multipliers (Q5).
   !>
   subroutine solve(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(out), contiguous :: x(:)            !! shape (n)
      real(dp), intent(out), contiguous :: multipliers(:)  !! y of the active constraints in their order, shape (k)

      call solve_equations(self, problem%linear, problem%bounds(self%active(:self%count)), x, multipliers)
      if (self%extended_residuals) then
         call refine(self, problem, x, multipliers)
      else
         call correct(self, problem, x, multipliers)
      end if
   end subroutine solve

   !> One step of refinement with residuals in working precision: it removes what the factors have lost by past changes,
   !> and what cancels in (Q5) where x is much smaller than the minimum without constraints.
   subroutine correct(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(inout), contiguous :: x(:), multipliers(:)

      real(dp) :: forces(size(x)), gap(size(multipliers)), x_change(size(x)), change(size(multipliers))
      integer :: i

      forces = problem%linear
      call dsymv('U', size(x), -1.0_dp, problem%hessian, size(x), x, 1, 1.0_dp, forces, 1)
      do i = 1, size(multipliers)
         associate (normal => problem%normals(:, self%active(i)))
            forces = forces + multipliers(i)*normal
            gap(i) = problem%bounds(self%active(i)) - dot_product(x, normal)
         end associate
      end do
      call solve_equations(self, forces, gap, x_change, change)
      x = x + x_change
      multipliers = multipliers + change
   end subroutine correct

   !> Iterative refinement (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., chapter 12): the residuals
   !> of the equations are computed from D, c, C and b with more digits, and solved for, while the steps get shorter.
   subroutine refine(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(inout), contiguous :: x(:), multipliers(:)

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
      real(dp), intent(out), contiguous :: x(:)            !! shape (n)
      real(dp), intent(out), contiguous :: multipliers(:)  !! y, shape (k)

      real(dp) :: components(size(multipliers))
      integer :: n, k

      n = size(x)
      k = self%count
      x = self%scaled(linear)
      if (k > 0) then
         call dgemv('T', n, k, 1.0_dp, self%span, n, x, 1, 0.0_dp, components, 1)
         multipliers = bounds
         call dtrsv('U', 'T', 'N', k, self%triangle, n, multipliers, 1)
         if (k < n) then
            multipliers = multipliers - components
            call dgemv('N', n, k, 1.0_dp, self%span, n, multipliers, 1, 1.0_dp, x, 1)
         else
            ! The constraints alone determine x, which may be many orders smaller than U^-T c.
            call dgemv('N', n, k, 1.0_dp, self%span, n, multipliers, 1, 0.0_dp, x, 1)
            multipliers = multipliers - components
         end if
         call dtrsv('U', 'N', 'N', k, self%triangle, n, multipliers, 1)
      end if
      call self%unscale(x)
   end subroutine solve_equations

end module wavycon_working_set
