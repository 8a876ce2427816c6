!> The numbers of a solution: those of its summary, such as mean gap, contact area and extreme pressures; further ones
!> that only some solvers compute; and how a solution changes with the load.
module wavycon_contact_measures
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: part_inside, line_zeros
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_details, contact_measures, full_contact_measures, is_known, known_errors, linear_area_fraction, &
      load_derivatives, measure_series, measuring_intervals, or_nan, scaled_error, unmeasured

   !> Stands for a number that is not known, and exceeds every accuracy. Not NaN, whose comparisons Debug builds trap:
   !> `or_nan` makes it NaN for the user. Its powers in estimates of errors are finite.
   real(dp), parameter, public :: unknown = 1e30_dp

   type :: contact_measures
      real(dp) :: mean_gap_over_amplitude = 1.0_dp       !! G: eqs. (19), (28)
      !> Approach of the mean planes of the elastic bodies, delta'/Delta: 1 - G, plus the mean residual indentation
      !> (C22) if there is a hardness.
      real(dp) :: approach_over_amplitude = 0.0_dp
      real(dp) :: contact_area_fraction = 0.0_dp         !! of the nominal area; 1 by definition from P = 1 on
      real(dp) :: peak_pressure_over_pstar = 0.0_dp      !! largest; `unknown` where it is infinite
      real(dp) :: min_pressure_over_pstar = 0.0_dp       !! smallest; negative between the points of a series
      real(dp) :: mean_gap_error = 0.0_dp                !! error estimate of the mean gap, in its unit, or `unknown`
      real(dp) :: contact_area_error = 0.0_dp            !! error estimate of the contact area, or `unknown`
      real(dp) :: peak_pressure_error = 0.0_dp           !! error estimate of the peak pressure, or `unknown`
      !> Where the pressure is the hardness: fraction of the nominal area and of the load, and their error estimates or
      !> `unknown`.
      real(dp) :: area_at_hardness_fraction = 0.0_dp
      real(dp) :: load_at_hardness_fraction = 0.0_dp
      real(dp) :: area_at_hardness_error = 0.0_dp
      real(dp) :: load_at_hardness_error = 0.0_dp
      !> On a grid: the points in contact over all points, and this area corrected by (C26) of
      !> src/core/contact/README.md, which is for surfaces alone. Otherwise `unknown`.
      real(dp) :: contact_area_counted_fraction = unknown
      real(dp) :: contact_area_corrected_fraction = unknown
      !> Elastic energy per nominal area, the mean of p u/2 [p* Delta], and its error estimate, or `unknown`.
      real(dp) :: elastic_energy = unknown, elastic_energy_error = unknown
      !> load_concentration of wavycon_grid_area, of a light contact on a height map; otherwise 0.
      real(dp) :: load_concentration = 0.0_dp
      !> With free edges the part of the load that lies within `border` sides of the border; otherwise 0.
      real(dp) :: load_at_border = 0.0_dp
   contains
      procedure :: errors => errors_of_measures
      procedure :: are_resolved
   end type contact_measures

   !> Numbers that the summary does not have, with error estimates. Not every solver computes them.
   type :: contact_details
      real(dp) :: trough_gap = 0.0_dp, trough_gap_error = 0.0_dp              !! gap at a trough [Delta]
      !> Gap and pressure at the saddle between nearest crests, where spots merge first [Delta], [p*].
      real(dp) :: saddle_gap = 0.0_dp, saddle_gap_error = 0.0_dp
      real(dp) :: saddle_pressure = 0.0_dp, saddle_pressure_error = 0.0_dp
      !> Strain energy per nominal area, the mean of p u/2 [p* Delta].
      real(dp) :: energy = 0.0_dp, energy_error = 0.0_dp
      !> Length of the edge of one contact spot or, once the spots have merged, of one closed pool [length].
      real(dp) :: perimeter = 0.0_dp, perimeter_error = 0.0_dp
      integer :: degree = 0                                                   !! degree of the polynomials
   end type contact_details

   !> How a solution changes with the load: src/beyond/README.md derives what follows from its derivatives.
   !>
   !> At fixed contact a change of load is that of a rigid punch of the contact's shape, whose pressure is k/sqrt(rho)
   !> at a distance rho from the edge. What is `unknown`, huge, does not exist or is not computed.
   type :: load_derivatives
      real(dp) :: gap_slope = unknown, gap_slope_error = unknown            !! G'(P) <= 0 [Delta/p*]
      real(dp) :: area_slope = unknown, area_slope_error = unknown          !! A'(P) of the area fraction [1/p*]
      real(dp) :: gap_curvature = unknown, gap_curvature_error = unknown    !! G''(P) >= 0 [Delta/p*^2]
      !> Least and largest k^2 along the edge over its mean, which is weighted with the edge's velocity.
      real(dp) :: intensity_range(2) = unknown
   end type load_derivatives

   !> Grid intervals on half a wavelength for areas and extremes: so many a harmonic, and at least so many.
   integer, parameter :: intervals_per_harmonic = 8, least_intervals = 64

   !> kappa. Theories give (8/pi)^(1/2) = 1.60, B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840-3861, and (2 pi)^(1/2)
   !> = 2.51, A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87-111. Computed contacts of self-affine surfaces
   !> lie between them, S. Hyun, L. Pei, J.-F. Molinari, M. O. Robbins, Phys. Rev. E 70 (2004) 026117; 2 is the value
   !> that results are compared with.
   real(dp), parameter :: area_coefficient = 2.0_dp

contains

   !> Intervals on half a wavelength on which a series of n harmonics is measured.
   elemental integer function measuring_intervals(harmonics)
      integer, intent(in) :: harmonics   !! n >= 1

      measuring_intervals = max(least_intervals, intervals_per_harmonic*harmonics)
   end function measuring_intervals

   !> The measures of full contact, P >= 1, eq. (22): p - P is at least -1.
   elemental type(contact_measures) function full_contact_measures(pbar_over_pstar, largest) result(measures)
      real(dp), intent(in) :: pbar_over_pstar   !! P
      real(dp), intent(in) :: largest           !! p - P [p*], of the waves of the paper 1

      measures = contact_measures(mean_gap_over_amplitude=0.0_dp, approach_over_amplitude=1.0_dp, &
                                  contact_area_fraction=1.0_dp, &
                                  peak_pressure_over_pstar=pbar_over_pstar + largest, &
                                  min_pressure_over_pstar=pbar_over_pstar - 1.0_dp)
   end function full_contact_measures

   !> Whether a number is not `unknown`.
   elemental logical function is_known(number)
      real(dp), intent(in) :: number

      is_known = number < unknown
   end function is_known

   !> An error times a factor, which is unknown if the error is: a product with a small factor would pass for known.
   elemental real(dp) function scaled_error(error, factor)
      real(dp), intent(in) :: error, factor   !! >= 0

      scaled_error = unknown
      if (is_known(error)) scaled_error = factor*error
   end function scaled_error

   !> A number for the user: NaN if it is unknown.
   elemental real(dp) function or_nan(number)
      real(dp), intent(in) :: number

      or_nan = number
      if (.not. is_known(number)) or_nan = ieee_value(1.0_dp, ieee_quiet_nan)
   end function or_nan

   !> Error estimates of mean gap [Delta], contact area fraction and peak pressure [p*], unknown where an estimate is
   !> no smaller than the largest error that the value can have, and so says nothing: gap and area lie between zero and
   !> one, the peak is below that of just full contact.
   pure function known_errors(estimates, largest) result(errors)
      real(dp), intent(in) :: estimates(3)
      real(dp), intent(in) :: largest   !! p - P in full contact [p*], of the waves of the paper 1
      real(dp) :: errors(3)

      errors = merge(estimates, unknown, estimates < [1.0_dp, 1.0_dp, 1.0_dp + largest])
   end function known_errors

   !> The error estimates of mean gap [Delta], contact area fraction and peak pressure [p*].
   pure function errors_of_measures(self) result(errors)
      class(contact_measures), intent(in) :: self
      real(dp) :: errors(3)

      errors = [self%mean_gap_error, self%contact_area_error, self%peak_pressure_error]
   end function errors_of_measures

   !> Whether mean gap, contact area and peak pressure are exact, larger than their error estimates, or do not exist.
   pure function are_resolved(self, surface)
      class(contact_measures), intent(in) :: self
      type(surface_type), intent(in) :: surface   !! that was solved: with free edges the first error is the approach's
      logical :: are_resolved(3)

      real(dp) :: errors(3), values(3)

      errors = self%errors()
      values = [self%mean_gap_over_amplitude, self%contact_area_fraction, self%peak_pressure_over_pstar]
      if (surface%has_free_edges .and. surface%dimension == 2) values(1) = self%approach_over_amplitude
      are_resolved = errors < values .or. errors <= 0.0_dp .or. .not. is_known(values)
   end function are_resolved

   !> The fraction of the nominal area in contact by the linear law of light loads on rough surfaces, A/A0 = kappa
   !> pbar/(E* h'), for comparison with those that are computed. It is a straight line at all loads, and exceeds 1 at
   !> heavy ones. Unknown for surfaces that are no height maps: the law is one of random surfaces.
   pure real(dp) function linear_area_fraction(surface, rms_slope, pbar_over_pstar) result(fraction)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: rms_slope         !! h' of the surface; an argument because it takes a sum over all waves
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 0

      fraction = unknown
      if (surface%dimension == 1 .or. .not. surface%is_height_map() .or. .not. surface%amplitude > 0.0_dp) return
      if (surface%has_free_edges) return
      fraction = area_coefficient*pbar_over_pstar*surface%full_contact_pressure(e_star=1.0_dp)/rms_slope
   end function linear_area_fraction

   !> The measures where there is no solution: zeros with unknown errors.
   pure type(contact_measures) function unmeasured() result(measures)
      measures = contact_measures(mean_gap_error=unknown, contact_area_error=unknown, peak_pressure_error=unknown, &
                                  area_at_hardness_error=unknown, load_at_hardness_error=unknown)
   end function unmeasured

   !> Measures the series of a pressure and its displacement, eqs. (19), (28) of Johnson, Greenwood & Higginson (1985).
   !> The edge of contact is the isobar p = edge_level p*. Mean gap and approach are those of a crest in elastic
   !> contact.
   subroutine measure_series(pressure, displacement, edge_level, measures, hardness)
      type(fourier_series), intent(in) :: pressure       !! p/p*
      type(fourier_series), intent(in) :: displacement   !! (u - ubar)/Delta
      real(dp), intent(in) :: edge_level                !! over p*
      type(contact_measures), intent(out) :: measures
      !> H/p*, huge or absent: there is none. The edge of the area where p = H is the isobar as far below H as that of
      !> contact is above zero, but at least H/2.
      real(dp), intent(in), optional :: hardness

      real(dp) :: extremes(2)

      ! The crest, phi = theta = 0, is in contact and h = 0 there: the approach is the displacement.
      measures%approach_over_amplitude = sum(displacement%c)
      measures%mean_gap_over_amplitude = 1.0_dp - measures%approach_over_amplitude
      call measure_isobar(pressure, edge_level, measures%contact_area_fraction, extremes)
      measures%min_pressure_over_pstar = extremes(1)
      measures%peak_pressure_over_pstar = extremes(2)
      if (.not. present(hardness)) return
      if (.not. hardness < huge(hardness)) return
      call measure_isobar(pressure, max(hardness - edge_level, 0.5_dp*hardness), measures%area_at_hardness_fraction, &
                          extremes)
      measures%load_at_hardness_fraction = hardness*measures%area_at_hardness_fraction/pressure%c(0, 0)
   end subroutine measure_series

   !> The area within an isobar, and the extreme pressures.
   subroutine measure_isobar(pressure, level, area, extremes)
      type(fourier_series), intent(in) :: pressure
      real(dp), intent(in) :: level           !! over p*
      real(dp), intent(out) :: area           !! fraction of the nominal area
      real(dp), intent(out) :: extremes(2)    !! least and largest pressure over p*

      real(dp), allocatable :: edges(:), values(:, :)
      real(dp) :: line(0:ubound(pressure%c, 1))
      type(isobar_grid) :: grid
      integer :: intervals

      intervals = measuring_intervals(ubound(pressure%c, 1))
      if (size(pressure%c, 2) > 1) then
         call start_isobar_grid(grid, pressure, level, intervals)
         area = grid%area_fraction()
         extremes = [minval(grid%pressure), maxval(grid%pressure)] + level
         return
      end if
      call pressure%evaluate_on_grid(intervals, values)
      extremes = [minval(values), maxval(values)]
      line = pressure%c(:, 0)
      line(0) = line(0) - level
      call line_zeros(line, intervals, edges)
      area = part_inside(edges, sum(line) >= 0.0_dp, pi)
   end subroutine measure_isobar

end module wavycon_contact_measures
