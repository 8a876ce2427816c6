!> Gauss-Newton's method for the coefficients and the shape of a fitted function.
module wavycon_gauss_newton
   use wavycon_contact_equations, only: contact_equations
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: longest_shape_change
   use wavycon_kinds, only: dp, ieee_is_finite
   use wavycon_lapack, only: dgglse
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: add_step, changes_with_load, least_squares_step, newton_steps

   !> The iteration, and the numbers of its last step.
   type :: newton_steps
      !> Ratio of the shape's changes in two successive steps: on entry to `solve` that of the last degree, on exit that
      !> of this degree.
      real(dp) :: contraction = 0.0_dp
      real(dp) :: change = 0.0_dp
         !! largest change of a coefficient of the shape, before the step is shortened, over b_0 before the step
      real(dp) :: remaining = 0.0_dp      !! estimate of the shape's relative error after the step
      real(dp) :: residual = 0.0_dp       !! largest residual before the step [Delta, for a pool pi E* Delta/s]
      real(dp) :: misfit = 0.0_dp         !! as of least_squares_step
      integer :: iterations = 0           !! number of steps at all degrees
      logical :: valid = .false.          !! whether the step is finite and the new shape is not about to fold
   contains
      procedure :: solve, step
   end type newton_steps

   !> Largest ratio of a step's change to the square of the last change while convergence is quadratic.
   real(dp), parameter, public :: change_per_square = 10.0_dp

   !> Safety limit: the largest number of steps at one degree. The loads of scripts/constants take at most half as many.
   !> At the limit the change of the last step is above the tolerance, and the caller decides whether the solution is of
   !> use.
   integer, parameter :: most_newton_steps = 12
   !> Guard: Jacobian at the centre over b_0^2 below which a shape is rejected and the iteration fails. An ellipse of
   !> 100 to 1 has 0.04, longer ones are not solved for. Only spots far past merging, which would fold, come that low
   !> (a_spot_that_folds_ends_the_search in tests/exact); the quadrature of folding maps grows without end.
   real(dp), parameter :: least_centre_jacobian = 0.04_dp

contains

   !> Iterates until the estimated error of the shape is within a tolerance, or to the limit of steps.
   !>
   !> The error that a step leaves is about its own change times the contraction, which is the ratio of the changes of
   !> two successive steps. After the first step the contraction is that of the last degree. The contraction is taken as
   !> at least that of quadratic convergence.
   subroutine solve(self, equations, lattice, now, tolerance)
      class(newton_steps), intent(inout) :: self
      type(contact_equations), intent(inout) :: equations  !! started for fitted functions like `now`
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(inout) :: now          !! on entry an approximation, on exit the last iterate
      real(dp), intent(in) :: tolerance                    !! largest allowed relative error of the shape, > 0

      real(dp) :: change_before
      integer :: i

      self%change = huge(1.0_dp)
      do i = 1, most_newton_steps
         change_before = self%change
         call self%step(equations, lattice, now)
         self%iterations = self%iterations + 1
         self%remaining = huge(1.0_dp)
         if (.not. self%valid) return
         associate (change => self%change)
            if (i > 1) self%contraction = min(change/max(change_before, tiny(change)), 1.0_dp)
            self%remaining = change*max(self%contraction, min(change, 1.0_dp)*change_per_square)
         end associate
         if (self%remaining <= tolerance) return
      end do
   end subroutine solve

   !> Takes one step, README.md (F40): minimise || residual - matrix*step ||_2. For a spot the step is subject to
   !> load_row*step = missing load, with adhesion to the missing area, (F69). A step whose relative change of the shape
   !> is larger than `longest_shape_change` is shortened to this change.
   subroutine step(self, equations, lattice, now)
      class(newton_steps), intent(inout) :: self
      type(contact_equations), intent(inout) :: equations  !! started for fitted functions like `now`
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(inout) :: now          !! the iterate; unchanged if the step is not finite

      real(dp) :: missing, whole(equations%unknowns)
      logical :: finite

      call equations%linearise(lattice, now)
      self%residual = huge(1.0_dp)
      self%misfit = huge(1.0_dp)
      self%change = huge(1.0_dp)
      self%valid = .false.
      ! LAPACK may not terminate if there is NaN or infinity.
      if (.not. (all(ieee_is_finite(equations%residual)) .and. all(ieee_is_finite(equations%matrix)))) return
      self%residual = maxval(abs(equations%residual))
      if (now%work > 0.0_dp) then
         missing = now%area - now%shape%area()
      else
         missing = now%load*lattice%area - equations%integral(now)
      end if
      call least_squares_step(equations, now, equations%residual, missing, whole, self%misfit, finite)
      if (.not. finite) return
      self%change = maxval(abs(whole(equations%before_shape + 1:)))/now%shape%b(0)
      call add_step(now, min(1.0_dp, longest_shape_change/max(self%change, tiny(1.0_dp)))*whole)
      self%valid = now%shape%b(0) > 0.0_dp &
         .and. now%shape%jacobian((0.0_dp, 0.0_dp)) > least_centre_jacobian*now%shape%b(0)**2
   end subroutine step

   !> The first and second derivatives of the unknowns by the load, at a solution: (I7a), (I7b) of src/beyond/README.md.
   subroutine changes_with_load(equations, lattice, now, change, change_of_change, load_change, finite)
      type(contact_equations), intent(inout) :: equations  !! started for fitted functions like `now`
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now             !! the solution, without adhesion
      real(dp), intent(out) :: change(:), change_of_change(:)   !! x' and x'', shape (unknowns)
      real(dp), intent(out) :: load_change(2)   !! first and second derivative of the integral of p or g
      logical, intent(out) :: finite            !! whether the derivatives are finite; if not they are of no use

      !> Step of P for finite differences, over the smaller of P and the closing pressure less P. The error of the
      !> differences, which is of fourth order, and their rounding are about 1e-11.
      real(dp), parameter :: part = 1e-3_dp
      !> Weights in the finite difference of the solutions one step and two steps away.
      real(dp), parameter :: weight(2) = [2.0_dp/3, -1.0_dp/12]
      type(contact_equations) :: moved     ! the equations at the solution moved along x' by some steps of the load
      type(fitted_function) :: other
      real(dp) :: misfit, right(size(equations%residual)), row_change, step
      integer :: i

      call equations%linearise(lattice, now)
      finite = all(ieee_is_finite(equations%matrix))
      if (.not. finite) return
      right = merge(1.0_dp, 0.0_dp, now%pool)
      call least_squares_step(equations, now, right, lattice%area, change, misfit, finite)
      if (.not. finite) return
      step = part*min(now%load, lattice%closing_pressure - now%load)
      moved = equations
      right = 0.0_dp
      row_change = 0.0_dp
      do i = -2, 2
         if (i == 0) cycle
         other = now
         call add_step(other, i*step*change)
         call moved%linearise(lattice, other)
         associate (factor => sign(weight(abs(i)), weight(abs(i))*i)/step)
            right = right - factor*matmul(moved%matrix, change)
            row_change = row_change + factor*dot_product(moved%load_row, change)
         end associate
      end do
      finite = all(ieee_is_finite(right))
      if (.not. finite) return
      call least_squares_step(equations, now, right, -row_change, change_of_change, misfit, finite)
      load_change = [dot_product(equations%load_row, change), &
                     dot_product(equations%load_row, change_of_change) + row_change]
   end subroutine changes_with_load

   !> Adds a step to the unknowns of a fitted function: coefficients, approach or load, and shape.
   pure subroutine add_step(now, step)
      type(fitted_function), intent(inout) :: now
      real(dp), intent(in) :: step(:)                      !! shape (unknowns of its equations)

      associate (terms => now%basis%terms, first => size(step) - size(now%shape%b) + 1)
         now%c = now%c + step(:terms)
         if (.not. now%pool) now%approach = now%approach + step(terms + 1)
         if (now%pool .and. now%work > 0.0_dp) now%load = now%load + step(terms + 1)
         now%shape%b = now%shape%b + step(first:)
      end associate
   end subroutine add_step

   !> Solves the linear least-squares problem of a step, with the constraint of load or area, by LAPACK's DGGLSE.
   subroutine least_squares_step(equations, now, right_sides, missing, step, misfit, finite)
      type(contact_equations), intent(in) :: equations
      type(fitted_function), intent(in) :: now
      real(dp), intent(in) :: right_sides(:)     !! changes of the left sides that the step shall make, shape (m + e)
      real(dp), intent(in) :: missing
         !! the constraint's right side: change of a spot's load times the cell's area, or, with adhesion, of the area
      real(dp), intent(out) :: step(:)           !! shape (unknowns)
      real(dp), intent(out) :: misfit
         !! root of the sum of squared residuals that the step leaves, over the number of equations in excess of
         !! unknowns
      logical, intent(out) :: finite             !! whether there is a finite solution; if not the step is of no use

      !> Number of columns that LAPACK treats together. This number times the sizes is enough work space.
      integer, parameter :: block = 64
      ! Copies of the arguments that LAPACK overwrites.
      real(dp) :: constraint(1, size(step)), left(size(right_sides)), right(1)
      real(dp), allocatable :: matrix(:, :)
      real(dp) :: work(block*(size(left) + size(step) + 1))
      integer :: beyond, info, m, n

      m = size(left)
      n = size(step)
      beyond = m - n + equations%constraints
      constraint(1, :) = equations%load_row
      if (now%work > 0.0_dp) then
         constraint = 0.0_dp
         call now%shape%linearise_area(constraint(1, equations%before_shape + 1:))
      end if
      right = missing
      left = right_sides
      allocate (matrix, source=equations%matrix)
      call dgglse(m, n, equations%constraints, matrix, m, constraint, 1, left, right, step, work, size(work), info)
      ! The last components of the right side, as LAPACK returns it, are those that no step can remove.
      misfit = norm2(left(m - beyond + 1:))/sqrt(real(beyond, dp))
      finite = info == 0
      if (finite) finite = maxval(abs(step)) < huge(1.0_dp)
   end subroutine least_squares_step

end module wavycon_gauss_newton
