!> The points of a grid.
!>
!> Those of an even field, f(-X, Y) = f(X, -Y) = f(X, Y), lie in a quarter of its cell: M x N points at
!> X = pi (i - 1/2)/M, Y = pi (j - 1/2)/N. Those of any other field lie in its whole cell: X = 2 pi (i - 1)/M,
!> Y = 2 pi (j - 1)/N. N = 1 for a field in one dimension.
module wavycon_grid_points
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: image_of_point, point_angle

contains

   !> The angle of a point of the grid, or of its continuation, in one direction [rad].
   elemental real(dp) function point_angle(i, points, even)
      integer, intent(in) :: i         !! any
      integer, intent(in) :: points    !! M or N, >= 1
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell

      point_angle = merge(pi*(i - 0.5_dp), 2*pi*(i - 1), even)/points
   end function point_angle

   !> The index of the grid's point of which a point of its continuation is the image: by mirrors at the borders of a
   !> quarter, periodically beyond those of a whole cell.
   elemental integer function image_of_point(i, points, even) result(image)
      integer, intent(in) :: i         !! any
      integer, intent(in) :: points    !! M or N, >= 1
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell

      image = i
      if (i >= 1 .and. i <= points) return
      if (even) then
         image = modulo(i - 1, 2*points)
         image = min(image, 2*points - 1 - image) + 1
      else
         image = modulo(i - 1, points) + 1
      end if
   end function image_of_point

end module wavycon_grid_points
