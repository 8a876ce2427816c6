!> Three equal waves whose directions differ by 60 degrees.
module wavycon_hexagonal
   use wavycon_constants, only: sqrt3
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: hexagonal

contains

   !> Three equal waves whose directions differ by 60 degrees: h = Delta [1 - (cos k1.r + cos k2.r + cos k3.r)/3] with
   !> wave vectors k1, k2, k3 = k2 - k1 of length 2 pi/lambda. The crests form rows along x with a distance of 2
   !> lambda/sqrt3 in each; the rectangular cell has two crests.
   type(surface_type) function hexagonal(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! of each wave [length], > 0

      surface = wave_sum([2/sqrt3, 2.0_dp]*wavelength, spread(amplitude/3, 1, 3), [0, 1, 1], [2, 1, -1], &
                         spread(0.0_dp, 1, 3))
   end function hexagonal

end module wavycon_hexagonal
