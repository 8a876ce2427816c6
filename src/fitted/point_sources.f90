!> Sums of 1/r or 1/r^3 over a few lattice points.
module wavycon_point_sources
   use wavycon_kinds, only: dp
   use wavycon_pair_kernel, only: pair_kernel
   implicit none (type, external)
   private

   public :: point_sources

   type, extends(pair_kernel) :: point_sources
      integer :: power = 1                     !! of 1/r: 1 or 3
      real(dp), allocatable :: point(:, :)     !! x and y, shape (2, m) [s]
   contains
      procedure :: evaluate
      procedure :: add
   end type point_sources

contains

   pure subroutine evaluate(self, n, x, y, value, slope_x, slope_y)
      class(point_sources), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)
      real(dp), intent(out) :: value(n)
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)

      value = 0.0_dp
      if (present(slope_x)) then
         slope_x = 0.0_dp
         slope_y = 0.0_dp
      end if
      call self%add(n, x, y, value, slope_x, slope_y)
   end subroutine evaluate

   !> Adds the sum and, if its slopes are given, its gradient at n places.
   pure subroutine add(self, n, x, y, value, slope_x, slope_y)
      class(point_sources), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                             !! [s]
      real(dp), intent(inout) :: value(n)                            !! [s^-power]
      real(dp), intent(inout), optional :: slope_x(n), slope_y(n)    !! both or none [s^-(power+1)]

      integer :: k

      do k = 1, size(self%point, 2)
         if (present(slope_x)) then
            call add_with_slopes(self%power, self%point(1, k), self%point(2, k), n, x, y, value, slope_x, slope_y)
         else
            call add_values(self%power, self%point(1, k), self%point(2, k), n, x, y, value)
         end if
      end do
   end subroutine add

   !> The term of one point at (a, b).
   pure subroutine add_values(power, a, b, n, x, y, value)
      integer, intent(in) :: power, n
      real(dp), intent(in) :: a, b, x(n), y(n)
      real(dp), intent(inout) :: value(n)

      integer :: i

      if (power == 1) then
         do i = 1, n
            value(i) = value(i) + sqrt(1.0_dp/((x(i) - a)**2 + (y(i) - b)**2))
         end do
      else
         do i = 1, n
            value(i) = value(i) + inverse_cube(1.0_dp/((x(i) - a)**2 + (y(i) - b)**2))
         end do
      end if
   end subroutine add_values

   !> The same with its gradient.
   pure subroutine add_with_slopes(power, a, b, n, x, y, value, slope_x, slope_y)
      integer, intent(in) :: power, n
      real(dp), intent(in) :: a, b, x(n), y(n)
      real(dp), intent(inout), dimension(n) :: value, slope_x, slope_y

      real(dp) :: inverse, inverse_square
      integer :: i

      if (power == 1) then
         do i = 1, n
            inverse_square = 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2)
            inverse = sqrt(inverse_square)
            value(i) = value(i) + inverse
            inverse = inverse*inverse_square
            slope_x(i) = slope_x(i) - (x(i) - a)*inverse
            slope_y(i) = slope_y(i) - (y(i) - b)*inverse
         end do
      else
         do i = 1, n
            inverse_square = 1.0_dp/((x(i) - a)**2 + (y(i) - b)**2)
            inverse = inverse_cube(inverse_square)
            value(i) = value(i) + inverse
            inverse = 3*inverse*inverse_square
            slope_x(i) = slope_x(i) - (x(i) - a)*inverse
            slope_y(i) = slope_y(i) - (y(i) - b)*inverse
         end do
      end if
   end subroutine add_with_slopes

   pure real(dp) function inverse_cube(inverse_square)
      real(dp), intent(in) :: inverse_square   !! 1/r^2

      inverse_cube = sqrt(inverse_square)*inverse_square
   end function inverse_cube

end module wavycon_point_sources
