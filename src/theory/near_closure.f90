!> Longer asymptotes of the two-dimensional wave for pbar -> p*: mean gap and contact area.
!>
!> They extend equations (24) and (30) of Johnson, Greenwood & Higginson (1985) in powers of e = 1 - pbar/p*. Both
!> apply near pbar = p* and are those of full contact above; below they return their formula's value. They are useful
!> down to pbar = 0.8 p* or so. p* = sqrt(2) pi E* Delta/lambda, gaps are in Delta.
!>
!> Derivation, with lengths in s = lambda/sqrt(2) and a trough at r = 0: the pressure that opens the crack is
!> e - pi^2 r^2 + (pi^4/4) r^4 + terms in cos(4 theta), and the volume G of each other crack adds the tension
!> G/(4 pi^2 |n|^3). With y = pi^2 b^2 the stress intensity factor vanishes for 2 y/3 - 2 y^2/15 = e + k G,
!> k = S_3/(4 pi^2), S_3 the lattice's sum of 1/|n|^3.
module wavycon_near_closure
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_lattice_sums, only: inverse_cube_sum
   use wavycon_penny_crack, only: penny_crack_mean_gap_over_amplitude
   implicit none (type, external)
   private

   public :: near_closure_contact_area_fraction, near_closure_mean_gap_over_amplitude

contains

   !> Fraction of the nominal area in contact, 1 - (3/(2 pi)) [e + 0.3 e^2 + k G_30], with (30) for
   !> G_30, which goes as e^(5/2). The error is O(e^3).
   elemental real(dp) function near_closure_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: e

      e = max(0.0_dp, 1 - pbar_over_pstar)
      fraction = 1 - 3/(2*pi) &
         *(e + 0.3_dp*e**2 + interaction()*penny_crack_mean_gap_over_amplitude(pbar_over_pstar))
   end function near_closure_contact_area_fraction

   !> Mean gap, (30) times 1 + (9/28) e + (5/2) k G_30/e; the error is O(e^2) of it.
   elemental real(dp) function near_closure_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      real(dp) :: e, g_30

      e = max(0.0_dp, 1 - pbar_over_pstar)
      g_30 = penny_crack_mean_gap_over_amplitude(pbar_over_pstar)
      gap = 0
      if (e > 0) gap = g_30*(1 + 9*e/28 + 2.5_dp*interaction()*g_30/e)
   end function near_closure_mean_gap_over_amplitude

   !> Tension at one trough for unit mean gap at all the others, k [p*/Delta].
   pure real(dp) function interaction()
      interaction = inverse_cube_sum()/(4*pi**2)
   end function interaction

end module wavycon_near_closure
