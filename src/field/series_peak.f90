!> The largest value of a field.
module wavycon_series_peak
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: find_peak

   !> Points to the shortest wave, from the best of which Newton's method climbs to the peak.
   integer, parameter :: points_per_wave = 16
   !> Crests are tried until none that is left can be higher: between the points of a plane a field may be larger by
   !> this factor (Ehlich & Zeller, Math. Z. 86 (1964) 41-44). Of many as high, as along a line, so many are tried.
   real(dp), parameter :: most_between = 1.0_dp/cos(pi/points_per_wave)**2
   integer, parameter :: most_crests = 10

contains

   subroutine find_peak(series, peak, place)
      type(fourier_series), intent(in) :: series
      real(dp), intent(out) :: peak
      real(dp), intent(out) :: place(2)   !! X, Y [rad]; the origin, if the field is largest there too

      !> Of values on the points that pass for equal, over the largest: sums of up to thousands of waves.
      real(dp), parameter :: rounding = 1e-12_dp

      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: crest(2), height, hidden, largest
      integer :: best(2), i, points(2)

      points = points_per_wave*max(1, ubound(series%c))
      if (ubound(series%c, 2) == 0) points(2) = 1
      allocate (values(points(1), points(2)))
      call transform%start(points, even=.false.)
      call transform%sample(series, values)
      largest = maxval(abs(values))
      hidden = (most_between - 1.0_dp)*largest
      best = maxloc(values)
      if (values(1, 1) >= maxval(values) - rounding*largest) best = 1
      peak = -huge(peak)
      place = 0.0_dp
      do i = 1, most_crests
         crest = [transform%x_angle(best(1)), transform%y_angle(best(2))]
         call climb(series, crest)
         height = series%at(crest(1), crest(2))
         if (height > peak + rounding*largest) then
            peak = height
            place = crest
         end if
         call take_out(values, best)
         best = maxloc(values)
         if (values(best(1), best(2)) + hidden <= peak) exit
      end do
   end subroutine find_peak

   !> Takes out the points about a crest, less than half the shortest wave away.
   pure subroutine take_out(values, place)
      real(dp), intent(inout) :: values(:, :)
      integer, intent(in) :: place(2)

      integer, parameter :: reach = points_per_wave/2 - 1
      integer :: i, j

      do j = place(2) - reach, place(2) + reach
         do i = place(1) - reach, place(1) + reach
            values(modulo(i - 1, size(values, 1)) + 1, modulo(j - 1, size(values, 2)) + 1) = -huge(1.0_dp)
         end do
      end do
   end subroutine take_out

   !> Newton's method for a maximum, a little short of it so that it also climbs to a crest that is the same all
   !> along a line. It stops where it gains nothing more.
   pure subroutine climb(series, place)
      type(fourier_series), intent(in) :: series
      real(dp), intent(inout) :: place(2)

      integer, parameter :: most_steps = 20
      real(dp), parameter :: short = 1e-3_dp
      real(dp) :: determinant, g(2), h(3), largest, scale, step(2), next(2)
      integer :: i

      do i = 1, most_steps
         call derivatives(series, place, g, h)
         if (ubound(series%c, 2) == 0) h(2:3) = [0.0_dp, h(1)]
         ! Squares of curvatures in unlike units may overflow.
         scale = maxval(abs(h))
         if (.not. scale > 0.0_dp) return
         g = g/scale
         h = h/scale
         ! The larger eigenvalue is that along the line, and zero but for rounding.
         largest = 0.5_dp*(h(1) + h(3)) + hypot(0.5_dp*(h(1) - h(3)), h(2))
         h([1, 3]) = h([1, 3]) - max(largest, 0.0_dp) - short
         determinant = h(1)*h(3) - h(2)**2
         if (.not. determinant > 0.0_dp) return
         step = [h(3)*g(1) - h(2)*g(2), h(1)*g(2) - h(2)*g(1)]/determinant
         next = place - step
         if (.not. series%at(next(1), next(2)) > series%at(place(1), place(2))) return
         place = next
      end do
   end subroutine climb

   !> First derivatives by X, Y and second by XX, XY, YY.
   pure subroutine derivatives(series, place, first, second)
      type(fourier_series), intent(in) :: series
      real(dp), intent(in) :: place(2)
      real(dp), intent(out) :: first(2), second(3)

      real(dp) :: cx, cy, sx, sy, f, f_x, f_y, f_xy
      integer :: i, j

      first = 0.0_dp
      second = 0.0_dp
      do j = 0, ubound(series%c, 2)
         cy = cos(j*place(2))
         sy = sin(j*place(2))
         do i = 0, ubound(series%c, 1)
            cx = cos(i*place(1))
            sx = sin(i*place(1))
            f = series%c(i, j)*cx*cy
            f_x = -series%c(i, j)*sx*cy
            f_y = -series%c(i, j)*cx*sy
            f_xy = series%c(i, j)*sx*sy
            if (.not. series%is_even()) then
               f = f + series%cs(i, j)*cx*sy + series%sc(i, j)*sx*cy + series%ss(i, j)*sx*sy
               f_x = f_x - series%cs(i, j)*sx*sy + series%sc(i, j)*cx*cy + series%ss(i, j)*cx*sy
               f_y = f_y + series%cs(i, j)*cx*cy - series%sc(i, j)*sx*sy + series%ss(i, j)*sx*cy
               f_xy = f_xy - series%cs(i, j)*sx*cy - series%sc(i, j)*cx*sy + series%ss(i, j)*cx*cy
            end if
            first = first + [i*f_x, j*f_y]
            second = second + [-real(i, dp)**2*f, i*j*f_xy, -real(j, dp)**2*f]
         end do
      end do
   end subroutine derivatives

end module wavycon_series_peak
