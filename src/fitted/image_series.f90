!> The smooth part of a lattice's kernel, or of its Laplacian, as a double series.
!>
!> Its mean over all that a source becomes when it is turned and mirrored, F(z_t, z_s), has the symmetry of a
!> contact in the target's place as in the source's. Without lattice points that are near it is smooth, and on
!> the discs |z_t|, |z_s| <= R
!>
!>     F(z_t, z_s) = sum over a, b of P_a(z_t/R) B_ab P_b(z_s/R),
!>
!> P the disc polynomials of the weight 1. B is made once, and all steps of Newton's method at all degrees of an
!> expansion need P at their targets and sources only, and at all pairs of them at most a few near points.
module wavycon_image_series
   use wavycon_constants, only: pi
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_disc_rule, only: disc_rule, plain_disc_rule
   use wavycon_fitted_tuning, only: most_near_points, series_clearance
   use wavycon_image_rule, only: kernel_of_images, linearise_sources
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: image_series, start_image_series

   type :: image_series
      real(dp) :: radius = 0.0_dp                  !! R [s]; 0 where there is no series
      real(dp) :: tolerance = 0.0_dp               !! that it was made with
      real(dp), allocatable :: near(:, :)          !! lattice points that are left out, shape (2, m) [s]
      type(disc_polynomials) :: basis
      real(dp), allocatable :: coefficient(:, :)   !! B [1/s], of the Laplacian [1/s^3], shape (N, N)
   contains
      procedure :: covers
      procedure :: add_rows
   end type image_series

   !> Rounding leaves some 1e-13 of the largest value near the discs' edges.
   real(dp), parameter :: least_tolerance = 5e-13_dp

contains

   !> Makes the series; leaves it without a radius where none is worth while.
   subroutine start_image_series(series, kernel, cubes, fold, radius, tolerance)
      type(image_series), intent(out) :: series
      type(periodic_kernel), intent(in) :: kernel
      logical, intent(in) :: cubes              !! whether the Laplacian is taken
      integer, intent(in) :: fold               !! of the symmetry of the lattice about a spot or island
      real(dp), intent(in) :: radius            !! R > 0 [s]
      real(dp), intent(in) :: tolerance
         !! > 0, error of F relative to its largest value; that of the Laplacian, whose weight in the equations is
         !! some hundredths, may be 20 times as much

      type(disc_rule) :: rule
      real(dp), allocatable :: near(:), nodes(:, :), part(:, :), value(:), values(:, :)
      real(dp) :: digits, distance
      integer :: degree, i, j, n

      if (tolerance < least_tolerance) return
      ! Shapes that are about to fold grow without end.
      if (.not. pi*(series_clearance*radius)**2 <= 2*most_near_points*kernel%height) return
      call kernel%points_within(series_clearance*radius, series%near, distance)
      if (size(series%near, 2) > most_near_points) return
      ! With the source on the edge nearest to a point left in, terms that turn fall as powers of that point's
      ! distance from the centre, in R, those that do not as for Chebyshev's polynomials.
      distance = distance/radius - 1.0_dp
      digits = -log(tolerance)
      degree = max(fold*(ceiling(digits/(fold*log(distance))) - 1), &
                   2*(ceiling(digits/(2*acosh(distance))) - 1))
      series%radius = radius
      series%tolerance = tolerance
      call start_disc_polynomials(series%basis, fold, degree, 0.0_dp)
      call plain_disc_rule(rule, 0.0_dp, fold, degree/2 + 1, degree/fold + 1)
      n = size(rule%point)
      allocate (nodes(n, n), near(2*fold*n), value(2*fold*n))
      do j = 1, n
         associate (k => n - j + 1)
            call kernel_of_images(kernel, cubes, fold, radius*rule%point(j), radius*rule%point(j:), &
                                  value(:2*fold*k))
            if (size(series%near, 2) > 0) then
               call kernel_of_images(kernel, cubes, fold, radius*rule%point(j), radius*rule%point(j:), &
                                     near(:2*fold*k), near=series%near)
               value(:2*fold*k) = value(:2*fold*k) - near(:2*fold*k)
            end if
            do i = 1, k
               nodes(j - 1 + i, j) = sum(value(i:2*fold*k:k))/(2*fold)
               nodes(j, j - 1 + i) = nodes(j - 1 + i, j)
            end do
         end associate
      end do
      associate (terms => series%basis%terms)
         allocate (values(n, terms), part(n, terms), series%coefficient(terms, terms))
         call series%basis%evaluate(n, rule%point, values)
         do i = 1, n
            values(i, :) = rule%weight(i)*values(i, :)
         end do
         call dgemm('N', 'N', n, terms, n, 1.0_dp, nodes, n, values, n, 0.0_dp, part, n)
         call dgemm('T', 'N', terms, terms, n, 1.0_dp, values, n, part, n, 0.0_dp, series%coefficient, terms)
      end associate
   end subroutine start_image_series

   !> Whether the series holds for a shape.
   pure logical function covers(self, shape)
      class(image_series), intent(in) :: self
      type(shape_map), intent(in) :: shape

      covers = shape%radius() <= self%radius
   end function covers

   !> Adds the integrals over the mapped disc of the terms of an expansion times F, and their sum's derivatives
   !> with the shape.
   !>
   !> N.B. The derivatives are taken with the targets' w_t kept, so that the targets move with the shape.
   subroutine add_rows(self, shape, rule, values, c, target, rows, shape_rows)
      class(image_series), intent(in) :: self
      type(shape_map), intent(in) :: shape             !! covered
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      complex(dp), intent(in) :: target(:)             !! w_t, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)

      real(dp), dimension(size(rule%point), self%basis%terms) :: source, source_x, source_y
      real(dp), dimension(size(target), self%basis%terms) :: place, place_x, place_y
      real(dp), dimension(size(rule%point), 0:ubound(shape%b, 1)) :: shift_x, shift_y, swelling
      real(dp), dimension(self%basis%terms, size(c) + size(shape%b)) :: moments, potential
      real(dp) :: per_radius, total(self%basis%terms), weighted(size(rule%point), size(c))
      complex(dp) :: shift(0:ubound(shape%b, 1)), z(max(size(rule%point), size(target)))
      integer :: columns, i, k, m, n, others, terms

      m = size(target)
      n = size(rule%point)
      terms = size(c)
      columns = size(shape%b)
      others = self%basis%terms
      per_radius = 1.0_dp/self%radius
      call linearise_sources(shape, rule, values, c, weighted, swelling, shift_x, shift_y)
      z(:n) = shape%place(rule%point)*per_radius
      call self%basis%evaluate(n, z, source)
      call self%basis%slopes(n, z, source, source_x, source_y)
      k = terms + 1
      call dgemm('T', 'N', others, terms, n, 1.0_dp, source, n, weighted, n, 0.0_dp, moments, others)
      call dgemm('T', 'N', others, columns, n, 1.0_dp, source, n, swelling, n, 0.0_dp, moments(:, k:), others)
      call dgemm('T', 'N', others, columns, n, per_radius, source_x, n, shift_x, n, 1.0_dp, moments(:, k:), others)
      call dgemm('T', 'N', others, columns, n, per_radius, source_y, n, shift_y, n, 1.0_dp, moments(:, k:), others)
      call dgemm('N', 'N', others, terms + columns, others, 1.0_dp, self%coefficient, others, moments, others, &
                 0.0_dp, potential, others)

      z(:m) = shape%place(target)*per_radius
      call self%basis%evaluate(m, z, place)
      call self%basis%slopes(m, z, place, place_x, place_y)
      call dgemm('N', 'N', m, terms, others, 1.0_dp, place, m, potential, others, 1.0_dp, rows, m)
      call dgemm('N', 'N', m, columns, others, 1.0_dp, place, m, potential(:, k:), others, 1.0_dp, shape_rows, m)
      total = matmul(potential(:, :terms), c)*per_radius
      z(:m) = cmplx(matmul(place_x, total), matmul(place_y, total), dp)
      do i = 1, m
         call shape%linearise_place(target(i), shift)
         shape_rows(i, :) = shape_rows(i, :) + z(i)%re*shift%re + z(i)%im*shift%im
      end do
   end subroutine add_rows

end module wavycon_image_series
