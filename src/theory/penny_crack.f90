!> The two-dimensional wave near full contact: each closed pool is a separate pressurised penny-shaped crack.
!>
!> The limit pbar -> p*: equations (24), (30) and Appendix 2 of Johnson, Greenwood & Higginson (1985), after
!> Sneddon. Pressures are in p* = sqrt(2) pi E* Delta/lambda, openings and gaps in Delta, lengths in lambda.
!> The radius, the contact area and the mean gap apply near pbar = p* and are those of full contact (0, 1,
!> 0) above; below they return their formula's value.
module wavycon_penny_crack
   use wavycon_constants, only: pi, sqrt2
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_quadrature, only: integrate
   implicit none (type, external)
   private

   public :: penny_crack_pressure_over_pstar, penny_crack_opening_shape
   public :: penny_crack_term_opening_over_amplitude, penny_crack_opening_over_amplitude, penny_crack_volume
   public :: penny_crack_radius_over_wavelength, penny_crack_contact_area_fraction
   public :: penny_crack_mean_gap_over_amplitude

contains

   !> Pressure that opens the crack, (A4): (1 - pbar/p*) - 2 pi^2 (r/lambda)^2.
   !>
   !> It is the tension that would keep the trough closed, to second order in r/lambda. The formula's value is
   !> returned for any argument.
   elemental real(dp) function penny_crack_pressure_over_pstar(r_over_wavelength, pbar_over_pstar) result(p)
      real(dp), intent(in) :: r_over_wavelength  !! distance from the trough [lambda]
      real(dp), intent(in) :: pbar_over_pstar    !! mean pressure [p*]

      p = (1 - pbar_over_pstar) - 2*(pi*r_over_wavelength)**2
   end function penny_crack_pressure_over_pstar

   !> Sneddon's I_n(rho), the integral of t^(n+1) (t^2 - rho^2)^(-1/2) for t from rho to 1, by the recurrence
   !>
   !>     (1 + n) I_n = (1 - rho^2)^(1/2) + n rho^2 I_{n-2};   0 for rho >= 1.
   !>
   !> The even ones start from I_0, the odd ones from I_{-1} = acosh(1/rho).
   elemental real(dp) function penny_crack_opening_shape(n, rho) result(shape)
      integer, intent(in) :: n     !! power of the pressure, >= 0
      real(dp), intent(in) :: rho  !! r/b, >= 0

      real(dp) :: root
      integer :: k

      shape = 0
      if (rho >= 1) return
      root = sqrt((1 - rho)*(1 + rho))
      ! rho^2 acosh(1/rho) goes to 0 with rho.
      if (modulo(n, 2) == 1 .and. rho > 0) shape = asinh(root/rho)
      do k = modulo(n, 2), n, 2
         shape = (root + k*rho**2*shape)/(1 + k)
      end do
   end function penny_crack_opening_shape

   !> Opening by the pressure A_n (r/b)^n, (A5), both faces together:
   !>
   !>     g_n = 2 b A_n/(sqrt(pi) E*) (n/2)!/((n+1)/2)! I_n(r/b);   0 for r >= b.
   elemental real(dp) function penny_crack_term_opening_over_amplitude(n, rho, a_n_over_pstar, &
      radius_over_wavelength) result(opening)
      integer, intent(in) :: n                        !! power of the pressure, >= 0
      real(dp), intent(in) :: rho                     !! r/b, >= 0
      real(dp), intent(in) :: a_n_over_pstar          !! A_n [p*]
      real(dp), intent(in) :: radius_over_wavelength  !! b [lambda]

      real(dp), parameter :: pstar_wavelength_over_modulus_amplitude = sqrt2*pi

      opening = pstar_wavelength_over_modulus_amplitude*2*radius_over_wavelength*a_n_over_pstar/sqrt(pi) &
         *gamma(0.5_dp*n + 1)/gamma(0.5_dp*n + 1.5_dp)*penny_crack_opening_shape(n, rho)
   end function penny_crack_term_opening_over_amplitude

   !> Opening of a crack of any radius by the pressure (A4): (A6), both faces together; 0 for r >= b.
   !>
   !> With a radius above that of (A7) it is negative near the edge: such a crack would close there.
   elemental real(dp) function penny_crack_opening_over_amplitude(rho, radius_over_wavelength, &
      pbar_over_pstar) result(opening)
      real(dp), intent(in) :: rho                     !! r/b, >= 0
      real(dp), intent(in) :: radius_over_wavelength  !! b [lambda]
      real(dp), intent(in) :: pbar_over_pstar         !! mean pressure [p*]

      real(dp) :: a_0, a_2  !! (A4) in powers of r/b

      a_0 = 1 - pbar_over_pstar
      a_2 = -2*(pi*radius_over_wavelength)**2
      opening = penny_crack_term_opening_over_amplitude(0, rho, a_0, radius_over_wavelength) &
         + penny_crack_term_opening_over_amplitude(2, rho, a_2, radius_over_wavelength)
   end function penny_crack_opening_over_amplitude

   !> Volume of a crack of any radius, (A8): the integral of 2 pi r g(r) for r < b, by quadrature.
   !>
   !> N.B. There is one crack to an area of lambda^2/2: the mean gap in Delta is twice this volume.
   subroutine penny_crack_volume(radius_over_wavelength, pbar_over_pstar, volume_over_amplitude_wavelength2, &
      error)
      real(dp), intent(in) :: radius_over_wavelength              !! b [lambda]; <= 0: no crack
      real(dp), intent(in) :: pbar_over_pstar                     !! mean pressure [p*]
      real(dp), intent(out) :: volume_over_amplitude_wavelength2  !! [Delta lambda^2]
      type(error_type), allocatable, intent(out) :: error         !! exit_not_converged: the quadrature failed

      real(dp) :: integral

      volume_over_amplitude_wavelength2 = 0
      if (radius_over_wavelength <= 0) return
      call integrate(opening_about_centre, [radius_over_wavelength, pbar_over_pstar], 0.0_dp, 1.0_dp, &
         integral, error)
      volume_over_amplitude_wavelength2 = 2*pi*radius_over_wavelength**2*integral
   end subroutine penny_crack_volume

   !> The opening times rho.
   pure real(dp) function opening_about_centre(rho, parameters) result(y)
      real(dp), intent(in) :: rho
      real(dp), intent(in) :: parameters(:)  !! (2): b/lambda, pbar/p*

      y = rho*penny_crack_opening_over_amplitude(rho, parameters(1), parameters(2))
   end function opening_about_centre

   !> Radius of an closed pool, (A7): b/lambda = (3 (1 - pbar/p*))^(1/2)/(2 pi); 0 from pbar = p* on.
   !>
   !> With this radius the faces close smoothly, dg/dr = 0 at r = b.
   elemental real(dp) function penny_crack_radius_over_wavelength(pbar_over_pstar) result(b)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      b = sqrt(3*max(0.0_dp, 1 - pbar_over_pstar))/(2*pi)
   end function penny_crack_radius_over_wavelength

   !> Fraction of the nominal area in contact, equation (24): 1 - 2 pi b^2/lambda^2
   !> = 1 - (3/(2 pi)) (1 - pbar/p*); 1 from pbar = p* on, 0.52 at pbar = 0.
   elemental real(dp) function penny_crack_contact_area_fraction(pbar_over_pstar) result(fraction)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      fraction = 1 - 3/(2*pi)*max(0.0_dp, 1 - pbar_over_pstar)
   end function penny_crack_contact_area_fraction

   !> Mean gap, equation (30) = (A9): (16/(15 pi^2)) (3/2)^(3/2) (1 - pbar/p*)^(5/2); 0 from pbar = p* on,
   !> 0.20 at pbar = 0.
   elemental real(dp) function penny_crack_mean_gap_over_amplitude(pbar_over_pstar) result(gap)
      real(dp), intent(in) :: pbar_over_pstar  !! mean pressure [p*]

      gap = 16/(15*pi**2)*1.5_dp**1.5_dp*max(0.0_dp, 1 - pbar_over_pstar)**2.5_dp
   end function penny_crack_mean_gap_over_amplitude

end module wavycon_penny_crack
