!> The contact with adhesion in the limit of Johnson, Kendall & Roberts: its curve of load, approach and area, which is
!> followed by the area of contact, so that it has no turning points on the way. Pull-off, jumps and the contacts of
!> given loads are zeros along it. Equations (I..) are those of README.md in this directory.
!>
!> The 1-D wave and the round ball have closed forms. Waves on a lattice have exact solutions by expansions with a
!> singular edge, one branch of separate spots and one of separate pools.
module wavycon_adhesive_curve
   use wavycon_constants, only: pi
   use wavycon_contact_status, only: converged, not_accurate, not_found
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fitted_solver, only: solve_adhesive
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, elastic_energy, mean_gap, unknown
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: adhesive_curve, adhesive_point, add_load, follow_curve

   !> What a point is. Under a given load a contact is stable where P rises with its area, at a given approach where the
   !> approach does.
   integer, parameter, public :: unstable_point = 0, stable_point = 1, approach_stable = 2, pull_off_point = 3, &
      jump_to_spots = 4, jump_to_pools = 5, jump_to_full = 6, approach_pull_off = 7, approach_jump = 8, &
      end_of_branch = 9, separated = 10, closed = 11, not_solved = 12
   character(22), parameter, public :: point_names(0:12) = [character(22) :: 'unstable', 'stable', &
      'stable_by_approach', 'pull_off', 'jump_to_spots', 'jump_to_pools', 'jump_to_full_contact', &
      'pull_off_by_approach', 'jump_by_approach', 'end_of_branch', 'separated', 'full_contact', 'not_solved']

   !> The numbers of a point that have zeros along the curve: P [p*], the approach [Delta], and their derivatives with
   !> respect to the area fraction.
   integer, parameter, public :: at_load = 1, at_approach = 2
   integer, parameter :: load_slope = 3, approach_slope = 4

   type :: adhesive_point
      logical :: exists = .false.
      integer :: kind = unstable_point
      integer :: number = 0                   !! of the load asked for, from 1
      logical :: pools = .false.              !! of the branch of separate pools
      real(dp) :: area = 0.0_dp               !! the contact area fraction, by which the curve is followed
      real(dp) :: area_error = 0.0_dp
      real(dp) :: value(4) = unknown          !! P, approach and their slopes
      real(dp) :: error(2) = unknown          !! of P and approach
      real(dp) :: energy = unknown            !! elastic [p* Delta]: the mean of p u/2
      real(dp) :: energy_error = unknown
      integer :: status = converged           !! a name of wavycon_contact_status
      type(fitted_answer), allocatable :: answer   !! of a lattice, from which other points start
   end type adhesive_point

   type :: adhesive_curve
      type(adhesive_point), allocatable :: points(:)     !! of spots by rising area, then of pools by falling area
      type(adhesive_point), allocatable :: critical(:)   !! pull-off, jumps, and where a branch ends
      type(adhesive_point), allocatable :: at_loads(:)   !! the contacts of the loads asked for
      !> Points and extremes in their order along the branches: P and approach are monotonic between two of a branch.
      type(adhesive_point), allocatable, private :: knots(:)
      type(surface_type), private :: surface
      type(fitted_frame), private :: frame
      real(dp), private :: pull = 0.0_dp      !! F_c of a ball (I20) over p* A_0
      real(dp), private :: work = 0.0_dp      !! w' > 0 [p* Delta]
      real(dp), private :: accuracy = 0.0_dp  !! largest error of P [p*] and approach [Delta]
   end type adhesive_curve

   !> Points of a curve in closed form.
   integer, parameter :: closed_form_points = 95
   !> Largest step of a spot's or pool's radius over that of a circle as large as its cell, and over itself.
   real(dp), parameter :: radius_step = 0.025_dp, radius_growth = 0.2_dp
   !> A branch ends where the part of the way to the neighbours, extrapolated, would exceed this, or a step is too small.
   real(dp), parameter :: largest_ratio = 0.97_dp, least_step = 0.1_dp

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
      curve%surface = surface
      curve%work = work
      curve%accuracy = accuracy
      if (is_ball(surface) .or. surface%dimension == 1) then
         call follow_closed_form(curve, largest_load)
      else
         call find_frame(surface, curve%frame)
         call follow_branch(curve, .false.)
         call follow_branch(curve, .true.)
      end if
      call name_jumps(curve)
   end subroutine follow_curve

   !> By equal steps of ln P1, P1 the load of the same contact without adhesion; of a wave of ln(P1/(1 - P1)).
   subroutine follow_closed_form(curve, largest_load)
      type(adhesive_curve), intent(inout) :: curve
      real(dp), intent(in) :: largest_load

      !> P1 of the first point over that of pull-off, or over w' of a wave (I18).
      real(dp), parameter :: least_over_pull = 1e-3_dp
      real(dp) :: area, least, most, p1
      integer :: i
      type(hertz_ball) :: contact
      type(adhesive_point) :: point

      if (is_ball(curve%surface)) then
         associate (surface => curve%surface)
            curve%pull = 1.5_dp*pi*curve%work*surface%amplitude*maxval(ball_radii(surface))/surface%nominal_area()
         end associate
         least = least_over_pull*curve%pull
         most = curve%pull*(1.0_dp + sqrt(1.0_dp + max(largest_load/curve%pull, 4.0_dp)))**2
      else
         least = min(2*least_over_pull*curve%work, 1e-4_dp)
         most = 1.0_dp/least - 1.0_dp
      end if
      do i = 1, closed_form_points
         associate (t => real(i - 1, dp)/(closed_form_points - 1))
            p1 = least*(most/least)**t
            if (curve%surface%dimension == 1) then
               p1 = p1/(1.0_dp + p1)
               area = 2/pi*asin(sqrt(p1))
            else
               contact = hertz_of_ball(curve%surface, load=p1)
               area = contact%contact_area()/curve%surface%nominal_area()
            end if
         end associate
         call find_point(curve, .false., area, point)
         call add_point(curve, point)
      end do
   end subroutine follow_closed_form

   !> By steps of the radius, from one that is smaller than that of pull-off from spots (I22) or of the jump from pools
   !> (I23) until spots or pools are about to touch.
   subroutine follow_branch(curve, pools)
      type(adhesive_curve), intent(inout) :: curve
      logical, intent(in) :: pools

      real(dp), parameter :: first_over_critical = 0.4_dp, largest_first = 0.1_dp
      real(dp) :: cell, full_step, open_cell, radius, ratio, step
      type(adhesive_point) :: point
      type(fitted_answer) :: start

      associate (lattice => curve%frame%lattice, work => curve%work/curve%frame%pressure_unit)
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
            call find_point(curve, pools, merge(1.0_dp - part, part, pools), point, start)
         end associate
         if (point%exists) then
            call add_point(curve, point)
            ! The ratio grows faster than the radius.
            full_step = min(radius_step*cell, radius_growth*radius)
            associate (growth => max(point%answer%merging_ratio - ratio, epsilon(ratio)))
               step = min(full_step, step*(largest_ratio - point%answer%merging_ratio)/growth)
            end associate
            start = point%answer
            ratio = start%merging_ratio
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
      integer, parameter :: kinds(2, 2) = reshape([pull_off_point, jump_to_full, approach_pull_off, approach_jump], [2, 2])
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
      logical :: has_stable
      type(adhesive_point) :: point

      known = size(curve%at_loads)
      do i = 1, size(curve%knots) - 1
         associate (here => curve%knots(i), after => curve%knots(i + 1))
            if (which > 0) then
               if (.not. is_between(here, after, which, target)) cycle
               call find_zero(curve, which, target, here, after, point)
            else
               if ((here%pools .neqv. after%pools) .or. ((here%area < target) .eqv. (after%area < target))) cycle
               call find_point(curve, here%pools, target, point, here%answer)
            end if
         end associate
         if (point%exists) curve%at_loads = [curve%at_loads, point]
      end do
      has_stable = any(curve%at_loads(known + 1:)%kind == stable_point .or. &
                       (which /= at_load .and. curve%at_loads(known + 1:)%kind == approach_stable))
      if (.not. has_stable) curve%at_loads = [curve%at_loads, beyond_extremes(curve, which, target)]
      curve%at_loads(known + 1:)%number = number
   end subroutine add_load

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
      if (point%kind == not_solved .and. .not. is_ball(curve%surface)) then
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

   !> The point of a branch at a contact area fraction.
   subroutine find_point(curve, pools, area, point, start)
      type(adhesive_curve), intent(in) :: curve
      logical, intent(in) :: pools
      real(dp), intent(in) :: area                          !! 0 < area < 1
      type(adhesive_point), intent(out) :: point
      type(fitted_answer), intent(in), optional :: start    !! of another area of the branch

      point%pools = pools
      point%area = area
      if (is_ball(curve%surface)) then
         call find_point_of_ball(curve, point)
      else if (curve%surface%dimension == 1) then
         call find_point_of_line_wave(curve, point)
      else
         call find_point_of_lattice(curve, point, start)
      end if
      if (.not. point%exists) return
      if (point%value(approach_slope) > 0.0_dp) point%kind = approach_stable
      if (point%value(load_slope) > 0.0_dp) point%kind = stable_point
      if (.not. maxval(point%error) <= curve%accuracy) point%status = not_accurate
   end subroutine find_point

   !> By (I19), (I20), (I24): the load P1 of Hertz's contact of the same area less the tension T = 2 sqrt(F_c P1).
   subroutine find_point_of_ball(curve, point)
      type(adhesive_curve), intent(in) :: curve
      type(adhesive_point), intent(inout) :: point

      real(dp) :: delta, p1, tension
      type(hertz_ball) :: contact

      associate (surface => curve%surface)
         contact = hertz_contact(ball_radii(surface), 1.0_dp, area=point%area*surface%nominal_area())
         p1 = contact%force/(surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
         delta = contact%approach/surface%amplitude
      end associate
      tension = 2*sqrt(curve%pull*p1)
      point%exists = .true.
      ! P1 goes with the power 3/2 of the area, T with 3/4, Hertz's approach with 1.
      point%value = [p1 - tension, delta*(1.0_dp - 2*tension/(3*p1)), (1.5_dp*p1 - 0.75_dp*tension)/point%area, &
                     delta*(1.0_dp - tension/(6*p1))/point%area]
      point%error = 0.0_dp
      point%energy = delta*(0.4_dp*p1 - 2*tension*(p1 - 0.5_dp*tension)/(3*p1))
      point%energy_error = 0.0_dp
   end subroutine find_point_of_ball

   !> By (I21), (I24): Johnson (1995). P1 = sin^2 psi is the load of the same strip without adhesion, psi = pi area/2.
   subroutine find_point_of_line_wave(curve, point)
      type(adhesive_curve), intent(in) :: curve
      type(adhesive_point), intent(inout) :: point

      real(dp) :: p1, slope, tension

      associate (s => sin(0.5_dp*pi*point%area), c => cos(0.5_dp*pi*point%area))
         p1 = s**2
         tension = sqrt(2*curve%work*s/(pi*c))
         slope = 2*s*c - tension/(2*s*c)
         point%exists = .true.
         point%value(:2) = [p1 - tension, p1 - (p1 - tension)*log(p1)]
         point%value(3:) = 0.5_dp*pi*[slope, 2*s*c - slope*log(p1) - 2*(p1 - tension)*c/s]
         point%energy = 0.25_dp*p1**2 + log(p1)*(tension*(p1 - 0.5_dp*tension) - 0.5_dp*p1**2)
      end associate
      point%error = 0.0_dp
      point%energy_error = 0.0_dp
   end subroutine find_point_of_line_wave

   !> By expansions with a singular edge: src/core/fitted/README.md, section 15.
   subroutine find_point_of_lattice(curve, point, start)
      type(adhesive_curve), intent(in) :: curve
      type(adhesive_point), intent(inout) :: point
      type(fitted_answer), intent(in), optional :: start

      real(dp) :: cell   ! of one spot or pool, with the sign of d(contact area)

      allocate (point%answer)
      associate (lattice => curve%frame%lattice, unit => curve%frame%pressure_unit, answer => point%answer)
         cell = lattice%area
         if (point%pools) cell = -lattice%area/lattice%troughs
         call solve_adhesive(lattice, point%pools, curve%work/unit, merge(point%area - 1.0_dp, point%area, point%pools) &
                             *cell, curve%accuracy/(1.0_dp + curve%surface%full_contact_peak), answer, start)
         if (answer%status > fitted_less_exact) return
         point%exists = .true.
         point%value = [unit*answer%pbar_over_pstar, answer%value(approach), cell*[unit, 1.0_dp]*answer%area_slopes]
         point%error = [unit*answer%load_error, answer%error(mean_gap)]
         point%energy = answer%value(elastic_energy)*unit/lattice%area
         point%energy_error = answer%error(elastic_energy)*unit/lattice%area
      end associate
   end subroutine find_point_of_lattice

   !> The point between two of a branch at which one of the numbers has a value, by the secant method in a bracket
   !> for the area (Anderson and Bjorck). Without one it does not exist.
   subroutine find_zero(curve, which, target, first, last, point)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which                 !! of point%value
      real(dp), intent(in) :: target               !! between those of both points
      type(adhesive_point), intent(in) :: first, last
      type(adhesive_point), intent(out) :: point

      integer, parameter :: most_steps = 60
      real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
      integer :: step
      real(dp) :: area(2), before, changes(2), last_values(2), miss(2), missed, next
      type(fitted_answer) :: start

      missed = 0.0_dp
      changes = 0.0_dp
      last_values = last%value(:2)
      area = [first%area, last%area]
      miss = [first%value(which), last%value(which)] - target
      if (allocated(last%answer)) start = last%answer
      do step = 1, most_steps
         before = area(2)
         next = before - miss(2)*(before - area(1))/(miss(2) - miss(1))
         call find_point(curve, first%pools, next, point, start)
         if (.not. point%exists) return
         if (allocated(point%answer)) start = point%answer
         associate (new => point%value(which) - target)
            if (new*miss(2) <= 0.0_dp) then
               area(1) = area(2)
               miss(1) = miss(2)
            else
               miss(1) = miss(1)*merge(1.0_dp - new/miss(2), 0.5_dp, abs(new) < abs(miss(2)))
            end if
            area(2) = next
            miss(2) = new
         end associate
         if (abs(next - before) <= rounding*next) exit
         if (which <= 2) then
            missed = abs(point%value(which) - target)
            if (missed <= max(0.1_dp*point%error(which), epsilon(target)*abs(target))) exit
         else
            ! At an extreme of one value the other one changes with the area.
            changes = abs(point%value(:2) - last_values)
            if (all(changes <= max(0.1_dp*point%error, epsilon(target)*abs(last_values)))) exit
            last_values = point%value(:2)
         end if
      end do
      if (which > 2) then
         point%error = point%error + changes
         point%area_error = merge(unknown, abs(next - before), allocated(point%answer))
      else
         point%area_error = abs((missed + point%error(which))/point%value(2 + which))
      end if
   end subroutine find_zero

   !> Hertz's contact of a ball under a load [p*]; over p* and Delta the modulus does not matter.
   pure type(hertz_ball) function hertz_of_ball(surface, load) result(contact)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: load

      contact = hertz_contact(ball_radii(surface), 1.0_dp, &
                              force=load*surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
   end function hertz_of_ball

end module wavycon_adhesive_curve
