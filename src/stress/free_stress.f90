!> The stresses below a surface with free edges: those of the series of the pressure on a cell of twice the sides of the
!> map, zero beyond the map, less those of its images. Equations (S11), (S12) of README.md in this directory.
module wavycon_free_stress
   use wavycon_constants, only: pi
   use wavycon_elastic_body, only: elastic_body
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_tensor, only: combined, xx, xy, xz, yy, yz, zz
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: free_stress, start_free_stress

   !> Images up to this number of cells away are point forces, the others the integral of the first two terms of these.
   integer, parameter :: nearest = 2

   type, extends(stress_fields) :: free_stress
      private
      type(series_stress) :: series        !! of the cell, whose first point is at X = Y = 0
      real(dp) :: first(2) = 0.0_dp        !! X, Y of that point on the surface [rad]
      real(dp) :: centre(2) = 0.0_dp       !! of the load, X and Y side_ratio [rad]
      real(dp) :: cell(2) = 2*pi           !! sides, in these lengths
      real(dp) :: force = 0.0_dp           !! [p* rad^2]
      !> xx and yy of all images farther than `nearest`: at the surface, and per depth.
      real(dp) :: far(2, 2, 2) = 0.0_dp    !! (component, part, term)
      real(dp) :: images_error = 0.0_dp    !! [p*]
   contains
      procedure :: at
      procedure :: expand
      procedure :: near
      procedure :: on_line
      procedure :: on_plane
      procedure :: start_places
   end type free_stress

contains

   !> Prepares the stresses of a load whose pressures are known at the points of the map.
   subroutine start_free_stress(stress, surface, pressure, first, centre, spread, pbar_over_pstar, pressure_error)
      type(free_stress), intent(out) :: stress
      type(surface_type), intent(in) :: surface      !! of a map, 2-D, with free edges
      type(fourier_series), intent(in) :: pressure   !! p/p* on the cell, its first point at X = Y = 0
      real(dp), intent(in) :: first(2)               !! X, Y of that point on the surface [rad]
      real(dp), intent(in) :: centre(2)              !! of the load, X, Y [rad]
      real(dp), intent(in) :: spread                 !! root mean square distance of the load from it, in x [rad]
      real(dp), intent(in) :: pbar_over_pstar        !! mean over the map
      real(dp), intent(in) :: pressure_error         !! as of start_series_stress

      integer :: j
      integer, parameter :: directions = 20000
      real(dp) :: angle, edge, linear(2, 2), weight, zeroth(2, 2)

      call start_series_stress(stress%series, surface, pressure, pbar_over_pstar/4, pressure_error, is_sampled=.true.)
      stress%pbar_over_pstar = pbar_over_pstar/4
      stress%parts = surface%parts()
      stress%side_ratio = surface%length(2)/surface%length(1)
      stress%first = first
      stress%cell(2) = 2*pi*stress%side_ratio
      stress%centre = centre*[1.0_dp, stress%side_ratio]
      stress%force = stress%pbar_over_pstar*product(stress%cell)
      ! The integral of (S12) over all angles, from the border of the near cells on. Its first term has no limit but for
      ! circles, as the mean over all directions of the waves' lateral stress.
      do j = 1, directions
         angle = 2*pi*(j - 0.5_dp)/directions
         edge = (nearest + 0.5_dp)*min(stress%cell(1)/max(abs(cos(angle)), epsilon(angle)), &
                                       stress%cell(2)/max(abs(sin(angle)), epsilon(angle)))
         weight = stress%force/(2*pi)*2*pi/directions/product(stress%cell)
         zeroth(:, 1) = [cos(2*angle), -cos(2*angle)]
         zeroth(:, 2) = -2*zeroth(:, 1)
         linear(:, 1) = [sin(angle)**2 - 3*cos(angle)**2, cos(angle)**2 - 3*sin(angle)**2] - zeroth(:, 1)
         linear(:, 2) = -2*([sin(angle)**2, cos(angle)**2] - zeroth(:, 1))
         stress%far(:, :, 1) = stress%far(:, :, 1) - weight*log(edge)*zeroth
         stress%far(:, :, 2) = stress%far(:, :, 2) + weight/edge*linear
      end do
      stress%images_error = 6*stress%force/(2*pi*minval(stress%cell)**2)*(spread/minval(stress%cell))**2
   end subroutine start_free_stress

   !> What the mean pressure of the cell adds, (S11), less the stresses of the images (S12). The vertical stress of the
   !> mean pressure is that of `elastic_body`.
   pure function correction(self, x, y, depth) result(parts)
      class(free_stress), intent(in) :: self
      real(dp), intent(in) :: x, y, depth   !! [rad]
      real(dp) :: parts(6, 2)

      integer :: i, j

      parts = 0.0_dp
      parts([xx, yy], 1) = -0.5_dp*self%pbar_over_pstar
      parts([xx, yy], 2) = -self%pbar_over_pstar
      parts([xx, yy], :) = parts([xx, yy], :) - self%far(:, :, 1) - depth*self%far(:, :, 2)
      do j = -nearest, nearest
         do i = -nearest, nearest
            if (i == 0 .and. j == 0) cycle
            parts = parts - self%force*below_point([x, y*self%side_ratio] - self%centre - [i, j]*self%cell, depth)
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

   subroutine at(self, x, y, depth, parts, error)
      class(free_stress), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: parts(6, 2)
      real(dp), intent(out), optional :: error

      call self%series%at(x - self%first(1), y - self%first(2), depth, parts, error)
      parts = parts + correction(self, x, y, depth)
      if (present(error)) error = error + self%images_error
   end subroutine at

   subroutine expand(self, place, width, reach, noise)
      class(free_stress), intent(inout) :: self
      real(dp), intent(in) :: place(3), width, reach
      real(dp), intent(out) :: noise

      call self%series%expand(place - [self%first, 0.0_dp], width, reach, noise)
   end subroutine expand

   subroutine near(self, place, parts)
      class(free_stress), intent(inout) :: self
      real(dp), intent(in) :: place(3)
      real(dp), intent(out) :: parts(6, 2)

      call self%series%near(place - [self%first, 0.0_dp], parts)
      parts = parts + correction(self, place(1), place(2), place(3))
   end subroutine near

   subroutine on_line(self, start, direction, t, depth, parts, error)
      class(free_stress), intent(inout) :: self
      real(dp), intent(in) :: start(2), t(:), depth
      integer, intent(in) :: direction(2)
      real(dp), intent(out) :: parts(:, :, :), error(:)

      integer :: i

      call self%series%on_line(start - self%first, direction, t, depth, parts, error)
      do i = 1, size(t)
         parts(:, :, i) = parts(:, :, i) + correction(self, start(1) + direction(1)*t(i), start(2) + direction(2)*t(i), &
                                                      depth)
      end do
      error = error + self%images_error
   end subroutine on_line

   subroutine on_plane(self, points, offset, depth, body, stress, error)
      class(free_stress), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2), depth
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: stress(:, :, :), error(:, :)

      real(dp) :: place(2), step(2)
      integer :: k, l

      step = 2*pi/(self%parts*points)
      call self%series%on_plane(points, offset - self%first/step, depth, body, stress, error)
      do l = 1, points(2)
         do k = 1, points(1)
            place = ([k, l] - 1 + offset)*step
            stress(k, l, :) = stress(k, l, :) + combined(correction(self, place(1), place(2), depth), body%nu)
         end do
      end do
      error = error + self%images_error
   end subroutine on_plane

   !> Those of the series, whose stresses there lack the correction.
   subroutine start_places(self, body, places, widths, stresses)
      class(free_stress), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: places(:, :), widths(:), stresses(:, :)

      integer :: i

      call self%series%start_places(body, places, widths, stresses)
      do i = 1, size(places, 2)
         places(:2, i) = places(:2, i) + self%first
         stresses(:, i) = stresses(:, i) + combined(correction(self, places(1, i), places(2, i), places(3, i)), body%nu)
      end do
   end subroutine start_places

end module wavycon_free_stress
