!> Sums over the waves of a pressure that is a Fourier series, (S3) of README.md in this directory: which waves reach a
!> depth, their moments at a point, (S9), the spectra of the stresses on a plane, (S1) and (S5), and the largest
!> stresses of a plane, (S10).
!>
!> As in (S3) a wave has the numbers k >= 0 and l, the wave vector (k, l'), l' = l L_x/L_y, and its length q.
module wavycon_pressure_wave_sums
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, pi, sqrt3
   use wavycon_lapack, only: dgemm
   use wavycon_stress_tensor, only: elastic_body, largest_shear, no_waves, xx, xy, xz, yy, yz, zz
   use wavycon_stress_tuning, only: faintest_on_planes
   use wavycon_wave_packing, only: fold_waves
   implicit none (type, external)
   private

   public :: pressure_wave_sums

   !> Waves whose factor of depth exp(-q Z) is smaller than exp(-37) = 9e-17 are less than rounding.
   real(dp), parameter, public :: deepest = 37.0_dp

   type :: pressure_wave_sums
      real(dp) :: side_ratio = 1.0_dp           !! L_y/L_x
      type(fourier_series) :: pressure          !! the pressure less its mean: the waves W of (S3) [p*]
      real(dp) :: sampled_from = huge(1.0_dp)   !! waves with q above this are the last octave of a grid, (S5)
      real(dp) :: faintest = deepest            !! waves with q Z above this are left out
   contains
      procedure :: start, last_waves, octave_reaches, find_moments, find_spectra, scan_plane
   end type pressure_wave_sums

contains

   !> Takes the waves of a pressure and, if the series is that of a grid, sets its last octave: half of the grid's
   !> highest wave number and more, in the direction where this is less.
   subroutine start(self, pressure, side_ratio, is_sampled)
      class(pressure_wave_sums), intent(out) :: self
      type(fourier_series), intent(in) :: pressure    !! pressure less its mean [p*]
      real(dp), intent(in) :: side_ratio              !! L_y/L_x, > 0
      logical, intent(in) :: is_sampled               !! whether the series is the one through values at a grid's points

      call assert(side_ratio > 0.0_dp, 'side_ratio > 0')
      self%side_ratio = side_ratio
      self%pressure = pressure
      if (.not. is_sampled) return
      self%sampled_from = 0.5_dp*pressure%last(1)
      if (pressure%last(2) > 0) self%sampled_from = min(self%sampled_from, 0.5_dp*pressure%last(2)/side_ratio)
   end subroutine start

   !> The highest wave numbers k and l of the waves that reach a depth, which have q Z <= `faintest`.
   pure function last_waves(self, depth) result(last)
      class(pressure_wave_sums), intent(in) :: self
      real(dp), intent(in) :: depth      !! Z >= 0 [rad]
      integer :: last(2)

      last = self%pressure%last([1, 2])
      if (depth > 0.0_dp) last = floor(min(self%faintest/depth*[1.0_dp, self%side_ratio], real(last, dp)))
   end function last_waves

   !> Whether any wave of the last octave may reach a depth.
   pure logical function octave_reaches(self, depth)
      class(pressure_wave_sums), intent(in) :: self
      real(dp), intent(in) :: depth   !! Z >= 0 [rad]

      octave_reaches = norm2(self%last_waves(depth)*[1.0_dp, 1.0_dp/self%side_ratio]) > self%sampled_from
   end function octave_reaches

   !> The moments (S9) of the waves at a point, M_abc = sum of k^a l'^b q^c W exp(i (k X + l Y) - q Z).
   !>
   !> The moments with c = -2 and c = -1 are sums over all waves. For each l the sum over k is a product of matrices.
   !> The other moments follow from these two: as q^2 = k^2 + l'^2, M_ab(c+2) = M_(a+2)bc + M_a(b+2)c.
   subroutine find_moments(self, place, order, moment)
      class(pressure_wave_sums), intent(in) :: self
      real(dp), intent(in) :: place(3)                          !! X, Y, Z [rad]
      integer, intent(in) :: order                              !! order N of the Taylor series, >= 0
      !> M_abc [p*], a and b from 0 to n, c from -2 to n - 2, n = order + 3; those with a + b + c + 2 > n are not used.
      complex(dp), allocatable, intent(out) :: moment(:, :, :)

      complex(dp), allocatable :: waves(:)
      real(dp), allocatable :: factor(:), powers(:, :, :), q(:), weighted(:, :, :)
      complex(dp) :: along_y, sum_x(0:order + 3, -2:-1), turn_x, turn_y
      real(dp) :: q_y, sums(2, 0:order + 3, 2, 2)
      integer :: a, b, c, k, l, last(2), n, number
      logical :: is_even

      n = order + 3
      last = self%last_waves(place(3))
      is_even = self%pressure%is_even()
      allocate (moment(0:n, 0:n, -2:n - 2), source=(0.0_dp, 0.0_dp))
      allocate (powers(2, 0:n, 0:last(1)), weighted(0:last(1), 2, 2), q(0:last(1)), factor(0:last(1)), waves(0:last(1)))
      do k = 0, last(1)
         turn_x = turn(k*place(1))
         powers(1, :, k) = [(turn_x%re*real(k, dp)**a, a=0, n)]
         powers(2, :, k) = [(turn_x%im*real(k, dp)**a, a=0, n)]
      end do
      sums = 0.0_dp
      ! The waves of an even pressure are real, and those of l and -l are equal.
      do l = merge(0, -last(2), is_even), last(2)
         q_y = l/self%side_ratio
         do k = 0, last(1)
            q(k) = sqrt(real(k, dp)**2 + q_y**2)
         end do
         number = count(q*place(3) <= self%faintest)
         if (number == 0) cycle
         q(0) = max(q(0), tiny(q))
         associate (m => number - 1)
            waves(:m) = self%pressure%row(l, m)
            factor(:m) = exp(-q(:m)*place(3))/q(:m)
            if (l == 0) factor(0) = 0.0_dp
            weighted(:m, 2, 1) = factor(:m)*waves(:m)%re
            weighted(:m, 1, 1) = weighted(:m, 2, 1)/q(:m)
            if (.not. is_even) then
               weighted(:m, 2, 2) = factor(:m)*waves(:m)%im
               weighted(:m, 1, 2) = weighted(:m, 2, 2)/q(:m)
            end if
         end associate
         call dgemm('N', 'N', 2*(n + 1), merge(2, 4, is_even), number, 1.0_dp, powers, 2*(n + 1), &
                    weighted, last(1) + 1, 0.0_dp, sums, 2*(n + 1))
         sum_x = cmplx(sums(1, :, :, 1) - sums(2, :, :, 2), sums(2, :, :, 1) + sums(1, :, :, 2), dp)
         turn_y = turn(l*place(2))
         do b = 0, n
            along_y = q_y**b*turn_y
            if (is_even .and. l > 0) along_y = along_y + (-q_y)**b*conjg(turn_y)
            moment(:n - b, b, :-1) = moment(:n - b, b, :-1) + along_y*sum_x(:n - b, :)
         end do
      end do
      do c = 0, n - 2
         do b = 0, n - 2 - c
            do a = 0, n - 2 - c - b
               moment(a, b, c) = moment(a + 2, b, c - 2) + moment(a, b + 2, c - 2)
            end do
         end do
      end do
   end subroutine find_moments

   !> The spectra of the stresses on a plane, in the form that `sample_waves` of wavycon_grid_transform takes.
   !>
   !> The number of spectra says which fields they belong to. 6: the components xx, yy, zz, xy, xz, yz, (S1). 9: also
   !> the sums S, S_x and S_y of the error, (S5). 5: the numbers of the deviator, (S10): eta_1, eta_2, and sqrt(3) times
   !> xy, xz and yz. 3: without xz and yz, which are zero at the surface. 2: below an even pressure, the sum of these
   !> five without eta_2, and eta_2. With 5, 3 and 2 waves with q Z > `faintest_on_planes` are left out.
   subroutine find_spectra(self, points, offset, depth, nu, spectra)
      class(pressure_wave_sums), intent(in) :: self
      integer, intent(in) :: points(2)                 !! N_x, N_y of the plane
      real(dp), intent(in) :: offset(2)                !! of the first point from X = Y = 0, in steps
      real(dp), intent(in) :: depth                    !! Z >= 0 [rad]
      real(dp), intent(in) :: nu                       !! Poisson's ratio
      complex(dp), intent(out) :: spectra(0:, 0:, :)   !! [p*], shape (0:N_x/2, 0:N_y - 1, number of fields)

      complex(dp), allocatable :: here(:, :), turn_x(:), wave(:)
      real(dp), allocatable :: k(:), q(:), q_z(:), shear(:)
      real(dp) :: limit, q_y
      integer :: i, j, l, last(2), number

      spectra = 0.0_dp
      number = size(spectra, 3)
      limit = merge(faintest_on_planes, self%faintest, number <= 5)
      last = self%last_waves(depth*max(1.0_dp, self%faintest/limit))
      allocate (here(0:last(1), 9), k(0:last(1)), q(0:last(1)), q_z(0:last(1)), shear(0:last(1)), wave(0:last(1)))
      k = [(real(i, dp), i=0, last(1))]
      turn_x = turn(2*pi*modulo(k*offset(1)/points(1), 1.0_dp))
      do l = -last(2), last(2)
         q_y = l/self%side_ratio
         q = sqrt(max(k**2 + q_y**2, tiny(q)))
         q_z = q*depth
         wave = 0.5_dp*exp(-q_z)*self%pressure%row(l, last(1))*turn_x*turn(2*pi*modulo(l*offset(2)/points(2), 1.0_dp))
         where (q_z > limit) wave = 0.0_dp
         ! Bounded where it is multiplied by zero: at the mean, and where waves have died out.
         shear = -(1.0_dp - 2*nu - min(q_z, limit))/max(q**2, sqrt(tiny(q)))
         select case (number)
         case (2)
            here(:, 1) = sqrt3*cmplx((0.5_dp*(k**2 - q_y**2) + k*q_y)*shear, (k + q_y)*depth, dp)*wave
            here(:, 2) = (0.5_dp - nu + 1.5_dp*q_z)*wave
         case (3, 5)
            here(:, 1) = 0.5_dp*sqrt3*(k**2 - q_y**2)*shear*wave
            here(:, 2) = (0.5_dp - nu + 1.5_dp*q_z)*wave
            here(:, 3) = sqrt3*k*q_y*shear*wave
            if (number == 5) then
               here(:, 4) = cmplx(0.0_dp, sqrt3*k*depth, dp)*wave
               here(:, 5) = cmplx(0.0_dp, sqrt3*q_y*depth, dp)*wave
            end if
         case default
            here(:, xy) = k*q_y*shear*wave
            here(:, xz) = cmplx(0.0_dp, k*depth, dp)*wave
            here(:, yz) = cmplx(0.0_dp, q_y*depth, dp)*wave
            here(:, xx) = (k**2*shear - 2*nu)*wave
            here(:, yy) = (q_y**2*shear - 2*nu)*wave
            here(:, zz) = -(1.0_dp + q_z)*wave
            here(:, 7) = (1.0_dp + q_z)*wave
            where (q <= self%sampled_from) here(:, 7) = 0.0_dp
            here(:, 8) = cmplx(0.0_dp, k/q, dp)*here(:, 7)
            here(:, 9) = cmplx(0.0_dp, q_y/q, dp)*here(:, 7)
         end select
         do j = 1, number
            call fold_waves(points, l, 0, here(:, j), spectra(:, :, j))
         end do
      end do
   end subroutine find_spectra

   !> Finds the points of a plane with the largest von Mises stress and with the largest shear stress, by (S10). The
   !> stresses are evaluated column by column, and no field of the whole plane is kept. Below an even pressure four of
   !> the five numbers of the deviator share one transform.
   subroutine scan_plane(self, pbar_over_pstar, points, first, last, depth, body, place, stress)
      class(pressure_wave_sums), intent(in) :: self
      real(dp), intent(in) :: pbar_over_pstar    !! mean pressure P [p*]
      integer, intent(in) :: points(2)           !! N_x, N_y of the plane
      integer, intent(in) :: first(2), last(2)   !! the first and the last point along X and Y to be compared, from 0
      real(dp), intent(in) :: depth              !! Z >= 0 [rad]
      type(elastic_body), intent(in) :: body
      integer, intent(out) :: place(2, 2)        !! numbers of the two points along X and Y, from 0, shape (2, points)
      real(dp), intent(out) :: stress(6, 2)      !! the deviators of the stress at the two points [p*]

      complex(dp), allocatable :: spectra(:, :, :)
      real(dp) :: here(6), largest(2), mean(6), shear
      real(dp), allocatable :: squares(:), sums(:, :), values(:, :)   ! sums: those at Y and at -Y
      type(grid_transform) :: plane
      integer :: i, j, number

      number = merge(3, 5, depth <= 0.0_dp)
      if (self%pressure%is_even()) number = 2
      allocate (spectra(0:points(1)/2, 0:points(2) - 1, number))
      call self%find_spectra(points, [0.0_dp, 0.0_dp], depth, body%nu, spectra)
      mean = body%stress(no_waves, pbar_over_pstar)
      spectra(0, 0, 2) = spectra(0, 0, 2) + mean(xx) - mean(zz)
      call plane%start(points, even=.false., whole=.true.)
      do i = 1, number
         call plane%sum_along_y(spectra(:, :, i))
      end do
      allocate (sums(0:points(1) - 1, 2), squares(first(1):last(1)))
      allocate (values(0:points(1) - 1, 5), source=0.0_dp)
      largest = -1.0_dp
      do j = first(2), last(2)
         do i = 1, number
            call plane%sample_columns(spectra(:, j:j, i), values(:, i:i))
         end do
         if (self%pressure%is_even()) then
            ! The four fields of the sum differ in their symmetry: each follows from the sum at +-X and +-Y.
            sums(:, 1) = values(:, 1)
            associate (l => modulo(-j, points(2)))
               call plane%sample_columns(spectra(:, l:l, 1), sums(:, 2:2))
            end associate
            do i = first(1), last(1)
               associate (a => sums(i, 1), b => sums(modulo(-i, points(1)), 1), c => sums(i, 2), &
                          d => sums(modulo(-i, points(1)), 2))
                  values(i, [1, 3, 4, 5]) = 0.25_dp*[a + b + c + d, a - b - c + d, a - b + c - d, a + b - c - d]
               end associate
            end do
         end if
         squares = values(first(1):last(1), 1)**2
         do i = 2, 5
            squares = squares + values(first(1):last(1), i)**2
         end do
         do i = first(1), last(1)
            ! The largest shear stress is at most 1/sqrt(3) of the von Mises stress. So the eigenvalues are computed
            ! only where the point may have the largest one.
            if (squares(i) <= min(largest(1), 3*largest(2)**2)) cycle
            here(xx) = values(i, 2)/3 + values(i, 1)/sqrt3
            here(yy) = values(i, 2)/3 - values(i, 1)/sqrt3
            here(zz) = -2*values(i, 2)/3
            here([xy, xz, yz]) = values(i, 3:5)/sqrt3
            shear = largest_shear(here)
            if (squares(i) > largest(1)) call take(1, squares(i))
            if (shear > largest(2)) call take(2, shear)
         end do
      end do

   contains

      !> Keeps the current point and its deviator as those of the largest stress found so far.
      subroutine take(k, value)
         integer, intent(in) :: k         !! 1: von Mises stress, 2: shear stress
         real(dp), intent(in) :: value    !! the square of the von Mises stress [p*^2], or the shear stress [p*]

         largest(k) = value
         place(:, k) = [i, j]
         stress(:, k) = here
      end subroutine take

   end subroutine scan_plane

end module wavycon_pressure_wave_sums
