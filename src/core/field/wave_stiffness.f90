!> The kernel of the bodies below a surface: the stiffness of each wave of the displacement. Series and grids ask the
!> surface's kernel for this stiffness; no other code contains it.
module wavycon_wave_stiffness
   use wavycon_kinds, only: dp, sp
   implicit none (type, external)
   private

   public :: wave_stiffness

   !> N.B. The kernel of the half-space has no length of its own. One that has, such as that of a layer, has it as a
   !> component, in the unit of length of the frequencies.
   type :: wave_stiffness
   contains
      !> From squared frequencies of waves, 1/wavelength^2, to their stiffness, pressure over displacement, in place.
      !> Its unit is such that it is the frequency for short waves: at their scale every body is a half-space.
      generic :: of => of_dp, of_sp
      procedure, nopass, private :: of_dp, of_sp
   end type wave_stiffness

contains

   !> The half-space: (E9) of the page of src/core/half_space.
   pure subroutine of_dp(waves)
      real(dp), intent(inout), contiguous :: waves(:)   !! squared frequencies, >= 0, then stiffnesses

      waves = sqrt(waves)
   end subroutine of_dp

   pure subroutine of_sp(waves)
      real(sp), intent(inout), contiguous :: waves(:)

      waves = sqrt(waves)
   end subroutine of_sp

end module wavycon_wave_stiffness
