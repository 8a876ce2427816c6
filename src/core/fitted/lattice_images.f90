!> The terms of the images in the equations of one spot or pool: those of all other spots or pools of the lattice, and
!> of the mean: README.md, section 7.
!>
!> They are sums over the points of a rule of F(z_t, z_s), the mean of the kernel for the target z_t over all copies of
!> the source z_s by symmetry. If this saves time and is accurate enough, F less the terms of the lattice points near by
!> is replaced by a double series of polynomials on a disc. The series is made once for a size of the shape: for |z_t|,
!> |z_s| <= R_0
!>
!>     F(z_t, z_s) = sum over a, b of Psi_a(z_t/R_0) B_ab Psi_b(z_s/R_0),   README.md (F35),
!>
!> with the disc polynomials Psi of the weight 1. Otherwise F is evaluated for all pairs of targets and sources. If a
!> cell has two pools, they are too near to each other for the series.
module wavycon_lattice_images
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_disc_sources, only: copies, linearise_sources
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: most_near_points, series_clearance
   use wavycon_kinds, only: dp, pi
   use wavycon_lapack, only: dgemm
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: lattice_images

   type :: lattice_images
      real(dp) :: tolerance = 0.0_dp               !! relative error of the series; 0 if there is none
      real(dp), private :: radius = 0.0_dp         !! R_0, the largest radius of a shape [s]; 0 if there is no series
      type(periodic_kernel), private :: near       !! terms of the lattice points that are left out of the series
      type(disc_polynomials), private :: basis     !! the polynomials Psi
      real(dp), allocatable, private :: coefficient(:, :)   !! B [1/s], for the Laplacian [1/s^3], shape (N, N)
   contains
      procedure :: prepare, add_rows
   end type lattice_images

   !> Least tolerance of a series. Rounding causes errors of about 1e-13 of the largest value near the edge of the disc.
   real(dp), parameter :: least_tolerance = 5e-13_dp

contains

   !> Makes the series for a shape. Nothing is done if the present series holds for the shape. There is no series if it
   !> would not save time or not be accurate enough.
   subroutine prepare(self, lattice, now, growth, tolerance)
      class(lattice_images), intent(inout) :: self
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now
      real(dp), intent(in) :: growth        !! the series shall hold up to this multiple of the shape's size, >= 1
      real(dp), intent(in) :: tolerance
         !! error of F relative to its largest value, > 0; that of the Laplacian, whose weight in the equations is a few
         !! hundredths, may be 20 times as large

      complex(dp), allocatable :: point(:)
      real(dp) :: clearance, e_folds, distance, radius
      integer :: degree

      radius = now%shape%radius()
      if (radius <= self%radius .or. (now%pool .and. lattice%troughs == 2)) return
      self%radius = 0.0_dp
      self%tolerance = 0.0_dp
      radius = growth*radius
      clearance = series_clearance*radius
      ! The number of points is estimated before they are listed, because a shape that is about to fold may have any
      ! size.
      if (tolerance < least_tolerance .or. .not. pi*clearance**2 <= 2*most_near_points*lattice%rows%spacing) return
      ! The distance of points in a row is 1. So the nearest point beyond the clearance is in this list.
      point = lattice%rows%points_about(clearance + 1.0_dp, (0.0_dp, 0.0_dp))
      ! README.md (F36). In the worst case the source is on the edge, at the point closest to the nearest lattice point
      ! of F. Then terms that vary with the angle fall as powers of this lattice point's distance from the source, and
      ! axisymmetric terms as in a Chebyshev series.
      distance = minval(abs(point), abs(point) >= clearance)/radius - 1.0_dp
      e_folds = -log(tolerance)
      degree = max(now%basis%fold*(ceiling(e_folds/(now%basis%fold*log(distance))) - 1), &
                   2*(ceiling(e_folds/(2*acosh(distance))) - 1))
      point = pack(point, abs(point) < clearance .and. abs(point) > 0.0_dp)
      if (size(point) > most_near_points) return
      self%radius = radius
      self%tolerance = tolerance
      self%near%point = reshape([point%re, point%im], [2, size(point)], order=[2, 1])
      associate (kernel => lattice%kernel(merge(2, 1, now%pool)))
         self%near%power = kernel%power
         call start_disc_polynomials(self%basis, now%basis%fold, degree, 0.0_dp)
         call find_coefficients(kernel)
      end associate

   contains

      !> Computes B from the values of F at all pairs of a rule's points, by the orthonormality of the basis.
      subroutine find_coefficients(kernel)
         type(periodic_kernel), intent(in) :: kernel   !! the whole kernel, with the lattice points near by

         type(disc_rule) :: rule
         complex(dp), allocatable :: source(:, :), z(:)
         real(dp), allocatable :: near(:), nodes(:, :), part(:, :), value(:), values(:, :)
         integer :: j, k, n

         associate (fold => self%basis%fold, degree => self%basis%degree, terms => self%basis%terms)
            call start_disc_rule(rule, 0.0_dp, fold, degree/2 + 1, degree/fold + 1)
            n = size(rule%point)
            source = reshape(copies(fold, self%radius*rule%point), [n, 2*fold])
            allocate (near(2*fold*n), nodes(n, n), part(n, terms), value(2*fold*n), values(n, terms))
            do j = 1, n
               ! F is symmetric in target and source. So only the sources j .. n are computed for the target j.
               z = reshape(self%radius*rule%point(j) - source(j:, :), [2*fold*(n - j + 1)])
               k = size(z)
               call kernel%evaluate(k, z%re, z%im, value)
               call self%near%evaluate(k, z%re, z%im, near)
               nodes(j:, j) = sum(reshape(value(:k) - near(:k), [n - j + 1, 2*fold]), 2)/(2*fold)
               nodes(j, j:) = nodes(j:, j)
            end do
            call self%basis%evaluate(n, rule%point, values)
            values = values*spread(rule%weight, 2, terms)
            call dgemm('N', 'N', n, terms, n, 1.0_dp, nodes, n, values, n, 0.0_dp, part, n)
            self%coefficient = reshape([real(dp) ::], [terms, terms], pad=[0.0_dp])
            call dgemm('T', 'N', terms, terms, n, 1.0_dp, values, n, part, n, 0.0_dp, self%coefficient, terms)
         end associate
      end subroutine find_coefficients

   end subroutine prepare

   !> Adds, for several targets, the integrals over all images of each term of a fitted function, and the derivatives of
   !> the integral of their sum by the shape. Also sets the integrals without a kernel, and their derivatives: those of
   !> the load.
   !>
   !> N.B. The derivatives are at fixed w_t: the targets z(w_t) move with the shape.
   subroutine add_rows(self, lattice, now, rule, values, target, rows, shape_rows, load_row, load_slope)
      class(lattice_images), intent(in) :: self
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now
      type(disc_rule), intent(in) :: rule              !! a rule for the weight of the fitted function
      real(dp), intent(in) :: values(:, :)             !! the basis at the rule's points, shape (n, N)
      complex(dp), intent(in) :: target(:)             !! w_t, |w_t| <= 1, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)
      real(dp), intent(out) :: load_row(:)             !! integrals of the terms over the spot or pool, shape (N)
      real(dp), intent(out) :: load_slope(0:)          !! d(integral of their sum)/d b_k, shape (0:K)

      complex(dp) :: place_slope(0:ubound(now%shape%b, 1))
      complex(dp), dimension(size(target)) :: target_gradient, z      ! gradient by z_t of the sum; z_t [s]
      complex(dp) :: source(size(rule%point))                         ! z_s [s]
      real(dp), dimension(size(rule%point), 0:ubound(now%shape%b, 1)) :: moment_x, moment_y, strength_slope
      real(dp) :: strength(size(rule%point)), weighted(size(rule%point), size(now%c))
      !> F for all sources and targets, and its gradient by the source's position, shape (n, m).
      real(dp), dimension(:, :), allocatable :: f, gradient_x, gradient_y
      integer :: columns, m, n, t

      m = size(target)
      n = size(rule%point)
      columns = size(now%shape%b)
      call linearise_sources(now%shape, rule, values, now%c, weighted, strength_slope, moment_x, moment_y)
      load_row = sum(weighted, 1)
      load_slope = sum(strength_slope, 1)
      z = now%shape%position_of(target)
      source = now%shape%position_of(rule%point)
      strength = matmul(weighted, now%c)
      target_gradient = 0.0_dp
      allocate (f(n, m), gradient_x(n, m), gradient_y(n, m), source=0.0_dp)
      if (now%shape%radius() <= self%radius) then
         call add_series()
         if (size(self%near%point, 2) > 0) call add_kernel(self%near, 1, (0.0_dp, 0.0_dp))
      else
         call add_kernel(lattice%kernel(merge(2, 1, now%pool)), 1, (0.0_dp, 0.0_dp))
      end if
      if (now%pool .and. lattice%troughs == 2) then
         ! The second pools, which are rotated by half a turn. None of them is the target's own, so that the whole
         ! kernel is taken, with the origin's term.
         call add_kernel(lattice%kernel(3), -1, 2*lattice%trough)
      end if
      call dgemm('T', 'N', m, size(now%c), n, 1.0_dp, f, n, weighted, n, 1.0_dp, rows, m)
      call dgemm('T', 'N', m, columns, n, 1.0_dp, f, n, strength_slope, n, 1.0_dp, shape_rows, m)
      call dgemm('T', 'N', m, columns, n, 1.0_dp, gradient_x, n, moment_x, n, 1.0_dp, shape_rows, m)
      call dgemm('T', 'N', m, columns, n, 1.0_dp, gradient_y, n, moment_y, n, 1.0_dp, shape_rows, m)
      do t = 1, m
         call now%shape%linearise_position(target(t), place_slope)
         shape_rows(t, :) = shape_rows(t, :) + target_gradient(t)%re*place_slope%re &
            + target_gradient(t)%im*place_slope%im
      end do

   contains

      !> Adds the mean of a kernel over the copies of each source.
      subroutine add_kernel(kernel, direction, to_centre)
         type(periodic_kernel), intent(in) :: kernel
         integer, intent(in) :: direction          !! 1, or -1 if the sources are rotated by half a turn
         complex(dp), intent(in) :: to_centre      !! the targets' centre less the sources' centre [s]

         complex(dp), dimension(2*now%shape%fold*n) :: copied, from
         complex(dp) :: turn
         real(dp), dimension(size(copied)) :: slope_x, slope_y, value
         real(dp), dimension(n) :: total_x, total_y
         integer :: copy, mirror, t

         associate (fold => now%shape%fold, mean => 1.0_dp/(2*now%shape%fold))
            copied = direction*copies(fold, source) - to_centre
            do t = 1, m
               from = z(t) - copied
               call kernel%evaluate(size(from), from%re, from%im, value, slope_x, slope_y)
               total_x = 0.0_dp
               total_y = 0.0_dp
               do copy = 0, 2*fold - 1
                  ! A copy moves as its source does, but rotated and mirrored. So its gradient is rotated and mirrored
                  ! back.
                  turn = -direction*mean*exp(cmplx(0.0_dp, -2*pi*(copy/2)/fold, dp))
                  mirror = 1 - 2*mod(copy, 2)
                  associate (x => slope_x(copy*n + 1:(copy + 1)*n), y => slope_y(copy*n + 1:(copy + 1)*n))
                     f(:, t) = f(:, t) + mean*value(copy*n + 1:(copy + 1)*n)
                     total_x = total_x + x
                     total_y = total_y + y
                     gradient_x(:, t) = gradient_x(:, t) + (turn%re*x - turn%im*y)
                     gradient_y(:, t) = gradient_y(:, t) + mirror*(turn%re*y + turn%im*x)
                  end associate
               end do
               target_gradient(t) = target_gradient(t) &
                  + mean*cmplx(dot_product(strength, total_x), dot_product(strength, total_y), dp)
            end do
         end associate
      end subroutine add_kernel

      !> Adds F and its gradients by the series.
      subroutine add_series()
         real(dp), dimension(m, self%basis%terms) :: at_target, target_x, target_y
         real(dp), dimension(n, self%basis%terms) :: at_source, source_x, source_y
         real(dp) :: part(self%basis%terms, m), per_radius, total(self%basis%terms)

         per_radius = 1.0_dp/self%radius
         associate (terms => self%basis%terms)
            call self%basis%evaluate(m, per_radius*z, at_target)
            call self%basis%slopes(m, per_radius*z, at_target, target_x, target_y)
            call self%basis%evaluate(n, per_radius*source, at_source)
            call self%basis%slopes(n, per_radius*source, at_source, source_x, source_y)
            call dgemm('N', 'T', terms, m, terms, 1.0_dp, self%coefficient, terms, at_target, m, 0.0_dp, part, terms)
            call dgemm('N', 'N', n, m, terms, 1.0_dp, at_source, n, part, terms, 1.0_dp, f, n)
            call dgemm('N', 'N', n, m, terms, per_radius, source_x, n, part, terms, 1.0_dp, gradient_x, n)
            call dgemm('N', 'N', n, m, terms, per_radius, source_y, n, part, terms, 1.0_dp, gradient_y, n)
         end associate
         total = per_radius*matmul(self%coefficient, matmul(strength, at_source))
         target_gradient = target_gradient + cmplx(matmul(target_x, total), matmul(target_y, total), dp)
      end subroutine add_series

   end subroutine add_rows

end module wavycon_lattice_images
