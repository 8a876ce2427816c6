!> The smooth part of a lattice's kernel as a double series of polynomials on the disc.
!>
!> Its mean over all copies of a source under the symmetry, F(z_t, z_s), is symmetric in the target's place as in the
!> source's. Less the lattice points near by it is smooth, and on the discs |z_t|, |z_s| <= R
!>
!>     F(z_t, z_s) = sum over a, b of P_a(z_t/R) B_ab P_b(z_s/R),   README.md (F35),
!>
!> P the disc polynomials of the weight 1. B is computed once. Then each Newton step of each degree evaluates P at its
!> targets and sources, and the kernel between pairs of them for the near lattice points only.
module wavycon_image_series
   use wavycon_constants, only: pi
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_disc_rule, only: disc_rule, start_disc_rule
   use wavycon_disc_sources, only: copies, linearise_sources
   use wavycon_fitted_tuning, only: most_near_points, series_clearance
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: image_series, start_image_series

   type :: image_series
      real(dp) :: radius = 0.0_dp                  !! R [s]; 0 without a series
      real(dp) :: tolerance = 0.0_dp               !! of the series; 0 without one
      type(periodic_kernel) :: near                !! lattice points left out of F
      type(disc_polynomials) :: basis
      real(dp), allocatable :: coefficient(:, :)   !! B [1/s], of the Laplacian [1/s^3], shape (N, N)
   contains
      procedure :: holds_for
      procedure :: add_rows
   end type image_series

   !> Rounding leaves some 1e-13 of the largest value near the discs' edges.
   real(dp), parameter :: least_tolerance = 5e-13_dp

contains

   !> Computes the series. It is left without a radius where it would not pay or not be as accurate.
   subroutine start_image_series(series, kernel, fold, radius, tolerance)
      type(image_series), intent(out) :: series
      type(periodic_kernel), intent(in) :: kernel
      integer, intent(in) :: fold               !! of the symmetry of the lattice about a spot or pool
      real(dp), intent(in) :: radius            !! R > 0 [s]
      real(dp), intent(in) :: tolerance
         !! > 0, error of F relative to its largest value; the error of the Laplacian, whose weight in the equations is
         !! some hundredths, may be 20 times as large

      type(disc_rule) :: rule
      real(dp), allocatable :: nodes(:, :)
      real(dp) :: distance
      integer :: degree

      if (tolerance < least_tolerance) return
      ! A shape that is about to fold may have any size: the number of points is estimated before they are listed.
      if (.not. pi*(series_clearance*radius)**2 <= 2*most_near_points*kernel%rows%spacing) return
      call kernel%rows%points_within(series_clearance*radius, series%near%point, distance)
      if (size(series%near%point, 2) > most_near_points) return
      series%near%power = kernel%power
      series%radius = radius
      series%tolerance = tolerance
      degree = series_degree(fold, distance/radius - 1.0_dp, tolerance)
      call start_disc_polynomials(series%basis, fold, degree, 0.0_dp)
      call start_disc_rule(rule, 0.0_dp, fold, degree/2 + 1, degree/fold + 1)
      call evaluate_nodes(series, kernel, fold, rule%point, nodes)
      call find_coefficients(series%basis, rule, nodes, series%coefficient)
   end subroutine start_image_series

   !> Degree for a tolerance, README.md (F36). With the source on the edge, at its point nearest to the nearest lattice
   !> point of F, terms that vary with the angle fall as powers of that point's distance, round ones as in Chebyshev's
   !> series.
   pure integer function series_degree(fold, distance, tolerance) result(degree)
      integer, intent(in) :: fold
      real(dp), intent(in) :: distance     !! of the singularity from the target's centre [R]
      real(dp), intent(in) :: tolerance

      real(dp) :: digits

      digits = -log(tolerance)
      degree = max(fold*(ceiling(digits/(fold*log(distance))) - 1), &
                   2*(ceiling(digits/(2*acosh(distance))) - 1))
   end function series_degree

   !> F for all pairs of the rule's points.
   subroutine evaluate_nodes(series, kernel, fold, point, nodes)
      type(image_series), intent(in) :: series
      type(periodic_kernel), intent(in) :: kernel
      integer, intent(in) :: fold
      complex(dp), intent(in) :: point(:)                     !! of the disc, shape (n)
      real(dp), allocatable, intent(out) :: nodes(:, :)       !! shape (n, n)

      complex(dp) :: source(size(point), 2*fold)
      real(dp), allocatable, dimension(:) :: near, value, x, y
      integer :: j, k, n

      n = size(point)
      source = reshape(copies(fold, series%radius*point), shape(source))
      allocate (nodes(n, n))
      do j = 1, n
         ! F is symmetric in target and source: only the sources from the target on are needed.
         k = 2*fold*(n - j + 1)
         x = reshape(series%radius*point(j)%re - source(j:, :)%re, [k])
         y = reshape(series%radius*point(j)%im - source(j:, :)%im, [k])
         allocate (near(k), value(k))
         call kernel%evaluate(k, x, y, value)
         call series%near%evaluate(k, x, y, near)
         nodes(j:, j) = sum(reshape(value - near, [n - j + 1, 2*fold]), 2)/(2*fold)
         nodes(j, j:) = nodes(j:, j)
         deallocate (near, value)
      end do
   end subroutine evaluate_nodes

   !> B from F at the pairs of points, by the orthonormality of the basis.
   subroutine find_coefficients(basis, rule, nodes, coefficient)
      type(disc_polynomials), intent(in) :: basis
      type(disc_rule), intent(in) :: rule
      real(dp), intent(in) :: nodes(:, :)                     !! shape (n, n)
      real(dp), allocatable, intent(out) :: coefficient(:, :) !! shape (N, N)

      real(dp), allocatable :: part(:, :), values(:, :)
      integer :: i, n

      n = size(rule%point)
      associate (terms => basis%terms)
         allocate (values(n, terms), part(n, terms), coefficient(terms, terms))
         call basis%evaluate(n, rule%point, values)
         do i = 1, n
            values(i, :) = rule%weight(i)*values(i, :)
         end do
         call dgemm('N', 'N', n, terms, n, 1.0_dp, nodes, n, values, n, 0.0_dp, part, n)
         call dgemm('T', 'N', terms, terms, n, 1.0_dp, values, n, part, n, 0.0_dp, coefficient, terms)
      end associate
   end subroutine find_coefficients

   !> Whether a shape is inside the series' disc.
   pure logical function holds_for(self, shape)
      class(image_series), intent(in) :: self
      type(shape_map), intent(in) :: shape

      holds_for = shape%radius() <= self%radius
   end function holds_for

   !> Adds the integrals over the mapped disc of the terms of an expansion times F for several targets, and the
   !> derivatives of their sum with respect to the shape.
   !>
   !> N.B. The derivatives are at fixed w_t: the targets move with the shape.
   subroutine add_rows(self, shape, rule, values, c, target, rows, shape_rows)
      class(image_series), intent(in) :: self
      type(shape_map), intent(in) :: shape             !! one that the series holds for
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the expansion, shape (N)
      complex(dp), intent(in) :: target(:)             !! w_t, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)

      real(dp), dimension(size(target), self%basis%terms) :: place, place_x, place_y
      real(dp), dimension(self%basis%terms, size(c) + size(shape%b)) :: moments, potential
      real(dp) :: per_radius, total(self%basis%terms)
      complex(dp) :: place_slope(0:ubound(shape%b, 1)), z(size(target))
      integer :: columns, i, k, m, others, terms

      m = size(target)
      terms = size(c)
      k = terms + 1
      columns = size(shape%b)
      others = self%basis%terms
      per_radius = 1.0_dp/self%radius
      call find_moments(self, shape, rule, values, c, moments)
      call dgemm('N', 'N', others, terms + columns, others, 1.0_dp, self%coefficient, others, moments, others, &
                 0.0_dp, potential, others)

      z = shape%place(target)*per_radius
      call self%basis%evaluate(m, z, place)
      call self%basis%slopes(m, z, place, place_x, place_y)
      call dgemm('N', 'N', m, terms, others, 1.0_dp, place, m, potential, others, 1.0_dp, rows, m)
      call dgemm('N', 'N', m, columns, others, 1.0_dp, place, m, potential(:, k:), others, 1.0_dp, shape_rows, m)
      total = matmul(potential(:, :terms), c)*per_radius
      ! The gradient with respect to the target's place.
      z = cmplx(matmul(place_x, total), matmul(place_y, total), dp)
      do i = 1, m
         call shape%linearise_place(target(i), place_slope)
         shape_rows(i, :) = shape_rows(i, :) + z(i)%re*place_slope%re + z(i)%im*place_slope%im
      end do
   end subroutine add_rows

   !> Integrals over the mapped disc of the series' basis times the terms of an expansion, then the derivatives of
   !> their sum with respect to the shape.
   subroutine find_moments(self, shape, rule, values, c, moments)
      type(image_series), intent(in) :: self
      type(shape_map), intent(in) :: shape
      type(disc_rule), intent(in) :: rule
      real(dp), intent(in) :: values(:, :), c(:)
      real(dp), intent(out) :: moments(:, :)           !! shape (N of the series, N + 1+K)

      real(dp), dimension(size(rule%point), self%basis%terms) :: source, source_x, source_y
      real(dp), dimension(size(rule%point), 0:ubound(shape%b, 1)) :: moment_x, moment_y, strength_slope
      real(dp) :: per_radius, weighted(size(rule%point), size(c))
      complex(dp) :: z(size(rule%point))
      integer :: columns, k, n, others, terms

      n = size(rule%point)
      terms = size(c)
      k = terms + 1
      columns = size(shape%b)
      others = self%basis%terms
      per_radius = 1.0_dp/self%radius
      call linearise_sources(shape, rule, values, c, weighted, strength_slope, moment_x, moment_y)
      z = shape%place(rule%point)*per_radius
      call self%basis%evaluate(n, z, source)
      call self%basis%slopes(n, z, source, source_x, source_y)
      call dgemm('T', 'N', others, terms, n, 1.0_dp, source, n, weighted, n, 0.0_dp, moments, others)
      call dgemm('T', 'N', others, columns, n, 1.0_dp, source, n, strength_slope, n, 0.0_dp, moments(:, k:), others)
      call dgemm('T', 'N', others, columns, n, per_radius, source_x, n, moment_x, n, 1.0_dp, moments(:, k:), others)
      call dgemm('T', 'N', others, columns, n, per_radius, source_y, n, moment_y, n, 1.0_dp, moments(:, k:), others)
   end subroutine find_moments

end module wavycon_image_series
