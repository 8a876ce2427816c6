!> The kernel of the bodies below a surface: the stiffness of each wave of the displacement. Series and grids ask the
!> surface's kernel for this stiffness; no other code contains it.
module wavycon_wave_stiffness
   use wavycon_elastic_layer, only: elastic_layer
   use wavycon_kinds, only: dp, sp
   implicit none (type, external)
   private

   public :: wave_stiffness

   !> N.B. The half-space has no length of its own. A layer has its thickness, in the unit of length of the frequencies.
   type :: wave_stiffness
      type(elastic_layer) :: layer
   contains
      !> From squared frequencies of waves, 1/wavelength^2, to their stiffness, pressure over displacement, in place.
      !> Its unit is such that it is the frequency for short waves: at their scale every body is a half-space.
      generic :: of => of_dp, of_sp
      procedure, private :: of_dp, of_sp
      procedure :: has_layer, in_unit, order
   end type wave_stiffness

contains

   !> Whether the bodies are not half-spaces.
   elemental logical function has_layer(self)
      class(wave_stiffness), intent(in) :: self

      has_layer = self%layer%thickness > 0.0_dp
   end function has_layer

   !> The same kernel with another unit of length.
   pure type(wave_stiffness) function in_unit(self, unit) result(kernel)
      class(wave_stiffness), intent(in) :: self
      real(dp), intent(in) :: unit   !! > 0 [length]

      kernel%layer = self%layer
      kernel%layer%thickness = kernel%layer%thickness/unit
   end function in_unit

   !> The power of the wave number with which the compliance goes about a wave, (E33): exactly -1 on half-spaces.
   pure real(dp) function order(self, frequency)
      class(wave_stiffness), intent(in) :: self
      real(dp), intent(in) :: frequency   !! of the wave, > 0

      real(dp) :: waves(2)

      waves = frequency**2*[0.5_dp, 2.0_dp]
      call self%of(waves)
      order = log(waves(1)/waves(2))/log(2.0_dp)
   end function order

   !> The half-space, (E9) of the page of src/core/half_space, over the factor of the layer, (E27).
   pure subroutine of_dp(self, waves)
      class(wave_stiffness), intent(in) :: self
      real(dp), intent(inout), contiguous :: waves(:)   !! squared frequencies, >= 0, then stiffnesses

      waves = sqrt(waves)
      if (.not. self%has_layer()) return
      where (waves > 0.0_dp) waves = waves/self%layer%factor(waves)
   end subroutine of_dp

   !> As `of_dp`, through double precision where there is a layer: of a thin one single precision has few digits.
   pure subroutine of_sp(self, waves)
      class(wave_stiffness), intent(in) :: self
      real(sp), intent(inout), contiguous :: waves(:)

      real(dp), allocatable :: in_double(:)

      if (self%has_layer()) then
         in_double = waves
         call self%of_dp(in_double)
         waves = real(in_double, sp)
      else
         waves = sqrt(waves)
      end if
   end subroutine of_sp

end module wavycon_wave_stiffness
