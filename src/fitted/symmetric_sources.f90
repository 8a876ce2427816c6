!> Sources at the points of a rule over a sector of the mapped disc, and all copies that the symmetry makes of them.
module wavycon_symmetric_sources
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule
   use wavycon_kinds, only: dp
   use wavycon_pair_kernel, only: pair_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: evaluate_copies, linearise_sources

contains

   !> Strengths of the sources, which are the terms of an expansion times weight and area, and how strengths and places
   !> change with the shape.
   pure subroutine linearise_sources(shape, rule, values, c, weighted, strength_slope, moment_x, moment_y)
      type(shape_map), intent(in) :: shape
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      real(dp), intent(out) :: weighted(:, :)          !! strength of each term, shape (n, N) [s^2]
      real(dp), intent(out) :: strength_slope(:, 0:)   !! d(strength of the expansion)/d b_k, shape (n, 0:K) [s]
      real(dp), intent(out), dimension(:, 0:) :: moment_x, moment_y
         !! strength of the expansion times dz/d b_k, real and imaginary part, shape (n, 0:K) [s^2]

      complex(dp) :: place_slope(0:ubound(shape%b, 1))
      real(dp) :: density(size(rule%point)), jacobian, jacobian_slope(0:ubound(shape%b, 1))
      integer :: i

      density = rule%weight*matmul(values, c)
      do i = 1, size(rule%point)
         call shape%linearise_jacobian(rule%point(i), jacobian, jacobian_slope)
         call shape%linearise_place(rule%point(i), place_slope)
         weighted(i, :) = rule%weight(i)*jacobian*values(i, :)
         strength_slope(i, :) = density(i)*jacobian_slope
         moment_x(i, :) = density(i)*jacobian*place_slope%re
         moment_y(i, :) = density(i)*jacobian*place_slope%im
      end do
   end subroutine linearise_sources

   !> A kernel between one target and all copies of n sources. For each turn by 2 pi g/fold, g = 0, .., fold-1, come
   !> first the n turned sources, then those mirrored at the x axis before the turn.
   subroutine evaluate_copies(kernel, fold, target, source, value, slope_x, slope_y)
      class(pair_kernel), intent(in) :: kernel
      integer, intent(in) :: fold                  !! of the symmetry
      complex(dp), intent(in) :: target            !! x + i y [s]
      complex(dp), intent(in) :: source(:)         !! x + i y, shape (n) [s]
      real(dp), intent(out) :: value(:)            !! shape (2 fold n)
      real(dp), intent(out), optional :: slope_x(:), slope_y(:)
         !! derivatives with respect to the target's place, both or none, shape (2 fold n)

      real(dp), dimension(size(value)) :: x, y
      complex(dp) :: turn
      integer :: g, i, n

      n = size(source)
      do g = 0, fold - 1
         turn = exp(cmplx(0.0_dp, 2*pi*g/fold, dp))
         do i = 1, n
            x(2*n*g + i) = target%re - (turn%re*source(i)%re - turn%im*source(i)%im)
            y(2*n*g + i) = target%im - (turn%re*source(i)%im + turn%im*source(i)%re)
            x(2*n*g + n + i) = target%re - (turn%re*source(i)%re + turn%im*source(i)%im)
            y(2*n*g + n + i) = target%im - (turn%im*source(i)%re - turn%re*source(i)%im)
         end do
      end do
      call kernel%evaluate(size(x), x, y, value, slope_x, slope_y)
   end subroutine evaluate_copies

end module wavycon_symmetric_sources
