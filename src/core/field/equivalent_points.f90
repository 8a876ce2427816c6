!> Finds which points of a grid are equivalent by the symmetries of a lattice of crests. Fields are evaluated at the
!> first point of each set of equivalent points only.
!>
!> The symmetries are reflections in the lines X = 0 and Y = 0, reflections in the diagonals of a square cell, and, in a
!> cell with two crests, the translation by half a cell along both axes.
module wavycon_equivalent_points
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: equivalent_points, point_image

   type :: equivalent_points
      logical :: is_square = .false.   !! whether the lattice does not change if x and y are exchanged
      integer :: crests = 0            !! number of crests in the cell, 1 or 2; 0: no points are equivalent
      !> Points of the grid, and twice the distance of its first point from the origin in steps.
      integer, private :: points(2) = 1, twice_offset(2) = 0
      !> Whether the points of the grid have these symmetries: reflections in the axes and in the diagonals,
      !> translation.
      logical, private :: has_mirrors = .false., has_diagonals = .false., has_second_crest = .false.
   contains
      procedure :: start, first_of, number_of_first
   end type equivalent_points

   !> The first of the points that are equivalent to a point, and the operations that lead to this first point:
   !> reflection in the axes, then exchange of X and Y.
   type :: point_image
      integer :: point(2) = 0                    !! indices of the first point, from 0
      logical :: mirrored(2) = .false.           !! whether X and Y have changed their signs
      logical :: exchanged = .false.             !! whether X and Y have been exchanged
   end type point_image

contains

   !> Finds those symmetries of the lattice that the points of a grid have too.
   subroutine start(self, points, offset)
      class(equivalent_points), intent(inout) :: self
      integer, intent(in) :: points(2)     !! points of the grid on the cell
      real(dp), intent(in) :: offset(2)    !! distance of the first point from the origin, in steps

      real(dp), parameter :: rounding = 1e-12_dp

      self%points = points
      self%twice_offset = nint(2*offset)
      self%has_mirrors = self%crests > 0 .and. all(abs(2*offset - self%twice_offset) <= rounding)
      self%has_diagonals = self%is_square .and. points(1) == points(2) .and. &
                           self%twice_offset(1) == self%twice_offset(2)
      self%has_second_crest = self%crests == 2 .and. all(mod(points, 2) == 0)
   end subroutine start

   !> The first of all points that are equivalent to a point. The order is that of a loop over X inside a loop over Y.
   pure type(point_image) function first_of(self, point) result(first)
      class(equivalent_points), intent(in) :: self
      integer, intent(in) :: point(2)      !! indices of the point, from 0

      type(point_image) :: other

      first%point = point
      if (.not. self%has_mirrors) return
      first = reflected(self, point)
      if (.not. self%has_second_crest) return
      other = reflected(self, modulo(point + self%points/2, self%points))
      if (other%point(2) < first%point(2) .or. &
          (other%point(2) == first%point(2) .and. other%point(1) < first%point(1))) first = other
   end function first_of

   !> The first of the mirror images of a point; if the cell is square, mirror images in the diagonals are included.
   pure type(point_image) function reflected(grid, point) result(first)
      type(equivalent_points), intent(in) :: grid
      integer, intent(in) :: point(2)

      integer :: mirror(2)

      mirror = modulo(-point - grid%twice_offset, grid%points)
      first%mirrored = mirror < point
      first%point = min(point, mirror)
      first%exchanged = grid%has_diagonals .and. first%point(2) > first%point(1)
      if (first%exchanged) first%point = first%point([2, 1])
   end function reflected

   !> The number of sets of equivalent points.
   pure integer function number_of_first(self) result(number)
      class(equivalent_points), intent(in) :: self

      type(point_image) :: first
      integer :: k, l

      number = 0
      do l = 0, self%points(2) - 1
         do k = 0, self%points(1) - 1
            first = self%first_of([k, l])
            if (all(first%point == [k, l])) number = number + 1
         end do
      end do
   end function number_of_first

end module wavycon_equivalent_points
