!> A paraboloid below a height map. The map has the angles 0 <= X, Y <= pi, and its centre is that of the paraboloid.
module wavycon_paraboloid
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: paraboloid

   !> The gap c(1) (X - pi/2)^2 + c(2) (Y - pi/2)^2, less its mean over the map.
   type :: paraboloid
      real(dp) :: c(2) = 0.0_dp   !! coefficients, as part of a surface in Delta, >= 0
   contains
      procedure :: is_flat, gap, subtract_from
   end type paraboloid

contains

   !> Whether there is no paraboloid.
   pure logical function is_flat(self)
      class(paraboloid), intent(in) :: self

      is_flat = all(self%c <= 0.0_dp)
   end function is_flat

   !> The gap at a point, less its mean over the map.
   elemental real(dp) function gap(self, x, y)
      class(paraboloid), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad], also outside of the map

      gap = 0.0_dp
      if (self%is_flat()) return
      ! Angles beyond the map are replaced by their mirror images within it.
      gap = sum(self%c*((0.5_dp*pi - abs(pi - modulo([x, y], 2*pi)))**2 - pi**2/12))
   end function gap

   !> Subtracts the gap, as of `gap`, from a field at equidistant points.
   pure subroutine subtract_from(self, field, first, step)
      class(paraboloid), intent(in) :: self
      real(dp), intent(inout) :: field(:, :)      !! values at the points, shape (M, N)
      real(dp), intent(in) :: first(2), step(2)   !! X, Y of the first point; steps along X and Y [rad]

      integer :: i, j

      if (self%is_flat()) return
      do j = 1, size(field, 2)
         do i = 1, size(field, 1)
            field(i, j) = field(i, j) - self%gap(first(1) + (i - 1)*step(1), first(2) + (j - 1)*step(2))
         end do
      end do
   end subroutine subtract_from

end module wavycon_paraboloid
