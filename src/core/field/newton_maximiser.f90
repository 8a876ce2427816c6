!> Newton's method for the maximum of a smooth field of two variables.
module wavycon_newton_maximiser
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: newton_maximiser

   !> A field whose maximum is searched; an extension has the field and its derivatives.
   type, abstract :: newton_maximiser
      real(dp) :: least = -huge(1.0_dp), most = huge(1.0_dp)   !! limits of both variables in the search
   contains
      procedure(expand_at_point), deferred :: expand
      procedure :: maximise
   end type newton_maximiser

   abstract interface
      !> `expand`: value and derivatives of the field at a point.
      pure subroutine expand_at_point(self, place, height, gradient, hessian)
         import :: dp, newton_maximiser
         class(newton_maximiser), intent(in) :: self
         real(dp), intent(in) :: place(2)       !! the point (X, Y)
         real(dp), intent(out) :: height        !! value of the field
         real(dp), intent(out) :: gradient(2)   !! first derivatives with respect to X, Y
         !> Second derivatives with respect to XX, XY, YY. For a field of X alone: that of XX, 0, that of XX again.
         real(dp), intent(out) :: hessian(3)
      end subroutine expand_at_point
   end interface

contains

   !> Climbs from a point to a maximum near it. The search ends when a step does not increase the value any more.
   !>
   !> Newton's step leads uphill only if both eigenvalues of the Hessian are negative. So the Hessian is shifted by its
   !> largest eigenvalue, if that is positive, and by a little more. Then each step goes uphill, also near a saddle or
   !> on a ridge of constant height. The additional shift shortens the steps: convergence is linear, and each step
   !> reduces the distance by a factor of about a thousand.
   pure subroutine maximise(self, place, height)
      class(newton_maximiser), intent(in) :: self
      real(dp), intent(inout) :: place(2)   !! (X, Y), on entry the start, on return the maximum
      real(dp), intent(out) :: height       !! value of the field at the maximum

      integer, parameter :: most_steps = 20
      real(dp), parameter :: shift = 1e-3_dp   ! additional shift over the largest second derivative
      real(dp) :: determinant, g(2), h(3), largest, next(2), next_height, step(2), unit
      integer :: i

      call self%expand(place, height, g, h)
      do i = 1, most_steps
         ! All derivatives are divided by the largest second one: otherwise squares might overflow in some units.
         unit = maxval(abs(h))
         if (.not. unit > 0.0_dp) return
         g = g/unit
         h = h/unit
         ! The larger eigenvalue. On a ridge of constant height it is zero but for rounding.
         largest = 0.5_dp*(h(1) + h(3)) + hypot(0.5_dp*(h(1) - h(3)), h(2))
         h([1, 3]) = h([1, 3]) - max(largest, 0.0_dp) - shift
         determinant = h(1)*h(3) - h(2)**2
         if (.not. determinant > 0.0_dp) return
         step = [h(3)*g(1) - h(2)*g(2), h(1)*g(2) - h(2)*g(1)]/determinant
         next = min(max(place - step, self%least), self%most)
         call self%expand(next, next_height, g, h)
         if (.not. next_height > height) return
         place = next
         height = next_height
      end do
   end subroutine maximise

end module wavycon_newton_maximiser
