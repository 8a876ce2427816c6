!> The factors that convert the core's pressures, lengths and angles to the user's units.
module wavycon_unit_scale
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: unit_scale, scale_of

   !> Pressures of the core are in p_star, gaps and displacements in amplitude, places in angles of the cell.
   type :: unit_scale
      real(dp) :: e_star = 1.0_dp              !! plane-strain modulus E* [pressure]
      real(dp) :: p_star = 0.0_dp              !! p*, mean pressure that just closes the gap [pressure]; 0: flat
      real(dp) :: amplitude = 0.0_dp           !! Delta, mean gap before load [length]
      real(dp) :: sides(2) = 1.0_dp            !! of the surface, or of a mirrored map, along x and y [length]
      real(dp) :: nominal_area = 1.0_dp        !! of the sides [length^2]; of a profile [length]
      real(dp) :: period(2) = 1.0_dp           !! L_x, L_y after which the surface repeats itself [length]
   contains
      procedure :: angles
      procedure :: depth_angle
   end type unit_scale

contains

   !> The scale of a surface under a plane-strain modulus.
   pure type(unit_scale) function scale_of(surface, e_star) result(scale)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: e_star   !! > 0 [pressure]

      scale = unit_scale(e_star, surface%full_contact_pressure(e_star), surface%amplitude, surface%sides(), &
                         surface%nominal_area(), surface%length)
   end function scale_of

   !> X, Y of a place, in the cell [rad].
   pure function angles(self, place)
      class(unit_scale), intent(in) :: self
      real(dp), intent(in) :: place(2)   !! x, y [length]
      real(dp) :: angles(2)

      angles = 2*pi*modulo(place/self%period, 1.0_dp)
   end function angles

   !> Z of a depth [rad].
   pure real(dp) function depth_angle(self, depth)
      class(unit_scale), intent(in) :: self
      real(dp), intent(in) :: depth   !! [length]

      depth_angle = 2*pi*depth/self%period(1)
   end function depth_angle

end module wavycon_unit_scale
