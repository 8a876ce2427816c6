!> The contact with adhesion in the limit of Johnson, Kendall & Roberts: its curve of load, approach and area, which is
!> followed by the area of contact, so that it has no turning points on the way. Pull-off, jumps and the contacts of
!> given loads are zeros along it. Equations (I..) are those of README.md in this directory.
module wavycon_adhesive_curve
   use wavycon_adhesive_contact, only: adhesive_point, adhesive_problem, approach_jump, approach_pull_off, &
      approach_stable, at_approach, at_load, closed, end_of_branch, jump_to_bands, jump_to_full, jump_to_pools, &
      jump_to_spots, not_solved, pull_off_point, separated, stable_point, start_adhesive_problem
   use wavycon_constants, only: pi
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_status, only: not_accurate, not_found
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: adhesive_curve, add_load, find_adhesive_solution, follow_curve

   type :: adhesive_curve
      type(adhesive_point), allocatable :: points(:)     !! of spots by rising area, then of pools by falling area
      type(adhesive_point), allocatable :: critical(:)   !! pull-off, jumps, and where a branch ends
      type(adhesive_point), allocatable :: at_loads(:)   !! the contacts of the loads asked for
      !> Points and extremes in their order along the branches: P and approach are monotonic between two of a branch.
      type(adhesive_point), allocatable, private :: knots(:)
      type(adhesive_problem), private :: problem
   end type adhesive_curve

   !> Points of a curve in closed form.
   integer, parameter :: closed_form_points = 95
   !> Largest step of a spot's or pool's radius over that of a circle as large as its cell, and over itself.
   real(dp), parameter :: radius_step = 0.025_dp, radius_growth = 0.2_dp
   !> Largest growth of the merging ratio in a step, over what is left of it, and the ratio from which a branch ends
   !> once the approach falls: the last extremes are at .83 and more. Otherwise it ends where a step is this part of the
   !> largest one. A growth of 0.2 loses the last extreme of the pools of the square wave, w' = .05, at 1e-3.
   real(dp), parameter :: ratio_growth = 0.12_dp, ratio_of_extremes = 0.6_dp, least_step = 0.02_dp
   !> Step to the last extreme of the approach, over the distance that the last slopes let expect.
   real(dp), parameter :: beyond_extreme = 1.3_dp

contains

   !> Follows the curve of a wave to full contact, that of a ball to the largest load or, if that is light, beyond zero
   !> load.
   subroutine follow_curve(surface, accuracy, work, largest_load, curve)
      type(surface_type), intent(in) :: surface   !! a wave of one dimension, a round ball or one with a frame
      real(dp), intent(in) :: accuracy            !! > 0, of P [p*] and approach [Delta]
      real(dp), intent(in) :: work                !! w' > 0 [p* Delta]
      real(dp), intent(in) :: largest_load        !! P of the loads that will be asked for [p*]
      type(adhesive_curve), intent(out) :: curve

      allocate (curve%points(0), curve%critical(0), curve%at_loads(0), curve%knots(0))
      call start_adhesive_problem(curve%problem, surface, work, accuracy)
      if (curve%problem%has_closed_form) then
         call follow_closed_form(curve, largest_load)
      else
         call follow_branch(curve, .false.)
         call follow_branch(curve, .true.)
      end if
      call name_jumps(curve)
   end subroutine follow_curve

   !> By equal steps of ln P1, P1 the load of the same contact without adhesion; of a wave of ln(P1/(1 - P1)).
   subroutine follow_closed_form(curve, largest_load)
      type(adhesive_curve), intent(inout) :: curve
      real(dp), intent(in) :: largest_load

      !> P1 of the first point over that of pull-off, or over w' of a wave (I21).
      real(dp), parameter :: least_over_pull = 1e-3_dp
      real(dp) :: area, least, most, p1
      integer :: i
      type(hertz_ball) :: contact
      type(adhesive_point) :: point

      if (is_ball(curve%problem%surface)) then
         least = least_over_pull*curve%problem%pull
         ! Twice the largest load's: at the approach of Hertz's contact under it adhesion makes P1 larger.
         most = 2*curve%problem%pull*(1.0_dp + sqrt(1.0_dp + max(largest_load/curve%problem%pull, 4.0_dp)))**2
      else
         least = min(2*least_over_pull*curve%problem%work, 1e-4_dp)
         most = 1.0_dp/least - 1.0_dp
      end if
      do i = 1, closed_form_points
         associate (t => real(i - 1, dp)/(closed_form_points - 1))
            p1 = least*(most/least)**t
            if (curve%problem%surface%dimension == 1) then
               p1 = p1/(1.0_dp + p1)
               area = 2/pi*asin(sqrt(p1))
            else
               contact = hertz_of_ball(curve%problem%surface, load=p1)
               area = contact%contact_area()/curve%problem%surface%nominal_area()
            end if
         end associate
         call curve%problem%find_point(.false., area, point)
         call add_point(curve, point)
      end do
   end subroutine follow_closed_form

   !> By steps of the radius, from one smaller than that of pull-off from spots or of the jump from pools, (I20), until
   !> the approach has its last extreme, which is before spots or pools touch.
   subroutine follow_branch(curve, pools)
      type(adhesive_curve), intent(inout) :: curve
      logical, intent(in) :: pools

      real(dp), parameter :: first_over_critical = 0.4_dp, largest_first = 0.1_dp, worst_error = 10.0_dp
      real(dp) :: cell, full_step, next, open_cell, radius, ratio, step
      type(adhesive_point) :: point
      type(fitted_answer) :: start

      associate (lattice => curve%problem%frame%lattice, work => curve%problem%work/curve%problem%frame%pressure_unit)
         open_cell = lattice%area/merge(lattice%troughs, 1, pools)
         cell = sqrt(open_cell/pi)
         associate (curvature => sqrt(product(lattice%curvatures(pools))))
            if (pools) then
               radius = (0.75_dp*sqrt(0.5_dp*work)/curvature)**0.4_dp
            else
               radius = (9*pi**2*work/(8*curvature**2))**(1.0_dp/3)
            end if
         end associate
         radius = min(first_over_critical*radius, largest_first*cell)
      end associate
      ratio = 0.0_dp
      step = radius
      full_step = radius
      do
         associate (part => pi*radius**2/open_cell)
            call curve%problem%find_point(pools, merge(1.0_dp - part, part, pools), point, start)
         end associate
         ! Next to the end of a branch a solution may be far less accurate than asked for: a shorter step leads to one.
         if (point%exists .and. maxval(point%error) <= worst_error*curve%problem%accuracy) then
            call add_point(curve, point)
            start = point%answer
            ! Past its last extreme the approach falls: nothing is stable from there on.
            if (start%merging_ratio > ratio_of_extremes .and. .not. point%value(2 + at_approach) > 0.0_dp) exit
            full_step = min(radius_step*cell, radius_growth*radius)
            associate (growth => max(start%merging_ratio - ratio, epsilon(ratio)))
               step = min(full_step, step*ratio_growth*(1.0_dp - start%merging_ratio)/growth)
            end associate
            ratio = start%merging_ratio
            if (ratio > ratio_of_extremes) then
               associate (newest => curve%points(size(curve%points) - 2:))
                  next = interpolated(newest%area, newest%value(2 + at_approach))
               end associate
               next = sqrt(max(merge(1.0_dp - next, next, pools), 0.0_dp)*open_cell/pi)
               if (next > radius) step = min(step, beyond_extreme*(next - radius))
            end if
         else
            radius = radius - step
            step = 0.5_dp*step
         end if
         if (ratio <= 0.0_dp .or. step < least_step*full_step) exit
         radius = radius + step
      end do
      if (ratio <= 0.0_dp) return
      point = curve%points(size(curve%points))
      point%kind = end_of_branch
      curve%critical = [curve%critical, point]
   end subroutine follow_branch

   !> Adds a point at the end of its branch, and the extremes of load and approach between it and the one before.
   subroutine add_point(curve, point)
      type(adhesive_curve), intent(inout) :: curve
      type(adhesive_point), intent(in) :: point

      !> Of a minimum and of a maximum, for load and approach.
      integer, parameter :: kinds(2, 2) = reshape([pull_off_point, jump_to_full, approach_pull_off, &
                                                   approach_jump], [2, 2])
      integer :: n, which
      type(adhesive_point) :: before, extreme(2)

      n = size(curve%points)
      if (n > 0) before = curve%points(n)
      if (before%exists .and. (before%pools .eqv. point%pools)) then
         do which = 1, 2
            associate (slope => [before%value(2 + which), point%value(2 + which)])
               if (slope(1)*slope(2) >= 0.0_dp) cycle
               call find_zero(curve, 2 + which, 0.0_dp, before, point, extreme(which))
               ! A maximum has the rise at the smaller area.
               extreme(which)%kind = kinds(merge(2, 1, (slope(1) > 0.0_dp) .neqv. point%pools), which)
            end associate
         end do
         if (all(extreme%exists)) then
            if (extreme(1)%area > extreme(2)%area .neqv. point%pools) extreme = extreme([2, 1])
         end if
         curve%critical = [curve%critical, pack(extreme, extreme%exists)]
         curve%knots = [curve%knots, pack(extreme, extreme%exists)]
      end if
      curve%points = [curve%points, point]
      curve%knots = [curve%knots, point]
   end subroutine add_point

   !> Names the extremes of the load by the stable contact that the bodies jump to under this load: at a maximum the one
   !> with the next larger area, at a minimum with the next smaller one.
   subroutine name_jumps(curve)
      type(adhesive_curve), intent(inout) :: curve

      integer :: i, k

      do i = 1, size(curve%critical)
         associate (point => curve%critical(i))
            if (all(point%kind /= [pull_off_point, jump_to_full])) cycle
            do k = 1, size(curve%knots) - 1
               associate (here => curve%knots(k), after => curve%knots(k + 1))
                  if (.not. is_between(here, after, at_load, point%value(at_load)) .or. &
                      .not. (after%value(at_load) > here%value(at_load) .neqv. after%area < here%area)) cycle
                  ! The knots next to an extreme meet its load at the extreme itself.
                  if (min(abs(here%area - point%area), abs(after%area - point%area)) <= 0.0_dp) cycle
                  if (here%area > point%area .neqv. point%kind == pull_off_point) &
                     point%kind = merge(jump_to_pools, jump_to_spots, here%pools)
               end associate
               if (all(point%kind /= [pull_off_point, jump_to_full])) exit
            end do
            ! Where spots are stable under lighter loads only, and pools under heavier ones, there are bands between.
            if (any(point%kind == [pull_off_point, jump_to_full]) .and. &
                any((curve%knots%pools .neqv. point%pools) .and. curve%knots%value(2 + at_load) > 0.0_dp .and. &
                    (curve%knots%value(at_load) > point%value(at_load) .neqv. point%pools)) .and. &
                (point%pools .eqv. point%kind == pull_off_point)) point%kind = jump_to_bands
         end associate
      end do
   end subroutine name_jumps

   !> Whether two knots are of one branch and a value lies between theirs.
   pure logical function is_between(here, after, which, target)
      type(adhesive_point), intent(in) :: here, after
      integer, intent(in) :: which
      real(dp), intent(in) :: target

      is_between = (here%pools .eqv. after%pools) .and. &
                   ((here%value(which) < target) .neqv. (after%value(which) < target))
   end function is_between

   !> Adds the contacts of a load, an approach or an area: spots by rising area, then pools by falling area. If none of
   !> them is stable, the bodies are separated or in full contact.
   subroutine add_load(curve, which, target, number)
      type(adhesive_curve), intent(inout) :: curve
      integer, intent(in) :: which     !! at_load, at_approach, or 0 for the contact area fraction
      real(dp), intent(in) :: target   !! P [p*], approach [Delta] or area fraction
      integer, intent(in) :: number    !! of the load

      integer :: i, known
      logical :: is_found   ! an area whether it is stable or not
      type(adhesive_point) :: point

      known = size(curve%at_loads)
      if (which == 0 .and. curve%problem%has_closed_form .and. target > 0.0_dp .and. target < 1.0_dp) then
         ! The formulas reach beyond the ends of the curve.
         call curve%problem%find_point(.false., target, point)
         curve%at_loads = [curve%at_loads, point]
         curve%at_loads(known + 1)%number = number
         return
      end if
      do i = 1, size(curve%knots) - 1
         associate (here => curve%knots(i), after => curve%knots(i + 1))
            if (which > 0) then
               if (.not. is_between(here, after, which, target)) cycle
               call find_zero(curve, which, target, here, after, point)
            else
               if ((here%pools .neqv. after%pools) .or. ((here%area < target) .eqv. (after%area < target))) cycle
               call curve%problem%find_point(here%pools, target, point, here%answer)
            end if
         end associate
         if (point%exists) curve%at_loads = [curve%at_loads, point]
      end do
      is_found = any(curve%at_loads(known + 1:)%kind == stable_point .or. which == 0 .or. &
                     (which == at_approach .and. curve%at_loads(known + 1:)%kind == approach_stable))
      if (.not. is_found) curve%at_loads = [curve%at_loads, beyond_extremes(curve, which, target)]
      curve%at_loads(known + 1:)%number = number
   end subroutine add_load

   !> The contact of a load as a solution with fields: of those that are stable, under the load or at the approach if
   !> that is given, the one of the largest area, which unloading meets. If an area is given it may be unstable.
   subroutine find_adhesive_solution(curve, which, number, solution)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which     !! as of add_load
      integer, intent(in) :: number    !! of a load that was added
      type(contact_solution), intent(out) :: solution

      integer :: chosen
      logical :: are_met(size(curve%at_loads))

      associate (points => curve%at_loads)
         are_met = points%number == number .and. (points%kind == stable_point .or. &
                                                  (which /= at_load .and. points%kind == approach_stable))
         chosen = maxloc(points%area, dim=1, mask=are_met)
         if (chosen == 0) chosen = findloc(points%number, number, dim=1, back=.true.)
         call curve%problem%make_solution(points(chosen), solution)
      end associate
   end subroutine find_adhesive_solution

   !> What the bodies are where no partial contact is stable.
   pure type(adhesive_point) function beyond_extremes(curve, which, target) result(point)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which
      real(dp), intent(in) :: target

      real(dp), allocatable :: stable(:)   ! the values of stable contacts

      point%kind = not_solved
      point%status = not_found
      if (which == 0) return
      stable = pack(curve%knots%value(which), curve%knots%value(2 + which) >= 0.0_dp)
      if (size(stable) > 0) then
         if (target < minval(stable)) point = adhesive_point(exists=.true., kind=separated)
      end if
      if (point%kind == not_solved .and. .not. is_ball(curve%problem%surface)) then
         if (target > maxval([stable, merge(1.0_dp, -huge(1.0_dp), which == at_approach)])) &
            point = adhesive_point(exists=.true., kind=closed, area=1.0_dp)
      end if
      if (.not. point%exists) return
      point%value(which) = target
      point%error = 0.0_dp
      if (point%kind == closed) then
         point%value(at_approach) = 1.0_dp
      else
         if (which == at_approach) point%value(at_load) = 0.0_dp
         point%energy = 0.0_dp
         point%energy_error = 0.0_dp
      end if
   end function beyond_extremes

   !> The point between two of a branch at which one of the numbers has a value: by Newton's method for loads and
   !> approaches, by inverse interpolation of the last points for their extremes, or else by halving a bracket of the
   !> area. All solutions start from that of the last point, so that they take the same degrees. Where there is no
   !> solution on the way the point does not exist.
   subroutine find_zero(curve, which, target, first, last, point)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which                 !! of point%value
      real(dp), intent(in) :: target               !! between those of both points
      type(adhesive_point), intent(in) :: first, last
      type(adhesive_point), intent(out) :: point

      integer, parameter :: most_steps = 60
      real(dp), parameter :: rounding = 4*epsilon(1.0_dp), part_of_error = 0.1_dp, tightening = 0.3_dp, &
         least_tightening = 0.01_dp
      integer :: n
      logical :: is_extreme, is_last
      real(dp) :: area(most_steps), bracket(2), changes(2), curvature, miss(most_steps), next, spread, told(2)
      type(adhesive_problem) :: problem

      problem = curve%problem
      is_extreme = which > 2
      area(:2) = [first%area, last%area]
      miss(:2) = [first%value(which), last%value(which)] - target
      ! The worse one is the first that interpolation forgets.
      if (abs(miss(1)) < abs(miss(2))) then
         area(:2) = area([2, 1])
         miss(:2) = miss([2, 1])
      end if
      bracket = area(:2)
      do n = 2, most_steps - 1
         is_last = problem%accuracy < curve%problem%accuracy
         if (is_last) then
            next = area(n) - miss(n)/curvature
         else if (n > 2 .and. .not. is_extreme) then
            next = area(n) - miss(n)/point%value(2 + which)
         else
            next = interpolated(area(max(1, n - 2):n), miss(max(1, n - 2):n))
         end if
         if (.not. (is_last .or. (next - bracket(1))*(next - bracket(2)) < 0.0_dp)) next = 0.5_dp*sum(bracket)
         if (n > 2) then
            changes = abs(point%value(3:)*(next - area(n)))
            told = point%error
            if (is_extreme) then
               ! What a step by the derivatives leaves, and what the slope's error does. The derivative of the slope is
               ! that of two points so far apart.
               if (.not. is_last) then
                  spread = area(n) - area(min(n - 1, 3))
                  curvature = (miss(n) - miss(min(n - 1, 3)))/spread
               end if
               changes = changes*left_over()
               told = told + abs(point%value(3:)*point%slope_error(which - 2)/curvature)
            end if
            if (is_last .or. abs(next - area(n)) <= rounding*next .or. &
                all(changes <= max(part_of_error*told, epsilon(next)*abs(point%value(:2))))) then
               if (is_extreme) call step_to_extreme()
               if (is_last .or. .not. is_extreme .or. maxval(point%error) <= curve%problem%accuracy) exit
               ! The slope is not known well enough: once more, to a smaller error.
               problem%accuracy = problem%accuracy &
                  *max(least_tightening, tightening*problem%accuracy/maxval(point%error))
            end if
         end if
         call problem%find_point(first%pools, next, point, last%answer)
         if (.not. point%exists) return
         area(n + 1) = next
         miss(n + 1) = point%value(which) - target
         bracket(merge(1, 2, (miss(n + 1) > 0.0_dp) .eqv. (miss(1) > 0.0_dp))) = next
      end do
      if (.not. is_extreme) point%area_error = abs((abs(miss(n)) + point%error(which))/point%value(2 + which))
      if (.not. maxval(point%error) <= curve%problem%accuracy) point%status = not_accurate

   contains

      !> The part of the step to `next` that it misses the extreme by: the curve bends over the distance of both points.
      real(dp) function left_over()
         left_over = (abs(next - area(n)) + abs(spread))/abs(last%area - first%area)
      end function left_over

      !> The last step, to `next`, by the derivatives; and the errors that the area's makes.
      subroutine step_to_extreme()
         real(dp) :: change(2), energy_slope, step

         step = next - area(n)
         point%area = next
         point%area_error = abs(step)*left_over() + abs(point%slope_error(which - 2)/curvature)
         energy_slope = point%value(at_load)*point%value(2 + at_approach) + problem%work
         change = point%value(3:)
         ! The slope at the extreme is 0.
         change(which - 2) = 0.5_dp*change(which - 2)
         point%value(:2) = point%value(:2) + change*step
         point%error = point%error + abs(change)*point%area_error
         point%energy = point%energy + energy_slope*step
         point%energy_error = point%energy_error + abs(energy_slope)*point%area_error
      end subroutine step_to_extreme

   end subroutine find_zero

   !> The place where a function is 0 by inverse interpolation of its values (Neville).
   pure real(dp) function interpolated(places, values) result(place)
      real(dp), intent(in) :: places(:), values(:)

      real(dp) :: p(size(places))
      integer :: i, k

      p = places
      do k = 1, size(p) - 1
         do i = 1, size(p) - k
            p(i) = (values(i + k)*p(i) - values(i)*p(i + 1))/(values(i + k) - values(i))
         end do
      end do
      place = p(1)
   end function interpolated

   !> Hertz's contact of a ball under a load [p*]; over p* and Delta the modulus does not matter.
   pure type(hertz_ball) function hertz_of_ball(surface, load) result(contact)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: load

      contact = hertz_contact(ball_radii(surface), 1.0_dp, &
                              force=load*surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
   end function hertz_of_ball

end module wavycon_adhesive_curve
