!> Numbers of a solution beyond the summary's, with error estimates. Not every solver has them.
module wavycon_contact_details
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: contact_details

   type :: contact_details
      real(dp) :: trough_gap = 0.0_dp, trough_gap_error = 0.0_dp              !! at a trough [Delta]
      real(dp) :: saddle_gap = 0.0_dp, saddle_gap_error = 0.0_dp              !! at the lowest saddle [Delta]
      real(dp) :: saddle_pressure = 0.0_dp, saddle_pressure_error = 0.0_dp    !! there [p*]
      !> Strain energy per nominal area, the mean of p u/2 [p* Delta].
      real(dp) :: energy = 0.0_dp, energy_error = 0.0_dp
      !> Of one contact spot or, above merging, of one open island [length].
      real(dp) :: perimeter = 0.0_dp, perimeter_error = 0.0_dp
      integer :: degree = 0                                                   !! of the expansion
   end type contact_details

end module wavycon_contact_details
