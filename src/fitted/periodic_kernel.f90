!> Green's functions of the half-space under loads on all points of a lattice.
!>
!> Two kernels are in use, as their sums over the lattice point n show:
!>
!>     Gp(x) = sum over n of 1/|x - n|, less its mean: the displacement by unit loads;
!>     Laplacian of Gp = sum over n of 1/|x - n|^3, which turns a gap into a pressure: README.md (F11).
!>
!> Either is 1/r^power about the origin plus a smooth part. On the rectangle about the origin that is the cell of the
!> lattice's rows the smooth part, less 1/r^power of the lattice points near by, is a polynomial in x^2 and y^2 to
!> rounding, README.md (F22). It is fitted once to Ewald's sum (F20). The Laplacian has a fit of its own:
!> differentiating the other one would amplify the rounding in its highest coefficients.
module wavycon_periodic_kernel
   use wavycon_even_polynomial, only: even_polynomial, fit_degree, fit_nodes, start_even_polynomial
   use wavycon_ewald_sum, only: ewald_sum
   use wavycon_kinds, only: dp
   use wavycon_point_sources, only: point_sources
   use wavycon_row_lattice, only: row_lattice
   implicit none (type, external)
   private

   public :: periodic_kernel, start_periodic_kernels

   !> The point sources are the lattice points near the origin, which are summed one by one; x is along the rows. Power
   !> 1 is Gp, power 3 its Laplacian.
   type, extends(point_sources) :: periodic_kernel
      type(row_lattice) :: rows
      type(even_polynomial) :: fit      !! of the smooth part without them; x along the rows
      logical :: whole = .false.        !! with the origin's own term, for places that are on none of the lattice points
   contains
      procedure :: evaluate
   end type periodic_kernel

   !> Rounding of Ewald's sum, whose terms are of order ten, and of its Laplacian.
   real(dp), parameter :: rounding(2) = [32, 320]*epsilon(1.0_dp)
   !> Least square of a distance. The inverse powers of a place and of the same place reduced must be equal and finite.
   real(dp), parameter :: least_square = 1e-100_dp
contains

   !> Fits both kernels of a lattice.
   subroutine start_periodic_kernels(rows, displacement, laplacian)
      type(row_lattice), intent(in) :: rows
      type(periodic_kernel), intent(out) :: displacement   !! Gp
      type(periodic_kernel), intent(out) :: laplacian      !! of Gp

      integer, parameter :: n = fit_degree
      real(dp), dimension(0:n, 0:n) :: distance, value, value_of_laplacian, x, y
      complex(dp), allocatable :: z(:)
      real(dp), allocatable :: near(:, :)
      integer :: k

      ! Fewer would take a fit of higher degree.
      z = rows%points_about(0.75_dp + 0.6_dp*max(rows%spacing, 1.0_dp), (0.0_dp, 0.0_dp))
      z = pack(z, abs(z) > 0.0_dp)
      near = reshape([z%re, z%im], [2, size(z)], order=[2, 1])
      if (rows%along_y) near = near([2, 1], :)
      call fit_nodes(rows%spacing, x, y)
      call ewald_sum(rows, size(x), x, y, value, value_of_laplacian)
      do k = 1, size(near, 2)
         distance = hypot(x - near(1, k), y - near(2, k))
         value = value - 1.0_dp/distance
         value_of_laplacian = value_of_laplacian - 1.0_dp/distance**3
      end do
      displacement%rows = rows
      displacement%point = near
      call start_even_polynomial(displacement%fit, rows%spacing, value, rounding(1))
      laplacian%power = 3
      laplacian%rows = rows
      laplacian%point = near
      call start_even_polynomial(laplacian%fit, rows%spacing, value_of_laplacian, rounding(2))
   end subroutine start_periodic_kernels

   !> The smooth part, which is the kernel less the origin's own term 1/r^power; or the whole kernel.
   pure subroutine evaluate(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      if (self%rows%along_y) then
         call evaluate_by_rows(self, n, y, x, value, slope_y, slope_x)
      else
         call evaluate_by_rows(self, n, x, y, value, slope_x, slope_y)
      end if
   end subroutine evaluate

   !> The same with x along the rows.
   pure subroutine evaluate_by_rows(self, n, x, y, value, slope_x, slope_y)
      class(periodic_kernel), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      real(dp), dimension(n) :: xr, yr
      real(dp) :: at_place, at_reduced
      logical :: moved
      integer :: i

      call self%rows%reduce_along_rows(n, x, y, xr, yr, moved)
      call self%fit%evaluate(n, xr, yr, value, slope_x, slope_y)
      call self%add(n, xr, yr, value, slope_x, slope_y)
      if (.not. (moved .or. self%whole)) return
      ! The origin's term is taken out at the place itself, not at the reduced place; for most places they are the same.
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
   end subroutine evaluate_by_rows

   !> 1/r or 1/r^3.
   pure real(dp) function inverse_power(power, inverse_square)
      integer, intent(in) :: power
      real(dp), intent(in) :: inverse_square   !! 1/r^2

      inverse_power = sqrt(inverse_square)
      if (power == 3) inverse_power = inverse_power*inverse_square
   end function inverse_power

end module wavycon_periodic_kernel
