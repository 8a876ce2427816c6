!> Removes the trend of a height map, which is its mean, plane or polynomial of the second degree of least squares:
!> (M1), (M2) of README.md in this directory; or the median of each of its rows.
module wavycon_detrend
   use wavycon_grid_slab, only: grid_slab
   use wavycon_gsl, only: ascending_order
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dpotrf, dtrsv
   use wavycon_measured_map, only: measured_map
   implicit none (type, external)
   private

   public :: detrend_map, level_lines

   !> Least pivot of Cholesky's factorisation of (M2). The pivot is the mean square, over the points with a height, of
   !> the part of a term that the terms before cannot fit; the mean square of a term over the whole grid is 1. With a
   !> smaller pivot rounding would determine the term's coefficient.
   real(dp), parameter :: least_part = 1.0e-10_dp

contains

   !> Subtracts the polynomial that fits best, by least squares, the heights that are not missing. Missing heights stay
   !> 0.
   subroutine detrend_map(map, degree, rise, is_determined)
      type(measured_map), intent(inout) :: map
      integer, intent(in) :: degree             !! 0: the mean, 1: a plane, 2: a polynomial of the second degree
      !> Rise of the removed polynomial's linear part from the first point to the last, along x and along y [height].
      real(dp), intent(out) :: rise(2)
      !> .false. if the heights that are not missing do not determine the polynomial. The map is then unchanged.
      logical, intent(out) :: is_determined

      type(grid_slab) :: slab
      integer, allocatable :: a(:), b(:)             ! degrees along x and y of each term P_a Q_b, (M1)
      real(dp), allocatable :: coefficient(:)        ! coefficient of each term
      real(dp), allocatable :: x(:, :), y(:, :)      ! P_a and Q_b at the points along x and y, the second index from 0
      integer :: i, j, k, pass

      slab = map%columns()
      call make_polynomials(slab%points(1), degree, x)
      call make_polynomials(slab%points(2), degree, y)
      a = [((i, i=0, min(ubound(x, 2), degree - j)), j=0, ubound(y, 2))]
      b = [((j, i=0, min(ubound(x, 2), degree - j)), j=0, ubound(y, 2))]
      rise = 0.0_dp
      ! The second pass removes the rounding errors of the first one, which are large if the mean or the tilt is.
      do pass = 1, 2
         call fit(coefficient, is_determined)
         if (.not. is_determined) return
         do j = 1, size(map%height, 2)
            map%height(:, j) = map%height(:, j) - matmul(terms_of_column(j), coefficient)
         end do
         if (allocated(map%missing)) where (map%missing) map%height = 0.0_dp
         do k = 1, size(a)
            if (a(k) == 1 .and. b(k) == 0) rise(1) = rise(1) + 2*coefficient(k)*x(size(x, 1), 1)
            if (a(k) == 0 .and. b(k) == 1) rise(2) = rise(2) + 2*coefficient(k)*y(size(y, 1), 1)
         end do
      end do

   contains

      !> Finds the coefficients of least squares from the normal equations (M2).
      subroutine fit(coefficient, is_determined)
         real(dp), allocatable, intent(out) :: coefficient(:)
         logical, intent(out) :: is_determined

         !> The sums over each column of points of the right-hand sides g_k and of the matrix G_kl; the terms there.
         real(dp), allocatable :: column_sums(:, :), terms(:, :)
         real(dp) :: gram(size(a), size(a)), totals(size(a)*(size(a) + 1))
         integer :: info, j, k

         allocate (column_sums(size(totals), size(map%height, 2)))
         do j = 1, size(map%height, 2)
            terms = terms_of_column(j)
            if (allocated(map%missing)) where (spread(map%missing(:, j), 2, size(a))) terms = 0.0_dp
            column_sums(:, j) = [matmul(map%height(:, j), terms), matmul(transpose(terms), terms)]
         end do
         totals = slab%column_totals(column_sums)/product(real(slab%points, dp))
         coefficient = totals(:size(a))
         gram = reshape(totals(size(a) + 1:), [size(a), size(a)])
         call dpotrf('L', size(a), gram, size(a), info)
         is_determined = info == 0
         if (is_determined) is_determined = all([(gram(k, k)**2 > least_part, k=1, size(a))])
         if (.not. is_determined) return
         call dtrsv('L', 'N', 'N', size(a), gram, size(a), coefficient, 1)
         call dtrsv('L', 'T', 'N', size(a), gram, size(a), coefficient, 1)
      end subroutine fit

      !> The values of all terms at the points of one of the process's own columns.
      pure function terms_of_column(j) result(terms)
         integer, intent(in) :: j                 !! number of the column among the own ones
         real(dp) :: terms(size(x, 1), size(a))

         integer :: k

         do k = 1, size(a)
            terms(:, k) = x(:, a(k))*y(slab%first - 1 + j, b(k))
         end do
      end function terms_of_column

   end subroutine detrend_map

   !> Subtracts from each row along x the median of its heights that are not missing: the middle one, or the mean of the
   !> two in the middle. Missing heights stay 0.
   subroutine level_lines(height, missing)
      real(dp), intent(inout) :: height(:, :)             !! the own columns of the map: rows along x of one y each
      logical, allocatable, intent(in) :: missing(:, :)   !! shape of height; not allocated if none is missing

      integer :: j, n
      logical :: is_there(size(height, 1))
      real(dp), allocatable :: heights(:)

      is_there = .true.
      do j = 1, size(height, 2)
         if (allocated(missing)) is_there = .not. missing(:, j)
         heights = pack(height(:, j), is_there)
         n = size(heights)
         if (n == 0) cycle
         heights = heights(ascending_order(heights))
         where (is_there) height(:, j) = height(:, j) - 0.5_dp*(heights((n + 1)/2) + heights(n/2 + 1))
      end do
   end subroutine level_lines

   !> The polynomials P_0 .. P_degree of (M1) at the points of one direction. Of n points there are n polynomials at
   !> most.
   pure subroutine make_polynomials(points, degree, values)
      integer, intent(in) :: points                        !! number of points in this direction
      integer, intent(in) :: degree
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (points, 0:min(degree, points - 1))

      integer :: i

      allocate (values(points, 0:min(degree, points - 1)), source=1.0_dp)
      if (ubound(values, 2) >= 1) values(:, 1) = of_unit_rms([(real(2*i - points - 1, dp), i=1, points)])
      if (ubound(values, 2) >= 2) values(:, 2) = of_unit_rms(values(:, 1)**2 - 1.0_dp)

   contains

      !> The values divided by their root mean square.
      pure function of_unit_rms(values)
         real(dp), intent(in) :: values(:)
         real(dp) :: of_unit_rms(size(values))

         of_unit_rms = values/sqrt(sum(values**2)/size(values))
      end function of_unit_rms

   end subroutine make_polynomials

end module wavycon_detrend
