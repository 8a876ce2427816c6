!> Fields that are cosine series in phi and theta: pressure and displacement.
module wavycon_cosine_series
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   implicit none (type, external)
   private

   public :: cosine_series, cosine_table, evaluate_line, folded

   !> f(phi, theta) = sum_ij c_ij cos(i phi) cos(j theta). In 1-D j = 0 alone.
   type :: cosine_series
      real(dp), allocatable :: c(:, :)   !! c(i, j), shape (0:n, 0:n) or (0:n, 0:0)
   contains
      procedure :: at
      procedure :: evaluate_on_grid
   end type cosine_series

contains

   !> The field at a point.
   pure real(dp) function at(self, phi, theta)
      class(cosine_series), intent(in) :: self
      real(dp), intent(in) :: phi, theta   !! [rad]

      real(dp) :: cosines(0:ubound(self%c, 1))
      integer :: i, j

      cosines = [(cos(i*phi), i=0, ubound(self%c, 1))]
      at = 0.0_dp
      do j = 0, ubound(self%c, 2)
         at = at + cos(j*theta)*dot_product(self%c(:, j), cosines)
      end do
   end function at

   !> The field at phi = pi k/N, theta = pi l/N, k, l = 0..N (l = 0 alone in 1-D).
   pure subroutine evaluate_on_grid(self, intervals, values)
      class(cosine_series), intent(in) :: self
      integer, intent(in) :: intervals                     !! N >= 1
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (0:N, 0:N) or (0:N, 0:0)

      real(dp) :: along_phi(0:intervals, 0:ubound(self%c, 1)), half_way(0:intervals, 0:ubound(self%c, 2))
      real(dp) :: along_theta(0:intervals, 0:ubound(self%c, 2))
      integer :: n, m, last

      n = ubound(self%c, 1)
      m = ubound(self%c, 2)
      last = merge(intervals, 0, m > 0)
      along_phi = cosine_table(intervals, n)
      along_theta = cosine_table(intervals, m)
      allocate (values(0:intervals, 0:last))
      call dgemm('N', 'N', intervals + 1, m + 1, n + 1, 1.0_dp, along_phi, intervals + 1, self%c, n + 1, &
                 0.0_dp, half_way, intervals + 1)
      call dgemm('N', 'T', intervals + 1, last + 1, m + 1, 1.0_dp, half_way, intervals + 1, &
                 along_theta, intervals + 1, 0.0_dp, values, intervals + 1)
   end subroutine evaluate_on_grid

   !> cos(i pi k/N), k = 0..N, i = 0..n. The angle is reduced in whole numbers, so that the symmetries of the cosine hold
   !> to the last bit and high harmonics are as exact as low ones.
   pure function cosine_table(intervals, harmonics) result(table)
      integer, intent(in) :: intervals   !! N >= 1
      integer, intent(in) :: harmonics   !! n >= 0
      real(dp) :: table(0:intervals, 0:harmonics)

      integer :: i, k, q

      do i = 0, harmonics
         do k = 0, intervals
            q = mod(i*k, 2*intervals)
            q = min(q, 2*intervals - q)
            if (2*q == intervals) then
               table(k, i) = 0.0_dp
            else if (2*q < intervals) then
               table(k, i) = cos(pi*q/intervals)
            else
               table(k, i) = -cos(pi*(intervals - q)/intervals)
            end if
         end do
      end do
   end function cosine_table

   !> The node of 0..N, phi = pi k/N, at which an even field has the value that it has at any node of the whole line.
   elemental integer function folded(k, intervals)
      integer, intent(in) :: k, intervals

      folded = modulo(k, 2*intervals)
      folded = min(folded, 2*intervals - folded)
   end function folded

   !> sum_i c_i cos(i x) and its derivative.
   pure subroutine evaluate_line(c, x, value, slope)
      real(dp), intent(in) :: c(0:)             !! shape (0:n)
      real(dp), intent(in) :: x                 !! [rad]
      real(dp), intent(out) :: value, slope

      complex(dp) :: turn, phase
      integer :: i

      turn = cmplx(cos(x), sin(x), dp)
      phase = (1.0_dp, 0.0_dp)
      value = c(0)
      slope = 0.0_dp
      do i = 1, ubound(c, 1)
         phase = phase*turn
         value = value + c(i)*real(phase)
         slope = slope - i*c(i)*aimag(phase)
      end do
   end subroutine evaluate_line

end module wavycon_cosine_series
