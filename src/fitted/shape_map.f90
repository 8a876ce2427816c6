!> The map of the unit disc to a contact spot or an open island: z = b_0 w + sum over k of b_k conj(w)^(fold k - 1).
!>
!> With one term the edge is a hypotrochoid, with b_1 = b_0/(fold - 1) an astroid and its kin: spots and islands are very
!> nearly such curves up to the load at which they merge.
module wavycon_shape_map
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: shape_map

   type :: shape_map
      integer :: fold = 4               !! of the symmetry, >= 2
      real(dp), allocatable :: b(:)     !! coefficients [s], shape (0:K)
   contains
      procedure :: place
      procedure :: jacobian
      procedure :: linearise_jacobian
      procedure :: area
      procedure :: perimeter
   end type shape_map

contains

   !> z(w) [s].
   elemental complex(dp) function place(self, w) result(z)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: power, step
      integer :: k

      z = self%b(0)*w
      step = conjg(w)**self%fold
      power = conjg(w)**(self%fold - 1)
      do k = 1, ubound(self%b, 1)
         z = z + self%b(k)*power
         power = power*step
      end do
   end function place

   !> Area of the image over that of the disc, |dz/dw|^2 - |dz/d conj(w)|^2 [s^2].
   elemental real(dp) function jacobian(self, w)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w

      complex(dp) :: power, slope, step
      integer :: k

      slope = 0.0_dp
      step = conjg(w)**self%fold
      power = conjg(w)**(self%fold - 2)
      do k = 1, ubound(self%b, 1)
         slope = slope + (self%fold*k - 1)*self%b(k)*power
         power = power*step
      end do
      jacobian = self%b(0)**2 - (slope%re**2 + slope%im**2)
   end function jacobian

   !> The same with its derivatives with the coefficients.
   pure subroutine linearise_jacobian(self, w, jacobian, derivative)
      class(shape_map), intent(in) :: self
      complex(dp), intent(in) :: w
      real(dp), intent(out) :: jacobian         !! [s^2]
      real(dp), intent(out) :: derivative(0:)   !! d jacobian/d b_k [s], shape (0:K)

      complex(dp) :: power(ubound(self%b, 1)), slope
      integer :: k

      slope = 0.0_dp
      do k = 1, ubound(self%b, 1)
         power(k) = (self%fold*k - 1)*conjg(w)**(self%fold*k - 2)
         slope = slope + self%b(k)*power(k)
      end do
      jacobian = self%b(0)**2 - (slope%re**2 + slope%im**2)
      derivative(0) = 2*self%b(0)
      derivative(1:) = -2*(slope%re*power%re + slope%im*power%im)
   end subroutine linearise_jacobian

   !> Area enclosed [s^2].
   pure real(dp) function area(self)
      use wavycon_constants, only: pi
      class(shape_map), intent(in) :: self

      integer :: k

      area = pi*(self%b(0)**2 - sum([((self%fold*k - 1)*self%b(k)**2, k=1, ubound(self%b, 1))]))
   end function area

   !> Length of the edge [s].
   pure real(dp) function perimeter(self)
      use wavycon_constants, only: pi
      class(shape_map), intent(in) :: self

      !> The midpoint rule in the angle is spectral; tips ask for many points.
      integer, parameter :: points = 512
      complex(dp) :: power, step, tangent, w
      integer :: i, k

      perimeter = 0.0_dp
      do i = 1, points
         w = exp(cmplx(0.0_dp, pi*(i - 0.5_dp)/(self%fold*points), dp))
         tangent = self%b(0)*w
         step = conjg(w)**self%fold
         power = conjg(w)**(self%fold - 1)
         do k = 1, ubound(self%b, 1)
            tangent = tangent - (self%fold*k - 1)*self%b(k)*power
            power = power*step
         end do
         perimeter = perimeter + abs(tangent)
      end do
      perimeter = perimeter*2*pi/points
   end function perimeter

end module wavycon_shape_map
