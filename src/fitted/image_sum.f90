!> The integral over a mapped disc of an expansion times a kernel that is smooth there, by a sum over a rule's points.
module wavycon_image_sum
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule
   use wavycon_disc_sources, only: copies, linearise_sources
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: add_image_sum

contains

   !> Adds the integrals of the terms of an expansion times the kernel for several targets, and the derivatives of
   !> their sum with respect to the shape.
   !>
   !> N.B. The derivatives are at fixed w_t: the targets move with the shape.
   subroutine add_image_sum(kernel, shape, rule, values, c, target, rows, shape_rows, opposite)
      type(periodic_kernel), intent(in) :: kernel
      type(shape_map), intent(in) :: shape             !! with the symmetry of the lattice, or less
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      complex(dp), intent(in) :: target(:)             !! w_t, |w_t| <= 1, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)
      complex(dp), intent(in), optional :: opposite
         !! if present the sources are on the mapped disc turned by half a turn, and this is the place of the targets'
         !! centre as seen from theirs [s]

      real(dp), dimension(2*shape%fold*size(rule%point)) :: value, slope_x, slope_y
      !> For each target: the kernel, and its gradient turned back to the source's sector, summed over the copies.
      real(dp), dimension(size(target), size(rule%point)) :: folded, gradient_x, gradient_y
      real(dp), dimension(size(rule%point), 0:ubound(shape%b, 1)) :: moment_x, moment_y, strength_slope
      real(dp) :: strength(size(rule%point)), weighted(size(rule%point), size(c))
      complex(dp) :: gradient, place_slope(0:ubound(shape%b, 1)), source(size(value)), to_centre, z
      integer :: columns, direction, m, n, t, terms

      m = size(target)
      n = size(rule%point)
      terms = size(c)
      columns = size(shape%b)
      source = copies(shape%fold, shape%place(rule%point))
      to_centre = 0.0_dp
      direction = 1
      if (present(opposite)) then
         source = -source
         to_centre = opposite
         direction = -1
      end if
      call linearise_sources(shape, rule, values, c, weighted, strength_slope, moment_x, moment_y)
      strength = matmul(weighted, c)/(2*shape%fold)
      do t = 1, m
         z = shape%place(target(t)) + to_centre
         call kernel%evaluate(size(source), z%re - source%re, z%im - source%im, value, slope_x, slope_y)
         call fold_copies(shape%fold, strength, value, slope_x, slope_y, folded(t, :), gradient_x(t, :), &
                          gradient_y(t, :), gradient)
         call shape%linearise_place(target(t), place_slope)
         shape_rows(t, :) = shape_rows(t, :) + gradient%re*place_slope%re + gradient%im*place_slope%im
      end do
      ! The rule's weights are those of the whole disc: the mean over the copies is taken. Sources move the other way as
      ! targets in the kernel's argument, and those turned by half a turn the other way again.
      associate (mean => 1.0_dp/(2*shape%fold))
         call dgemm('N', 'N', m, terms, n, mean, folded, m, weighted, n, 1.0_dp, rows, m)
         call dgemm('N', 'N', m, columns, n, mean, folded, m, strength_slope, n, 1.0_dp, shape_rows, m)
         call dgemm('N', 'N', m, columns, n, -direction*mean, gradient_x, m, moment_x, n, 1.0_dp, shape_rows, m)
         call dgemm('N', 'N', m, columns, n, -direction*mean, gradient_y, m, moment_y, n, 1.0_dp, shape_rows, m)
      end associate
   end subroutine add_image_sum

   !> Sums the copies of each source for one target. A copy moves as its source does, turned and mirrored: its gradient
   !> is turned and mirrored back.
   pure subroutine fold_copies(fold, strength, value, slope_x, slope_y, folded, gradient_x, gradient_y, gradient)
      integer, intent(in) :: fold
      real(dp), intent(in) :: strength(:)                                !! of the sources, shape (n)
      real(dp), intent(in), dimension(:) :: value, slope_x, slope_y      !! as of copies, shape (2 fold n)
      real(dp), intent(out), dimension(:) :: folded                      !! kernel, shape (n)
      real(dp), intent(out), dimension(:) :: gradient_x, gradient_y      !! in the source's sector, shape (n)
      complex(dp), intent(out) :: gradient     !! of the sum with respect to the target's place

      complex(dp) :: back(size(strength)), slope, total(size(strength), 2), turn
      integer :: copy, i, n, side

      n = size(strength)
      folded = 0.0_dp
      total = 0.0_dp
      back = 0.0_dp
      do copy = 0, 2*fold - 1
         turn = exp(cmplx(0.0_dp, -2*pi*(copy/2)/fold, dp))
         side = 1 + mod(copy, 2)
         do i = 1, n
            slope = cmplx(slope_x(copy*n + i), slope_y(copy*n + i), dp)
            folded(i) = folded(i) + value(copy*n + i)
            total(i, side) = total(i, side) + slope
            slope = turn*slope
            back(i) = back(i) + cmplx(slope%re, (3 - 2*side)*slope%im, dp)
         end do
      end do
      gradient = sum(strength*sum(total, 2))
      gradient_x = back%re
      gradient_y = back%im
   end subroutine fold_copies

end module wavycon_image_sum
