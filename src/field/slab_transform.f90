!> Fourier series of fields on grids that may be spread over the ranks.
!>
!> The points, and the coefficients and values of a series, are those of wavycon_grid_transform. Here columns are
!> transformed along x, then rows of the spectrum along y, by plans of single lines. Of a grid that is spread each rank
!> has the columns of its slab, and of the series the coefficients of some wave numbers in X: a series of the shape
!> c(first:last, 0:n), whose component `spread_waves` is the number of these rows on all ranks. The digits of the
!> coefficients and of the values do not depend on the number of ranks.
module wavycon_slab_transform
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_ptr
   use wavycon_assertion, only: assert
   use wavycon_fftw, only: fftw_execute_dft, fftw_execute_dft_c2r, fftw_execute_dft_r2c, fftw_execute_r2r
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_line_plans, only: cosines_to_values, plan_of_line, real_to_waves, values_to_cosines, waves_backward, &
      waves_forward, waves_to_real
   use wavycon_ranks, only: any_rank, gather_columns, new_row_exchange, ranks_at_work, row_exchange, this_rank
   use wavycon_wave_packing, only: allocate_series, give_cosines, give_waves, take_cosines, take_waves
   implicit none (type, external)
   private

   public :: slab_transform, gather_series

   type :: slab_transform
      integer :: points(2) = 0       !! M, N
      logical :: even = .true.       !! whether the points are those of a quarter of an even field's cell
      type(grid_slab) :: slab        !! of the points
   contains
      procedure :: start
      procedure :: waves_x
      procedure :: rows_of_waves
      procedure :: series
      procedure :: sample
   end type slab_transform

   !> Rows of the spectrum that are copied at a time, so that copies fill lines of the processor's cache.
   integer, parameter :: block_rows = 8

contains

   subroutine start(self, points, even)
      class(slab_transform), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N >= 1
      logical, intent(in) :: even

      self%points = points
      self%even = even
      call self%slab%start(points)
   end subroutine start

   !> The number of wave numbers in X that the points determine.
   pure integer function waves_x(self)
      class(slab_transform), intent(in) :: self

      waves_x = merge(self%points(1), self%points(1)/2 + 1, self%even)
   end function waves_x

   !> The wave numbers in X whose coefficients this rank has: first to last, last = first - 1 for none.
   subroutine rows_of_waves(self, first, last)
      class(slab_transform), intent(in) :: self
      integer, intent(out) :: first, last

      class(row_exchange), allocatable :: exchange

      first = 0
      last = self%waves_x() - 1
      if (.not. self%slab%is_spread) return
      call new_row_exchange(self%points(2), self%waves_x(), self%slab%width, 1, dp, exchange)
      first = exchange%first_row - 1
      last = first + exchange%own_rows - 1
   end subroutine rows_of_waves

   !> The series that interpolates a field at the points. All ranks call this.
   subroutine series(self, field, answer)
      class(slab_transform), intent(in) :: self
      real(dp), intent(in) :: field(:, :)            !! shape (M, slab%columns())
      type(fourier_series), intent(out) :: answer    !! spread if the grid is

      real(c_double), allocatable :: block(:, :, :), own_rows(:, :, :), spectrum(:, :, :)
      class(row_exchange), allocatable :: exchange
      integer :: first, j, k, last, number, rows

      call assert(all(shape(field) == [self%points(1), self%slab%columns()]), 'the field has the columns of the slab')
      rows = self%waves_x()
      allocate (spectrum(numbers(self%even), rows, self%slab%columns()))
      call columns_to_waves(self, field, spectrum)
      first = 0
      last = rows - 1
      if (self%slab%is_spread) then
         call new_row_exchange(self%points(2), rows, self%slab%width, numbers(self%even), dp, exchange)
         allocate (own_rows(numbers(self%even), exchange%own_rows, self%points(2)))
         call exchange%to_rows(spectrum, own_rows)
         call move_alloc(own_rows, spectrum)
         first = exchange%first_row - 1
         last = first + exchange%own_rows - 1
         answer%spread_waves = rows
      end if
      call allocate_series(answer, first, last, merge(self%points(2) - 1, self%points(2)/2, self%even), self%even)
      allocate (block(numbers(self%even), self%points(2), block_rows))
      do k = first, last, block_rows
         number = min(block_rows, last - k + 1)
         do j = 1, self%points(2)
            block(:, j, :number) = spectrum(:, k - first + 1:k - first + number, j)
         end do
         call transform_rows(self%even, block(:, :, :number), forwards=.true.)
         if (self%even) then
            call take_cosines(self%points, block(:, :, :number), k, answer)
         else
            call take_waves(self%points, block(:, :, :number), k, answer)
         end if
      end do
   end subroutine series

   !> The values of a series at the points. Waves beyond the grid's highest wave number are left out. All ranks call
   !> this, if the grid or the series is spread.
   !>
   !> With `power` each harmonic is first multiplied by that power of its frequency, the root of the sum of the squares
   !> of its wave numbers times `per_wave`, and the mean becomes 0.
   subroutine sample(self, from, field, power, per_wave)
      class(slab_transform), intent(in) :: self
      type(fourier_series), intent(in) :: from                !! even, if the points are those of a quarter
      real(dp), intent(out), contiguous :: field(:, :)        !! shape (M, slab%columns())
      integer, intent(in), optional :: power                  !! not 0
      real(dp), intent(in), optional :: per_wave(2)           !! with power

      real(c_double), allocatable :: block(:, :, :), own_columns(:, :, :), spectrum(:, :, :)
      class(row_exchange), allocatable :: exchange
      integer :: columns, first, first_column, j, k, last, number, rows, width

      call assert(all(shape(field) == [self%points(1), self%slab%columns()]), 'the field has the columns of the slab')
      first = lbound(from%c, 1)
      last = min(highest_x(self), ubound(from%c, 1))
      first_column = self%slab%first
      columns = self%slab%columns()
      rows = last + 1
      if (from%is_spread()) then
         ! A small grid that is whole on each rank: each computes some columns.
         width = merge(self%slab%width, (self%points(2) - 1)/ranks_at_work() + 1, self%slab%is_spread)
         rows = from%spread_waves
         call new_row_exchange(self%points(2), rows, width, numbers(self%even), dp, exchange)
         call assert(size(from%c, 1) == exchange%own_rows, 'the series is spread over the same ranks')
         first_column = 1
         columns = self%points(2)
         allocate (spectrum(numbers(self%even), exchange%own_rows, columns), source=0.0_dp)
      else
         allocate (spectrum(numbers(self%even), rows, columns))
      end if
      allocate (block(numbers(self%even), self%points(2), block_rows))
      do k = first, last, block_rows
         number = min(block_rows, last - k + 1)
         if (self%even) then
            call give_cosines(self%points, from, k, block(:, :, :number), power, per_wave)
         else
            call give_waves(self%points, from, k, block(:, :, :number), power, per_wave)
         end if
         call transform_rows(self%even, block(:, :, :number), forwards=.false.)
         do j = 1, columns
            spectrum(:, k - first + 1:k - first + number, j) = block(:, first_column - 1 + j, :number)
         end do
      end do
      if (allocated(exchange)) then
         columns = exchange%own_columns
         allocate (own_columns(numbers(self%even), rows, columns))
         call exchange%to_columns(spectrum, own_columns)
         call move_alloc(own_columns, spectrum)
      end if
      if (allocated(exchange) .and. .not. self%slab%is_spread) then
         call gather_values(self, spectrum, min(rows - 1, highest_x(self)), width, columns, field)
      else
         call waves_to_columns(self, spectrum, min(rows - 1, highest_x(self)), field)
      end if
   end subroutine sample

   !> Makes a spread series whole on the first rank, or on all; other ranks keep theirs. All ranks call this;
   !> nothing happens if the first rank has the whole series.
   subroutine gather_series(series, first_only)
      type(fourier_series), intent(inout) :: series
      logical, intent(in) :: first_only

      if (.not. any_rank(this_rank() == 0 .and. series%is_spread())) return
      call gather_array(series%c)
      if (.not. series%is_even()) then
         call gather_array(series%cs)
         call gather_array(series%sc)
         call gather_array(series%ss)
      end if
      if (this_rank() == 0 .or. .not. first_only) series%spread_waves = 0

   contains

      subroutine gather_array(values)
         real(dp), allocatable, intent(inout) :: values(:, :)

         real(dp), allocatable :: own(:, :), whole(:, :)
         integer :: rank, width
         logical :: is_wanted

         is_wanted = this_rank() == 0 .or. .not. first_only
         width = (series%spread_waves - 1)/ranks_at_work() + 1
         allocate (own, source=transpose(values))
         allocate (whole(size(values, 2), merge(series%spread_waves, 0, is_wanted)))
         call gather_columns([(max(0, min(series%spread_waves - rank*width, width)), rank=0, ranks_at_work() - 1)], &
                             own, whole, first_only)
         if (.not. is_wanted) return
         deallocate (values)
         allocate (values(0:size(whole, 2) - 1, 0:size(whole, 1) - 1), source=transpose(whole))
      end subroutine gather_array

   end subroutine gather_series

   !> The highest wave number in X that the points can carry.
   pure integer function highest_x(self)
      type(slab_transform), intent(in) :: self

      highest_x = self%waves_x() - 1
   end function highest_x

   !> Real numbers of an element of the spectrum.
   pure integer function numbers(even)
      logical, intent(in) :: even

      numbers = merge(1, 2, even)
   end function numbers

   !> Transforms columns along x: sum_i f_i e^(-ikX_i), k = 0 .. M/2, or twice sum_i f_i cos kX_i, k = 0 .. M - 1.
   subroutine columns_to_waves(self, field, spectrum)
      type(slab_transform), intent(in) :: self
      real(dp), intent(in) :: field(:, :)
      real(c_double), intent(inout) :: spectrum(:, :, :)

      complex(c_double_complex), allocatable :: waves(:)
      real(c_double), allocatable :: cosines(:), values(:)
      type(c_ptr) :: plan
      integer :: j

      associate (m => self%points(1))
         allocate (values(m), cosines(merge(m, 0, self%even)), waves(0:merge(0, m/2, self%even)))
         plan = plan_of_line(merge(values_to_cosines, real_to_waves, self%even), m, dp)
         do j = 1, size(field, 2)
            values = field(:, j)
            if (self%even) then
               call fftw_execute_r2r(plan, values, cosines)
               spectrum(1, :, j) = cosines
            else
               call fftw_execute_dft_r2c(plan, values, waves)
               spectrum(1, :, j) = real(waves)
               spectrum(2, :, j) = aimag(waves)
            end if
         end do
      end associate
   end subroutine columns_to_waves

   !> The inverse, times M or 2M, for wave numbers up to `last`.
   subroutine waves_to_columns(self, spectrum, last, field)
      type(slab_transform), intent(in) :: self
      real(c_double), intent(in) :: spectrum(:, :, :)
      integer, intent(in) :: last
      real(dp), intent(out) :: field(:, :)

      complex(c_double_complex), allocatable :: waves(:)
      real(c_double), allocatable :: cosines(:), values(:)
      type(c_ptr) :: plan
      integer :: j

      associate (m => self%points(1))
         allocate (values(m), cosines(merge(m, 0, self%even)), waves(0:merge(0, m/2, self%even)))
         plan = plan_of_line(merge(cosines_to_values, waves_to_real, self%even), m, dp)
         do j = 1, size(field, 2)
            if (self%even) then
               cosines(:last + 1) = spectrum(1, :last + 1, j)
               cosines(last + 2:) = 0.0_dp
               call fftw_execute_r2r(plan, cosines, values)
            else
               waves(:last) = cmplx(spectrum(1, :last + 1, j), spectrum(2, :last + 1, j), dp)
               waves(last + 1:) = 0.0_dp
               call fftw_execute_dft_c2r(plan, waves, values)
            end if
            field(:, j) = values
         end do
      end associate
   end subroutine waves_to_columns

   !> Transforms the columns that this rank has and gathers those of all ranks.
   subroutine gather_values(self, spectrum, last, width, columns, field)
      type(slab_transform), intent(in) :: self
      real(c_double), intent(in) :: spectrum(:, :, :)
      integer, intent(in) :: last, width, columns      !! highest wave number; columns of each rank; own ones
      real(dp), intent(out), contiguous :: field(:, :)

      real(dp), allocatable :: own(:, :)
      integer :: rank

      allocate (own(self%points(1), columns))
      call waves_to_columns(self, spectrum, last, own)
      call gather_columns([(max(0, min(self%points(2) - rank*width, width)), rank=0, ranks_at_work() - 1)], own, field, &
                          first_only=.false.)
   end subroutine gather_values

   !> Transforms rows along y, in place.
   subroutine transform_rows(even, block, forwards)
      logical, intent(in) :: even
      real(c_double), intent(inout) :: block(:, :, :)
      logical, intent(in) :: forwards

      complex(c_double_complex), allocatable :: line(:), waves(:)
      real(c_double), allocatable :: cosines(:), values(:)
      type(c_ptr) :: plan
      integer :: r

      associate (n => size(block, 2))
         if (even) then
            plan = plan_of_line(merge(values_to_cosines, cosines_to_values, forwards), n, dp)
            allocate (values(n), cosines(n))
            do r = 1, size(block, 3)
               values = block(1, :, r)
               call fftw_execute_r2r(plan, values, cosines)
               block(1, :, r) = cosines
            end do
         else
            plan = plan_of_line(merge(waves_forward, waves_backward, forwards), n, dp)
            allocate (line(n), waves(n))
            do r = 1, size(block, 3)
               line = cmplx(block(1, :, r), block(2, :, r), dp)
               call fftw_execute_dft(plan, line, waves)
               block(1, :, r) = real(waves)
               block(2, :, r) = aimag(waves)
            end do
         end if
      end associate
   end subroutine transform_rows

end module wavycon_slab_transform
