!> The points of a grid and their continuation beyond its borders.
!>
!> The points of an even field, f(-X, Y) = f(X, -Y) = f(X, Y), lie in a quarter of its cell: M x N points at
!> X = pi (i - 1/2)/M, Y = pi (j - 1/2)/N. The points of any other field lie in its whole cell: X = 2 pi (i - 1)/M,
!> Y = 2 pi (j - 1)/N. N = 1 for a field in one dimension.
module wavycon_grid_points
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: image_of_point, point_angle

contains

   !> The angle X or Y [rad] of a point of the grid or of its continuation.
   elemental real(dp) function point_angle(i, points, even)
      integer, intent(in) :: i         !! index of the point along this axis, any integer
      integer, intent(in) :: points    !! number of points along this axis, M or N, >= 1
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell

      point_angle = 2*pi*(i - 1)/points
      if (even) point_angle = pi*(i - 0.5_dp)/points
   end function point_angle

   !> The index of the point of the grid whose image is a given point of the continuation. A quarter of a cell is
   !> continued by mirror images at its borders, a whole cell periodically. A point of the grid is its own image.
   elemental integer function image_of_point(i, points, even) result(image)
      integer, intent(in) :: i         !! index of the point along this axis, any integer
      integer, intent(in) :: points    !! number of points along this axis, M or N, >= 1
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
