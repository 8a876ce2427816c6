!> The stiffness of a wave.
module wavycon_wave_stiffness
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: wave_stiffness

contains

   !> The pressure of a wave over its displacement: of a half-space |k|, in the unit that E*/2 gives it.
   elemental real(dp) function wave_stiffness(kx, ky)
      real(dp), intent(in) :: kx, ky   !! wave vector, in any unit

      wave_stiffness = hypot(kx, ky)
   end function wave_stiffness

end module wavycon_wave_stiffness
