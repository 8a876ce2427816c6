!> Periodic fields as Fourier series in two angles: surfaces, pressures and displacements.
module wavycon_fourier_series
   use wavycon_cosine_table, only: cosine_table
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: fourier_series, divide_series, evaluate_line, turn, weighted

   !> f(X, Y) = Re sum_kl W_kl exp(i (kX + lY)), k = 0..m, l = -n..n; in 1-D l = 0 only. For k = 0 the terms of l and -l
   !> are the same wave: half of its amplitude is W_0l, the other half the conjugate W_0,-l.
   !>
   !> An even field, f(-X, Y) = f(X, -Y) = f(X, Y), is f = sum_kl c_kl cos kX cos lY, k, l >= 0. Its waves are real,
   !> W_k,-l = W_kl = c_kl/2 for l > 0 and W_k0 = c_k0, and only the c_kl are stored.
   type :: fourier_series
      real(dp), allocatable :: c(:, :)         !! c_kl of an even field, shape (0:m, 0:n)
      complex(dp), allocatable :: wave(:, :)   !! W_kl of any other field, shape (0:m, -n:n)
      !> How a series is distributed over processes (ranks, see wavycon_grid_transform). A rank has some wave numbers k,
      !> its own ones; here they are columns, k is column k + 1. A series that is not distributed has the default.
      type(grid_slab) :: rows
   contains
      procedure :: is_even, first, last, row, frequencies, multiply, set_mean
      procedure :: add_wave, parallel_slopes, at, on_line, evaluate_on_grid, gather
   end type fourier_series

   !> The largest slope along the crests, over that across them (root mean squares), for which crests count as parallel.
   real(dp), parameter :: slope_along = 0.02_dp

contains

   !> Whether the series is stored as that of an even field; also if there is no series.
   pure logical function is_even(self)
      class(fourier_series), intent(in) :: self

      is_even = .not. allocated(self%wave)
   end function is_even

   !> The first wave number in X that this rank has.
   pure integer function first(self)
      class(fourier_series), intent(in) :: self

      first = 0
      if (allocated(self%c)) first = lbound(self%c, 1)
      if (allocated(self%wave)) first = lbound(self%wave, 1)
   end function first

   !> The last wave number in X that this rank has, or the last one in Y; -1 if there is no series.
   elemental integer function last(self, way)
      class(fourier_series), intent(in) :: self
      integer, intent(in) :: way   !! axis: 1 for X, 2 for Y

      last = -1
      if (allocated(self%c)) last = ubound(self%c, way)
      if (allocated(self%wave)) last = ubound(self%wave, way)
   end function last

   !> W_kl for one l and all k from first() to a given one.
   pure function row(self, l, highest) result(waves)
      class(fourier_series), intent(in) :: self
      integer, intent(in) :: l         !! wave number in Y, -last(2) .. last(2)
      integer, intent(in) :: highest   !! last k, at most last(1)
      complex(dp) :: waves(self%first():highest)

      if (.not. self%is_even()) then
         waves = self%wave(:highest, l)
      else if (l == 0) then
         waves = self%c(:highest, 0)
      else
         waves = 0.5_dp*self%c(:highest, abs(l))
      end if
   end function row

   !> The frequency of each wave, one over its wavelength [1/length]. The waves (k, l) and (k, -l) have the same one.
   pure function frequencies(self, length) result(frequency)
      class(fourier_series), intent(in) :: self
      real(dp), intent(in) :: length(2)   !! sides of the cell along x and y, > 0
      real(dp) :: frequency(self%first():self%last(1), 0:self%last(2))

      integer :: k, l

      do l = 0, self%last(2)
         frequency(:, l) = hypot([(k/length(1), k=self%first(), self%last(1))], l/length(2))
      end do
   end function frequencies

   !> Multiplies each wave by a factor, which is the same for (k, l) and (k, -l).
   pure subroutine multiply(self, factor)
      class(fourier_series), intent(inout) :: self
      real(dp), intent(in) :: factor(:, 0:)   !! factor of each k and |l|, shape of `frequencies`

      integer :: l

      do l = -self%last(2), self%last(2)
         if (.not. self%is_even()) self%wave(:, l) = factor(:, abs(l))*self%wave(:, l)
      end do
      if (self%is_even()) self%c = factor*self%c
   end subroutine multiply

   !> Sets the mean of the field. Ranks that do not have the wave number 0 do nothing.
   pure subroutine set_mean(self, mean)
      class(fourier_series), intent(inout) :: self
      real(dp), intent(in) :: mean

      if (self%first() > 0) return
      if (allocated(self%c)) self%c(0, 0) = mean
      if (allocated(self%wave)) self%wave(0, 0) = mean
   end subroutine set_mean

   !> Adds Re w exp(i (kX + lY)) to a series that is not even.
   pure subroutine add_wave(self, k, l, w)
      class(fourier_series), intent(inout) :: self
      integer, intent(in) :: k, l      !! wave numbers, not both zero; this rank has k
      complex(dp), intent(in) :: w     !! complex amplitude

      if (k > 0) then
         self%wave(k, l) = self%wave(k, l) + w
      else
         self%wave(0, l) = self%wave(0, l) + 0.5_dp*w
         self%wave(0, -l) = self%wave(0, -l) + 0.5_dp*conjg(w)
      end if
   end subroutine add_wave

   !> The sizes of the slopes along X and Y, sums over the waves of k^2 |W_kl|^2 and l^2 |W_kl|^2 to the power 1/2, if
   !> the crests of all waves are parallel, or nearly: (C15d) of src/core/contact/README.md. Otherwise 0.
   function parallel_slopes(self, length) result(slopes)
      class(fourier_series), intent(in) :: self
      real(dp), intent(in) :: length(2)   !! sides of the cell along x and y, > 0
      real(dp) :: slopes(2)

      real(dp) :: moments(3), powers(self%first():self%last(1)), scale(2), sums(3, self%first():self%last(1))
      complex(dp) :: waves(self%first():self%last(1))
      integer :: k, l

      sums = 0.0_dp
      do l = -self%last(2), self%last(2)
         waves = self%row(l, self%last(1))
         powers = waves%re**2 + waves%im**2
         if (self%first() == 0) powers(0) = 2*powers(0)   ! two halves of one wave
         do k = self%first(), self%last(1)
            sums(:, k) = sums(:, k) + powers(k)*real([k, l, k], dp)*[k, l, l]
         end do
      end do
      moments = self%rows%column_totals(sums)
      slopes = sqrt(moments(:2))
      ! For parallel crests the third moment is the root of the product of the other two. Sides are taken over the
      ! smaller one, so that products neither overflow nor underflow, whatever the unit of length is.
      scale = minval(length)/length
      moments = moments*[scale**2, product(scale)]
      if (product(moments(:2)) - moments(3)**2 > (slope_along*sum(moments(:2)))**2) slopes = 0.0_dp
   end function parallel_slopes

   !> exp(i angle).
   elemental complex(dp) function turn(angle)
      real(dp), intent(in) :: angle   !! [rad]

      turn = exp(cmplx(0.0_dp, angle, dp))
   end function turn

   !> The field at a point.
   pure real(dp) function at(self, x, y)
      class(fourier_series), intent(in) :: self   !! not distributed
      real(dp), intent(in) :: x, y   !! X, Y [rad]

      integer :: k, l

      associate (turn_x => turn([(k*x, k=0, self%last(1))]), turn_y => turn([(l*y, l=0, self%last(2))]))
         if (self%is_even()) then
            at = dot_product(matmul(self%c, real(turn_y)), real(turn_x))
         else
            at = real(sum(turn_x*matmul(self%wave, [conjg(turn_y(size(turn_y):2:-1)), turn_y])))
         end if
      end associate
   end function at

   !> The field along a line, X = X_0 + d_x t, Y = Y_0 + d_y t. On the line a wave has the wave number d_x k + d_y l.
   !> Waves of the same number are added first, so that each point needs only a sum over one index.
   pure function on_line(self, start, direction, t) result(values)
      class(fourier_series), intent(in) :: self   !! not distributed
      real(dp), intent(in) :: start(2)       !! X_0, Y_0 [rad]
      integer, intent(in) :: direction(2)    !! d_x, d_y >= 0
      real(dp), intent(in) :: t(:)           !! coordinates of the points along the line [rad]
      real(dp) :: values(size(t))

      complex(dp), allocatable :: along(:)   ! amplitudes by wave number along the line
      complex(dp) :: phase, step, turn_x(0:self%last(1)), waves(0:self%last(1))
      integer :: i, k, l, n

      n = dot_product(direction, self%last([1, 2]))
      allocate (along(-n:n), source=(0.0_dp, 0.0_dp))
      turn_x = turn([(k*start(1), k=0, self%last(1))])
      do l = -self%last(2), self%last(2)
         waves = self%row(l, self%last(1))*turn_x*turn(l*start(2))
         do k = 0, self%last(1)
            n = direction(1)*k + direction(2)*l
            along(n) = along(n) + waves(k)
         end do
      end do
      do i = 1, size(t)
         phase = turn(lbound(along, 1)*t(i))
         step = turn(t(i))
         values(i) = 0.0_dp
         do n = lbound(along, 1), ubound(along, 1)
            values(i) = values(i) + real(along(n)*phase)
            phase = phase*step
         end do
      end do
   end function on_line

   !> An even field on a quarter of the cell, at X = pi k/N, Y = pi l/N, k, l = 0..N (l = 0 only in 1-D): two products
   !> of matrices with a table of cosines.
   pure subroutine evaluate_on_grid(self, intervals, values)
      class(fourier_series), intent(in) :: self
      integer, intent(in) :: intervals                     !! N >= 1
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (0:N, 0:N) or (0:N, 0:0)

      real(dp) :: half_way(0:intervals, 0:ubound(self%c, 2))   ! values at X, coefficients along Y
      integer :: m, n, rows, columns

      m = size(self%c, 1)
      n = size(self%c, 2)
      rows = intervals + 1
      columns = 1
      if (n > 1) columns = rows
      allocate (values(0:rows - 1, 0:columns - 1))
      call dgemm('N', 'N', rows, n, m, 1.0_dp, cosine_table(intervals, m - 1), rows, self%c, m, 0.0_dp, half_way, rows)
      call dgemm('N', 'T', rows, columns, n, 1.0_dp, half_way, rows, cosine_table(intervals, n - 1), rows, &
                 0.0_dp, values, rows)
   end subroutine evaluate_on_grid

   !> Gathers a distributed series on rank 0, which writes the tables, or on all ranks. On ranks that do not get the
   !> whole series it does not change.
   subroutine gather(self, first_only)
      class(fourier_series), intent(inout) :: self
      logical, intent(in) :: first_only   !! whether rank 0 alone gets the whole series

      real(dp), allocatable :: own(:, :), whole(:, :)   ! real parts of the waves, and then the imaginary ones
      integer :: last, numbers

      if (.not. self%rows%any(self%rows%is_distributed .and. self%rows%first == 1)) return
      last = self%last(2)
      numbers = 2*last + 1
      if (self%is_even()) then
         own = transpose(self%c)
      else
         own = transpose(reshape([self%wave%re, self%wave%im], [size(self%wave, 1), 2*numbers]))
      end if
      call self%rows%gather_whole(own, whole, first_only)
      if (.not. allocated(whole)) return
      self%rows = grid_slab()
      if (self%is_even()) then
         deallocate (self%c)
         allocate (self%c(0:size(whole, 2) - 1, 0:last), source=transpose(whole))
      else
         deallocate (self%wave)
         allocate (self%wave(0:size(whole, 2) - 1, -last:last), &
                   source=transpose(cmplx(whole(:numbers, :), whole(numbers + 1:, :), dp)))
      end if
   end subroutine gather

   !> The value of sum_i c_i cos(i x) and its derivative with respect to x.
   pure subroutine evaluate_line(c, x, value, slope)
      real(dp), intent(in) :: c(0:)             !! coefficients, shape (0:n)
      real(dp), intent(in) :: x                 !! angle [rad]
      real(dp), intent(out) :: value, slope

      complex(dp) :: turn, phase   ! e^(ix), e^(i k x)
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

   !> A series in which each wave is multiplied by its stiffness, or divided by the stiffness. Without a kernel the
   !> square of the frequency, which is one over the wavelength, takes the place of the stiffness. The mean becomes 0.
   pure type(fourier_series) function weighted(series, length, kernel, divides)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: length(2)   !! sides of the cell along x and y, > 0
      type(wave_stiffness), intent(in), optional :: kernel   !! stiffness of the waves
      logical, intent(in), optional :: divides   !! whether the waves are divided; .false. if absent

      real(dp) :: factor(series%first():series%last(1), 0:series%last(2))
      integer :: k, l

      do l = 0, series%last(2)
         factor(:, l) = [((k/length(1))**2 + (l/length(2))**2, k=series%first(), series%last(1))]
         if (present(kernel)) call kernel%of(factor(:, l))
      end do
      if (present(divides)) then
         where (divides .and. factor > 0.0_dp) factor = 1.0_dp/factor
      end if
      weighted = series
      call weighted%multiply(factor)
   end function weighted

   !> Divides all coefficients of a series by a number, in place.
   pure subroutine divide_series(series, unit)
      type(fourier_series), intent(inout) :: series
      real(dp), intent(in) :: unit   !! divisor, not 0

      if (allocated(series%c)) series%c = series%c/unit
      if (allocated(series%wave)) series%wave = series%wave/unit
   end subroutine divide_series

end module wavycon_fourier_series
