!> The minimum on a set of active constraints taken as equations, by factorisations.
!>
!> For the active rows C_W the factorisation is  D = U^2,  U^-1 C_W' = QR,  Q'Q = I of k columns, R upper triangular
!> (Q4). With x = U^-1 xi the minimum on C_W x = b_W is (Q5)
!>
!>     v = R^-T b_W - Q'U^-1 c,   xi = U^-1 c + Qv,   multipliers = R^-1 v.
!>
!> A constraint is added by Gram-Schmidt's method with reorthogonalisation and removed by rotations, without a new
!> factorisation (Daniel, Gragg, Kaufman & Stewart, Math. Comp. 30 (1976) 772-795). Numbers (Q..) are the equations of
!> README.md in this directory.
module wavycon_working_set
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: ddot, dgemv, drot, dtrsv
   use wavycon_qp_problem, only: kkt_residual, kkt_tolerance, qp_converged, qp_inaccurate, qp_problem, qp_solution
   implicit none (type, external)
   private

   public :: working_set

   !> A constraint counts as dependent on other active ones if the part of its normal outside their span is less than
   !> this fraction of it: such a part is rounding.
   real(dp), parameter, public :: dependence = 1e-13_dp
   !> A vector is projected once if this part of its square remains [DGKS]. With 1e-4 so much orthogonality is lost that
   !> the pass finds n + 1 independent constraints.
   real(dp), parameter :: square_kept = 0.5_dp

   type :: working_set
      integer :: count = 0                           !! k
      integer, allocatable :: active(:)              !! the active constraints, active(:k), shape (n)
      real(dp), allocatable :: span(:, :)            !! Q in span(:, :k), shape (n, n)
      real(dp), allocatable :: triangle(:, :)        !! R in the upper triangle of triangle(:k, :k), shape (n, n)
      real(dp), allocatable :: inverse(:)            !! U^-1, the factor of normals and unknowns, shape (n)
   contains
      procedure :: start, assign_active, split, add, remove, solve, refresh, check
   end type working_set

contains

   !> The empty set of active constraints.
   subroutine start(self, problem)
      class(working_set), intent(out) :: self
      type(qp_problem), intent(in) :: problem

      associate (n => size(problem%linear))
         allocate (self%active(n), self%triangle(n, n), self%span(n, n))
      end associate
      self%inverse = 1.0_dp/sqrt(problem%hessian)
   end subroutine start

   !> Factorises a set of active constraints (Q4), without those that depend on the others and without the rounding of
   !> past changes. `start` comes first.
   subroutine assign_active(self, problem, list)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: list(:)  !! constraints, each once

      real(dp) :: components(size(self%active)), normal(size(self%active)), rest(size(self%active))
      integer :: i

      self%count = 0
      do i = 1, size(list)
         if (self%count == size(self%active)) exit
         normal = self%inverse*problem%normals(:, list(i))
         rest = normal
         call self%split(rest, components(:self%count))
         if (norm2(rest) > dependence*norm2(normal)) call self%add(list(i), components(:self%count), rest)
      end do
   end subroutine assign_active

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
      real(dp), intent(in) :: components(:), rest(:)   !! U^-1 C_i' split, shapes (k) and (n)

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
   !> One step of refinement removes what the factors have lost by past changes, and what cancels in (Q5) where x is
   !> much smaller than the minimum without constraints.
   subroutine solve(self, problem, x, multipliers)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      real(dp), intent(out), contiguous :: x(:)            !! shape (n)
      real(dp), intent(out), contiguous :: multipliers(:)  !! y of the active constraints in their order, shape (k)

      real(dp) :: forces(size(x)), gap(size(multipliers)), x_change(size(x)), change(size(multipliers))
      integer :: i

      call solve_equations(self, problem%linear, problem%bounds(self%active(:self%count)), x, multipliers)
      forces = problem%linear - problem%hessian*x
      do i = 1, size(multipliers)
         associate (normal => problem%normals(:, self%active(i)))
            forces = forces + multipliers(i)*normal
            gap(i) = problem%bounds(self%active(i)) - dot_product(x, normal)
         end associate
      end do
      call solve_equations(self, forces, gap, x_change, change)
      x = x + x_change
      multipliers = multipliers + change
   end subroutine solve

   !> Factorises the active constraints afresh.
   subroutine refresh(self, problem)
      class(working_set), intent(inout) :: self
      type(qp_problem), intent(in) :: problem

      integer :: list(self%count)

      list = self%active(:self%count)
      call self%assign_active(problem, list)
   end subroutine refresh

   !> Computes the minimum on the active constraints (Q5) and its KKT residual (Q3). The status is `qp_converged` if the
   !> residual is within `kkt_tolerance`, otherwise `qp_inaccurate`.
   subroutine check(self, problem, solution)
      class(working_set), intent(in) :: self
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(inout) :: solution   !! all but `pivots` is set

      if (allocated(solution%x)) deallocate (solution%x, solution%active, solution%multipliers)
      allocate (solution%x(size(problem%linear)), solution%multipliers(self%count))
      allocate (solution%active, source=self%active(:self%count))
      call self%solve(problem, solution%x, solution%multipliers)
      solution%kkt_residual = kkt_residual(problem, solution%x, solution%active, solution%multipliers)
      solution%status = qp_inaccurate
      if (solution%kkt_residual <= kkt_tolerance) solution%status = qp_converged
   end subroutine check

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
      x = self%inverse*linear
      if (k > 0) then
         call dgemv('T', n, k, 1.0_dp, self%span, n, x, 1, 0.0_dp, components, 1)
         ! If k = n the constraints alone determine x, which may be many orders smaller than U^-1 c.
         if (k == n) x = 0.0_dp
         multipliers = bounds
         call dtrsv('U', 'T', 'N', k, self%triangle, n, multipliers, 1)
         if (k < n) multipliers = multipliers - components
         call dgemv('N', n, k, 1.0_dp, self%span, n, multipliers, 1, 1.0_dp, x, 1)
         if (k == n) multipliers = multipliers - components
         call dtrsv('U', 'N', 'N', k, self%triangle, n, multipliers, 1)
      end if
      x = self%inverse*x
   end subroutine solve_equations

end module wavycon_working_set
