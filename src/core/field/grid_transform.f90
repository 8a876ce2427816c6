!> Converts between the values of a field on the points of a grid and its Fourier series, by FFTW's transforms of
!> columns and rows. The grid may be distributed over processes, called ranks (`grid_slab`).
!>
!> The points are those of wavycon_grid_points. An even field on a quarter of its cell is a sum of cosines (DCT-II and
!> III), any other field a sum of complex waves. Columns are transformed along x, then rows of the spectrum along y. On
!> a distributed grid each rank has some columns of the field and, in the series, the coefficients of some wave numbers
!> in X, its own ones. The series then has the shape (first:last, :), and its component `rows` tells that the rank has
!> numbers first + 1 to last + 1 of all wave numbers in X. The digits of coefficients and values do not depend on how
!> the grid is distributed.
module wavycon_grid_transform
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_f_pointer, c_loc
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_line_plans, only: cosines_to_values, line_plan, plan_of_line, real_to_waves, values_to_cosines, &
      waves_backward, waves_forward, waves_to_real
   use wavycon_threads, only: threads_for
   use wavycon_wave_packing, only: give_cosines, give_waves, take_cosines, take_waves
   implicit none (type, external)
   private

   public :: grid_transform

   type :: grid_transform
      integer :: points(2) = 0       !! M, N
      logical :: even = .true.       !! whether the points are those of a quarter of an even field's cell
      type(grid_slab) :: slab        !! columns of the grid that this rank has
      integer, private :: waves = 0     !! number of wave numbers in X that the points determine
      integer, private :: numbers = 0   !! real numbers for an element of the spectrum: cosine 1, complex wave 2
   contains
      procedure :: start, new_series, series, sample, sample_waves, sum_along_y, sample_columns
   end type grid_transform

   !> Number of rows of the spectrum that are copied at a time, and of elements of each of them, so that copies use
   !> whole lines of the processor's cache on both sides. On 1024 x 1024 points 16 and 8 rows took 1.03 and 1.10 times
   !> as long. With whole rows in place of 8 elements of each, full contact on 4096 x 4096 points took 1.2 times as
   !> long, the copies three times. The numbers change no digit.
   integer, parameter :: block_rows = 32, block_elements = 8
   !> Unused numbers between these rows in memory. Without them elements of rows whose length is a power of two would
   !> compete for the same place in the cache, and the transform of 1024 x 1024 points takes 1.4 times as long.
   integer, parameter :: row_space = 8

contains

   !> Sets the points of the grid and distributes it.
   subroutine start(self, points, even, whole)
      class(grid_transform), intent(out) :: self
      integer, intent(in) :: points(2)         !! M, N >= 1
      logical, intent(in) :: even              !! whether the points are those of a quarter of an even field's cell
      logical, intent(in), optional :: whole   !! whether the grid stays whole, however large it is; default: .false.

      self%points = points
      self%even = even
      self%waves = merge(points(1), points(1)/2 + 1, even)
      self%numbers = merge(1, 2, even)
      call self%slab%start(points, whole)
   end subroutine start

   !> Makes a series of zeros with the coefficients that the points determine, on this rank those of its own wave
   !> numbers.
   subroutine new_series(self, answer)
      class(grid_transform), intent(in) :: self
      type(fourier_series), intent(out) :: answer    !! distributed if the grid is

      call answer%rows%start([1, self%waves], whole=.true.)
      if (self%slab%is_distributed) call answer%rows%divide([1, self%waves])
      associate (first => answer%rows%first - 1, last => answer%rows%last - 1, n => self%points(2))
         if (self%even) then
            allocate (answer%c(first:last, 0:n - 1), source=0.0_dp)
         else
            allocate (answer%wave(first:last, -(n/2):n/2), source=(0.0_dp, 0.0_dp))
         end if
      end associate
   end subroutine new_series

   !> Computes the series that interpolates a field at the points: transforms own columns, exchanges them for own rows
   !> if the grid is distributed, transforms rows, and scales the coefficients.
   subroutine series(self, field, answer)
      class(grid_transform), intent(in) :: self
      real(dp), intent(in) :: field(:, :)            !! shape (M, slab%columns())
      type(fourier_series), intent(out) :: answer    !! distributed if the grid is

      real(dp), allocatable :: own_rows(:, :, :), spectrum(:, :, :)

      call assert(all(shape(field) == [self%points(1), self%slab%columns()]), 'the field has the columns of the slab')
      call self%new_series(answer)
      allocate (spectrum(self%numbers, self%waves, self%slab%columns()))
      call columns_to_waves(self, field, spectrum)
      if (self%slab%is_distributed) then
         allocate (own_rows(self%numbers, answer%last(1) - answer%first() + 1, self%points(2)))
         call self%slab%exchange_rows(answer%rows, 8*self%numbers, spectrum, own_rows, to_rows=.true.)
         call move_alloc(own_rows, spectrum)
      end if
      call transform_rows(self%even, spectrum, forwards=.true.)
      if (self%even) then
         call take_cosines(self%points, spectrum, answer)
      else
         call take_waves(self%points, spectrum, answer)
      end if
   end subroutine series

   !> Computes the values of a series at the points. Waves whose wave numbers exceed those of the grid are left out.
   subroutine sample(self, from, field)
      class(grid_transform), intent(in) :: self
      type(fourier_series), intent(in) :: from                !! must be even if the points are those of a quarter
      real(dp), intent(out), contiguous :: field(:, :)        !! shape (M, slab%columns())

      real(dp), allocatable :: own_columns(:, :, :), own_values(:, :)
      real(dp), allocatable, target :: spectrum(:, :, :)
      complex(c_double_complex), pointer :: waves(:, :)
      type(grid_slab) :: kept   ! columns that this rank has after the exchange
      integer :: carried, rows  ! own wave numbers in X that the grid has too; rows of the own spectrum

      call assert(all(shape(field) == [self%points(1), self%slab%columns()]), 'the field has the columns of the slab')
      carried = max(min(self%waves - 1, from%last(1)) - from%first() + 1, 0)
      rows = carried
      ! For the exchange the rows must be all own wave numbers of the series.
      if (from%rows%is_distributed) rows = from%last(1) - from%first() + 1
      allocate (spectrum(self%numbers, rows, self%points(2)))
      spectrum(:, carried + 1:, :) = 0.0_dp
      if (self%even) then
         call give_cosines(self%points, from, spectrum(:, :carried, :))
      else
         call c_f_pointer(c_loc(spectrum), waves, [size(spectrum, 2), size(spectrum, 3)])
         call give_waves(self%points, from, waves(:carried, :))
      end if
      call transform_rows(self%even, spectrum(:, :carried, :), forwards=.false.)
      if (.not. from%rows%is_distributed) then
         call waves_to_columns(self, size(spectrum, 2), spectrum(:, :, self%slab%first:self%slab%last), field)
         return
      end if
      kept = self%slab
      if (.not. kept%is_distributed) call kept%divide(self%points)
      allocate (own_columns(self%numbers, from%rows%points(2), kept%columns()))
      call kept%exchange_rows(from%rows, 8*self%numbers, own_columns, spectrum, to_rows=.false.)
      if (self%slab%is_distributed) then
         call waves_to_columns(self, from%rows%points(2), own_columns, field)
      else
         allocate (own_values(self%points(1), kept%columns()))
         call waves_to_columns(self, from%rows%points(2), own_columns, own_values)
         call kept%gather(8*self%points(1), own_values, field, first_only=.false.)
      end if
   end subroutine sample

   !> Computes the values of a spectrum at the points of a whole cell, on a grid that is not distributed:
   !> f = sum_kl w_kl e^(i(kX + lY)), k = -M/2 .. M/2, l = 0 .. N - 1, where w_-k,N-l is the conjugate of w_kl.
   subroutine sample_waves(self, waves, field)
      class(grid_transform), intent(in) :: self                 !! self%even is .false.
      !> w_kl, k = 0 .. M/2, shape (M/2 + 1, N); overwritten.
      complex(c_double_complex), intent(inout), contiguous, target :: waves(:, :)
      real(dp), intent(out), contiguous :: field(:, :)          !! shape (M, N)

      call assert(all(shape(field) == self%points) .and. .not. self%even, 'the field is that of a whole cell')
      call self%sum_along_y(waves)
      call self%sample_columns(waves, field)
   end subroutine sample_waves

   !> First half of `sample_waves`: replaces the waves by the sums over l, sum_l w_kl e^(ilY_j).
   subroutine sum_along_y(self, waves)
      class(grid_transform), intent(in) :: self
      !> On entry w_kl of some wave numbers k, on return their sums at Y_j, shape (any, N).
      complex(c_double_complex), intent(inout), contiguous, target :: waves(:, :)

      real(dp), pointer :: spectrum(:, :, :)

      call assert(size(waves, 2) == self%points(2), 'there are waves of all l')
      call c_f_pointer(c_loc(waves), spectrum, [2, shape(waves)])
      call transform_rows(.false., spectrum, forwards=.false.)
   end subroutine sum_along_y

   !> Second half of `sample_waves`: computes the values in some columns from the sums of these columns.
   subroutine sample_columns(self, sums, values)
      class(grid_transform), intent(in) :: self
      complex(c_double_complex), intent(in), contiguous, target :: sums(:, :)   !! k = 0 .. M/2, shape (M/2 + 1, any)
      real(dp), intent(out) :: values(:, :)                                     !! shape (M, any)

      real(dp), pointer :: spectrum(:, :)

      call c_f_pointer(c_loc(sums), spectrum, [2*size(sums, 1), size(sums, 2)])
      call waves_to_columns(self, size(sums, 1), spectrum, values)
   end subroutine sample_columns

   !> Transforms columns along x: sum_i f_i e^(-ikX_i), k = 0 .. M/2, or twice sum_i f_i cos kX_i, k = 0 .. M - 1.
   subroutine columns_to_waves(self, field, spectrum)
      type(grid_transform), intent(in) :: self
      real(dp), intent(in) :: field(:, :)   !! own columns, shape (M, slab%columns())
      !> Each column has the real numbers of the waves, real and imaginary parts of complex ones one after the other.
      real(dp), intent(inout) :: spectrum(self%numbers*self%waves, size(field, 2))

      ! Columns are copied to arrays of their own, here and below, because FFTW's arrays must be aligned.
      real(dp), allocatable :: values(:), waves(:)
      type(line_plan) :: plan
      integer :: j

      plan = plan_of_line(merge(values_to_cosines, real_to_waves, self%even), self%points(1), dp)
      !$omp parallel num_threads(threads_for(size(field))) private(values, waves)
      allocate (values(self%points(1)), waves(self%numbers*self%waves))
      !$omp do schedule(static)
      do j = 1, size(field, 2)
         values = field(:, j)
         call plan%execute(plan%plan, values, waves)
         spectrum(:, j) = waves
      end do
      !$omp end do
      !$omp end parallel
   end subroutine columns_to_waves

   !> Transforms waves back to columns along x, the inverse of `columns_to_waves` times M, or times 2M for cosines. Wave
   !> numbers that the spectrum does not have count as zero, and those that the grid does not have are left out.
   subroutine waves_to_columns(self, waves_of_column, spectrum, field)
      type(grid_transform), intent(in) :: self
      integer, intent(in) :: waves_of_column   !! number of wave numbers in X of the spectrum
      real(dp), intent(out) :: field(:, :)     !! columns, shape (M, any)
      real(dp), intent(in) :: spectrum(self%numbers*waves_of_column, size(field, 2))

      real(dp), allocatable :: values(:), waves(:)
      type(line_plan) :: plan
      integer :: j, number

      number = self%numbers*min(self%waves, waves_of_column)
      plan = plan_of_line(merge(cosines_to_values, waves_to_real, self%even), self%points(1), dp)
      !$omp parallel num_threads(threads_for(size(field))) private(values, waves)
      allocate (values(self%points(1)), waves(self%numbers*self%waves))
      !$omp do schedule(static)
      do j = 1, size(field, 2)
         waves(:number) = spectrum(:number, j)
         waves(number + 1:) = 0.0_dp
         call plan%execute(plan%plan, waves, values)
         field(:, j) = values
      end do
      !$omp end do
      !$omp end parallel
   end subroutine waves_to_columns

   !> Transforms the rows of the spectrum along y, in place: from points to waves or back. A block of rows at a time is
   !> copied into an array in which each row is contiguous.
   subroutine transform_rows(even, spectrum, forwards)
      logical, intent(in) :: even                    !! whether the rows are sums of cosines, otherwise of waves
      !> Shape (1 or 2 real numbers for an element, wave numbers in X, points or wave numbers in Y).
      real(dp), intent(inout) :: spectrum(:, :, :)
      logical, intent(in) :: forwards                !! whether from points to waves

      real(dp), allocatable :: block(:, :), line(:)
      type(line_plan) :: plan
      integer :: i, j, k, last, r

      associate (numbers => size(spectrum, 1), n => size(spectrum, 3), rows => min(block_rows, size(spectrum, 2)))
         if (even) then
            plan = plan_of_line(merge(values_to_cosines, cosines_to_values, forwards), n, dp)
         else
            plan = plan_of_line(merge(waves_forward, waves_backward, forwards), n, dp)
         end if
         !$omp parallel num_threads(threads_for(size(spectrum))) private(block, line, i, j, last, r)
         allocate (block(numbers*(n + modulo(n, 2) + row_space), rows), line(numbers*n))
         !$omp do schedule(static)
         do k = 1, size(spectrum, 2), block_rows
            last = min(k + block_rows - 1, size(spectrum, 2))
            do j = 1, n, block_elements
               do r = 1, last - k + 1
                  do i = j, min(j + block_elements - 1, n)
                     block(numbers*(i - 1) + 1, r) = spectrum(1, k + r - 1, i)
                     block(numbers*i, r) = spectrum(numbers, k + r - 1, i)
                  end do
               end do
            end do
            do r = 1, last - k + 1
               call plan%execute(plan%plan, block(:, r), line)
               block(:numbers*n, r) = line
            end do
            do j = 1, n, block_elements
               do r = 1, last - k + 1
                  do i = j, min(j + block_elements - 1, n)
                     spectrum(1, k + r - 1, i) = block(numbers*(i - 1) + 1, r)
                     spectrum(numbers, k + r - 1, i) = block(numbers*i, r)
                  end do
               end do
            end do
         end do
         !$omp end do
         !$omp end parallel
      end associate
   end subroutine transform_rows

end module wavycon_grid_transform
