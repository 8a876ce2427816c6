!> What unit sources on some lattice points do at a place: sums of 1/r or 1/r^3.
module wavycon_point_sources
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: point_sources

   type :: point_sources
      integer :: power = 1                     !! of 1/r: 1 or 3
      real(dp), allocatable :: point(:, :)     !! x and y, shape (2, m) [s]
   contains
      procedure :: evaluate
      procedure :: add
   end type point_sources

contains

   !> The sum and, if its slopes are given room, its gradient at n places.
   pure subroutine evaluate(self, n, x, y, value, slope_x, slope_y)
      class(point_sources), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)                             !! [s]
      real(dp), intent(out) :: value(n)                              !! [s^-power]
      real(dp), intent(out), optional :: slope_x(n), slope_y(n)      !! both or none [s^-(power+1)]

      value = 0.0_dp
      if (present(slope_x)) then
         slope_x = 0.0_dp
         slope_y = 0.0_dp
      end if
      call self%add(n, x, y, value, slope_x, slope_y)
   end subroutine evaluate

   !> Adds the same.
   pure subroutine add(self, n, x, y, value, slope_x, slope_y)
      class(point_sources), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: x(n), y(n)
      real(dp), intent(inout) :: value(n)
      real(dp), intent(inout), optional :: slope_x(n), slope_y(n)

      real(dp) :: inverse, inverse_square, of_cube, of_first
      integer :: i, k

      ! 1/r or 1/r^3 as 1/r (of_first + of_cube/r^2): with a choice in them the loops would not be of vectors.
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
   end subroutine add

end module wavycon_point_sources
