!> What a scene asks of the stresses: the bodies and when they yield.
module wavycon_stress_setting
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_elastic_body, only: elastic_body
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_stress_fields, only: stress_fields
   implicit none (type, external)
   private

   public :: stress_setting

   type :: stress_setting
      !> The first body and, if its Poisson's ratio or yield stress differs, the second.
      type(elastic_body), allocatable :: body(:)
      real(dp), allocatable :: yield_stress(:)   !! of each body, in uniaxial tension [p*]; not allocated if not given
      logical :: by_shear = .false.              !! whether it yields by Tresca's criterion rather than von Mises'
   contains
      procedure :: over_yield_stress
      procedure :: find_over_yield_stress
   end type stress_setting

contains

   !> The equivalent stress of a body over its yield stress: a von Mises stress, or twice a shear stress.
   elemental real(dp) function over_yield_stress(self, body, von_mises, shear) result(ratio)
      class(stress_setting), intent(in) :: self      !! with yield stresses
      integer, intent(in) :: body                    !! its number
      real(dp), intent(in) :: von_mises, shear       !! stresses, or their errors [p*]

      ratio = merge(2*shear, von_mises, self%by_shear)/self%yield_stress(body)
   end function over_yield_stress

   !> The largest equivalent stress over the yield stress, of both bodies.
   subroutine find_over_yield_stress(self, fields, ratio, error)
      class(stress_setting), intent(in) :: self
      class(stress_fields), intent(inout) :: fields
      real(dp), intent(out) :: ratio
      real(dp), intent(out) :: error   !! estimate of its error

      type(largest_stress) :: largest
      real(dp) :: of_body
      integer :: i

      ratio = 0.0_dp
      error = 0.0_dp
      do i = 1, size(self%body)
         if (self%by_shear) then
            call find_largest_stresses(fields, self%body(i), shear=largest)
         else
            call find_largest_stresses(fields, self%body(i), yielding=largest)
         end if
         of_body = self%over_yield_stress(i, largest%value, largest%value)
         ! A build that traps exceptions does not survive a comparison with NaN, which is the stress without a solution.
         if (.not. ieee_is_nan(of_body)) then
            if (of_body < ratio) cycle
         end if
         ratio = of_body
         error = self%over_yield_stress(i, largest%error, largest%error)
      end do
   end subroutine find_over_yield_stress

end module wavycon_stress_setting
