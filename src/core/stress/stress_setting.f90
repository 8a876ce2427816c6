!> The bodies whose stresses are computed, and the criterion of their yield.
module wavycon_stress_setting
   use wavycon_kinds, only: dp, ieee_is_nan
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_tensor, only: elastic_body
   implicit none (type, external)
   private

   public :: stress_setting

   type :: stress_setting
      !> The first body, and the second body if its Poisson's ratio or its yield stress differs from the first one's.
      type(elastic_body), allocatable :: body(:)
      real(dp), allocatable :: yield_stress(:)   !! of each body, in uniaxial tension [p*]; not allocated if not given
      logical :: by_shear = .false.              !! true: bodies yield by Tresca's criterion; false: by von Mises'
   contains
      procedure :: over_yield_stress, find_over_yield_stress
   end type stress_setting

contains

   !> The equivalent stress of a body over its yield stress. The equivalent stress is the von Mises stress or, by
   !> Tresca's criterion, twice the largest shear stress.
   elemental real(dp) function over_yield_stress(self, body, von_mises, shear) result(ratio)
      class(stress_setting), intent(in) :: self      !! yield_stress is allocated
      integer, intent(in) :: body                    !! number of the body: 1 or 2
      real(dp), intent(in) :: von_mises, shear       !! stresses, or their errors [p*]

      ratio = von_mises
      if (self%by_shear) ratio = 2*shear
      ratio = ratio/self%yield_stress(body)
   end function over_yield_stress

   !> Finds the largest ratio of equivalent stress to yield stress, over all places and both bodies.
   subroutine find_over_yield_stress(self, fields, ratio, error, stresses)
      class(stress_setting), intent(in) :: self          !! yield_stress is allocated
      class(stress_fields), intent(inout) :: fields      !! the stresses of one load
      real(dp), intent(out) :: ratio                     !! [-]; NaN if the load has no solution
      real(dp), intent(out) :: error                     !! estimate of the error of the ratio; NaN if there is none
      !> Von Mises stress (1) and shear stress (2) of each body, shape (2, bodies). If present both are searched for.
      type(largest_stress), intent(out), optional :: stresses(:, :)

      type(largest_stress) :: largest(2)
      real(dp) :: of_body
      integer :: i

      ratio = 0.0_dp
      error = 0.0_dp
      do i = 1, size(self%body)
         if (present(stresses)) then
            call find_largest_stresses(fields, self%body(i), largest(1), largest(2))
            stresses(:, i) = largest
         else if (self%by_shear) then
            call find_largest_stresses(fields, self%body(i), shear=largest(2))
         else
            call find_largest_stresses(fields, self%body(i), yielding=largest(1))
         end if
         of_body = self%over_yield_stress(i, largest(1)%value, largest(2)%value)
         ! The ratio is NaN if the load has no solution. A comparison with NaN stops a build that traps exceptions.
         if (.not. ieee_is_nan(of_body)) then
            if (of_body < ratio) cycle
         end if
         ratio = of_body
         error = self%over_yield_stress(i, largest(1)%error, largest(2)%error)
      end do
   end subroutine find_over_yield_stress

end module wavycon_stress_setting
