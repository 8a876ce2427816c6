!> Green's functions of the half-space under loads on all points of a lattice.
!>
!> There are two kernels, sums over the lattice points n:
!>
!>     Gp(x) = sum over n of 1/|x - n|, less its mean: the displacement by unit loads;
!>     Laplacian of Gp = sum over n of 1/|x - n|^3, which turns a gap into a pressure: README.md (F11).
!>
!> Each kernel is 1/r^power around the origin plus a smooth part. On the rectangle around the origin that is a cell of
!> the lattice, the smooth part less the terms 1/r^power of the lattice points near by is a polynomial in x^2 and y^2,
!> with an error of rounding: README.md (F22). The polynomial is fitted once to Ewald's sum (F20). The Laplacian has a
!> polynomial of its own, because differentiating that of Gp would amplify the rounding of its highest coefficients.
!>
!> Ewald's sum has only rounding errors everywhere, but is slow. Gp has the Fourier coefficients 1/(A |k|), k /= 0, with
!> the area A of a cell. The error function splits the sum into one over lattice points n and one over wave vectors k of
!> the reciprocal lattice. The terms of both fall faster than any power:
!>
!>     Gp(x) = sum over n of erfc(e |x-n|)/|x-n|
!>             + (1/A) [ sum over k /= 0 of erfc(pi |k|/e)/|k| cos(2 pi k.x) - 2 sqrt(pi)/e ],   e = split sqrt(pi/A).
!>
!> Source: P. P. Ewald, Ann. Phys. 369 (1921) 253-287, for the potential 1/r in the plane.
module wavycon_periodic_kernel
   use wavycon_chebyshev_table, only: chebyshev_table, square_nodes
   use wavycon_kinds, only: dp, pi
   use wavycon_row_lattice, only: row_lattice
   implicit none (type, external)
   private

   public :: ewald_sum, periodic_kernel, start_periodic_kernels

   !> The smooth part of a kernel or, with `whole`, the whole kernel. If `fit` is not allocated, it is the sum over
   !> `point` alone.
   type :: periodic_kernel
      integer :: power = 1                         !! power of 1/r: 1 is Gp, 3 its Laplacian
      type(row_lattice) :: rows                    !! the lattice
      real(dp), allocatable :: point(:, :)         !! x, y of lattice points whose terms are summed, shape (2, m) [s]
      type(chebyshev_table), allocatable :: fit    !! the smooth part without these terms, as a polynomial
      logical :: whole = .false.                   !! whether the term of the origin is included
   contains
      procedure :: evaluate
   end type periodic_kernel

   !> Number of nodes of the fit in the square of either coordinate. The first term left out is below rounding.
   integer, parameter :: nodes = 13
   !> Rounding of Ewald's sum, whose terms are of the order of ten, and of its Laplacian.
   real(dp), parameter :: rounding(2) = [32, 320]*epsilon(1.0_dp)
   !> Least square of a distance. It keeps inverse powers finite, and equal at a position and at the same position
   !> reduced.
   real(dp), parameter :: least_square = 1e-100_dp

   !> Terms whose argument of erfc is larger are left out: erfc(6.4) is 1e-19.
   real(dp), parameter :: cut_off = 6.4_dp
   !> Above 1 there are more waves, and fewer terms of lattice points, whose erfc takes several times as long as a
   !> cosine: the sums of the square lattice take 1.2e6 instructions, with 1 they take 2.3e6.
   real(dp), parameter :: split = 1.7_dp
   !> Number of terms of the power series for x < 1. The first one left out is below rounding.
   integer, parameter :: series_terms = 20

contains

   !> Fits both kernels of a lattice.
   subroutine start_periodic_kernels(rows, kernels)
      type(row_lattice), intent(in) :: rows
      type(periodic_kernel), intent(out) :: kernels(3)     !! Gp, its Laplacian, and the whole of the latter

      real(dp), dimension(nodes, nodes) :: inverse, x, y
      real(dp) :: half(2), values(nodes, nodes, 2)
      complex(dp), allocatable :: z(:)
      integer :: i, k

      ! With fewer of these points the fit would need a higher degree.
      z = rows%points_about(0.75_dp + 0.6_dp*max(rows%spacing, 1.0_dp), (0.0_dp, 0.0_dp))
      z = pack(z, abs(z) > 0.0_dp)
      half = rows%half_sides()
      x = spread(square_nodes(nodes, half(1)), 2, nodes)
      y = spread(square_nodes(nodes, half(2)), 1, nodes)
      call ewald_sum(rows, size(x), x, y, values(:, :, 1), values(:, :, 2))
      do k = 1, size(z)
         inverse = 1.0_dp/sqrt((x - z(k)%re)**2 + (y - z(k)%im)**2)
         values(:, :, 1) = values(:, :, 1) - inverse
         values(:, :, 2) = values(:, :, 2) - inverse**3
      end do
      do i = 1, 2
         associate (kernel => kernels(i))
            kernel%power = 2*i - 1
            kernel%rows = rows
            kernel%point = reshape([z%re, z%im], [2, size(z)], order=[2, 1])
            allocate (kernel%fit)
            call kernel%fit%set(values(:, :, i:i))
            call kernel%fit%set_powers(rounding(i))
         end associate
      end do
      kernels(3) = kernels(2)
      kernels(3)%whole = .true.
   end subroutine start_periodic_kernels

   !> The smooth part, which is the kernel less the origin's term 1/r^power, or the whole kernel, and the gradient if
   !> the arguments are present.
   pure subroutine evaluate(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                             !! positions anywhere in the plane [s]
      real(dp), intent(out) :: value(n)                              !! [s^-power]
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)      !! both or none [s^-(power+1)]

      real(dp) :: at_place, at_reduced, reduced(n, 2)
      logical :: moved
      integer :: i

      reduced(:, 1) = x
      reduced(:, 2) = y
      associate (xr => reduced(:, 1), yr => reduced(:, 2))
         if (allocated(self%fit)) then
            call self%rows%reduce(n, reduced, moved)
            call self%fit%evaluate_even(self%rows%half_sides(), n, xr, yr, value, slope_x, slope_y)
         else
            moved = .false.
            value = 0.0_dp
            if (present(slope_x)) slope_x = 0.0_dp
            if (present(slope_x)) slope_y = 0.0_dp
         end if
         call add_points(self, n, xr, yr, value, slope_x, slope_y)
         if (.not. (moved .or. self%whole)) return
         ! The origin's term is taken out at the position itself. At the reduced position, which `evaluate_even` takes,
         ! it is put back. For most positions both are the same.
         do i = 1, n
            at_reduced = 1.0_dp/max(xr(i)**2 + yr(i)**2, least_square)
            at_place = merge(0.0_dp, 1.0_dp/max(x(i)**2 + y(i)**2, least_square), self%whole)
            value(i) = value(i) + (inverse_power(self%power, at_reduced) - inverse_power(self%power, at_place))
            if (present(slope_x)) then
               at_reduced = self%power*at_reduced*inverse_power(self%power, at_reduced)
               at_place = self%power*at_place*inverse_power(self%power, at_place)
               slope_x(i) = slope_x(i) - (xr(i)*at_reduced - x(i)*at_place)
               slope_y(i) = slope_y(i) - (yr(i)*at_reduced - y(i)*at_place)
            end if
         end do
      end associate
   end subroutine evaluate

   !> Adds the terms 1/r^power of the points, and their gradients.
   pure subroutine add_points(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)
      real(dp), intent(inout) :: value(n)
      real(dp), intent(inout), optional :: slope_x(n), slope_y(n)

      real(dp) :: inverse, inverse_square, of_cube, of_first
      integer :: i, k

      ! 1/r and 1/r^3 are written as 1/r (of_first + of_cube/r^2): compilers do not vectorise loops with a branch.
      of_first = merge(1.0_dp, 0.0_dp, self%power == 1)
      of_cube = 1.0_dp - of_first
      do k = 1, size(self%point, 2)
         associate (a => self%point(1, k), b => self%point(2, k))
            if (present(slope_x)) then
               do i = 1, n
                  inverse_square = 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2)
                  inverse = sqrt(inverse_square)*(of_first + of_cube*inverse_square)
                  value(i) = value(i) + inverse
                  inverse = self%power*inverse*inverse_square
                  slope_x(i) = slope_x(i) - (x(i) - a)*inverse
                  slope_y(i) = slope_y(i) - (y(i) - b)*inverse
               end do
            else
               do i = 1, n
                  inverse_square = 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2)
                  value(i) = value(i) + sqrt(inverse_square)*(of_first + of_cube*inverse_square)
               end do
            end if
         end associate
      end do
   end subroutine add_points

   !> The power 1/r or 1/r^3 from 1/r^2.
   pure real(dp) function inverse_power(power, inverse_square)
      integer, intent(in) :: power
      real(dp), intent(in) :: inverse_square   !! 1/r^2

      inverse_power = sqrt(inverse_square)
      if (power == 3) inverse_power = inverse_power*inverse_square
   end function inverse_power

   !> Ewald's sum of Gp - 1/r, README.md (F20), and of its Laplacian less 1/r^3, which is the sum of 1/|x - n|^3 over
   !> all lattice points except the origin.
   !>
   !> The wave vectors of the reciprocal lattice are the lattice points n, turned by a right angle, over A. So with
   !> e = split sqrt(pi/A) the factor erfc(pi |k|/e)/(A |k|) of a wave is erfc(e |n|/split^2)/|n|.
   pure subroutine ewald_sum(rows, n, x, y, value, laplacian)
      type(row_lattice), intent(in) :: rows
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)            !! positions in the rectangle about the origin [s]
      real(dp), intent(out) :: value(n)             !! [1/s]
      real(dp), intent(out) :: laplacian(n)         !! [1/s^3]

      complex(dp), allocatable :: point(:)
      real(dp) :: bell, e, farthest, r, square, term, weight
      integer :: i, k

      e = split*sqrt(pi/rows%spacing)
      do i = 1, n
         r = e*hypot(x(i), y(i))
         ! The constant of (F20), and the origin's term erfc(r)/r less 1/r.
         value(i) = -2*sqrt(pi)/(e*rows%spacing) - e*merge(erf(r)/max(r, tiny(r)), 2/sqrt(pi), r > 0.0_dp)
         laplacian(i) = e**3*origin_remainder_laplacian(r)
      end do
      farthest = cut_off/e
      allocate (point, source=rows%points_about(farthest, (0.0_dp, 0.0_dp)))
      do k = 1, size(point)
         if (2*k == size(point) + 1) cycle
         ! The terms erfc(e r)/r of the lattice points except the origin, and their Laplacian by README.md (F21).
         do i = 1, n
            square = (x(i) - point(k)%re)**2 + (y(i) - point(k)%im)**2
            if (square >= farthest**2) cycle
            term = erfc(e*sqrt(square))/sqrt(square)
            bell = 2*e/sqrt(pi)*exp(-e**2*square)
            value(i) = value(i) + term
            laplacian(i) = laplacian(i) + term/square + bell*(1/square + 2*e**2)
         end do
      end do
      ! The terms of the waves: n and -n together.
      point = rows%points_about(split**2*farthest, (0.0_dp, 0.0_dp))
      do k = 1, size(point)/2
         if (abs(point(k)) >= split**2*farthest) cycle
         weight = 2*erfc(e/split**2*abs(point(k)))/abs(point(k))
         do i = 1, n
            term = weight*cos(2*pi/rows%spacing*(y(i)*point(k)%re - x(i)*point(k)%im))
            value(i) = value(i) + term
            laplacian(i) = laplacian(i) - (2*pi/rows%spacing*abs(point(k)))**2*term
         end do
      end do
   end subroutine ewald_sum

   !> The Laplacian in the plane of -erf(x)/x: the origin's term of README.md (F21) less 1/r^3.
   pure real(dp) function origin_remainder_laplacian(x) result(value)
      real(dp), intent(in) :: x             !! >= 0

      real(dp) :: power
      integer :: n

      if (x < 1.0_dp) then
         ! The closed form loses digits to cancellation: the series of -erf(x)/x, the sum over n of
         ! -2/sqrt(pi) (-x^2)^n/(n! (2n+1)), differentiated.
         power = -2/sqrt(pi)
         value = 0.0_dp
         do n = 1, series_terms
            value = value - power*4*n/(2*n + 1.0_dp)
            power = -power*x**2/n
         end do
      else
         value = -erf(x)/x**3 + 2/sqrt(pi)*exp(-x**2)*(1/x**2 + 2)
      end if
   end function origin_remainder_laplacian

end module wavycon_periodic_kernel
