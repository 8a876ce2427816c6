!> Displacement of a half-space by unit loads on all points of a lattice, less its mean, and its Laplacian in the plane,
!> by Ewald's sum: exact to rounding anywhere, but slow.
!>
!> The kernel Gp has the Fourier coefficients 1/(A |k|), k /= 0, with A the area of a cell. It is split by the error
!> function into a sum over lattice points n and one over wave vectors k of the reciprocal lattice, both of which fall
!> off faster than any power:
!>
!>     Gp(x) = sum over n of erfc(e |x-n|)/|x-n|
!>             + (1/A) [ sum over k /= 0 of erfc(pi |k|/e)/|k| cos(2 pi k.x) - 2 sqrt(pi)/e ],   e = sqrt(pi/A).
!>
!> This is README.md (F20). Source: P. P. Ewald, Ann. Phys. 369 (1921) 253-287, for the potential 1/r in the plane.
module wavycon_ewald_sum
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_row_lattice, only: row_lattice
   implicit none (type, external)
   private

   public :: ewald_sum

   !> Terms beyond this argument of erfc are left out: erfc of it is 1e-19.
   real(dp), parameter :: cut_off = 6.4_dp
   !> Terms of the power series used for x < 1: the first one left out is below rounding.
   integer, parameter :: series_terms = 20

contains

   !> Gp - 1/r, README.md (F20), and its Laplacian less 1/r^3, which is the sum of 1/|x - n|^3 over all lattice points
   !> but the origin.
   pure subroutine ewald_sum(rows, n, along, across, value, laplacian)
      type(row_lattice), intent(in) :: rows
      integer, intent(in) :: n
      real(dp), intent(in) :: along(n), across(n)   !! along and across the rows, in the rectangle about the origin [s]
      real(dp), intent(out) :: value(n)             !! [1/s]
      real(dp), intent(out) :: laplacian(n)         !! [1/s^3]

      real(dp) :: e, r
      integer :: i

      e = sqrt(pi/rows%spacing)
      do i = 1, n
         r = e*hypot(along(i), across(i))
         value(i) = -2*sqrt(pi)/(e*rows%spacing) + e*origin_remainder(r)
         laplacian(i) = e**3*origin_remainder_laplacian(r)
      end do
      call add_lattice_points(rows, e, n, along, across, value, laplacian)
      call add_waves(rows, e, n, along, across, value, laplacian)
   end subroutine ewald_sum

   !> Adds the terms erfc(e r)/r of the lattice points but the origin, and their Laplacian by README.md (F21).
   pure subroutine add_lattice_points(rows, e, n, along, across, value, laplacian)
      type(row_lattice), intent(in) :: rows
      real(dp), intent(in) :: e                      !! [1/s]
      integer, intent(in) :: n
      real(dp), intent(in) :: along(n), across(n)
      real(dp), intent(inout) :: value(n), laplacian(n)

      real(dp) :: bell, farthest, square, term
      integer :: columns, i, j, k, most_rows

      farthest = cut_off/e
      most_rows = ceiling(farthest/rows%spacing + 0.5_dp)
      columns = ceiling(farthest + 1.0_dp + 0.5_dp*most_rows)
      do j = -most_rows, most_rows
         do i = -columns, columns
            if (i == 0 .and. j == 0) cycle
            do k = 1, n
               square = (along(k) - i - rows%shift*j)**2 + (across(k) - rows%spacing*j)**2
               if (square >= farthest**2) cycle
               associate (r => sqrt(square))
                  term = erfc(e*r)/r
               end associate
               bell = 2*e/sqrt(pi)*exp(-e**2*square)
               value(k) = value(k) + term
               laplacian(k) = laplacian(k) + term/square + bell*(1/square + 2*e**2)
            end do
         end do
      end do
   end subroutine add_lattice_points

   !> Adds the waves of the reciprocal lattice, k = (i, (j - i shift)/spacing), once for k and -k.
   pure subroutine add_waves(rows, e, n, along, across, value, laplacian)
      type(row_lattice), intent(in) :: rows
      real(dp), intent(in) :: e                      !! [1/s]
      integer, intent(in) :: n
      real(dp), intent(in) :: along(n), across(n)
      real(dp), intent(inout) :: value(n), laplacian(n)

      real(dp) :: farthest, k_across, k_along, length, term, weight
      integer :: columns, i, j, k, most_rows

      farthest = cut_off*e/pi
      columns = ceiling(farthest)
      most_rows = ceiling(farthest*rows%spacing + 0.5_dp*columns)
      do j = -most_rows, most_rows
         do i = 0, columns
            k_along = i
            k_across = (j - i*rows%shift)/rows%spacing
            length = hypot(k_along, k_across)
            if ((i == 0 .and. j <= 0) .or. length >= farthest) cycle
            weight = 2*erfc(pi*length/e)/(length*rows%spacing)
            do k = 1, n
               term = weight*cos(2*pi*(k_along*along(k) + k_across*across(k)))
               value(k) = value(k) + term
               laplacian(k) = laplacian(k) - (2*pi*length)**2*term
            end do
         end do
      end do
   end subroutine add_waves

   !> -erf(x)/x: what remains of the origin's term erfc(x)/x when 1/x is taken out.
   pure real(dp) function origin_remainder(x) result(value)
      real(dp), intent(in) :: x             !! >= 0

      value = -2/sqrt(pi)
      if (x > 0.0_dp) value = -erf(x)/x
   end function origin_remainder

   !> The Laplacian in the plane of -erf(x)/x; with 1/r^3 taken out of README.md (F21).
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

end module wavycon_ewald_sum
