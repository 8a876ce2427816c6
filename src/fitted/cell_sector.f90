!> The part of a lattice's cell that symmetry makes the whole: seen from a spot or island, the places between two of its
!> mirror lines that are not beyond the border to its neighbours.
!>
!> The border is a chain of straight lines. Between spots that are mirror images of each other it is their mirror line.
!> Neighbours on a rhombic lattice are each other's half-turn about the midpoint between them; there any line through
!> the midpoint does, and one along the edge at its nearest point keeps clear of both.
module wavycon_cell_sector
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_row_lattice, only: row_lattice
   use wavycon_shape_map, only: shape_map
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: cell_sector, start_cell_sector

   !> Points of a half sector of the edge, of which the nearest one to the midpoint is taken. Any line between the two
   !> neighbours would do.
   integer, parameter :: edge_points = 64

   type :: cell_sector
      complex(dp), allocatable :: corner(:)       !! ends of the border's lines, shape (lines + 1), anticlockwise [s]
      type(row_lattice), private :: rows          !! the crests
      complex(dp) :: centre = 0.0_dp              !! of the spot or island, from a crest [s]
      integer, private :: fold = 4                !! of the symmetry about it
      integer, private :: places = 1              !! spots or islands in a cell: at the centre and at -centre
      complex(dp), allocatable, private :: image(:)   !! the lattice points next to the origin, and 0 [s]
      logical, private :: turns = .false.         !! whether the border is that of neighbours turned by half a turn
      complex(dp), private :: midpoint = 0.0_dp, normal = 1.0_dp   !! of that border
   contains
      procedure :: folded
   end type cell_sector

contains

   !> Sets border and symmetry.
   subroutine start_cell_sector(sector, lattice, island, shape)
      type(cell_sector), intent(out) :: sector
      type(wave_lattice), intent(in) :: lattice
      logical, intent(in) :: island               !! about a trough, otherwise about a crest
      type(shape_map), intent(in) :: shape        !! of the spot or island

      complex(dp) :: middle
      real(dp) :: height

      sector%fold = shape%fold
      if (island) then
         sector%centre = lattice%trough
         sector%places = lattice%troughs
      end if
      sector%rows = lattice%rows
      associate (near => lattice%displacement_kernel%near_points())
         sector%image = [(0.0_dp, 0.0_dp), cmplx(near(1, :), near(2, :), dp)]
      end associate
      if (island) then
         middle = lattice%to_next_trough(1)
      else
         middle = lattice%to_next_crest(1)
      end if
      if (sector%fold > 2) then
         ! One line across the way to the next neighbour, which is in the direction of a mirror line.
         height = abs(middle)
         associate (angle => atan2(middle%im, middle%re), half => pi/sector%fold)
            if (angle < 0.5_dp*half) then
               sector%corner = [cmplx(height, 0.0_dp, dp), height/cos(half)*exp(cmplx(0.0_dp, half, dp))]
            else
               sector%corner = [cmplx(height/cos(half), 0.0_dp, dp), middle]
            end if
         end associate
      else if (lattice%rows%shift > 0.0_dp) then
         call place_tilted_border(sector, shape, middle)
      else
         height = 0.5_dp*lattice%rows%spacing
         sector%corner = [(0.5_dp, 0.0_dp), cmplx(0.5_dp, height, dp), cmplx(0.0_dp, height, dp)]
      end if
   end subroutine start_cell_sector

   !> The border on a rhombic lattice: through the midpoint, along the edge at the point nearest to it.
   subroutine place_tilted_border(sector, shape, middle)
      type(cell_sector), intent(inout) :: sector
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: middle            !! towards the neighbour, half a side of the cell in x and in y [s]

      complex(dp) :: w(0:edge_points)
      real(dp) :: across
      integer :: i

      w = [(exp(cmplx(0.0_dp, 0.5_dp*pi*i/edge_points, dp)), i=0, edge_points)]
      i = minloc(abs(shape%place(w) - middle), 1) - 1
      sector%turns = .true.
      sector%midpoint = middle
      sector%normal = shape%tangent(w(i))
      sector%normal = sector%normal/abs(sector%normal)
      associate (n => sector%normal)
         ! It meets the y axis and the side of the quarter across, or else the x axis and the side above.
         if (n%re*middle%re <= n%im*middle%im) then
            across = middle%im + middle%re*n%re/n%im
            sector%corner = [cmplx(2*middle%re, 0.0_dp, dp), cmplx(2*middle%re, 2*middle%im - across, dp), middle, &
                             cmplx(0.0_dp, across, dp)]
         else
            across = middle%re + middle%im*n%im/n%re
            sector%corner = [cmplx(across, 0.0_dp, dp), middle, cmplx(2*middle%re - across, 2*middle%im, dp), &
                             cmplx(0.0_dp, 2*middle%im, dp)]
         end if
      end associate
   end subroutine place_tilted_border

   !> The equivalent place in the sector.
   pure complex(dp) function folded(self, place) result(z)
      class(cell_sector), intent(in) :: self
      complex(dp), intent(in) :: place            !! x + i y from a crest [s]

      complex(dp) :: other

      z = from_nearest(self, place - self%centre)
      if (self%places == 2) then
         other = from_nearest(self, -place - self%centre)
         if (abs(other) < abs(z)) z = other
      end if
      z = between_mirrors(self%fold, z)
      if (self%turns) then
         associate (n => self%normal, beyond => z - self%midpoint)
            if (n%re*beyond%re + n%im*beyond%im > 0.0_dp) z = between_mirrors(self%fold, 2*self%midpoint - z)
         end associate
      end if
   end function folded

   !> The place as seen from the nearest lattice point.
   pure complex(dp) function from_nearest(self, z)
      class(cell_sector), intent(in) :: self
      complex(dp), intent(in) :: z

      complex(dp) :: reduced

      reduced = self%rows%reduced(z)
      associate (x => reduced%re - self%image%re, y => reduced%im - self%image%im)
         from_nearest = reduced - self%image(minloc(x**2 + y**2, 1))
      end associate
   end function from_nearest

   !> The equivalent place at an angle between 0 and pi/fold.
   pure complex(dp) function between_mirrors(fold, z) result(equivalent)
      integer, intent(in) :: fold
      complex(dp), intent(in) :: z

      integer :: turns

      turns = nint(atan2(z%im, z%re)*fold/(2*pi))
      equivalent = z
      if (turns /= 0) equivalent = z*exp(cmplx(0.0_dp, -2*pi*turns/fold, dp))
      equivalent = cmplx(equivalent%re, abs(equivalent%im), dp)
   end function between_mirrors

end module wavycon_cell_sector
