!> The spots of contact and the pools of gap of one cell, and whether contact and gap percolate: (A1) to (A5) of
!> README.md. Of a mirrored height map they are those of the map, a quarter of the cell.
module wavycon_contact_spots
   use, intrinsic :: iso_c_binding, only: c_size_t
   use wavycon_constants, only: pi
   use wavycon_contact_contours, only: contact_contour
   use wavycon_gsl, only: gsl_sort_index
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: or_nan, unknown
   implicit none (type, external)
   private

   public :: contact_region, contact_spots, find_spots, in_cell, one_region

   !> A connected part of the contact or of the gap.
   type :: contact_region
      real(dp) :: area_fraction = 0.0_dp   !! of the nominal area
      real(dp) :: perimeter = 0.0_dp       !! with that of its holes [length]; NaN in 1-D
      real(dp) :: load_fraction = 0.0_dp   !! of the load, of a spot; NaN if it is not known, and of pools
      !> X, Y of the centroid of what its outer edge encloses, 0 to 2 pi, on a mirrored map 0 to pi [rad]; NaN if it has
      !> no outer edge.
      real(dp) :: centre(2) = 0.0_dp
      integer :: holes = 0                 !! closed regions of the other kind in it
      logical :: percolates(2) = .false.   !! whether it goes on from cell to cell along x and y
   contains
      procedure :: is_closed
   end type contact_region

   !> Without a solution they are not allocated.
   type :: contact_spots
      type(contact_region), allocatable :: spots(:)          !! of contact, the largest first
      type(contact_region), allocatable :: pools(:)          !! of gap, the largest first
   contains
      procedure :: perimeter => total_perimeter
   end type contact_spots

   real(dp), parameter :: cell_area = (2*pi)**2   !! [rad^2]

contains

   !> Whether a region is bounded along x and y.
   elemental logical function is_closed(self)
      class(contact_region), intent(in) :: self

      is_closed = .not. any(self%percolates)
   end function is_closed

   !> The length of the edge of contact in one cell, or in the mirrored map [length]; NaN in 1-D.
   pure real(dp) function total_perimeter(self)
      class(contact_spots), intent(in) :: self

      ! Each curve bounds one spot and one pool.
      total_perimeter = sum(self%pools%perimeter)
      if (size(self%pools) == 0) total_perimeter = sum(self%spots%perimeter)
   end function total_perimeter

   !> The regions that curves divide a cell into. The numbers of spots and pools of the curves run from 1 without gaps.
   subroutine find_spots(curves, area, dimension, length, loads, is_map, answer)
      type(contact_contour), intent(in) :: curves(:)   !! all of the cell, at least one
      real(dp), intent(in) :: area                !! of the contact over the nominal area
      integer, intent(in) :: dimension            !! of the contact, 1 or 2
      real(dp), intent(in) :: length(2)           !! L_x, L_y [length]
      real(dp), intent(in) :: loads(:)            !! of the spots, over the load; of no size if they are not known
      !> Whether the cell is a map and its mirror images. In 2-D a region and its images then have one number.
      logical, intent(in) :: is_map
      type(contact_spots), intent(out) :: answer

      type(contact_region), allocatable :: spots(:), pools(:)

      if (dimension == 1) then
         call find_strips(curves, loads, is_map, spots, pools)
      else
         call find_regions(curves%spot, curves%pool, 1, curves, area, length, is_map, spots)
         call find_regions(curves%pool, curves%spot, -1, curves, 1.0_dp - area, length, is_map, pools)
         spots%load_fraction = or_nan(unknown)
         if (size(loads) == size(spots)) spots%load_fraction = loads
         pools%load_fraction = or_nan(unknown)
      end if
      call add_up_to(area, spots)
      call add_up_to(1.0_dp - area, pools)
      call sort_by_area(spots, answer%spots)
      call sort_by_area(pools, answer%pools)
   end subroutine find_spots

   !> The only region of a cell without an edge.
   subroutine one_region(is_contact, dimension, answer)
      logical, intent(in) :: is_contact        !! or a gap
      integer, intent(in) :: dimension
      type(contact_spots), intent(out) :: answer

      type(contact_region) :: region

      region%area_fraction = 1.0_dp
      region%perimeter = merge(0.0_dp, or_nan(unknown), dimension == 2)
      region%load_fraction = merge(1.0_dp, or_nan(unknown), is_contact)
      region%centre = or_nan(unknown)
      region%percolates = .true.
      allocate (answer%spots(merge(1, 0, is_contact)), source=region)
      allocate (answer%pools(merge(0, 1, is_contact)), source=region)
   end subroutine one_region

   !> The regions of one kind on a surface: (A2), (A3), (A5).
   subroutine find_regions(number, other, outwards, curves, total, length, is_map, regions)
      integer, intent(in) :: number(:)    !! of the region of each curve, from 1
      integer, intent(in) :: other(:)     !! of the region of the other kind on its other side, from 1
      integer, intent(in) :: outwards     !! turns of a curve about such a region: 1 for spots, -1 for pools
      type(contact_contour), intent(in) :: curves(:)
      real(dp), intent(in) :: total       !! area of all regions over the nominal area
      real(dp), intent(in) :: length(2)
      logical, intent(in) :: is_map       !! whether a number is that of a region and its mirror images
      type(contact_region), allocatable, intent(out) :: regions(:)

      integer :: excess, i, k
      logical :: has_outer(maxval(number)), goes_around(maxval(number)), is_counted(maxval(other))

      allocate (regions(maxval(number)))
      has_outer = .false.
      goes_around = .false.
      is_counted = .false.
      do i = 1, size(curves)
         associate (region => regions(number(i)), x => curves(i)%phi, y => curves(i)%theta)
            region%area_fraction = region%area_fraction + outwards*curves(i)%area/cell_area
            region%perimeter = region%perimeter + curve_length(curves(i), length)
            if (curves(i)%turns == outwards) then
               has_outer(number(i)) = .true.
               region%centre = centroid(curves(i), is_map)
            else if (curves(i)%turns == 0) then
               goes_around(number(i)) = .true.
               ! How many cells it goes on until it comes again.
               region%percolates = region%percolates .or. nint([x(size(x)) - x(1), y(size(y)) - y(1)]/(2*pi)) /= 0
            else if (.not. is_counted(other(i))) then
               ! A hole has one outer edge, but of a mirrored map it stands for its images too.
               is_counted(other(i)) = .true.
               region%holes = region%holes + 1
            end if
         end associate
      end do
      if (is_map) regions%perimeter = regions%perimeter/4
      do i = 1, size(regions)
         if (has_outer(i)) cycle
         regions(i)%centre = or_nan(unknown)
         if (goes_around(i)) then
            regions(i)%area_fraction = modulo(regions(i)%area_fraction, 1.0_dp)
         else
            regions(i)%area_fraction = 1.0_dp + regions(i)%area_fraction
            regions(i)%percolates = .true.
         end if
      end do
      ! The area of a band one point wide may be below zero, and is then that of nearly the whole cell by `modulo`.
      excess = merge(nint(sum(regions%area_fraction) - total), 0, any(goes_around))
      do i = 1, abs(excess)
         k = maxloc(sign(1, excess)*regions%area_fraction, 1, goes_around)
         regions(k)%area_fraction = regions(k)%area_fraction - sign(1, excess)
      end do
      regions%area_fraction = min(max(regions%area_fraction, 0.0_dp), 1.0_dp)
   end subroutine find_regions

   !> Scales the areas so that their sum is the total. They differ by rounding, where areas below zero were set to zero,
   !> and where the contact area is that which carries the load at the hardness.
   pure subroutine add_up_to(total, regions)
      real(dp), intent(in) :: total   !! over the nominal area
      type(contact_region), intent(inout) :: regions(:)

      if (sum(regions%area_fraction) > 0.0_dp) &
         regions%area_fraction = regions%area_fraction*(total/sum(regions%area_fraction))
   end subroutine add_up_to

   !> The strips of a 1-D contact and the gaps between them, of a mirrored map those of the map: all endless along y,
   !> none along x.
   subroutine find_strips(strips, loads, is_map, spots, pools)
      type(contact_contour), intent(in) :: strips(:)   !! of the cell, ascending
      real(dp), intent(in) :: loads(:)                 !! as of find_spots
      logical, intent(in) :: is_map
      type(contact_region), allocatable, intent(out) :: spots(:), pools(:)

      real(dp) :: load
      integer :: i, n

      n = size(strips)
      allocate (spots(n), pools(n))
      load = or_nan(unknown)
      do i = 1, n
         if (size(loads) == n) load = loads(i)
         spots(i) = strip(strips(i)%phi, load)
         associate (next => strips(mod(i, n) + 1), period => merge(2*pi, 0.0_dp, i == n))
            ! The last gap begins before the first strip, or ends a period on if that is in contact at 0.
            pools(i) = strip([strips(i)%phi(2), next%phi(1)] + period*merge([-1, 0], [0, 1], next%phi(1) > 0.0_dp), &
                             or_nan(unknown))
         end associate
      end do
      if (.not. is_map) return
      ! Those beyond the map are mirror images.
      spots = pack(spots, spots%area_fraction > 0.0_dp)
      pools = pack(pools, pools%area_fraction > 0.0_dp)

   contains

      !> A strip of the cell or, if that is a map and its image, the part in the map.
      pure type(contact_region) function strip(ends, load)
         real(dp), intent(in) :: ends(2)   !! [rad]
         real(dp), intent(in) :: load      !! over that of the cell

         real(dp) :: in_map(2)

         strip%area_fraction = (ends(2) - ends(1))/(2*pi)
         strip%perimeter = or_nan(unknown)
         strip%load_fraction = load
         strip%centre = in_cell([0.5_dp*sum(ends), 0.0_dp])
         strip%percolates(2) = .true.
         if (.not. is_map) return
         ! One between the borders of the map has the load of its mirror image too.
         if (ends(1) >= 0.0_dp .and. ends(2) <= pi) strip%load_fraction = 2*load
         in_map = min(max(ends, 0.0_dp), pi)
         strip%area_fraction = (in_map(2) - in_map(1))/pi
         strip%centre(1) = 0.5_dp*sum(in_map)
      end function strip

   end subroutine find_strips

   !> The length of a curve [length].
   pure real(dp) function curve_length(curve, length)
      type(contact_contour), intent(in) :: curve
      real(dp), intent(in) :: length(2)   !! L_x, L_y

      associate (n => size(curve%phi), x => curve%phi, y => curve%theta)
         curve_length = curve%length
         if (curve_length > 0.0_dp) return
         curve_length = sum(hypot(length(1)*(x(2:) - x(:n - 1)), length(2)*(y(2:) - y(:n - 1))))/(2*pi)
      end associate
   end function curve_length

   !> The centroid of the polygon in a closed curve, in the cell, on a mirrored map of its part in the map [rad]: (A5).
   pure function centroid(curve, is_map) result(centre)
      type(contact_contour), intent(in) :: curve
      logical, intent(in) :: is_map
      real(dp) :: centre(2)

      real(dp), dimension(size(curve%phi)) :: x, y
      real(dp) :: twice_area
      integer :: n

      n = size(x)
      x = curve%phi - curve%phi(1)
      y = curve%theta - curve%theta(1)
      associate (parts => x(:n - 1)*y(2:) - x(2:)*y(:n - 1))
         twice_area = sum(parts)
         centre = [sum(x)/n, sum(y)/n]
         if (abs(twice_area) > 0.0_dp) &
            centre = [sum((x(:n - 1) + x(2:))*parts), sum((y(:n - 1) + y(2:))*parts)]/(3*twice_area)
      end associate
      centre = in_cell(centre + [curve%phi(1), curve%theta(1)])
      if (.not. is_map) return
      centre = pi - abs(centre - pi)
      if (.not. abs(twice_area) > 0.0_dp) return
      if (crosses_border(curve%phi)) centre(1) = 2*moment(curve%phi, y)/twice_area
      if (crosses_border(curve%theta)) centre(2) = -2*moment(curve%theta, x)/twice_area
   end function centroid

   !> Whether a border of the map, a multiple of pi, lies between some of the angles.
   pure logical function crosses_border(angles)
      real(dp), intent(in) :: angles(:)

      crosses_border = floor(minval(angles)/pi) < floor(maxval(angles)/pi)
   end function crosses_border

   !> The integral of F(a) db along the polygon through the points (a, b), by Simpson's rule: F' is the place in the map
   !> of the angle a, pi - |pi - a| for 0 <= a <= 2 pi, and F(0) = 0.
   pure real(dp) function moment(a, b)
      real(dp), intent(in) :: a(:), b(:)

      real(dp) :: at_point(size(a)), between(size(a) - 1)
      integer :: n

      n = size(a)
      at_point = integral_of_place(a)
      between = integral_of_place(0.5_dp*(a(:n - 1) + a(2:)))
      moment = sum((b(2:) - b(:n - 1))*(at_point(:n - 1) + 4*between + at_point(2:)))/6
   end function moment

   !> F of `moment`.
   elemental real(dp) function integral_of_place(angle) result(integral)
      real(dp), intent(in) :: angle

      real(dp) :: rest

      rest = modulo(angle, 2*pi)
      integral = pi**2*floor(angle/(2*pi)) + merge(0.5_dp*rest**2, pi**2 - 0.5_dp*(2*pi - rest)**2, rest <= pi)
   end function integral_of_place

   !> The equivalent angle from 0 to 2 pi; one of 2 pi less rounding is 0, as 2 pi is.
   elemental real(dp) function in_cell(angle)
      real(dp), intent(in) :: angle

      real(dp), parameter :: rounding = 1e-12_dp

      in_cell = max(angle - 2*pi*floor(angle/(2*pi) + rounding), 0.0_dp)
   end function in_cell

   subroutine sort_by_area(regions, sorted)
      type(contact_region), intent(in) :: regions(:)
      type(contact_region), allocatable, intent(out) :: sorted(:)   !! the largest first

      integer(c_size_t) :: places(size(regions))

      call gsl_sort_index(places, -regions%area_fraction, 1_c_size_t, size(regions, kind=c_size_t))
      sorted = regions(int(places) + 1)
   end subroutine sort_by_area

end module wavycon_contact_spots
