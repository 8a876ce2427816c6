!> Solves the contact of a wave on a lattice to a given accuracy, by collocation fitted to the edge of contact.
module wavycon_fitted_solver
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_degree_history, only: degree_history, error_estimate
   use wavycon_fitted_answer, only: fitted_answer, fitted_bad_input, fitted_failed, fitted_less_exact, fitted_merged, &
      fitted_solved, most_previous
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_measures, only: all_measures, area_measure, centre_measure, energy_measure, gap_measure, &
      load_measure, measure_fitted_function, peak_measure, perimeter_measure
   use wavycon_fitted_size, only: merging_ratio, next_clustering, next_degree, shape_terms
   use wavycon_fitted_tuning, only: degree_step, first_degree, last_degree, round_shape_ratio, series_growth
   use wavycon_gauss_newton, only: least_squares_step, newton_steps
   use wavycon_kinds, only: dp, ieee_is_finite
   use wavycon_load_continuation, only: find_start, is_start
   use wavycon_quantities, only: approach, contact_area, elastic_energy, mean_gap, peak_pressure, perimeter, &
      polynomial_degree, unknown
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: solve_adhesive, solve_fitted

   !> Guard: the number of successive degrees without convergence of Newton's method after which spots, or pools, are
   !> given up. Next to merging and beyond Newton's method may fail at every degree, and the highest degrees take
   !> seconds each.
   integer, parameter :: most_failed_degrees = 3

   !> The quantities of an answer, and the measures that they follow from.
   integer, parameter :: measured(*) = [mean_gap, contact_area, peak_pressure, elastic_energy, perimeter]
   integer, parameter :: shown_measures(*) = [gap_measure, area_measure, peak_measure, energy_measure, &
      perimeter_measure]

contains

   !> Solves for one load, as separate spots or as separate pools. If the more likely one of the two fails, the other
   !> one is tried.
   !>
   !> The accuracy is relative to the mean gap, to the area of the spot or of the pool, and to the peak pressure. The
   !> degree of the fitted function is raised until the estimated errors of all three are within the accuracy.
   !>
   !> Status: fitted_solved, fitted_less_exact, fitted_merged, fitted_bad_input or fitted_failed.
   subroutine solve_fitted(lattice, pbar_over_pstar, accuracy, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: pbar_over_pstar        !! mean pressure P, between 0 and the lattice's closing pressure
      real(dp), intent(in) :: accuracy               !! largest allowed relative error, > 0; rounding is about 1e-14
      type(fitted_answer), intent(out) :: answer
      type(fitted_answer), intent(in), optional :: start
         !! solution of another load of the same lattice, which saves time if that load is near; not the variable
         !! `answer`
      logical, intent(in), optional :: fields
         !! whether the error of a pool's gap at its trough has to be within the accuracy times Delta, because fields
         !! need this; false if absent

      type(fitted_function) :: goal

      answer%pbar_over_pstar = pbar_over_pstar
      answer%status = fitted_bad_input
      if (.not. (pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < lattice%closing_pressure)) return
      if (.not. accuracy > 0.0_dp) return
      goal%load = pbar_over_pstar
      goal%pool = pbar_over_pstar > lattice%about_merging
      if (present(start)) then
         ! If pools are separate at a lighter load they are separate at this load. If spots are separate at a heavier
         ! load they are separate at this one.
         if (start%status <= fitted_less_exact .and. &
             (start%pool .eqv. pbar_over_pstar >= start%pbar_over_pstar)) goal%pool = start%pool
      end if
      call solve_regime(lattice, goal, accuracy, accuracy, answer, start, fields)
      ! A start with sharp tips may not lead to a much rounder shape.
      if (answer%status >= fitted_merged .and. present(start)) then
         if (is_start(lattice, start, goal)) call solve_regime(lattice, goal, accuracy, accuracy, answer, fields=fields)
      end if
      if (answer%status < fitted_merged) return
      goal%pool = .not. goal%pool
      call solve_regime(lattice, goal, accuracy, accuracy, answer, start, fields)
   end subroutine solve_fitted

   !> Solves for a spot or for a pool, at rising degrees, until the estimated errors are within the accuracy. The answer
   !> is the solution with the least estimated errors.
   subroutine solve_regime(lattice, goal, accuracy, finest, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: goal            !! as of find_start
      real(dp), intent(in) :: accuracy                     !! largest allowed relative error
      real(dp), intent(in) :: finest                       !! as of solve_adhesive; without adhesion the accuracy
      type(fitted_answer), intent(inout) :: answer         !! on entry without a solution
      type(fitted_answer), intent(in), optional :: start   !! as of solve_fitted
      logical, intent(in), optional :: fields              !! as of solve_fitted

      type(contact_equations) :: equations
      type(degree_history) :: history
      type(fitted_function) :: now
      type(newton_steps) :: newton
      real(dp) :: clustering, measures(all_measures), ratio, reference(all_measures), scale(all_measures), tolerance
      !> With adhesion, at the newest degrees: the derivatives by the area of load, approach and b_0, the last step's
      !> change of the shape, and the decay of the slopes' errors, the newest first: README.md (F70), (F70a).
      real(dp) :: slopes(3, 0:most_previous), changes(2), decay(2)
      integer :: degree, failed, start_degree
      logical :: adhesive, merged, valid

      now = goal
      adhesive = goal%work > 0.0_dp
      answer%pool = goal%pool
      answer%status = fitted_failed
      answer%iterations = 0
      history%required = load_measure
      if (present(fields)) history%required = merge(centre_measure, load_measure, fields .and. goal%pool)
      slopes = 0.0_dp
      changes = 0.0_dp
      decay = 1.0_dp
      call find_start(lattice, now, degree, answer%iterations, valid, merged, start)
      if (merged) answer%status = fitted_merged
      if (.not. valid) return
      ! Relative tolerance of the shape. A smaller one would be rounding. A larger one would show in the differences
      ! between degrees. Most solutions of a curve with adhesion are to a low accuracy: what Newton's method leaves is
      ! part of their told errors.
      tolerance = min(max(0.1_dp*accuracy, 1e-13_dp), merge(1e-5_dp, 1e-7_dp, adhesive))
      ! Next to merging the tips of low degrees are up to 3 % too long. Until the degree of the start is reached its
      ! merging ratio is the better one: otherwise the clustering would be wrong, and the shape might seem merged.
      start_degree = merge(now%basis%degree, 0, adhesive)
      ratio = merging_ratio(lattice, now)
      ! For round shapes a lower first degree gives the error estimates one more difference. It cannot represent sharp
      ! tips.
      if (degree == first_degree .and. ratio < round_shape_ratio) degree = first_degree - degree_step/2
      failed = 0
      ! Next to merging convergence is slower than quadratic. A second step at the first degree measures its rate.
      newton%contraction = merge(1.0_dp, 0.0_dp, ratio > 0.7_dp)
      do
         clustering = now%shape%clustering
         if (lattice%square) clustering = next_clustering(clustering, ratio, now%pool)
         now = now%resized(degree, shape_terms(degree, now%basis%fold, ratio), clustering)
         ! A larger tolerance of the series would hardly save time.
         call equations%images%prepare(lattice, now, series_growth, 1e-2_dp*min(accuracy, 1e-4_dp))
         if (degree >= start_degree) ratio = merging_ratio(lattice, now)
         call start_equations(equations, now, ratio)
         call newton%solve(equations, lattice, now, tolerance)
         if (degree >= start_degree) ratio = merging_ratio(lattice, now)
         merged = ratio >= 1.0_dp
         if (.not. newton%valid .or. merged) exit
         ! Without convergence at this degree there is nothing to compare, but the next degree may converge.
         failed = failed + 1
         if (newton%change <= 1e-4_dp .or. newton%remaining <= tolerance) then
            failed = 0
            call measure_fitted_function(equations, lattice, now, measures, reference, scale)
            if (.not. all(reference(:load_measure) > 0.0_dp)) exit
            call history%push(now, measures, reference, newton%misfit, newton%remaining)
            if (adhesive) then
               slopes(:, 1:) = slopes(:, :most_previous - 1)
               changes(2) = changes(1)
               decay(2) = decay(1)
               call find_slopes(newton%change)
            end if
            if (history%newest_is_best) call set_answer()
            if (history%best_meets(accuracy*scale)) then
               answer%status = fitted_solved
               ! A slope of unsure sign is of little use. At the solution itself it takes one more linearisation,
               ! which is done where the error falls to less than half.
               if (adhesive .and. history%newest_is_best .and. decay(1) > 2*history%decay(1) .and. &
                   .not. all(abs(answer%area_slopes) > answer%area_slope_errors)) then
                  call equations%linearise(lattice, now)
                  ! The map may fold at the edge: there is no next step then.
                  if (.not. all(ieee_is_finite(equations%residual))) exit
                  call find_slopes(0.0_dp)
               end if
               if (history%best_meets(finest*scale)) exit
               if (abs(answer%area_slopes(2)) > answer%area_slope_errors(2)) exit
               tolerance = max(0.1_dp*finest, 1e-13_dp)
            end if
         end if
         if (degree >= last_degree .or. failed == merge(1, most_failed_degrees, adhesive)) exit
         degree = next_degree(degree, now%basis%fold, ratio)
      end do
      answer%iterations = answer%iterations + newton%iterations
      ! On the square lattice a solution of a lower degree, which is nearly right, is kept if a higher degree has
      ! merged.
      if (merged .and. answer%status /= fitted_solved .and. &
          (answer%status == fitted_failed .or. .not. lattice%square)) answer%status = fitted_merged

   contains

      !> Sets the answer to the newest solution, which is the best one so far.
      subroutine set_answer()
         real(dp) :: error(all_measures)

         answer%status = fitted_less_exact
         answer%solution = now
         answer%residual = newton%residual
         answer%merging_ratio = merging_ratio(lattice, now)
         ! All degrees have the same error of the images. So this error is not considered in the choice of the best
         ! degree, and is added only here.
         error = max(history%error, equations%images%tolerance*reference)
         answer%pbar_over_pstar = measures(load_measure)
         answer%load_error = error(load_measure)
         answer%value(measured) = measures(shown_measures)
         answer%error(measured) = error(shown_measures)
         answer%value(approach) = 1.0_dp - answer%value(mean_gap)
         answer%value(polynomial_degree) = now%basis%degree
         associate (area => answer%value(contact_area), area_error => answer%error(contact_area))
            area = area/lattice%area
            area_error = area_error/lattice%area
            if (now%pool) then
               area = 1.0_dp - lattice%troughs*area
               area_error = lattice%troughs*area_error
            end if
         end associate
         answer%misfit_decay = history%decay
         answer%previous = history%newest(1:min(history%solutions - 1, most_previous))
      end subroutine set_answer

      !> Sets the newest slopes from the equations as they are linearised, README.md (F70), and those of the answer if
      !> the newest solution is the best one.
      subroutine find_slopes(change)
         real(dp), intent(in) :: change   !! last step's change of the shape

         logical :: finite   ! not used: the last step was finite
         real(dp) :: misfit, of_all(equations%unknowns)

         call least_squares_step(equations, now, 0*equations%residual, 1.0_dp, of_all, misfit, finite)
         associate (of_integral => dot_product(equations%load_row, of_all)/lattice%area, &
                    of_unknown => of_all(now%basis%terms + 1))
            slopes(:, 0) = [of_integral, of_unknown, of_all(equations%before_shape + 1)]
            if (now%pool) slopes(:2, 0) = [of_unknown, -lattice%troughs*of_integral]
         end associate
         changes(1) = change
         decay(1) = max(history%decay(1), min(change/max(changes(2), tiny(change)), 1.0_dp))
         if (.not. history%newest_is_best) return
         answer%area_change = of_all
         answer%area_slopes = slopes(:2, 0)
         answer%area_slope_errors = slope_errors(slopes(:, :min(history%solutions - 1, most_previous)), decay, &
                                                 [lattice%closing_pressure, 1.0_dp]/lattice%area)
      end subroutine find_slopes

   end subroutine solve_regime

   !> Estimates of the errors of the slopes of load and approach: README.md (F70a), (F70b). Unknown if there is none.
   pure function slope_errors(slopes, decay, reference) result(errors)
      real(dp), intent(in) :: slopes(:, 0:)   !! those of load, approach and b_0 at 2 or 3 degrees, shape (3, 0:.)
      real(dp), intent(in) :: decay(2)        !! (F70a) of the last two degrees
      real(dp), intent(in) :: reference(2)    !! what errors of load and approach are relative to, > 0
      real(dp) :: errors(2)

      !> Distance of the area from its largest value, up to a factor, and its relative error.
      real(dp) :: distance(1, 0:ubound(slopes, 2)), part(1)

      errors = error_estimate(slopes(:2, :), decay, reference)
      distance(1, :) = 1.0_dp/max(slopes(3, :)**2, tiny(slopes))
      part = error_estimate(distance, decay, distance(:, 0))/distance(:, 0)
      if (part(1) < 1.0_dp) then
         errors = 2*errors/(1.0_dp - part(1) + sqrt(1.0_dp - part(1)))
      else
         errors = unknown
      end if
   end function slope_errors

   !> Solves the contact with adhesion of a spot or a pool of a given area. The load is part of the solution.
   !>
   !> The accuracy is relative to Delta for the mean gap, and to the closing pressure for the load and, if this is not
   !> larger, for the peak pressure. Near merging the gap is a tenth of Delta: errors relative to the gap would take
   !> higher degrees for digits that a curve does not show. Status: fitted_solved, fitted_less_exact, fitted_merged if
   !> the shape touches its neighbours, or fitted_failed.
   subroutine solve_adhesive(lattice, pool, work, area, accuracy, answer, start, finest)
      type(wave_lattice), intent(in) :: lattice
      logical, intent(in) :: pool            !! true: an open pool; false: a contact spot
      real(dp), intent(in) :: work           !! work of adhesion W > 0 [pi E* Delta^2/s]
      real(dp), intent(in) :: area           !! area of the spot or pool, between 0 and that of its cell [s^2]
      real(dp), intent(in) :: accuracy       !! largest allowed error over these scales, > 0
      type(fitted_answer), intent(out) :: answer
      type(fitted_answer), intent(in), optional :: start
         !! solution of another area of the same lattice and work, which saves time; not the variable `answer`
      real(dp), intent(in), optional :: finest
         !! accuracy to which the degree is raised further while the sign of the approach's slope is not sure,
         !! 0 < finest <= accuracy; the accuracy if absent

      type(fitted_function) :: goal
      real(dp) :: least

      goal%pool = pool
      goal%work = work
      goal%area = area
      least = accuracy
      if (present(finest)) least = finest
      call solve_regime(lattice, goal, accuracy, least, answer, start)
   end subroutine solve_adhesive

end module wavycon_fitted_solver
