!> Stresses on the axis of a Hertzian contact, circular or along a line, and the largest shear of a circular one.
!>
!> K. L. Johnson, Contact Mechanics, Cambridge University Press (1985), sections 3.4 and 4.2. The pressure is
!> p0 (1 - r^2/a^2)^(1/2), in a line contact p0 (1 - x^2/a^2)^(1/2). Lengths are in a, stresses in p0, positive in
!> tension; z points into the solid. A stress has the components xx, yy, zz, xy, xz, yz, and is given in two parts:
!> for nu = 0, and the derivative with respect to Poisson's ratio nu.
module wavycon_hertz_stress
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: hertz_line_axis_stress, hertz_point_axis_stress, hertz_point_largest_shear

   !> Places of the components that are not zero.
   integer, parameter :: xx = 1, yy = 2, zz = 3

contains

   !> On the axis of a point contact, Johnson (3.45): s_zz = -1/(1 + z^2) and
   !> s_xx = s_yy = -(1 + nu) (1 - z arctan(1/z)) + 1/(2 (1 + z^2)). At depth the terms of the bracket cancel.
   pure subroutine hertz_point_axis_stress(z, parts)
      real(dp), intent(in) :: z             !! depth, >= 0 [a]; far down digits are lost
      real(dp), intent(out) :: parts(6, 2)  !! stress in two parts [p0]

      real(dp) :: lateral

      lateral = 1 - z*atan2(1.0_dp, z)
      parts = 0
      parts(xx:yy, 1) = 1/(2*(1 + z**2)) - lateral
      parts(zz, 1) = -1/(1 + z**2)
      parts(xx:yy, 2) = -lateral
   end subroutine hertz_point_axis_stress

   !> Largest shear on the axis of a point contact, (s_xx - s_zz)/2, and its depth; 0.31 p0 at 0.48 a for nu = 0.3.
   !>
   !> As s_xx = s_yy, the von Mises stress is twice as large and is largest at the same depth. The depth is where the
   !> slope of s_xx - s_zz is zero. That slope is positive on the surface, and falls and is convex down to the zero:
   !> Newton's method from the surface approaches it from one side.
   pure subroutine hertz_point_largest_shear(nu, shear, depth)
      real(dp), intent(in) :: nu      !! Poisson's ratio, -1 <= nu <= 1/2
      real(dp), intent(out) :: shear  !! [p0]
      real(dp), intent(out) :: depth  !! [a]

      real(dp) :: curvature, last, parts(6, 2), slope

      depth = 0
      do
         last = depth
         slope = (1 + nu)*(atan2(1.0_dp, depth) - depth/(1 + depth**2)) - 3*depth/(1 + depth**2)**2
         curvature = (12*depth**2/(1 + depth**2) - 5 - 2*nu)/(1 + depth**2)**2
         depth = depth - slope/curvature
         ! Rounding ends the approach from one side.
         if (.not. depth > last) exit
      end do
      depth = last
      call hertz_point_axis_stress(depth, parts)
      shear = (parts(xx, 1) - parts(zz, 1) + nu*parts(xx, 2))/2
   end subroutine hertz_point_largest_shear

   !> On the axis of a line contact along y in plane strain, Johnson (4.46).
   pure subroutine hertz_line_axis_stress(z, parts)
      real(dp), intent(in) :: z             !! depth, >= 0 [a]; far down digits are lost
      real(dp), intent(out) :: parts(6, 2)  !! stress in two parts [p0]

      parts = 0
      parts(xx, 1) = 2*z - (1 + 2*z**2)/sqrt(1 + z**2)
      parts(zz, 1) = -1/sqrt(1 + z**2)
      parts(yy, 2) = parts(xx, 1) + parts(zz, 1)
   end subroutine hertz_line_axis_stress

end module wavycon_hertz_stress
