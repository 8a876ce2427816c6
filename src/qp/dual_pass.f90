!> From the solution of one quadratic programme to that of another that differs in its bounds alone.
!>
!> The solution is a piecewise linear function of the bounds. With the same active constraints some multipliers may
!> become negative, and some slacks. The constraints of such multipliers are released. Then violated constraints are
!> made active one by one, while no multiplier may change sign: the dual method of Goldfarb & Idnani (Math. Program.
!> 27 (1983) 1-33) on Beale's table, with his two exchanges. Equations (Q11), (Q12) of README.md in this directory.
!> Beale's method keeps the slacks >= 0 and lowers the objective; the dual method keeps the multipliers >= 0 and
!> raises it. Each full step raises it strictly, and between two of them the active set shrinks, so the method ends.
module wavycon_dual_pass
   use wavycon_beale_table, only: table_type
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_converged, qp_infeasible, qp_iteration_limit
   implicit none (type, external)
   private

   public :: restore_optimum

   !> A negative slack smaller than this fraction of the largest slack is rounding.
   real(dp), parameter :: zero_slack = 32*epsilon(1.0_dp)
   !> An element of a row that is smaller than this fraction of its norm is rounding. A constraint with no larger
   !> elements in the free variables depends on the active ones.
   real(dp), parameter :: zero_element = 1e-13_dp

contains

   !> Makes a table optimal whose free variables are at their minimum. Returns at once if the table drifts: it is then
   !> to be made afresh from its active constraints.
   subroutine restore_optimum(table, pivot_limit, pivots, status)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots   !! exchanges, counted up
      integer, intent(out) :: status     !! qp_converged, qp_infeasible, qp_iteration_limit

      real(dp) :: zero
      integer :: violated, released

      status = qp_converged
      do
         released = table%steepest_slack(.false.)
         if (released == 0) exit
         call table%exchange_with_derivative(released)
         if (table%drifted) return
         call table%move_to_minimum()
         pivots = pivots + 1
      end do
      where (table%gradient(:table%active_count) < 0.0_dp) table%gradient(:table%active_count) = 0.0_dp

      do
         zero = zero_slack*maxval(abs(table%values(:table%basic_count)))
         violated = minloc(table%values(:table%basic_count), dim=1)
         status = qp_converged
         if (violated == 0) return
         if (table%values(violated) >= -zero) return
         call make_active(table, table%basic(violated), pivot_limit, pivots, status)
         if (status /= qp_converged .or. table%drifted) return
      end do
   end subroutine restore_optimum

   !> Raises the multiplier of a violated constraint until its slack is zero (Q12). Active constraints whose multipliers
   !> vanish before are released.
   subroutine make_active(table, constraint, pivot_limit, pivots, status)
      type(table_type), intent(inout) :: table
      integer, intent(in) :: constraint
      integer, intent(in) :: pivot_limit
      integer, intent(inout) :: pivots
      integer, intent(out) :: status

      real(dp) :: row(size(table%gradient)), rates(table%basic_count + size(table%gradient))
      real(dp) :: multiplier, full_step, step, stiffness, zero
      integer :: place, released, i, k

      ! With the multiplier mu of s = a + A z + B y the free variables are at y = mu B', where their derivative is
      ! mu B', and the multipliers of the active slacks are g - mu A'.
      multiplier = 0.0_dp
      do
         status = qp_iteration_limit
         if (pivots >= pivot_limit) return

         k = table%active_count
         place = findloc(table%basic(:table%basic_count), constraint, dim=1)
         row = table%rows(place, :)
         stiffness = dot_product(row(k + 1:), row(k + 1:))
         zero = zero_element*norm2(row)
         full_step = huge(full_step)
         if (sqrt(stiffness) > zero) full_step = -table%values(place)/stiffness

         step = full_step
         released = 0
         do i = 1, k
            if (row(i) <= zero) cycle
            if (table%gradient(i)/row(i) - multiplier < step) then
               step = max(table%gradient(i)/row(i) - multiplier, 0.0_dp)
               released = i
            end if
         end do
         status = qp_infeasible
         if (step >= huge(step)) then
            table%excluded = constraint
            table%weights = max(-row(:k), 0.0_dp)
            return
         end if

         multiplier = multiplier + step
         table%gradient(k + 1:) = table%gradient(k + 1:) + step*row(k + 1:)
         associate (r => rates(:table%basic_count), values => table%values(:table%basic_count))
            call table%free_rates(row(k + 1:), r)
            values = values + step*r
         end associate
         pivots = pivots + 1
         if (released == 0) exit
         call table%exchange_with_derivative(released)
         status = qp_converged
         if (table%drifted) return
      end do
      table%values(place) = 0.0_dp
      call table%exchange_with_slack(place)
      status = qp_converged
   end subroutine make_active

end module wavycon_dual_pass
