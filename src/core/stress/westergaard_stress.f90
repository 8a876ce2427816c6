!> Stresses below the one-dimensional wave in plane strain, in closed form.
!>
!> The pressure is Westergaard's, equation (4) of Johnson, Greenwood & Higginson (1985). Its stress function, with
!> w = (X + i Z)/2, X = 2 pi x/lambda from a crest, Z = 2 pi z/lambda into the solid, and P = pbar/p*,
!>
!>     F(w) = 2 P cos w/(R - i sin w),   R = (P - sin^2 w)^(1/2),   Re R >= 0,
!>
!> is analytic for Z > 0, tends to P at depth, and its real part on Z = 0 is the pressure (4): H = Re F is the harmonic
!> continuation of the pressure. Without friction the stresses are (H. M. Westergaard, J. Appl. Mech. 6 (1939) A49-A53)
!>
!>     s_zz = -H + z dH/dz,   s_xx = -H - z dH/dz,   s_xz = z dH/dx,   s_yy = nu (s_xx + s_zz) = -2 nu H.
!>
!> In full contact F = P + exp(i X - Z). With adhesion the contact is that of a load P1 = P + T less flat punches under
!> the mean tension T, whose function is, (I24) of src/beyond/README.md,
!>
!>     F_T(w) = T cos w/R,   R = (P1 - sin^2 w)^(1/2).
!>
!> Stresses are in p* = pi E* Delta/lambda, positive in tension.
module wavycon_westergaard_stress
   use wavycon_kinds, only: dp
   use wavycon_stress_tensor, only: xx, xz, yy, zz
   implicit none (type, external)
   private

   public :: westergaard_stress

contains

   !> Stresses of the pressure less its mean: those of F - P. Without load they are zero. The stress of the mean
   !> pressure is not included: s_zz = -P, and the lateral stress that the boundaries of the solid impose.
   !>
   !> Errors are of the order of rounding of X, Z and the load, at all loads and depths. For this F - P and its
   !> derivative are written so that the terms of a sum have the same sign, both in the real and in the imaginary part,
   !>
   !>     F - P = P [exp(i w) + (1 - P)/(cos w + R)]/(R - i sin w),
   !>     dF/d(X + i Z) = i P [R - i (1 - P) sin w]/[R (R - i sin w)^2],
   !>
   !> with R^2 = P - sin^2(X/2) + cos X sinh^2(Z/2) - (i/2) sin X sinh Z. Each function of w is computed with the factor
   !> exp(-Z/2), so that none overflows at large depths. With adhesion
   !>
   !>     F_T - T = T (1 - P1)/[R (cos w + R)],   dF_T/d(X + i Z) = T (1 - P1) sin w/(2 R^3),
   !>
   !> which are infinite at the edge of contact: the stresses are huge there.
   pure subroutine westergaard_stress(x, z, pbar_over_pstar, nu_terms, tension)
      real(dp), intent(in) :: x                !! 2 pi x/lambda, from a crest [rad]
      real(dp), intent(in) :: z                !! 2 pi z/lambda, depth, >= 0 [rad]
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure, with adhesion P1 = P + T [p*]
      real(dp), intent(out) :: nu_terms(6, 2)
         !! nu_terms(:, 1): stresses xx, yy, zz, xy, xz, yz for nu = 0; nu_terms(:, 2): their derivatives by nu [p*]
      real(dp), intent(in), optional :: tension  !! T >= 0 of adhesion, with P1 < 1; absent: 0 [p*]

      complex(dp) :: change  !! F - P
      complex(dp) :: slope   !! Z times the derivative of F with respect to X + i Z

      if (pbar_over_pstar >= 1) then
         change = exp(-z)*cmplx(cos(x), sin(x), dp)
         slope = z*(0.0_dp, 1.0_dp)*change
      else if (pbar_over_pstar > 0) then
         call partial_contact(x, z, pbar_over_pstar, change, slope, tension)
      else
         change = 0
         slope = 0
      end if

      nu_terms = 0
      nu_terms(xx, 1) = -change%re + slope%im
      nu_terms(zz, 1) = -change%re - slope%im
      nu_terms(xz, 1) = slope%re
      nu_terms(yy, 2) = -2*change%re
   end subroutine westergaard_stress

   !> F - P and Z dF/d(X + i Z) in partial contact, 0 < P < 1. With adhesion those of F - F_T - (P1 - T).
   pure subroutine partial_contact(x, z, load, change, slope, tension)
      real(dp), intent(in) :: x, z            !! X, Z [rad]
      real(dp), intent(in) :: load            !! P, with adhesion P1
      complex(dp), intent(out) :: change      !! F - P
      complex(dp), intent(out) :: slope       !! Z dF/d(X + i Z)
      real(dp), intent(in), optional :: tension   !! T

      real(dp) :: c, s         !! cos and sin of X/2 for the nearest crest
      real(dp) :: decay        !! exp(-Z)
      real(dp) :: cosh_z, sinh_z, inside
      complex(dp) :: cos_w, minus_i_sin_w, root, total

      c = cos(x/2)
      s = sign(1.0_dp, c)*sin(x/2)
      c = abs(c)
      decay = exp(-z)
      ! sinh(Z/2) and cosh(Z/2), each times exp(-Z/2).
      sinh_z = tanh(z/2)/(1 + tanh(z/2))
      cosh_z = (1 + decay)/2
      cos_w = cmplx(c*cosh_z, -s*sinh_z, dp)
      minus_i_sin_w = cmplx(c*sinh_z, -s*cosh_z, dp)

      ! P - sin^2(X/2), computed from the smaller of two numbers, so that fewer digits cancel.
      inside = c**2 - (1 - load)
      if (load < 0.5_dp) inside = load - s**2
      ! On the surface the imaginary part is zero. Its sign is that of -s, and by this sign sqrt chooses the right side
      ! of its branch cut on the negative real axis.
      root = sqrt(cmplx(decay*inside + (c - s)*(c + s)*sinh_z**2, -2*s*c*cosh_z*sinh_z, dp))
      total = root + minus_i_sin_w

      change = load*decay*(cmplx(c, s, dp) + (1 - load)/(cos_w + root))/total
      ! At the edge of contact the root is 0, and the quotient cannot be computed. Its product with Z tends to 0 there.
      slope = 0
      if (abs(root) > 0) slope = (0.0_dp, 1.0_dp)*load*decay*z*((root + (1 - load)*minus_i_sin_w)/root)/total**2
      if (.not. present(tension)) return
      if (tension <= 0) return
      if (abs(root) <= 0) root = epsilon(1.0_dp)
      change = change - tension*(1 - load)*decay/(root*(cos_w + root))
      slope = slope - (0.0_dp, 0.5_dp)*z*tension*(1 - load)*decay*minus_i_sin_w/root**3
   end subroutine partial_contact

end module wavycon_westergaard_stress
