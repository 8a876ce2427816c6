!> Beale's table: the objective and the basic slacks of a quadratic programme in terms of its non-basic variables, and
!> the two exchanges of variables. Numbers (Q..) are the equations of README.md in this directory.
!>
!> The non-basic variables are active slacks z >= 0 and variables y that are free of sign. At the table's point all
!> of them are zero, and (Q6), (Q7)
!>
!>     F = f + g'z + 1/2 z'Hz + e'y + 1/2 y'y,    s = a + A z + B y.
!>
!> N.B. Each exchange (b) adds one of Beale's free variables, and each exchange (a) couples them again. Any basis of
!> the same space serves as well. Here the free variables are kept conjugate, to each other and to the active slacks
!> (hence the plain y'y), by a Householder reflection in exchange (a), so that all can be changed together. A free
!> variable that becomes basic never limits a step and is dropped, as in Beale's method.
module wavycon_beale_table
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv, dger, dlarfg, dsyr, dtrsm
   use wavycon_qp_problem, only: qp_problem
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: table_type

   !> A derivative counts as zero if it is less than this fraction of that at x = 0, both over the root of the second
   !> derivative: the rounding of a table just made.
   real(dp), parameter :: derivative_tolerance = 64*epsilon(1.0_dp)

   !> An exchange must leave this fraction of each diagonal element of H: with less, too few of its digits are left.
   real(dp), parameter :: least_remainder = 1e-10_dp

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
      logical :: drifted = .false.            !! an exchange was refused as it would lose digits
   contains
      procedure :: start
      procedure :: steepest_slack
      procedure :: free_rates
      procedure :: exchange_with_slack
      procedure :: exchange_with_derivative
   end type table_type

contains

   !> The table at x = 0, (Q8): x = U^-1 y.
   subroutine start(table, problem, set)
      class(table_type), intent(out) :: table
      type(qp_problem), intent(in) :: problem
      type(working_set), intent(in) :: set     !! the empty set

      integer :: i, n, m

      n = size(problem%linear)
      m = size(problem%bounds)
      allocate (table%active(n), table%hessian(n, n))
      table%basic = [(i, i=1, m)]
      table%basic_count = m
      table%values = -problem%bounds
      table%rows = transpose(problem%normals)
      call dtrsm('R', 'U', 'N', 'N', m, n, 1.0_dp, set%root, n, table%rows, max(1, m))
      table%gradient = -set%scaled(problem%linear)
      table%zero_descent = derivative_tolerance*norm2(table%gradient)
   end subroutine start

   !> The active slack whose growth lowers the objective most, measured by |dF/dz|/sqrt(d2F/dz2), which has no unit of
   !> z; 0 if there is none.
   pure integer function steepest_slack(table, least_index) result(steepest)
      class(table_type), intent(in) :: table
      logical, intent(in) :: least_index    !! take the first constraint that lowers it at all instead

      real(dp) :: descent, largest
      integer :: i

      steepest = 0
      largest = table%zero_descent
      do i = 1, table%active_count
         if (table%gradient(i) >= 0.0_dp) cycle
         if (table%hessian(i, i) <= 0.0_dp) cycle  ! rounding only; positive in a table made afresh
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

   !> The rates of the basic slacks when the free variables change along a direction.
   subroutine free_rates(table, direction, rates)
      class(table_type), intent(in) :: table
      real(dp), intent(in) :: direction(:)  !! shape (n - k)
      real(dp), intent(out) :: rates(:)     !! shape (basic_count)

      integer :: m, n, k

      m = max(1, size(table%rows, 1))
      n = size(table%rows, 2)
      k = table%active_count
      if (k == n) then
         rates = 0.0_dp
      else
         call dgemv('N', table%basic_count, n - k, 1.0_dp, table%rows(:, k + 1:), m, direction, 1, 0.0_dp, rates, 1)
      end if
   end subroutine free_rates

   !> Exchange (a), (Q9): a basic slack that has reached zero becomes active in the place of a free variable.
   subroutine exchange_with_slack(table, leaving)
      class(table_type), intent(inout) :: table
      integer, intent(in) :: leaving   !! place in `basic`

      real(dp) :: row(size(table%gradient)), v(size(table%gradient)), image(table%basic_count), tau, beta
      integer :: k, m, n, last, free_count

      m = max(1, size(table%rows, 1))
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

      ! Reflect the free variables so that the slack depends on the first of them alone, with the coefficient beta.
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

   !> Exchange (b), (Q10): an active slack becomes basic, and a free variable, the change of dF/dz/sqrt(d2F/dz2), takes
   !> its place. Where that would lose too many digits nothing is exchanged and `drifted` is set.
   subroutine exchange_with_derivative(table, released)
      class(table_type), intent(inout) :: table
      integer, intent(in) :: released   !! place in `active`

      real(dp) :: column(table%active_count), curvature
      integer :: i, k, m, n, name

      m = max(1, size(table%rows, 1))
      n = size(table%rows, 2)
      k = table%active_count
      call move_to_last(table, released)
      name = table%active(k)
      curvature = table%hessian(k, k)
      column = table%hessian(:k, k)

      table%drifted = table%drifted .or. curvature <= 0.0_dp
      do i = 1, k - 1
         if (table%drifted) exit
         table%drifted = table%hessian(i, i) - column(i)*(column(i)/curvature) < least_remainder*table%hessian(i, i)
      end do
      if (table%drifted) return

      ! sqrt(curvature) z_k = u - column'z/sqrt(curvature), where z is without z_k.
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

   !> Swaps an active slack with the last one.
   subroutine move_to_last(table, place)
      class(table_type), intent(inout) :: table
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

end module wavycon_beale_table
