!> The integral over a mapped disc of f times the smooth part of a lattice's kernel, or of its Laplacian: all
!> the other spots or islands, and the mean.
module wavycon_image_rule
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule
   use wavycon_kinds, only: dp
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: image_rows

contains

   !> Weights of f at the points of a rule, for one target, and the derivative with the shape of the integral
   !> for one f.
   pure subroutine image_rows(kernel, cubes, shape, rule, target, density, row, shape_row)
      type(periodic_kernel), intent(in) :: kernel
      logical, intent(in) :: cubes                   !! whether the Laplacian is taken
      type(shape_map), intent(in) :: shape           !! of the symmetry of the lattice, or less
      type(disc_rule), intent(in) :: rule            !! with the weight of f
      complex(dp), intent(in) :: target              !! w_t, |w_t| <= 1
      real(dp), intent(in) :: density(:)             !! f less its weight at the rule's points, shape (n)
      real(dp), intent(out) :: row(:)                !! weights of f less its weight, shape (n)
      real(dp), intent(out) :: shape_row(0:)         !! d(integral)/d b_k, shape (0:K)

      real(dp), dimension(2*shape%fold*size(rule%point)) :: x, y, value, slope_x, slope_y
      complex(dp), dimension(size(rule%point)) :: z, w, own_slope, pulled, power, step, bend
      complex(dp) :: own, total, turn, z_target, target_power, slope
      real(dp) :: jacobian(size(rule%point)), folded(size(rule%point))
      integer :: g, i, k, m, n

      n = size(rule%point)
      m = shape%fold
      w = rule%point
      z = shape%place(w)
      z_target = shape%place(target)
      do g = 0, m - 1
         turn = exp(cmplx(0.0_dp, 2*pi*g/m, dp))
         do i = 1, n
            x(2*n*g + i) = z_target%re - (turn%re*z(i)%re - turn%im*z(i)%im)
            y(2*n*g + i) = z_target%im - (turn%re*z(i)%im + turn%im*z(i)%re)
            x(2*n*g + n + i) = z_target%re - (turn%re*z(i)%re + turn%im*z(i)%im)
            y(2*n*g + n + i) = z_target%im - (turn%im*z(i)%re - turn%re*z(i)%im)
         end do
      end do
      if (cubes) then
         call kernel%smooth_laplacian(size(x), x, y, value, slope_x, slope_y)
      else
         call kernel%smooth_part(size(x), x, y, value, slope_x, slope_y)
      end if

      ! The mean over the group: the rule's weights are those of the whole disc.
      folded = 0.0_dp
      pulled = 0.0_dp
      total = 0.0_dp
      jacobian = shape%jacobian(w)
      do g = 0, m - 1
         turn = exp(cmplx(0.0_dp, -2*pi*g/m, dp))
         do i = 1, n
            folded(i) = folded(i) + value(2*n*g + i) + value(2*n*g + n + i)
            pulled(i) = pulled(i) + turn*cmplx(slope_x(2*n*g + i), slope_y(2*n*g + i), dp) &
               + conjg(turn*cmplx(slope_x(2*n*g + n + i), slope_y(2*n*g + n + i), dp))
         end do
      end do
      folded = folded/(2*m)
      pulled = pulled/(2*m)
      row = rule%weight*jacobian*folded
      do g = 0, 2*m - 1
         do i = 1, n
            total = total + rule%weight(i)*jacobian(i)*density(i)/(2*m) &
               *cmplx(slope_x(n*g + i), slope_y(n*g + i), dp)
         end do
      end do
      own = shape%crowded(target)
      own_slope = shape%crowded_slope(w)
      shape_row(0) = total%re*own%re + total%im*own%im
      do i = 1, n
         own = shape%crowded(w(i))
         shape_row(0) = shape_row(0) + rule%weight(i)*density(i)*( &
            2*shape%b(0)*(own_slope(i)%re**2 + own_slope(i)%im**2)*folded(i) &
            - jacobian(i)*(pulled(i)%re*own%re + pulled(i)%im*own%im))
      end do
      ! The slope of the anti-analytic part.
      step = conjg(w)**m
      power = conjg(w)**(m - 2)
      bend = 0.0_dp
      do k = 1, ubound(shape%b, 1)
         bend = bend + (m*k - 1)*shape%b(k)*power
         power = power*step
      end do
      power = conjg(w)**(m - 2)
      target_power = conjg(target)**(m - 1)
      do k = 1, ubound(shape%b, 1)
         shape_row(k) = total%re*target_power%re + total%im*target_power%im
         do i = 1, n
            slope = power(i)*conjg(w(i))
            shape_row(k) = shape_row(k) - rule%weight(i)*density(i)*( &
               2*(m*k - 1)*folded(i)*(bend(i)%re*power(i)%re + bend(i)%im*power(i)%im) &
               + jacobian(i)*(pulled(i)%re*slope%re + pulled(i)%im*slope%im))
         end do
         power = power*step
         target_power = target_power*conjg(target)**m
      end do
   end subroutine image_rows

end module wavycon_image_rule
