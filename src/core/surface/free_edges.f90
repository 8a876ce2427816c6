!> Surfaces with free edges, which are not continued beyond their borders: their units, and the ball below a map. The
!> ball is a paraboloid, the shape of a sphere near its lowest point.
module wavycon_free_edges
   use wavycon_kinds, only: dp, pi
   use wavycon_paraboloid, only: paraboloid
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: ball_radii, form_of_radii, is_ball, set_units_without_closure, surface_of_ball

contains

   !> Makes the surface of a smooth ball: a paraboloid with free edges, whose lowest point is the middle of a rectangle.
   type(surface_type) function surface_of_ball(sides, radii) result(surface)
      real(dp), intent(in) :: sides(2)       !! sides of the rectangle along x and y [length], > 0
      real(dp), intent(in) :: radii(2)       !! radii of curvature along x and y [length], > 0

      surface%mirrored = .true.
      surface%has_free_edges = .true.
      surface%length = surface%maps_in_cell()*sides
      allocate (surface%shape%c(0:0, 0:0), source=0.0_dp)
      surface%form = form_of_radii(surface, radii)
      surface%amplitude = sum(surface%form%c)*pi**2/12
      surface%form%c = surface%form%c/surface%amplitude
      surface%crest = 0.5_dp*pi
      call set_units_without_closure(surface)
   end function surface_of_ball

   !> Whether the surface is a paraboloid without roughness.
   pure logical function is_ball(surface)
      type(surface_type), intent(in) :: surface

      is_ball = surface%has_free_edges .and. surface%dimension == 2 .and. all(surface%form%c > 0.0_dp)
      ! The surface is even, as it has free edges. Only an even series has the array c.
      if (is_ball) is_ball = all(abs(surface%shape%c) <= 0.0_dp)
   end function is_ball

   !> The paraboloid of given radii, in angles of the cell: x^2/(2 R) = c X^2 with c = (L/(2 pi))^2/(2 R) [length].
   pure type(paraboloid) function form_of_radii(surface, radii) result(form)
      type(surface_type), intent(in) :: surface   !! its dimension and sides are set
      real(dp), intent(in) :: radii(2)            !! radii along x and y [length], > 0; huge: no curvature

      where (radii < huge(radii)) form%c = 0.5_dp*(surface%length/(2*pi))**2/radii
      if (surface%dimension == 1) form%c(2) = 0.0_dp
   end function form_of_radii

   !> The radii of the surface's paraboloid along x and y [length]; huge where it has no curvature.
   pure function ball_radii(surface) result(radii)
      type(surface_type), intent(in) :: surface
      real(dp) :: radii(2)

      radii = huge(radii)
      where (surface%form%c > 0.0_dp) radii = 0.5_dp*(surface%length/(2*pi))**2/(surface%amplitude*surface%form%c)
   end function ball_radii

   !> Sets the components of a surface with free edges that belong to full contact, which it does not have: the unit of
   !> pressure by `stiffness`, and an infinite peak. Adds the curvature of the paraboloid to that of the crest.
   pure subroutine set_units_without_closure(surface)
      type(surface_type), intent(inout) :: surface

      surface%stiffness = surface%nominal_area()**(1.0_dp/surface%dimension)
      surface%full_contact_peak = huge(1.0_dp)
      surface%crest_curvature = surface%crest_curvature + 2*sum(surface%form%c/surface%length**2)
   end subroutine set_units_without_closure

end module wavycon_free_edges
