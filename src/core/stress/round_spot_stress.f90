!> Stresses below a round spot in closed form: those of Hertz's pressure and, for a ball with adhesion, of a flat punch.
!>
!> Lengths are over the radius of the spot, and c = z + i. A point at the complex depth c has the potential of the flat
!> punch: with R = (r^2 + c^2)^(1/2), Re R >= 0, the function -Im(1/R) is (1 - r^2)^(-1/2) on the spot, 0 outside of it,
!> and harmonic below. Hertz's pressure is the integral of punches over their radius. Both are (I23) of
!> src/beyond/README.md.
module wavycon_round_spot_stress
   use wavycon_kinds, only: dp
   use wavycon_stress_kernel, only: nu_terms_of
   implicit none (type, external)
   private

   public :: round_spot_stress

contains

   !> The stresses of the pressure hertz (1 - r^2)^(1/2) - punch (1 - r^2)^(-1/2) on the spot r < 1. Those of the punch
   !> are infinite at its edge, and huge numbers there.
   pure subroutine round_spot_stress(place, z, hertz, punch, nu_terms)
      complex(dp), intent(in) :: place         !! x + i y from the middle of the spot, over its radius
      real(dp), intent(in) :: z                !! depth over the radius, >= 0
      real(dp), intent(in) :: hertz            !! peak of Hertz's pressure
      real(dp), intent(in) :: punch            !! pressure of the punch in the middle, a tension if > 0
      real(dp), intent(out) :: nu_terms(6, 2)  !! as of nu_terms_of, in the unit of the pressures

      complex(dp), parameter :: i = (0.0_dp, 1.0_dp)
      complex(dp) :: c, root, u
      real(dp) :: d2l, d2v, dh, h, hz   ! H, dH/dz; D^2 L and D^2 V over place^2, D H over place
      real(dp) :: r2

      c = cmplx(z, 1.0_dp, dp)
      r2 = place%re**2 + place%im**2
      ! r^2 + c^2, with 1 - r^2 from the difference of r and 1. On the surface the sign of the imaginary part is +.
      root = sqrt(cmplx(z**2 - (1.0_dp - abs(place))*(1.0_dp + abs(place)), 2*z, dp))
      if (abs(root) <= 0.0_dp) root = epsilon(1.0_dp)
      u = root + c
      h = hertz*aimag(root - z*log(u)) + punch*aimag(1/root)
      hz = -hertz*aimag(log(u) - i/root) - punch*aimag(c/root**3)
      d2l = -hertz*aimag(0.25_dp*(1/u + r2/(3*u**3)) + 0.5_dp*i/u**2) + punch*aimag(1/(root*u**2))
      d2v = -hertz*aimag(0.5_dp/u**2 + i/(root*u**2)) + punch*aimag((root + u)/(root**3*u**2))
      dh = hertz*aimag(1/u + i/(root*u)) - punch*aimag(1/root**3)
      nu_terms = nu_terms_of([h, z*hz, d2l*real(place**2), d2l*aimag(place**2), z*d2v*real(place**2), &
                              z*d2v*aimag(place**2), z*dh*place%re, z*dh*place%im])
   end subroutine round_spot_stress

end module wavycon_round_spot_stress
