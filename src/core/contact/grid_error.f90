!> Error estimates of mean gap [Delta], contact area fraction and peak pressure [p*] on a sequence of grids.
!>
!> Each estimate is the largest of three: that from the changes over the last three grids (C14); that from features
!> which the grid does not resolve, as their error does not show in the changes, (C15) to (C16); and, for mean gap and
!> peak pressure, that from the error of the area (C17), (C17a) and from edges along the lines of the grid (C17b).
!> README.md in this directory has the equations and tells how many of the estimates hold. None is a bound.
module wavycon_grid_error
   use wavycon_contact_tuning, only: area_kept_change, change_safety, edge_bias, edge_scatter, kept_change, &
      least_of_area, opening_ratio, unresolved_width
   use wavycon_grid_area, only: edge_crossings, edge_spread, lone_approach, lone_points
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp, int64, pi
   use wavycon_quantities, only: is_known, unknown
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: aligned_errors, change_history, estimate_errors, implied_errors, unresolved_errors

   !> Mean gap (with free edges the approach), contact area and peak pressure on the last grid, and on the two grids
   !> before, the finer of them first. With fewer than three grids the estimates are unknown.
   type :: change_history
      real(dp) :: values(3) = unknown
      real(dp) :: before(3, 2) = unknown
   contains
      procedure :: push
      procedure :: errors => errors_of_changes
   end type change_history

contains

   !> Estimates the errors of mean gap [Delta], contact area fraction and peak pressure [p*] on the last grid.
   function estimate_errors(history, surface, mean_pressure, edge, bend) result(errors)
      type(change_history), intent(in) :: history   !! values on the grids up to the last one
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure      !! P, > 0
      type(grid_edge), intent(in) :: edge        !! pressures and gaps on the last grid
      real(dp), intent(in) :: bend               !! bend of (C16) [p*], from grid_peak_pressure
      real(dp) :: errors(3)

      real(dp) :: displacement   ! 2 l P/E* of (C17a) [Delta]
      real(dp) :: ridges(2)      ! parts of a wave on a step (C15c), 0 unless ridges are parallel

      errors = max(history%errors(), unresolved_errors(surface, edge, bend))
      if (surface%has_free_edges) then
         errors = max(errors, least_of_area*errors(2)/max(history%values(2), tiny(1.0_dp))*history%values)
      else
         ridges = surface%waves_on_step(edge%slab%points)
         if (any(ridges > 0.0_dp)) errors(1) = max(errors(1), change_safety*lone_approach(edge, ridges))
         displacement = 0.0_dp
         if (.not. (surface%is_height_map() .or. surface%kernel%has_layer())) then
            ! Only the saddles of even waves lie alike in all grids.
            if (edge%even) displacement = mean_pressure/minval(edge%stiffness(:surface%dimension))
            if (edge%even .or. surface%dimension == 1) then
               errors = max(errors, aligned_errors(surface%dimension, history%values, mean_pressure, edge))
            end if
         end if
         errors = max(errors, implied_errors(surface%dimension, history%values, errors(2), displacement))
      end if
   end function estimate_errors

   !> Adds the values of a finer grid.
   pure subroutine push(self, values)
      class(change_history), intent(inout) :: self
      real(dp), intent(in) :: values(3)   !! in the order of change_history

      self%before = reshape([self%values, self%before(:, 1)], [3, 2])
      self%values = values
   end subroutine push

   !> Errors from the changes (C14): the last change, but at least a part of the change before, because a single change
   !> may be small by chance.
   pure function errors_of_changes(self) result(errors)
      class(change_history), intent(in) :: self
      real(dp) :: errors(3)

      real(dp), parameter :: kept(3) = [kept_change, area_kept_change, kept_change]

      associate (change => abs(self%values - self%before(:, 1)), &
                 change_before => abs(self%before(:, 1) - self%before(:, 2)))
         errors = change_safety*max(change, kept*change_before)
      end associate
      where (.not. is_known(self%before(:, 2))) errors = unknown
   end function errors_of_changes

   !> Errors that changes do not show (C15), (C16). The area has one because the position of the edge between points is
   !> uncertain and all grids may err alike. All values have one if a small gap may lie between points that are in
   !> contact. The peak pressure has one if too few points are in contact for the polynomial (C13).
   function unresolved_errors(surface, edge, bend) result(errors)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge    !! after `fetch_neighbours`
      real(dp), intent(in) :: bend           !! bend of (C16) [p*], from grid_peak_pressure; 0: the polynomial is enough
      real(dp) :: errors(3)

      integer(int64) :: crossings, points
      real(dp) :: open_part
      real(dp) :: ridges(2)   ! parts of a wave on a step (C15c), 0 unless ridges are parallel
      real(dp) :: places   ! uncertainty of the places of the edge and of what (C11) misses, in steps or cells

      points = product(int(edge%slab%points, int64))
      ridges = surface%waves_on_step(edge%slab%points)
      open_part = possible_openings(edge, ridges)/real(points, dp)
      crossings = edge_crossings(edge)
      if (crossings == 0) open_part = max(open_part, 1.0_dp/points)
      ! Near full contact the mean gap, and the change of the peak, are proportional to the open part to the power 5/2
      ! or a higher one.
      errors = [open_part**2, open_part, open_part**2]
      ! With free edges approach and peak are not of the order of Delta and p*. Their errors follow from the area's
      ! relative error by (C17).
      if (surface%has_free_edges) errors([1, 3]) = 0.0_dp
      places = max(edge_scatter*sqrt(real(crossings, dp)), edge_bias*crossings)
      if (any(ridges > 0.0_dp)) places = places + abs(lone_points(edge, ridges))
      errors(2) = errors(2) + places/points
      if (bend > 0.0_dp) errors(3) = max(errors(3), min(bend, unresolved_peak(surface, edge)))
   end function unresolved_errors

   !> Number of points in contact beside which a gap may lie, o of (C15): the neighbours along both directions, on
   !> ridges only those along the direction most nearly across, are in contact and have no lower pressure, and the
   !> pressure of one of them is more than `opening_ratio` times as large.
   integer(int64) function possible_openings(edge, ridges) result(openings)
      type(grid_edge), intent(in) :: edge   !! after `fetch_neighbours`
      real(dp), intent(in) :: ridges(2)     !! `waves_on_step` of the surface, 0 unless ridges are parallel

      real(dp) :: values(edge%slab%points(1), -1:1)
      real(dp), dimension(edge%slab%points(1)) :: least, most   ! pressure of the neighbours
      integer :: direction, j

      openings = 0
      do j = edge%slab%first, edge%slab%last
         if (.not. edge%may_touch(j)) cycle
         least = huge(least)
         most = 0.0_dp
         do direction = 1, 2
            if (ridges(direction) < maxval(ridges)) cycle
            values = edge%beside(j, direction)
            least = min(least, values(:, -1), values(:, 1))
            most = max(most, values(:, -1), values(:, 1))
         end do
         openings = openings + count(values(:, 0) > 0.0_dp .and. least >= values(:, 0) .and. &
                                     most > opening_ratio*values(:, 0))
      end do
      openings = edge%slab%total_count(openings)
   end function possible_openings

   !> Hertz's peak pressure [p*] of a contact whose half width or radius is `unresolved_width` steps (C16). In 2-D the
   !> sum of both curvatures takes the place of twice their mean, so that the pressure is large enough for elliptic
   !> contacts too.
   pure real(dp) function unresolved_peak(surface, edge) result(peak)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge

      !> Peak pressure [p*] of line contact and of point contact, divided by the half width or radius, by
      !> curvature/(4 pi^2 Delta) and by the stiffness sigma.
      real(dp), parameter :: hertz_peak(2) = [2*pi, 8.0_dp]
      real(dp) :: step(2)

      step = surface%length/edge%slab%points
      if (edge%even) step = step/2
      if (surface%dimension == 1) step(2) = 0.0_dp
      peak = hertz_peak(surface%dimension)*unresolved_width*maxval(step)*surface%stiffness*surface%crest_curvature
   end function unresolved_peak

   !> The least errors that mean gap and peak pressure can have, from the error of the area (C17), (C17a). The changes
   !> of both may be small by chance, and next to merging those of several grids are small at the same loads.
   pure function implied_errors(dimension, values, area_error, displacement) result(errors)
      integer, intent(in) :: dimension       !! 1 or 2
      real(dp), intent(in) :: values(3)      !! mean gap [Delta], contact area fraction, peak pressure [p*]
      real(dp), intent(in) :: area_error     !! error estimate of the area
      real(dp), intent(in) :: displacement   !! 2 l P/E* of the longer step l [Delta]
      real(dp) :: errors(3)                  !! errors of the same values; zero for the area

      !> Near full contact the mean gap is proportional to this power of the open part, in 1-D and 2-D: eqs. (20), (30)
      !> of Johnson, Greenwood & Higginson (1985) with (7), (24).
      real(dp), parameter :: closing_power(2) = [4.0_dp, 2.5_dp]
      real(dp) :: open_part

      errors = 0.0_dp
      open_part = 1.0_dp - values(2)
      associate (gap => values(1), area => values(2), peak => values(3))
         if (.not. min(area, open_part) > 0.0_dp) return
         errors = least_of_area*area_error*[min(gap, 1.0_dp - gap)/min(area, open_part), 0.0_dp, peak/area]
         errors(1) = max(errors(1), open_part*displacement/area*area_error/area)
         ! If only a few points are open the true gap may be much larger than on the grid, where it may even be zero.
         if (area_error >= open_part) errors(1) = max(errors(1), area_error**2, &
            gap*((1.0_dp + area_error/open_part)**closing_power(dimension) - 1.0_dp))
      end associate
   end function implied_errors

   !> The errors of mean gap and peak pressure from edges along lines of the grid (C17b). Where spots merge such edges
   !> are long, and several grids may err alike.
   function aligned_errors(dimension, values, mean_pressure, edge) result(errors)
      integer, intent(in) :: dimension           !! 1 or 2
      real(dp), intent(in) :: values(3)          !! mean gap [Delta], contact area fraction, peak pressure [p*]
      real(dp), intent(in) :: mean_pressure      !! P, > 0
      type(grid_edge), intent(in) :: edge        !! on a half-space, after `fetch_neighbours`
      real(dp) :: errors(3)                      !! errors of the same values; zero for the area

      !> c of (C17b) in 1-D and 2-D, from Hertz's contacts.
      real(dp), parameter :: of_hertz(2) = [2/pi, 3*pi/16]
      real(dp) :: area_of_wave   ! A of (C17b) with a bar

      errors = 0.0_dp
      associate (gap => values(1), area => values(2), peak => values(3))
         if (.not. min(area, 1.0_dp - gap, 1.0_dp - mean_pressure) > 0.0_dp) return
         area_of_wave = area
         if (dimension == 1) area_of_wave = sin(pi/2*area)/(pi/2)
         errors(1) = of_hertz(dimension)*mean_pressure*(1.0_dp - mean_pressure)/area_of_wave**2 &
                     *abs(edge_spread(edge))/product(real(edge%slab%points, dp))
         errors(3) = peak*errors(1)/(1.0_dp - gap)
      end associate
   end function aligned_errors

end module wavycon_grid_error
