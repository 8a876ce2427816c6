!> Power spectra of a surface, from its Fourier series. The equations are those of src/map/README.md.
module wavycon_power_spectrum
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_roughness, only: wave_powers, waves_of_number
   implicit none (type, external)
   private

   public :: power_spectrum, line_spectrum, radial_spectrum

   !> A spectrum in bins of rising wave number; all arrays have one element a bin.
   type :: power_spectrum
      real(dp), allocatable :: wave_number(:)    !! mean of its waves [rad/length]
      integer, allocatable :: waves(:)           !! how many there are, >= 1
      !> Mean of the power spectral densities of its waves: [length^4] of a radial spectrum, [length^3] along a line.
      real(dp), allocatable :: density(:)
      !> Root mean squares of the waves up to this bin: height [length], slope, curvature [1/length].
      real(dp), allocatable :: height(:), slope(:), curvature(:)
   end type power_spectrum

   !> Most bins of a radial spectrum, more than those of the largest square map with its mirror images, 11584.
   integer, parameter :: most_bins = 12000

   !> Sums over the waves of a bin; wave numbers are over 2 pi/unit.
   type :: bin_sums
      integer :: waves = 0
      real(dp) :: wave_number = 0.0_dp, power(3) = 0.0_dp   !! the mean square, also times q^2 and q^4
   end type bin_sums

contains

   !> The isotropic spectrum of a surface, eqs (M26) and (M27). Bin b has the wave numbers from (b - 1/2) dq to
   !> (b + 1/2) dq, where dq is 2 pi over the longer side, or the largest wave number over most_bins if that is more;
   !> bin 1 also has those below. Bins without waves are left out.
   pure function radial_spectrum(series, amplitude, length, points) result(spectrum)
      type(fourier_series), intent(in) :: series   !! of the height over `amplitude`, in 2-D; its mean is ignored
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! of the grid that the series interpolates; zeros if there is none
      type(power_spectrum) :: spectrum

      type(bin_sums), allocatable :: bins(:)
      real(dp) :: highest, powers(0:ubound(series%c, 1)), unit, width
      integer :: bin, k, l

      unit = minval(length)
      highest = number(ubound(series%c, 1), ubound(series%c, 2))
      width = max(unit/maxval(length), highest/most_bins)
      allocate (bins(nint(highest/width)))
      do l = 0, ubound(series%c, 2)
         powers = wave_powers(series, points, l)
         do k = merge(1, 0, l == 0), ubound(series%c, 1)
            bin = max(1, nint(number(k, l)/width))
            call add(bins(bin), number(k, l), waves_of_number(k, points(1))*waves_of_number(l, points(2)), powers(k))
         end do
      end do
      spectrum = spectrum_of(pack(bins, bins%waves > 0), amplitude, unit, length(1)*length(2))
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
      type(power_spectrum) :: spectrum

      type(bin_sums) :: bins(0:ubound(series%c, direction))
      real(dp) :: of_lines(0:ubound(series%c, direction)), powers(0:ubound(series%c, 1))
      integer :: first, k, l

      of_lines = 0.0_dp
      do l = 0, ubound(series%c, 2)
         powers = wave_powers(series, points, l)
         if (direction == 1) of_lines = of_lines + powers
         if (direction == 2) of_lines(l) = sum(powers)
      end do
      do k = 0, ubound(bins, 1)
         call add(bins(k), real(k, dp), waves_of_number(k, points(direction)), of_lines(k))
      end do
      first = merge(1, 0, ubound(series%c, 2) == 0)
      spectrum = spectrum_of(bins(first:), amplitude, length(direction), length(direction))
   end function line_spectrum

   !> Adds waves of one wave number to a bin.
   pure subroutine add(bin, number, waves, power)
      type(bin_sums), intent(inout) :: bin
      real(dp), intent(in) :: number     !! wave number over 2 pi/unit
      integer, intent(in) :: waves       !! how many
      real(dp), intent(in) :: power      !! their mean square

      bin%waves = bin%waves + waves
      bin%wave_number = bin%wave_number + waves*number
      bin%power = bin%power + power*[1.0_dp, number**2, number**4]
   end subroutine add

   !> The spectrum of bins that all have waves.
   pure function spectrum_of(bins, amplitude, unit, size_of_cell) result(spectrum)
      type(bin_sums), intent(in) :: bins(:)
      real(dp), intent(in) :: amplitude        !! unit of the heights [length]
      real(dp), intent(in) :: unit             !! of the wave numbers, which are over 2 pi/unit [length]
      real(dp), intent(in) :: size_of_cell     !! area of the cell [length^2], of lines their length [length]
      type(power_spectrum) :: spectrum

      real(dp) :: up_to(3)
      integer :: b

      allocate (spectrum%waves(size(bins)), source=bins%waves)
      allocate (spectrum%wave_number(size(bins)), spectrum%density(size(bins)))
      spectrum%wave_number(:) = 2*pi/unit*(bins%wave_number/bins%waves)
      spectrum%density(:) = amplitude*size_of_cell*(amplitude*(bins%power(1)/bins%waves))
      allocate (spectrum%height(size(bins)), spectrum%slope(size(bins)), spectrum%curvature(size(bins)))
      up_to = 0.0_dp
      do b = 1, size(bins)
         up_to = up_to + bins(b)%power
         spectrum%height(b) = amplitude*sqrt(up_to(1))
         spectrum%slope(b) = 2*pi/unit*(amplitude*sqrt(up_to(2)))
         spectrum%curvature(b) = (2*pi/unit)**2*(amplitude*sqrt(up_to(3)))
      end do
   end function spectrum_of

end module wavycon_power_spectrum
