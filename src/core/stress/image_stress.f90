!> What the stresses below a surface with free edges lack, if the pressure of a cell of twice the sides of the map, zero
!> beyond the map, is repeated: equations (S11), (S12) of README.md in this directory.
module wavycon_image_stress
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_stress_tensor, only: xx, xy, xz, yy, yz, zz
   implicit none (type, external)
   private

   public :: image_stress, images_of

   !> Images up to this number of cells away are point forces, the others the integral of the first two terms of these.
   integer, parameter :: nearest = 2

   type :: image_stress
      private
      real(dp) :: pbar = 0.0_dp            !! mean over the cell [p*]
      real(dp) :: force = 0.0_dp           !! [p* rad^2]
      real(dp) :: side_ratio = 1.0_dp      !! L_y/L_x
      real(dp) :: centre(2) = 0.0_dp       !! of the load, X and Y side_ratio [rad]
      real(dp) :: cell(2) = 2*pi           !! sides, in these lengths
      !> xx and yy of all images farther than `nearest`: at the surface, and per depth.
      real(dp) :: far(2, 2, 2) = 0.0_dp    !! (component, part, term)
      real(dp), public :: error = 0.0_dp   !! of the stresses [p*]
   contains
      procedure :: correction
   end type image_stress

contains

   !> The images of a load.
   pure type(image_stress) function images_of(pbar, side_ratio, centre, spread) result(images)
      real(dp), intent(in) :: pbar         !! mean pressure over the cell [p*]
      real(dp), intent(in) :: side_ratio   !! L_y/L_x
      real(dp), intent(in) :: centre(2)    !! of the load, X, Y [rad]
      real(dp), intent(in) :: spread       !! root mean square distance of the load from it, in x [rad]

      real(dp) :: angle, border(2), inverse, squared, linear(2)

      images%pbar = pbar
      images%side_ratio = side_ratio
      images%centre = centre*[1.0_dp, side_ratio]
      images%cell(2) = 2*pi*side_ratio
      images%force = pbar*product(images%cell)
      ! The integral of (S12) over all angles, from the border of the near cells on. Its first term has no limit but for
      ! circles, as the mean over all directions of the waves' lateral stress; with that the integral of cos(2 theta)
      ! times the logarithm of the border's distance is pi - 4 angle. `inverse` and `squared` are those of 1 and of
      ! cos^2(theta) over the distance.
      border = (nearest + 0.5_dp)*images%cell
      angle = atan2(border(2), border(1))
      inverse = 4*(sin(angle)/border(1) + cos(angle)/border(2))
      squared = 4*((sin(angle) - sin(angle)**3/3)/border(1) + cos(angle)**3/(3*border(2)))
      linear = [2*inverse - 6*squared, 6*squared - 4*inverse]
      images%far(:, 1, 1) = (4*angle - pi)*[1, -1]
      images%far(:, 2, 1) = -2*images%far(:, 1, 1)
      images%far(:, 1, 2) = linear
      images%far(:, 2, 2) = linear([2, 1])
      images%far = pbar/(2*pi)*images%far
      images%error = 6*images%force/(2*pi*minval(images%cell)**2)*(spread/minval(images%cell))**2
   end function images_of

   !> What the mean pressure of the cell adds, (S11), less the stresses of the images (S12). The vertical stress of the
   !> mean pressure is that of `elastic_body`.
   pure function correction(self, place) result(parts)
      class(image_stress), intent(in) :: self
      real(dp), intent(in) :: place(3)   !! X, Y, Z [rad]
      real(dp) :: parts(6, 2)

      real(dp) :: from_centre(2)
      integer :: i, j

      parts = 0.0_dp
      parts([xx, yy], 1) = -0.5_dp*self%pbar
      parts([xx, yy], 2) = -self%pbar
      parts([xx, yy], :) = parts([xx, yy], :) - self%far(:, :, 1) - place(3)*self%far(:, :, 2)
      from_centre = place(:2)*[1.0_dp, self%side_ratio] - self%centre
      do j = -nearest, nearest
         do i = -nearest, nearest
            if (i == 0 .and. j == 0) cycle
            parts = parts - self%force*below_point(from_centre - [i, j]*self%cell, place(3))
         end do
      end do
   end function correction

   !> Boussinesq's stresses of a unit point force, Johnson (1985), eqs. (3.18).
   pure function below_point(place, z) result(parts)
      real(dp), intent(in) :: place(2)   !! x, y from the force, not both zero
      real(dp), intent(in) :: z          !! depth
      real(dp) :: parts(6, 2)

      real(dp) :: bracket(4), r2, rho

      associate (x => place(1), y => place(2))
         r2 = x**2 + y**2
         rho = sqrt(r2 + z**2)
         bracket = [((1 - z/rho)*(x**2 - y**2)/r2 + z*y**2/rho**3)/r2, &
                    ((1 - z/rho)*(y**2 - x**2)/r2 + z*x**2/rho**3)/r2, 0.0_dp, &
                    ((1 - z/rho)*2*x*y/r2 - z*x*y/rho**3)/r2]
         parts = 0.0_dp
         parts([xx, yy, zz, xy], 1) = bracket - 3*z*[x**2, y**2, z**2, x*y]/rho**5
         parts([xz, yz], 1) = -3*z**2*place/rho**5
         parts([xx, yy, zz, xy], 2) = -2*bracket
         parts = parts/(2*pi)
      end associate
   end function below_point

end module wavycon_image_stress
