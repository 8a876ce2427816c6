!> Fourier transforms of fields on the points of a grid, by FFTW.
!>
!> An even field, f(-X, Y) = f(X, -Y) = f(X, Y), is given on a quarter of its cell: M x N points at
!> X = pi (i - 1/2)/M, Y = pi (j - 1/2)/N, and is a sum of cosines (DCT-II and III). Any other field is given at M x N
!> points of its whole cell, X = 2 pi (i - 1)/M, Y = 2 pi (j - 1)/N. N = 1 for a field in one dimension.
module wavycon_grid_transform
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_int, c_null_ptr, c_ptr
   use wavycon_constants, only: pi
   use wavycon_fftw, only: fftw_alignment_of, fftw_destroy_plan, FFTW_ESTIMATE, fftw_execute_dft_c2r, &
                           fftw_execute_dft_r2c, fftw_execute_r2r, fftw_plan_dft_c2r_2d, fftw_plan_dft_r2c_2d, &
                           fftw_plan_r2r_2d, FFTW_REDFT01, FFTW_REDFT10
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_transform, image_of_point, point_angle

   type :: grid_transform
      integer :: points(2) = 0                     !! M, N
      logical :: even = .true.
      real(dp) :: factor = 1.0_dp                  !! `forward` and then `backward` multiply a field by it
      integer, allocatable :: wave_x(:), wave_y(:) !! wave numbers of the spectrum's first and second index
      real(c_double), allocatable :: cosines(:, :)            !! spectrum of an even field, shape (M, N)
      complex(c_double_complex), allocatable :: waves(:, :)   !! spectrum of any other, shape (M/2 + 1, N)
      type(c_ptr), private :: forward_plan = c_null_ptr, backward_plan = c_null_ptr
   contains
      procedure :: start
      procedure :: forward
      procedure :: backward
      procedure :: series
      procedure :: sample
      procedure :: x_angle
      procedure :: y_angle
      final :: finish
   end type grid_transform

contains

   subroutine start(self, points, even)
      class(grid_transform), intent(inout) :: self   !! not started before
      integer, intent(in) :: points(2)               !! M, N >= 1
      logical, intent(in) :: even

      integer :: i

      self%points = points
      self%even = even
      associate (m => points(1), n => points(2))
         if (even) then
            self%factor = 4.0_dp*m*n
            self%wave_x = [(i, i=0, m - 1)]
            self%wave_y = [(i, i=0, n - 1)]
            allocate (self%cosines(m, n))
         else
            self%factor = real(m, dp)*n
            self%wave_x = [(i, i=0, m/2)]
            self%wave_y = [(merge(i, i - n, 2*i <= n), i=0, n - 1)]
            allocate (self%waves(m/2 + 1, n))
         end if
      end associate
   end subroutine start

   !> Transforms a field to its spectrum, `cosines` or `waves`.
   subroutine forward(self, field)
      class(grid_transform), intent(inout) :: self
      real(c_double), intent(inout), contiguous :: field(:, :)   !! shape (M, N); kept

      real(c_double), allocatable :: aligned(:, :)

      if (fftw_alignment_of(field) /= 0) then
         allocate (aligned, source=field)
         call execute(self, aligned, forwards=.true.)
      else
         call execute(self, field, forwards=.true.)
      end if
   end subroutine forward

   !> Transforms the spectrum, which is overwritten, to `factor` times its field.
   subroutine backward(self, field)
      class(grid_transform), intent(inout) :: self
      real(c_double), intent(out), contiguous :: field(:, :)   !! shape (M, N)

      real(c_double), allocatable :: aligned(:, :)

      if (fftw_alignment_of(field) /= 0) then
         allocate (aligned, mold=field)
         call execute(self, aligned, forwards=.false.)
         field = aligned
      else
         call execute(self, field, forwards=.false.)
      end if
   end subroutine backward

   !> Transforms by a plan, which is made when it is first needed.
   subroutine execute(self, field, forwards)
      type(grid_transform), intent(inout) :: self
      real(c_double), intent(inout), contiguous :: field(:, :)   !! aligned as `allocate` does it
      logical, intent(in) :: forwards

      integer(c_int) :: columns, rows

      rows = int(self%points(2), c_int)
      columns = int(self%points(1), c_int)
      ! FFTW_ESTIMATE plans from the sizes and the alignment of the arrays and leaves their contents as they are. The
      ! planner is not thread-safe.
      !$omp critical (wavycon_fftw_planner)
      if (forwards .and. .not. c_associated(self%forward_plan)) then
         if (self%even) then
            self%forward_plan = fftw_plan_r2r_2d(rows, columns, field, self%cosines, FFTW_REDFT10, FFTW_REDFT10, &
                                                 FFTW_ESTIMATE)
         else
            self%forward_plan = fftw_plan_dft_r2c_2d(rows, columns, field, self%waves, FFTW_ESTIMATE)
         end if
      else if (.not. forwards .and. .not. c_associated(self%backward_plan)) then
         if (self%even) then
            self%backward_plan = fftw_plan_r2r_2d(rows, columns, self%cosines, field, FFTW_REDFT01, FFTW_REDFT01, &
                                                  FFTW_ESTIMATE)
         else
            self%backward_plan = fftw_plan_dft_c2r_2d(rows, columns, self%waves, field, FFTW_ESTIMATE)
         end if
      end if
      !$omp end critical (wavycon_fftw_planner)
      if (self%even .and. forwards) then
         call fftw_execute_r2r(self%forward_plan, field, self%cosines)
      else if (self%even) then
         call fftw_execute_r2r(self%backward_plan, self%cosines, field)
      else if (forwards) then
         call fftw_execute_dft_r2c(self%forward_plan, field, self%waves)
      else
         call fftw_execute_dft_c2r(self%backward_plan, self%waves, field)
      end if
   end subroutine execute

   !> The series that interpolates a field at the points.
   subroutine series(self, field, answer)
      class(grid_transform), intent(inout) :: self
      real(c_double), intent(inout), contiguous :: field(:, :)   !! shape (M, N); kept
      type(fourier_series), intent(out) :: answer

      complex(dp) :: up, down
      real(dp) :: weight
      integer :: k, l, m, n

      call self%forward(field)
      m = self%points(1)
      n = self%points(2)
      if (self%even) then
         allocate (answer%c(0:m - 1, 0:n - 1))
         answer%c = self%cosines/(real(m, dp)*n)
         answer%c(0, :) = 0.5_dp*answer%c(0, :)
         answer%c(:, 0) = 0.5_dp*answer%c(:, 0)
         return
      end if
      allocate (answer%c(0:m/2, 0:n/2), answer%cs(0:m/2, 0:n/2), answer%sc(0:m/2, 0:n/2), answer%ss(0:m/2, 0:n/2))
      do l = 0, n/2
         do k = 0, m/2
            ! Of e^(i(kX + lY)) and e^(i(kX - lY)), which are equal for l = 0, and at all points for 2l = N.
            weight = merge(1.0_dp, 2.0_dp, k == 0 .or. 2*k == m)/(real(m, dp)*n)
            up = weight*self%waves(k + 1, l + 1)
            down = 0.0_dp
            if (l > 0 .and. 2*l < n) down = weight*self%waves(k + 1, n - l + 1)
            answer%c(k, l) = real(up + down)
            answer%sc(k, l) = -aimag(up + down)
            answer%cs(k, l) = 0.0_dp
            answer%ss(k, l) = 0.0_dp
            if (l > 0 .and. 2*l < n) then
               answer%cs(k, l) = aimag(down - up)
               answer%ss(k, l) = real(down - up)
            end if
         end do
      end do
   end subroutine series

   !> The values of a series at the points. Waves beyond the grid's highest wave number are left out.
   subroutine sample(self, from, field)
      class(grid_transform), intent(inout) :: self
      type(fourier_series), intent(in) :: from                     !! even, if the points are those of a quarter
      real(c_double), intent(out), contiguous :: field(:, :)       !! shape (M, N)

      complex(dp) :: even_part, odd_part
      real(dp) :: weight
      integer :: k, l, m, n, last_k, last_l

      m = self%points(1)
      n = self%points(2)
      if (self%even) then
         last_k = min(m - 1, ubound(from%c, 1))
         last_l = min(n - 1, ubound(from%c, 2))
         self%cosines = 0.0_dp
         self%cosines(:last_k + 1, :last_l + 1) = 0.25_dp*from%c(:last_k, :last_l)
         self%cosines(1, :) = 2*self%cosines(1, :)
         self%cosines(:, 1) = 2*self%cosines(:, 1)
         call self%backward(field)
         return
      end if
      last_k = min(m/2, ubound(from%c, 1))
      last_l = min(n/2, ubound(from%c, 2))
      self%waves = 0.0_dp
      do l = 0, last_l
         do k = 0, last_k
            weight = merge(1.0_dp, 0.5_dp, k == 0 .or. 2*k == m)
            even_part = weight*from%c(k, l)
            odd_part = 0.0_dp
            if (.not. from%is_even()) then
               if (k > 0 .and. 2*k < m) even_part = even_part - weight*from%sc(k, l)*(0.0_dp, 1.0_dp)
               odd_part = -weight*from%cs(k, l)*(0.0_dp, 1.0_dp)
               if (k > 0 .and. 2*k < m) odd_part = odd_part - weight*from%ss(k, l)
            end if
            if (l == 0 .or. 2*l == n) then
               self%waves(k + 1, l + 1) = even_part
            else
               self%waves(k + 1, l + 1) = 0.5_dp*(even_part + odd_part)
               self%waves(k + 1, n - l + 1) = 0.5_dp*(even_part - odd_part)
            end if
         end do
      end do
      call self%backward(field)
   end subroutine sample

   !> X of the points with first index i [rad].
   elemental real(dp) function x_angle(self, i)
      class(grid_transform), intent(in) :: self
      integer, intent(in) :: i

      x_angle = point_angle(i, self%points(1), self%even)
   end function x_angle

   !> Y of the points with second index j [rad].
   elemental real(dp) function y_angle(self, j)
      class(grid_transform), intent(in) :: self
      integer, intent(in) :: j

      y_angle = point_angle(j, self%points(2), self%even)
   end function y_angle

   !> The angle of a point of the grid, or of its continuation, in one direction [rad].
   elemental real(dp) function point_angle(i, points, even)
      integer, intent(in) :: i         !! any
      integer, intent(in) :: points    !! M or N, >= 1
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell

      point_angle = merge(pi*(i - 0.5_dp), 2*pi*(i - 1), even)/points
   end function point_angle

   !> The index of the grid's point of which a point of its continuation is the image: by mirrors at the borders of a
   !> quarter, periodically beyond those of a whole cell.
   elemental integer function image_of_point(i, points, even) result(image)
      integer, intent(in) :: i         !! any
      integer, intent(in) :: points    !! M or N, >= 1
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell

      if (even) then
         image = modulo(i - 1, 2*points)
         image = min(image, 2*points - 1 - image) + 1
      else
         image = modulo(i - 1, points) + 1
      end if
   end function image_of_point

   subroutine finish(self)
      type(grid_transform), intent(inout) :: self

      !$omp critical (wavycon_fftw_planner)
      if (c_associated(self%forward_plan)) call fftw_destroy_plan(self%forward_plan)
      if (c_associated(self%backward_plan)) call fftw_destroy_plan(self%backward_plan)
      !$omp end critical (wavycon_fftw_planner)
      self%forward_plan = c_null_ptr
      self%backward_plan = c_null_ptr
   end subroutine finish

end module wavycon_grid_transform
