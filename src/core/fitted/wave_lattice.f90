!> The wavy surfaces that collocation fitted to the edge solves: their crests are the points of a lattice, one in a
!> primitive cell.
!>
!>     h/Delta = 1 - sum over i of a_i cos(2 pi k_i.x),   sum of a_i = 1,   README.md (F1),
!>
!> so that h = 0 at the crests and Delta is the mean undeformed gap. Lengths are in the distance s of neighbouring
!> crests of a row, pressures in pi E* Delta/s. In these units u_k = p_k/|k| for each wave vector k in waves per s,
!> (F3). For the square lattice the unit of pressure is p*. In full contact each wave has the pressure a_i |k_i| cos(2
!> pi k_i.x) in addition to the mean pressure, (F6). Contact is first lost where the sum is lowest, at the troughs.
!> Section 1 of README.md has a table of the lattices.
module wavycon_wave_lattice
   use wavycon_kinds, only: dp, pi
   use wavycon_periodic_kernel, only: periodic_kernel, start_periodic_kernels
   use wavycon_row_lattice, only: row_lattice
   implicit none (type, external)
   private

   public :: wave_lattice, square_lattice, rectangular_lattice, rhombic_lattice, hexagonal_lattice

   !> The mean pressure over the closing pressure at which spots merge on the square lattice, found from solutions on
   !> both sides of merging. The pressure that full contact would have at this load at the midpoints between troughs is
   !> the same number. Rectangular and rhombic lattices, which are square for a side ratio of 1, take this number for
   !> the pressure at the midpoints.
   !>
   !> The number only decides whether spots or pools are tried first at a load. If the choice is wrong, the others are
   !> tried next, which takes more time.
   real(dp), parameter :: square_merging = 0.228605_dp
   !> The same mean pressure of the hexagonal lattice. With an estimate that is lower by 0.05 loads from 0.67 to 0.7
   !> take up to 1.5 times as long. With one that is higher by 0.05 loads from 0.73 to 0.76 take up to twice as long.
   real(dp), parameter :: hexagonal_merging = 0.71191_dp

   type :: wave_lattice
      integer :: fold = 2                            !! order of the rotational symmetry about a crest
      integer :: trough_fold = 2                     !! order of the rotational symmetry about a trough
      integer :: troughs = 1                         !! troughs in a cell: at `trough`; a second one at -`trough`
      logical :: square = .false.                    !! whether this is the square lattice
      real(dp) :: area = 1.0_dp                      !! area of a cell [s^2]
      real(dp) :: closing_pressure = 1.0_dp          !! mean pressure that just closes the troughs, p* (F7)
      real(dp) :: about_merging = 0.0_dp             !! mean pressure near which spots merge and pools separate
      real(dp), allocatable :: wave(:, :)            !! wave vectors k_i [1/s], shape (2, n)
      real(dp), allocatable :: amplitude(:)          !! amplitudes a_i > 0 [Delta], shape (n)
      real(dp), allocatable :: pressure(:)           !! pressure of each wave in full contact, a_i |k_i|, shape (n)
      complex(dp), allocatable :: phase(:)           !! phase of each wave at the trough, exp(2 pi i k_i.x), shape (n)
      complex(dp) :: saddle = 0.5_dp                 !! the lowest saddle between neighbouring crests, x + i y [s]
      complex(dp) :: trough = (0.5_dp, 0.5_dp)       !! a trough, x + i y [s]
      !> Midpoints between a crest and the neighbours that its spot may touch, one of each kind, from the crest; the
      !> same for a trough and its pool, from the trough [s].
      complex(dp), allocatable :: to_next_crest(:), to_next_trough(:)
      type(row_lattice) :: rows                      !! the lattice of the crests
      !> 1: Gp, the kernel of spots; the integral of Gp times p is u less its mean, (F2). 2: its Laplacian, the kernel
      !> of pools, which turns a gap into a pressure, (F10). Both are the smooth parts. 3: the whole of the second one.
      type(periodic_kernel) :: kernel(3)
   contains
      procedure :: rise, curvatures, rise_slope
   end type wave_lattice

contains

   !> h/Delta = 1 - (cos X + cos Y)/2: the paper's surface (21), with the axes towards neighbouring crests.
   function square_lattice() result(lattice)
      type(wave_lattice) :: lattice

      lattice = rectangular_lattice(1.0_dp, 0.5_dp)
      lattice%fold = 4
      lattice%trough_fold = 4
      lattice%square = .true.
      lattice%saddle = 0.5_dp
   end function square_lattice

   !> h/Delta = 1 - a_x cos X - a_y cos Y, a_x + a_y = 1.
   function rectangular_lattice(side_ratio, amplitude_x) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer side, along y, over the shorter side: 1 to 3
      real(dp), intent(in) :: amplitude_x  !! a_x, between 0 and 1 [Delta]
      type(wave_lattice) :: lattice

      lattice%wave = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp/side_ratio], [2, 2])
      lattice%amplitude = [amplitude_x, 1.0_dp - amplitude_x]
      ! With equal amplitudes two saddles are equally low. The one on the longer side is taken, as spots extend in this
      ! direction.
      if (amplitude_x >= 0.5_dp) lattice%saddle = cmplx(0.0_dp, 0.5_dp*side_ratio, dp)
      lattice%trough = cmplx(0.5_dp, 0.5_dp*side_ratio, dp)
      lattice%to_next_crest = [cmplx(0.5_dp, 0.0_dp, dp), cmplx(0.0_dp, 0.5_dp*side_ratio, dp)]
      call finish_lattice(lattice, row_lattice(spacing=side_ratio, shift=0.0_dp), square_merging)
   end function rectangular_lattice

   !> h/Delta = 1 - cos X cos Y, with a second crest in the middle of the rectangle of both wavelengths. With the side
   !> ratio 1 this is the paper's surface, with the axes at 45 degrees to the lines between neighbouring crests.
   function rhombic_lattice(side_ratio) result(lattice)
      real(dp), intent(in) :: side_ratio   !! longer wavelength, along y, over the shorter one, which is s: 1 to 3
      type(wave_lattice) :: lattice

      lattice%wave = reshape([1.0_dp, 1.0_dp/side_ratio, 1.0_dp, -1.0_dp/side_ratio], [2, 2])
      lattice%amplitude = [0.5_dp, 0.5_dp]
      lattice%saddle = cmplx(0.25_dp, 0.25_dp*side_ratio, dp)
      lattice%trough = 0.5_dp
      lattice%to_next_crest = [lattice%saddle]
      call finish_lattice(lattice, row_lattice(spacing=0.5_dp*side_ratio, shift=0.5_dp), square_merging)
   end function rhombic_lattice

   !> h/Delta = 1 - (cos k1.x + cos k2.x + cos k3.x)/3: three equal waves at 60 degrees to each other. (k and -k are the
   !> same wave, so this holds also for k2 and k3, which are 120 degrees apart.) Each crest has six neighbours, two of
   !> them along y, so that a trough lies on the x axis. The troughs, with three neighbours each, are the points of a
   !> honeycomb, two in a cell.
   function hexagonal_lattice() result(lattice)
      type(wave_lattice) :: lattice

      real(dp), parameter :: root3 = sqrt(3.0_dp)

      lattice%fold = 6
      lattice%trough_fold = 3
      lattice%troughs = 2
      lattice%wave = reshape([2.0_dp, 0.0_dp, 1.0_dp, root3, 1.0_dp, -root3]/root3, [2, 3])
      lattice%amplitude = [1.0_dp, 1.0_dp, 1.0_dp]/3
      lattice%saddle = cmplx(0.25_dp*root3, 0.25_dp, dp)
      lattice%trough = 1.0_dp/root3
      lattice%to_next_crest = [lattice%saddle]
      lattice%to_next_trough = [cmplx(0.5_dp/root3, 0.0_dp, dp)]
      lattice%phase = 0.5_dp*[cmplx(-1.0_dp, -root3, dp), cmplx(-1.0_dp, root3, dp), cmplx(-1.0_dp, root3, dp)]
      ! The pressure of full contact at the midpoints between troughs is P - (2/3) closing pressure.
      call finish_lattice(lattice, row_lattice(spacing=0.5_dp*root3, shift=0.5_dp, along_y=.true.), &
                          hexagonal_merging - 2.0_dp/3)
   end function hexagonal_lattice

   !> Sets the components that follow from waves, trough and midpoints between crests: the kernels and the data of
   !> pools. On all lattices except the hexagonal one troughs have the same neighbours as crests, and all waves have
   !> their minimum at the trough.
   subroutine finish_lattice(lattice, rows, at_merging)
      type(wave_lattice), intent(inout) :: lattice
      type(row_lattice), intent(in) :: rows          !! the crests
      real(dp), intent(in) :: at_merging
         !! pressure over the closing pressure that full contact would have at the load at which pools merge, at the
         !! midpoint between troughs where it is lowest

      complex(dp), allocatable :: middle(:)

      lattice%rows = rows
      ! The distance of points in a row is 1.
      lattice%area = rows%spacing
      call start_periodic_kernels(rows, lattice%kernel)
      if (.not. allocated(lattice%to_next_trough)) lattice%to_next_trough = lattice%to_next_crest
      if (.not. allocated(lattice%phase)) lattice%phase = [(-1.0_dp, 0.0_dp), (-1.0_dp, 0.0_dp)]
      lattice%pressure = lattice%amplitude*hypot(lattice%wave(1, :), lattice%wave(2, :))
      ! README.md (F6) and (F7): the pressure of full contact at the trough is P less the closing pressure.
      lattice%closing_pressure = -sum(lattice%pressure*lattice%phase%re)
      allocate (middle, source=lattice%to_next_trough)
      lattice%about_merging = (1.0_dp + at_merging)*lattice%closing_pressure - minval(lattice%rise(.true., middle))
   end subroutine finish_lattice

   !> For pools R, README.md (F13): the pressure of full contact less its value at the trough. For spots -h/Delta,
   !> README.md (F1). Both are sums over i of a_i (cos(2 pi k_i.x + angle_i) - cos angle_i), computed without loss of
   !> digits near the centre.
   elemental real(dp) function rise(self, pool, z)
      class(wave_lattice), intent(in) :: self
      logical, intent(in) :: pool   !! true: R; false: -h/Delta
      complex(dp), intent(in) :: z  !! x + i y, for R from the trough, otherwise from a crest [s]

      complex(dp) :: wave
      real(dp) :: half
      integer :: i

      rise = 0.0_dp
      do i = 1, size(self%amplitude)
         wave = merge(self%pressure(i)*self%phase(i), cmplx(self%amplitude(i), kind=dp), pool)
         half = pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im)
         rise = rise - 2*sin(half)*(wave%re*sin(half) + wave%im*cos(half))
      end do
   end function rise

   !> The curvatures along x and y of h at a crest [Delta/s^2], README.md (F41), or of R at a trough [pressure/s^2],
   !> (F42).
   pure function curvatures(self, pool)
      class(wave_lattice), intent(in) :: self
      logical, intent(in) :: pool   !! true: those of R; false: those of h
      real(dp) :: curvatures(2)

      integer :: i

      associate (height => merge(-self%pressure*self%phase%re, self%amplitude, pool))
         curvatures = 4*pi**2*[(sum(self%wave(i, :)**2*height), i=1, 2)]
      end associate
   end function curvatures

   !> The gradient of `rise`, as a complex number [unit of `rise`/s].
   elemental complex(dp) function rise_slope(self, pool, z) result(slope)
      class(wave_lattice), intent(in) :: self
      logical, intent(in) :: pool   !! as of `rise`
      complex(dp), intent(in) :: z  !! as of `rise`

      complex(dp) :: wave
      real(dp) :: turn
      integer :: i

      slope = 0.0_dp
      do i = 1, size(self%amplitude)
         wave = merge(self%pressure(i)*self%phase(i), cmplx(self%amplitude(i), kind=dp), pool)
         turn = 2*pi*(self%wave(1, i)*z%re + self%wave(2, i)*z%im)
         slope = slope - 2*pi*cmplx(self%wave(1, i), self%wave(2, i), dp)*(wave%re*sin(turn) + wave%im*cos(turn))
      end do
   end function rise_slope

end module wavycon_wave_lattice
