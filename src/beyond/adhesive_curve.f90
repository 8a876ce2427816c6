!> The contact with adhesion in the limit of Johnson, Kendall & Roberts, by Ciavarella's superposition: a contact
!> without adhesion at a mean pressure P1, less the field of a rigid punch of the contact's shape under a tension T.
!>
!> The curve is followed by P1, through its turning points. Equations (I..) are those of README.md in this directory.
module wavycon_adhesive_curve
   use, intrinsic :: iso_c_binding, only: c_size_t
   use wavycon_constants, only: pi
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_gsl, only: gsl_sort_index
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, area_slope, contact_area, gap_curvature, gap_slope, is_known, &
      least_intensity, mean_gap, most_intensity, quantities, scaled
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: adhesive_point, adhesive_curve, follow_curve, add_load

   !> Points of the curve; of a wave without its ends.
   integer, parameter :: curve_points = 95
   !> Of the parameter t, 0 < t < 1, from one point to the next.
   real(dp), parameter :: t_step = 1.0_dp/(curve_points + 1)

   !> What a point is.
   integer, parameter, public :: unstable_point = 0, stable_point = 1, pull_off_point = 2, jump_point = 3, &
      separated = 4, closed = 5, not_reliable = 6
   character(20), parameter, public :: point_names(0:6) = [character(20) :: 'unstable', 'stable', 'pull_off', &
      'jump_to_full_contact', 'separated', 'full_contact', 'not_reliable']
   !> Extremes of a wave this number of points from one whose energy release rate exceeds this part of w are artefacts:
   !> there spots are about to merge, and the superposition fails.
   integer, parameter :: near = 3
   real(dp), parameter :: most_release = 1.5_dp

   type :: adhesive_point
      logical :: exists = .false.             !! otherwise there is no solution at P1 with its derivatives
      integer :: kind = unstable_point        !! stable: where P rises with P1
      integer :: number = 0                   !! of the load asked for, from 1
      real(dp) :: p1 = 0.0_dp                 !! P1 [p*]
      real(dp) :: load = 0.0_dp, load_error = 0.0_dp           !! P = P1 - T (I16), < 0 is a tension [p*]
      real(dp) :: approach = 0.0_dp, approach_error = 0.0_dp   !! (I17) [Delta]
      real(dp) :: area = 0.0_dp, area_error = 0.0_dp           !! the contact area fraction
      !> Least and largest energy release rate along the edge over w: 1 where the superposition is exact.
      real(dp) :: release_range(2) = 1.0_dp
      real(dp) :: t = 0.0_dp                  !! the parameter of a wave's curve
   end type adhesive_point

   type :: adhesive_curve
      type(adhesive_point), allocatable :: points(:)     !! by rising P1
      type(adhesive_point), allocatable :: critical(:)   !! extremes of P: pull-off and jumps into full contact
      type(adhesive_point), allocatable :: at_loads(:)   !! the stable and the unstable points of loads asked for
      !> Of a wave, points that exist and extremes that are reliable, by rising P1: P is monotonic between them.
      type(adhesive_point), allocatable, private :: knots(:)
      real(dp), private :: least = 0.0_dp     !! P1 at the ends of a wave's curve, from 0 and from 1
      real(dp), private :: pull = 0.0_dp      !! F_c of a ball (I20) over p* A_0
      real(dp), private :: work = 0.0_dp      !! w' > 0 [p* Delta]
   end type adhesive_curve

contains

   !> Follows the curve of a wave to P1 = 1, that of a ball to the largest load or, if that is light, beyond zero load.
   subroutine follow_curve(solver, work, largest_load, curve)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: work           !! w' > 0 [p* Delta]
      real(dp), intent(in) :: largest_load   !! P of the loads that will be asked for [p*]
      type(adhesive_curve), intent(out) :: curve

      type(adhesive_point) :: point
      integer :: i
      integer(c_size_t), allocatable :: places(:)

      curve%work = work
      allocate (curve%points(curve_points), curve%critical(0), curve%at_loads(0), curve%knots(0))
      if (is_ball(solver%surface)) then
         call follow_ball(curve, solver%surface, largest_load)
         return
      end if
      ! Pull-off lies at P1 = (3/(4 pi)) w' or above (I18).
      curve%least = min(2e-3_dp*curve%work, 1e-4_dp)
      do i = 1, curve_points
         call solve_point(curve, solver, i*t_step, curve%points(i))
      end do
      do i = 2, curve_points
         associate (before => curve%points(i - 1), here => curve%points(i), &
                    after => curve%points(min(i + 1, curve_points)))
            if (.not. (before%exists .and. here%exists .and. after%exists)) cycle
            if (after%load > before%load) curve%points(i)%kind = stable_point
            if (i == curve_points .or. (here%load - before%load)*(after%load - here%load) > 0.0_dp) cycle
            point = here
            point%kind = not_reliable
            if (all(curve%points(max(1, i - near):min(i + near, curve_points))%release_range(2) <= most_release)) &
               call find_extreme(curve, solver, before, after, point)
            curve%critical = [curve%critical, point]
         end associate
      end do
      curve%knots = [pack(curve%points, curve%points%exists), pack(curve%critical, curve%critical%kind /= not_reliable)]
      allocate (places(size(curve%knots)))
      call gsl_sort_index(places, curve%knots%p1, 1_c_size_t, size(places, kind=c_size_t))
      curve%knots = curve%knots(places + 1)
   end subroutine follow_curve

   !> By equal steps of ln P1.
   subroutine follow_ball(curve, surface, largest_load)
      type(adhesive_curve), intent(inout) :: curve
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: largest_load

      real(dp), parameter :: least_over_pull = 1e-3_dp
      real(dp) :: ratio   ! the largest P1 over the least
      integer :: i

      curve%pull = 1.5_dp*pi*curve%work*surface%amplitude*maxval(ball_radii(surface))/surface%nominal_area()
      ratio = (1.0_dp + sqrt(1.0_dp + max(largest_load/curve%pull, 4.0_dp)))**2/least_over_pull
      do i = 1, curve_points
         curve%points(i) = point_of_ball(curve%pull, surface, &
            least_over_pull*curve%pull*ratio**(real(i - 1, dp)/(curve_points - 1)))
      end do
      curve%critical = [point_of_ball(curve%pull, surface, curve%pull)]
      curve%critical%kind = pull_off_point
   end subroutine follow_ball

   !> Adds the points of the curve at a load, by rising P1; where it is not reliable, a point near by. Beyond pull-off
   !> and jump none of them is stable: the bodies are separated, or in full contact.
   subroutine add_load(curve, solver, load, number)
      type(adhesive_curve), intent(inout) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: load    !! P [p*]
      integer, intent(in) :: number   !! of the load

      type(adhesive_point) :: point
      integer :: i, known
      logical :: has_stable   ! whether P rises through the load, if only where that is not reliable
      real(dp) :: root

      known = size(curve%at_loads)
      has_stable = .false.
      do i = 1, size(curve%knots) - 1
         associate (here => curve%knots(i), after => curve%knots(i + 1))
            if ((here%load < load) .eqv. (after%load < load)) cycle
            has_stable = has_stable .or. after%load > here%load
            point = adhesive_point()
            if (max(here%release_range(2), after%release_range(2)) <= most_release) &
               call find_crossing(curve, solver, load, here, after, point)
            point%kind = merge(stable_point, unstable_point, after%load > here%load)
            if (.not. point%exists) then
               point = here
               point%kind = not_reliable
            end if
         end associate
         curve%at_loads = [curve%at_loads, point]
      end do
      associate (pull => curve%pull, surface => solver%surface, critical => curve%critical)
         if (is_ball(surface) .and. load >= -pull) then
            ! sqrt(P1) = sqrt(F_c) +- sqrt(F_c + P), by (I20).
            has_stable = .true.
            root = sqrt(pull) + sqrt(pull + load)
            if (load < 0.0_dp .and. load > -pull) &
               curve%at_loads = [curve%at_loads, point_of_ball(pull, surface, (load/root)**2)]
            curve%at_loads = [curve%at_loads, point_of_ball(pull, surface, root**2)]
         end if
         if (.not. has_stable) then
            point = adhesive_point(exists=.true., kind=closed, p1=load, load=load, approach=1.0_dp, area=1.0_dp)
            if (any(critical%kind == pull_off_point)) then
               if (load <= minval(critical%load, critical%kind == pull_off_point)) &
                  point = adhesive_point(exists=.true., kind=separated, p1=load, load=load)
            end if
            curve%at_loads = [curve%at_loads, point]
         end if
      end associate
      curve%at_loads(known + 1:)%number = number
   end subroutine add_load

   !> The point of a round ball at P1 = T^2/(4 F_c), to rounding: (I20), and (I17) with Hertz's contact (I19).
   type(adhesive_point) function point_of_ball(pull, surface, p1) result(point)
      real(dp), intent(in) :: pull                !! F_c [p* A_0]
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p1

      type(hertz_ball) :: contact

      ! Over p* and Delta the modulus does not matter.
      contact = hertz_contact(ball_radii(surface), 1.0_dp, &
                              force=p1*surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
      point = adhesive_point(exists=.true., kind=merge(stable_point, unstable_point, p1 >= pull), p1=p1, &
                             load=p1 - 2*sqrt(pull*p1), area=contact%contact_area()/surface%nominal_area(), &
                             approach=contact%approach/surface%amplitude)
      if (p1 > 0.0_dp) point%approach = point%approach*(1.0_dp - 4*sqrt(pull/p1)/3)
   end function point_of_ball

   !> The point of a parameter t of a wave's curve, 0 < t < 1, which goes in equal steps of ln(P1/(1 - P1)): (I15) to
   !> (I17).
   subroutine solve_point(curve, solver, t, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: t
      type(adhesive_point), intent(out) :: point

      type(contact_solution) :: solution
      type(quantities) :: slopes
      real(dp) :: p1, tension, tension_error

      p1 = 1.0_dp/(1.0_dp + (1.0_dp/curve%least - 1.0_dp)**(1.0_dp - 2*t))
      call solver%solve(p1, solution)
      if (solution%is_good()) call solution%derivatives(solver%surface, slopes)
      point%t = t
      point%p1 = p1
      point%exists = is_known(slopes%value(area_slope)) .and. is_known(slopes%value(gap_curvature)) &
         .and. min(slopes%value(area_slope), slopes%value(gap_curvature)) > 0.0_dp
      if (.not. point%exists) return
      tension = sqrt(2*curve%work*slopes%value(area_slope)/slopes%value(gap_curvature))
      tension_error = scaled(slopes%error(area_slope), 0.5_dp*tension/slopes%value(area_slope)) &
                      + scaled(slopes%error(gap_curvature), 0.5_dp*tension/slopes%value(gap_curvature))
      point%load = p1 - tension
      point%load_error = tension_error
      point%approach = solution%value(approach) + slopes%value(gap_slope)*tension
      point%approach_error = solution%error(mean_gap) + scaled(slopes%error(gap_slope), tension) &
                             + scaled(tension_error, -slopes%value(gap_slope))
      point%area = solution%value(contact_area)
      point%area_error = solution%error(contact_area)
      point%release_range = slopes%value([least_intensity, most_intensity])
   end subroutine solve_point

   !> An extreme of P between two points, by parabolas through three points that come closer. It is not reliable
   !> unless it lies between them and its P beyond theirs.
   subroutine find_extreme(curve, solver, first, last, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      type(adhesive_point), intent(in) :: first, last
      type(adhesive_point), intent(inout) :: point   !! between them, its P beyond theirs; then the extreme

      integer, parameter :: steps = 5
      real(dp), parameter :: narrowing = 0.2_dp
      type(adhesive_point) :: after, before, here
      real(dp) :: bend, sense, width
      integer :: i

      sense = sign(1.0_dp, 2*point%load - first%load - last%load)
      before = first
      here = point
      after = last
      width = t_step
      do i = 1, steps
         bend = before%load - 2*here%load + after%load
         if (.not. sense*bend < 0.0_dp) exit
         call solve_point(curve, solver, &
                          here%t + width*min(max(0.5_dp*(before%load - after%load)/bend, -1.0_dp), 1.0_dp), here)
         width = narrowing*width
         call solve_point(curve, solver, here%t - width, before)
         call solve_point(curve, solver, here%t + width, after)
         if (.not. (before%exists .and. here%exists .and. after%exists)) return
      end do
      if (here%t <= first%t .or. here%t >= last%t .or. sense*(here%load - point%load) < 0.0_dp &
          .or. here%release_range(2) > most_release) return
      point = here
      point%kind = merge(jump_point, pull_off_point, sense > 0.0_dp)
   end subroutine find_extreme

   !> The point of a load between two knots of a wave's curve, by the secant method in a bracket (Illinois).
   subroutine find_crossing(curve, solver, load, first, last, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: load
      type(adhesive_point), intent(in) :: first, last
      type(adhesive_point), intent(out) :: point

      integer, parameter :: most_steps = 30
      real(dp), parameter :: rounding = 1e-13_dp
      real(dp) :: miss(2), t(2), t_new
      integer :: step

      t = [first%t, last%t]
      miss = [first%load, last%load] - load
      do step = 1, most_steps
         t_new = t(2) - miss(2)*(t(2) - t(1))/(miss(2) - miss(1))
         call solve_point(curve, solver, t_new, point)
         if (.not. point%exists .or. abs(t_new - t(2)) <= rounding) return
         if ((point%load - load)*miss(2) <= 0.0_dp) then
            t(1) = t(2)
            miss(1) = miss(2)
         else
            miss(1) = 0.5_dp*miss(1)
         end if
         t(2) = t_new
         miss(2) = point%load - load
         if (abs(miss(2)) <= rounding) return
      end do
   end subroutine find_crossing

end module wavycon_adhesive_curve
