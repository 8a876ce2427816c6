!> A lattice of points in equal rows, which is symmetric to the x axis and to the y axis.
!>
!> The distance of neighbouring points in a row is 1, the unit s of all lengths. The distance of rows is `spacing`. Each
!> row is shifted along itself against the row before by `shift`: 0 for a rectangular, 1/2 for a rhombic or hexagonal
!> lattice.
!>
!> N.B. The symmetries that are used hold for the shifts 0 and 1/2 only.
module wavycon_row_lattice
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: row_lattice

   type :: row_lattice
      real(dp) :: spacing = 1.0_dp     !! distance of neighbouring rows [s], >= 1/2
      real(dp) :: shift = 0.0_dp       !! shift of the next row along itself [s]: 0 or 1/2
      logical :: along_y = .false.     !! true: rows are along y; false: along x
   contains
      procedure :: half_sides, reduce, reduced, points_about
   end type row_lattice

contains

   !> Half the sides, along x and y, of the rectangle about the origin to which positions are reduced [s].
   pure function half_sides(self) result(half)
      class(row_lattice), intent(in) :: self
      real(dp) :: half(2)

      half = 0.5_dp*[1.0_dp, self%spacing]
      if (self%along_y) half = half([2, 1])
   end function half_sides

   !> Reduces n positions to the rectangle about the origin by adding lattice vectors.
   pure subroutine reduce(self, n, place, moved)
      class(row_lattice), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(inout) :: place(n, 2)    !! x and y [s]
      logical, intent(out) :: moved             !! whether any position was outside of the rectangle

      integer :: across, along, column, i, moves, row

      along = merge(2, 1, self%along_y)
      across = 3 - along
      moves = 0
      do i = 1, n
         row = int(place(i, across)/self%spacing + sign(0.5_dp, place(i, across)))
         place(i, across) = place(i, across) - row*self%spacing
         place(i, along) = place(i, along) - row*self%shift
         column = int(place(i, along) + sign(0.5_dp, place(i, along)))
         place(i, along) = place(i, along) - column
         moves = ior(moves, ior(row, column))
      end do
      moved = moves /= 0
   end subroutine reduce

   !> The position in the rectangle that differs from z by a lattice vector.
   pure complex(dp) function reduced(self, z)
      class(row_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y [s]

      real(dp) :: place(1, 2)
      logical :: moved

      place(1, :) = [z%re, z%im]
      call self%reduce(1, place, moved)
      reduced = cmplx(place(1, 1), place(1, 2), dp)
   end function reduced

   !> All lattice points, moved by an offset, whose distance from the rectangle about the origin is at most `distance`.
   !> If the offset is 0, the origin is the middle one of them, and the point number n + 1 - i of n is minus the point
   !> i.
   pure function points_about(self, distance, offset) result(point)
      class(row_lattice), intent(in) :: self
      real(dp), intent(in) :: distance             !! >= 0 [s]
      complex(dp), intent(in) :: offset            !! x + i y [s]
      complex(dp), allocatable :: point(:)         !! x + i y, shape (n) [s]

      complex(dp), allocatable :: z(:)
      integer :: columns, i, j, rows
      real(dp) :: half(2)

      rows = ceiling((distance + abs(offset))/self%spacing + 0.5_dp)
      columns = ceiling(distance + abs(offset) + 0.5_dp + self%shift*rows)
      half = self%half_sides()
      z = [((cmplx(i + self%shift*j, self%spacing*j, dp), i=-columns, columns), j=-rows, rows)]
      if (self%along_y) z = cmplx(z%im, z%re, dp)
      z = z + offset
      point = pack(z, hypot(max(abs(z%re) - half(1), 0.0_dp), max(abs(z%im) - half(2), 0.0_dp)) <= distance)
   end function points_about

end module wavycon_row_lattice
