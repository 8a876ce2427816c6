!> The equations of contact of one of several separate spots, or of one of several separate pools, at points of the
!> mapped disc.
!>
!> Spot: the pressure p of the spot and of all its images displaces the surface by u, and u + h = delta in contact. The
!> pressure carries the load, P times the area of a cell: README.md (F8) and (F9).
!>
!> Pool: the gap g makes the pressure vanish in the pool. In full contact the pressure is P + the sum of
!> a_i |k_i| cos 2 pi k_i.x. A gap changes the pressure by -(1/4 pi^2) times the finite part of the integral of g times
!> the Laplacian of Gp. Therefore
!>
!>     (1/4 pi^2) integral of Laplacian(Gp) g = pressure rise from the trough - (closing pressure - P).   (F12)
!>
!> The solution for a wrong edge has a singular term at the edge, which the weight (1 - |w|^2)^power excludes. So the
!> equations can only be met with the right edge. With adhesion the weight includes this term, and the equations of the
!> edge (F67) give the term the strength that the work of adhesion requires. The unknowns are the coefficients of the
!> fitted function, the approach of a spot or, with adhesion, the load of a pool, and the coefficients of the shape.
!> There are more equations than unknowns, which are met in the sense of least squares.
module wavycon_contact_equations
   use wavycon_chord_rule, only: chord_rule, start_chord_rule
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: chords_per_degree, extra_chord_points, extra_disc_angles, near_images_ratio, &
      pool_extra_angles, pool_extra_radii, sharp_chords_per_degree, sharp_collocation_factor, &
      sharp_collocation_ratio, sharp_quadrature_ratio, spot_extra_angles, spot_extra_radii
   use wavycon_kinds, only: dp, not_a_number, pi
   use wavycon_lapack, only: dgemv
   use wavycon_lattice_images, only: lattice_images
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: contact_equations, start_equations

   type :: contact_equations
      integer :: unknowns = 0
         !! number of unknowns: N coefficients, a spot's approach or an adhesive pool's load, 1+K of the shape
      integer :: before_shape = 0                !! number of unknowns before those of the shape
      !> Number of constraints that a step meets exactly: 1, a spot's load or, with adhesion, the area; 0 for a pool
      !> without adhesion.
      integer :: constraints = 0
      type(chord_rule) :: chords                 !! rule of the singular integral over the spot or pool itself
      type(disc_rule) :: rule                    !! rule of the integrals with the images, and of those without a kernel
      complex(dp), allocatable :: target(:)      !! points of collocation in the disc, shape (m)
      complex(dp), allocatable :: edge(:)        !! points of the edge, |w| = 1, shape (e); e = 0 without adhesion
      real(dp), allocatable :: values(:, :)      !! the basis at the rule's points, shape (n, N)
      real(dp), allocatable :: edge_values(:, :) !! the basis at the edge's points, shape (e, N)
      real(dp), allocatable :: matrix(:, :)      !! derivatives of the left sides, shape (m + e, unknowns)
      !> Right sides less left sides, shape (m + e) [Delta, for a pool pi E* Delta/s].
      real(dp), allocatable :: residual(:)
      !> Derivatives of the integral of p, the left side of README.md (F9), or of the integral of g, shape (unknowns).
      real(dp), allocatable :: load_row(:)
      !> The kernel of the images, with or without a series: see `prepare` there. start_equations keeps this component.
      type(lattice_images) :: images
   contains
      procedure :: linearise, integral
   end type contact_equations

contains

   !> Chooses points of collocation and rules for fitted functions of the same degree, number of shape terms and
   !> symmetry as a given one.
   subroutine start_equations(equations, like, merging_ratio)
      type(contact_equations), intent(inout) :: equations
      type(fitted_function), intent(in) :: like   !! the given fitted function
      real(dp), intent(in) :: merging_ratio       !! merging ratio of the shape: 0 for a point, 1 where neighbours touch

      type(contact_equations) :: new
      real(dp) :: phi
      integer :: angles, finer, fold, i, j, n, radii

      new%images = equations%images
      equations = new
      fold = like%basis%fold
      equations%constraints = merge(0, 1, like%pool .and. like%work <= 0.0_dp)
      equations%before_shape = like%basis%terms + equations%constraints
      equations%unknowns = equations%before_shape + size(like%shape%b)
      ! The rule of chords for the singular integral and the rule over the disc for the images.
      associate (degree => like%basis%degree, b => like%shape%b)
         ! Sharp tips make the divided difference on the chords less smooth. Near neighbours make the images' kernel
         ! less smooth.
         angles = int(chords_per_degree*degree) + 4
         if (merging_ratio > sharp_quadrature_ratio) angles = int(sharp_chords_per_degree*degree) + min(20, degree)
         ! On an ellipse the coefficients of 1/|Q| in the angle fall as the powers of b_1/b_0.
         if (fold == 2) angles = angles + ceiling(-log(epsilon(1.0_dp))/log(b(0)/max(abs(b(1)), epsilon(1.0_dp))))
         call start_chord_rule(equations%chords, like%pool, like%basis, ubound(b, 1), angles, &
                               merge(degree + 1, degree/2 + extra_chord_points, like%pool .and. like%work > 0.0_dp))
         finer = merge(1, 0, merging_ratio > sharp_quadrature_ratio)
         ! Low degrees are not accurate enough to need many more points.
         if (merging_ratio > near_images_ratio) finer = min(6, degree/4)
         call start_disc_rule(equations%rule, like%basis%power, fold, degree/2 + 2 + finer, &
                              degree/fold + extra_disc_angles + finer)
      end associate
      n = size(equations%rule%point)
      allocate (equations%values(n, like%basis%terms))
      call like%basis%evaluate(n, equations%rule%point, equations%values)
      ! Points of collocation, README.md, section 8: they lie on rays at the midpoints of equal angles, and on each ray
      ! they are dense towards the edge. There are at least two more radii than axisymmetric functions have unknowns.
      ! With as many radii as unknowns the size of the shape would not be determined.
      radii = like%basis%degree/2 + merge(pool_extra_radii, spot_extra_radii, like%pool)
      angles = like%basis%degree/fold + merge(pool_extra_angles, spot_extra_angles, like%pool)
      if (merging_ratio > sharp_collocation_ratio) angles = int(sharp_collocation_factor*angles)
      ! For a round shape each term b_k is one harmonic of the angle. With only K angles the last harmonic would vanish
      ! at all of them.
      angles = max(angles, ubound(like%shape%b, 1) + 1)
      n = radii*angles
      associate (e => merge(angles, 0, like%work > 0.0_dp))
         allocate (equations%target(n), equations%matrix(n + e, equations%unknowns), equations%residual(n + e), &
                   equations%load_row(equations%unknowns), equations%edge_values(e, like%basis%terms))
         equations%edge = [(exp(cmplx(0.0_dp, pi*(j - 0.5_dp)/(fold*angles), dp)), j=1, e)]
         call like%basis%evaluate(e, equations%edge, equations%edge_values)
      end associate
      do j = 1, angles
         phi = pi*(j - 0.5_dp)/(fold*angles)
         equations%target((j - 1)*radii + 1:j*radii) = &
            [(sin(0.5_dp*pi*(i - 0.5_dp)/radii)*exp(cmplx(0.0_dp, phi, dp)), i=1, radii)]
      end do
   end subroutine start_equations

   !> Sets the matrix and the residual, README.md (F37) or (F38), and the derivatives `load_row`, for an approximation.
   subroutine linearise(self, lattice, now)
      class(contact_equations), intent(inout) :: self
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now   !! the approximation, of the kind that the equations were started for

      complex(dp) :: place_slope(0:ubound(now%shape%b, 1)), slope, z
      real(dp) :: known
      integer :: i, m

      m = size(self%target)
      associate (terms => now%basis%terms, first => self%before_shape + 1)
         do i = 1, m
            call self%chords%rows(now%basis, now%shape, self%target(i), now%c, self%matrix(i, :terms), &
                                  self%matrix(i, first:))
         end do
         self%load_row = 0.0_dp
         call self%images%add_rows(lattice, now, self%rule, self%values, self%target, self%matrix(:m, :terms), &
                                   self%matrix(:m, first:), self%load_row(:terms), self%load_row(first:))
         if (now%pool) self%matrix(:m, :) = self%matrix(:m, :)/(4*pi**2)
         call dgemv('N', m, terms, -1.0_dp, self%matrix, size(self%residual), now%c, 1, 0.0_dp, self%residual, 1)
         ! The terms that do not depend on the coefficients: for a spot the approach and the undeformed gap, for a pool
         ! the pressure of full contact. They also change with the positions of the targets.
         known = now%approach
         if (now%pool) known = now%load - lattice%closing_pressure
         if (self%constraints == 1) self%matrix(:m, self%before_shape) = -1.0_dp
         do i = 1, m
            z = now%shape%position_of(self%target(i))
            self%residual(i) = self%residual(i) + lattice%rise(now%pool, z) + known
            slope = -lattice%rise_slope(now%pool, z)
            call now%shape%linearise_position(self%target(i), place_slope)
            self%matrix(i, first:) = self%matrix(i, first:) + slope%re*place_slope%re + slope%im*place_slope%im
         end do
      end associate
      if (size(self%edge) > 0) call linearise_edge()

   contains

      !> Sets the equations of the edge, README.md (F67), behind those of the targets: at points of the edge the sum of
      !> c_i Psi_i(w) is the strength of the singular term that the work of adhesion requires. The equations are scaled
      !> to the size of the others.
      subroutine linearise_edge()
         real(dp) :: log_slope(0:ubound(now%shape%b, 1)), ratio, row_factor, strength
         integer :: i, row

         row_factor = pi**2*now%shape%b(0)
         if (now%pool) row_factor = 0.25_dp/now%shape%b(0)
         do i = 1, size(self%edge)
            row = size(self%target) + i
            call now%shape%linearise_edge(self%edge(i), ratio, log_slope)
            if (.not. ratio > 0.0_dp) then
               ! The map folds at the edge. NaN tells the caller that there is no step.
               self%residual(row) = not_a_number()
               return
            else if (now%pool) then
               strength = 4*sqrt(now%work/ratio)
               log_slope = -0.5_dp*log_slope
            else
               strength = -sqrt(now%work*ratio)/pi
               log_slope = 0.5_dp*log_slope
            end if
            self%matrix(row, :self%before_shape) = [row_factor*self%edge_values(i, :), 0.0_dp]
            self%matrix(row, self%before_shape + 1:) = -row_factor*strength*log_slope
            self%residual(row) = row_factor*(strength - dot_product(self%edge_values(i, :), now%c))
         end do
      end subroutine linearise_edge

   end subroutine linearise

   !> The integral over the spot or pool of the fitted function, p or g, times a function of the position.
   real(dp) function integral(self, now, factor)
      class(contact_equations), intent(in) :: self
      type(fitted_function), intent(in) :: now      !! of the kind that the equations were started for
      real(dp), intent(in), optional :: factor(:)   !! the function at the rule's points, shape (n); 1 if absent

      real(dp) :: at_points(size(self%rule%point))

      at_points = self%rule%weight*now%shape%jacobian(self%rule%point)*matmul(self%values, now%c)
      if (present(factor)) at_points = at_points*factor
      integral = sum(at_points)
   end function integral

end module wavycon_contact_equations
