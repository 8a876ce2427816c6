!> The numbers of a solution's summary: mean gap, contact area and extreme pressures.
module wavycon_contact_measures
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: length_inside, line_zeros
   implicit none (type, external)
   private

   public :: contact_measures, full_contact_measures, largest_errors, measure_series, measuring_intervals, &
      unmeasured

   type :: contact_measures
      real(dp) :: mean_gap_over_amplitude = 1.0_dp       !! G: eqs. (19), (28)
      !> Of the mean planes of the elastic bodies, delta'/Delta: 1 - G, and with a hardness more by the mean depth of
      !> imprints.
      real(dp) :: approach_over_amplitude = 0.0_dp
      real(dp) :: contact_area_fraction = 0.0_dp         !! of the nominal area; 1 by definition from P = 1 on
      real(dp) :: peak_pressure_over_pstar = 0.0_dp      !! largest
      real(dp) :: min_pressure_over_pstar = 0.0_dp       !! smallest; negative between the points of a series
      real(dp) :: mean_gap_error = 0.0_dp                !! error estimate of the mean gap, in its unit
      real(dp) :: contact_area_error = 0.0_dp            !! likewise of the contact area
      real(dp) :: peak_pressure_error = 0.0_dp           !! likewise of the peak pressure
      !> Where the pressure is the hardness: fraction of the nominal area, and of the load. With a hardness
      !> contact_area_error holds for this area too.
      real(dp) :: area_at_hardness_fraction = 0.0_dp
      real(dp) :: load_at_hardness_fraction = 0.0_dp
   end type contact_measures

   !> Grid intervals on half a wavelength for areas and extremes: so many a harmonic, and at least so many.
   integer, parameter :: intervals_per_harmonic = 8, least_intervals = 64

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

   !> The largest errors that mean gap [Delta], contact area fraction and peak pressure [p*] can have, given where there
   !> is no estimate: the values lie between zero and one, the peak below that of just full contact.
   pure function largest_errors(largest) result(errors)
      real(dp), intent(in) :: largest   !! p - P in full contact [p*], of the waves of the paper 1
      real(dp) :: errors(3)

      errors = [1.0_dp, 1.0_dp, 1.0_dp + largest]
   end function largest_errors

   !> The measures where there is no solution: zeros with the largest errors.
   pure type(contact_measures) function unmeasured(largest) result(measures)
      real(dp), intent(in) :: largest   !! as of largest_errors

      real(dp) :: errors(3)

      errors = largest_errors(largest)
      measures = contact_measures(mean_gap_error=errors(1), contact_area_error=errors(2), &
                                  peak_pressure_error=errors(3))
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
      area = length_inside(edges, sum(line) >= 0.0_dp, 0.0_dp, pi)/pi
   end subroutine measure_isobar

end module wavycon_contact_measures
