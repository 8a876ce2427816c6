!> Hertz's contact of two bodies whose gap is a paraboloid, x^2/(2 R_x) + y^2/(2 R_y): K. L. Johnson, *Contact
!> mechanics*, Cambridge University Press (1985), eqs. (4.25), (4.26).
!>
!> With a >= b the half axes along the larger radius R and the smaller R', k = (1 - b^2/a^2)^(1/2), K and D = (K -
!> E)/k^2 complete elliptic integrals of modulus k:
!>
!>     R/R' = (K - D)/(D b^2/a^2),   p_0 = E* a^2/(2 R b D),   approach = a^2 K/(2 R D),   force = (2/3) pi a b p_0.
module wavycon_hertz_ball
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_constants, only: pi
   use wavycon_gsl, only: gsl_sf_ellint_Dcomp, gsl_sf_ellint_Kcomp
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: hertz_ball, hertz_contact, hertz_roller

   !> A contact, in any unit of length and of pressure.
   type :: hertz_ball
      real(dp) :: half_axis(2) = 0.0_dp      !! of the contact, along x and y [length]
      real(dp) :: force = 0.0_dp             !! [pressure length^2]
      real(dp) :: approach = 0.0_dp          !! [length]
      real(dp) :: peak_pressure = 0.0_dp     !! [pressure]
      !> With adhesion the force of a flat punch as large as the contact, which is taken off [pressure length^2].
      real(dp) :: tension = 0.0_dp
   contains
      procedure :: contact_area
      procedure :: perimeter
   end type hertz_ball

contains

   !> The contact under a force, at an approach, of an area or of a peak pressure, one of which is given, >= 0.
   !>
   !> Peak pressure and axes are proportional to each other, the approach goes with their square and the force with
   !> their cube.
   pure type(hertz_ball) function hertz_contact(radii, e_star, force, approach, area, peak_pressure) result(contact)
      real(dp), intent(in) :: radii(2)   !! along x and y [length], > 0; up to 1e8 times one another
      real(dp), intent(in) :: e_star     !! [pressure], > 0
      real(dp), intent(in), optional :: force, approach, area, peak_pressure

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

   !> Half width [length] and peak pressure [pressure] of a roller under a force a depth, Johnson (1985), eqs. (4.43),
   !> (4.45).
   pure function hertz_roller(radius, e_star, force) result(answer)
      real(dp), intent(in) :: radius   !! [length], > 0
      real(dp), intent(in) :: e_star   !! [pressure], > 0
      real(dp), intent(in) :: force    !! [pressure length], >= 0
      real(dp) :: answer(2)

      answer = [sqrt(4*force*radius/(pi*e_star)), sqrt(force*e_star/(pi*radius))]
   end function hertz_roller

   pure real(dp) function contact_area(self)
      class(hertz_ball), intent(in) :: self

      contact_area = pi*product(self%half_axis)
   end function contact_area

   !> 4 a E, the length of the ellipse, with E = K - k^2 D.
   pure real(dp) function perimeter(self)
      class(hertz_ball), intent(in) :: self

      real(dp) :: d, first_kind, ratio

      ratio = minval(self%half_axis)/maxval(self%half_axis)
      call integrals(ratio, first_kind, d)
      perimeter = 4*maxval(self%half_axis)*(first_kind - (1.0_dp - ratio**2)*d)
   end function perimeter

   !> The contact whose longer half axis is the larger radius.
   pure type(hertz_ball) function unit_contact(radii, e_star) result(contact)
      real(dp), intent(in) :: radii(2), e_star

      integer, parameter :: steps = 64
      real(dp) :: a, b, d, high, k, k1, low, middle
      integer :: step

      ! ln(b/a), by bisection: the ratio of the radii falls with it.
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
      contact%half_axis = merge([a, b], [b, a], radii(1) >= radii(2))
      contact%peak_pressure = e_star*a**2/(2*maxval(radii)*b*d)
      contact%approach = a**2*k1/(2*maxval(radii)*d)
      contact%force = 2*pi*a*b*contact%peak_pressure/3
   end function unit_contact

   !> K and D of the modulus of an ellipse.
   pure subroutine integrals(ratio, first_kind, d)
      real(dp), intent(in) :: ratio   !! b/a
      real(dp), intent(out) :: first_kind, d

      integer(c_int), parameter :: all_digits = 0
      real(dp) :: modulus

      modulus = sqrt((1.0_dp - ratio)*(1.0_dp + ratio))
      ! The integrals of modulus 1 are infinite.
      modulus = min(modulus, 1.0_dp - epsilon(modulus))
      first_kind = gsl_sf_ellint_Kcomp(modulus, all_digits)
      d = gsl_sf_ellint_Dcomp(modulus, all_digits)
   end subroutine integrals

end module wavycon_hertz_ball
