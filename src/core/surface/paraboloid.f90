!> A paraboloid below a map whose X and Y are 0 to pi, about the map's centre.
module wavycon_paraboloid
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: paraboloid

   !> The gap c(1) (X - pi/2)^2 + c(2) (Y - pi/2)^2, less its mean over the map.
   type :: paraboloid
      real(dp) :: c(2) = 0.0_dp   !! of a surface in Delta, >= 0
   contains
      procedure :: is_flat
      procedure :: gap
      procedure :: subtract_from
   end type paraboloid

contains

   pure logical function is_flat(self)
      class(paraboloid), intent(in) :: self

      is_flat = all(self%c <= 0.0_dp)
   end function is_flat

   !> The gap at a point.
   elemental real(dp) function gap(self, x, y)
      class(paraboloid), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad], anywhere

      gap = 0.0_dp
      if (self%is_flat()) return
      ! Angles beyond the map are replaced by their mirror images within it.
      gap = sum(self%c*((0.5_dp*pi - abs(pi - modulo([x, y], 2*pi)))**2 - pi**2/12))
   end function gap

   !> Subtracts the gap from a field over points that are equally spaced.
   pure subroutine subtract_from(self, field, first, step)
      class(paraboloid), intent(in) :: self
      real(dp), intent(inout) :: field(:, :)
      real(dp), intent(in) :: first(2), step(2)   !! X, Y of the first point, and of a step [rad]

      integer :: i, j

      if (self%is_flat()) return
      do j = 1, size(field, 2)
         do i = 1, size(field, 1)
            field(i, j) = field(i, j) - self%gap(first(1) + (i - 1)*step(1), first(2) + (j - 1)*step(2))
         end do
      end do
   end subroutine subtract_from

end module wavycon_paraboloid
