!> Quantities of a solution whose pressure is a Fourier series, of full contact, and the contact area by the linear law
!> of rough surfaces.
module wavycon_contact_measures
   use wavycon_fourier_series, only: fourier_series
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_full_contact, only: full_contact_energy
   use wavycon_kinds, only: dp, pi
   use wavycon_line_zeros, only: part_inside, line_zeros
   use wavycon_quantities, only: approach, area_at_hardness, contact_area, elastic_energy, load_at_hardness, mean_gap, &
      min_pressure, peak_pressure, quantities, unknown
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: full_contact_quantities, linear_area_fraction, measure_series, measuring_intervals

   !> Grid intervals on half a wavelength for areas and extremes: the number for each harmonic, and the least number.
   integer, parameter :: intervals_per_harmonic = 8, least_intervals = 64

   !> The coefficient kappa of the linear law. Theories give (8/pi)^(1/2) = 1.60 (B. N. J. Persson, J. Chem. Phys. 115
   !> (2001) 3840-3861) and (2 pi)^(1/2) = 2.51 (A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87-111).
   !> Computed contacts of self-affine surfaces lie between the two (S. Hyun, L. Pei, J.-F. Molinari, M. O. Robbins,
   !> Phys. Rev. E 70 (2004) 026117). Results are compared with the value 2.
   real(dp), parameter :: area_coefficient = 2.0_dp

contains

   !> The number of grid intervals on half a wavelength on which a series of n harmonics is measured.
   elemental integer function measuring_intervals(harmonics)
      integer, intent(in) :: harmonics   !! n >= 1

      measuring_intervals = max(least_intervals, intervals_per_harmonic*harmonics)
   end function measuring_intervals

   !> The quantities of full contact, P >= 1, by eq. (22). The least value of p - P is -1 (in p*) by the definition of
   !> p*.
   type(quantities) function full_contact_quantities(surface, pbar_over_pstar) result(answer)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P

      answer%value(mean_gap) = 0.0_dp
      answer%value(approach) = 1.0_dp
      answer%value(contact_area) = 1.0_dp
      answer%value(peak_pressure) = pbar_over_pstar + surface%full_contact_peak
      answer%value(min_pressure) = pbar_over_pstar - 1.0_dp
      answer%value(elastic_energy) = full_contact_energy(surface)
      answer%error(elastic_energy) = 0.0_dp
   end function full_contact_quantities

   !> The fraction of the nominal area in contact by the linear law of rough surfaces at light loads, A/A0 = kappa
   !> pbar/(E* h'). It serves for comparison with computed areas. The law is evaluated at all loads, so the result
   !> exceeds 1 at heavy ones. As the law is that of random surfaces on half-spaces, the result is `unknown` if the
   !> surface is not a height map in 2-D, is flat, has free edges, or lies on a layer.
   pure real(dp) function linear_area_fraction(surface, rms_slope, pbar_over_pstar) result(fraction)
      type(surface_type), intent(in) :: surface
      !> Root mean square slope h' of the surface. It is an argument because its computation takes a sum over all waves.
      real(dp), intent(in) :: rms_slope
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 0

      fraction = unknown
      if (surface%dimension == 1 .or. .not. surface%is_height_map() .or. .not. surface%amplitude > 0.0_dp) return
      if (surface%has_free_edges .or. surface%kernel%has_layer()) return
      fraction = area_coefficient*pbar_over_pstar*surface%full_contact_pressure(e_star=1.0_dp)/rms_slope
   end function linear_area_fraction

   !> Computes the quantities of a contact from the Fourier series of its pressure and displacement, eqs. (19), (28) of
   !> Johnson, Greenwood & Higginson (1985). The edge of contact is the isobar p = edge_level p*. Mean gap and approach
   !> hold for elastic contact at the crest phi = theta = 0.
   subroutine measure_series(pressure, displacement, edge_level, answer, hardness)
      type(fourier_series), intent(in) :: pressure       !! p/p*
      type(fourier_series), intent(in) :: displacement   !! (u - ubar)/Delta
      real(dp), intent(in) :: edge_level                 !! pressure at the edge of contact [p*]
      type(quantities), intent(out) :: answer
      !> Hardness H/p*; huge or absent if there is none. The edge of the area where p = H is the isobar
      !> p = H - edge_level p* or, if that is higher, p = H/2.
      real(dp), intent(in), optional :: hardness

      real(dp) :: extremes(2)

      ! At the crest phi = theta = 0 there is contact and h = 0. So the approach is the displacement there.
      answer%value(approach) = sum(displacement%c)
      answer%value(mean_gap) = 1.0_dp - answer%value(approach)
      call measure_isobar(pressure, edge_level, answer%value(contact_area), extremes)
      answer%value([min_pressure, peak_pressure]) = extremes
      if (.not. present(hardness)) return
      if (.not. hardness < huge(hardness)) return
      call measure_isobar(pressure, max(hardness - edge_level, 0.5_dp*hardness), &
                          answer%value(area_at_hardness), extremes)
      answer%value(load_at_hardness) = hardness*answer%value(area_at_hardness)/pressure%c(0, 0)
   end subroutine measure_series

   !> The area where the pressure is at least a level, and the extreme pressures.
   subroutine measure_isobar(pressure, level, area, extremes)
      type(fourier_series), intent(in) :: pressure
      real(dp), intent(in) :: level           !! [p*]
      real(dp), intent(out) :: area           !! fraction of the nominal area
      real(dp), intent(out) :: extremes(2)    !! least and largest pressure at the points of the grid [p*]

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
