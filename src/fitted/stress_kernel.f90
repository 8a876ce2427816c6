!> Stresses in a half-space below point sources on its surface, as eight fields that do not depend on Poisson's ratio.
!>
!> The pressure p acts on z = 0, z into the solid. Let H be the harmonic function that is p on the surface and vanishes
!> at depth, V and L its integrals, H = -dV/dz, V = -dL/dz, and D = d/dx + i d/dy. Then (F51)
!>
!>     s_zz = -H + z H_z,                        s_xx + s_yy = -(1 + 2 nu) H - z H_z,
!>     s_xx - s_yy + 2 i s_xy = (1 - 2 nu) D^2 L - z D^2 V,        s_xz + i s_yz = z D H.
!>
!> A point force has V = 1/(2 pi R): Boussinesq's solution.
module wavycon_stress_kernel
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: add_gap, add_sources, stress_parts

   !> Number of fields, and their order: H, z H_z, then real and imaginary parts of D^2 L, z D^2 V and z D H.
   integer, parameter, public :: stress_fields = 8
   integer, parameter, public :: h_field = 1, hz_field = 2, l_field = 3, v_field = 5, dh_field = 7

   !> What sources are summed for: all these fields, or on the surface, outside of the sources, the displacement by a
   !> pressure [Delta] or the pressure by a gap.
   integer, parameter, public :: all_fields = 1, surface_field = 2

   !> Sources that are evaluated at a time: their kernels stay in the first cache.
   integer, parameter :: block = 128

contains

   !> Adds the fields of n point forces or of the pressure by a gap at n points.
   !>
   !> N.B. On the surface, z = 0, no source may be at the place.
   pure subroutine add_sources(kernel, gap, n, x, y, z, strength_x, strength_y, fields)
      integer, intent(in) :: kernel                           !! all_fields or surface_field
      logical, intent(in) :: gap                              !! whether they are of a pool
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                      !! the place as seen from the sources [s]
      real(dp), intent(in) :: z                               !! depth >= 0 [s]
      real(dp), intent(in) :: strength_x(n), strength_y(n)
         !! times area: a spot's pressure, or a pool's gap for surface_field, and 0; the gap's gradient for
         !! all_fields
      real(dp), intent(inout) :: fields(stress_fields)        !! of surface_field the first one

      if (kernel == all_fields .and. gap) then
         call add_gap_gradient(n, x, y, z, strength_x, strength_y, fields)
      else if (kernel == all_fields) then
         call add_pressure(n, x, y, z, strength_x, fields)
      else if (gap) then
         fields(1) = fields(1) - sum(strength_x/sqrt(x**2 + y**2)**3)/(4*pi**2)
      else
         fields(1) = fields(1) + sum(strength_x/sqrt(x**2 + y**2))
      end if
   end subroutine add_sources

   !> Adds the fields of n point forces at one place, README.md (F52).
   !>
   !> N.B. As of add_sources.
   pure subroutine add_pressure(n, x, y, z, force, fields)
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)           !! the place as seen from the sources [s]
      real(dp), intent(in) :: z                    !! depth >= 0 [s]
      real(dp), intent(in) :: force(n)             !! pressure times area
      real(dp), intent(inout) :: fields(stress_fields)

      real(dp), dimension(block) :: h, inverse_square, l, rim, rre
      real(dp) :: inverse, inverse_r, r, r2, total(stress_fields)
      integer :: first, i, last

      total = 0.0_dp
      do first = 1, n, block
         last = min(block, n - first + 1)
         do i = 1, last
            rre(i) = (x(first + i - 1) - y(first + i - 1))*(x(first + i - 1) + y(first + i - 1))
            rim(i) = 2*x(first + i - 1)*y(first + i - 1)
            r2 = x(first + i - 1)**2 + y(first + i - 1)**2 + z**2
            r = sqrt(r2)
            inverse = 1.0_dp/(r*(r + z))
            inverse_r = (r + z)*inverse
            inverse_square(i) = inverse_r**2
            h(i) = force(first + i - 1)*inverse_r*inverse_square(i)
            l(i) = force(first + i - 1)*(2*r + z)*inverse**2*inverse_r
         end do
         do i = 1, last
            total(1) = total(1) + h(i)
            total(2) = total(2) + h(i)*(1.0_dp - 3*z**2*inverse_square(i))
            total(3) = total(3) + l(i)*rre(i)
            total(4) = total(4) + l(i)*rim(i)
            h(i) = h(i)*inverse_square(i)
            total(5) = total(5) + h(i)*rre(i)
            total(6) = total(6) + h(i)*rim(i)
            total(7) = total(7) + h(i)*x(first + i - 1)
            total(8) = total(8) + h(i)*y(first + i - 1)
         end do
      end do
      total(1:2) = z*total(1:2)
      total(5:6) = 3*z*total(5:6)
      total(7:8) = -3*z**2*total(7:8)
      fields = fields + total/(2*pi)
   end subroutine add_pressure

   !> Adds the fields of the pressure |k| g_k of a gap g, by its gradient at n points: README.md (F53).
   !>
   !> N.B. As of add_sources.
   pure subroutine add_gap_gradient(n, x, y, z, gradient_x, gradient_y, fields)
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                      !! the place as seen from the sources [s]
      real(dp), intent(in) :: z                               !! depth >= 0 [s]
      real(dp), intent(in) :: gradient_x(n), gradient_y(n)    !! gradient of g times area [Delta s]
      real(dp), intent(inout) :: fields(stress_fields)

      real(dp), dimension(block) :: inverse_square, inverse_cube, im, re
      real(dp) :: inverse, total(stress_fields)
      integer :: first, i, last

      total = 0.0_dp
      do first = 1, n, block
         last = min(block, n - first + 1)
         do i = 1, last
            inverse = 1.0_dp/sqrt(x(first + i - 1)**2 + y(first + i - 1)**2 + z**2)
            inverse_square(i) = inverse**2
            inverse_cube(i) = inverse*inverse_square(i)
            re(i) = x(first + i - 1)*gradient_x(first + i - 1)
            im(i) = y(first + i - 1)*gradient_y(first + i - 1)
         end do
         do i = 1, last
            associate (gx => gradient_x(first + i - 1), gy => gradient_y(first + i - 1), &
                       fifth => inverse_cube(i)*inverse_square(i), &
                       cross => x(first + i - 1)*gradient_y(first + i - 1) + y(first + i - 1)*gradient_x(first + i - 1))
               total(1) = total(1) + (re(i) + im(i))*inverse_cube(i)
               total(2) = total(2) + (re(i) + im(i))*fifth
               total(3) = total(3) + (re(i) - im(i))*inverse_cube(i)
               total(4) = total(4) + cross*inverse_cube(i)
               total(5) = total(5) + (re(i) - im(i))*fifth
               total(6) = total(6) + cross*fifth
               total(7) = total(7) + gx*inverse_cube(i)*(1.0_dp - 3*z**2*inverse_square(i))
               total(8) = total(8) + gy*inverse_cube(i)*(1.0_dp - 3*z**2*inverse_square(i))
            end associate
         end do
      end do
      total(2) = -3*z**2*total(2)
      total(3:4) = -total(3:4)
      total(5:6) = -3*z**2*total(5:6)
      total(7:8) = -z*total(7:8)
      fields = fields + total/(4*pi**2)
   end subroutine add_gap_gradient

   !> Adds the fields of the pressure |k| g_k of a gap g at n points, README.md (F56).
   pure subroutine add_gap(n, x, y, z, gap, fields)
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)           !! the place as seen from the sources [s]
      real(dp), intent(in) :: z                    !! depth > 0 [s]
      real(dp), intent(in) :: gap(n)               !! g times area [Delta s^2]
      real(dp), intent(inout) :: fields(stress_fields)

      real(dp), dimension(block) :: fifth, inverse_square
      real(dp) :: inverse, total(stress_fields)
      integer :: first, i, last

      total = 0.0_dp
      do first = 1, n, block
         last = min(block, n - first + 1)
         do i = 1, last
            inverse = 1.0_dp/sqrt(x(first + i - 1)**2 + y(first + i - 1)**2 + z**2)
            inverse_square(i) = inverse**2
            fifth(i) = gap(first + i - 1)*inverse*inverse_square(i)**2
         end do
         do i = 1, last
            associate (dx => x(first + i - 1), dy => y(first + i - 1), seventh => fifth(i)*inverse_square(i))
               total(1) = total(1) + fifth(i)*(2*z**2 - dx**2 - dy**2)
               total(2) = total(2) + fifth(i)*(9.0_dp - 15*z**2*inverse_square(i))
               total(3) = total(3) + fifth(i)*(dx - dy)*(dx + dy)
               total(4) = total(4) + fifth(i)*2*dx*dy
               total(5) = total(5) + seventh*(dx - dy)*(dx + dy)
               total(6) = total(6) + seventh*2*dx*dy
               total(7) = total(7) + fifth(i)*(3.0_dp - 15*z**2*inverse_square(i))*dx
               total(8) = total(8) + fifth(i)*(3.0_dp - 15*z**2*inverse_square(i))*dy
            end associate
         end do
      end do
      total(2) = z**2*total(2)
      total(3:4) = 3*total(3:4)
      total(5:6) = 15*z**2*total(5:6)
      total(7:8) = z*total(7:8)
      fields = fields + total/(4*pi**2)
   end subroutine add_gap

   !> The stresses from the fields, README.md (F51), as parts(:, 1) + nu parts(:, 2).
   pure subroutine stress_parts(fields, parts)
      real(dp), intent(in) :: fields(stress_fields)
      real(dp), intent(out) :: parts(6, 2)            !! xx, yy, zz, xy, xz, yz

      associate (h => fields(1), zhz => fields(2), l => fields(3:4), v => fields(5:6), dh => fields(7:8))
         parts(1, :) = [0.5_dp*(-h - zhz + l(1) - v(1)), -h - l(1)]
         parts(2, :) = [0.5_dp*(-h - zhz - l(1) + v(1)), -h + l(1)]
         parts(3, :) = [-h + zhz, 0.0_dp]
         parts(4, :) = [0.5_dp*(l(2) - v(2)), -l(2)]
         parts(5, :) = [dh(1), 0.0_dp]
         parts(6, :) = [dh(2), 0.0_dp]
      end associate
   end subroutine stress_parts

end module wavycon_stress_kernel
