!> Root mean squares of height, slope and curvature of a surface, and its power spectra, from its Fourier series. The
!> equations are those of src/core/map/README.md.
module wavycon_roughness
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: roughness_type, roughness_of, spectrum_bin, line_spectrum, radial_spectrum

   type :: roughness_type
      real(dp) :: height = 0.0_dp      !! of the height over its mean, eq. (M22) [length]
      real(dp) :: slope = 0.0_dp       !! of the size of the gradient, eq. (M23)
      real(dp) :: curvature = 0.0_dp   !! of half the Laplacian, of a profile of h'', eq. (M24) [1/length]
      !> Sum of the mean squares of all waves, each over its wavelength, eq. (M25a) [length]; on a layer each times its
      !> stiffness.
      real(dp) :: frequency_moment = 0.0_dp
   end type roughness_type

   !> A bin of a spectrum, which has them in the order of rising wave numbers.
   type :: spectrum_bin
      real(dp) :: wave_number    !! mean of its waves [rad/length]
      integer :: waves           !! how many there are, >= 1
      !> Mean of the power spectral densities of its waves: [length^4] of a radial spectrum, [length^3] along a line.
      real(dp) :: density
      !> Root mean squares of the waves up to this bin: height [length], slope, curvature [1/length].
      real(dp) :: height, slope, curvature
   end type spectrum_bin

   !> Most bins of a radial spectrum, more than those of the largest square map with its mirror images, 11584.
   integer, parameter :: most_bins = 12000

contains

   !> The roughness of a surface.
   type(roughness_type) function roughness_of(series, amplitude, length, points, kernel) result(roughness)
      type(fourier_series), intent(in) :: series   !! of the height over `amplitude`; its mean is ignored
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! of the grid that the series interpolates; zeros if there is none
      type(wave_stiffness), intent(in), optional :: kernel   !! of the bodies; absent: half-spaces

      type(wave_stiffness) :: of_waves
      !> (M22) to (M25a), in the order of roughness_type, of the waves of each wave number in X.
      real(dp) :: moments(4, series%first():series%last(1))
      real(dp), dimension(series%first():series%last(1)) :: powers, q_squared, x_squared
      real(dp) :: sums(4), unit
      integer :: k, l

      ! Wave numbers over 2 pi/unit neither overflow nor make all squares underflow, whatever the unit of length.
      unit = minval(length)
      if (present(kernel)) of_waves = kernel%in_unit(unit)
      x_squared = [((k*(unit/length(1)))**2, k=series%first(), series%last(1))]
      moments = 0.0_dp
      do l = 0, series%last(2)
         powers = wave_powers(series, points, l)
         q_squared = x_squared + (l*(unit/length(2)))**2
         moments(1, :) = moments(1, :) + powers
         moments(2, :) = moments(2, :) + powers*q_squared
         moments(3, :) = moments(3, :) + powers*q_squared**2
         call of_waves%of(q_squared)
         moments(4, :) = moments(4, :) + powers*q_squared
      end do
      sums = series%rows%column_totals(moments)
      sums(:3) = amplitude*[1.0_dp, 2*pi/unit, (2*pi/unit)**2]*sqrt(sums(:3))
      if (series%last(2) > 0) sums(3) = 0.5_dp*sums(3)
      roughness = roughness_type(sums(1), sums(2), sums(3), amplitude**2*sums(4)/unit)
   end function roughness_of

   !> The isotropic spectrum of a surface, eqs (M26) and (M27). Bin b has the wave numbers from (b - 1/2) dq to
   !> (b + 1/2) dq, where dq is 2 pi over the longer side, or the largest wave number over most_bins if that is more;
   !> bin 1 also has those below. Bins without waves are left out.
   pure function radial_spectrum(series, amplitude, length, points) result(spectrum)
      type(fourier_series), intent(in) :: series   !! of the height over `amplitude`, in 2-D; its mean is ignored
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! of the grid that the series interpolates; zeros if there is none
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

      pure real(dp) function number(k, l)
         integer, intent(in) :: k, l

         number = hypot(k*(unit/length(1)), l*(unit/length(2)))
      end function number

   end function radial_spectrum

   !> The spectrum of the lines along x or y, the mean of all lines, eq. (M28). There is a bin for each wave number; the
   !> first, of a surface in 2-D, is 0: the means of the lines. Slope and curvature are those along the line.
   pure function line_spectrum(series, amplitude, length, points, direction) result(spectrum)
      type(fourier_series), intent(in) :: series   !! as of radial_spectrum, also in 1-D
      real(dp), intent(in) :: amplitude            !! [length]
      real(dp), intent(in) :: length(2)            !! [length]
      integer, intent(in) :: points(2)
      integer, intent(in) :: direction             !! 1 or 2: along x or y
      type(spectrum_bin), allocatable :: spectrum(:)

      real(dp) :: bins(5, 0:series%last(direction))
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
      first = merge(1, 0, series%last(2) == 0)
      spectrum = spectrum_of(bins(:, first:), amplitude, length(direction), length(direction))
   end function line_spectrum

   !> What waves of one wave number add to the sums of a bin: their number, the wave numbers, the mean squares, and
   !> these times q^2 and q^4.
   pure function sums_of(number, waves, power) result(sums)
      real(dp), intent(in) :: number     !! wave number over 2 pi/unit
      integer, intent(in) :: waves       !! how many
      real(dp), intent(in) :: power      !! their mean square
      real(dp) :: sums(5)

      sums = [real(waves, dp), waves*number, power*[1.0_dp, number**2, number**4]]
   end function sums_of

   !> The spectrum of the bins that have waves.
   pure function spectrum_of(bins, amplitude, unit, size_of_cell) result(spectrum)
      real(dp), intent(in) :: bins(:, :)       !! sums of each
      real(dp), intent(in) :: amplitude        !! unit of the heights [length]
      real(dp), intent(in) :: unit             !! of the wave numbers, which are over 2 pi/unit [length]
      real(dp), intent(in) :: size_of_cell     !! area of the cell [length^2], of lines their length [length]
      type(spectrum_bin), allocatable :: spectrum(:)

      real(dp) :: rms(3), up_to(3)   ! of the waves up to a bin
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

   !> The mean square of all waves of wave numbers +-k and +-l in X and Y, for all k of the series, eq. (M21); 0 for the
   !> mean.
   pure function wave_powers(series, points, l) result(powers)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)             !! as of roughness_of
      integer, intent(in) :: l                     !! 0 to series%last(2)
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

   !> How many different waves have the wave numbers k and -k: one for the mean and, on an even number of points, for
   !> the highest wave, which equals its opposite at the points; otherwise two.
   elemental integer function waves_of_number(k, points) result(waves)
      integer, intent(in) :: k        !! >= 0
      integer, intent(in) :: points   !! of the grid in this direction; 0 if there is none

      waves = merge(1, 2, k == 0 .or. 2*k == points)
   end function waves_of_number

end module wavycon_roughness
