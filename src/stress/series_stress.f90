!> The stresses under a pressure that is a Fourier series: full contact, the paper's series, the points of a grid.
!>
!> Equations (S1) to (S5) of README.md in this directory.
module wavycon_series_stress
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi, sqrt3
   use wavycon_elastic_body, only: elastic_body
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_tensor, only: largest_shear, von_mises, xx, xy, xz, yy, yz, zz
   use wavycon_stress_tuning, only: coarsest, octave_factor, plane_points, plane_ratio, pressure_part, waves_in_depth
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: series_stress, start_series_stress

   integer, parameter :: number_of_sums = 11

   !> Waves whose factor exp(-q Z) is smaller than exp(-37) are rounding.
   real(dp), parameter :: deepest = 37.0_dp

   type, extends(stress_fields) :: series_stress
      private
      !> W of (S3), p = P + sum of Re W exp(i(kX + lY)) over k > 0, and over l > 0 for k = 0; shape (0:m, -n:n) [p*].
      complex(dp), allocatable :: wave(:, :)
      real(dp) :: sampled_from = huge(1.0_dp)   !! waves with q above this are those of a grid's last octave
      real(dp) :: pressure_error = 0.0_dp       !! of the pressure [p*]; NaN if there is no estimate
      real(dp) :: faintest = deepest            !! waves with q Z above this are left out
      real(dp), allocatable :: decay(:, :)      !! exp(-q Z) of the depth in use, shape (0:., 0:.)
      real(dp) :: decay_depth = 0.0_dp          !! Z [rad]
   contains
      procedure :: at
      procedure :: on_line
      procedure :: on_plane
      procedure :: start_places
      procedure, private :: use_depth
   end type series_stress

contains

   !> Prepares the stresses of a series.
   subroutine start_series_stress(stress, surface, pressure, pbar_over_pstar, pressure_error, is_sampled)
      type(series_stress), intent(out) :: stress
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: pressure    !! p/p*; the mean is ignored
      real(dp), intent(in) :: pbar_over_pstar         !! P
      real(dp), intent(in) :: pressure_error          !! estimate of the pressure's error [p*]; NaN: none
      logical, intent(in) :: is_sampled               !! whether the series is that of values on a grid

      integer :: k, l, m, n

      m = ubound(pressure%c, 1)
      n = ubound(pressure%c, 2)
      stress%pbar_over_pstar = pbar_over_pstar
      stress%dimension = surface%dimension
      stress%parts = surface%parts()
      stress%side_ratio = surface%length(2)/surface%length(1)
      if (surface%dimension == 1) stress%side_ratio = 1.0_dp
      stress%pressure_error = pressure_error
      if (.not. ieee_is_nan(pressure_error)) &
         stress%faintest = log(pressure_part/min(max(pressure_error, pressure_part*exp(-deepest)), coarsest))
      if (is_sampled) then
         stress%sampled_from = 0.5_dp*m
         if (n > 0) stress%sampled_from = 0.5_dp*min(real(m, dp), n/stress%side_ratio)
      end if
      allocate (stress%wave(0:m, -n:n), source=(0.0_dp, 0.0_dp))
      do l = 0, n
         do k = 0, m
            associate (up => stress%wave(k, l), down => stress%wave(k, -l))
               if (k == 0 .and. l == 0) cycle
               if (k > 0 .and. l > 0) then
                  up = 0.5_dp*pressure%c(k, l)
                  down = up
                  if (pressure%is_even()) cycle
                  up = up - 0.5_dp*cmplx(pressure%ss(k, l), pressure%sc(k, l) + pressure%cs(k, l), dp)
                  down = down + 0.5_dp*cmplx(pressure%ss(k, l), pressure%cs(k, l) - pressure%sc(k, l), dp)
               else
                  up = pressure%c(k, l)
                  if (pressure%is_even()) cycle
                  if (l == 0) up = up - cmplx(0.0_dp, pressure%sc(k, l), dp)
                  if (k == 0) up = up - cmplx(0.0_dp, pressure%cs(k, l), dp)
               end if
            end associate
         end do
      end do
   end subroutine start_series_stress

   !> The sums (S4) at one point.
   subroutine at(self, x, y, depth, parts, error)
      class(series_stress), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(in) :: depth
      real(dp), intent(out) :: parts(6, 2)
      real(dp), intent(out), optional :: error

      complex(dp) :: turn_x(0:ubound(self%wave, 1)), wave
      real(dp) :: q, q_y, sums(number_of_sums)
      logical :: with_error
      integer :: k, l, last(2)

      if (.not. self%exist) then
         parts = ieee_value(parts, ieee_quiet_nan)
         if (present(error)) error = ieee_value(error, ieee_quiet_nan)
         return
      end if
      call self%use_depth(depth)
      last = ubound(self%decay) - 1
      turn_x(:last(1)) = [(exp(cmplx(0.0_dp, k*x, dp)), k=0, last(1))]
      with_error = present(error) .and. octave_reaches(self)
      sums = 0.0_dp
      do l = -last(2), last(2)
         q_y = l/self%side_ratio
         associate (turn_y => exp(cmplx(0.0_dp, l*y, dp)))
            do k = merge(1, 0, l <= 0), last(1)
               if (is_zero(self%wave(k, l))) cycle
               wave = self%decay(k, abs(l))*self%wave(k, l)*turn_x(k)*turn_y
               q = sqrt(k**2 + q_y**2)
               associate (a => wave%re, b => wave%im, of_x => k*wave%re/q**2, x => real(k, dp))
                  sums(1) = sums(1) + a
                  sums(2) = sums(2) + q*a
                  sums(3) = sums(3) + x*of_x
                  sums(4) = sums(4) + q*(x*of_x)
                  sums(5) = sums(5) + q_y*of_x
                  sums(6) = sums(6) + q*(q_y*of_x)
                  sums(7) = sums(7) - x*b
                  sums(8) = sums(8) - q_y*b
               end associate
               if (.not. with_error .or. q <= self%sampled_from) cycle
               sums(9:) = sums(9:) + real(octave_weights(k/q, q_y/q, q*depth)*wave)
            end do
         end associate
      end do
      sums([2, 4, 6, 7, 8]) = depth*sums([2, 4, 6, 7, 8])
      parts = parts_of(sums)
      if (present(error)) error = error_of(self, parts, sums(9:))
   end subroutine at

   !> The stresses from the sums (S4).
   pure function parts_of(sums) result(parts)
      real(dp), intent(in) :: sums(number_of_sums)
      real(dp) :: parts(6, 2)

      parts = 0.0_dp
      parts(xx, 1) = sums(4) - sums(3)
      parts(yy, 1) = (sums(2) - sums(4)) - (sums(1) - sums(3))
      parts(zz, 1) = -(sums(1) + sums(2))
      parts(xy, 1) = sums(6) - sums(5)
      parts(xz, 1) = sums(7)
      parts(yz, 1) = sums(8)
      parts(xx, 2) = -2*(sums(1) - sums(3))
      parts(yy, 2) = -2*sums(3)
      parts(xy, 2) = 2*sums(5)
   end function parts_of

   !> The sums (S4) along a line: its waves are first added up to those with the same wave number d_x k + d_y l along t.
   subroutine on_line(self, start, direction, t, depth, parts, error)
      class(series_stress), intent(inout) :: self
      real(dp), intent(in) :: start(2)
      integer, intent(in) :: direction(2)
      real(dp), intent(in) :: t(:)
      real(dp), intent(in) :: depth
      real(dp), intent(out) :: parts(:, :, :), error(:)

      complex(dp), allocatable :: along(:, :)
      complex(dp) :: turn_x(0:ubound(self%wave, 1)), wave, weights(number_of_sums)
      real(dp) :: n_x, n_y, q, q_y, sums(number_of_sums)
      integer :: i, k, l, last(2), m

      if (.not. self%exist) then
         parts = ieee_value(parts, ieee_quiet_nan)
         error = ieee_value(error, ieee_quiet_nan)
         return
      end if
      call self%use_depth(depth)
      last = ubound(self%decay) - 1
      turn_x(:last(1)) = [(exp(cmplx(0.0_dp, k*start(1), dp)), k=0, last(1))]
      m = dot_product(abs(direction), last)
      allocate (along(number_of_sums, -m:m), source=(0.0_dp, 0.0_dp))
      do l = -last(2), last(2)
         q_y = l/self%side_ratio
         associate (turn_y => exp(cmplx(0.0_dp, l*start(2), dp)))
            do k = merge(1, 0, l <= 0), last(1)
               if (is_zero(self%wave(k, l))) cycle
               wave = self%decay(k, abs(l))*self%wave(k, l)*turn_x(k)*turn_y
               q = sqrt(k**2 + q_y**2)
               n_x = k/q
               n_y = q_y/q
               weights(1:5:2) = [1.0_dp, n_x**2, n_x*n_y]
               weights(2:6:2) = q*depth*weights(1:5:2)
               weights(7:8) = cmplx(0.0_dp, [real(k, dp), q_y]*depth, dp)
               weights(9:) = 0.0_dp
               if (q > self%sampled_from) weights(9:) = octave_weights(n_x, n_y, q*depth)
               m = direction(1)*k + direction(2)*l
               along(:, m) = along(:, m) + weights*wave
            end do
         end associate
      end do
      do i = 1, size(t)
         sums = 0.0_dp
         do m = lbound(along, 2), ubound(along, 2)
            sums = sums + real(along(:, m)*exp(cmplx(0.0_dp, m*t(i), dp)))
         end do
         parts(:, :, i) = parts_of(sums)
         error(i) = error_of(self, parts(:, :, i), sums(9:))
      end do
   end subroutine on_line

   !> The error (S5).
   pure real(dp) function error_of(stress, parts, octave)
      class(series_stress), intent(in) :: stress
      real(dp), intent(in) :: parts(6, 2)
      real(dp), intent(in) :: octave(3)   !! sums over the waves of the last octave, with the weights below

      error_of = stress%pressure_error + octave_factor*norm2(octave)
      if (.not. ieee_is_nan(error_of)) error_of = max(error_of, parts(zz, 1) - stress%pbar_over_pstar)
   end function error_of

   !> The weights of a wave of the last octave in (S5), to its sign.
   pure function octave_weights(n_x, n_y, q_z) result(weights)
      real(dp), intent(in) :: n_x, n_y   !! its direction
      real(dp), intent(in) :: q_z        !! q Z
      complex(dp) :: weights(3)

      weights = (1.0_dp + q_z)*[(1.0_dp, 0.0_dp), cmplx(0.0_dp, n_x, dp), cmplx(0.0_dp, n_y, dp)]
   end function octave_weights

   !> Computes the factors exp(-q Z) of a depth, unless they are those of the last call.
   subroutine use_depth(self, depth)
      class(series_stress), intent(inout) :: self
      real(dp), intent(in) :: depth   !! Z [rad]

      real(dp) :: q_z
      integer :: k, l, last(2)

      if (allocated(self%decay)) then
         if (abs(depth - self%decay_depth) <= 0.0_dp) return
         deallocate (self%decay)
      end if
      last = ubound(self%wave)
      if (depth > 0.0_dp) last = floor(min(self%faintest/depth*[1.0_dp, self%side_ratio], real(last, dp)))
      ! With one more in each direction, for a series without waves in one of them.
      allocate (self%decay(0:last(1) + 1, 0:last(2) + 1), source=0.0_dp)
      do l = 0, last(2)
         do k = 0, last(1)
            q_z = depth*sqrt(k**2 + (l/self%side_ratio)**2)
            if (q_z > self%faintest) exit
            self%decay(k, l) = exp(-q_z)
         end do
      end do
      self%decay_depth = depth
   end subroutine use_depth

   !> Whether waves of the last octave reach the depth in use.
   pure logical function octave_reaches(stress)
      class(series_stress), intent(in) :: stress

      octave_reaches = norm2((ubound(stress%decay) - 1)*[1.0_dp, 1.0_dp/stress%side_ratio]) > stress%sampled_from
   end function octave_reaches

   !> Series on turned cells have many such waves.
   pure logical function is_zero(wave)
      complex(dp), intent(in) :: wave

      is_zero = abs(wave%re) <= 0.0_dp .and. abs(wave%im) <= 0.0_dp
   end function is_zero

   !> One transform for each component, and three for the error (S5). Waves that the points cannot tell from slower
   !> ones are added to those, so that the values are exact for any number of points.
   subroutine on_plane(self, points, offset, depth, body, stress, error)
      class(series_stress), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), intent(in) :: depth
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: stress(:, :, :)
      real(dp), allocatable, intent(out) :: error(:, :)

      real(dp), allocatable :: fields(:, :, :)
      integer :: i, number

      if (.not. self%exist) then
         allocate (stress(points(1), points(2), 6), error(points(1), points(2)))
         stress = ieee_value(stress, ieee_quiet_nan)
         error = ieee_value(error, ieee_quiet_nan)
         return
      end if
      call self%use_depth(depth)
      number = merge(9, 6, octave_reaches(self))
      call transform_waves(self, self%parts*points, offset, depth, body, number, fields)
      if (any(self%parts > 1)) fields = fields(:points(1), :points(2), :)
      allocate (error(points(1), points(2)), source=0.0_dp)
      do i = 7, number
         error = error + fields(:, :, i)**2
      end do
      error = self%pressure_error + octave_factor*sqrt(error)
      if (.not. ieee_is_nan(self%pressure_error)) error = max(error, fields(:, :, zz))
      if (number == 6) then
         call move_alloc(fields, stress)
      else
         allocate (stress, source=fields(:, :, :6))
      end if
   end subroutine on_plane

   !> The six components on a plane and, if asked for, the three sums of (S5).
   subroutine transform_waves(self, points, offset, depth, body, number, fields)
      class(series_stress), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2), depth
      type(elastic_body), intent(in) :: body
      integer, intent(in) :: number                          !! of fields, 6 or 9
      real(dp), allocatable, intent(out) :: fields(:, :, :)  !! shape (N_x, N_y, number)

      complex(dp), allocatable :: waves(:, :, :)
      type(grid_transform) :: transform
      real(dp) :: mean(6)
      integer :: i

      allocate (fields(points(1), points(2), number))
      allocate (waves(points(1)/2 + 1, points(2), number), source=(0.0_dp, 0.0_dp))
      call transform%start(points, even=.false.)
      call add_waves(self, points, offset, depth, body%nu, waves)
      do i = 1, number
         transform%waves = waves(:, :, i)
         call transform%backward(fields(:, :, i))
      end do
      mean = body%stress(reshape([(0.0_dp, i=1, 12)], [6, 2]), self%pbar_over_pstar)
      do i = 1, 6
         if (abs(mean(i)) > 0.0_dp) fields(:, :, i) = fields(:, :, i) + mean(i)
      end do
   end subroutine transform_waves

   !> Adds the waves of the components of the stress to their spectra, and to three more, if there are, those of
   !> the last octave for the error (S5).
   subroutine add_waves(self, points, offset, depth, nu, spectra)
      class(series_stress), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2), depth, nu
      complex(dp), intent(inout) :: spectra(0:, 0:, :)   !! shape (0:N_x/2, 0:N_y - 1, 6 or 9)

      complex(dp) :: here(size(spectra, 3)), turn_x(0:ubound(self%wave, 1)), wave
      real(dp) :: n_x, n_y, q, q_y
      integer :: k, l, last(2)

      call self%use_depth(depth)
      last = ubound(self%decay) - 1
      turn_x = [(exp(cmplx(0.0_dp, 2*pi*modulo(k*offset(1)/points(1), 1.0_dp), dp)), k=0, ubound(self%wave, 1))]
      do l = -last(2), last(2)
         q_y = l/self%side_ratio
         associate (turn_y => exp(cmplx(0.0_dp, 2*pi*modulo(l*offset(2)/points(2), 1.0_dp), dp)))
            do k = merge(1, 0, l <= 0), last(1)
               if (is_zero(self%wave(k, l))) cycle
               q = sqrt(k**2 + q_y**2)
               if (q*depth > self%faintest) exit
               wave = 0.5_dp*self%decay(k, abs(l))*self%wave(k, l)*turn_x(k)*turn_y
               n_x = k/q
               n_y = q_y/q
               here(xx) = -(n_x**2*(1.0_dp - q*depth) + 2*nu*n_y**2)*wave
               here(yy) = -(n_y**2*(1.0_dp - q*depth) + 2*nu*n_x**2)*wave
               here(zz) = -(1.0_dp + q*depth)*wave
               here(xy) = -n_x*n_y*(1.0_dp - 2*nu - q*depth)*wave
               here(xz) = cmplx(0.0_dp, k*depth, dp)*wave
               here(yz) = cmplx(0.0_dp, q_y*depth, dp)*wave
               here(7:) = (0.0_dp, 0.0_dp)
               if (q > self%sampled_from .and. size(here) > 6) here(7:) = octave_weights(n_x, n_y, q*depth)*wave
               call add(modulo(k, points(1)), modulo(l, points(2)), here)
               call add(modulo(-k, points(1)), modulo(-l, points(2)), conjg(here))
            end do
         end associate
      end do

   contains

      !> Adds a wave, unless it belongs to the half of the spectrum that the transform takes from the other one.
      subroutine add(k, l, here)
         integer, intent(in) :: k, l
         complex(dp), intent(in) :: here(:)

         if (2*k <= points(1)) spectra(k, l, :) = spectra(k, l, :) + here
      end subroutine add

   end subroutine add_waves

   !> The places of the largest von Mises stress and of the largest shear on planes from the surface down, each at about
   !> `plane_ratio` times the depth of the one before. Deeper planes need fewer points.
   subroutine start_places(self, body, places, widths, stresses)
      class(series_stress), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: places(:, :)
      real(dp), allocatable, intent(out) :: widths(:)
      real(dp), allocatable, intent(out) :: stresses(:, :)

      !> Of a plane: stresses and their spectra, and two measures.
      integer(int64), parameter :: numbers_a_point = 16
      real(dp), allocatable :: depth(:), shear(:, :), stress(:, :, :), yielding(:, :)
      real(dp) :: here(6), least, step
      integer :: i, k, l, points(2)

      step = pi/max(plane_points/2.0_dp, real(maxval(ubound(self%wave)), dp))
      allocate (depth(2 + ceiling(log(2*pi/step)/log(plane_ratio))), source=0.0_dp)
      do i = 2, size(depth)
         depth(i) = step*plane_ratio**(i - 2)
      end do
      allocate (places(3, 2*size(depth)), widths(2*size(depth)), stresses(6, 2*size(depth)))
      do i = 1, size(depth)
         points = plane_of(depth(i))
         if (self%dimension == 1) points(2) = 1
         do while (.not. has_memory_for(numbers_a_point*product(int(points, int64))))
            points = (points + 1)/2
         end do
         call transform_waves(self, points, [0.0_dp, 0.0_dp], depth(i), body, 6, stress)
         allocate (yielding(points(1), points(2)), shear(points(1), points(2)), source=0.0_dp)
         do l = 1, points(2)
            do k = 1, points(1)
               here = stress(k, l, :)
               yielding(k, l) = von_mises(here)
            end do
         end do
         ! A shear stress is between 1/2 and 1/sqrt3 of the von Mises stress: below this bound it is not the largest.
         least = 0.5_dp*sqrt3*maxval(yielding)
         do l = 1, points(2)
            do k = 1, points(1)
               if (yielding(k, l) < least) cycle
               here = stress(k, l, :)
               shear(k, l) = largest_shear(here)
            end do
         end do
         call take(2*i - 1, maxloc(yielding))
         call take(2*i, maxloc(shear))
         widths(2*i - 1:2*i) = max(depth(i), step)
         deallocate (yielding, shear)
      end do

   contains

      !> Takes a point of the plane as a place.
      subroutine take(place, point)
         integer, intent(in) :: place, point(2)

         places(:, place) = [2*pi*(point - 1)/points, depth(i)]
         stresses(:, place) = stress(point(1), point(2), :)
      end subroutine take

      !> Points along X and Y that resolve the waves that reach a depth.
      function plane_of(depth) result(points)
         real(dp), intent(in) :: depth
         integer :: points(2)

         !> Lengths of which are fast to transform.
         integer, parameter :: multiple = 8
         real(dp) :: most

         most = 2.0_dp*ubound(self%wave, 1)
         if (depth > 0.0_dp) most = min(most, waves_in_depth/depth)
         points(1) = max(plane_points, multiple*ceiling(most/multiple))
         most = 2.0_dp*ubound(self%wave, 2)
         if (depth > 0.0_dp) most = min(most, waves_in_depth/depth*self%side_ratio)
         points(2) = max(plane_points, multiple*ceiling(most/multiple))
      end function plane_of

   end subroutine start_places

end module wavycon_series_stress
