!> The measures of a solution: mean gap, area, peak pressure, load, energy and length of the edge.
module wavycon_fitted_measures
   use wavycon_contact_equations, only: contact_equations
   use wavycon_disc_sources, only: copies
   use wavycon_fitted_function, only: fitted_function
   use wavycon_kinds, only: dp, pi
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: measure_fitted_function

   !> The order of the measures in an array, and their number.
   integer, parameter, public :: gap_measure = 1        !! mean gap G [Delta]
   integer, parameter, public :: area_measure = 2       !! area of one spot or pool [s^2]
   integer, parameter, public :: peak_measure = 3       !! pressure at a crest [pi E* Delta/s]
   integer, parameter, public :: load_measure = 4       !! P, given or found [pi E* Delta/s]
   integer, parameter, public :: centre_measure = 5     !! a spot's peak pressure; a pool's gap at its trough [Delta]
   integer, parameter, public :: energy_measure = 6     !! half the integral of p u over a cell [Delta s^2]
   integer, parameter, public :: perimeter_measure = 7  !! length of the edge of one spot or pool [s]
   integer, parameter, public :: all_measures = 7

contains

   !> Computes all measures of a solution.
   subroutine measure_fitted_function(equations, lattice, now, measures, reference, scale)
      type(contact_equations), intent(in) :: equations     !! started for fitted functions like `now`
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(inout) :: now          !! the solution; the load of an adhesive spot is set
      real(dp), intent(out) :: measures(all_measures)
      real(dp), intent(out) :: reference(all_measures)
         !! what errors are relative to: the measure; for loads and pressures with adhesion plus the tension at the edge
      real(dp), intent(out) :: scale(all_measures)         !! what the accuracy is relative to

      real(dp) :: at_edge

      if (now%work > 0.0_dp .and. .not. now%pool) now%load = equations%integral(now)/lattice%area
      ! The mean gap G: for a spot 1 - delta, README.md (F5); for a pool the mean of its gap.
      measures(gap_measure) = 1.0_dp - now%approach
      if (now%pool) measures(gap_measure) = lattice%troughs*equations%integral(now)/lattice%area
      measures(area_measure) = now%shape%area()
      measures(centre_measure) = now%at((0.0_dp, 0.0_dp))
      measures(peak_measure) = measures(centre_measure)
      if (now%pool) measures(peak_measure) = pressure_between_pools()
      measures(energy_measure) = strain_energy()
      measures(perimeter_measure) = now%shape%perimeter()
      measures(load_measure) = now%load
      reference = measures
      if (now%work > 0.0_dp) then
         ! The tensions of (F71) and (F72).
         at_edge = sqrt(now%work/(2*sqrt(now%area/pi)))
         associate (of_load => merge(at_edge, 4*at_edge*now%area/(pi*lattice%area), now%pool))
            reference([peak_measure, load_measure, centre_measure]) = abs(measures([peak_measure, load_measure, &
               centre_measure])) + [at_edge, of_load, at_edge]
         end associate
      end if
      scale = reference
      ! Fields need the gap at a trough within the accuracy times Delta. Near full contact it is a small part of Delta.
      scale(centre_measure) = max(reference(centre_measure), 1.0_dp)
      ! The area is given and has no error. Under tension gap and load may be larger than Delta and the closing
      ! pressure: their accuracy is relative to these.
      if (now%work > 0.0_dp) scale([gap_measure, area_measure, peak_measure, load_measure]) = [1.0_dp, huge(1.0_dp), &
         max(reference(peak_measure), lattice%closing_pressure), lattice%closing_pressure]

   contains

      !> The pressure at a crest, which is the largest one: the pressure of full contact less 1/(4 pi^2) times the
      !> integral of the gap times the Laplacian of Gp, README.md (F45). The pools of a cell are mirror images about the
      !> crest, so that each contributes the same.
      real(dp) function pressure_between_pools()
         complex(dp) :: from_crest(2*now%basis%fold*size(equations%rule%point))
         real(dp) :: mean(size(equations%rule%point)), value(size(from_crest))

         from_crest = lattice%trough + copies(now%basis%fold, now%shape%position_of(equations%rule%point))
         call lattice%kernel(3)%evaluate(size(value), from_crest%re, from_crest%im, value)
         ! The points of the rule lie in one sector. So the mean of the kernel over their copies is taken.
         mean = sum(reshape(value, [size(mean), 2*now%basis%fold]), 2)/(2*now%basis%fold)
         pressure_between_pools = now%load - lattice%closing_pressure + lattice%rise(.true., -lattice%trough) &
            - lattice%troughs*equations%integral(now, mean)/(4*pi**2)
      end function pressure_between_pools

      !> Half the integral of p u over a cell [Delta s^2]: README.md (F46) for a spot, (F47) for a pool.
      !>
      !> In contact u = delta - h. For pools p u = p (delta - h + g) everywhere, and p g = 0. The integral of p h
      !> follows from the Fourier coefficients of p at the waves of h, which are |k| times those of u.
      real(dp) function strain_energy() result(energy)
         complex(dp) :: z(size(equations%rule%point))

         z = now%shape%position_of(equations%rule%point)
         if (now%pool) then
            associate (rise => lattice%rise(.true., z) - lattice%closing_pressure, &
                       full => 0.5_dp*lattice%area*sum(lattice%amplitude*lattice%pressure))
               energy = 0.5_dp*(full + lattice%troughs*equations%integral(now, rise) &
                                - now%load*measures(gap_measure)*lattice%area)
            end associate
         else
            energy = 0.5_dp*(now%approach*now%load*lattice%area + equations%integral(now, lattice%rise(.false., z)))
         end if
      end function strain_energy

   end subroutine measure_fitted_function

end module wavycon_fitted_measures
