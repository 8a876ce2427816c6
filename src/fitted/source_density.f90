!> What of an expansion is the source of fields: a spot's pressure, a pool's gap or its gradient.
!>
!> A pressure and the gradient of a gap are the root of 1 - |w|^2 times a smooth function, so that one rule serves both:
!> README.md, section 13.
module wavycon_source_density
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: find_density

contains

   !> The source times the Jacobian, over the power of 1 - |w|^2 that it has: J p, J g, or README.md (F54) for the gap's
   !> gradient.
   subroutine find_density(solution, gradient, n, w, inside, density)
      type(expansion), intent(in) :: solution
      logical, intent(in) :: gradient              !! of the gap, whether it is that
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)              !! points of the disc
      real(dp), intent(in) :: inside(n)            !! 1 - |w|^2, exact also next to the edge
      complex(dp), intent(out) :: density(n)       !! real without gradient

      real(dp), dimension(n, solution%basis%terms) :: slope_x, slope_y, values
      complex(dp), dimension(n) :: conjugate_slope, f_slope, slope
      real(dp) :: f(n)

      call solution%basis%evaluate(n, w, values)
      call solution%shape%slopes(n, w, slope, conjugate_slope)
      f = matmul(values, solution%c)
      if (gradient) then
         call solution%basis%slopes(n, w, values, slope_x, slope_y)
         f_slope = inside*cmplx(matmul(slope_x, solution%c), matmul(slope_y, solution%c), dp) - 3*f*w
         density = slope*f_slope - conjugate_slope*conjg(f_slope)
      else
         density = f*(slope%re**2 + slope%im**2 - (conjugate_slope%re**2 + conjugate_slope%im**2))
      end if
   end subroutine find_density

end module wavycon_source_density
