!> Kuznetsov's exact mean gap under the one-dimensional wave.
module wavycon_kuznetsov
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: kuznetsov_mean_gap_over_amplitude

contains

   !> Mean gap G = 1 - P (1 - ln P), P = pbar/p*: equation (20) of Johnson, Greenwood & Higginson (1985).
   !>
   !> Exact for 0 <= P <= 1; 1 below and 0 above.
   elemental real(dp) function kuznetsov_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      if (pbar_over_pstar <= 0) then
         gap = 1
      else if (pbar_over_pstar >= 1) then
         gap = 0
      else
         ! In this order the difference loses few digits near P = 1, where G is (1 - P)^2/2.
         gap = max(0.0_dp, (1 - pbar_over_pstar) + pbar_over_pstar*log(pbar_over_pstar))
      end if
   end function kuznetsov_mean_gap_over_amplitude

end module wavycon_kuznetsov
