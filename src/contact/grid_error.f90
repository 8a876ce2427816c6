!> Error estimates of mean gap [Delta], contact area fraction and peak pressure [p*] on a sequence of grids.
!>
!> The estimate of each number is the largest of three: from its changes on the last three grids; from what no change
!> contains, as the grid does not resolve it; and, of mean gap and peak pressure, from the error of the area. The
!> equations (C..) and the share of estimates that hold are in README.md in this directory. None is a bound.
module wavycon_grid_error
   use wavycon_constants, only: pi
   use wavycon_contact_tuning, only: area_safety, edge_bias_even, edge_bias_whole, edge_scatter, gap_safety, &
      kept_change, least_of_area, opening_ratio, peak_safety, unresolved_width
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: change_history, estimate_errors, implied_errors, unresolved_errors

   !> In place of a number that no grid has given yet: so large that estimates from fewer than three grids exceed every
   !> accuracy.
   real(dp), parameter :: unknown = 1e30_dp

   !> The three numbers of the last grid, and their last two changes.
   type :: change_history
      real(dp) :: values(3) = unknown
      real(dp) :: change(3) = unknown
      real(dp) :: change_before(3) = unknown
   contains
      procedure :: push
      procedure :: errors => errors_of_changes
   end type change_history

contains

   !> Estimates the errors of the numbers of the last grid of a history.
   pure function estimate_errors(history, surface, edge, peak_resolved) result(errors)
      type(change_history), intent(in) :: history
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge        !! of the last grid
      logical, intent(in) :: peak_resolved       !! as of grid_peak_pressure
      real(dp) :: errors(3)

      errors = max(history%errors(), unresolved_errors(surface, edge, peak_resolved))
      errors = max(errors, implied_errors(surface%dimension, history%values, errors(2)))
   end function estimate_errors

   !> Adds the numbers of a finer grid.
   pure subroutine push(self, values)
      class(change_history), intent(inout) :: self
      real(dp), intent(in) :: values(3)

      self%change_before = self%change
      self%change = abs(values - self%values)
      self%values = values
   end subroutine push

   !> Errors from the changes (C14): the last change, or half of the one before, so that a change that is small by
   !> chance does not pass for accuracy.
   pure function errors_of_changes(self) result(errors)
      class(change_history), intent(in) :: self
      real(dp) :: errors(3)

      real(dp), parameter :: safety(3) = [gap_safety, area_safety, peak_safety]

      errors = max(safety*self%change, kept_change*safety*self%change_before)
   end function errors_of_changes

   !> Errors that no change contains (C15): the area's, from the place of the edge between points, where all grids may
   !> err alike; while the grid is too coarse to show it, the last open gap, between points that are all in contact;
   !> and a peak of fewer points than its polynomial takes.
   pure function unresolved_errors(surface, edge, peak_resolved) result(errors)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge
      logical, intent(in) :: peak_resolved
      real(dp) :: errors(3)

      real(dp) :: bias, open_part
      integer :: crossings

      associate (points => size(edge%pressure_or_gap))
         if (all(edge%pressure_or_gap > 0.0_dp)) then
            ! With the open part of the surface the mean gap falls as the power 5/2 or faster, and so does the change
            ! of the peak.
            open_part = max(1, possible_openings(edge))/real(points, dp)
            errors = [open_part**2, open_part, open_part**2]
         else
            crossings = count_crossings(edge)
            bias = merge(edge_bias_even, edge_bias_whole, edge%even)
            errors = [0.0_dp, max(edge_scatter*sqrt(real(crossings, dp)), bias*crossings)/points, 0.0_dp]
            if (.not. peak_resolved) errors(3) = unresolved_peak(surface, edge)
         end if
      end associate
   end function unresolved_errors

   !> Neighbouring points between which the edge of contact lies.
   pure integer function count_crossings(edge) result(crossings)
      type(grid_edge), intent(in) :: edge

      associate (field => edge%pressure_or_gap, m => size(edge%pressure_or_gap, 1), n => size(edge%pressure_or_gap, 2))
         crossings = count((field(:m - 1, :) > 0.0_dp) .neqv. (field(2:, :) > 0.0_dp)) &
                     + count((field(:, :n - 1) > 0.0_dp) .neqv. (field(:, 2:) > 0.0_dp))
      end associate
   end function count_crossings

   !> Points in contact whose pressure is so far below a neighbour's that there may be a gap beside them.
   pure integer function possible_openings(edge) result(openings)
      type(grid_edge), intent(in) :: edge

      real(dp) :: highest
      integer :: i, j

      openings = 0
      associate (field => edge%pressure_or_gap)
         do j = 1, size(field, 2)
            do i = 1, size(field, 1)
               highest = max(field(edge%place(i - 1, 1), j), field(edge%place(i + 1, 1), j), &
                             field(i, edge%place(j - 1, 2)), field(i, edge%place(j + 1, 2)))
               if (highest > opening_ratio*field(i, j)) openings = openings + 1
            end do
         end do
      end associate
   end function possible_openings

   !> The peak pressure [p*] of Hertz's contact of the half width or radius that a grid does not resolve (C16). In 2-D
   !> with the sum of both curvatures in place of their mean, so that it is large enough for elliptic contacts too.
   pure real(dp) function unresolved_peak(surface, edge) result(peak)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge

      !> Of line contact and of point contact, over half width or radius, curvature/(4 pi^2 Delta) and stiffness.
      real(dp), parameter :: hertz_peak(2) = [2*pi, 8.0_dp]
      real(dp) :: step(2)

      step = surface%length/(merge(2, 1, edge%even)*shape(edge%pressure_or_gap))
      if (surface%dimension == 1) step(2) = 0.0_dp
      peak = hertz_peak(surface%dimension)*unresolved_width*maxval(step)*surface%stiffness*surface%crest_curvature
   end function unresolved_peak

   !> Errors of mean gap and peak pressure that their changes on three grids may not show, from the area's (C17).
   pure function implied_errors(dimension, values, area_error) result(errors)
      integer, intent(in) :: dimension       !! 1 or 2
      real(dp), intent(in) :: values(3), area_error
      real(dp) :: errors(3)                  !! that of the area zero

      !> With these powers of the open part the mean gap falls towards full contact: eqs. (20), (30) of Johnson,
      !> Greenwood & Higginson (1985) with (7), (24).
      real(dp), parameter :: closing_power(2) = [4.0_dp, 2.5_dp]
      real(dp) :: open_part

      errors = 0.0_dp
      open_part = 1.0_dp - values(2)
      associate (gap => values(1), area => values(2), peak => values(3))
         if (.not. min(gap, area, open_part) > 0.0_dp) return
         errors = least_of_area*area_error*[min(gap, 1.0_dp - gap)/min(area, open_part), 0.0_dp, peak/area]
         ! A last gap of a few points may be much larger than it appears.
         if (area_error >= open_part) errors(1) = max(errors(1), min(area_error**2, &
            gap*((1.0_dp + area_error/open_part)**closing_power(dimension) - 1.0_dp)))
      end associate
   end function implied_errors

end module wavycon_grid_error
