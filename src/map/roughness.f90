!> Root mean squares of height, slope and curvature of a surface, from its Fourier series. The equations are those of
!> src/map/README.md.
module wavycon_roughness
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_own_waves, only: wave_slab
   implicit none (type, external)
   private

   public :: roughness_type, roughness_of, wave_powers, waves_of_number

   type :: roughness_type
      real(dp) :: height = 0.0_dp      !! of the height over its mean, eq. (M22) [length]
      real(dp) :: slope = 0.0_dp       !! of the size of the gradient, eq. (M23)
      real(dp) :: curvature = 0.0_dp   !! of half the Laplacian, of a profile of h'', eq. (M24) [1/length]
      !> Sum of the mean squares of all waves, each over its wavelength, eq. (M25a) [length].
      real(dp) :: frequency_moment = 0.0_dp
   end type roughness_type

contains

   !> The roughness of a surface.
   type(roughness_type) function roughness_of(series, amplitude, length, points) result(roughness)
      type(fourier_series), intent(in) :: series   !! of the height over `amplitude`; its mean is ignored
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! of the grid that the series interpolates; zeros if there is none

      real(dp) :: sums(4), unit
      type(grid_slab) :: rows

      ! Wave numbers over 2 pi/unit neither overflow nor make all squares underflow, whatever the unit of length.
      unit = minval(length)
      rows = wave_slab(series)
      sums = rows%column_totals(moments_of_rows(series, unit/length, points))
      sums(:3) = amplitude*[1.0_dp, 2*pi/unit, (2*pi/unit)**2]*sqrt(sums(:3))
      if (ubound(series%c, 2) > 0) sums(3) = 0.5_dp*sums(3)
      roughness = roughness_type(sums(1), sums(2), sums(3), amplitude**2*sums(4)/unit)
   end function roughness_of

   !> The sums of (M22) to (M25a) over the waves of each wave number in X, of height, slope, curvature and frequency, in
   !> the order of roughness_type; wave numbers are in units of 2 pi/unit.
   pure function moments_of_rows(series, over_length, points) result(moments)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: over_length(2)             !! unit/L_x, unit/L_y
      integer, intent(in) :: points(2)                   !! as of roughness_of
      real(dp), allocatable :: moments(:, :)             !! shape (4, that of the series' first index)

      real(dp), dimension(lbound(series%c, 1):ubound(series%c, 1)) :: powers, q_squared, x_squared
      integer :: k, l

      x_squared = [((k*over_length(1))**2, k=lbound(series%c, 1), ubound(series%c, 1))]
      allocate (moments(4, size(powers)), source=0.0_dp)
      do l = 0, ubound(series%c, 2)
         powers = wave_powers(series, points, l)
         q_squared = x_squared + (l*over_length(2))**2
         moments(1, :) = moments(1, :) + powers
         moments(2, :) = moments(2, :) + powers*q_squared
         moments(3, :) = moments(3, :) + powers*q_squared**2
         moments(4, :) = moments(4, :) + powers*sqrt(q_squared)
      end do
   end function moments_of_rows

   !> The mean square of all waves of wave numbers +-k and +-l in X and Y, for all k of the series, eq. (M21); 0 for the
   !> mean.
   pure function wave_powers(series, points, l) result(powers)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)             !! as of roughness_of
      integer, intent(in) :: l                     !! 0 to ubound(series%c, 2)
      real(dp) :: powers(lbound(series%c, 1):ubound(series%c, 1))

      integer :: k

      powers = series%c(:, l)**2
      if (.not. series%is_even()) powers = powers + series%cs(:, l)**2 + series%sc(:, l)**2 + series%ss(:, l)**2
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
