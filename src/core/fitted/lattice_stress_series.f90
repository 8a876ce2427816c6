!> Stresses below all spots or pools of a lattice as a Fourier series: README.md (F55).
!>
!> All lattices are symmetric to the x axis and the y axis through a crest, so that the series has terms
!> cos(k_x x) cos(k_y y) only. A lattice of shifted rows has the terms of a rectangle of two rows in which the sum of
!> the two wave numbers is even.
module wavycon_lattice_stress_series
   use wavycon_disc_sources, only: disc_sources
   use wavycon_kinds, only: dp, pi
   use wavycon_lapack, only: dgemm
   use wavycon_stress_kernel, only: of_gap, stress_field_count
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: lattice_stress_series, start_lattice_stress_series, add_wave

   type :: lattice_stress_series
      real(dp) :: digits = 0.0_dp                      !! waves with |k| z above this are left out: ln(1/accuracy)
      real(dp) :: base_x = 0.0_dp, base_y = 0.0_dp     !! least k_x and k_y [rad/s]
      real(dp), allocatable, private :: pressure(:, :) !! amplitude of each wave, shape (0:n_x, 0:n_y); 0 for the mean
   contains
      procedure :: add_at
   end type lattice_stress_series

contains

   !> Computes the amplitudes of the waves of all spots or pools that reach a depth, from the point sources of one of
   !> them.
   subroutine start_lattice_stress_series(series, lattice, sources, depth, e_folds)
      type(lattice_stress_series), intent(out) :: series
      type(wave_lattice), intent(in) :: lattice
      type(disc_sources), intent(in) :: sources  !! pressure or gap; the waves of a gap have |k| times the pressure
      real(dp), intent(in) :: depth              !! least depth at which the series will be evaluated, > 0 [s]
      real(dp), intent(in) :: e_folds            !! natural logarithm of 1/accuracy

      complex(dp) :: centre
      real(dp), allocatable :: along_x(:, :), along_y(:, :)
      real(dp), dimension(size(sources%x)) :: strength, x, y
      real(dp) :: height, largest, length
      integer :: i, j, n, waves_x, waves_y
      logical :: gap

      gap = sources%source == of_gap
      centre = merge(lattice%trough, (0.0_dp, 0.0_dp), gap)
      ! A pool and its image by half a turn about a crest have the same even terms. So the second pool of a cell is a
      ! factor 2.
      strength = merge(lattice%troughs, 1, gap)*sources%strength(:, 1)
      series%digits = e_folds
      largest = e_folds/depth
      n = size(x)
      x = centre%re + sources%x
      y = centre%im + sources%y
      associate (rows => lattice%rows)
         height = rows%spacing*merge(2, 1, rows%shift > 0.0_dp)
         series%base_x = 2*pi/merge(height, 1.0_dp, rows%along_y)
         series%base_y = 2*pi/merge(1.0_dp, height, rows%along_y)
         waves_x = ceiling(largest/series%base_x)
         waves_y = ceiling(largest/series%base_y)
         along_x = reshape([(cos(i*(series%base_x*x))*strength, i=0, waves_x)], [n, waves_x + 1])
         along_y = reshape([(cos(j*(series%base_y*y)), j=0, waves_y)], [n, waves_y + 1])
         allocate (series%pressure(0:waves_x, 0:waves_y))
         call dgemm('T', 'N', waves_x + 1, waves_y + 1, n, 1.0_dp/rows%spacing, along_x, n, along_y, n, 0.0_dp, &
                    series%pressure, waves_x + 1)
      end associate
      do j = 0, waves_y
         do i = 0, waves_x
            associate (p => series%pressure(i, j))
               length = hypot(series%base_x*i, series%base_y*j)
               if (lattice%rows%shift > 0.0_dp .and. mod(i + j, 2) == 1) p = 0.0_dp
               if (gap) p = p*length/(2*pi)
               if (i > 0) p = 2*p
               if (j > 0) p = 2*p
            end associate
         end do
      end do
      series%pressure(0, 0) = 0.0_dp
   end subroutine start_lattice_stress_series

   !> Adds the fields at a point.
   pure subroutine add_at(self, place, depth, fields)
      class(lattice_stress_series), intent(in) :: self
      complex(dp), intent(in) :: place             !! from a crest [s]
      real(dp), intent(in) :: depth                !! >= that of the start [s]
      real(dp), intent(inout) :: fields(stress_field_count)

      complex(dp) :: x(0:ubound(self%pressure, 1)), y(0:ubound(self%pressure, 2))
      real(dp) :: kx, ky, length, p, total(stress_field_count)
      integer :: i, j, last

      x = [(exp(cmplx(0.0_dp, i*self%base_x*place%re, dp)), i=0, ubound(x, 1))]
      y = [(exp(cmplx(0.0_dp, j*self%base_y*place%im, dp)), j=0, ubound(y, 1))]
      total = 0.0_dp
      do i = 0, ubound(x, 1)
         kx = i*self%base_x
         if (kx*depth > self%digits) exit
         last = min(ubound(y, 1), int(sqrt((self%digits/depth)**2 - kx**2)/self%base_y))
         do j = 0, last
            if (.not. abs(self%pressure(i, j)) > 0.0_dp) cycle
            ky = j*self%base_y
            length = sqrt(kx**2 + ky**2)
            p = self%pressure(i, j)*exp(-length*depth)
            associate (cc => p*x(i)%re*y(j)%re, along => (ky - kx)*(ky + kx)*p*x(i)%re*y(j)%re/length**2, &
                       across => 2*kx*ky*p*x(i)%im*y(j)%im/length**2)
               total = total + [cc, -depth*length*cc, along, across, depth*length*along, depth*length*across, &
                                -kx*depth*p*x(i)%im*y(j)%re, -ky*depth*p*x(i)%re*y(j)%im]
            end associate
         end do
      end do
      fields = fields + total
   end subroutine add_at

   !> Adds the fields of one wave of the pressure, p cos(k.x), at a point.
   pure subroutine add_wave(wave, pressure, place, depth, fields)
      real(dp), intent(in) :: wave(2)              !! wave vector k, not 0 [rad/s]
      real(dp), intent(in) :: pressure             !! amplitude p
      complex(dp), intent(in) :: place             !! x + i y of the point [s]
      real(dp), intent(in) :: depth                !! depth z >= 0 [s]
      real(dp), intent(inout) :: fields(stress_field_count)

      complex(dp) :: direction
      real(dp) :: length, turn

      length = hypot(wave(1), wave(2))
      direction = cmplx(wave(1), wave(2), dp)/length
      turn = wave(1)*place%re + wave(2)*place%im
      associate (even => pressure*exp(-length*depth)*cos(turn), odd => pressure*exp(-length*depth)*sin(turn), &
                 depth_waves => depth*length, square => direction**2)
         fields = fields + [even, -depth_waves*even, -even*square%re, -even*square%im, &
                            -depth_waves*even*square%re, -depth_waves*even*square%im, &
                            -depth_waves*odd*direction%re, -depth_waves*odd*direction%im]
      end associate
   end subroutine add_wave

end module wavycon_lattice_stress_series
