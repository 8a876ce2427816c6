!> One of the two elastic bodies: its stress at a point as the sum of the stress of the pressure's waves and of the
!> stress of the mean pressure.
module wavycon_elastic_body
   use wavycon_kinds, only: dp
   use wavycon_stress_tensor, only: xx, yy, zz
   implicit none (type, external)
   private

   public :: elastic_body

   !> The lateral stress that the mean pressure pbar causes, (S2). `laterally_constrained`: -nu pbar/(1 - nu), as there
   !> is no lateral strain. `laterally_free`: none. `hydrostatic`: -pbar.
   integer, parameter, public :: laterally_constrained = 1, laterally_free = 2, hydrostatic = 3

   !> The argument `nu_terms` of `stress` where the pressure has no waves: `stress` then returns that of the mean
   !> pressure.
   real(dp), parameter, public :: no_waves(6, 2) = 0.0_dp

   type :: elastic_body
      real(dp) :: nu = 0.3_dp                        !! Poisson's ratio, -1 < nu <= 1/2
      integer :: lateral = laterally_constrained     !! or laterally_free, or hydrostatic
   contains
      procedure :: stress
   end type elastic_body

contains

   !> The stress at a point, tension positive: the sum of that of the pressure's waves, (S1), and that of the mean
   !> pressure, (S2).
   pure function stress(self, nu_terms, pbar)
      class(elastic_body), intent(in) :: self
      !> The stress of the waves is nu_terms(:, 1) + nu*nu_terms(:, 2): see `at` of wavycon_stress_fields.
      real(dp), intent(in) :: nu_terms(6, 2)
      real(dp), intent(in) :: pbar          !! mean pressure, in the unit of `nu_terms`
      real(dp) :: stress(6)                 !! xx, yy, zz, xy, xz, yz, in the same unit

      real(dp) :: lateral(3)   ! lateral stress over -pbar for each choice of `lateral`

      lateral = [self%nu/(1.0_dp - self%nu), 0.0_dp, 1.0_dp]
      stress = nu_terms(:, 1) + self%nu*nu_terms(:, 2)
      stress([xx, yy]) = stress([xx, yy]) - lateral(self%lateral)*pbar
      stress(zz) = stress(zz) - pbar
   end function stress

end module wavycon_elastic_body
