!> Sums over the aliases of each wave of a grid, which are the waves that have the same values at its points. The sums
!> are the compliance and the stiffness of a field that is bilinear between the points, bounded from above: (E20) and
!> (E21) of README.md in this directory.
module wavycon_alias_sums
   use wavycon_kinds, only: dp, pi
   use wavycon_threads, only: threads_for
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: alias_sums

   !> Number of aliases on each side of a wave, along x and y, that are summed one by one, A of (E22). The others are
   !> bounded by integrals. With 2 and 4 in place of 1 the bounds of the wave on 2048 x 2048 points are .43 and .49 %
   !> closer, those of a rough map on 256 x 256 points .63 and .73 %; the wave's bounds then take 1.1 and 2 times as
   !> long.
   integer, parameter :: aliases = 1

   !> Sums for the waves k = 0 .. last(1) in X and l = 0 .. last(2) in Y, in units of `wave_stiffness`.
   type :: alias_sums
      real(dp), allocatable :: frequency(:, :)    !! f of (E20), the stiffness of the wave itself
      real(dp), allocatable :: weight(:, :)       !! w of (E19), the part of the wave itself in the bilinear field
      real(dp), allocatable :: compliance(:, :)   !! C of (E20), sum of w^2/stiffness over the wave and its aliases
      real(dp), allocatable :: stiffness(:, :)    !! D of (E21), sum of w^2*stiffness over the aliases alone
   contains
      procedure :: start
   end type alias_sums

   !> The data of one axis: the waves k of a line of n points and their aliases k + a n.
   type :: alias_line
      real(dp), allocatable :: weight(:, :)       !! sinc^2 of (E19), shape (0:last, -aliases:aliases)
      real(dp), allocatable :: frequency(:, :)    !! one over the wavelength [1/length], same shape
      !> Bounds of sums of weight^2*frequency^(4 - m), shape (0:last, 3:5): over the aliases with |a| > aliases; and,
      !> for m = 3 and 4, over the wave and all aliases.
      real(dp), allocatable, dimension(:, :) :: far, every
   end type alias_line

contains

   !> Computes the sums. The far aliases are bounded first, by f >= f_x and f >= f_y in the compliance and by
   !> f <= f_x + f_y in the stiffness; the near ones are then added one by one.
   subroutine start(self, points, length, last, kernel)
      class(alias_sums), intent(out) :: self
      integer, intent(in) :: points(2)      !! points of the grid on the whole cell, >= 1; 1 along y in 1-D
      real(dp), intent(in) :: length(2)     !! sides of the cell [length], > 0
      integer, intent(in) :: last(2)        !! highest wave numbers in X and Y, at most half of the points
      type(wave_stiffness), intent(in) :: kernel   !! half-spaces, or a layer on a rigid base

      integer :: a, b, l
      real(dp) :: far(1), closest   ! stiffness and frequency of the longest alias that is not summed alone
      real(dp), allocatable :: stiffness(:), weight(:)
      type(alias_line) :: x, y

      x = line_of(points(1), length(1), last(1))
      y = line_of(points(2), length(2), last(2))
      allocate (self%frequency(0:last(1), 0:last(2)), source=0.0_dp)
      allocate (self%weight, self%compliance, self%stiffness, mold=self%frequency)
      closest = (aliases + 0.5_dp)*minval(points/length, points > 1 .or. [.true., .false.])
      far = closest**2
      call kernel%of(far)
      !$omp parallel do num_threads(threads_for(size(self%frequency))) schedule(static) private(a, b, stiffness, weight)
      do l = 0, last(2)
         self%compliance(:, l) = x%far(:, 5)*y%every(l, 4) + x%every(:, 4)*y%far(l, 5)
         ! On a layer shorter waves are less compliant, and no stiffer over their frequency (E32).
         self%stiffness(:, l) = far(1)/closest*( &
            x%far(:, 3)*y%every(l, 4) + x%far(:, 4)*y%every(l, 3) &
            + x%every(:, 3)*y%far(l, 4) + x%every(:, 4)*y%far(l, 3))
         do b = -aliases, aliases
            if (y%weight(l, b) <= 0.0_dp) cycle
            do a = -aliases, aliases
               weight = x%weight(:, a)*y%weight(l, b)
               stiffness = x%frequency(:, a)**2 + y%frequency(l, b)**2
               call kernel%of(stiffness)
               if (a == 0 .and. b == 0) then
                  self%weight(:, l) = weight
                  self%frequency(:, l) = stiffness
               else
                  self%stiffness(:, l) = self%stiffness(:, l) + weight**2*stiffness
               end if
               where (stiffness > 0.0_dp) self%compliance(:, l) = self%compliance(:, l) + weight**2/stiffness
            end do
         end do
      end do
      !$omp end parallel do
   end subroutine start

   !> Computes the data of one axis. In units of n/length the wave k has the frequency x = k/n and its aliases have x +
   !> a. Then sinc^2 is (sin(pi x)/pi)^2/(x + a)^2, and (E22) bounds the sums of |x + a|^(-m) over the far aliases.
   pure type(alias_line) function line_of(points, length, last) result(line)
      integer, intent(in) :: points     !! n, number of points along the axis
      real(dp), intent(in) :: length    !! side of the cell [length]
      integer, intent(in) :: last       !! highest wave number

      integer :: a, k, m
      real(dp) :: unit   ! unit of the frequencies [1/length]
      real(dp) :: s(0:last), x(0:last)

      unit = points/length
      x = [(k, k=0, last)]/real(points, dp)
      s = (sin(pi*x)/pi)**2
      allocate (line%weight(0:last, -aliases:aliases), line%far(0:last, 3:5))
      allocate (line%frequency, mold=line%weight)
      do a = -aliases, aliases
         line%frequency(:, a) = abs(x + a)*unit
         line%weight(1:, a) = s(1:)/(x(1:) + a)**2
         line%weight(0, a) = merge(1.0_dp, 0.0_dp, a == 0)
      end do
      do m = 3, 5
         line%far(:, m) = s**2*(((aliases + 0.5_dp + x)**(1 - m) + (aliases + 0.5_dp - x)**(1 - m))/(m - 1)) &
                          *unit**(4 - m)
      end do
      line%every = line%far
      line%every(:, 3) = line%far(:, 3) + sum(line%weight**2*line%frequency, dim=2)
      line%every(:, 4) = line%far(:, 4) + sum(line%weight**2, dim=2)
   end function line_of

end module wavycon_alias_sums
