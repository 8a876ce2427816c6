!> The largest value of a Fourier series.
module wavycon_series_peak
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_transform, only: grid_transform
   use wavycon_newton_maximiser, only: newton_maximiser
   use wavycon_kinds, only: dp, pi
   implicit none (type, external)
   private

   public :: find_peak

   !> Grid points to the shortest wave of the series. Newton's method starts from the highest of these points.
   integer, parameter :: points_per_wave = 16
   !> The largest modulus of a series of two variables is at most this factor times that at the points of the grid
   !> (Ehlich & Zeller, Math. Z. 86 (1964) 41-44). So crests are tried until no other crest can be higher.
   real(dp), parameter :: most_between = 1.0_dp/cos(pi/points_per_wave)**2
   !> Largest number of crests that are tried. It matters if many crests are equally high, as along a line.
   integer, parameter :: most_crests = 10

   !> A series as the field whose maximum Newton's method finds.
   type, extends(newton_maximiser) :: series_maximiser
      type(fourier_series) :: series
   contains
      procedure :: expand
   end type series_maximiser

contains

   !> Finds the largest value of a series and a point that has this value. The series is sampled on a grid; the
   !> maximiser climbs from the highest point, then from the highest point outside the neighbourhood of this crest, and
   !> so on.
   subroutine find_peak(series, peak, place)
      type(fourier_series), intent(in) :: series   !! series, not distributed
      real(dp), intent(out) :: peak                !! largest value
      real(dp), intent(out) :: place(2)            !! X, Y [rad]; the origin if the value there is as large

      !> Values whose difference is below this part of the largest are taken as equal: a value is a sum of up to
      !> thousands of waves, and is rounded.
      real(dp), parameter :: rounding = 1e-12_dp
      integer, parameter :: half_width = points_per_wave/2 - 1   ! of the neighbourhood of a crest, in points

      type(grid_transform) :: transform
      type(series_maximiser) :: field
      real(dp), allocatable :: values(:, :)
      real(dp) :: crest(2), found, hidden, largest   ! hidden: by how much a crest may exceed the points about it
      integer :: best(2), i, k, l, points(2)

      points = points_per_wave*max(1, series%last([1, 2]))
      if (series%last(2) == 0) points(2) = 1
      allocate (values(points(1), points(2)))
      call transform%start(points, even=.false., whole=.true.)
      call transform%sample(series, values)
      largest = maxval(abs(values))
      hidden = (most_between - 1.0_dp)*largest
      best = maxloc(values)
      if (values(1, 1) >= maxval(values) - rounding*largest) best = 1
      field%series = series
      peak = -huge(peak)
      place = 0.0_dp
      do i = 1, most_crests
         crest = point_angle(best, transform%points, transform%even)
         call field%maximise(crest, found)
         if (found > peak + rounding*largest) then
            peak = found
            place = crest
         end if
         ! Removes the points about this crest whose distance along x and y is below half of the shortest wave.
         do l = best(2) - half_width, best(2) + half_width
            do k = best(1) - half_width, best(1) + half_width
               values(modulo(k - 1, points(1)) + 1, modulo(l - 1, points(2)) + 1) = -huge(1.0_dp)
            end do
         end do
         best = maxloc(values)
         if (values(best(1), best(2)) + hidden <= peak) exit
      end do
   end subroutine find_peak

   !> Value, gradient and Hessian of the series.
   pure subroutine expand(self, place, height, gradient, hessian)
      class(series_maximiser), intent(in) :: self
      real(dp), intent(in) :: place(2)
      real(dp), intent(out) :: height, gradient(2), hessian(3)

      complex(dp) :: waves(0:self%series%last(1))
      integer :: k, l
      real(dp) :: numbers(0:self%series%last(1))

      height = 0.0_dp
      gradient = 0.0_dp
      hessian = 0.0_dp
      numbers = [(real(k, dp), k=0, self%series%last(1))]
      do l = -self%series%last(2), self%series%last(2)
         waves = self%series%row(l, self%series%last(1))*turn(numbers*place(1) + l*place(2))
         height = height + sum(waves%re)
         gradient = gradient - [sum(numbers*waves%im), l*sum(waves%im)]
         hessian = hessian - [sum(numbers**2*waves%re), l*sum(numbers*waves%re), l**2*sum(waves%re)]
      end do
      if (self%series%last(2) == 0) hessian(2:3) = [0.0_dp, hessian(1)]
   end subroutine expand

end module wavycon_series_peak
