!> The stress at a point: its components, and the measures of it that decide on yield.
!>
!> Stresses are positive in tension. The six components stand in the order xx, yy, zz, xy, xz, yz. They may be in any
!> unit, and all results are in the same unit. A stress with a component that is not finite has NaN for its
!> principal stresses and its largest shear.
module wavycon_stress_tensor
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_lapack, only: dsyev
   implicit none (type, external)
   private

   public :: largest_shear, principal_stresses, stress_pressure, von_mises

   !> Positions of the components in an array of six.
   integer, parameter, public :: xx = 1, yy = 2, zz = 3, xy = 4, xz = 5, yz = 6

contains

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
