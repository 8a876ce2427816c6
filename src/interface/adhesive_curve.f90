!> The contact with adhesion in the limit of Johnson, Kendall & Roberts, by Ciavarella's superposition: a contact
!> without adhesion at a mean pressure P1, less the field of a rigid punch of the contact's shape under a tension T.
!>
!> The curve is followed by P1, through its turning points. Equations (I..) are those of README.md in this directory.
module wavycon_adhesive_curve
   use wavycon_contact_measures, only: contact_measures, is_known, load_derivatives, scaled_error
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: adhesive_point, adhesive_curve, follow_curve, add_load

   !> Points of the curve, but its ends.
   integer, parameter :: curve_points = 95
   !> Of the parameter t, 0 < t < 1, from one point to the next.
   real(dp), parameter :: t_step = 1.0_dp/(curve_points + 1)

   !> What a point is.
   integer, parameter, public :: unstable_point = 0, stable_point = 1, pull_off_point = 2, jump_point = 3, &
      separated = 4, closed = 5, not_reliable = 6
   character(20), parameter, public :: point_names(0:6) = [character(20) :: 'unstable', 'stable', 'pull_off', &
      'jump_to_full_contact', 'separated', 'full_contact', 'not_reliable']
   !> Extremes this number of points from one whose energy release rate exceeds this part of w are artefacts: there
   !> spots are about to merge, and the superposition fails.
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
   end type adhesive_point

   type :: adhesive_curve
      type(adhesive_point), allocatable :: points(:)     !! by rising P1
      type(adhesive_point), allocatable :: critical(:)   !! extremes of P: pull-off and jumps into full contact
      type(adhesive_point), allocatable :: at_loads(:)   !! the stable and the unstable points of loads asked for
      !> P1 at its ends: of a wave `least` from 0 and from 1, of a ball from `least` to `most` [p*].
      real(dp), private :: least = 0.0_dp, most = 1.0_dp
      real(dp), private :: work = 0.0_dp                 !! w' > 0 [p* Delta]
   end type adhesive_curve

contains

   !> Follows the curve of a wave to P1 = 1, that of a ball as far as the largest load needs it.
   subroutine follow_curve(solver, work, largest_load, curve)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: work           !! w' > 0 [p* Delta]
      real(dp), intent(in) :: largest_load   !! P of the loads that will be asked for [p*]
      type(adhesive_curve), intent(out) :: curve

      real(dp) :: pull
      type(adhesive_point) :: point
      integer :: i

      curve%work = work
      ! Pull-off lies at P1 = (3/(4 pi)) w' or above (I18).
      curve%least = min(2e-3_dp*work, 1e-4_dp)
      if (solver%surface%is_ball()) then
         ! P = P1 - 2 sqrt(pull P1) by (I20), which is least at P1 = pull.
         curve%least = 1.0_dp
         call solve_point(curve, solver, 0.0_dp, point)
         pull = (0.5_dp*(1.0_dp - point%load))**2
         curve%least = 1e-3_dp*pull
         curve%most = (sqrt(pull) + sqrt(pull + max(1.01_dp*largest_load, 4*pull)))**2
      end if
      allocate (curve%points(curve_points))
      do i = 1, curve_points
         call solve_point(curve, solver, i*t_step, point)
         curve%points(i) = point
      end do
      allocate (curve%critical(0), curve%at_loads(0))
      do i = 2, curve_points
         associate (before => curve%points(i - 1), here => curve%points(i), &
                    after => curve%points(min(i + 1, curve_points)))
            if (.not. (before%exists .and. here%exists .and. after%exists)) cycle
            if (after%load > before%load) curve%points(i)%kind = stable_point
            if (i == curve_points .or. (here%load - before%load)*(after%load - here%load) > 0.0_dp) cycle
            point = here
            point%kind = not_reliable
            if (all(curve%points(max(1, i - near):min(i + near, curve_points))%release_range(2) <= most_release)) &
               call find_extreme(curve, solver, i*t_step, point)
            curve%critical = [curve%critical, point]
         end associate
      end do
   end subroutine follow_curve

   !> Adds the points of the curve at a load, by rising P1; where it is not reliable, a point near by. Beyond pull-off
   !> and jump none of them is stable: the bodies are separated, or in full contact.
   subroutine add_load(curve, solver, load, number)
      type(adhesive_curve), intent(inout) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: load    !! P [p*]
      integer, intent(in) :: number   !! of the load

      type(adhesive_point) :: point
      integer :: i
      logical :: has_stable

      has_stable = .false.
      do i = 1, curve_points - 1
         associate (here => curve%points(i), after => curve%points(i + 1))
            if (.not. (here%exists .and. after%exists)) cycle
            if ((here%load - load)*(after%load - load) > 0.0_dp) cycle
            has_stable = has_stable .or. after%load > here%load
            if (max(here%release_range(2), after%release_range(2)) > most_release) then
               point = here
               point%kind = not_reliable
            else
               call find_crossing(curve, solver, load, i, point)
               point%kind = merge(stable_point, unstable_point, after%load > here%load)
            end if
         end associate
         point%number = number
         curve%at_loads = [curve%at_loads, point]
      end do
      if (has_stable) return
      point = adhesive_point(exists=.true., kind=closed, number=number, p1=load, load=load, approach=1.0_dp, &
                             area=1.0_dp)
      associate (of_critical => curve%critical%kind == pull_off_point)
         if (any(of_critical)) then
            if (load < minval(curve%critical%load, of_critical)) &
               point = adhesive_point(exists=.true., kind=separated, number=number, p1=load, load=load)
         end if
      end associate
      curve%at_loads = [curve%at_loads, point]
   end subroutine add_load

   !> The point of a parameter t: (I15) to (I17). Its P1 goes in equal steps of ln(P1/(1 - P1)), of a ball of ln P1.
   subroutine solve_point(curve, solver, t, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: t
      type(adhesive_point), intent(out) :: point

      type(contact_solution) :: solution
      type(load_derivatives) :: slopes
      real(dp) :: p1, tension, tension_error

      if (solver%surface%is_ball()) then
         p1 = curve%least*(curve%most/curve%least)**t
         call solve_ball(solver, p1, solution%measures, slopes)
      else
         p1 = 1.0_dp/(1.0_dp + (1.0_dp/curve%least - 1.0_dp)**(1.0_dp - 2*t))
         call solver%solve(p1, solution)
         if (solution%is_good()) call solution%derivatives(solver%surface, slopes)
      end if
      point%p1 = p1
      point%exists = is_known(slopes%area_slope) .and. is_known(slopes%gap_curvature) &
         .and. min(slopes%area_slope, slopes%gap_curvature) > 0.0_dp
      if (.not. point%exists) return
      tension = sqrt(2*curve%work*slopes%area_slope/slopes%gap_curvature)
      tension_error = scaled_error(slopes%area_slope_error, 0.5_dp*tension/slopes%area_slope) &
                      + scaled_error(slopes%gap_curvature_error, 0.5_dp*tension/slopes%gap_curvature)
      point%load = p1 - tension
      point%load_error = tension_error
      associate (measures => solution%measures)
         point%approach = measures%approach_over_amplitude + slopes%gap_slope*tension
         point%approach_error = measures%mean_gap_error + scaled_error(slopes%gap_slope_error, tension) &
                                + scaled_error(tension_error, -slopes%gap_slope)
         point%area = measures%contact_area_fraction
         point%area_error = measures%contact_area_error
      end associate
      point%release_range = slopes%intensity_range
   end subroutine solve_point

   !> Hertz's contact of a round ball and its derivatives (I19), to rounding.
   subroutine solve_ball(solver, p1, measures, slopes)
      class(contact_solver), intent(in) :: solver
      real(dp), intent(in) :: p1
      type(contact_measures), intent(out) :: measures
      type(load_derivatives), intent(out) :: slopes

      type(hertz_ball) :: contact

      associate (surface => solver%surface)
         ! Over p* and Delta the modulus does not matter.
         contact = hertz_contact(surface%radii(), 1.0_dp, &
                                 force=p1*surface%full_contact_pressure(1.0_dp)*surface%nominal_area())
         measures%approach_over_amplitude = contact%approach/surface%amplitude
         measures%contact_area_fraction = contact%contact_area()/surface%nominal_area()
      end associate
      associate (slope => -2*measures%approach_over_amplitude/(3*p1))
         slopes = load_derivatives(gap_slope=slope, gap_slope_error=0.0_dp, &
                                   area_slope=2*measures%contact_area_fraction/(3*p1), area_slope_error=0.0_dp, &
                                   gap_curvature=-slope/(3*p1), gap_curvature_error=0.0_dp, intensity_range=1.0_dp)
      end associate
   end subroutine solve_ball

   !> An extreme of P next to a point, by parabolas through three points that come closer.
   subroutine find_extreme(curve, solver, t, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: t
      type(adhesive_point), intent(inout) :: point   !! at t, then at the extreme

      integer, parameter :: steps = 5
      real(dp), parameter :: narrowing = 0.2_dp
      type(adhesive_point) :: after, before
      real(dp) :: bend, here, width
      integer :: i, kind

      here = t
      width = t_step
      kind = unstable_point
      do i = 1, steps
         call solve_point(curve, solver, here - width, before)
         call solve_point(curve, solver, here + width, after)
         if (.not. (before%exists .and. after%exists)) exit
         bend = before%load - 2*point%load + after%load
         kind = merge(pull_off_point, jump_point, bend > 0.0_dp)
         if (.not. abs(bend) > 0.0_dp) exit
         here = here + width*min(max(0.5_dp*(before%load - after%load)/bend, -1.0_dp), 1.0_dp)
         call solve_point(curve, solver, here, point)
         width = narrowing*width
      end do
      point%kind = kind
   end subroutine find_extreme

   !> The point of a load between two points of the curve, by the secant method in a bracket (Illinois).
   subroutine find_crossing(curve, solver, load, i, point)
      type(adhesive_curve), intent(in) :: curve
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: load
      integer, intent(in) :: i                      !! of the first point
      type(adhesive_point), intent(out) :: point

      integer, parameter :: most_steps = 30
      real(dp), parameter :: rounding = 1e-13_dp
      real(dp) :: miss(2), t(2), t_new
      integer :: step

      t = t_step*[i, i + 1]
      miss = [curve%points(i)%load, curve%points(i + 1)%load] - load
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
