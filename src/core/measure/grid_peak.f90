!> The largest pressure of a solution on a grid, interpolated between the points: eqs. (C13), (C13a) of
!> src/core/contact/README.md.
module wavycon_grid_peak
   use wavycon_full_contact, only: full_contact_patches
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   use wavycon_measure_tuning, only: most_crests, rise_factor
   use wavycon_newton_maximiser, only: newton_maximiser
   use wavycon_quantities, only: is_known, unknown
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_peak_pressure

   !> The points of the polynomial along each direction are -2 .. 3, so that the peak lies in the middle step, 0 to 1.
   integer, parameter :: first = -2, last = 3
   !> How far from a local maximum points are used, as one of the steps beside it is the middle step.
   integer, parameter :: reach = 3

   !> The polynomial of degree 5 along each direction through 6 x 6 pressures; coordinates are in steps of these points.
   type, extends(newton_maximiser) :: peak_polynomial
      real(dp) :: values(first:last, first:last) = 0.0_dp   !! pressures at the points, in 1-D the same in all columns
      logical :: in_plane = .true.                          !! false in 1-D
   contains
      procedure :: expand
   end type peak_polynomial

   !> A point of the grid whose pressure is a local maximum, and what is about it.
   type :: crest_type
      integer :: place(2) = 0             !! the point (k, l)
      real(dp) :: bend = 0.0_dp           !! as of grid_peak_pressure where not all points are in contact
      !> Pressures, or minus gaps, at the points up to `reach` steps from it.
      real(dp) :: values(-reach:reach, -reach:reach) = 0.0_dp
   end type crest_type

contains

   !> Finds the maximum of the polynomial through the points around the largest pressure, (C13). If a point of the
   !> polynomial is outside of contact, the result is the largest pressure at the points. At a crest on a mirror line,
   !> midway between two points, the polynomial is even.
   !>
   !> On a grid that does not resolve the waves of the surface it takes what the pressure of full contact is between the
   !> points, (C13a), at several local maxima.
   subroutine grid_peak_pressure(edge, peak, bend, surface)
      type(grid_edge), intent(in) :: edge   !! if the grid is distributed, after `fetch_neighbours`
      real(dp), intent(out) :: peak         !! the peak pressure, in the unit of the edge's pressure; with a surface p*
      !> For the error estimate (C16): zero if all points of the polynomial are in contact. Otherwise minus half the
      !> sum of the pressure's second differences at the largest pressure, or `unknown` if one of its four neighbours is
      !> not in contact. With a surface at least the difference between polynomials of two degrees, and how much higher
      !> than the peak another local maximum may be.
      real(dp), intent(out) :: bend
      !> The surface, without free edges, if the grid does not resolve its waves.
      type(surface_type), intent(in), optional :: surface

      integer :: place(2)
      real(dp) :: highest

      if (present(surface)) then
         call find_peak_between(edge, surface, peak, bend)
      else
         call edge%slab%find_largest(edge%pressure_or_gap, highest, place)
         call climb(crest_at(edge, place), edge%slab%points(2) > 1, peak, bend)
      end if
   end subroutine grid_peak_pressure

   !> The same by (C13a).
   subroutine find_peak_between(edge, surface, peak, bend)
      type(grid_edge), intent(in) :: edge
      type(surface_type), intent(in) :: surface
      real(dp), intent(out) :: peak, bend

      integer :: i, number, places(2, most_crests(surface%dimension))
      real(dp) :: possible   ! the highest pressure that a local maximum may have which is not taken as the peak
      real(dp), allocatable :: full(:, :, :)
      type(crest_type) :: crests(most_crests(surface%dimension))

      call find_crests(edge, places, number, possible)
      crests(:number) = [(crest_at(edge, places(:, i)), i=1, number)]
      call find_full_pressures()
      peak = 0.0_dp
      bend = unknown
      do i = 1, number
         call climb_between(crests(i), full(:, :, i), peak, bend, possible)
      end do
      bend = max(bend, possible - peak)

   contains

      !> The pressure of full contact, less its mean, about each crest: at the crossings of 15 lines along y with 15
      !> along x, in 1-D with one, shape (15, 15 or 1, crests). Lines 1 to 7 pass through points of the grid, 8 to 15
      !> through the fifths of the two steps beside the crest.
      subroutine find_full_pressures()
         real(dp), parameter :: lines(*) = [-3.0_dp, -2.0_dp, -1.0_dp, 0.0_dp, 1.0_dp, 2.0_dp, 3.0_dp, &
                                            -0.8_dp, -0.6_dp, -0.4_dp, -0.2_dp, 0.2_dp, 0.4_dp, 0.6_dp, 0.8_dp]
         real(dp) :: angles(size(lines), number, 2)
         integer :: crossed, highest(2), i, j

         do j = 1, number
            do i = 1, size(lines)
               angles(i, j, :) = edge%angles(crests(j)%place + lines(i))
            end do
         end do
         highest = edge%slab%points/2
         if (edge%even) highest = edge%slab%points - 1
         crossed = size(lines)
         if (surface%dimension == 1) crossed = 1
         allocate (full(size(lines), crossed, number), &
                   source=full_contact_patches(surface, highest, angles(:, :, 1), angles(:crossed, :, 2)))
      end subroutine find_full_pressures

   end subroutine find_peak_between

   !> What is about a point. The process that has the point looks, and all get its numbers.
   function crest_at(edge, place) result(crest)
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: place(2)
      type(crest_type) :: crest

      integer :: i, j
      real(dp) :: values(size(crest%values))

      values = 0.0_dp
      if (place(2) >= edge%slab%first .and. place(2) <= edge%slab%last) &
         values = [((edge%value_at(place(1) + i, place(2) + j), i=-reach, reach), j=-reach, reach)]
      values = edge%slab%total(values)
      crest%place = place
      crest%values = reshape(values, shape(crest%values))
      associate (p => crest%values)
         crest%bend = unknown
         if (all([p(-1:1, 0), p(0, -1:1)] > 0.0_dp)) crest%bend = 3*p(0, 0) - 0.5_dp*sum([p(-1:1, 0), p(0, -1:1)])
      end associate
   end function crest_at

   !> The peak by (C13).
   pure subroutine climb(crest, in_plane, peak, bend)
      type(crest_type), intent(in) :: crest
      logical, intent(in) :: in_plane             !! false in 1-D
      real(dp), intent(out) :: peak, bend         !! as of grid_peak_pressure

      !> How far the search may leave the middle step, where the polynomial is accurate [grid steps].
      real(dp), parameter :: margin = 0.5_dp
      type(peak_polynomial) :: field
      real(dp) :: height, position(2)
      integer :: base(2)

      ! Along each direction the middle step of the polynomial goes from the largest pressure to the larger one of its
      ! two neighbours. So a solution and its mirror image have the same peak.
      base = 0
      if (crest%values(-1, 0) > crest%values(1, 0)) base(1) = -1
      if (crest%values(0, -1) > crest%values(0, 1)) base(2) = -1
      field = peak_polynomial(least=-margin, most=1.0_dp + margin, in_plane=in_plane, &
                              values=crest%values(base(1) + first:base(1) + last, base(2) + first:base(2) + last))
      peak = max(maxval(field%values), 0.0_dp)
      bend = crest%bend
      if (any(field%values <= 0.0_dp)) return
      bend = 0.0_dp
      position = -base
      call field%maximise(position, height)
      peak = max(peak, height)
   end subroutine climb

   !> Raises the peak by (C13a) if it is higher in one of the steps, or cells of the grid, beside a crest. The pressure
   !> less that of full contact is interpolated by the polynomial of degree 5, 3 or 1 whose points are all in contact,
   !> to points a fifth of a step apart. A crest with a neighbour that is not in contact may be higher than that.
   pure subroutine climb_between(crest, full, peak, bend, possible)
      type(crest_type), intent(in) :: crest
      real(dp), intent(in) :: full(:, :)          !! pressure of full contact on the patch of `find_full_pressures`
      real(dp), intent(inout) :: peak, bend       !! as of grid_peak_pressure, of the crests before
      !> The highest pressure that one of them may have; it is raised to that of this crest, if its error is not known.
      real(dp), intent(inout) :: possible

      !> Largest pressure over that half a step beside it, of a contact whose half width is one step: Hertz's of a
      !> cylinder.
      real(dp), parameter :: rise_of_two = 2/sqrt(3.0_dp)
      !> Largest rise from half a step beside a kink to the kink over that in full contact, (C16a).
      real(dp), parameter :: rise_at_kink = 2.25_dp
      !> Lines of the patch: those of the polynomial, and those from one end of the middle step to the other, for the
      !> step before the crest and the one behind it.
      integer, parameter :: own(6, 2) = reshape([1, 2, 3, 4, 5, 6, 2, 3, 4, 5, 6, 7], [6, 2])
      integer, parameter :: fine(6, 2) = reshape([3, 8, 9, 10, 11, 4, 4, 12, 13, 14, 15, 5], [6, 2])
      !> Two cells of the grid have the same value at a point that both have, but for rounding.
      real(dp), parameter :: rounding = 1e-12_dp
      type(peak_polynomial) :: field
      real(dp), dimension(first:last, first:last) :: lower, smooth
      real(dp) :: height, position(2), this_bend
      integer :: along(6), degree, i, j, top(2)

      field%least = first
      field%most = last
      field%in_plane = size(full, 2) > 1
      do j = 1, 2
         do i = 1, 2
            associate (values => crest%values(first + i - 2:last + i - 2, first + j - 2:last + j - 2))
               degree = largest_degree(values)
               along = 1
               if (field%in_plane) along = own(:, j)
               smooth = values - full(own(:, i), along)
            end associate
            height = crest%values(0, 0)
            this_bend = crest%bend
            if (degree > 0) then
               if (field%in_plane) along = fine(:, j)
               field%values = full(fine(:, i), along) + to_fifths(smooth, degree)
               top = maxloc(field%values) - 1 + first
               position = top
               call field%maximise(position, height)
               height = max(height, crest%values(0, 0))
               if (degree == 5) this_bend = 0.0_dp
               if (degree > 1) then
                  lower = to_fifths(smooth, degree) - to_fifths(smooth, degree - 2)
                  this_bend = max(this_bend, abs(lower(top(1), top(2))))
               end if
            end if
            associate (p => crest%values(0, 0))
               if (.not. is_known(this_bend)) &
                  possible = max(possible, rise_of_two*height, p + rise_at_kink*(height - p))
            end associate
            if (height > (1.0_dp + rounding)*peak .or. (height >= (1.0_dp - rounding)*peak .and. this_bend < bend)) then
               peak = height
               bend = this_bend
            end if
         end do
      end do
   end subroutine climb_between

   !> The largest degree, 5, 3 or 1, of a polynomial whose points are all in contact; -1 if there is none.
   pure integer function largest_degree(values) result(degree)
      real(dp), intent(in) :: values(first:, first:)   !! pressures, or minus gaps, at the points of degree 5

      do degree = 5, 1, -2
         associate (low => (1 - degree)/2, high => (1 + degree)/2)
            if (all(values(low:high, low:high) > 0.0_dp)) return
         end associate
      end do
   end function largest_degree

   !> The values at fifths of the middle step, of the polynomial of a degree through points about this step.
   pure function to_fifths(values, degree) result(fifths)
      real(dp), intent(in) :: values(first:last, first:last)
      integer, intent(in) :: degree   !! 1, 3, 5
      real(dp) :: fifths(first:last, first:last)

      real(dp) :: at(first:last, first:last)   ! weights of the points, for each fifth
      real(dp) :: derivatives(first:last, 0:2)
      integer :: i

      at = 0.0_dp
      do i = first, last
         derivatives = weights(real(i - first, dp)/(last - first), degree)
         at(:, i) = derivatives(:, 0)
      end do
      fifths = matmul(transpose(at), matmul(values, at))
   end function to_fifths

   !> Finds the local maxima near which the largest pressure may be: the highest point, and those that are the highest
   !> after each has been raised by what its neighbours along x and y let expect between the points.
   subroutine find_crests(edge, best, number, left)
      type(grid_edge), intent(in) :: edge
      integer, intent(out) :: best(:, :)   !! their points (k, l), shape (2, n)
      integer, intent(out) :: number       !! how many there are, at most n
      real(dp), intent(out) :: left        !! the highest raised pressure of those that are left out, or 0

      !> Maxima below this part of the largest pressure are left out, to save time. With 0.7 no peak changes, with 0.8
      !> the root mean square error of peaks is 1.3 times as large. But kinks of 0.56 of it were found that have the
      !> true peak: (C16a) must see them.
      real(dp), parameter :: least_part = 0.4_dp
      !> Maxima that differ by less than this part are mirror images or repetitions: of them one is tried.
      real(dp), parameter :: alike = 1e-6_dp
      real(dp) :: expected, highest, top(1)
      real(dp) :: raised(size(best, 2) + 1)          ! of the own points, falling; then 0
      integer :: own(2, size(best, 2) + 1)           ! their places
      integer :: i, j, k, l, m, most
      logical :: is_top   ! whether this process has the most hopeful maximum, or one like it

      m = edge%slab%points(1)
      most = size(best, 2)
      call edge%slab%find_largest(edge%pressure_or_gap, highest, best(:, 1))
      raised = 0.0_dp
      own = 0
      left = 0.0_dp
      do j = edge%slab%first, edge%slab%last
         if (.not. edge%may_touch(j)) cycle
         associate (p => edge%pressure_or_gap(:, j - edge%slab%first + 1))
            do i = 1, m
               ! One neighbour after the other: most points are no maxima along x.
               if (p(i) <= least_part*max(highest, 0.0_dp)) cycle
               if (p(i) < p(max(i - 1, 1))) cycle
               if (p(i) < p(min(i + 1, m))) cycle
               if (any(p(i) < [((edge%value_at(i + k, j + l), k=-1, 1), l=-1, 1)])) cycle
               if (highest - p(i) <= alike*highest) cycle
               expected = p(i) + rise([(edge%value_at(i + k, j), k=-2, 2)]) + rise([(edge%value_at(i, j + l), l=-2, 2)])
               if (expected <= raised(most) .or. any(abs(raised - expected) <= alike*expected)) cycle
               k = count(raised >= expected) + 1
               raised(k + 1:) = raised(k:most)
               own(:, k + 1:) = own(:, k:most)
               raised(k) = expected
               own(:, k) = [i, j]
            end do
         end associate
      end do
      raised(most + 1) = 0.0_dp
      ! The most hopeful one of all processes, one after the other. Of equal ones the first in the order of the grid.
      i = 1
      do number = 1, most
         top = edge%slab%largest(raised(i:i))
         left = top(1)
         if (number == most .or. .not. left > 0.0_dp) return
         is_top = raised(i) >= (1.0_dp - alike)*left
         best(:, number + 1) = edge%slab%first_point(is_top, own(:, i))
         if (is_top) i = i + 1
      end do
   end subroutine find_crests

   !> How far the pressure is expected to rise from a point towards the larger one of its two neighbours along a line:
   !> to the linear interpolation midway, plus `rise_factor` times what the cubic one adds to that. Gaps count as zero.
   pure real(dp) function rise(line)
      real(dp), intent(in) :: line(-2:2)   !! pressures, or minus gaps, at the point and its neighbours

      real(dp) :: p(-1:2)   ! the same, from the smaller neighbour on

      p = max(line(-1:2), 0.0_dp)
      if (line(-1) > line(1)) p = max(line(1:-2:-1), 0.0_dp)
      rise = 0.0_dp
      if (p(1) > 0.0_dp) &
         rise = max(0.5_dp*(p(1) - p(0)) + rise_factor/16*(p(0) + p(1) - p(-1) - p(2)), 0.0_dp)
   end function rise

   !> The polynomial and its derivatives at a point. In 1-D the second direction gets the curvature of the first one and
   !> no slope, so that Newton's step along it is zero.
   pure subroutine expand(self, place, height, gradient, hessian)
      class(peak_polynomial), intent(in) :: self
      real(dp), intent(in) :: place(2)                !! [grid steps]
      real(dp), intent(out) :: height                 !! value of the polynomial
      real(dp), intent(out) :: gradient(2)            !! derivatives along x, y
      real(dp), intent(out) :: hessian(3)             !! derivatives xx, xy, yy

      real(dp), dimension(first:last, 0:2) :: along_x, along_y
      real(dp) :: derivatives(0:2, 0:2)   ! (i, j): of order i along x and j along y

      along_x = weights(place(1), last - first)
      along_y = weights(place(2), last - first)
      derivatives = matmul(transpose(along_x), matmul(self%values, along_y))
      height = derivatives(0, 0)
      gradient = [derivatives(1, 0), derivatives(0, 1)]
      hessian = [derivatives(2, 0), derivatives(1, 1), derivatives(0, 2)]
      if (self%in_plane) return
      gradient(2) = 0.0_dp
      hessian(2:3) = [0.0_dp, hessian(1)]
   end subroutine expand

   !> The Lagrange polynomials of the points of a degree at a coordinate, and their first and second derivatives; zero
   !> for the other points.
   pure function weights(t, degree)
      real(dp), intent(in) :: t              !! coordinate [grid steps]
      integer, intent(in) :: degree          !! 1, 3, 5
      real(dp) :: weights(first:last, 0:2)   !! second index: order of the derivative

      integer :: i, k

      weights = 0.0_dp
      do k = (1 - degree)/2, (1 + degree)/2
         ! The product of (t - i)/(k - i) over all i /= k: its value, first derivative and half its second derivative.
         weights(k, 0) = 1.0_dp
         do i = (1 - degree)/2, (1 + degree)/2
            if (i /= k) weights(k, :) = ((t - i)*weights(k, :) + [0.0_dp, weights(k, :1)])/(k - i)
         end do
      end do
      weights(:, 2) = 2*weights(:, 2)
   end function weights

end module wavycon_grid_peak
