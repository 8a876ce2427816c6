!> The constructors of surfaces made of waves, by one name.
module wavycon_wave_surfaces
   use wavycon_crossed_1d, only: crossed_1d
   use wavycon_hexagonal, only: hexagonal
   use wavycon_wave_1d, only: wave_1d
   use wavycon_wave_2d, only: wave_2d
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: crossed_1d, hexagonal, wave_1d, wave_2d, wave_sum

end module wavycon_wave_surfaces
