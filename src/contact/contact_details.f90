!> Numbers of a solution that the summary does not have, with error estimates. Not every solver computes them.
module wavycon_contact_details
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_details

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

end module wavycon_contact_details
