!> The stress at a point of an elastic body: its components, as the sum of the stress of the pressure's waves and of the
!> stress of the mean pressure, and the measures of it that decide on yield.
!>
!> Stresses are positive in tension. The six components stand in the order xx, yy, zz, xy, xz, yz. They may be in any
!> unit, and all results are in the same unit. A stress with a component that is not finite has NaN for its
!> principal stresses and its largest shear.
module wavycon_stress_tensor
   use wavycon_kinds, only: dp, ieee_is_finite, not_a_number
   use wavycon_lapack, only: dsyev
   implicit none (type, external)
   private

   public :: elastic_body, largest_shear, principal_stresses, stress_pressure, von_mises

   !> Positions of the components in an array of six.
   integer, parameter, public :: xx = 1, yy = 2, zz = 3, xy = 4, xz = 5, yz = 6

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

   !> Von Mises stress [(d1^2 + d2^2 + d3^2)/2 + 3 (xy^2 + xz^2 + yz^2)]^(1/2) with the differences d1 = xx - yy,
   !> d2 = yy - zz, d3 = zz - xx. In uniaxial tension it is the tension.
   pure real(dp) function von_mises(s)
      real(dp), intent(in) :: s(6)  !! stress

      von_mises = sqrt(((s(xx) - s(yy))**2 + (s(yy) - s(zz))**2 + (s(zz) - s(xx))**2)/2 &
         + 3*(s(xy)**2 + s(xz)**2 + s(yz)**2))
   end function von_mises

   !> Largest shear stress of all planes through the point, (s1 - s3)/2. By Tresca's criterion a body yields where this
   !> stress reaches half of the yield stress.
   !>
   !> The principal stresses are computed from the deviator, whose normal components are formed from differences of the
   !> stress's. So a large hydrostatic pressure does not cost digits.
   pure real(dp) function largest_shear(s)
      real(dp), intent(in) :: s(6)  !! stress

      real(dp) :: deviator(6), principal(3)

      deviator(xx) = ((s(xx) - s(yy)) + (s(xx) - s(zz)))/3
      deviator(yy) = ((s(yy) - s(zz)) + (s(yy) - s(xx)))/3
      deviator(zz) = ((s(zz) - s(xx)) + (s(zz) - s(yy)))/3
      deviator(xy:) = s(xy:)
      principal = principal_stresses(deviator)
      largest_shear = (principal(1) - principal(3))/2
   end function largest_shear

   !> Hydrostatic pressure, -(xx + yy + zz)/3.
   pure real(dp) function stress_pressure(s)
      real(dp), intent(in) :: s(6)  !! stress

      stress_pressure = -(s(xx) + s(yy) + s(zz))/3
   end function stress_pressure

   !> Principal stresses s1 >= s2 >= s3. The error of each is of the order of rounding of the largest one, also where
   !> two are equal. All are NaN if a component of the stress is not finite.
   !>
   !> N.B. The closed formula with arccos is not used: it loses half of the digits where two principal stresses are
   !> equal, as on every axis of symmetry.
   pure function principal_stresses(s) result(principal)
      real(dp), intent(in) :: s(6)  !! stress
      real(dp) :: principal(3)

      real(dp) :: ascending(3), matrix(3, 3), work(8)
      integer :: info

      principal = not_a_number()
      ! LAPACK compares numbers. A comparison with NaN stops a build that traps exceptions.
      if (.not. all(ieee_is_finite(s))) return
      ! DSYEV reads the lower triangle only.
      matrix = 0
      matrix(:, 1) = s([xx, xy, xz])
      matrix(2:, 2) = s([yy, yz])
      matrix(3, 3) = s(zz)
      call dsyev('N', 'L', 3, matrix, 3, ascending, work, size(work), info)
      if (info == 0) principal = ascending(3:1:-1)
   end function principal_stresses

end module wavycon_stress_tensor
