!> Stresses in a half-space below point sources on its surface, as eight fields that do not depend on Poisson's ratio.
!>
!> The pressure p acts on z = 0, and z points into the solid. Let H be the harmonic function that is p on the surface
!> and vanishes at depth, V and L its integrals, H = -dV/dz, V = -dL/dz, H_z = dH/dz, and D = d/dx + i d/dy. Then, by
!> (F51) of src/core/fitted/README.md, which has all formulas (F..),
!>
!>     sigma_zz = -H + z H_z,        sigma_xx + sigma_yy = -(1 + 2 nu) H - z H_z,
!>     sigma_xx - sigma_yy + 2 i sigma_xy = (1 - 2 nu) D^2 L - z D^2 V,        sigma_xz + i sigma_yz = z D H.
!>
!> At the distance R from a point force V = 1/(2 pi R): Boussinesq's solution.
module wavycon_stress_kernel
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: add_sources, nu_terms_of

   !> The number of fields, and the position of each one: H, z H_z, then the real and the imaginary part of D^2 L, of
   !> z D^2 V and of z D H.
   integer, parameter, public :: stress_field_count = 8
   integer, parameter, public :: h_field = 1, hz_field = 2, l_field = 3, v_field = 5, dh_field = 7

   !> The kinds of sources: a pressure; a gap; a gap that is given by its gradient.
   integer, parameter, public :: of_pressure = 1, of_gap = 2, of_gradient = 3

   !> The fields that are computed. `all_fields`: the eight fields. `surface_field`: one field, on the surface z = 0
   !> away from the sources; of a pressure this is the displacement [Delta], of a gap the pressure.
   integer, parameter, public :: all_fields = 1, surface_field = 2

contains

   !> Adds to `fields` those at one point of n point forces, or of the pressure that belongs to a gap at n points: a
   !> wave g_k of the gap has the pressure |k| g_k.
   !>
   !> N.B. If the point is on the surface, z = 0, no source may be at the same position.
   pure subroutine add_sources(kernel, source, n, x, y, z, strength_x, strength_y, fields)
      integer, intent(in) :: kernel                           !! all_fields or surface_field
      integer, intent(in) :: source                           !! of_pressure, of_gap or, for all fields, of_gradient
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                      !! the point less the position of each source [s]
      real(dp), intent(in) :: z                               !! depth of the point, >= 0 [s]
      !> Strengths of the sources. A pressure or a gap: strength_x is its value times the source's area, and strength_y
      !> is not used. A gradient: strength_x and strength_y are its components times the area.
      real(dp), intent(in) :: strength_x(n), strength_y(n)
      real(dp), intent(inout) :: fields(stress_field_count)   !! for surface_field only the first one is changed

      real(dp), dimension(n) :: inverse, r
      real(dp) :: along, cross, difference, fifth, im, l, of_dh, re, seventh, third, total(stress_field_count)
      integer :: i

      ! Roots and quotients are taken of whole arrays, because compilers vectorise them so.
      total = 0.0_dp
      if (kernel == surface_field .and. source == of_pressure) then
         total(1) = sum(strength_x/sqrt(x**2 + y**2))
      else if (kernel == surface_field) then
         total(1) = -sum(strength_x/sqrt(x**2 + y**2)**3)/(4*pi**2)
      else if (source == of_pressure) then
         ! (F52).
         r = sqrt(x**2 + y**2 + z**2)
         inverse = 1.0_dp/(r*(r + z))
         do i = 1, n
            associate (inverse_r => (r(i) + z)*inverse(i))
               third = strength_x(i)*inverse_r**3
               fifth = third*inverse_r**2
               l = strength_x(i)*(2*r(i) + z)*inverse(i)**2*inverse_r
            end associate
            re = (x(i) - y(i))*(x(i) + y(i))
            im = 2*x(i)*y(i)
            total = total + [third, third - 3*z**2*fifth, l*re, l*im, fifth*re, fifth*im, fifth*x(i), fifth*y(i)]
         end do
         total = total*[z, z, 1.0_dp, 1.0_dp, 3*z, 3*z, -3*z**2, -3*z**2]/(2*pi)
      else if (source == of_gap) then
         ! (F56).
         inverse = 1.0_dp/sqrt(x**2 + y**2 + z**2)
         do i = 1, n
            fifth = strength_x(i)*inverse(i)**5
            seventh = fifth*inverse(i)**2
            re = (x(i) - y(i))*(x(i) + y(i))
            im = 2*x(i)*y(i)
            of_dh = 3*fifth - 15*z**2*seventh
            total = total + [fifth*(2*z**2 - x(i)**2 - y(i)**2), 9*fifth - 15*z**2*seventh, fifth*re, fifth*im, &
                             seventh*re, seventh*im, of_dh*x(i), of_dh*y(i)]
         end do
         total = total*[1.0_dp, z**2, 3.0_dp, 3.0_dp, 15*z**2, 15*z**2, z, z]/(4*pi**2)
      else
         ! (F53).
         inverse = 1.0_dp/sqrt(x**2 + y**2 + z**2)
         do i = 1, n
            third = inverse(i)**3
            fifth = third*inverse(i)**2
            along = x(i)*strength_x(i) + y(i)*strength_y(i)
            difference = x(i)*strength_x(i) - y(i)*strength_y(i)
            cross = x(i)*strength_y(i) + y(i)*strength_x(i)
            of_dh = third - 3*z**2*fifth
            total = total + [along*third, along*fifth, difference*third, cross*third, difference*fifth, cross*fifth, &
                             strength_x(i)*of_dh, strength_y(i)*of_dh]
         end do
         total = total*[1.0_dp, -3*z**2, -1.0_dp, -1.0_dp, -3*z**2, -3*z**2, -z, -z]/(4*pi**2)
      end if
      fields = fields + total
   end subroutine add_sources

   !> The stresses from the fields, (F51). For Poisson's ratio nu they are nu_terms(:, 1) + nu*nu_terms(:, 2).
   pure function nu_terms_of(fields) result(nu_terms)
      real(dp), intent(in) :: fields(stress_field_count)   !! in the order of the names above
      real(dp) :: nu_terms(6, 2)                           !! xx, yy, zz, xy, xz, yz, in the unit of the fields

      associate (h => fields(1), zhz => fields(2), l => fields(3:4), v => fields(5:6), dh => fields(7:8))
         nu_terms(1, :) = [0.5_dp*(-h - zhz + l(1) - v(1)), -h - l(1)]
         nu_terms(2, :) = [0.5_dp*(-h - zhz - l(1) + v(1)), -h + l(1)]
         nu_terms(3, :) = [-h + zhz, 0.0_dp]
         nu_terms(4, :) = [0.5_dp*(l(2) - v(2)), -l(2)]
         nu_terms(5, :) = [dh(1), 0.0_dp]
         nu_terms(6, :) = [dh(2), 0.0_dp]
      end associate
   end function nu_terms_of

end module wavycon_stress_kernel
