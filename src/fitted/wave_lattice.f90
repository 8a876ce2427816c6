!> The wavy surfaces that the boundary-fitted solver knows: one crest a primitive cell, at the lattice's points.
!>
!> h/Delta = 1 - sum over i of a_i cos(2 pi k_i.x), the a_i sum to 1 so that a crest touches: Delta is the
!> mean undeformed gap. Lengths are in the cell's shorter side s, pressures in pi E* Delta/s, which for the
!> square cell is p* and which makes u_k = p_k/|k| for each wave vector k in waves per s. In full contact each wave
!> has the pressure a_i |k_i| cos(2 pi k_i.x) beside the mean one; where that is lowest, at the troughs, it opens last.
module wavycon_wave_lattice
   use wavycon_constants, only: pi
   use wavycon_fitted_tuning, only: hexagonal_merging, rectangular_merging, rhombic_merging
   use wavycon_kinds, only: dp
   use wavycon_periodic_kernel, only: periodic_kernel, start_periodic_kernel
   implicit none (type, external)
   private

   public :: wave_lattice, square_lattice, rectangular_lattice, rhombic_lattice, hexagonal_lattice

   type :: wave_lattice
      integer :: fold = 4                        !! of the symmetry about a crest
      integer :: trough_fold = 4                 !! of the symmetry about a trough
      integer :: troughs = 1                     !! in a cell: at `trough` and, if there are two, at -`trough`
      real(dp) :: area = 1.0_dp                  !! of a cell [s^2]
      real(dp) :: closing_pressure = 1.0_dp      !! the mean pressure that just closes the troughs, p*
      real(dp) :: about_merging = 0.0_dp         !! the mean pressure from about which each trough has its island
      real(dp), allocatable :: wave(:, :)        !! k_i [1/s], shape (2, n)
      real(dp), allocatable :: amplitude(:)      !! a_i > 0 [Delta], shape (n)
      complex(dp) :: saddle = 0.5_dp             !! the lowest between neighbouring crests, x + i y [s]
      complex(dp) :: trough = (0.5_dp, 0.5_dp)   !! x + i y [s]
      complex(dp), allocatable :: phase(:)       !! of each wave at the trough, exp(2 pi i k_i.x), shape (n)
      real(dp), allocatable :: pressure(:)       !! of each in full contact, a_i |k_i|, shape (n)
      !> Middles of the ways to the neighbours that spots and islands may touch, one of each kind, from the crest and
      !> from the trough [s].
      complex(dp), allocatable :: to_next_crest(:), to_next_trough(:)
      type(periodic_kernel) :: kernel
      logical :: square = .true.                 !! the lattice whose troughs are as its crests
   contains
      procedure :: undeformed_gap
      procedure :: undeformed_slope
      procedure :: pressure_rise
      procedure :: pressure_rise_slope
   end type wave_lattice

contains

   !> h/Delta = 1 - (cos X + cos Y)/2: the paper's surface, with the axes along neighbouring crests.
   function square_lattice() result(lattice)
      type(wave_lattice) :: lattice

      !> The mean pressure at which spots merge, found by solving on either side of it.
      real(dp), parameter :: merging_pressure = 0.228605_dp

      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
      lattice%amplitude(:) = [0.5_dp, 0.5_dp]
      lattice%to_next_crest = [lattice%saddle]
      call start_periodic_kernel(lattice%kernel, 1.0_dp, 0.0_dp)
      call add_pressure(lattice, merging_pressure)
   end function square_lattice

   !> h/Delta = 1 - a_x cos X - a_y cos Y, a_x + a_y = 1.
   function rectangular_lattice(side_ratio, amplitude_x) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer side, along y, over the shorter: 1 to 3
      real(dp), intent(in) :: amplitude_x  !! a_x, between 0 and 1 [Delta]
      type(wave_lattice) :: lattice

      lattice%fold = 2
      lattice%trough_fold = 2
      lattice%square = .false.
      lattice%area = side_ratio
      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp/side_ratio], [2, 2])
      lattice%amplitude(:) = [amplitude_x, 1.0_dp - amplitude_x]
      ! Of two as low, the one on the longer side: spots stretch that way.
      if (amplitude_x >= 0.5_dp) lattice%saddle = cmplx(0.0_dp, 0.5_dp*side_ratio, dp)
      lattice%trough = cmplx(0.5_dp, 0.5_dp*side_ratio, dp)
      lattice%to_next_crest = [cmplx(0.5_dp, 0.0_dp, dp), cmplx(0.0_dp, 0.5_dp*side_ratio, dp)]
      call start_periodic_kernel(lattice%kernel, side_ratio, 0.0_dp)
      call add_pressure(lattice, rectangular_merging)
   end function rectangular_lattice

   !> h/Delta = 1 - cos X cos Y: a crest more in the middle of the cell. At a ratio of 1 the paper's surface, with the
   !> axes at 45 degrees to neighbouring crests.
   function rhombic_lattice(side_ratio) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer wavelength, along y, over the shorter, s: 1 to 3
      type(wave_lattice) :: lattice

      lattice%fold = 2
      lattice%trough_fold = 2
      lattice%square = .false.
      lattice%area = 0.5_dp*side_ratio
      allocate (lattice%wave(2, 2), lattice%amplitude(2))
      lattice%wave(:, :) = reshape([1.0_dp, 1.0_dp/side_ratio, 1.0_dp, -1.0_dp/side_ratio], [2, 2])
      lattice%amplitude(:) = [0.5_dp, 0.5_dp]
      lattice%saddle = cmplx(0.25_dp, 0.25_dp*side_ratio, dp)
      lattice%trough = 0.5_dp
      lattice%to_next_crest = [lattice%saddle]
      call start_periodic_kernel(lattice%kernel, 0.5_dp*side_ratio, 0.5_dp)
      call add_pressure(lattice, rhombic_merging)
   end function rhombic_lattice

   !> Three equal waves at 120 degrees; each crest has six neighbours, two of them along y so that a trough is on the
   !> x axis. The troughs, with three neighbours each, are the points of a honeycomb, two in a cell.
   function hexagonal_lattice() result(lattice)
      type(wave_lattice) :: lattice

      real(dp), parameter :: root3 = sqrt(3.0_dp)

      lattice%fold = 6
      lattice%trough_fold = 3
      lattice%troughs = 2
      lattice%square = .false.
      lattice%area = 0.5_dp*root3
      allocate (lattice%wave(2, 3), lattice%amplitude(3))
      lattice%wave(:, :) = reshape([2.0_dp, 0.0_dp, 1.0_dp, root3, 1.0_dp, -root3]/root3, [2, 3])
      lattice%amplitude(:) = [1.0_dp, 1.0_dp, 1.0_dp]/3
      lattice%saddle = cmplx(0.25_dp*root3, 0.25_dp, dp)
      lattice%trough = 1.0_dp/root3
      lattice%to_next_crest = [lattice%saddle]
      lattice%to_next_trough = [cmplx(0.5_dp/root3, 0.0_dp, dp)]
      lattice%phase = 0.5_dp*[cmplx(-1.0_dp, -root3, dp), cmplx(-1.0_dp, root3, dp), cmplx(-1.0_dp, root3, dp)]
      call start_periodic_kernel(lattice%kernel, 0.5_dp*root3, 0.5_dp, rows_along_y=.true.)
      call add_pressure(lattice, hexagonal_merging)
   end function hexagonal_lattice

   !> What islands need. Those of all lattices but the hexagonal have neighbours as the spots have, and all waves are
   !> lowest at the trough.
   subroutine add_pressure(lattice, at_merging)
      type(wave_lattice), intent(inout) :: lattice   !! with its waves, trough and ways between crests
      real(dp), intent(in) :: at_merging
         !! lowest pressure of full contact in the middles between troughs at which islands separate, over the closing
         !! pressure

      complex(dp), allocatable :: middle(:)

      if (.not. allocated(lattice%to_next_trough)) lattice%to_next_trough = lattice%to_next_crest
      if (.not. allocated(lattice%phase)) lattice%phase = [(-1.0_dp, 0.0_dp), (-1.0_dp, 0.0_dp)]
      lattice%pressure = lattice%amplitude*hypot(lattice%wave(1, :), lattice%wave(2, :))
      ! Less its mean, the pressure of full contact at the trough is minus that which closes it.
      lattice%closing_pressure = -sum(lattice%pressure*lattice%phase%re)
      allocate (middle, source=lattice%to_next_trough)
      lattice%about_merging = (1.0_dp + at_merging)*lattice%closing_pressure - minval(lattice%pressure_rise(middle))
   end subroutine add_pressure

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

   !> The pressure of full contact less that at the trough x_t, the sum of a_i |k_i| (cos 2 pi k_i.x - cos 2 pi
   !> k_i.x_t), without loss of digits near the trough.
   elemental real(dp) function pressure_rise(self, z) result(p)
      class(wave_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y from the trough [s]

      real(dp) :: half
      integer :: i

      p = 0.0_dp
      do i = 1, size(self%pressure)
         half = pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im)
         p = p - 2*self%pressure(i)*sin(half)*(self%phase(i)%re*sin(half) + self%phase(i)%im*cos(half))
      end do
   end function pressure_rise

   !> Its gradient [1/s], as a complex number.
   elemental complex(dp) function pressure_rise_slope(self, z) result(slope)
      class(wave_lattice), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y from the trough [s]

      real(dp) :: turn
      integer :: i

      slope = 0.0_dp
      do i = 1, size(self%pressure)
         turn = 2*pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im)
         slope = slope - 2*pi*self%pressure(i)*cmplx(self%wave(1, i), self%wave(2, i), dp) &
            *(self%phase(i)%re*sin(turn) + self%phase(i)%im*cos(turn))
      end do
   end function pressure_rise_slope

end module wavycon_wave_lattice
