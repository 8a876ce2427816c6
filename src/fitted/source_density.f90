!> What of an expansion is the source of fields: a spot's pressure, a pool's gap or its gradient.
!>
!> A pressure and the gradient of a gap are the root of 1 - |w|^2 times a smooth function, so that one rule serves both:
!> README.md, section 13.
module wavycon_source_density
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: find_density, place_differences

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

   !> z(w) - z(w_0) without cancellation, by the divided differences of README.md (F26).
   pure subroutine place_differences(shape, origin, n, step, w, difference)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: origin            !! w_0
      integer, intent(in) :: n
      complex(dp), intent(in) :: step(n), w(n)     !! w - w_0, and w
      complex(dp), intent(out) :: difference(n)    !! [s]

      complex(dp), dimension(n) :: of_fold, of_term, power, total
      complex(dp) :: origin_power, origin_step
      integer :: j, k, m

      m = shape%fold
      of_term = 1.0_dp
      do j = 2, m - 1
         of_term = w*of_term + origin**(j - 1)
      end do
      of_fold = w*of_term + origin**(m - 1)
      origin_step = origin**m
      power = origin_step + step*of_fold
      origin_power = origin**(m - 1)
      total = shape%b(1)*of_term
      do k = 2, ubound(shape%b, 1)
         of_term = power*of_term + origin_power*of_fold
         total = total + shape%b(k)*of_term
         origin_power = origin_power*origin_step
      end do
      difference = shape%b(0)*step + conjg(step*total)
      if (shape%clustering > 0.0_dp) &
         difference = difference - shape%b(0)*shape%clustering*step*(w*of_fold + origin_step)
   end subroutine place_differences

end module wavycon_source_density
