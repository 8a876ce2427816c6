!> How a solution changes with the load: the derivatives of mean gap and contact area. src/interface/README.md derives
!> what follows from them.
module wavycon_load_derivatives
   use wavycon_contact_measures, only: unknown
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: load_derivatives

   !> At fixed contact a change of load is that of a rigid punch of the contact's shape, whose pressure is k/sqrt(rho)
   !> at a distance rho from the edge. What is `unknown`, huge, does not exist or is not computed.
   type :: load_derivatives
      real(dp) :: gap_slope = unknown, gap_slope_error = unknown            !! G'(P) <= 0 [Delta/p*]
      real(dp) :: area_slope = unknown, area_slope_error = unknown          !! A'(P) of the area fraction [1/p*]
      real(dp) :: gap_curvature = unknown, gap_curvature_error = unknown    !! G''(P) >= 0 [Delta/p*^2]
      !> Least and largest k^2 along the edge over its mean, which is weighted with the edge's velocity.
      real(dp) :: intensity_range(2) = unknown
   end type load_derivatives

end module wavycon_load_derivatives
