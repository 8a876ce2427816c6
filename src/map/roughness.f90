!> Root mean squares of height, slope and curvature of a surface, from its Fourier series. The equations are those of
!> src/map/README.md.
module wavycon_roughness
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: roughness_type, roughness_of, wave_powers, waves_of_number

   type :: roughness_type
      real(dp) :: height = 0.0_dp      !! of the height over its mean, eq. (M22) [length]
      real(dp) :: slope = 0.0_dp       !! of the size of the gradient, eq. (M23)
      real(dp) :: curvature = 0.0_dp   !! of half the Laplacian, of a profile of h'', eq. (M24) [1/length]
      !> Slope and curvature by differences between neighbouring points, eq. (M25); as above if there are no points.
      real(dp) :: slope_by_differences = 0.0_dp, curvature_by_differences = 0.0_dp
   end type roughness_type

contains

   !> The roughness of a surface.
   pure type(roughness_type) function roughness_of(series, amplitude, length, points) result(roughness)
      type(fourier_series), intent(in) :: series   !! of the height over `amplitude`; its mean is ignored
      real(dp), intent(in) :: amplitude            !! unit of the series, >= 0 [length]
      real(dp), intent(in) :: length(2)            !! L_x, L_y, sides of the periodic cell, > 0 [length]
      integer, intent(in) :: points(2)             !! of the grid that the series interpolates; zeros if there is none

      !> Squared wave numbers, of the surface and of its differences, in units of 2 pi/unit.
      real(dp), dimension(0:ubound(series%c, 1)) :: q_squared, s_squared, x_squared, x_steps
      real(dp) :: powers(0:ubound(series%c, 1)), sums(5), unit
      integer :: k, l

      ! Wave numbers over 2 pi/unit neither overflow nor make all squares underflow, whatever the unit of length.
      unit = minval(length)
      x_squared = [((k*(unit/length(1)))**2, k=0, ubound(series%c, 1))]
      x_steps = [(step_squared(k, points(1), unit/length(1)), k=0, ubound(series%c, 1))]
      sums = 0.0_dp
      do l = 0, ubound(series%c, 2)
         powers = wave_powers(series, points, l)
         q_squared = x_squared + (l*(unit/length(2)))**2
         s_squared = x_steps + step_squared(l, points(2), unit/length(2))
         sums = sums + [sum(powers), sum(powers*q_squared), sum(powers*q_squared**2), sum(powers*s_squared), &
                        sum(powers*s_squared**2)]
      end do
      sums = amplitude*sqrt(sums)
      sums([2, 4]) = 2*pi/unit*sums([2, 4])
      sums([3, 5]) = (2*pi/unit)**2*sums([3, 5])
      if (ubound(series%c, 2) > 0) sums([3, 5]) = 0.5_dp*sums([3, 5])
      roughness = roughness_type(sums(1), sums(2), sums(3), sums(4), sums(5))
   end function roughness_of

   !> The mean square of all waves of wave numbers +-k and +-l in X and Y, for k = 0, 1, ..., eq. (M21); 0 for the mean.
   pure function wave_powers(series, points, l) result(powers)
      type(fourier_series), intent(in) :: series
      integer, intent(in) :: points(2)             !! as of roughness_of
      integer, intent(in) :: l                     !! 0 to ubound(series%c, 2)
      real(dp) :: powers(0:ubound(series%c, 1))

      integer :: k

      powers = series%c(:, l)**2
      if (.not. series%is_even()) powers = powers + series%cs(:, l)**2 + series%sc(:, l)**2 + series%ss(:, l)**2
      powers = powers/(waves_of_number([(k, k=0, ubound(powers, 1))], points(1))*waves_of_number(l, points(2)))
      if (l == 0) powers(0) = 0.0_dp
   end function wave_powers

   !> How many of the wave numbers k and -k are different waves: the mean has none beside it, and at the points of a
   !> grid the highest wave of an even number of points is the same as the one that runs back.
   elemental integer function waves_of_number(k, points) result(waves)
      integer, intent(in) :: k        !! >= 0
      integer, intent(in) :: points   !! of the grid in this direction; 0 if there is none

      waves = merge(1, 2, k == 0 .or. 2*k == points)
   end function waves_of_number

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
