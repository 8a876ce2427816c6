!> The spots of contact and the pools of gap of one periodic cell, and whether contact and gap percolate: (A1) to (A5)
!> of README.md. On a mirrored height map the regions are those of the map, which is a quarter of the cell.
module wavycon_contact_spots
   use wavycon_contact_contours, only: contact_contour
   use wavycon_gsl, only: ascending_order
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: or_nan, unknown
   implicit none (type, external)
   private

   public :: connected_region, contact_spots, find_spots, in_cell, one_region

   !> A connected part of the contact or of the gap.
   type :: connected_region
      real(dp) :: area_fraction = 0.0_dp   !! area of the region over the nominal area
      real(dp) :: perimeter = 0.0_dp       !! length of all its edges, also those of its holes [length]; NaN in 1-D
      real(dp) :: load_fraction = 0.0_dp   !! part of the load that a spot carries; NaN if not known, and for pools
      !> X, Y of the centroid of the area within the outer edge, holes included [rad]: 0 to 2 pi, on a mirrored map 0 to
      !> pi. NaN if the region has no outer edge.
      real(dp) :: centre(2) = 0.0_dp
      integer :: holes = 0                 !! number of closed regions of the other kind inside the region
      logical :: percolates(2) = .false.   !! whether the region continues from cell to cell along x, and along y
   contains
      procedure :: is_closed
   end type connected_region

   !> All regions of one solution. If the load has no solution, the components are not allocated.
   type :: contact_spots
      type(connected_region), allocatable :: spots(:)        !! regions of contact, the largest first
      type(connected_region), allocatable :: pools(:)        !! regions of gap, the largest first
   contains
      procedure :: perimeter => total_perimeter
   end type contact_spots

   real(dp), parameter :: cell_area = (2*pi)**2   !! [rad^2]

contains

   !> Whether a region is bounded along both x and y.
   elemental logical function is_closed(self)
      class(connected_region), intent(in) :: self

      is_closed = .not. any(self%percolates)
   end function is_closed

   !> The length of the edge of contact in one cell, of a mirrored map in the map [length]; NaN in 1-D.
   pure real(dp) function total_perimeter(self)
      class(contact_spots), intent(in) :: self

      ! Each curve bounds one spot and one pool, so that the sums over spots and over pools are equal.
      total_perimeter = sum(self%pools%perimeter)
      if (size(self%pools) == 0) total_perimeter = sum(self%spots%perimeter)
   end function total_perimeter

   !> Finds the regions into which the curves of the edge divide a cell. Together the curves must have all numbers of
   !> spots from 1 to the largest, and the same for pools.
   subroutine find_spots(curves, area, dimension, length, is_map, answer)
      type(contact_contour), intent(in) :: curves(:)   !! all curves of the cell, at least one
      real(dp), intent(in) :: area                !! contact area over the nominal area
      integer, intent(in) :: dimension            !! 1: the contact is a set of strips; 2: of spots
      real(dp), intent(in) :: length(2)           !! L_x, L_y [length]
      !> Whether the cell consists of a map and its mirror images. In 2-D a region and its images have the same number.
      logical, intent(in) :: is_map
      type(contact_spots), intent(out) :: answer

      type(connected_region), allocatable :: spots(:), pools(:)

      if (dimension == 1) then
         call find_strips(curves, is_map, spots, pools)
      else
         call find_regions(curves%spot, curves%pool, 1, curves, area, length, is_map, spots)
         call find_regions(curves%pool, curves%spot, -1, curves, 1.0_dp - area, length, is_map, pools)
         pools%load_fraction = or_nan(unknown)
      end if
      call add_up_to(area, spots)
      call add_up_to(1.0_dp - area, pools)
      answer%spots = spots(ascending_order(-spots%area_fraction))
      answer%pools = pools(ascending_order(-pools%area_fraction))
   end subroutine find_spots

   !> Sets the only region of a cell without an edge: the whole cell.
   subroutine one_region(is_contact, dimension, answer)
      logical, intent(in) :: is_contact        !! true: full contact; false: no contact
      integer, intent(in) :: dimension         !! of the contact, 1 or 2
      type(contact_spots), intent(out) :: answer

      type(connected_region) :: region

      region%area_fraction = 1.0_dp
      region%perimeter = merge(0.0_dp, or_nan(unknown), dimension == 2)
      region%load_fraction = merge(1.0_dp, or_nan(unknown), is_contact)
      region%centre = or_nan(unknown)
      region%percolates = .true.
      allocate (answer%spots(merge(1, 0, is_contact)), source=region)
      allocate (answer%pools(merge(0, 1, is_contact)), source=region)
   end subroutine one_region

   !> Finds the regions of one kind, spots or pools, in 2-D: (A2), (A3), (A5).
   subroutine find_regions(number, other, outwards, curves, total, length, is_map, regions)
      integer, intent(in) :: number(:)    !! for each curve, the number of the region of this kind beside it, from 1
      integer, intent(in) :: other(:)     !! for each curve, the number of the region of the other kind, from 1
      integer, intent(in) :: outwards     !! `turns` of the outer edge of a region: 1 for spots, -1 for pools
      type(contact_contour), intent(in) :: curves(:)
      real(dp), intent(in) :: total       !! area of all regions of this kind over the nominal area
      real(dp), intent(in) :: length(2)   !! L_x, L_y [length]
      logical, intent(in) :: is_map       !! whether a region and its mirror images have the same number
      type(connected_region), allocatable, intent(out) :: regions(:)

      integer :: excess, i, k   ! excess: whole cells by which the sum of the areas is too large
      logical :: has_outer(maxval(number)), goes_around(maxval(number)), is_counted(maxval(other))

      allocate (regions(maxval(number)))
      has_outer = .false.
      goes_around = .false.
      is_counted = .false.
      do i = 1, size(curves)
         associate (region => regions(number(i)), x => curves(i)%phi, y => curves(i)%theta)
            region%area_fraction = region%area_fraction + outwards*curves(i)%area/cell_area
            region%perimeter = region%perimeter + curve_length(curves(i), length)
            region%load_fraction = or_nan(curves(i)%load)
            if (curves(i)%turns == outwards) then
               has_outer(number(i)) = .true.
               region%centre = centroid(curves(i), is_map)
            else if (curves(i)%turns == 0) then
               goes_around(number(i)) = .true.
               ! The curve winds around the cell: along x, y or both it ends whole periods from its start.
               region%percolates = region%percolates .or. nint([x(size(x)) - x(1), y(size(y)) - y(1)]/(2*pi)) /= 0
            else if (.not. is_counted(other(i))) then
               ! This curve is the outer edge of a hole. A hole of a mirrored map has images with the same number, each
               ! with an edge of its own, but is counted once.
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
      ! The computed area of a band one point wide may be less than zero. `modulo` then makes nearly the whole cell of
      ! it. So the number of whole cells is chosen such that the sum of all areas is the given total.
      excess = 0
      if (any(goes_around)) excess = nint(sum(regions%area_fraction) - total)
      do i = 1, abs(excess)
         k = maxloc(sign(1, excess)*regions%area_fraction, 1, goes_around)
         regions(k)%area_fraction = regions(k)%area_fraction - sign(1, excess)
      end do
      regions%area_fraction = min(max(regions%area_fraction, 0.0_dp), 1.0_dp)
   end subroutine find_regions

   !> Scales the areas of regions so that their sum is a given total. Before, the sum differs from the total by
   !> rounding, because areas below zero were set to zero, and where the total is the area that carries the load at the
   !> hardness.
   pure subroutine add_up_to(total, regions)
      real(dp), intent(in) :: total   !! area of all regions over the nominal area
      type(connected_region), intent(inout) :: regions(:)

      if (sum(regions%area_fraction) > 0.0_dp) &
         regions%area_fraction = regions%area_fraction*(total/sum(regions%area_fraction))
   end subroutine add_up_to

   !> Finds the strips of a 1-D contact and the gaps between them, of a mirrored map those within the map. All are
   !> endless along y and bounded along x.
   subroutine find_strips(strips, is_map, spots, pools)
      type(contact_contour), intent(in) :: strips(:)   !! all strips of the cell, ascending, at least one
      logical, intent(in) :: is_map                    !! whether the cell consists of a map and its mirror image
      type(connected_region), allocatable, intent(out) :: spots(:), pools(:)

      real(dp) :: gap(2)
      integer :: i, n

      n = size(strips)
      allocate (spots(n), pools(n))
      do i = 1, n
         spots(i) = strip(strips(i)%phi, or_nan(strips(i)%load))
         gap = [strips(i)%phi(2), strips(mod(i, n) + 1)%phi(1)]
         if (i == n) then
            ! The gap after the last strip ends at the first strip one period on. It contains phi = 0, or lies between 0
            ! and 2 pi if the first strip contains phi = 0.
            if (gap(2) > 0.0_dp) then
               gap(1) = gap(1) - 2*pi
            else
               gap(2) = gap(2) + 2*pi
            end if
         end if
         pools(i) = strip(gap, or_nan(unknown))
      end do
      if (.not. is_map) return
      ! Strips beyond the map, which are mirror images, have the area 0 here.
      spots = pack(spots, spots%area_fraction > 0.0_dp)
      pools = pack(pools, pools%area_fraction > 0.0_dp)

   contains

      !> The region of one strip or gap of the cell; if the cell is a map and its image, of its part within the map.
      pure type(connected_region) function strip(ends, load)
         real(dp), intent(in) :: ends(2)   !! first and last angle [rad]
         real(dp), intent(in) :: load      !! load of the strip over that of the cell

         real(dp) :: in_map(2)

         strip%area_fraction = (ends(2) - ends(1))/(2*pi)
         strip%perimeter = or_nan(unknown)
         strip%load_fraction = load
         strip%centre = in_cell([0.5_dp*sum(ends), 0.0_dp])
         strip%percolates(2) = .true.
         if (.not. is_map) return
         ! The map has half of the cell's load. So the load of a strip within the map is twice as large a part of it. A
         ! strip across a border has half of its load in the map.
         if (ends(1) >= 0.0_dp .and. ends(2) <= pi) strip%load_fraction = 2*load
         in_map = min(max(ends, 0.0_dp), pi)
         strip%area_fraction = (in_map(2) - in_map(1))/pi
         strip%centre(1) = 0.5_dp*sum(in_map)
      end function strip

   end subroutine find_strips

   !> The length of a curve [length]: the one that is known, otherwise that of the polygon through its points.
   pure real(dp) function curve_length(curve, length)
      type(contact_contour), intent(in) :: curve
      real(dp), intent(in) :: length(2)   !! L_x, L_y [length]

      associate (n => size(curve%phi), x => curve%phi, y => curve%theta)
         curve_length = curve%length
         if (curve_length > 0.0_dp) return
         curve_length = sum(hypot(length(1)*(x(2:) - x(:n - 1)), length(2)*(y(2:) - y(:n - 1))))/(2*pi)
      end associate
   end function curve_length

   !> The centroid of the polygon through the points of a closed curve, as an equivalent point of the cell [rad]. On a
   !> mirrored map the centroid of the folded polygon, (A5), which lies in the map.
   pure function centroid(curve, is_map) result(centre)
      type(contact_contour), intent(in) :: curve   !! closed
      logical, intent(in) :: is_map                !! whether the cell consists of a map and its mirror images
      real(dp) :: centre(2)

      real(dp), dimension(size(curve%phi)) :: x, y
      real(dp) :: twice_area
      integer :: n

      n = size(x)
      x = curve%phi - curve%phi(1)
      y = curve%theta - curve%theta(1)
      associate (products => x(:n - 1)*y(2:) - x(2:)*y(:n - 1))
         twice_area = sum(products)
         centre = [sum(x)/n, sum(y)/n]
         if (abs(twice_area) > 0.0_dp) &
            centre = [sum((x(:n - 1) + x(2:))*products), sum((y(:n - 1) + y(2:))*products)]/(3*twice_area)
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

   !> The integral of M(a) db along the polygon through the points (a, b), by Simpson's rule: (A5). M' = m is the
   !> position in the map that belongs to the angle a, m = pi - |pi - a| for 0 <= a <= 2 pi, and M(0) = 0.
   pure real(dp) function moment(a, b)
      real(dp), intent(in) :: a(:), b(:)   !! [rad]

      real(dp) :: at_point(size(a)), between(size(a) - 1)
      integer :: n

      n = size(a)
      at_point = integral_of_position(a)
      between = integral_of_position(0.5_dp*(a(:n - 1) + a(2:)))
      moment = sum((b(2:) - b(:n - 1))*(at_point(:n - 1) + 4*between + at_point(2:)))/6
   end function moment

   !> The integral M of `moment`.
   elemental real(dp) function integral_of_position(angle) result(integral)
      real(dp), intent(in) :: angle   !! [rad]

      real(dp) :: within, remainder   ! the part of the integral over whole periods and that over the rest

      remainder = modulo(angle, 2*pi)
      within = 0.5_dp*remainder**2
      if (remainder > pi) within = pi**2 - 0.5_dp*(2*pi - remainder)**2
      integral = pi**2*floor(angle/(2*pi)) + within
   end function integral_of_position

   !> The equivalent angle from 0 to 2 pi. An angle that is less than 2 pi by rounding only becomes 0, as 2 pi does.
   elemental real(dp) function in_cell(angle)
      real(dp), intent(in) :: angle   !! [rad]

      real(dp), parameter :: rounding = 1e-12_dp   ! in periods

      in_cell = max(angle - 2*pi*floor(angle/(2*pi) + rounding), 0.0_dp)
   end function in_cell

end module wavycon_contact_spots
