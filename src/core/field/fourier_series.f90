!> Periodic fields as Fourier series in two angles: surfaces, pressures and displacements.
module wavycon_fourier_series
   use wavycon_cosine_table, only: cosine_table
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: fourier_series, divide_series, divided, evaluate_line, weighted

   !> f(X, Y) = sum_ij  c_ij cos iX cos jY + cs_ij cos iX sin jY + sc_ij sin iX cos jY + ss_ij sin iX sin jY.
   !> An even field, f(-X, Y) = f(X, -Y) = f(X, Y), has the first term only. In 1-D j = 0 only.
   type :: fourier_series
      real(dp), allocatable :: c(:, :)   !! shape (0:m, 0:n)
      real(dp), allocatable :: cs(:, :), sc(:, :), ss(:, :)   !! of the same shape; not allocated for an even field
      !> m + 1 for a series that is distributed as grids are, where the rank has some of the first indices only, see
      !> wavycon_grid_transform. 0: it is whole.
      integer :: distributed_waves = 0
   contains
      procedure :: is_even
      procedure :: is_distributed
      procedure :: at
      procedure :: on_line
      procedure :: evaluate_on_grid
   end type fourier_series

contains

   pure logical function is_even(self)
      class(fourier_series), intent(in) :: self

      is_even = .not. allocated(self%ss)
   end function is_even

   pure logical function is_distributed(self)
      class(fourier_series), intent(in) :: self

      is_distributed = self%distributed_waves > 0
   end function is_distributed

   !> The field at a point. The series is whole.
   pure real(dp) function at(self, x, y)
      class(fourier_series), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad]

      real(dp), dimension(0:ubound(self%c, 1)) :: cosines, sines
      integer :: i, j

      cosines = [(cos(i*x), i=0, ubound(self%c, 1))]
      if (.not. self%is_even()) sines = [(sin(i*x), i=0, ubound(self%c, 1))]
      at = 0.0_dp
      do j = 0, ubound(self%c, 2)
         at = at + cos(j*y)*dot_product(self%c(:, j), cosines)
         if (self%is_even()) cycle
         at = at + sin(j*y)*(dot_product(self%cs(:, j), cosines) + dot_product(self%ss(:, j), sines)) &
              + cos(j*y)*dot_product(self%sc(:, j), sines)
      end do
   end function at

   !> The field along a line, X = X_0 + d_x t, Y = Y_0 + d_y t. Its waves are first added up to those of equal wave
   !> number along t. The series is whole.
   pure function on_line(self, start, direction, t) result(values)
      class(fourier_series), intent(in) :: self
      real(dp), intent(in) :: start(2)       !! X_0, Y_0 [rad]
      integer, intent(in) :: direction(2)    !! d_x, d_y >= 0
      real(dp), intent(in) :: t(:)           !! [rad]
      real(dp) :: values(size(t))

      complex(dp), allocatable :: along(:)
      complex(dp) :: down, phase, turn, turn_x(0:ubound(self%c, 1)), turn_y, up
      integer :: i, j, last(2), n

      last = direction*ubound(self%c)
      allocate (along(-last(2):sum(last)), source=(0.0_dp, 0.0_dp))
      turn_x = [(exp(cmplx(0.0_dp, i*start(1), dp)), i=0, ubound(self%c, 1))]
      do j = 0, ubound(self%c, 2)
         turn_y = exp(cmplx(0.0_dp, j*start(2), dp))
         do i = 0, ubound(self%c, 1)
            ! The amplitudes of exp(i (iX + jY)) and exp(i (iX - jY)).
            up = 0.5_dp*self%c(i, j)
            down = up
            if (.not. self%is_even()) then
               up = up - 0.5_dp*cmplx(self%ss(i, j), self%sc(i, j) + self%cs(i, j), dp)
               down = down + 0.5_dp*cmplx(self%ss(i, j), self%cs(i, j) - self%sc(i, j), dp)
            end if
            n = direction(1)*i
            associate (m => direction(2)*j)
               along(n + m) = along(n + m) + up*turn_x(i)*turn_y
               along(n - m) = along(n - m) + down*turn_x(i)*conjg(turn_y)
            end associate
         end do
      end do
      do i = 1, size(t)
         turn = exp(cmplx(0.0_dp, t(i), dp))
         phase = exp(cmplx(0.0_dp, lbound(along, 1)*t(i), dp))
         values(i) = 0.0_dp
         do n = lbound(along, 1), ubound(along, 1)
            values(i) = values(i) + real(along(n)*phase)
            phase = phase*turn
         end do
      end do
   end function on_line

   !> An even field on a quarter of the cell, at X = pi k/N, Y = pi l/N, k, l = 0..N (l = 0 only in 1-D).
   pure subroutine evaluate_on_grid(self, intervals, values)
      class(fourier_series), intent(in) :: self
      integer, intent(in) :: intervals                     !! N >= 1
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (0:N, 0:N) or (0:N, 0:0)

      real(dp) :: half_way(0:intervals, 0:ubound(self%c, 2))
      integer :: m, n, rows, columns

      m = size(self%c, 1)
      n = size(self%c, 2)
      rows = intervals + 1
      columns = merge(rows, 1, n > 1)
      allocate (values(0:rows - 1, 0:columns - 1))
      call dgemm('N', 'N', rows, n, m, 1.0_dp, cosine_table(intervals, m - 1), rows, self%c, m, 0.0_dp, half_way, rows)
      call dgemm('N', 'T', rows, columns, n, 1.0_dp, half_way, rows, cosine_table(intervals, n - 1), rows, &
                 0.0_dp, values, rows)
   end subroutine evaluate_on_grid

   !> sum_i c_i cos(i x) and its derivative.
   pure subroutine evaluate_line(c, x, value, slope)
      real(dp), intent(in) :: c(0:)             !! shape (0:n)
      real(dp), intent(in) :: x                 !! [rad]
      real(dp), intent(out) :: value, slope

      complex(dp) :: turn, phase
      integer :: i

      turn = cmplx(cos(x), sin(x), dp)
      phase = (1.0_dp, 0.0_dp)
      value = c(0)
      slope = 0.0_dp
      do i = 1, ubound(c, 1)
         phase = phase*turn
         value = value + c(i)*real(phase)
         slope = slope - i*c(i)*aimag(phase)
      end do
   end subroutine evaluate_line

   !> A series with each term multiplied by the stiffness of its wave, or divided by it, or without a kernel multiplied
   !> by the square of its frequency, one over its wavelength; the mean becomes 0.
   pure type(fourier_series) function weighted(series, length, kernel, divides)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: length(2)   !! sides of the cell along x and y, > 0
      type(wave_stiffness), intent(in), optional :: kernel
      logical, intent(in), optional :: divides   !! by the stiffness

      real(dp) :: weight(lbound(series%c, 1):ubound(series%c, 1))
      integer :: i, j

      weighted = series
      do j = 0, ubound(series%c, 2)
         weight = ([(i, i=lbound(series%c, 1), ubound(series%c, 1))]/length(1))**2 + (j/length(2))**2
         if (present(kernel)) call kernel%of(weight)
         if (present(divides)) where (weight > 0.0_dp) weight = 1.0_dp/weight
         weighted%c(:, j) = weight*series%c(:, j)
         if (series%is_even()) cycle
         weighted%cs(:, j) = weight*series%cs(:, j)
         weighted%sc(:, j) = weight*series%sc(:, j)
         weighted%ss(:, j) = weight*series%ss(:, j)
      end do
   end function weighted

   !> A series divided by a number; unchanged if that is 0.
   pure type(fourier_series) function divided(series, unit)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: unit

      divided = series
      if (abs(unit) > 0.0_dp) call divide_series(divided, unit)
   end function divided

   !> Divides a series by a number in place.
   pure subroutine divide_series(series, unit)
      type(fourier_series), intent(inout) :: series
      real(dp), intent(in) :: unit   !! not 0

      series%c = series%c/unit
      if (series%is_even()) return
      series%cs = series%cs/unit
      series%sc = series%sc/unit
      series%ss = series%ss/unit
   end subroutine divide_series

end module wavycon_fourier_series
