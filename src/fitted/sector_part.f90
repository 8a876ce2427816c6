!> Coordinates of the part of a sector between two directions of the exterior map: t from -1 to 1 with the angle of v, s
!> from 0 at the edge to 1 at the border, which is a straight line.
module wavycon_sector_part
   use wavycon_exterior_map, only: linearise_exterior
   use wavycon_fitted_tuning, only: table_bend
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: sector_part, s_at, radius_at

   type :: sector_part
      complex(dp) :: from = 0.0_dp, to = 0.0_dp     !! ends of the border, anticlockwise [s]
      real(dp) :: first = 0.0_dp, last = 0.0_dp     !! the directions [rad]
   contains
      procedure :: direction
      procedure :: t_of
      procedure :: find_border
   end type sector_part

contains

   !> e^(i angle) at t between -1 and 1.
   pure complex(dp) function direction(self, t)
      class(sector_part), intent(in) :: self
      real(dp), intent(in) :: t                    !! -1 to 1

      direction = exp(cmplx(0.0_dp, 0.5_dp*(self%first + self%last + (self%last - self%first)*t), dp))
   end function direction

   !> The inverse for any v between the directions.
   pure real(dp) function t_of(self, v) result(t)
      class(sector_part), intent(in) :: self
      complex(dp), intent(in) :: v

      t = (2*atan2(v%im, v%re) - self%first - self%last)/(self%last - self%first)
   end function t_of

   !> |v| at which a ray of the exterior map meets the border's line, by Newton's method.
   pure subroutine find_border(self, shape, direction, radius, found)
      class(sector_part), intent(in) :: self
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: direction         !! of modulus 1
      real(dp), intent(out) :: radius
      logical, intent(out) :: found                !! false if there is none, or it is on the edge

      !> Safety limit: most steps.
      integer, parameter :: most_steps = 50
      !> Relative step that rounding leaves; distance from the edge below which there is no room for a table.
      real(dp), parameter :: rounding = 1e-13_dp, least_distance = 1e-6_dp
      complex(dp) :: conjugate_slope, normal, slope, z
      real(dp) :: step
      integer :: i

      normal = (0.0_dp, -1.0_dp)*(self%to - self%from)/abs(self%to - self%from)
      radius = 2*max(abs(self%from), abs(self%to))/shape%b(0)
      found = .false.
      do i = 1, most_steps
         call linearise_exterior(shape, radius*direction, z, slope, conjugate_slope)
         slope = slope*direction + conjugate_slope*conjg(direction)
         z = self%from - z
         step = (z%re*normal%re + z%im*normal%im)/(slope%re*normal%re + slope%im*normal%im)
         radius = max(radius + step, 1.0_dp)
         found = abs(step) <= rounding*radius
         if (found) exit
      end do
      found = found .and. radius > 1.0_dp + least_distance
   end subroutine find_border

   !> s of a place at |v| = radius where the border is at |v| = border: README.md (F49). It is 0 at the edge and 1 at
   !> the border, and the singularities of the field inside of the edge and beyond the border are about equally far off.
   pure real(dp) function s_at(radius, border) result(s)
      real(dp), intent(in) :: radius, border       !! > 1

      s = (radius - 1.0_dp)*(1.0_dp + table_bend)*border/((radius + table_bend*border)*(border - 1.0_dp))
   end function s_at

   !> Its inverse.
   pure real(dp) function radius_at(s, border) result(radius)
      real(dp), intent(in) :: s                    !! 0 to 1
      real(dp), intent(in) :: border

      associate (ratio => s*(border - 1.0_dp)/((1.0_dp + table_bend)*border))
         radius = (1.0_dp + table_bend*border*ratio)/(1.0_dp - ratio)
      end associate
   end function radius_at

end module wavycon_sector_part
