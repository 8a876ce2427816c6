!> The wavy surfaces that the boundary-fitted solver knows: one crest a primitive cell, at the lattice's points.
!>
!> h/Delta = 1 - sum over i of a_i cos(2 pi k_i.x), the a_i sum to 1 so that a crest touches: Delta is the
!> mean undeformed gap. Lengths are in the cell's shorter side s, pressures in pi E* Delta/s, which for the
!> square cell is p* and which makes u_k = p_k/|k| for each wave vector k in waves per s.
module wavycon_wave_lattice
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_periodic_kernel, only: periodic_kernel, start_periodic_kernel
   implicit none (type, external)
   private

   public :: wave_lattice, square_lattice, rectangular_lattice, rhombic_lattice, hexagonal_lattice

   type :: wave_lattice
      integer :: fold = 4                        !! of the symmetry about a crest
      real(dp) :: area = 1.0_dp                  !! of a cell [s^2]
      real(dp), allocatable :: wave(:, :)        !! k_i [1/s], shape (2, n)
      real(dp), allocatable :: amplitude(:)      !! a_i > 0 [Delta], shape (n)
      complex(dp) :: saddle = 0.5_dp             !! the lowest between neighbouring crests, x + i y [s]
      complex(dp) :: trough = (0.5_dp, 0.5_dp)   !! x + i y [s]
      type(periodic_kernel) :: kernel
      logical :: square = .true.                 !! the lattice whose troughs are as its crests
   contains
      procedure :: undeformed_gap
      procedure :: undeformed_slope
   end type wave_lattice

contains

   !> h/Delta = 1 - (cos X + cos Y)/2: the paper's surface, with the axes along neighbouring crests.
   function square_lattice() result(lattice)
      type(wave_lattice) :: lattice

      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
      lattice%amplitude(:) = [0.5_dp, 0.5_dp]
      call start_periodic_kernel(lattice%kernel, 1.0_dp, 0.0_dp)
   end function square_lattice

   !> h/Delta = 1 - a_x cos X - a_y cos Y, a_x + a_y = 1.
   function rectangular_lattice(side_ratio, amplitude_x) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer side, along y, over the shorter: 1 to 3
      real(dp), intent(in) :: amplitude_x  !! a_x, between 0 and 1 [Delta]
      type(wave_lattice) :: lattice

      lattice%fold = 2
      lattice%square = .false.
      lattice%area = side_ratio
      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp/side_ratio], [2, 2])
      lattice%amplitude(:) = [amplitude_x, 1.0_dp - amplitude_x]
      ! Of two as low, the one on the longer side: spots stretch that way.
      if (amplitude_x >= 0.5_dp) lattice%saddle = cmplx(0.0_dp, 0.5_dp*side_ratio, dp)
      lattice%trough = cmplx(0.5_dp, 0.5_dp*side_ratio, dp)
      call start_periodic_kernel(lattice%kernel, side_ratio, 0.0_dp)
   end function rectangular_lattice

   !> h/Delta = 1 - cos X cos Y: a crest more in the middle of the cell. At a ratio of 1 the paper's surface, with the
   !> axes at 45 degrees to neighbouring crests.
   function rhombic_lattice(side_ratio) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer wavelength, along y, over the shorter, s: 1 to 3
      type(wave_lattice) :: lattice

      lattice%fold = 2
      lattice%square = .false.
      lattice%area = 0.5_dp*side_ratio
      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 1.0_dp/side_ratio, 1.0_dp, -1.0_dp/side_ratio], [2, 2])
      lattice%amplitude(:) = [0.5_dp, 0.5_dp]
      lattice%saddle = cmplx(0.25_dp, 0.25_dp*side_ratio, dp)
      lattice%trough = 0.5_dp
      call start_periodic_kernel(lattice%kernel, 0.5_dp*side_ratio, 0.5_dp)
   end function rhombic_lattice

   !> Three equal waves at 120 degrees; each crest has six neighbours.
   function hexagonal_lattice() result(lattice)
      type(wave_lattice) :: lattice

      real(dp), parameter :: root3 = sqrt(3.0_dp)

      lattice%fold = 6
      lattice%square = .false.
      lattice%area = 0.5_dp*root3
      allocate (lattice%wave(2, 3), lattice%amplitude(3))
      lattice%wave(:, :) = reshape([0.0_dp, 2.0_dp, root3, 1.0_dp, -root3, 1.0_dp]/root3, [2, 3])
      lattice%amplitude(:) = [1.0_dp, 1.0_dp, 1.0_dp]/3
      lattice%trough = cmplx(0.5_dp, 0.5_dp/root3, dp)
      call start_periodic_kernel(lattice%kernel, 0.5_dp*root3, 0.5_dp)
   end function hexagonal_lattice

   !> h/Delta, without loss of digits near a crest.
   elemental real(dp) function undeformed_gap(self, z) result(h)
      class(wave_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y from a crest [s]

      integer :: i

      h = 0.0_dp
      do i = 1, size(self%amplitude)
         h = h + 2*self%amplitude(i)*sin(pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im))**2
      end do
   end function undeformed_gap

   !> Gradient of h [Delta/s], as a complex number.
   elemental complex(dp) function undeformed_slope(self, z) result(slope)
      class(wave_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y from a crest [s]

      integer :: i

      slope = 0.0_dp
      do i = 1, size(self%amplitude)
         slope = slope + 2*pi*self%amplitude(i)*cmplx(self%wave(1, i), self%wave(2, i), dp) &
            *sin(2*pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im))
      end do
   end function undeformed_slope

end module wavycon_wave_lattice
