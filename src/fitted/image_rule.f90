!> The integral over a mapped disc of f times the smooth part of a lattice's kernel, or of its Laplacian: all
!> the other spots or islands, and the mean.
module wavycon_image_rule
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_periodic_kernel, only: add_points, periodic_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: add_image_rows, kernel_of_images, linearise_sources

contains

   !> Adds the integrals over the mapped disc of the terms of an expansion times the kernel, and their sum's
   !> derivatives with the shape.
   !>
   !> N.B. The derivatives are taken with the targets' w_t kept, so that the targets move with the shape.
   subroutine add_image_rows(kernel, cubes, shape, rule, values, c, target, rows, shape_rows, near, &
                             opposite)
      type(periodic_kernel), intent(in) :: kernel
      logical, intent(in) :: cubes                     !! whether the Laplacian is taken
      type(shape_map), intent(in) :: shape             !! of the symmetry of the lattice, or less
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      complex(dp), intent(in) :: target(:)             !! w_t, |w_t| <= 1, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)
      real(dp), intent(in), optional :: near(:, :)     !! as of kernel_of_images
      complex(dp), intent(in), optional :: opposite
         !! centre of the disc's image less that of its image turned by half a turn, if a cell has that as well [s]

      real(dp), parameter :: origin(2, 1) = 0.0_dp
      real(dp), dimension(2*shape%fold*size(rule%point)) :: own_value, own_x, own_y, value, slope_x, slope_y
      real(dp), dimension(size(target), size(rule%point)) :: folded, pulled_x, pulled_y
      real(dp), dimension(size(rule%point), 0:ubound(shape%b, 1)) :: shift_x, shift_y, swelling
      real(dp) :: weighted(size(rule%point), size(c)), strength(size(rule%point))
      complex(dp) :: place, shift(0:ubound(shape%b, 1)), total, turn(0:shape%fold - 1), z(size(rule%point))
      integer :: columns, g, m, n, t, terms

      m = size(target)
      n = size(rule%point)
      terms = size(c)
      columns = size(shape%b)
      turn = [(exp(cmplx(0.0_dp, -2*pi*g/shape%fold, dp)), g=0, shape%fold - 1)]
      z = shape%place(rule%point)
      call linearise_sources(shape, rule, values, c, weighted, swelling, shift_x, shift_y)
      strength = matmul(weighted, c)/(2*shape%fold)
      folded = 0.0_dp
      pulled_x = 0.0_dp
      pulled_y = 0.0_dp
      do t = 1, m
         place = shape%place(target(t))
         total = 0.0_dp
         call kernel_of_images(kernel, cubes, shape%fold, place, z, value, slope_x, slope_y, near)
         call add_values(1)
         if (present(opposite)) then
            ! None of those is the target's own.
            call kernel_of_images(kernel, cubes, shape%fold, place + opposite, -z, value, slope_x, slope_y)
            call kernel_of_images(kernel, cubes, shape%fold, place + opposite, -z, own_value, own_x, own_y, origin)
            value = value + own_value
            slope_x = slope_x + own_x
            slope_y = slope_y + own_y
            call add_values(-1)
         end if
         call shape%linearise_place(target(t), shift)
         shape_rows(t, :) = shape_rows(t, :) + total%re*shift%re + total%im*shift%im
      end do
      associate (mean => 1.0_dp/(2*shape%fold))
         call dgemm('N', 'N', m, terms, n, mean, folded, m, weighted, n, 1.0_dp, rows, m)
         call dgemm('N', 'N', m, columns, n, mean, folded, m, swelling, n, 1.0_dp, shape_rows, m)
         call dgemm('N', 'N', m, columns, n, -mean, pulled_x, m, shift_x, n, 1.0_dp, shape_rows, m)
         call dgemm('N', 'N', m, columns, n, -mean, pulled_y, m, shift_y, n, 1.0_dp, shape_rows, m)
      end associate

   contains

      !> Adds the mean over the group: the rule's weights are those of the whole disc. A source moves as its images
      !> do, turned back and mirrored.
      subroutine add_values(direction)
         integer, intent(in) :: direction   !! of the sources' movement: 1 or -1

         real(dp) :: across, along
         integer :: i, image, mirrored

         do g = 0, shape%fold - 1
            do i = 1, n
               image = 2*n*g + i
               mirrored = image + n
               along = slope_x(image) + slope_x(mirrored)
               across = slope_y(image) + slope_y(mirrored)
               total = total + strength(i)*cmplx(along, across, dp)
               folded(t, i) = folded(t, i) + value(image) + value(mirrored)
               pulled_x(t, i) = pulled_x(t, i) + direction*(turn(g)%re*along - turn(g)%im*across)
               pulled_y(t, i) = pulled_y(t, i) + direction*(turn(g)%re*(slope_y(image) - slope_y(mirrored)) &
                                                            + turn(g)%im*(slope_x(image) - slope_x(mirrored)))
            end do
         end do
      end subroutine add_values

   end subroutine add_image_rows

   !> What the sources at a rule's points bring to an integral over the mapped disc, and how that changes with
   !> the shape: by their strength and by their place.
   pure subroutine linearise_sources(shape, rule, values, c, weighted, swelling, shift_x, shift_y)
      type(shape_map), intent(in) :: shape
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      real(dp), intent(out) :: weighted(:, :)          !! terms of the basis, weight and area, shape (n, N) [s^2]
      real(dp), intent(out) :: swelling(:, 0:)         !! derivatives of their sum, shape (n, 0:K) [s]
      real(dp), intent(out), dimension(:, 0:) :: shift_x, shift_y
         !! their sum times the derivatives of the place, shape (n, 0:K) [s^2]

      complex(dp) :: shift(0:ubound(shape%b, 1))
      real(dp) :: density(size(rule%point)), jacobian, jacobian_slope(0:ubound(shape%b, 1))
      integer :: i

      density = rule%weight*matmul(values, c)
      do i = 1, size(rule%point)
         call shape%linearise_jacobian(rule%point(i), jacobian, jacobian_slope)
         call shape%linearise_place(rule%point(i), shift)
         weighted(i, :) = rule%weight(i)*jacobian*values(i, :)
         swelling(i, :) = density(i)*jacobian_slope
         shift_x(i, :) = density(i)*jacobian*shift%re
         shift_y(i, :) = density(i)*jacobian*shift%im
      end do
   end subroutine linearise_sources

   !> The smooth part between a target and all that sources become when they are turned and mirrored: of each
   !> turn first all of them as they are, then all mirrored before.
   pure subroutine kernel_of_images(kernel, cubes, fold, target, source, value, slope_x, slope_y, near)
      type(periodic_kernel), intent(in) :: kernel
      logical, intent(in) :: cubes                 !! whether the Laplacian is taken
      integer, intent(in) :: fold                  !! of the symmetry
      complex(dp), intent(in) :: target            !! x + i y [s]
      complex(dp), intent(in) :: source(:)         !! shape (n) [s]
      real(dp), intent(out) :: value(:)            !! shape (2 fold n)
      real(dp), intent(out), optional :: slope_x(:), slope_y(:)
         !! derivatives with the target, both or none, shape (2 fold n)
      real(dp), intent(in), optional :: near(:, :)
         !! lattice points, those that a turn brings to each other together, shape (2, k): only what they do [s]

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
      if (present(near)) then
         value = 0.0_dp
         if (present(slope_x)) then
            slope_x = 0.0_dp
            slope_y = 0.0_dp
         end if
         call add_points(near, cubes, size(x), x, y, value, slope_x, slope_y)
      else if (cubes) then
         call kernel%smooth_laplacian(size(x), x, y, value, slope_x, slope_y)
      else
         call kernel%smooth_part(size(x), x, y, value, slope_x, slope_y)
      end if
   end subroutine kernel_of_images

end module wavycon_image_rule
