!> Newton's method for the maximum of a smooth field of two variables.
module wavycon_newton_maximiser
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: newton_maximiser

   type, abstract :: newton_maximiser
      real(dp) :: least = -huge(1.0_dp), most = huge(1.0_dp)   !! limits of both variables in the search
   contains
      procedure(expand_at_point), deferred :: expand
      procedure :: maximise
   end type newton_maximiser

   abstract interface
      pure subroutine expand_at_point(self, place, height, gradient, hessian)
         import :: dp, newton_maximiser
         class(newton_maximiser), intent(in) :: self
         real(dp), intent(in) :: place(2)
         real(dp), intent(out) :: height
         real(dp), intent(out) :: gradient(2)   !! by X, Y
         real(dp), intent(out) :: hessian(3)    !! by XX, XY, YY; of one variable by XX, 0, by XX
      end subroutine expand_at_point
   end interface

contains

   !> Climbs from a place to the maximum near it, until a step gains nothing more.
   !>
   !> The Hessian is shifted by its largest eigenvalue, where that is positive, and by a little more, so that each step
   !> goes uphill also near a saddle or on a ridge of constant height. The extra shift shortens the steps: convergence
   !> is linear, by a factor of a thousand a step.
   pure subroutine maximise(self, place, height)
      class(newton_maximiser), intent(in) :: self
      real(dp), intent(inout) :: place(2)
      real(dp), intent(out) :: height     !! there

      integer, parameter :: most_steps = 20
      real(dp), parameter :: shift = 1e-3_dp   ! over the largest second derivative
      real(dp) :: determinant, g(2), h(3), largest, next(2), next_height, scale, step(2)
      integer :: i

      call self%expand(place, height, g, h)
      do i = 1, most_steps
         ! Squares of curvatures may overflow in some units.
         scale = maxval(abs(h))
         if (.not. scale > 0.0_dp) return
         g = g/scale
         h = h/scale
         ! The larger eigenvalue: along a line of equal height it is zero but for rounding.
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
