!> The equations of contact of one spot below merging, or of one open island above, at points of the mapped
!> disc.
!>
!> Spot: its pressure p makes u + h = delta, and bears the load P on a cell. Island: its gap g makes the pressure
!> vanish, which is P + the sum of a_i |k_i| cos 2 pi k_i.x in full contact, and is changed by -(1/4 pi^2) times the
!> integral of g and the Laplacian of Gp, a finite part. Therefore
!>
!>     (1/4 pi^2) integral of Laplacian(Gp) g = pressure rise from the trough - (closing pressure - P).
!>
!> The power of 1 - |w|^2 leaves out the term that a wrong shape would bring in: only the right edge fits. So
!> the system in the coefficients, a spot's approach and the shape has more equations than unknowns.
module wavycon_contact_equations
   use wavycon_chord_rule, only: chord_rule, start_chord_rule
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule, plain_disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_fitted_tuning, only: chords_per_degree, extra_chord_points, extra_chords, extra_disc_angles, &
      extra_disc_radii, extra_sharp_chords, island_extra_angles, island_extra_radii, near_disc_extra, &
      near_images_ratio, sharp_chords_per_degree, sharp_collocation_factor, sharp_collocation_ratio, sharp_disc_extra, &
      sharp_quadrature_ratio, spot_extra_angles, spot_extra_radii
   use wavycon_image_rule, only: add_image_rows
   use wavycon_image_series, only: image_series
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: contact_equations, start_equations

   type :: contact_equations
      integer :: unknowns = 0                    !! N coefficients, a spot's approach, 1+K of the shape
      type(chord_rule) :: chords
      type(disc_rule) :: rule
      complex(dp), allocatable :: target(:)      !! in the disc, shape (m)
      real(dp), allocatable :: values(:, :)      !! of the basis at the rule's points, shape (n, N)
      real(dp), allocatable :: matrix(:, :)      !! derivatives of the equations, shape (m, unknowns)
      real(dp), allocatable :: rest(:)           !! right less left side, shape (m) [Delta], an island's [p*]
      real(dp), allocatable :: load_row(:)       !! derivatives of the load, shape (unknowns)
      real(dp), allocatable :: density(:)        !! the expansion at the rule's points, shape (n)
      type(image_series) :: images               !! without a radius, if there is none
   contains
      procedure :: linearise
      procedure, private :: add_images
      procedure, private :: linearise_load
      procedure :: integral
   end type contact_equations

contains

   !> Chooses targets and rules for expansions like the one given.
   subroutine start_equations(equations, like, reach, images)
      type(contact_equations), intent(out) :: equations
      type(expansion), intent(in) :: like
      real(dp), intent(in) :: reach   !! of the edge towards its neighbours; 1 touches
      type(image_series), intent(in), optional :: images
         !! of the lattice's kernel or its Laplacian; of use where it covers the shape

      integer :: angles, finer, fold, i, j, n, others, radii
      real(dp) :: phi

      fold = like%basis%fold
      others = 1
      if (like%island) others = 0
      equations%unknowns = like%basis%terms + others + size(like%shape%b)
      associate (degree => like%basis%degree)
         ! Sharp tips make the quotient on the chords less smooth, near neighbours the kernel.
         angles = int(chords_per_degree*degree) + extra_chords
         if (reach > sharp_quadrature_ratio) angles = int(sharp_chords_per_degree*degree) + extra_sharp_chords
         ! On an ellipse the quotient itself falls as a power of b_1/b_0 in the angle.
         if (fold == 2) angles = angles + ceiling(-log(epsilon(1.0_dp)) &
            /log(like%shape%b(0)/max(abs(like%shape%b(1)), epsilon(1.0_dp))))
         call start_chord_rule(equations%chords, like%basis, ubound(like%shape%b, 1), angles, &
                               degree/2 + extra_chord_points)
         finer = 0
         if (reach > sharp_quadrature_ratio) finer = sharp_disc_extra
         if (reach > near_images_ratio) finer = near_disc_extra
         call plain_disc_rule(equations%rule, like%basis%power, fold, &
                              degree/2 + extra_disc_radii + finer, degree/fold + extra_disc_angles + finer)
         ! Two more than the unknowns of the round part of a function: with as many, any size would do.
         radii = degree/2 + merge(island_extra_radii, spot_extra_radii, like%island)
         angles = degree/fold + merge(island_extra_angles, spot_extra_angles, like%island)
         ! Sharper shapes are better determined by half as many again.
         if (reach > sharp_collocation_ratio) angles = int(sharp_collocation_factor*angles)
         ! Of a round shape each term is a harmonic of the angle, and the last would vanish at as many angles.
         angles = max(angles, ubound(like%shape%b, 1) + 1)
      end associate
      allocate (equations%target(radii*angles))
      n = 0
      do j = 1, angles
         phi = pi*(j - 0.5_dp)/(fold*angles)
         do i = 1, radii
            n = n + 1
            equations%target(n) = sin(0.5_dp*pi*(i - 0.5_dp)/radii)*exp(cmplx(0.0_dp, phi, dp))
         end do
      end do
      n = size(equations%rule%point)
      allocate (equations%values(n, like%basis%terms), equations%density(n))
      call like%basis%evaluate(n, equations%rule%point, equations%values)
      associate (m => size(equations%target))
         allocate (equations%matrix(m, equations%unknowns), equations%rest(m), &
                   equations%load_row(equations%unknowns))
      end associate
      if (present(images)) equations%images = images
   end subroutine start_equations

   !> Sets the matrix and the rest at an expansion.
   subroutine linearise(self, lattice, load, now)
      class(contact_equations), intent(inout) :: self
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load            !! P
      type(expansion), intent(in) :: now      !! like the one the equations were started for

      complex(dp) :: slope, v, z
      real(dp) :: slopes(0:ubound(now%shape%b, 1)), row(now%basis%terms)
      integer :: fold, i, k, m, n, shapes, terms

      terms = now%basis%terms
      shapes = self%unknowns - size(now%shape%b)
      fold = now%basis%fold
      m = size(self%target)
      n = size(self%rule%point)
      call dgemv('N', n, terms, 1.0_dp, self%values, n, now%c, 1, 0.0_dp, self%density, 1)
      do i = 1, m
         call self%chords%rows(now%basis, now%shape, self%target(i), now%c, row, slopes)
         self%matrix(i, :terms) = row
         self%matrix(i, shapes + 1:) = slopes
      end do
      call self%add_images(lattice, now)
      if (now%island) self%matrix = self%matrix/(4*pi**2)
      call dgemv('N', m, terms, -1.0_dp, self%matrix, m, now%c, 1, 0.0_dp, self%rest, 1)
      do i = 1, m
         z = now%shape%place(self%target(i))
         if (now%island) then
            self%rest(i) = self%rest(i) + lattice%pressure_rise(z) - (lattice%closing_pressure - load)
            slope = -lattice%pressure_rise_slope(z)
         else
            self%rest(i) = self%rest(i) + now%approach - lattice%undeformed_gap(z)
            self%matrix(i, terms + 1) = -1.0_dp
            slope = lattice%undeformed_slope(z)
         end if
         v = now%shape%crowded(self%target(i))
         do k = 0, ubound(now%shape%b, 1)
            if (k > 0) v = conjg(self%target(i))**(fold*k - 1)
            self%matrix(i, shapes + 1 + k) = self%matrix(i, shapes + 1 + k) + slope%re*v%re + slope%im*v%im
         end do
      end do
      if (.not. now%island) call self%linearise_load(now)
   end subroutine linearise

   !> Adds to the matrix what all other spots or islands, and the mean, do.
   subroutine add_images(self, lattice, now)
      class(contact_equations), intent(inout) :: self
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      integer :: shapes

      shapes = self%unknowns - size(now%shape%b)
      associate (rows => self%matrix(:, :now%basis%terms), shape_rows => self%matrix(:, shapes + 1:))
         if (now%island .and. lattice%troughs == 2) then
            call add_image_rows(lattice%kernel, now%island, now%shape, self%rule, self%values, now%c, self%target, &
                                rows, shape_rows, opposite=2*lattice%trough)
            return
         else if (.not. self%images%covers(now%shape)) then
            call add_image_rows(lattice%kernel, now%island, now%shape, self%rule, self%values, now%c, self%target, &
                                rows, shape_rows)
            return
         end if
         call self%images%add_rows(now%shape, self%rule, self%values, now%c, self%target, rows, shape_rows)
         if (size(self%images%near, 2) > 0) &
            call add_image_rows(lattice%kernel, now%island, now%shape, self%rule, self%values, now%c, self%target, &
                                rows, shape_rows, self%images%near)
      end associate
   end subroutine add_images

   !> Derivatives of the load that a spot bears.
   subroutine linearise_load(self, now)
      class(contact_equations), intent(inout) :: self
      type(expansion), intent(in) :: now

      real(dp) :: jacobian, slope(0:ubound(now%shape%b, 1))
      integer :: i, shapes

      shapes = self%unknowns - size(now%shape%b)
      self%load_row = 0.0_dp
      do i = 1, size(self%rule%point)
         call now%shape%linearise_jacobian(self%rule%point(i), jacobian, slope)
         self%load_row(:now%basis%terms) = self%load_row(:now%basis%terms) &
            + self%rule%weight(i)*jacobian*self%values(i, :)
         self%load_row(shapes + 1:) = self%load_row(shapes + 1:) + self%rule%weight(i)*self%density(i)*slope
      end do
   end subroutine linearise_load

   !> Integral over the spot or island of an expansion times a function of the place: of p or g.
   real(dp) function integral(self, now, factor)
      class(contact_equations), intent(in) :: self
      type(expansion), intent(in) :: now
      real(dp), intent(in), optional :: factor(:)   !! the function at the rule's points, shape (n)

      real(dp) :: product(size(self%rule%point))

      product = self%rule%weight*now%shape%jacobian(self%rule%point)*matmul(self%values, now%c)
      if (present(factor)) product = product*factor
      integral = sum(product)
   end function integral

end module wavycon_contact_equations
