!> Displacement of a half-space by unit loads on all the points of a lattice, less its mean.
!>
!> Lengths are in the lattice's shorter side s. The Fourier coefficients of the kernel Gp are 1/(A |k|), k <>
!> 0, with A the area of a cell, and about its own lattice point it is 1/r + a smooth function. Ewald's sum
!> gives it anywhere,
!>
!>     Gp(x) = sum over n of erfc(e |x-n|)/|x-n|
!>             + (1/A) [ sum over k <> 0 of erfc(pi |k|/e)/|k| cos(2 pi k.x) - 2 sqrt(pi)/e ]
!>
!> with e = sqrt(pi/A), but slowly. So the sum is taken once per lattice: on the rectangle |x| <= 1/2, |y| <=
!> height/2 about the origin, Gp less 1/r of a handful of lattice points near by is a polynomial in x^2 and
!> y^2 to rounding. So is its Laplacian less their 1/r^3, which has a fit of its own: differentiated, rounding in the
!> highest coefficients of the first would spoil it.
!>
!> N.B. The lattice is even in x and in y: rectangular or, with every other row moved by half a side, rhombic.
!> What is said here is for rows along x; for those along y, x and y change places.
module wavycon_periodic_kernel
   use wavycon_constants, only: pi
   use wavycon_fitted_tuning, only: kernel_fit_degree, kernel_near_distance, kernel_near_per_side
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: periodic_kernel, start_periodic_kernel, add_points, ewald_sum

   type :: periodic_kernel
      real(dp) :: height = 1.0_dp                !! distance of two rows [s], >= 1/2
      real(dp) :: row_shift = 0.0_dp             !! of the next row, along itself [s]: 0 or 1/2
      logical :: rows_along_y = .false.          !! or along x
      real(dp), allocatable :: image(:, :)       !! lattice points taken out, but the origin, shape (2, m)
      real(dp), allocatable :: coefficient(:, :) !! of the powers of u and v, shape (0:., 0:.)
      integer, allocatable :: degree(:)          !! in u for each power of v
      real(dp), allocatable :: bending(:, :)     !! coefficients of the Laplacian [1/s^2], as `coefficient`
   contains
      procedure :: smooth_part
      procedure :: smooth_laplacian
      procedure :: laplacian
      procedure :: points_within
      procedure :: reduced
   end type periodic_kernel

   !> Coefficients below it are rounding of Ewald's sum, whose terms are of order ten, and of its Laplacian.
   real(dp), parameter :: noise(2) = [32, 320]*epsilon(1.0_dp)
   !> erfc of it is 1e-19.
   real(dp), parameter :: cut_off = 6.4_dp
   !> Where |x| of a point and of its reduced place are the same, their 1/|x|^5 must be the same finite number.
   real(dp), parameter :: least_square = 1e-100_dp

contains

   !> Fits the smooth part.
   subroutine start_periodic_kernel(kernel, height, row_shift, rows_along_y)
      type(periodic_kernel), intent(out) :: kernel
      real(dp), intent(in) :: height     !! distance of two rows [s], >= 1/2
      real(dp), intent(in) :: row_shift  !! of the next row, along itself [s]: 0 or 1/2
      logical, intent(in), optional :: rows_along_y   !! along x if absent

      integer, parameter :: n = kernel_fit_degree
      real(dp), dimension(0:n, 0:n) :: cosine, distance, to_powers, x, y
      real(dp) :: image(2), reach, values(0:n, 0:n, 2)
      integer :: degree(0:n), i, j, k

      kernel%height = height
      kernel%row_shift = row_shift
      ! Lattice points left in are at least 1.35 sides from the rectangle, more from a long one.
      reach = kernel_near_distance + kernel_near_per_side*max(height, 1.0_dp)
      allocate (kernel%image(2, 0))
      do j = -4, 4
         do i = -6, 6
            image = [i + row_shift*j, height*j]
            if (i == 0 .and. j == 0) cycle
            if (norm2(max(abs(image) - 0.5_dp*[1.0_dp, height], 0.0_dp)) > reach) cycle
            kernel%image = reshape([kernel%image, image], [2, size(kernel%image, 2) + 1])
         end do
      end do

      do j = 0, n
         do i = 0, n
            cosine(i, j) = cos(pi*i*(j + 0.5_dp)/(n + 1))
         end do
      end do
      do j = 0, n
         do i = 0, n
            x(i, j) = 0.5_dp*sqrt(0.5_dp*(1.0_dp + cosine(1, i)))
            y(i, j) = 0.5_dp*height*sqrt(0.5_dp*(1.0_dp + cosine(1, j)))
         end do
      end do
      call ewald_sum(height, row_shift, size(x), x, y, values(:, :, 1), values(:, :, 2))
      do k = 1, size(kernel%image, 2)
         distance = hypot(x - kernel%image(1, k), y - kernel%image(2, k))
         values(:, :, 1) = values(:, :, 1) - 1.0_dp/distance
         values(:, :, 2) = values(:, :, 2) - 1.0_dp/distance**3
      end do
      degree = -1
      do k = 1, 2
         values(:, :, k) = matmul(cosine, matmul(values(:, :, k), transpose(cosine)))*(2.0_dp/(n + 1))**2
         values(0, :, k) = 0.5_dp*values(0, :, k)
         values(:, 0, k) = 0.5_dp*values(:, 0, k)
         do j = 0, n
            i = findloc(abs(values(:, j, k)) > noise(k), .true., dim=1, back=.true.) - 1
            values(i + 1:, j, k) = 0.0_dp
            degree(j) = max(degree(j), i)
         end do
      end do
      k = findloc(degree >= 0, .true., dim=1, back=.true.) - 1
      ! Powers of one variable bring in lower powers of the same: a degree must not grow with the other power.
      do j = k - 1, 0, -1
         degree(j) = max(degree(j), degree(j + 1))
      end do
      ! Chebyshev's polynomials in powers; the coefficients fall much faster than these grow.
      to_powers = 0.0_dp
      to_powers(0, 0) = 1.0_dp
      to_powers(1, 1) = 1.0_dp
      do j = 2, n
         to_powers(1:, j) = 2*to_powers(:n - 1, j - 1)
         to_powers(:, j) = to_powers(:, j) - to_powers(:, j - 2)
      end do
      do j = 1, 2
         values(:, :, j) = matmul(to_powers, matmul(values(:, :, j), transpose(to_powers)))
      end do
      allocate (kernel%degree(0:k), kernel%coefficient(0:degree(0), 0:k), kernel%bending(0:degree(0), 0:k))
      kernel%degree(:) = degree(:k)
      kernel%coefficient(:, :) = values(:degree(0), :k, 1)
      kernel%bending(:, :) = values(:degree(0), :k, 2)
      if (present(rows_along_y)) kernel%rows_along_y = rows_along_y
      if (kernel%rows_along_y) kernel%image(:, :) = kernel%image([2, 1], :)
   end subroutine start_periodic_kernel

   !> Gp - 1/r and, if asked for, its gradient at n places.
   pure subroutine smooth_part(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                                    !! [s]
      real(dp), intent(out) :: value(n)                                     !! Gp - 1/r [1/s]
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)             !! both or none [1/s^2]

      call without_origin(self, .false., self%coefficient, n, x, y, value, slope_x, slope_y)
   end subroutine smooth_part

   !> The Laplacian of Gp less 1/r^3 and, if asked for, its gradient at n places: the sum of 1/|x - n|^3 over all
   !> lattice points but the origin.
   pure subroutine smooth_laplacian(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                                    !! [s]
      real(dp), intent(out) :: value(n)                                     !! [1/s^3]
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)             !! both or none [1/s^4]

      call without_origin(self, .true., self%bending, n, x, y, value, slope_x, slope_y)
   end subroutine smooth_laplacian

   !> A polynomial of the kernel and the inverse distances, or their cubes, of the lattice points near by.
   pure subroutine without_origin(self, cubes, coefficient, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      logical, intent(in) :: cubes
      real(dp), intent(in) :: coefficient(0:, 0:)   !! as self%coefficient
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      real(dp), dimension(n) :: xr, yr
      real(dp) :: far, near, power
      logical :: moved
      integer :: i

      call reduce(self, n, x, y, xr, yr, moved)
      call polynomial(self, coefficient, n, xr, yr, value, slope_x, slope_y)
      call add_points(self%image, cubes, n, xr, yr, value, slope_x, slope_y)
      if (.not. moved) return
      ! The origin's own is left out at x, not at the reduced place: for most points the same.
      power = merge(3.0_dp, 1.0_dp, cubes)
      do i = 1, n
         near = 1.0_dp/max(xr(i)**2 + yr(i)**2, least_square)
         far = 1.0_dp/max(x(i)**2 + y(i)**2, least_square)
         value(i) = value(i) + (inverse(cubes, near) - inverse(cubes, far))
         if (present(slope_x)) then
            near = power*near*inverse(cubes, near)
            far = power*far*inverse(cubes, far)
            slope_x(i) = slope_x(i) - (xr(i)*near - x(i)*far)
            slope_y(i) = slope_y(i) - (yr(i)*near - y(i)*far)
         end if
      end do
   end subroutine without_origin

   !> Adds the inverse distances, or their cubes, from some lattice points.
   pure subroutine add_points(point, cubes, n, x, y, value, slope_x, slope_y)
      real(dp), intent(in) :: point(:, :)                            !! shape (2, m) [s]
      logical, intent(in) :: cubes
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                             !! [s]
      real(dp), intent(inout) :: value(n)                            !! [1/s], of cubes [1/s^3]
      real(dp), intent(inout), optional :: slope_x(n), slope_y(n)    !! both or none [1/s^2], of cubes [1/s^4]

      real(dp) :: a, b, near, power, square
      integer :: i, k

      power = merge(3.0_dp, 1.0_dp, cubes)
      do k = 1, size(point, 2)
         a = point(1, k)
         b = point(2, k)
         if (present(slope_x)) then
            do i = 1, n
               square = 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2)
               near = inverse(cubes, square)
               value(i) = value(i) + near
               near = power*near*square
               slope_x(i) = slope_x(i) - (x(i) - a)*near
               slope_y(i) = slope_y(i) - (y(i) - b)*near
            end do
         else
            do i = 1, n
               value(i) = value(i) + inverse(cubes, 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2))
            end do
         end if
      end do
   end subroutine add_points

   !> 1/r or 1/r^3.
   pure real(dp) function inverse(cubes, inverse_square)
      logical, intent(in) :: cubes
      real(dp), intent(in) :: inverse_square   !! 1/r^2

      inverse = sqrt(inverse_square)
      if (cubes) inverse = inverse*inverse_square
   end function inverse

   !> The Laplacian of Gp at n places: the sum of 1/|x - n|^3 over the lattice.
   pure subroutine laplacian(self, n, x, y, value)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)      !! [s]
      real(dp), intent(out) :: value(n)       !! [1/s^3]

      call self%smooth_laplacian(n, x, y, value)
      value = value + 1.0_dp/hypot(x, y)**3
   end subroutine laplacian

   !> The same places in the rectangle about the origin.
   pure subroutine reduce(self, n, x, y, xr, yr, moved)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)       !! [s]
      real(dp), intent(out) :: xr(n), yr(n)    !! [s]
      logical, intent(out) :: moved            !! whether any is another one

      if (self%rows_along_y) then
         call reduce_by_rows(self, n, y, x, yr, xr, moved)
      else
         call reduce_by_rows(self, n, x, y, xr, yr, moved)
      end if
   end subroutine reduce

   !> The same with x along the rows.
   pure subroutine reduce_by_rows(self, n, x, y, xr, yr, moved)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)       !! [s]
      real(dp), intent(out) :: xr(n), yr(n)    !! [s]
      logical, intent(out) :: moved

      integer :: column, i, moves, row

      moves = 0
      do i = 1, n
         row = int(y(i)/self%height + sign(0.5_dp, y(i)))
         yr(i) = y(i) - row*self%height
         xr(i) = x(i) - row*self%row_shift
         column = int(xr(i) + sign(0.5_dp, xr(i)))
         xr(i) = xr(i) - column
         moves = ior(moves, ior(row, column))
      end do
      moved = moves /= 0
   end subroutine reduce_by_rows

   !> The lattice points but the origin nearer to it than some distance, and how near the next one is.
   pure subroutine points_within(self, distance, point, next)
      class(periodic_kernel), intent(in) :: self
      real(dp), intent(in) :: distance                       !! > 0 [s]
      real(dp), allocatable, intent(out) :: point(:, :)      !! shape (2, m) [s]
      real(dp), intent(out) :: next                          !! [s]

      real(dp) :: x, y
      integer :: columns, i, j, rows

      rows = ceiling(distance/self%height) + 1
      columns = ceiling(distance + self%row_shift*rows) + 1
      next = huge(next)
      allocate (point(2, 0))
      do j = -rows, rows
         do i = -columns, columns
            x = i + self%row_shift*j
            y = self%height*j
            if (i == 0 .and. j == 0) cycle
            if (hypot(x, y) < distance) then
               point = reshape([point, x, y], [2, size(point, 2) + 1])
            else
               next = min(next, hypot(x, y))
            end if
         end do
      end do
      if (self%rows_along_y) point = point([2, 1], :)
   end subroutine points_within

   !> One of the two polynomials in x^2 and y^2 and, if asked for, its gradient.
   pure subroutine polynomial(self, coefficient, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      real(dp), intent(in) :: coefficient(0:, 0:)   !! as self%coefficient
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! in the rectangle about the origin [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      if (self%rows_along_y) then
         call polynomial_by_rows(self, coefficient, n, y, x, value, slope_y, slope_x)
      else
         call polynomial_by_rows(self, coefficient, n, x, y, value, slope_x, slope_y)
      end if
   end subroutine polynomial

   !> The same with x along the rows.
   pure subroutine polynomial_by_rows(self, coefficient, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      real(dp), intent(in) :: coefficient(0:, 0:)   !! as self%coefficient
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! in the rectangle about the origin [s]
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      real(dp), dimension(n) :: u, v, q, dq, du, dv
      real(dp) :: a
      integer :: i, j, k

      do i = 1, n
         u(i) = 8*x(i)**2 - 1.0_dp
         v(i) = 8*(y(i)/self%height)**2 - 1.0_dp
      end do
      value = 0.0_dp
      du = 0.0_dp
      dv = 0.0_dp
      do k = ubound(self%degree, 1), 0, -1
         q = coefficient(self%degree(k), k)
         if (present(slope_x)) then
            dq = 0.0_dp
            do j = self%degree(k) - 1, 0, -1
               a = coefficient(j, k)
               do i = 1, n
                  dq(i) = dq(i)*u(i) + q(i)
                  q(i) = q(i)*u(i) + a
               end do
            end do
            do i = 1, n
               dv(i) = dv(i)*v(i) + value(i)
               du(i) = du(i)*v(i) + dq(i)
            end do
         else
            do j = self%degree(k) - 1, 0, -1
               a = coefficient(j, k)
               do i = 1, n
                  q(i) = q(i)*u(i) + a
               end do
            end do
         end if
         do i = 1, n
            value(i) = value(i)*v(i) + q(i)
         end do
      end do
      if (present(slope_x)) then
         do i = 1, n
            slope_x(i) = 16*x(i)*du(i)
            slope_y(i) = 16*y(i)/self%height**2*dv(i)
         end do
      end if
   end subroutine polynomial_by_rows

   !> The same place in the rectangle about the origin.
   pure complex(dp) function reduced(self, z)
      class(periodic_kernel), intent(in) :: self
      complex(dp), intent(in) :: z  !! x + i y [s]

      real(dp) :: x(1), y(1)
      logical :: moved

      call reduce(self, 1, [z%re], [z%im], x, y, moved)
      reduced = cmplx(x(1), y(1), dp)
   end function reduced

   !> Gp - 1/r and its Laplacian by Ewald's sum at n places.
   pure subroutine ewald_sum(height, row_shift, n, x, y, value, laplacian)
      real(dp), intent(in) :: height            !! distance of two rows [s]
      real(dp), intent(in) :: row_shift         !! of the next row along x [s]
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)        !! [s], in the rectangle about the origin
      real(dp), intent(out) :: value(n)         !! [1/s]
      real(dp), intent(out) :: laplacian(n)     !! [1/s^3]

      real(dp) :: bell, e, k_x, k_y, r, reach, square, term, weight
      integer :: i, j, k, rows, columns

      e = sqrt(pi/height)
      do k = 1, n
         r = e*hypot(x(k), y(k))
         value(k) = -2*sqrt(pi)/(e*height) + e*long_range(r, derivative=0)
         laplacian(k) = e**3*long_range(r, derivative=2)
      end do
      reach = cut_off/e
      rows = ceiling(reach/height + 0.5_dp)
      columns = ceiling(reach + 1.0_dp + 0.5_dp*rows)
      do j = -rows, rows
         do i = -columns, columns
            if (i == 0 .and. j == 0) cycle
            do k = 1, n
               square = (x(k) - i - row_shift*j)**2 + (y(k) - height*j)**2
               if (square >= reach**2) cycle
               r = sqrt(square)
               term = erfc(e*r)/r
               bell = 2*e/sqrt(pi)*exp(-e**2*square)
               value(k) = value(k) + term
               laplacian(k) = laplacian(k) + term/square + bell*(1/square + 2*e**2)
            end do
         end do
      end do
      ! The reciprocal lattice: (i, (j - i shift)/height), one of k and -k.
      reach = cut_off*e/pi
      columns = ceiling(reach)
      rows = ceiling(reach*height + 0.5_dp*columns)
      do j = -rows, rows
         do i = 0, columns
            k_x = i
            k_y = (j - i*row_shift)/height
            r = hypot(k_x, k_y)
            if ((i == 0 .and. j <= 0) .or. r >= reach) cycle
            weight = 2*erfc(pi*r/e)/(r*height)
            do k = 1, n
               term = weight*cos(2*pi*(k_x*x(k) + k_y*y(k)))
               value(k) = value(k) + term
               laplacian(k) = laplacian(k) - (2*pi*r)**2*term
            end do
         end do
      end do
   end subroutine ewald_sum

   !> -erf(x)/x, what is left of the origin's own term, or its Laplacian in the plane.
   pure real(dp) function long_range(x, derivative) result(value)
      real(dp), intent(in) :: x             !! >= 0
      integer, intent(in) :: derivative     !! 0 or 2

      integer, parameter :: terms = 20
      real(dp) :: power
      integer :: n

      value = 0.0_dp
      if (x < 1.0_dp) then
         ! A sum of -2/sqrt(pi) (-x^2)^n/(n! (2n+1)): closed forms lose digits.
         power = -2/sqrt(pi)
         if (derivative == 0) value = power
         do n = 1, terms
            if (derivative == 2) value = value - power*4*n/(2*n + 1.0_dp)
            power = -power*x**2/n
            if (derivative == 0) value = value + power/(2*n + 1)
         end do
      else if (derivative == 0) then
         value = -erf(x)/x
      else
         value = -erf(x)/x**3 + 2/sqrt(pi)*exp(-x**2)*(1/x**2 + 2)
      end if
   end function long_range

end module wavycon_periodic_kernel
