!> One of the two bodies: how its stresses follow from those of the waves of pressure and from the mean pressure.
module wavycon_elastic_body
   use wavycon_kinds, only: dp
   use wavycon_stress_tensor, only: xx, yy, zz
   implicit none (type, external)
   private

   public :: elastic_body

   !> The lateral stresses of the mean pressure pbar: no lateral strain, -nu pbar/(1 - nu); none; -pbar.
   integer, parameter, public :: laterally_constrained = 1, laterally_free = 2, hydrostatic = 3

   !> The parts where there is the mean pressure alone.
   real(dp), parameter, public :: no_waves(6, 2) = 0.0_dp

   type :: elastic_body
      real(dp) :: nu = 0.3_dp                        !! Poisson's ratio, -1 < nu <= 1/2
      integer :: lateral = laterally_constrained     !! one of the names above
   contains
      procedure :: stress
   end type elastic_body

contains

   !> The stress, tension positive: that of the waves (S1) and that of the mean pressure (S2).
   pure function stress(self, parts, pbar)
      class(elastic_body), intent(in) :: self
      real(dp), intent(in) :: parts(6, 2)   !! as of wavycon_stress_fields
      real(dp), intent(in) :: pbar          !! mean pressure, in the unit of the parts
      real(dp) :: stress(6)                 !! xx, yy, zz, xy, xz, yz

      real(dp) :: lateral(3)   ! over -pbar, in the order of the names

      lateral = [self%nu/(1.0_dp - self%nu), 0.0_dp, 1.0_dp]
      stress = parts(:, 1) + self%nu*parts(:, 2)
      stress([xx, yy]) = stress([xx, yy]) - lateral(self%lateral)*pbar
      stress(zz) = stress(zz) - pbar
   end function stress

end module wavycon_elastic_body
