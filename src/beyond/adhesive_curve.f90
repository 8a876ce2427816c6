!> The curve of load, approach and area of the contact with adhesion in the limit of Johnson, Kendall & Roberts. The
!> curve is followed by the contact area, in which it has no turning points: load and approach have extremes along the
!> curve. Pull-off, jumps and the contacts of given loads are found as zeros along the curve. Equations (I..) are those
!> of README.md in this directory.
module wavycon_adhesive_curve
   use wavycon_adhesive_contact, only: adhesive_point, adhesive_problem, approach_jump, approach_pull_off, &
      approach_stable, at_approach, at_load, closed, end_of_branch, jump_to_bands, jump_to_full, jump_to_pools, &
      jump_to_spots, not_solved, pull_off_point, separated, stable_point, start_adhesive_problem, &
      unstable_point
   use wavycon_beyond_tuning, only: beyond_extreme, finer_by, first_over_critical, least_step, radius_growth, &
      radius_step, ratio_growth, ratio_of_extremes, sign_accuracy, worst_error
   use wavycon_contact_solution, only: contact_solution
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: is_known, unknown
   use wavycon_solution_record, only: converged, not_accurate, not_found
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: adhesive_curve, add_load, find_adhesive_solution, follow_curve

   type :: adhesive_curve
      !> Points of the curve: the branch of spots by rising contact area, then the branch of pools by falling one.
      type(adhesive_point), allocatable :: points(:)
      type(adhesive_point), allocatable :: critical(:)   !! extremes of load and approach, and the ends of branches
      type(adhesive_point), allocatable :: at_loads(:)   !! contacts at the loads of the deck, added by `add_load`
      !> Points and extremes in their order along the branches. P and approach are monotonic between two neighbours of
      !> one branch.
      type(adhesive_point), allocatable, private :: knots(:)
      type(adhesive_problem) :: problem
   end type adhesive_curve

   !> Number of points of a curve in closed form.
   integer, parameter :: closed_form_points = 95

contains

   !> Computes the curve: of the 1-D wave to nearly full contact; of waves on a lattice both branches to their last
   !> extremes; of a ball to the largest load of the deck or, if that is light, to a load beyond zero.
   subroutine follow_curve(surface, accuracy, work, largest_load, curve)
      type(surface_type), intent(in) :: surface   !! a 1-D wave, a round ball, or a wave on a lattice (find_frame)
      real(dp), intent(in) :: accuracy            !! largest allowed error of P [p*] and of the approach [Delta], > 0
      real(dp), intent(in) :: work                !! work of adhesion w' > 0 [p* Delta]
      real(dp), intent(in) :: largest_load        !! largest P for which `add_load` will be called [p*]
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

   !> Computes the points of a curve in closed form, at equal steps of ln P1 for a ball and of ln(P1/(1 - P1)) for the
   !> 1-D wave, where P1 is the load of the contact of the same area without adhesion.
   subroutine follow_closed_form(curve, largest_load)
      type(adhesive_curve), intent(inout) :: curve
      real(dp), intent(in) :: largest_load   !! as of follow_curve

      !> P1 of the first point over P1 at pull-off, for a wave over w', (I21).
      real(dp), parameter :: least_over_pull = 1e-3_dp
      real(dp) :: area, least, most, p1
      integer :: i
      type(hertz_ball) :: contact
      type(adhesive_point) :: point

      if (is_ball(curve%problem%surface)) then
         least = least_over_pull*curve%problem%pull
         ! Twice the P1 that belongs to the largest load. The deck may also give the approach of Hertz's contact under
         ! this load, at which P1 is larger with adhesion.
         most = 2*curve%problem%pull*(1.0_dp + sqrt(1.0_dp + max(largest_load/curve%problem%pull, 4.0_dp)))**2
      else
         least = min(2*least_over_pull*curve%problem%work, 1e-4_dp)
         most = 1.0_dp/least - 1.0_dp
      end if
      do i = 1, closed_form_points
         associate (t => real(i - 1, dp)/(closed_form_points - 1), surface => curve%problem%surface)
            p1 = least*(most/least)**t
            if (surface%dimension == 1) then
               p1 = p1/(1.0_dp + p1)
               area = 2/pi*asin(sqrt(p1))
            else
               contact = hertz_contact(ball_radii(surface), 1.0_dp, &
                                       force=p1*surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
               area = contact%contact_area()/surface%nominal_area()
            end if
         end associate
         call curve%problem%find_point(.false., area, point)
         call add_point(curve, point)
      end do
   end subroutine follow_closed_form

   !> Follows one branch of a wave on a lattice by steps of the radius of a circle of the spot's or pool's area. The
   !> first radius is smaller than that of pull-off of a spot, or of the largest load of a pool, (I20). Where neighbours
   !> have moved the first extreme, which is of the approach of spots or of the load of pools, to a smaller radius, the
   !> branch starts at half the radius. It ends past the last extreme of the approach, before spots or pools touch.
   subroutine follow_branch(curve, pools)
      type(adhesive_curve), intent(inout) :: curve
      logical, intent(in) :: pools   !! true: the branch of pools; false: of spots

      real(dp), parameter :: largest_first = 0.1_dp, largest_error = 0.02_dp
      !> `cell_area`: area of the lattice that belongs to one spot or pool. `cell_radius`: radius of a circle of this
      !> area. `part`: of the cell that is in contact. `ratio`: merging ratio of the last point; 0 if there is none yet.
      real(dp) :: cell_area, cell_radius, full_step, next, part, radius, ratio, step
      integer :: n
      logical :: starts_late   ! whether the point would be the first one, and is past the first extreme
      !> `past`: the newest point past the last extreme that is not accurate enough, if there is any.
      type(adhesive_point) :: past, point
      type(adhesive_problem) :: finer
      type(fitted_answer) :: start

      finer = curve%problem
      finer%accuracy = finer_by*min(finer%accuracy, sign_accuracy)
      associate (lattice => curve%problem%frame%lattice, work => curve%problem%work/curve%problem%frame%pressure_unit)
         cell_area = lattice%area
         if (pools) cell_area = lattice%area/lattice%troughs
         cell_radius = sqrt(cell_area/pi)
         associate (curvature => sqrt(product(lattice%curvatures(pools))))
            if (pools) then
               radius = (0.75_dp*sqrt(0.5_dp*work)/curvature)**0.4_dp
            else
               radius = (9*pi**2*work/(8*curvature**2))**(1.0_dp/3)
            end if
         end associate
         radius = min(first_over_critical*radius, largest_first*cell_radius)
      end associate
      ratio = 0.0_dp
      step = radius
      full_step = radius
      do
         part = pi*radius**2/cell_area
         if (pools) part = 1.0_dp - part
         ! The sign of a slope decides where the branch ends, and between which points an extreme lies.
         call curve%problem%find_point(pools, part, point, start, merge(finer%accuracy, curve%problem%accuracy, &
                                                                        ratio > ratio_of_extremes))
         if (contradicts() .and. maxval(point%error) > finer%accuracy) then
            start = point%answer
            call finer%find_point(pools, part, point, start)
         end if
         starts_late = point%exists .and. ratio <= 0.0_dp .and. &
                       point%value(2 + merge(at_load, at_approach, pools)) > 0.0_dp
         ! Near the end of a branch a solution may be less accurate than asked for. A shorter step then leads to a
         ! solution that is accurate.
         if (point%exists .and. .not. (starts_late .or. contradicts()) .and. &
             maxval(point%error) <= min(worst_error*curve%problem%accuracy, largest_error)) then
            call add_point(curve, point)
            start = point%answer
            ! Past its last extreme the approach falls with the radius, and no contact is stable from there on.
            if (start%merging_ratio > ratio_of_extremes .and. .not. point%value(2 + at_approach) > 0.0_dp) exit
            full_step = min(radius_step*cell_radius, radius_growth*radius)
            associate (growth => max(start%merging_ratio - ratio, epsilon(ratio)))
               step = min(full_step, step*ratio_growth*(1.0_dp - start%merging_ratio)/growth)
            end associate
            ratio = start%merging_ratio
            if (ratio > ratio_of_extremes) then
               ! From three slopes or, where these lead back, from the last two.
               do n = 2, 1, -1
                  associate (newest => curve%points(size(curve%points) - n:))
                     next = interpolated(newest%area, newest%value(2 + at_approach))
                  end associate
                  if (pools) next = 1.0_dp - next
                  next = sqrt(max(next, 0.0_dp)*cell_area/pi)
                  if (next > radius) exit
               end do
               if (next > radius) &
                  step = min(step, max(beyond_extreme*(next - radius), 0.1_dp*least_step*full_step))
            end if
         else
            if (point%exists .and. ratio > ratio_of_extremes .and. maxval(point%error) <= largest_error .and. &
                point%value(2 + at_approach) < -point%slope_error(at_approach)) past = point
            radius = radius - step
            step = 0.5_dp*step
            if ((ratio <= 0.0_dp .and. .not. starts_late) .or. step < least_step*full_step) exit
         end if
         radius = radius + step
      end do
      if (ratio <= 0.0_dp) return
      ! Of a point past the last extreme only the sign of the slope has to be sure.
      point = curve%points(size(curve%points))
      if (past%exists .and. point%value(2 + at_approach) > 0.0_dp .and. &
          (past%area > point%area .neqv. pools)) then
         call add_point(curve, past)
         point = past
      end if
      point%kind = end_of_branch
      ! The last extreme of the approach is missing then, perhaps one of the load, too.
      if (point%value(2 + at_approach) > 0.0_dp) point%status = not_found
      curve%critical = [curve%critical, point]

   contains

      !> Whether the slope says that the approach rises with the area, and the last point's approach that it falls: the
      !> slope is then wrong.
      pure logical function contradicts()
         contradicts = ratio > ratio_of_extremes .and. point%exists
         if (.not. contradicts) return
         associate (last => curve%points(size(curve%points)))
            contradicts = point%value(2 + at_approach) > 0.0_dp .and. &
                          (point%value(at_approach) - last%value(at_approach))*(point%area - last%area) < 0.0_dp
         end associate
      end function contradicts

   end subroutine follow_branch

   !> Adds a point at the end of its branch, and before the point the extremes of load and approach that lie between the
   !> last point and this one.
   subroutine add_point(curve, point)
      type(adhesive_curve), intent(inout) :: curve
      type(adhesive_point), intent(in) :: point

      !> Kinds of extremes: (1, :) of a minimum, (2, :) of a maximum; (:, 1) of the load, (:, 2) of the approach.
      integer, parameter :: kinds(2, 2) = reshape([pull_off_point, jump_to_full, approach_pull_off, &
                                                   approach_jump], [2, 2])
      integer :: n, which   ! which: at_load or at_approach
      type(adhesive_point) :: before, extreme(2)

      n = size(curve%points)
      if (n > 0) before = curve%points(n)
      if (before%exists .and. (before%pools .eqv. point%pools)) then
         do which = 1, 2
            associate (slope => [before%value(2 + which), point%value(2 + which)])
               if (slope(1)*slope(2) >= 0.0_dp) cycle
               call find_zero(curve, 2 + which, 0.0_dp, before, point, extreme(which))
               ! The solution of the last point of a branch may be a bad start. That of the point before may be better.
               if (.not. extreme(which)%exists) &
                  call find_zero(curve, 2 + which, 0.0_dp, point, before, extreme(which))
               ! At a maximum the slope is positive on the side of the smaller area: before it on the branch of spots,
               ! after it on that of pools.
               extreme(which)%kind = kinds(1, which)
               if ((slope(1) > 0.0_dp) .neqv. point%pools) extreme(which)%kind = kinds(2, which)
               if (extreme(which)%exists .and. (all(is_known(extreme(which)%error)) .or. &
                   (extreme(which)%area - before%area)*(extreme(which)%area - point%area) <= 0.0_dp)) cycle
               ! Only the areas between which it lies are known, and these where both slopes are larger than their
               ! errors. Next to merging, where a slope may have the wrong sign, the last step of the search may lead
               ! out of the areas with an unknown error.
               extreme(which) = adhesive_point(kind=extreme(which)%kind, pools=point%pools, status=not_found, &
                                               area=0.5_dp*(before%area + point%area), area_error=unknown)
               if (.not. any(doubt(slope, [before%slope_error(which), point%slope_error(which)]) > 0.0_dp)) &
                  extreme(which)%area_error = 0.5_dp*abs(before%area - point%area)
            end associate
         end do
         if (all(extreme%kind /= unstable_point)) then
            if (extreme(1)%area > extreme(2)%area .neqv. point%pools) extreme = extreme([2, 1])
         end if
         do n = 1, 2   ! gfortran loses memory where pack stands in an array constructor
            if (extreme(n)%kind /= unstable_point) curve%critical = [curve%critical, extreme(n)]
            if (extreme(n)%exists) curve%knots = [curve%knots, extreme(n)]
         end do
      end if
      curve%points = [curve%points, point]
      curve%knots = [curve%knots, point]
   end subroutine add_point

   !> Names each extreme of the load by the stable contact that the bodies jump to under this load. At a maximum this is
   !> the stable contact with the next larger area, at a minimum that with the next smaller area. Without one the
   !> extreme keeps its name, pull-off or jump to full contact.
   subroutine name_jumps(curve)
      type(adhesive_curve), intent(inout) :: curve

      integer :: i, k

      do i = 1, size(curve%critical)
         associate (point => curve%critical(i))
            if (.not. point%exists .or. all(point%kind /= [pull_off_point, jump_to_full])) cycle
            do k = 1, size(curve%knots) - 1
               associate (here => curve%knots(k), after => curve%knots(k + 1))
                  if (.not. is_between(here, after, at_load, point%value(at_load)) .or. &
                      .not. (after%value(at_load) > here%value(at_load) .neqv. after%area < here%area)) cycle
                  ! The intervals beside the extreme have its load at the extreme itself, which is not a jump.
                  if (min(abs(here%area - point%area), abs(after%area - point%area)) <= 0.0_dp) cycle
                  if (here%area > point%area .neqv. point%kind == pull_off_point) then
                     point%kind = jump_to_spots
                     if (here%pools) point%kind = jump_to_pools
                  end if
               end associate
               if (all(point%kind /= [pull_off_point, jump_to_full])) exit
            end do
            ! If spots are stable under lighter loads only, and pools under heavier ones, the contact between them
            ! consists of bands.
            if (any(point%kind == [pull_off_point, jump_to_full]) .and. &
                any((curve%knots%pools .neqv. point%pools) .and. curve%knots%value(2 + at_load) > 0.0_dp .and. &
                    (curve%knots%value(at_load) > point%value(at_load) .neqv. point%pools)) .and. &
                (point%pools .eqv. point%kind == pull_off_point)) point%kind = jump_to_bands
         end associate
      end do
   end subroutine name_jumps

   !> Whether two neighbouring knots are on one branch and a value of the load or approach lies between theirs.
   pure logical function is_between(here, after, which, target)
      type(adhesive_point), intent(in) :: here, after
      integer, intent(in) :: which       !! position in point%value, such as at_load
      real(dp), intent(in) :: target     !! the value

      is_between = (here%pools .eqv. after%pools) .and. &
                   ((here%value(which) < target) .neqv. (after%value(which) < target))
   end function is_between

   !> Adds to `at_loads` all contacts at a given load, approach or area: those of spots by rising area, then those of
   !> pools by falling area. If none of them is stable, a point is added that says whether the bodies are separated or
   !> in full contact.
   subroutine add_load(curve, which, target, number)
      type(adhesive_curve), intent(inout) :: curve
      integer, intent(in) :: which     !! what is given: at_load, at_approach, or 0 for the contact area fraction
      real(dp), intent(in) :: target   !! P [p*], approach [Delta] or area fraction
      integer, intent(in) :: number    !! number of the deck's load

      integer :: i, known
      logical :: is_found   ! whether a stable contact is found; of a given area, which may be unstable, always true
      type(adhesive_point) :: point

      known = size(curve%at_loads)
      if (which == 0) then
         call add_contacts_of_area(curve, target)
      else
         do i = 1, size(curve%knots) - 1
            associate (here => curve%knots(i), after => curve%knots(i + 1))
               if (.not. is_between(here, after, which, target)) cycle
               call find_zero(curve, which, target, here, after, point)
            end associate
            if (point%exists) curve%at_loads = [curve%at_loads, point]
         end do
      end if
      is_found = any(curve%at_loads(known + 1:)%kind == stable_point .or. which == 0 .or. &
                     (which == at_approach .and. curve%at_loads(known + 1:)%kind == approach_stable))
      if (.not. is_found) curve%at_loads = [curve%at_loads, beyond_extremes(curve, which, target)]
      curve%at_loads(known + 1:)%number = number
   end subroutine add_load

   !> Adds to `at_loads` the contacts of a given area, of each branch that has it. They start from the knot before this
   !> area, those before the first knot from it or, if it is too far away, from the asymptote of small spots or pools.
   !> Closed forms hold at any area, also beyond the ends of the computed curve.
   subroutine add_contacts_of_area(curve, area)
      type(adhesive_curve), intent(inout) :: curve
      real(dp), intent(in) :: area     !! area fraction

      integer :: before, first, members   ! of a branch's knots: those before the area, the first one, how many
      logical :: pools
      logical, allocatable :: are_of_branch(:)
      type(adhesive_point) :: point

      if (.not. (area > 0.0_dp .and. area < 1.0_dp)) return
      pools = .false.
      do
         are_of_branch = curve%knots%pools .eqv. pools
         members = count(are_of_branch)
         before = count(are_of_branch .and. (curve%knots%area < area .neqv. pools))
         first = findloc(are_of_branch, .true., dim=1)
         if (before < members .or. curve%problem%has_closed_form) then
            call curve%problem%find_point(pools, area, point, curve%knots(first + max(before - 1, 0))%answer)
            if (point%exists) curve%at_loads = [curve%at_loads, point]
         end if
         if (pools .or. curve%problem%has_closed_form) return
         pools = .true.
      end do
   end subroutine add_contacts_of_area

   !> The contact at a load of the deck as a solution with fields. Of several stable contacts the one with the largest
   !> area is taken, which the bodies reach by unloading. If an approach is given, contacts that are stable at the
   !> approach count as well. If an area is given, the contact may be unstable.
   subroutine find_adhesive_solution(curve, which, number, solution)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which     !! as of add_load
      integer, intent(in) :: number    !! number of a load for which add_load was called
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

   !> The state of the bodies at a load or approach at which no partial contact is stable: separated, in full contact,
   !> or not solved.
   pure type(adhesive_point) function beyond_extremes(curve, which, target) result(point)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which       !! as of add_load
      real(dp), intent(in) :: target     !! as of add_load

      real(dp), allocatable :: stable(:)   ! loads or approaches of the stable contacts
      real(dp) :: largest                  ! above this value there is full contact

      point%kind = not_solved
      point%status = not_found
      if (which == 0) return
      stable = pack(curve%knots%value(which), curve%knots%value(2 + which) >= 0.0_dp)
      if (size(stable) > 0) then
         if (target < minval(stable)) point = adhesive_point(exists=.true., kind=separated)
      end if
      if (point%kind == not_solved .and. .not. is_ball(curve%problem%surface)) then
         largest = -huge(1.0_dp)
         if (which == at_approach) largest = 1.0_dp
         if (target > maxval([stable, largest])) point = adhesive_point(exists=.true., kind=closed, area=1.0_dp)
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

   !> Finds the point between two points of a branch at which load, approach or one of their derivatives has a given
   !> value.
   !>
   !> The area is the unknown. A load or an approach is found by Newton's method, an extreme by inverse interpolation of
   !> the last three slopes. A step that would leave the bracket is replaced by bisection. All solutions start from that
   !> of the point `last`, so that they have the same degrees and their differences are smooth. The last step to an
   !> extreme is taken by the derivatives alone. If the point has too large an error, the search goes on once more with
   !> a smaller accuracy. If there is no solution at an area of the search, point%exists is .false.
   subroutine find_zero(curve, which, target, first, last, point)
      type(adhesive_curve), intent(in) :: curve
      integer, intent(in) :: which                    !! position in point%value: 1, 2 load, approach; 3, 4 their slopes
      real(dp), intent(in) :: target                  !! the value, between those of `first` and `last`; 0 for a slope
      type(adhesive_point), intent(in) :: first, last
      type(adhesive_point), intent(out) :: point

      integer, parameter :: most_steps = 60
      !> The search ends if the next step changes load and approach by less than `part_of_error` of their errors. The
      !> accuracy of a repeated search is the last point's error times a factor from `least_tightening` to `tightening`.
      real(dp), parameter :: rounding = 4*epsilon(1.0_dp), part_of_error = 0.1_dp, tightening = 0.3_dp, &
         least_tightening = 0.1_dp
      !> `fine`: number of solutions with a smaller accuracy. `other`: area from which the curvature is.
      !> `side`: of the bracket.
      integer :: fine, n, other, side
      logical :: is_extreme   ! whether a slope is to become 0
      !> `area`, `miss`: areas so far, and value(which) less the target there. `bracket`, `next`: the areas between
      !> which the point lies, and the next area. `unsure`: of an extreme, the errors of the slopes at the ends of
      !> `bracket` that are no smaller than these slopes, otherwise 0. `changes`, `errors`: those of load and approach,
      !> by the next step and of the last point. `curvature`, `ends`: the derivative of the slope, and the two areas
      !> that it is from. `curvature_error`: relative. `solved`: larger error of the last solution, before the step by
      !> the derivatives.
      real(dp) :: area(most_steps), bracket(2), changes(2), curvature, curvature_error, ends(2), errors(2), &
         miss(most_steps), next, solved, unsure(2)
      type(adhesive_problem) :: problem

      problem = curve%problem
      is_extreme = which > 2
      area(:2) = [first%area, last%area]
      miss(:2) = [first%value(which), last%value(which)] - target
      unsure = 0.0_dp
      if (is_extreme) unsure = doubt(miss(:2), [first%slope_error(which - 2), last%slope_error(which - 2)])
      ! The end with the larger miss comes first, because interpolation drops the first point first.
      if (abs(miss(1)) < abs(miss(2))) then
         area(:2) = area([2, 1])
         miss(:2) = miss([2, 1])
         unsure = unsure([2, 1])
      end if
      bracket = area(:2)
      fine = 0
      do n = 2, most_steps - 1
         if (n > 2 .and. .not. is_extreme) then
            next = area(n) - miss(n)/point%value(2 + which)
         else if (fine == 1) then
            next = area(n) - miss(n)/curvature
         else
            next = interpolated(area(max(1, n - 2 + fine/2):n), miss(max(1, n - 2 + fine/2):n))
         end if
         if (.not. (fine > 0 .or. (next - bracket(1))*(next - bracket(2)) < 0.0_dp)) next = 0.5_dp*sum(bracket)
         if (n > 2) then
            changes = abs(point%value(3:)*(next - area(n)))
            errors = point%error
            if (is_extreme) then
               ! The changes are those that a step by the derivatives leaves out, and the errors have that of the slope
               ! besides.
               if (fine /= 1) then
                  other = n - 1
                  if (fine == 0) other = min(other, 3)
                  ends = area([n, other])
                  curvature = (miss(n) - miss(other))/(area(n) - area(other))
                  ! `first` and `last` have other degrees than the solutions of the search: errors of slopes differ.
                  curvature_error = 0.0_dp
                  if (other < 3) curvature_error = maxval([first%slope_error(which - 2), last%slope_error(which - 2), &
                                                           point%slope_error(which - 2)])/abs(miss(n) - miss(other))
               end if
               changes = changes*left_over()
               errors = errors + abs(point%value(3:)*point%slope_error(which - 2)/curvature)
            else
               ! What is missing of a given load is part of the error of the approach, and the other way round.
               changes(3 - which) = 0.0_dp
            end if
            if ((fine > 0 .and. is_extreme) .or. abs(next - area(n)) <= rounding*next .or. &
                all(changes <= max(part_of_error*errors, epsilon(next)*abs(point%value(:2))))) then
               solved = maxval(point%error)
               if (is_extreme) then
                  call step_to_extreme()
               else
                  call add_error_of_area()
               end if
               if (fine == merge(2, 1, is_extreme) .or. maxval(point%error) <= curve%problem%accuracy) exit
               ! A second solution at the same area would give no curvature.
               if (fine == 1 .and. abs(next - area(n)) <= rounding*next) exit
               ! The area is not known accurately enough. Its error falls with that of the solutions. If it is the
               ! curvature of an extreme that is not, a second solution of the same accuracy gives it.
               fine = fine + 1
               if (fine == 1) problem%accuracy = &
                  solved*max(least_tightening, tightening*problem%accuracy/maxval(point%error))
            end if
         end if
         call problem%find_point(first%pools, next, point, last%answer)
         if (.not. point%exists) return
         area(n + 1) = next
         miss(n + 1) = point%value(which) - target
         side = merge(1, 2, (miss(n + 1) > 0.0_dp) .eqv. (miss(1) > 0.0_dp))
         bracket(side) = next
         if (is_extreme) unsure(side) = doubt(miss(n + 1), point%slope_error(which - 2))
      end do
      if (n == most_steps .and. .not. is_extreme) call add_error_of_area()
      point%status = converged
      if (.not. maxval(point%error) <= curve%problem%accuracy) point%status = not_accurate

   contains

      !> An estimate of the relative error of the step to `next`, (I20a): the curvature is that between the areas
      !> `ends`, not that between the last area and the extreme.
      real(dp) function left_over()
         real(dp) :: moved, to_bracket(2)   ! to_bracket: curvatures between the last area and `first`, `last`

         moved = abs(area(n) - ends(1))
         to_bracket = (miss(:2) - miss(n))/(area(:2) - area(n))
         left_over = (moved + abs(next - ends(2)))*max(1.0_dp/abs(last%area - first%area), &
            maxval(abs(to_bracket/curvature - 1.0_dp)/max(moved + abs(area(:2) - ends(2)), tiny(moved))))
      end function left_over

      !> Sets the error of the area of a contact with a given load or approach, and adds to those of the other one and
      !> of the energy what it causes.
      subroutine add_error_of_area()
         point%area_error = abs((abs(miss(n)) + point%error(which))/point%value(2 + which))
         point%error(3 - which) = point%error(3 - which) + abs(point%value(5 - which))*point%area_error
         point%energy_error = point%energy_error + point%area_error &
                              *abs(point%value(at_load)*point%value(2 + at_approach) + problem%work)
      end subroutine add_error_of_area

      !> Takes the last step, to `next`, by the derivatives instead of a solution, and adds to the errors of load,
      !> approach and energy those that the error of the area causes.
      subroutine step_to_extreme()
         real(dp) :: added(2), bend(2), change(2), step

         step = next - area(n)
         point%area = next
         associate (e => min(left_over() + curvature_error, 1.0_dp - epsilon(step)))
            point%area_error = min(abs(step)*e/(1.0_dp - e), maxval(abs(bracket - next) + abs(unsure/curvature))) &
                               + abs(point%slope_error(which - 2)/curvature)
         end associate
         change = point%value(3:)
         ! The slope of the value that has the extreme falls to 0 along the step, but not linearly. What the step leaves
         ! out of the other value is of second order.
         bend = max(abs((first%value(3:) - change)/(first%area - area(n))), &
                    abs((last%value(3:) - change)/(last%area - area(n))))
         bend(which - 2) = 0.0_dp
         added = abs(change)*point%area_error + 0.5_dp*bend*step**2
         change(which - 2) = 0.5_dp*change(which - 2)
         ! (I15)
         associate (p => point%value(at_load) + 0.5_dp*change(at_load)*step)
            point%energy = point%energy + (p*change(at_approach) + problem%work)*step
            point%energy_error = point%energy_error + abs(p)*added(at_approach) + problem%work*point%area_error
         end associate
         point%value(:2) = point%value(:2) + change*step
         point%error = point%error + added
         ! Next to merging the slope may have no error estimate.
         if (point%area_error >= 1.0_dp) then
            point%area_error = unknown
            point%error = unknown
            point%energy_error = unknown
         end if
      end subroutine step_to_extreme

   end subroutine find_zero

   !> The error of a slope that has no sure sign, being no larger than its error; 0 where the slope is larger.
   elemental real(dp) function doubt(slope, error)
      real(dp), intent(in) :: slope, error

      doubt = merge(0.0_dp, error, abs(slope) > error)
   end function doubt

   !> The argument at which a function is 0, by inverse interpolation of its values (Neville's algorithm).
   pure real(dp) function interpolated(arguments, values) result(zero)
      real(dp), intent(in) :: arguments(:), values(:)   !! arguments of the function and its values there

      real(dp) :: p(size(arguments))
      integer :: i, k

      p = arguments
      do k = 1, size(p) - 1
         do i = 1, size(p) - k
            p(i) = (values(i + k)*p(i) - values(i)*p(i + 1))/(values(i + k) - values(i))
         end do
      end do
      zero = p(1)
   end function interpolated

end module wavycon_adhesive_curve
