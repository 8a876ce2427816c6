!> Root mean squares of height, slope and curvature of a surface, and its power spectra, computed from its Fourier
!> series. The equations are those of README.md in this directory.
module wavycon_roughness
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp, pi
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: roughness_type, roughness_of, spectrum_bin, line_spectrum, radial_spectrum

   type :: roughness_type
      real(dp) :: height = 0.0_dp      !! root mean square of the height less its mean, eq. (M22) [length]
      real(dp) :: slope = 0.0_dp       !! root mean square of |gradient|, eq. (M23) [-]
      real(dp) :: curvature = 0.0_dp   !! that of half the Laplacian, for a profile of h'', eq. (M24) [1/length]
      !> Sum over all waves of the mean square divided by the wavelength, eq. (M25a) [length]; on a layer each
      !> is also divided by the factor of the wave (E27).
      real(dp) :: frequency_moment = 0.0_dp
      real(dp) :: slopes(2) = 0.0_dp   !! root mean squares of the slopes along x and along y, the parts of (M23) [-]
   end type roughness_type

   !> A bin of a spectrum. The bins of a spectrum are in the order of rising wave numbers.
   type :: spectrum_bin
      real(dp) :: wave_number    !! mean wave number of the waves in the bin [rad/length]
      integer :: waves           !! number of these waves, >= 1
      !> Mean power spectral density of these waves: [length^4] for a radial spectrum, [length^3] for one along a line.
      real(dp) :: density
      !> Root mean squares, of all waves up to this bin, of height [length], slope [-] and curvature [1/length].
      real(dp) :: height, slope, curvature
   end type spectrum_bin

   !> The largest number of bins of a radial spectrum. The largest square map with its mirror images has 11584.
   integer, parameter :: most_bins = 12000

contains

   !> Computes the roughness of a surface from the Fourier series of its height.
   type(roughness_type) function roughness_of(series, amplitude, length, points, kernel) result(roughness)
      type(fourier_series), intent(in) :: series   !! series of the height over `amplitude`; its mean is not used
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! numbers of points of the grid that the series interpolates, or 0
      type(wave_stiffness), intent(in), optional :: kernel   !! of the bodies; absent: half-spaces

      type(wave_stiffness) :: of_waves
      !> For each wave number in X the sums over the waves: (M22), the parts of (M23) along x and along y, (M24) and
      !> (M25a).
      real(dp) :: moments(5, series%first():series%last(1))
      real(dp), dimension(series%first():series%last(1)) :: powers, q_squared, x_squared
      real(dp) :: sums(5), unit
      integer :: k, l

      ! Wave numbers are taken over 2 pi/unit. So their powers do not overflow and do not all underflow, whatever the
      ! unit of length is.
      unit = minval(length)
      if (present(kernel)) of_waves = kernel%in_unit(unit)
      x_squared = [((k*(unit/length(1)))**2, k=series%first(), series%last(1))]
      moments = 0.0_dp
      do l = 0, series%last(2)
         powers = wave_powers(series, points, l)
         q_squared = x_squared + (l*(unit/length(2)))**2
         moments(1, :) = moments(1, :) + powers
         moments(3, :) = moments(3, :) + powers*(l*(unit/length(2)))**2
         moments(4, :) = moments(4, :) + powers*q_squared**2
         call of_waves%of(q_squared)
         moments(5, :) = moments(5, :) + powers*q_squared
      end do
      moments(2, :) = x_squared*moments(1, :)
      sums = series%rows%column_totals(moments)
      roughness%height = amplitude*sqrt(sums(1))
      roughness%slopes = amplitude*(2*pi/unit)*sqrt(sums(2:3))
      roughness%slope = amplitude*(2*pi/unit)*sqrt(sum(sums(2:3)))
      roughness%curvature = amplitude*(2*pi/unit)**2*sqrt(sums(4))
      if (series%last(2) > 0) roughness%curvature = 0.5_dp*roughness%curvature
      roughness%frequency_moment = amplitude**2*sums(5)/unit
   end function roughness_of

   !> The isotropic spectrum of a surface, eqs (M26) and (M27). Bin b has the wave numbers from (b - 1/2) dq to
   !> (b + 1/2) dq. The width dq is 2 pi over the longer side or, if this is larger, the largest wave number over
   !> `most_bins`. Bin 1 also has the wave numbers below dq/2. Bins without waves are left out.
   pure function radial_spectrum(series, amplitude, length, points) result(spectrum)
      type(fourier_series), intent(in) :: series   !! series of the height over `amplitude`, in 2-D; mean not used
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! numbers of points of the grid that the series interpolates, or 0
      type(spectrum_bin), allocatable :: spectrum(:)

      real(dp), allocatable :: bins(:, :)
      real(dp) :: highest, powers(0:series%last(1)), unit, width
      integer :: bin, k, l

      unit = minval(length)
      highest = number(series%last(1), series%last(2))
      width = max(unit/maxval(length), highest/most_bins)
      allocate (bins(5, nint(highest/width)), source=0.0_dp)
      do l = 0, series%last(2)
         powers = wave_powers(series, points, l)
         do k = merge(1, 0, l == 0), series%last(1)
            bin = max(1, nint(number(k, l)/width))
            bins(:, bin) = bins(:, bin) + sums_of(number(k, l), waves_of_number(k, points(1))* &
                                                  waves_of_number(l, points(2)), powers(k))
         end do
      end do
      spectrum = spectrum_of(bins, amplitude, unit, length(1)*length(2))
      spectrum%curvature = 0.5_dp*spectrum%curvature

   contains

      !> The length of the wave vector over 2 pi/unit.
      pure real(dp) function number(k, l)
         integer, intent(in) :: k, l

         number = hypot(k*(unit/length(1)), l*(unit/length(2)))
      end function number

   end function radial_spectrum

   !> The spectrum of the profiles along x or along y, the mean over all of them, eq. (M28). There is a bin for each
   !> wave number. In 2-D the first one is that of the wave number 0, the means of the profiles. Slope and curvature are
   !> those along the profile.
   pure function line_spectrum(series, amplitude, length, points, direction) result(spectrum)
      type(fourier_series), intent(in) :: series   !! as of radial_spectrum, also in 1-D; so the next three arguments
      real(dp), intent(in) :: amplitude            !! [length]
      real(dp), intent(in) :: length(2)            !! [length]
      integer, intent(in) :: points(2)
      integer, intent(in) :: direction             !! 1: along x, 2: along y
      type(spectrum_bin), allocatable :: spectrum(:)

      real(dp) :: bins(5, 0:series%last(direction))
      !> `of_lines`: mean squares, summed over the wave numbers across the profiles.
      real(dp) :: of_lines(0:series%last(direction)), powers(0:series%last(1))
      integer :: first, k, l

      of_lines = 0.0_dp
      do l = 0, series%last(2)
         powers = wave_powers(series, points, l)
         if (direction == 1) of_lines = of_lines + powers
         if (direction == 2) of_lines(l) = sum(powers)
      end do
      do k = 0, ubound(bins, 2)
         bins(:, k) = sums_of(real(k, dp), waves_of_number(k, points(direction)), of_lines(k))
      end do
      first = 0
      if (series%last(2) == 0) first = 1
      spectrum = spectrum_of(bins(:, first:), amplitude, length(direction), length(direction))
   end function line_spectrum

   !> The contribution of waves of one wave number q to the five sums of a bin: number of waves, sum of wave numbers,
   !> mean square, mean square times q^2, and mean square times q^4.
   pure function sums_of(number, waves, power) result(sums)
      real(dp), intent(in) :: number     !! q over 2 pi/unit
      integer, intent(in) :: waves       !! how many waves there are
      real(dp), intent(in) :: power      !! mean square of all of them together
      real(dp) :: sums(5)

      sums = [real(waves, dp), waves*number, power*[1.0_dp, number**2, number**4]]
   end function sums_of

   !> Makes a spectrum from the sums of its bins. Bins without waves are left out.
   pure function spectrum_of(bins, amplitude, unit, size_of_cell) result(spectrum)
      real(dp), intent(in) :: bins(:, :)       !! the five sums, as of `sums_of`, of each bin
      real(dp), intent(in) :: amplitude        !! unit of the heights [length]
      real(dp), intent(in) :: unit             !! the wave numbers in the sums are over 2 pi/unit [length]
      real(dp), intent(in) :: size_of_cell     !! area of the cell [length^2], for profiles their length [length]
      type(spectrum_bin), allocatable :: spectrum(:)

      !> Of all waves up to a bin: root mean squares of height, slope and curvature, and the sums 3 to 5.
      real(dp) :: rms(3), up_to(3)
      integer :: b, n

      allocate (spectrum(count(bins(1, :) > 0.0_dp)))
      up_to = 0.0_dp
      n = 0
      do b = 1, size(bins, 2)
         if (.not. bins(1, b) > 0.0_dp) cycle
         n = n + 1
         up_to = up_to + bins(3:, b)
         rms = [1.0_dp, 2*pi/unit, (2*pi/unit)**2]*(amplitude*sqrt(up_to))
         spectrum(n) = spectrum_bin(2*pi/unit*(bins(2, b)/bins(1, b)), nint(bins(1, b)), &
                                    amplitude*size_of_cell*(amplitude*(bins(3, b)/bins(1, b))), rms(1), rms(2), rms(3))
      end do
   end function spectrum_of

   !> For each k of the series the mean square of all waves with the wave numbers +-k in X and +-l in Y, eq. (M21). The
   !> mean, k = l = 0, gets 0.
   pure function wave_powers(series, points, l) result(powers)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)             !! as of roughness_of
      integer, intent(in) :: l                     !! wave number in Y, 0 to series%last(2)
      real(dp) :: powers(series%first():series%last(1))

      integer :: k

      if (series%is_even()) then
         powers = series%c(:, l)**2
      else
         powers = series%wave(:, l)%re**2 + series%wave(:, l)%im**2
         if (l > 0) powers = 2*(powers + series%wave(:, -l)%re**2 + series%wave(:, -l)%im**2)
      end if
      powers = powers/(waves_of_number([(k, k=lbound(powers, 1), ubound(powers, 1))], points(1))* &
                       waves_of_number(l, points(2)))
      if (l == 0 .and. lbound(powers, 1) == 0) powers(0) = 0.0_dp
   end function wave_powers

   !> The number of different waves with the wave numbers k and -k. There is one for k = 0 and, if the number of points
   !> is even, for the highest wave number, as both waves then have the same values at the points. Otherwise there are
   !> two.
   elemental integer function waves_of_number(k, points) result(waves)
      integer, intent(in) :: k        !! >= 0
      integer, intent(in) :: points   !! number of points of the grid in this direction; 0 if there is no grid

      waves = merge(1, 2, k == 0 .or. 2*k == points)
   end function waves_of_number

end module wavycon_roughness
