!> Removes the mean, plane or paraboloid of least squares from a height map: (M1), (M2) of README.md in this directory.
module wavycon_detrend
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dpotrf, dtrsv
   use wavycon_measured_map, only: measured_map
   implicit none (type, external)
   private

   public :: detrend_map

   !> Least mean square, on the points that are there, of the part of a term that the other terms do not fit, over its
   !> mean square on the whole grid. Below it rounding would decide the coefficient.
   real(dp), parameter :: least_part = 1.0e-10_dp

   !> The terms P_a(x) P_b(y) of a polynomial (M1) on the points of a map.
   type :: polynomial
      real(dp), allocatable :: x(:, :), y(:, :)   !! P_a at the points, shapes (M, 0:.), (N, 0:.)
      integer, allocatable :: a(:), b(:)          !! of each term
      real(dp), allocatable :: coefficient(:)     !! of each term [height]
   end type polynomial

contains

   !> Subtracts the polynomial of least squares over the points that are there. Missing points keep their zeros.
   subroutine detrend_map(map, degree, rise, is_determined)
      type(measured_map), intent(inout) :: map
      integer, intent(in) :: degree             !! 0: the mean, 1: a plane, 2: a polynomial of the second degree
      !> Rise of the linear part that was removed, from the first point to the last along x and y [height].
      real(dp), intent(out) :: rise(2)
      !> .false. if the points that are there do not determine the polynomial: the map is then unchanged.
      logical, intent(out) :: is_determined

      type(polynomial) :: trend
      integer :: pass

      call start(trend, map%points(), degree)
      rise = 0.0_dp
      ! The second pass removes what rounding left of a large mean or tilt in the first.
      do pass = 1, 2
         call fit(trend, map, is_determined)
         if (.not. is_determined) return
         call subtract(trend, map)
         rise = rise + rise_of(trend)
      end do
   end subroutine detrend_map

   !> The terms up to a degree, as many as the points determine.
   pure subroutine start(trend, points, degree)
      type(polynomial), intent(out) :: trend
      integer, intent(in) :: points(2), degree

      integer :: a, b

      call make_polynomials(points(1), degree, trend%x)
      call make_polynomials(points(2), degree, trend%y)
      trend%a = [((a, a=0, min(ubound(trend%x, 2), degree - b)), b=0, ubound(trend%y, 2))]
      trend%b = [((b, a=0, min(ubound(trend%x, 2), degree - b)), b=0, ubound(trend%y, 2))]
      allocate (trend%coefficient(size(trend%a)))
   end subroutine start

   !> P_0 .. P_degree of (M1) at the points of one direction, fewer if there are fewer points.
   pure subroutine make_polynomials(points, degree, values)
      integer, intent(in) :: points, degree
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (points, 0:.)

      integer :: i

      allocate (values(points, 0:min(degree, points - 1)), source=1.0_dp)
      if (ubound(values, 2) >= 1) values(:, 1) = of_unit_rms([(real(2*i - points - 1, dp), i=1, points)])
      if (ubound(values, 2) >= 2) values(:, 2) = of_unit_rms(values(:, 1)**2 - 1.0_dp)
   end subroutine make_polynomials

   !> Values over their root mean square.
   pure function of_unit_rms(values)
      real(dp), intent(in) :: values(:)
      real(dp) :: of_unit_rms(size(values))

      of_unit_rms = values/sqrt(sum(values**2)/size(values))
   end function of_unit_rms

   !> The coefficients of least squares, by the normal equations (M2).
   subroutine fit(trend, map, is_determined)
      type(polynomial), intent(inout) :: trend
      type(measured_map), intent(in) :: map
      logical, intent(out) :: is_determined

      type(grid_slab) :: slab
      real(dp) :: gram(size(trend%a), size(trend%a)), moments(0:ubound(trend%x, 2))
      real(dp) :: products(0:ubound(trend%x, 2), 0:ubound(trend%x, 2)), x_there(size(trend%x, 1), 0:ubound(trend%x, 2))
      real(dp), allocatable :: parts(:, :)   ! of each column: of the coefficients, then of the matrix
      real(dp) :: totals(size(trend%a)*(size(trend%a) + 1))
      integer :: info, j, k, l, terms

      terms = size(trend%a)
      slab = map%columns()
      allocate (parts(size(totals), size(map%height, 2)), source=0.0_dp)
      do j = 1, size(map%height, 2)
         x_there = trend%x
         if (allocated(map%missing)) &
            x_there = merge(0.0_dp, x_there, spread(map%missing(:, j), 2, size(x_there, 2)))
         moments = matmul(map%height(:, j), x_there)
         products = matmul(transpose(x_there), trend%x)
         do k = 1, terms
            associate (a => trend%a(k), of_column => trend%y(slab%first - 1 + j, :))
               parts(k, j) = of_column(trend%b(k) + 1)*moments(a)
               do l = 1, k
                  parts(l*terms + k, j) = of_column(trend%b(k) + 1)*of_column(trend%b(l) + 1)*products(a, trend%a(l))
               end do
            end associate
         end do
      end do
      totals = slab%column_totals(parts)/product(real(slab%points, dp))
      trend%coefficient = totals(:terms)
      gram = reshape(totals(terms + 1:), [terms, terms])
      call dpotrf('L', terms, gram, terms, info)
      is_determined = info == 0
      if (is_determined) is_determined = all([(gram(k, k)**2 > least_part, k=1, terms)])
      if (.not. is_determined) return
      call dtrsv('L', 'N', 'N', terms, gram, terms, trend%coefficient, 1)
      call dtrsv('L', 'T', 'N', terms, gram, terms, trend%coefficient, 1)
   end subroutine fit

   !> Subtracts a polynomial at the points that are there.
   subroutine subtract(trend, map)
      type(polynomial), intent(in) :: trend
      type(measured_map), intent(inout) :: map

      type(grid_slab) :: slab
      real(dp) :: of_row(0:ubound(trend%x, 2))
      integer :: j, k

      slab = map%columns()
      do j = 1, size(map%height, 2)
         of_row = 0.0_dp
         do k = 1, size(trend%a)
            of_row(trend%a(k)) = of_row(trend%a(k)) + trend%coefficient(k)*trend%y(slab%first - 1 + j, trend%b(k))
         end do
         map%height(:, j) = map%height(:, j) - matmul(trend%x, of_row)
         if (allocated(map%missing)) map%height(:, j) = merge(0.0_dp, map%height(:, j), map%missing(:, j))
      end do
   end subroutine subtract

   !> The linear part of a polynomial: its rise from the first point to the last along x and y.
   pure function rise_of(trend) result(rise)
      type(polynomial), intent(in) :: trend
      real(dp) :: rise(2)

      integer :: k

      rise = 0.0_dp
      do k = 1, size(trend%a)
         if (trend%a(k) == 1 .and. trend%b(k) == 0) rise(1) = 2*trend%coefficient(k)*trend%x(size(trend%x, 1), 1)
         if (trend%a(k) == 0 .and. trend%b(k) == 1) rise(2) = 2*trend%coefficient(k)*trend%y(size(trend%y, 1), 1)
      end do
   end function rise_of

end module wavycon_detrend
