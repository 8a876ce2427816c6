!> The factors between the units of the core and those of the user.
module wavycon_unit_scale
   use wavycon_kinds, only: dp, pi
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: unit_scale, scale_of

   !> In the core pressures are in units of p*, gaps and displacements in units of Delta, and positions are angles of
   !> the cell.
   type :: unit_scale
      real(dp) :: e_star = 1.0_dp              !! plane-strain modulus E* [pressure]
      real(dp) :: p_star = 0.0_dp              !! p*, mean pressure that just closes the gap [pressure]; 0 if it is flat
      real(dp) :: amplitude = 0.0_dp           !! Delta, mean gap before load [length]
      real(dp) :: sides(2) = 1.0_dp            !! sides of the cell, or of a mirrored map, along x and y [length]
      real(dp) :: nominal_area = 1.0_dp        !! product of these sides [length^2]; of a profile its length [length]
      real(dp) :: period(2) = 1.0_dp           !! sides L_x, L_y of the surface's cell [length]
      logical :: repeats = .true.              !! whether the cell is repeated: not with free edges
   contains
      procedure :: angles, depth_angle
   end type unit_scale

contains

   !> The factors for a surface on bodies with a given plane-strain modulus.
   pure type(unit_scale) function scale_of(surface, e_star) result(scale)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: e_star   !! > 0 [pressure]

      scale = unit_scale(e_star, surface%full_contact_pressure(e_star), surface%amplitude, surface%sides(), &
                         surface%nominal_area(), surface%length, .not. surface%has_free_edges)
   end function scale_of

   !> The angles X, Y of a position [rad]: those in the first cell, but with free edges also beyond.
   pure function angles(self, position)
      class(unit_scale), intent(in) :: self
      real(dp), intent(in) :: position(2)   !! x, y [length]
      real(dp) :: angles(2)

      angles = position/self%period
      if (self%repeats) angles = modulo(angles, 1.0_dp)
      angles = 2*pi*angles
   end function angles

   !> Depth as an angle, Z = 2 pi z/L_x [rad].
   pure real(dp) function depth_angle(self, depth)
      class(unit_scale), intent(in) :: self
      real(dp), intent(in) :: depth   !! depth z below the surface [length]

      depth_angle = 2*pi*depth/self%period(1)
   end function depth_angle

end module wavycon_unit_scale
