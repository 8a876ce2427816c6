!> A lattice of points in equal rows, even in x and in y.
!>
!> Points of a row are 1 apart, which is the unit s of all lengths. Rows are `spacing` apart; each is shifted along
!> itself against the one before by `shift`, 0 for a rectangular and 1/2 for a rhombic or hexagonal lattice.
!>
!> N.B. The symmetries that are used hold for shifts of 0 and 1/2 only.
module wavycon_row_lattice
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: row_lattice

   type :: row_lattice
      real(dp) :: spacing = 1.0_dp     !! distance of neighbouring rows [s], >= 1/2
      real(dp) :: shift = 0.0_dp       !! of the next row along itself [s]: 0 or 1/2
      logical :: along_y = .false.     !! whether rows are along y; otherwise along x
   contains
      procedure :: reduce_along_rows
      procedure :: reduced
      procedure :: points_about
   end type row_lattice

contains

   !> Translates n places by lattice vectors into the rectangle |along| <= 1/2, |across| <= spacing/2 about the origin.
   pure subroutine reduce_along_rows(self, n, along, across, reduced_along, reduced_across, moved)
      class(row_lattice), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: along(n), across(n)                        !! coordinates along and across the rows [s]
      real(dp), intent(out) :: reduced_along(n), reduced_across(n)       !! [s]
      logical, intent(out) :: moved                                      !! whether any place was outside

      integer :: column, i, moves, row

      moves = 0
      do i = 1, n
         row = int(across(i)/self%spacing + sign(0.5_dp, across(i)))
         reduced_across(i) = across(i) - row*self%spacing
         reduced_along(i) = along(i) - row*self%shift
         column = int(reduced_along(i) + sign(0.5_dp, reduced_along(i)))
         reduced_along(i) = reduced_along(i) - column
         moves = ior(moves, ior(row, column))
      end do
      moved = moves /= 0
   end subroutine reduce_along_rows

   !> The place of the rectangle about the origin that differs from z by a lattice vector.
   pure complex(dp) function reduced(self, z)
      class(row_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y [s]

      real(dp) :: across(1), along(1)
      logical :: moved

      along = merge(z%im, z%re, self%along_y)
      across = merge(z%re, z%im, self%along_y)
      call self%reduce_along_rows(1, [along], [across], along, across, moved)
      reduced = cmplx(merge(across(1), along(1), self%along_y), merge(along(1), across(1), self%along_y), dp)
   end function reduced

   !> The lattice points, all moved by an offset, that are not farther than `distance` from the rectangle about the
   !> origin: the cell of places that are reduced.
   pure function points_about(self, distance, offset) result(point)
      class(row_lattice), intent(in) :: self
      real(dp), intent(in) :: distance             !! >= 0 [s]
      complex(dp), intent(in) :: offset            !! x + i y [s]
      complex(dp), allocatable :: point(:)         !! x + i y [s]

      complex(dp) :: half, z
      integer :: columns, i, j, rows

      half = 0.5_dp*cmplx(1.0_dp, self%spacing, dp)
      rows = ceiling((distance + abs(offset))/self%spacing + 0.5_dp)
      columns = ceiling(distance + abs(offset) + 0.5_dp + self%shift*rows)
      if (self%along_y) half = cmplx(half%im, half%re, dp)
      allocate (point(0))
      do j = -rows, rows
         do i = -columns, columns
            z = cmplx(i + self%shift*j, self%spacing*j, dp)
            if (self%along_y) z = cmplx(z%im, z%re, dp)
            z = z + offset
            if (norm2(max(abs([z%re, z%im]) - [half%re, half%im], 0.0_dp)) <= distance) point = [point, z]
         end do
      end do
   end function points_about

end module wavycon_row_lattice
