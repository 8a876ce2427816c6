!> Makes random self-affine surfaces from their spectra. Equations (G1) to (G8) are in README.md of this directory.
module wavycon_self_affine
   use, intrinsic :: iso_c_binding, only: c_long, c_ptr
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_gsl, only: gsl_rng_alloc, gsl_rng_free, gsl_rng_mt19937, gsl_rng_set, gsl_rng_uniform
   use wavycon_kinds, only: dp, largest_number, pi, smallest_number
   use wavycon_measured_map, only: check_room
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_plain_text, only: short_number
   use wavycon_surface, only: surface_type
   use wavycon_surface_of_points, only: surface_of_points
   implicit none (type, external)
   private

   public :: self_affine_spectrum, self_affine_surface, least_points_of, has_waves, make_heights, sides_of_spectrum

   !> The waves of a periodic cell and their amplitudes.
   type :: self_affine_spectrum
      integer :: dimension = 2                !! 1: a profile along x; 2: a surface
      real(dp) :: length(2) = 1.0_dp          !! L_x, L_y, sides of the cell [length], > 0; L_y is not used in 1-D
      real(dp) :: hurst = 0.8_dp              !! Hurst exponent H, 0 to 1
      real(dp) :: longest = 1.0_dp            !! longest wavelength [length]
      real(dp) :: rolloff = 1.0_dp            !! wavelength of the roll-off: longer waves have its amplitude [length]
      real(dp) :: shortest = 1.0_dp           !! shortest wavelength [length], 0 < shortest <= rolloff <= longest
      real(dp) :: rms = 1.0_dp                !! root mean square of the height [length] or of the slope [-], > 0
      logical :: by_slope = .false.           !! true: `rms` is that of the slope; false: that of the height
      !> Spectral density of waves longer than the roll-off, (M26) or (M28) of src/core/map/README.md [length^4 or
      !> length^3]; 0 if `rms` gives the amplitudes.
      real(dp) :: density = 0.0_dp
      logical :: random_amplitudes = .false.  !! true: amplitudes of a Gaussian process; false: those of the spectrum
      integer :: seed = 1                     !! seed of the random numbers, >= 1
      real(dp) :: anisotropy = 1.0_dp         !! gamma of (G6), correlation length along x over that along y, > 0
   end type self_affine_spectrum

   !> A wave whose length is outside of a cut-off by this part, which is rounding, counts as inside.
   real(dp), parameter :: rounding = 1e-12_dp

contains

   !> Makes the surface of a spectrum. Errors: exit_file_trouble if there is not enough memory, exit_bad_input for
   !> heights out of range.
   subroutine self_affine_surface(source, spectrum, points, surface, map, error, has_free_edges, radii)
      character(*), intent(in) :: source                      !! name of the spectrum, for messages
      type(self_affine_spectrum), intent(in) :: spectrum      !! has_waves is true
      integer, intent(in) :: points(2)                        !! points of the cell's grid, at least least_points_of
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map   !! statistics of the heights at the points
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: has_free_edges         !! as of surface_of_points
      real(dp), intent(in), optional :: radii(2)              !! as of surface_of_points

      type(grid_slab) :: slab
      real(dp), allocatable :: height(:, :)
      real(dp) :: largest

      call slab%start(points)
      call check_room(source, points, error, slab)
      call slab%share_error(error)
      if (allocated(error)) return
      allocate (height(points(1), slab%columns()))
      call make_heights(spectrum, height, points)
      largest = maxval(slab%extremes(height))
      if (largest > largest_number .or. largest < smallest_number) then
         call fatal_error(error, exit_bad_input, source//': heights are up to '//short_number(largest)// &
                          ' [length]: lengths may be from '//short_number(smallest_number)//' to '// &
                          short_number(largest_number))
         return
      end if
      map = statistics_of(height, 'made', points, spectrum%length/points, repeats=.true.)
      surface = surface_of_points(spectrum%length, height, points=points, has_free_edges=has_free_edges, radii=radii)
   end subroutine self_affine_surface

   !> The least numbers of points along x and y on which all waves differ: more than two points in a period of each
   !> wave.
   pure function least_points_of(spectrum) result(points)
      type(self_affine_spectrum), intent(in) :: spectrum
      integer :: points(2)

      points = 2*highest_waves(spectrum) + 1
   end function least_points_of

   !> The largest wave numbers along x and y that may be within the cut-offs.
   pure function highest_waves(spectrum) result(highest)
      type(self_affine_spectrum), intent(in) :: spectrum
      integer :: highest(2)

      !> Upper bound of the wave numbers, so that they are default integers. Grids have far fewer points.
      real(dp), parameter :: most = 1e8_dp

      highest = int(min(most, sides_of_spectrum(spectrum%length, spectrum%anisotropy)/spectrum%shortest*(1 + rounding)))
      if (spectrum%dimension == 1) highest(2) = 0
   end function highest_waves

   !> Whether any wave of the cell is within the cut-offs.
   pure logical function has_waves(spectrum)
      type(self_affine_spectrum), intent(in) :: spectrum

      integer :: highest(2), m, n
      real(dp) :: sides(2)

      highest = highest_waves(spectrum)
      sides = sides_of_spectrum(spectrum%length, spectrum%anisotropy)
      has_waves = .true.
      do m = 0, highest(1)
         do n = 0, highest(2)
            if (mean_square(spectrum, frequency(sides, m, n)) > 0.0_dp) return
         end do
      end do
      has_waves = .false.
   end function has_waves

   !> The sides of the cell for which (G2) is the frequency in the spectrum, (G6) [length].
   pure function sides_of_spectrum(length, anisotropy) result(sides)
      real(dp), intent(in) :: length(2)    !! sides of the cell [length]
      real(dp), intent(in) :: anisotropy   !! gamma, > 0
      real(dp) :: sides(2)

      sides = length*sqrt([1/anisotropy, anisotropy])
   end function sides_of_spectrum

   !> The frequency of a wave, (G2) [1/length].
   pure real(dp) function frequency(sides, m, n)
      real(dp), intent(in) :: sides(2)   !! sides of the cell [length]
      integer, intent(in) :: m, n        !! wave numbers

      frequency = hypot(m/sides(1), n/sides(2))
   end function frequency

   !> The mean square of a wave, s of (G3), over that of a wave at the roll-off; 0 outside of the cut-offs.
   pure real(dp) function mean_square(spectrum, frequency)
      type(self_affine_spectrum), intent(in) :: spectrum
      real(dp), intent(in) :: frequency   !! in the spectrum, (G6) [1/length]

      mean_square = 0.0_dp
      if (frequency*spectrum%longest >= 1 - rounding .and. frequency*spectrum%shortest <= 1 + rounding) &
         mean_square = max(1.0_dp, frequency*spectrum%rolloff)**(-spectrum%dimension - 2*spectrum%hurst)
   end function mean_square

   !> Makes the heights (G1) at the own columns of a grid of the cell. Each process adds up the waves of its own wave
   !> numbers along x. The heights do not depend on how the grid is distributed.
   !>
   !> N.B. The random numbers are drawn in the order of (G5), also for waves outside of the cut-offs. So the phase of a
   !> wave depends on the seed and its wave numbers only, and the surface does not depend on the grid.
   subroutine make_heights(spectrum, height, points)
      type(self_affine_spectrum), intent(in) :: spectrum   !! has_waves is true
      !> Heights [length], shape (M, N), N = 1 in 1-D, or (M, columns of the grid's slab).
      real(dp), intent(inout), contiguous :: height(:, :)
      integer, intent(in) :: points(2)   !! M, N of a grid that may be distributed, at least least_points_of

      type(c_ptr) :: generator
      type(fourier_series) :: waves
      type(grid_transform) :: transform
      !> The sum (G4) that `rms` is the root of, with c = 1; for each wave number along x its part.
      real(dp) :: moment(1), rms, sides(2)
      real(dp), allocatable :: moments(:, :)
      integer :: first, highest(2), k, last, m, n

      call transform%start(points, even=.false.)
      generator = gsl_rng_alloc(gsl_rng_mt19937)
      call gsl_rng_set(generator, int(spectrum%seed, c_long))
      highest = highest_waves(spectrum)
      sides = sides_of_spectrum(spectrum%length, spectrum%anisotropy)
      call transform%new_series(waves)
      first = waves%first()
      last = waves%last(1)
      ! Each wave number m has its own sum. So rounding grows with the square root of the number of waves.
      allocate (moments(1, first:last), source=0.0_dp)
      do k = 1, maxval(highest)
         if (spectrum%dimension == 1) then
            call add_wave(k, 0)
         else
            do m = 0, k - 1
               call add_wave(m, k)
               if (m > 0) call add_wave(m, -k)
            end do
            do n = -k, k
               call add_wave(k, n)
            end do
         end if
      end do
      call gsl_rng_free(generator)
      moment = waves%rows%column_totals(moments)
      call transform%sample(waves, height)
      ! The density counts the two wave vectors of a wave, each with half of its mean square.
      rms = 1.0_dp
      if (spectrum%density > 0.0_dp) moment = product(spectrum%length(:spectrum%dimension))/(2*spectrum%density)
      if (spectrum%density <= 0.0_dp) rms = spectrum%rms
      height = rms/sqrt(moment(1))*height

   contains

      !> Draws the random numbers of a wave. If the wave is within the cut-offs and m is an own wave number of the
      !> process, adds the wave to the series and its mean square to the moments.
      subroutine add_wave(m, n)
         integer, intent(in) :: m, n   !! wave numbers, m >= 0

         !> Half of the step of the generator's numbers. Plus this no number is 0, and its logarithm exists.
         real(dp), parameter :: half_step = 2.0_dp**(-33)
         real(dp) :: phase, square, uniform, weight

         phase = 2*pi*gsl_rng_uniform(generator)
         uniform = gsl_rng_uniform(generator) + half_step
         if (any(abs([m, n]) > highest) .or. m < first .or. m > last) return
         square = mean_square(spectrum, frequency(sides, m, n))
         if (square <= 0.0_dp) return
         if (spectrum%random_amplitudes) square = -log(uniform)*square
         weight = 1.0_dp
         if (spectrum%by_slope) weight = (2*pi*frequency(spectrum%length, m, n))**2
         moments(1, m) = moments(1, m) + square*weight
         call waves%add_wave(m, n, sqrt(2*square)*turn(phase))
      end subroutine add_wave

   end subroutine make_heights

end module wavycon_self_affine
