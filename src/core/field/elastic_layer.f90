!> An elastic layer on a base: what it makes of the compliance of a half-space, for each wave and for the mean pressure.
!> Numbers (E..) are the equations of src/core/half_space/README.md.
module wavycon_elastic_layer
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: elastic_layer

   type :: elastic_layer
      !> h, its thickness, in the unit of length of the frequencies; 0: there is none.
      real(dp) :: thickness = 0.0_dp
      !> Whether it slides on its base without friction, which is then rigid. If not, it is bonded.
      logical :: slides = .false.
      real(dp) :: nu = 0.5_dp             !! Poisson's ratio, which does not matter if it slides
      !> Of its base: the layer's shear modulus over that of the base, 0: the base is rigid; and Poisson's ratio.
      real(dp) :: shear_ratio = 0.0_dp, base_nu = 0.5_dp
      !> Its part of the compliance of the shortest waves, E*/E1*; the rest is that of the other body, a half-space.
      real(dp) :: share = 1.0_dp
   contains
      procedure :: factor, mean_compliance
   end type elastic_layer

   !> Beyond this 2kh the factor is one to all digits: it differs from one by less than its square times exp(-2kh).
   real(dp), parameter :: thickest = 60.0_dp

contains

   !> The compliance of a wave over that of the half-space, (E27): (E29) of a bonded layer, (E28) of one that slides.
   elemental real(dp) function factor(self, frequency)
      class(elastic_layer), intent(in) :: self
      real(dp), intent(in) :: frequency   !! of the wave, > 0

      real(dp) :: a, b, beyond, decay, excess, half, one, sine, square, top, x

      factor = 1.0_dp
      x = 4*pi*self%thickness*frequency
      if (x > thickest) return
      ! (E30), each times exp(-x) if x is not small.
      decay = exp(-x)
      if (x < 1.0_dp) then
         one = 1.0_dp
         sine = sinh(x)
         half = 2*sinh(0.5_dp*x)**2
         square = x**2
         excess = x*square/6*(1 + square/20*(1 + square/42*(1 + square/72*(1 + square/110*(1 + square/156*( &
                  1 + square/210*(1 + square/272)))))))
      else
         one = decay
         sine = 0.5_dp*(1.0_dp - decay**2)
         half = 0.5_dp*(1.0_dp - decay)**2
         excess = sine - x*decay
         decay = decay**2
         square = x**2*one
      end if
      if (self%slides) then
         factor = half/(sine + x*one)
      else
         a = 3 - 4*self%nu
         b = 3 - 4*self%base_nu
         associate (m => self%shear_ratio)
            beyond = 2*(1 - m)*(1 + m*b)
            top = m*(1 + a)*(1 + b)*decay + 2*(a - 1 + m*(2 + b*(a - 1)) + 2*m**2*b)*sine + beyond*excess
            factor = top/((1 + a)**2*one + 2*(m**2*b + 0.5_dp*m*(a - 1)*(b - 1) + a)*half + m*(1 + a)*(1 + b)*sine &
                          + 0.5_dp*beyond*square)
         end associate
      end if
      factor = self%share*factor + (1.0_dp - self%share)
   end function factor

   !> How much a mean pressure compresses the layer, as a length: times the pressure over pi E* [length], (E31).
   pure real(dp) function mean_compliance(self)
      class(elastic_layer), intent(in) :: self

      mean_compliance = pi*self%thickness*self%share
      if (.not. self%slides) mean_compliance = mean_compliance*(1 - 2*self%nu)/(1 - self%nu)**2
   end function mean_compliance

end module wavycon_elastic_layer
