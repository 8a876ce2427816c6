!> Beale's method for  min 1/2 x'Dx - c'x  subject to  Cx >= b,  D positive definite, b <= 0.
!>
!> E. M. L. Beale, J. R. Statist. Soc. B 17 (1955) 173-184; Naval Res. Logist. Quart. 6 (1959) 227-243.
!>
!> The n non-basic variables are zero: active slacks z >= 0 and variables y that are free of sign. The objective
!> and the basic slacks s = Cx - b are written in them:
!>
!>     F = f + g'z + 1/2 z'Hz + e'y + 1/2 y'y,    s = a + A z + B y.
!>
!> At first all slacks are basic. Free variables with a derivative are changed first (either direction), then an
!> active slack with a negative derivative (it grows), up to the first of two events: (a) a basic slack reaches zero
!> and takes the place of the variable that was changed; (b) the derivative reaches zero: u = dF/dz enters as a
!> new free variable. A free variable that has become basic can never matter again and is dropped.
!>
!> N.B. Two departures from Beale. (1) He changes the free variables one at a time, and couples them again with every
!> exchange. As any combinations of them serve as well, here they are kept conjugate to each other and to the
!> active slacks (hence the plain y'y) by a Householder reflection at each exchange (a), and change together: one
!> step where he takes up to n. An active slack gives way to its u before the step, not after; the path is the same.
!> (2) He carries one table in exact arithmetic. Here the table only finds the set of active constraints: the answer
!> is then solved for from the problem's own data, its Karush-Kuhn-Tucker conditions are checked, and where the
!> table has drifted it is made afresh from that set and the method goes on.
module wavycon_beale
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_kinds, only: dp
   use wavycon_kkt, only: kkt_residual
   use wavycon_lapack, only: dgemm, dgemv, dger, dlarfg, dsyr, dtrtri
   use wavycon_qp_problem, only: qp_problem, qp_solution, &
                                 qp_converged, qp_iteration_limit, qp_infeasible_start, qp_inaccurate, &
                                 qp_not_convex, qp_not_finite
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: solve_by_beale, finish_on_active_set

   !> An answer is accepted when its relative KKT residual is not above this.
   real(dp), parameter, public :: kkt_tolerance = 1e-12_dp

   !> A derivative counts as zero when removing it would lower the objective by less than the square of this
   !> fraction of what the unconstrained minimum does: the rounding of a table just made.
   real(dp), parameter :: derivative_tolerance = 64*epsilon(1.0_dp)
   !> A slack that falls slower than this fraction of the fastest does not stop a step: it depends on active ones.
   real(dp), parameter :: pivot_tolerance = 1e-11_dp
   !> Slacks within this fraction of the first to reach zero tie with it; the fastest of them is taken.
   real(dp), parameter :: tie_tolerance = 1e-13_dp
   !> After so many steps of length zero in a row the least index decides all choices, so that none recurs
   !> (Chang & Cottle, Math. Program. 18 (1980) 127-138), until a step has length again.
   integer, parameter :: patience = 12
   !> The table is compared with the problem after so many pivots times n, and made afresh if it has drifted.
   integer, parameter :: check_interval = 8

   !> The objective and the basic slacks, written in the non-basic variables.
   type :: table_type
      integer :: active_count = 0             !! k, number of active slacks; there are n - k free variables
      integer :: basic_count = 0              !! number of basic slacks
      integer, allocatable :: active(:)       !! constraints of the active slacks, active(1:k)
      integer, allocatable :: basic(:)        !! constraints of the basic slacks, basic(1:basic_count)
      real(dp), allocatable :: gradient(:)    !! (g, e): g(1:k) of the active slacks, then of the free variables
      real(dp), allocatable :: hessian(:, :)  !! H in the upper triangle of hessian(1:k, 1:k)
      real(dp), allocatable :: values(:)      !! a, values(1:basic_count)
      real(dp), allocatable :: rows(:, :)     !! (A, B), shape (m, n): row i of basic slack i, columns as `gradient`
      real(dp) :: zero_descent = 0.0_dp       !! |dF/dz|/sqrt(d2F/dz2) below this is rounding
   end type table_type

contains

   !> Solves the problem. Every outcome is a status; nothing loops for ever.
   subroutine solve_by_beale(problem, solution, pivot_limit)
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(out) :: solution    !! `x`, `active`, `multipliers` are set whatever the status,
                                                    !! but where the problem itself is refused
      integer, intent(in), optional :: pivot_limit  !! > 0; 50 (n + m) if absent

      type(table_type) :: table
      type(working_set) :: set
      integer :: n, m, limit, pivots_before
      logical :: positive_definite, optimal

      n = size(problem%linear)
      m = size(problem%bounds)
      limit = 50*(n + m)
      if (present(pivot_limit)) limit = pivot_limit

      if (.not. (all(ieee_is_finite(problem%hessian)) .and. all(ieee_is_finite(problem%linear)) &
                 .and. all(ieee_is_finite(problem%normals)) .and. all(ieee_is_finite(problem%bounds)))) then
         solution%status = qp_not_finite
         return
      end if
      if (any(problem%bounds > 0.0_dp)) then
         solution%status = qp_infeasible_start
         return
      end if
      call set%start(problem, positive_definite)
      if (.not. positive_definite) then
         solution%status = qp_not_convex
         return
      end if

      call start_table(problem, set, table)
      do
         pivots_before = solution%pivots
         call descend(table, min(limit, pivots_before + check_interval*n), solution%pivots, optimal)
         call set%assign_active(problem, table%active(:table%active_count))
         call finish_on_active_set(problem, set, problem%bounds, solution)
         if (solution%status == qp_converged) return
         ! A table just made that finds nothing to do leaves the digits to the problem's conditioning.
         if (optimal .and. solution%pivots == pivots_before) return
         if (solution%pivots >= limit) exit
         call rebuild_table(problem, set, solution, table)
      end do
      solution%status = qp_iteration_limit
   end subroutine solve_by_beale

   !> Solves for the minimiser on the active constraints of a set and judges it by its KKT residual:
   !> `qp_converged` or `qp_inaccurate`. `pivots` is left as it is.
   subroutine finish_on_active_set(problem, set, bounds, solution)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(in) :: set
      real(dp), intent(in) :: bounds(:)               !! b; may differ from the problem's own
      type(qp_solution), intent(inout) :: solution

      real(dp) :: x(size(problem%linear)), multipliers(size(problem%linear))

      call set%solve(problem, bounds, x, multipliers)
      solution%x = x
      solution%active = set%active(:set%active_count)
      solution%multipliers = multipliers(:set%active_count)
      solution%kkt_residual = kkt_residual(problem, bounds, x, solution%active, solution%multipliers)
      solution%status = merge(qp_converged, qp_inaccurate, solution%kkt_residual <= kkt_tolerance)
   end subroutine finish_on_active_set

   !> The table at x = 0: x = Jy, J'DJ = I.
   subroutine start_table(problem, set, table)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(in) :: set     !! the empty set
      type(table_type), intent(out) :: table

      integer :: i, n, m

      n = size(problem%linear)
      m = size(problem%bounds)
      allocate (table%active(n), table%gradient(n), table%hessian(n, n), table%rows(m, n))
      table%basic = [(i, i=1, m)]
      table%basic_count = m
      table%values = -problem%bounds
      call dgemm('T', 'N', m, n, n, 1.0_dp, problem%normals, n, set%directions, n, 0.0_dp, table%rows, m)
      call dgemv('T', n, n, -1.0_dp, set%directions, n, problem%linear, 1, 0.0_dp, table%gradient, 1)
      table%zero_descent = derivative_tolerance*norm2(table%gradient)
   end subroutine start_table

   !> Changes non-basic variables until none can lower the objective, or, the pivot limit passed, until the free ones
   !> can't: the point is then the minimiser on the active constraints.
   subroutine descend(table, pivot_limit, pivots, optimal)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots
      logical, intent(out) :: optimal  !! false: the pivot limit was reached

      integer :: idle_steps, leaving, released
      real(dp) :: step

      idle_steps = 0
      do
         do while (norm2(table%gradient(table%active_count + 1:)) > table%zero_descent)
            call move_free(table, idle_steps > patience, step, leaving)
            if (leaving == 0) exit
            idle_steps = merge(0, idle_steps + 1, step > 0.0_dp)
            call exchange_with_slack(table, leaving)
            pivots = pivots + 1
         end do
         table%gradient(table%active_count + 1:) = 0.0_dp

         released = steepest_slack(table, idle_steps > patience)
         optimal = released == 0
         if (optimal .or. pivots >= pivot_limit) return
         call exchange_with_derivative(table, released)
         pivots = pivots + 1
      end do
   end subroutine descend

   !> Changes the free variables along their steepest descent to the minimum or to the first slack that vanishes.
   subroutine move_free(table, least_index, step, leaving)
      type(table_type), intent(inout) :: table
      logical, intent(in) :: least_index
      real(dp), intent(out) :: step       !! fraction of the way to the minimum, 0 .. 1
      integer, intent(out) :: leaving     !! the place in `basic` of the slack that vanishes, 0 if none does

      real(dp) :: rates(table%basic_count), slowest, fastest
      integer :: i, k, m, n, free_count

      m = size(table%rows, 1)
      n = size(table%rows, 2)
      k = table%active_count
      free_count = n - k
      associate (values => table%values(:table%basic_count))
         ! The free Hessian is the unit matrix: the way to the minimum is minus the gradient.
         call dgemv('N', table%basic_count, free_count, 1.0_dp, table%rows(:, k + 1:), m, &
                    table%gradient(k + 1:), 1, 0.0_dp, rates, 1)
         slowest = pivot_tolerance*maxval(abs(rates))
         step = 1.0_dp
         do i = 1, table%basic_count
            if (rates(i) > slowest) then
               if (max(values(i), 0.0_dp) < step*rates(i)) step = max(values(i), 0.0_dp)/rates(i)
            end if
         end do

         leaving = 0
         if (step < 1.0_dp) then
            fastest = 0.0_dp
            do i = 1, table%basic_count
               if (rates(i) <= slowest) cycle
               if (values(i) > step*(1.0_dp + tie_tolerance)*rates(i)) cycle
               if (least_index) then
                  if (leaving /= 0) then
                     if (table%basic(i) > table%basic(leaving)) cycle
                  end if
                  leaving = i
               else if (rates(i) > fastest) then
                  leaving = i
                  fastest = rates(i)
               end if
            end do
         end if
         values = values - step*rates
      end associate
      table%gradient(k + 1:) = (1.0_dp - step)*table%gradient(k + 1:)
   end subroutine move_free

   !> The active slack whose growth lowers the objective fastest, measured by |dF/dz|/sqrt(d2F/dz2) so that no unit
   !> matters; 0 if none does.
   pure integer function steepest_slack(table, least_index) result(steepest)
      type(table_type), intent(in) :: table
      logical, intent(in) :: least_index    !! the first constraint that lowers it at all, instead

      real(dp) :: descent, largest
      integer :: i

      steepest = 0
      largest = table%zero_descent
      do i = 1, table%active_count
         if (table%gradient(i) >= 0.0_dp) cycle
         if (table%hessian(i, i) <= 0.0_dp) cycle  ! lost to rounding; a table made afresh will have it
         descent = -table%gradient(i)/sqrt(table%hessian(i, i))
         if (descent <= largest) cycle
         if (least_index) then
            if (steepest /= 0) then
               if (table%active(i) > table%active(steepest)) cycle
            end if
         else
            largest = descent
         end if
         steepest = i
      end do
   end function steepest_slack

   !> Exchange (a): a basic slack that has reached zero becomes active in the place of a free variable.
   subroutine exchange_with_slack(table, leaving)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: leaving   !! place in `basic`

      real(dp) :: row(size(table%gradient)), v(size(table%gradient)), image(table%basic_count), tau, beta
      integer :: k, m, n, last, free_count

      m = size(table%rows, 1)
      n = size(table%rows, 2)
      k = table%active_count
      free_count = n - k
      row = table%rows(leaving, :)

      last = table%basic_count
      table%active(k + 1) = table%basic(leaving)
      table%basic(leaving) = table%basic(last)
      table%values(leaving) = table%values(last)
      table%rows(leaving, :) = table%rows(last, :)
      table%basic_count = last - 1

      ! Turn the free variables so that the slack depends on one of them alone, with the coefficient beta.
      call dlarfg(free_count, row(k + 1), row(k + 2:), 1, tau)
      beta = row(k + 1)
      v(1) = 1.0_dp
      v(2:free_count) = row(k + 2:)
      associate (m_basic => table%basic_count, e => table%gradient(k + 1:))
         call dgemv('N', m_basic, free_count, 1.0_dp, table%rows(:, k + 1:), m, v, 1, 0.0_dp, image, 1)
         call dger(m_basic, free_count, -tau, image, 1, v, 1, table%rows(:, k + 1:), m)
         e = e - tau*dot_product(v(:free_count), e)*v(:free_count)

         ! s = row'z + beta y  gives  y = v'(z, s).
         v(:k) = -row(:k)/beta
         v(k + 1) = 1.0_dp/beta
         call dger(m_basic, k, 1.0_dp, table%rows(:, k + 1), 1, v, 1, table%rows, m)
         table%rows(:m_basic, k + 1) = table%rows(:m_basic, k + 1)/beta
         table%hessian(:k + 1, k + 1) = 0.0_dp
         call dsyr('U', k + 1, 1.0_dp, v, 1, table%hessian, n)
         table%gradient(:k + 1) = [table%gradient(:k), 0.0_dp] + table%gradient(k + 1)*v(:k + 1)
      end associate
      table%active_count = k + 1
   end subroutine exchange_with_slack

   !> Exchange (b): an active slack becomes basic, and the free variable u = dF/dz/sqrt(d2F/dz2) non-basic in its place.
   subroutine exchange_with_derivative(table, released)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: released   !! place in `active`

      real(dp) :: column(table%active_count), curvature
      integer :: k, m, n, name

      m = size(table%rows, 1)
      n = size(table%rows, 2)
      k = table%active_count
      call move_to_last(table, released)
      name = table%active(k)
      curvature = table%hessian(k, k)
      column = table%hessian(:k, k)

      ! sqrt(curvature) z_k = u - column'z/sqrt(curvature), z_k left out of z.
      call dsyr('U', k - 1, -1.0_dp/curvature, column, 1, table%hessian, n)
      table%gradient(:k - 1) = table%gradient(:k - 1) - table%gradient(k)/curvature*column(:k - 1)
      table%gradient(k) = table%gradient(k)/sqrt(curvature)
      call dger(table%basic_count, k - 1, -1.0_dp/curvature, table%rows(:, k), 1, column, 1, table%rows, m)
      table%rows(:table%basic_count, k) = table%rows(:table%basic_count, k)/sqrt(curvature)

      table%active_count = k - 1
      table%basic_count = table%basic_count + 1
      table%basic(table%basic_count) = name
      table%values(table%basic_count) = 0.0_dp
      table%rows(table%basic_count, :k - 1) = -column(:k - 1)/curvature
      table%rows(table%basic_count, k) = 1.0_dp/sqrt(curvature)
      table%rows(table%basic_count, k + 1:) = 0.0_dp
   end subroutine exchange_with_derivative

   !> Changes places of an active slack and the last one.
   subroutine move_to_last(table, place)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: place

      real(dp) :: column(table%basic_count), h_place(table%active_count), h_last(table%active_count)
      integer :: k, names(2)

      k = table%active_count
      if (place == k) return
      names = table%active([place, k])
      table%active([k, place]) = names
      table%gradient([place, k]) = table%gradient([k, place])
      column = table%rows(:table%basic_count, place)
      table%rows(:table%basic_count, place) = table%rows(:table%basic_count, k)
      table%rows(:table%basic_count, k) = column

      associate (h => table%hessian)
         h_place = [h(:place, place), h(place, place + 1:k)]
         h_last = h(:k, k)
         h_place([place, k]) = h_place([k, place])
         h_last([place, k]) = h_last([k, place])
         h(:k, k) = h_place
         h(:place, place) = h_last(:place)
         h(place, place + 1:k) = h_last(place + 1:k)
         h(place, k) = h_last(k)
      end associate
   end subroutine move_to_last

   !> Makes the table afresh at the minimiser on a set of active constraints.
   subroutine rebuild_table(problem, set, solution, table)
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(in) :: set
      type(qp_solution), intent(in) :: solution  !! the minimiser on the set
      type(table_type), intent(inout) :: table

      real(dp) :: inverse(set%active_count, set%active_count)
      real(dp) :: to_x(size(problem%linear), size(problem%linear))
      logical :: is_active(size(problem%bounds))
      integer :: i, n, m, k, info

      n = size(problem%linear)
      m = size(problem%bounds)
      k = set%active_count
      is_active = .false.
      is_active(solution%active) = .true.

      ! x = x_0 + J_1 R^-T z + J_2 y, so that H = R^-1 R^-T.
      inverse = set%triangle(:k, :k)
      do i = 1, k - 1
         inverse(i + 1:, i) = 0.0_dp
      end do
      call dtrtri('U', 'N', k, inverse, max(k, 1), info)
      to_x = set%directions
      call dgemm('N', 'T', n, k, k, 1.0_dp, set%directions, n, inverse, max(k, 1), 0.0_dp, to_x, n)
      call dgemm('N', 'T', k, k, k, 1.0_dp, inverse, max(k, 1), inverse, max(k, 1), 0.0_dp, table%hessian, n)
      table%gradient = 0.0_dp
      table%gradient(:k) = solution%multipliers
      table%active_count = k
      table%active(:k) = solution%active

      table%basic_count = m - k
      table%basic(:m - k) = pack([(i, i=1, m)], .not. is_active)
      associate (normals => problem%normals(:, table%basic(:m - k)))
         table%values(:m - k) = -problem%bounds(table%basic(:m - k))
         call dgemv('T', n, m - k, 1.0_dp, normals, n, solution%x, 1, 1.0_dp, table%values, 1)
         call dgemm('T', 'N', m - k, n, n, 1.0_dp, normals, n, to_x, n, 0.0_dp, table%rows, m)
      end associate
   end subroutine rebuild_table

end module wavycon_beale
