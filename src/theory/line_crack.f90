!> The one-dimensional wave near full contact: each open strip is a separate pressurised crack.
!>
!> The limit pbar -> p* of Westergaard's solution, equations (9) to (11) of Johnson, Greenwood & Higginson
!> (1985). The interface has no strength, so the crack opens until its stress intensity factor is zero.
!> Pressures are in p* = pi E* Delta/lambda, lengths in lambda.
module wavycon_line_crack
   use wavycon_constants, only: pi
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_quadrature, only: integrate
   implicit none (type, external)
   private

   public :: line_crack_pressure_over_pstar, line_crack_stress_intensity
   public :: line_crack_half_width_over_wavelength, line_crack_contact_area_fraction

contains

   !> Pressure that opens the crack, equation (9): (1 - pbar/p*) - 2 pi^2 (x/lambda)^2.
   !>
   !> It is the tension that would keep the trough closed, to second order in x/lambda. The formula's value is
   !> returned for any argument.
   elemental real(dp) function line_crack_pressure_over_pstar(x_over_wavelength, pbar_over_pstar) result(p)
      real(dp), intent(in) :: x_over_wavelength  !! from the trough [lambda]
      real(dp), intent(in) :: pbar_over_pstar    !! mean pressure [p*]

      p = (1 - pbar_over_pstar) - 2*(pi*x_over_wavelength)**2
   end function line_crack_pressure_over_pstar

   !> Stress intensity factor at the ends of a crack of any half width b, equation (10), by quadrature:
   !>
   !>     K_I = (pi b)^(-1/2) integral over |x| < b of p(x) ((b + x)/(b - x))^(1/2).
   !>
   !> It is positive where the crack would grow.
   subroutine line_crack_stress_intensity(half_width_over_wavelength, pbar_over_pstar, &
      k_over_pstar_root_wavelength, error)
      real(dp), intent(in) :: half_width_over_wavelength     !! b [lambda]; <= 0: no crack, K_I = 0
      real(dp), intent(in) :: pbar_over_pstar                !! mean pressure [p*]
      real(dp), intent(out) :: k_over_pstar_root_wavelength  !! K_I [p* lambda^(1/2)]
      type(error_type), allocatable, intent(out) :: error    !! exit_not_converged: the quadrature failed

      real(dp) :: integral

      k_over_pstar_root_wavelength = 0
      if (half_width_over_wavelength <= 0) return
      call integrate(pressure_along_crack, [half_width_over_wavelength, pbar_over_pstar], -1.0_dp, 1.0_dp, &
         integral, error, left_power=0.5_dp, right_power=-0.5_dp)
      k_over_pstar_root_wavelength = sqrt(half_width_over_wavelength/pi)*integral
   end subroutine line_crack_stress_intensity

   !> The pressure as a function of t = x/b.
   pure real(dp) function pressure_along_crack(t, parameters) result(p)
      real(dp), intent(in) :: t
      real(dp), intent(in) :: parameters(:)  !! (2): b/lambda, pbar/p*

      p = line_crack_pressure_over_pstar(t*parameters(1), parameters(2))
   end function pressure_along_crack

   !> Half width of an open strip, equation (11): b/lambda = (1 - pbar/p*)^(1/2)/pi; 0 from pbar = p* on.
   !>
   !> Applies near pbar = p*; elsewhere the formula's value is returned: 0.32 at pbar = 0, where 1/2 is exact.
   elemental real(dp) function line_crack_half_width_over_wavelength(pbar_over_pstar) result(b)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      b = sqrt(max(0.0_dp, 1 - pbar_over_pstar))/pi
   end function line_crack_half_width_over_wavelength

   !> Fraction of the nominal area in contact, 1 - 2 b/lambda; 1 from pbar = p* on.
   elemental real(dp) function line_crack_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 1 - 2*line_crack_half_width_over_wavelength(pbar_over_pstar)
   end function line_crack_contact_area_fraction

end module wavycon_line_crack
