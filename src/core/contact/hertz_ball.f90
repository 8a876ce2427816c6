!> Hertz's contact of two bodies whose gap is a paraboloid, x^2/(2 R_x) + y^2/(2 R_y): K. L. Johnson, *Contact
!> mechanics*, Cambridge University Press (1985), eqs. (4.25), (4.26).
!>
!> Let a >= b be the half axes of the contact, a along the larger radius R and b along the smaller radius R'. K and E
!> are the complete elliptic integrals of modulus k = (1 - b^2/a^2)^(1/2), and D = (K - E)/k^2. Then
!>
!>     R/R' = (K - D)/(D b^2/a^2),   p_0 = E* a^2/(2 R b D),   approach = a^2 K/(2 R D),   force = (2/3) pi a b p_0.
module wavycon_hertz_ball
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_gsl, only: gsl_sf_ellint_RD, gsl_sf_ellint_RF
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: hertz_ball, hertz_contact, hertz_roller

   !> A contact, in any unit of length and of pressure.
   type :: hertz_ball
      real(dp) :: half_axis(2) = 0.0_dp      !! half axes of the contact along x and y [length]
      real(dp) :: force = 0.0_dp             !! [pressure length^2]
      real(dp) :: approach = 0.0_dp          !! [length]
      real(dp) :: peak_pressure = 0.0_dp     !! [pressure]
      !> With adhesion the tensile force of a flat punch of the contact's size, which is subtracted from Hertz's
      !> pressure [pressure length^2].
      real(dp) :: tension = 0.0_dp
   contains
      procedure :: contact_area, perimeter
   end type hertz_ball

contains

   !> The contact that has a given force, approach, area or peak pressure.
   !>
   !> The peak pressure is proportional to the half axes, the approach to their square and the force to their cube. So
   !> one contact, `unit_contact`, is multiplied by factors.
   pure type(hertz_ball) function hertz_contact(radii, e_star, force, approach, area, peak_pressure) result(contact)
      real(dp), intent(in) :: radii(2)   !! radii of curvature along x and y [length], > 0; their ratio is at most 1e8
      real(dp), intent(in) :: e_star     !! contact modulus E* [pressure], > 0
      real(dp), intent(in), optional :: force, approach, area, peak_pressure   !! exactly one of these is given, >= 0

      real(dp) :: factor

      contact = unit_contact(radii, e_star)
      factor = 1.0_dp
      if (present(force)) factor = (force/contact%force)**(1.0_dp/3)
      if (present(approach)) factor = sqrt(approach/contact%approach)
      if (present(area)) factor = sqrt(area/contact%contact_area())
      if (present(peak_pressure)) factor = peak_pressure/contact%peak_pressure
      contact = hertz_ball(factor*contact%half_axis, factor**3*contact%force, factor**2*contact%approach, &
                           factor*contact%peak_pressure)
   end function hertz_contact

   !> Half width and peak pressure of the contact of a cylinder, Johnson (1985), eqs. (4.43), (4.45).
   pure function hertz_roller(radius, e_star, force) result(answer)
      real(dp), intent(in) :: radius   !! radius of the cylinder [length], > 0
      real(dp), intent(in) :: e_star   !! contact modulus E* [pressure], > 0
      real(dp), intent(in) :: force    !! force for a unit of the cylinder's length [pressure length], >= 0
      real(dp) :: answer(2)            !! half width [length] and peak pressure [pressure]

      answer = [sqrt(4*force*radius/(pi*e_star)), sqrt(force*e_star/(pi*radius))]
   end function hertz_roller

   !> The area of the ellipse of contact [length^2].
   pure real(dp) function contact_area(self)
      class(hertz_ball), intent(in) :: self

      contact_area = pi*product(self%half_axis)
   end function contact_area

   !> The perimeter of the ellipse of contact [length], 4 a E with E = K - k^2 D.
   pure real(dp) function perimeter(self)
      class(hertz_ball), intent(in) :: self

      real(dp) :: d, first_kind, ratio

      ratio = minval(self%half_axis)/maxval(self%half_axis)
      call integrals(ratio, first_kind, d)
      perimeter = 4*maxval(self%half_axis)*(first_kind - (1.0_dp - ratio**2)*d)
   end function perimeter

   !> The contact whose longer half axis equals the larger radius. The axis ratio is found by bisection.
   pure type(hertz_ball) function unit_contact(radii, e_star) result(contact)
      real(dp), intent(in) :: radii(2), e_star

      integer, parameter :: steps = 64
      real(dp) :: a, b, d, high, k, k1, low, middle
      integer :: step

      ! The bracket of ln(b/a). The ratio of the radii falls as ln(b/a) grows.
      low = -1.5_dp*log(maxval(radii)/minval(radii)) - 1e-3_dp
      high = 0.0_dp
      do step = 1, steps
         middle = 0.5_dp*(low + high)
         call integrals(exp(middle), k1, d)
         if ((k1 - d)/(d*exp(2*middle)) > maxval(radii)/minval(radii)) then
            low = middle
         else
            high = middle
         end if
      end do
      if (abs(radii(1) - radii(2)) <= 0.0_dp) high = 0.0_dp
      k = exp(high)
      call integrals(k, k1, d)
      a = maxval(radii)
      b = k*a
      contact%half_axis = [a, b]
      if (radii(1) < radii(2)) contact%half_axis = [b, a]
      contact%peak_pressure = e_star*a**2/(2*maxval(radii)*b*d)
      contact%approach = a**2*k1/(2*maxval(radii)*d)
      contact%force = 2*pi*a*b*contact%peak_pressure/3
   end function unit_contact

   !> The elliptic integrals K and D that belong to an axis ratio, by Carlson's: the modulus of a slender ellipse, close
   !> to 1, would have lost the digits of the ratio.
   pure subroutine integrals(ratio, first_kind, d)
      real(dp), intent(in) :: ratio            !! b/a
      real(dp), intent(out) :: first_kind, d   !! K, D

      integer(c_int), parameter :: all_digits = 0

      first_kind = gsl_sf_ellint_RF(0.0_dp, ratio**2, 1.0_dp, all_digits)
      d = gsl_sf_ellint_RD(0.0_dp, ratio**2, 1.0_dp, all_digits)/3
   end subroutine integrals

end module wavycon_hertz_ball
