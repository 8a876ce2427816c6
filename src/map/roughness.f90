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

   public :: roughness_type, differences_within, roughness_of, wave_powers, waves_of_number

   type :: roughness_type
      real(dp) :: height = 0.0_dp      !! of the height over its mean, eq. (M22) [length]
      real(dp) :: slope = 0.0_dp       !! of the size of the gradient, eq. (M23)
      real(dp) :: curvature = 0.0_dp   !! of half the Laplacian, of a profile of h'', eq. (M24) [1/length]
      !> Slope and curvature by differences between neighbouring points, eq. (M25); as above if there are no points.
      real(dp) :: slope_by_differences = 0.0_dp, curvature_by_differences = 0.0_dp
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

      real(dp) :: sums(6), unit
      type(grid_slab) :: rows

      ! Wave numbers over 2 pi/unit neither overflow nor make all squares underflow, whatever the unit of length.
      unit = minval(length)
      rows = wave_slab(series)
      sums = rows%column_totals(moments_of_rows(series, unit/length, points))
      sums(:5) = amplitude*sqrt(sums(:5))
      sums(6) = amplitude**2*sums(6)/unit
      sums([2, 4]) = 2*pi/unit*sums([2, 4])
      sums([3, 5]) = (2*pi/unit)**2*sums([3, 5])
      if (ubound(series%c, 2) > 0) sums([3, 5]) = 0.5_dp*sums([3, 5])
      roughness = roughness_type(sums(1), sums(2), sums(3), sums(4), sums(5), sums(6))
   end function roughness_of

   !> The sums of (M22) to (M25a) over the waves of each wave number in X, of height, slope, curvature, slope and
   !> curvature by differences, and frequency, in the order of roughness_type; wave numbers are in units of 2 pi/unit.
   pure function moments_of_rows(series, over_length, points) result(moments)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: over_length(2)             !! unit/L_x, unit/L_y
      integer, intent(in) :: points(2)                   !! as of roughness_of
      real(dp), allocatable :: moments(:, :)             !! shape (6, that of the series' first index)

      !> Squared wave numbers, of the surface and of its differences.
      real(dp), dimension(lbound(series%c, 1):ubound(series%c, 1)) :: powers, q_squared, s_squared, x_squared, x_steps
      integer :: k, l

      x_squared = [((k*over_length(1))**2, k=lbound(series%c, 1), ubound(series%c, 1))]
      x_steps = [(step_squared(k, points(1), over_length(1)), k=lbound(series%c, 1), ubound(series%c, 1))]
      allocate (moments(6, size(powers)), source=0.0_dp)
      do l = 0, ubound(series%c, 2)
         powers = wave_powers(series, points, l)
         q_squared = x_squared + (l*over_length(2))**2
         s_squared = x_steps + step_squared(l, points(2), over_length(2))
         moments(1, :) = moments(1, :) + powers
         moments(2, :) = moments(2, :) + powers*q_squared
         moments(3, :) = moments(3, :) + powers*q_squared**2
         moments(4, :) = moments(4, :) + powers*s_squared
         moments(5, :) = moments(5, :) + powers*s_squared**2
         moments(6, :) = moments(6, :) + powers*sqrt(q_squared)
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

   !> Root mean squares of slope and curvature by differences as in `roughness_type`, without those across the borders of
   !> a map that does not repeat.
   function differences_within(height, points, length) result(differences)
      real(dp), intent(in) :: height(:, :)       !! shape (M, N) or (M, columns of the grid's slab) [length]
      integer, intent(in) :: points(2)           !! M, N
      real(dp), intent(in) :: length(2)          !! sides of the map, > 0 [length]
      real(dp) :: differences(2)

      real(dp), dimension(size(height, 1), 1) :: behind, next
      real(dp) :: over_step(2), parts(3, size(height, 2)), totals(3), unit(1)
      real(dp), dimension(size(height, 1)) :: bend, here, to_last, to_next
      integer :: j
      type(grid_slab) :: slab

      call slab%start(points)
      unit = maxval(abs(height))
      call slab%largest(unit)
      differences = 0.0_dp
      if (.not. unit(1) > 0.0_dp) return
      ! Powers of heights over the largest one and of steps over the least do not overflow.
      over_step = minval(length/points)*points/length
      call slab%halo(height, .false., behind, next)
      parts = 0.0_dp
      associate (m => points(1), n => points(2), columns => size(height, 2))
         do j = 1, columns
            here = height(:, j)/unit(1)
            if (j > 1) behind(:, 1) = height(:, j - 1)
            to_last = over_step(2)*(here - behind(:, 1)/unit(1))
            if (j < columns) then
               to_next = over_step(2)*(height(:, j + 1)/unit(1) - here)
            else
               to_next = over_step(2)*(next(:, 1)/unit(1) - here)
            end if
            parts(1, j) = sum((over_step(1)*(here(2:) - here(:m - 1)))**2)/(max(m - 1, 1)*n)
            if (slab%first - 1 + j < n) parts(2, j) = sum(to_next**2)/(m*(n - 1))
            if (n > 1 .and. any(slab%first - 1 + j == [1, n])) cycle
            bend(2:m - 1) = over_step(1)**2*(here(3:) - 2*here(2:m - 1) + here(:m - 2))
            if (n > 1) bend(2:m - 1) = 0.5_dp*(bend(2:m - 1) + over_step(2)*(to_next(2:m - 1) - to_last(2:m - 1)))
            parts(3, j) = sum(bend(2:m - 1)**2)/(max(m - 2, 1)*max(n - 2, 1))
         end do
      end associate
      totals = slab%column_totals(parts)
      associate (step => minval(length/points))
         differences = unit(1)/step*[sqrt(totals(1) + totals(2)), sqrt(totals(3))/step]
      end associate
   end function differences_within

   !> The square of the wave number that differences between neighbours see, eq. (M25), over 2 pi/unit.
   elemental real(dp) function step_squared(k, points, over_length)
      integer, intent(in) :: k                 !! >= 0
      integer, intent(in) :: points            !! of the grid in this direction; 0 if there is none
      real(dp), intent(in) :: over_length      !! unit/L

      if (points > 0) then
         step_squared = (points/pi*sin(pi*k/points)*over_length)**2
      else
         step_squared = (k*over_length)**2
      end if
   end function step_squared

end module wavycon_roughness
