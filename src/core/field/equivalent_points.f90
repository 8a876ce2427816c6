!> The points of a grid that are equivalent by the symmetries of a lattice of crests: fields are evaluated at the
!> first of them only.
!>
!> The symmetries are the mirror lines X = 0 and Y = 0, the diagonals of a square cell, and the translation by half a
!> cell both ways of a cell with two crests.
module wavycon_equivalent_points
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: equivalent_points, point_image

   type :: equivalent_points
      logical :: is_square = .false.   !! whether x and y are equivalent on the lattice
      integer :: crests = 0            !! of the cell, 1 or 2; 0: no points are equivalent
      integer, private :: points(2) = 1, twice_offset(2) = 0
      logical, private :: has_mirrors = .false., has_diagonals = .false., has_second_crest = .false.
   contains
      procedure :: start
      procedure :: first_of
      procedure :: number_of_first
   end type equivalent_points

   !> The first point equivalent to a point: mirrored, and then with X and Y exchanged.
   type :: point_image
      integer :: point(2) = 0                    !! from 0
      logical :: mirrored(2) = .false.           !! in X and in Y
      logical :: exchanged = .false.
   end type point_image

contains

   !> Finds the symmetries that the points of a grid have.
   subroutine start(self, points, offset)
      class(equivalent_points), intent(inout) :: self
      integer, intent(in) :: points(2)     !! of the cell
      real(dp), intent(in) :: offset(2)    !! of the first point, in steps

      real(dp), parameter :: rounding = 1e-12_dp

      self%points = points
      self%twice_offset = nint(2*offset)
      self%has_mirrors = self%crests > 0 .and. all(abs(2*offset - self%twice_offset) <= rounding)
      self%has_diagonals = self%is_square .and. points(1) == points(2) .and. &
                           self%twice_offset(1) == self%twice_offset(2)
      self%has_second_crest = self%crests == 2 .and. all(mod(points, 2) == 0)
   end subroutine start

   !> The first of all points equivalent to this one, in the order of a loop over X within one over Y.
   pure type(point_image) function first_of(self, point) result(first)
      class(equivalent_points), intent(in) :: self
      integer, intent(in) :: point(2)      !! from 0

      type(point_image) :: other

      first%point = point
      if (.not. self%has_mirrors) return
      first = reflected(self, point)
      if (.not. self%has_second_crest) return
      other = reflected(self, modulo(point + self%points/2, self%points))
      if (other%point(2) < first%point(2) .or. &
          (other%point(2) == first%point(2) .and. other%point(1) < first%point(1))) first = other
   end function first_of

   !> The first of the mirror images of a point and, on a square cell, of those on the other side of its diagonals.
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

   !> The number of points that are not equivalent to an earlier one.
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
