!> The &surface group: which waves the bodies carry.
module wavycon_surface_group
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: surface_group_type, surface_dimension

   !> What &surface says.
   type :: surface_group_type
      character(12) :: kind = ''                         !! 'wave_1d', 'wave_2d' or 'crossed_1d'
      real(dp) :: amplitude = 1, wavelength = 1          !! of wave_1d and wave_2d [length]
      real(dp) :: amplitude1 = 0, amplitude2 = 0         !! of the two blocks of crossed_1d [length]
      real(dp) :: wavelength1 = 0, wavelength2 = 0       !! of the two blocks of crossed_1d [length]
   end type surface_group_type

contains

   !> 1 where the gap depends on x alone, else 2.
   pure integer function surface_dimension(surface)
      type(surface_group_type), intent(in) :: surface

      surface_dimension = merge(1, 2, surface%kind == 'wave_1d')
   end function surface_dimension

end module wavycon_surface_group
