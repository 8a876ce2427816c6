!> The contact of a wave on its lattice by collocation fitted to the edge, to a given accuracy.
module wavycon_fitted_solver
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_degree_history, only: degree_history
   use wavycon_expansion, only: expansion
   use wavycon_expansion_size, only: merging_ratio, next_clustering, next_degree, shape_terms
   use wavycon_fitted_answer, only: fitted_answer, fitted_bad_input, fitted_failed, fitted_less_exact, fitted_merged, &
      fitted_solved, most_previous
   use wavycon_fitted_measures, only: all_measures, area_measure, centre_measure, energy_measure, gap_measure, &
      load_measure, measure_expansion, peak_measure, perimeter_measure
   use wavycon_fitted_tuning, only: degree_step, error_safety, first_degree, last_degree, previous_difference_share, &
      round_shape_ratio, series_growth
   use wavycon_gauss_newton, only: change_with_area, newton_steps
   use wavycon_kinds, only: dp
   use wavycon_load_continuation, only: is_start, start_at_area, start_at_load
   use wavycon_quantities, only: approach, contact_area, elastic_energy, mean_gap, peak_pressure, perimeter, &
      polynomial_degree
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: solve_adhesive, solve_fitted

   !> Guard: degrees in a row at which Newton's method does not converge, before the regime is
   !> given up. Next to merging, and beyond it, it may fail at every degree, and the last ones take seconds each.
   integer, parameter :: most_failed_degrees = 3

   !> The quantities of an answer, and the measures that they are from.
   integer, parameter :: measured(*) = [mean_gap, contact_area, peak_pressure, elastic_energy, perimeter]
   integer, parameter :: shown_measures(*) = [gap_measure, area_measure, peak_measure, energy_measure, &
      perimeter_measure]

contains

   !> Solves for one load.
   !>
   !> The accuracy is relative: to the mean gap, to the area fraction or, above merging, the open one, and to the peak
   !> pressure. The degree of the expansion is raised until the estimated errors of all three are within it.
   !>
   !> Status: fitted_solved, fitted_less_exact, fitted_merged, fitted_bad_input or fitted_failed.
   subroutine solve_fitted(lattice, pbar_over_pstar, accuracy, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: pbar_over_pstar        !! P, between 0 and the lattice's closing pressure
      real(dp), intent(in) :: accuracy               !! of each measure over itself, > 0; rounding allows some 1e-14
      type(fitted_answer), intent(out) :: answer
      type(fitted_answer), intent(in), optional :: start
         !! of another load of the same lattice, not the same variable as `answer`; saves time where the load is near
      logical, intent(in), optional :: fields
         !! whether a pool's gap at its trough is to be as accurate, as fields need it; false if absent

      logical :: first_is_pool

      answer%pbar_over_pstar = pbar_over_pstar
      answer%status = fitted_bad_input
      if (.not. (pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < lattice%closing_pressure)) return
      if (.not. accuracy > 0.0_dp) return
      first_is_pool = pbar_over_pstar > lattice%about_merging
      if (present(start)) then
         ! Spots that have merged at a lighter load have merged at this one; pools apart at a heavier one are apart.
         if (start%status <= fitted_less_exact .and. &
             (start%pool .eqv. pbar_over_pstar >= start%pbar_over_pstar)) first_is_pool = start%pool
      end if
      call solve_regime(lattice, accuracy, first_is_pool, answer, start, fields)
      ! A start with sharp tips may not lead to a much rounder shape.
      if (answer%status >= fitted_merged .and. present(start)) then
         if (is_start(lattice, start, pbar_over_pstar, first_is_pool)) &
            call solve_regime(lattice, accuracy, first_is_pool, answer, fields=fields)
      end if
      if (answer%status >= fitted_merged) &
         call solve_regime(lattice, accuracy, .not. first_is_pool, answer, start, fields)
   end subroutine solve_fitted

   !> Solves as a spot or as a pool, by degrees.
   subroutine solve_regime(lattice, accuracy, pool, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: accuracy
      logical, intent(in) :: pool
      type(fitted_answer), intent(inout) :: answer   !! its load is set
      type(fitted_answer), intent(in), optional :: start
      logical, intent(in), optional :: fields

      type(expansion) :: now
      integer :: degree, required
      logical :: merged, valid

      answer%pool = pool
      answer%status = fitted_failed
      answer%iterations = 0
      required = load_measure
      if (present(fields)) required = merge(centre_measure, load_measure, fields .and. pool)
      call start_at_load(lattice, answer%pbar_over_pstar, pool, now, degree, answer%iterations, valid, merged, start)
      if (merged) answer%status = fitted_merged
      if (valid) call raise_degree(lattice, accuracy, now, degree, required, answer)
   end subroutine solve_regime

   !> Solves with adhesion for a spot or a pool of a given area: the load is found.
   !>
   !> The accuracy is relative to the mean gap, to the peak pressure, and to the load with its tension along the edge:
   !> loads vanish on the way to tensions. Status: fitted_solved, fitted_less_exact, fitted_merged, where the shape
   !> touches its neighbours, or fitted_failed.
   subroutine solve_adhesive(lattice, pool, work, area, accuracy, answer, start)
      type(wave_lattice), intent(in) :: lattice
      logical, intent(in) :: pool            !! whether it is the open pool; otherwise the contact spot
      real(dp), intent(in) :: work           !! W > 0, the work of adhesion [pi E* Delta^2/s]
      real(dp), intent(in) :: area           !! of the spot or pool, between 0 and that of its cell [s^2]
      real(dp), intent(in) :: accuracy       !! > 0
      type(fitted_answer), intent(out) :: answer
      type(fitted_answer), intent(in), optional :: start
         !! of another area of the same lattice and work, not the same variable as `answer`; saves time

      type(expansion) :: now
      integer :: degree
      logical :: valid

      answer%pool = pool
      call start_at_area(lattice, pool, work, area, now, degree, answer%iterations, valid, start)
      if (valid) call raise_degree(lattice, accuracy, now, degree, load_measure, answer)
   end subroutine solve_adhesive

   !> Raises the degree from an approximation on until the estimated errors are within the accuracy.
   subroutine raise_degree(lattice, accuracy, now, first, required, answer)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: accuracy
      type(expansion), intent(inout) :: now          !! the approximation
      integer, intent(in) :: first                   !! degree to start with
      integer, intent(in) :: required                !! measures, in their order, that have to be as accurate
      type(fitted_answer), intent(inout) :: answer   !! failed so far

      type(contact_equations) :: equations
      type(degree_history) :: history
      type(newton_steps) :: newton
      real(dp), allocatable :: area_change(:)
      real(dp) :: area_slopes(2, 0:2)   ! of the newest solution and those before it
      real(dp) :: clustering, measures(all_measures), ratio, scale(all_measures), tolerance
      integer :: degree, failed, k
      logical :: merged

      degree = first
      ! Tolerance of the shape: a smaller one is rounding, a larger one shows in the differences between degrees.
      tolerance = min(max(0.1_dp*accuracy, 1e-13_dp), 1e-7_dp)
      ratio = merging_ratio(lattice, now)
      ! A lower degree gives the estimates of round shapes one more difference; it cannot represent sharp ones.
      if (degree == first_degree .and. ratio < round_shape_ratio) degree = first_degree - degree_step/2
      failed = 0
      area_slopes = 0.0_dp
      allocate (area_change(0))
      ! Next to merging convergence is less than quadratic: a second step at the first degree measures it.
      newton%contraction = merge(1.0_dp, 0.0_dp, ratio > 0.7_dp)
      do
         clustering = now%shape%clustering
         if (lattice%square) clustering = next_clustering(clustering, ratio, now%pool)
         now = now%resized(degree, shape_terms(degree, now%basis%fold, ratio), clustering)
         ! Looser series are hardly quicker.
         call equations%images%prepare(lattice, now, series_growth, 1e-2_dp*min(accuracy, 1e-4_dp))
         ratio = merging_ratio(lattice, now)
         call start_equations(equations, now, ratio)
         call newton%solve(equations, lattice, now, tolerance)
         ratio = merging_ratio(lattice, now)
         merged = ratio >= 1.0_dp
         if (.not. newton%valid .or. merged) exit
         ! Without convergence there is nothing to compare, but the next degree may converge.
         failed = failed + 1
         if (newton%change <= 1e-4_dp .or. newton%remaining <= tolerance) then
            failed = 0
            call measure_expansion(equations, lattice, now, measures, scale)
            if (.not. all(scale(:load_measure) > 0.0_dp)) exit
            if (now%work > 0.0_dp) then
               area_slopes(:, 1:) = area_slopes(:, :1)
               area_change = [(0.0_dp, k=1, equations%unknowns)]
               call change_with_area(equations, now, area_change)
               area_slopes(:, 0) = slopes_of(equations, lattice, now, area_change)
            end if
            call history%push(now, measures, scale, newton%misfit, newton%remaining)
            if (history%newest_is_best) then
               call set_answer(answer, lattice, history, now, newton%residual, ratio, equations%images%tolerance)
               answer%area_slopes = area_slopes(:, 0)
               answer%area_slope_errors = error_safety*max(abs(area_slopes(:, 0) - area_slopes(:, 1)), &
                  previous_difference_share*abs(area_slopes(:, 1) - area_slopes(:, 2)))
               answer%area_change = area_change
            end if
            if (history%best_meets(accuracy, required)) then
               answer%status = fitted_solved
               exit
            end if
         end if
         if (degree >= last_degree .or. failed == merge(1, most_failed_degrees, now%work > 0.0_dp)) exit
         degree = next_degree(degree, now%basis%fold, ratio)
      end do
      answer%iterations = answer%iterations + newton%iterations
      ! On the square lattice a solution of a lower degree is kept although a higher one has merged: it is nearly right.
      if (merged .and. (answer%status == fitted_failed .or. .not. lattice%square)) answer%status = fitted_merged
   end subroutine raise_degree

   !> The derivatives of load and approach with respect to the area from those of all unknowns, README.md (F70).
   pure function slopes_of(equations, lattice, now, area_change) result(slopes)
      type(contact_equations), intent(in) :: equations         !! of the solution
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now                       !! the solution, with adhesion
      real(dp), intent(in) :: area_change(:)                   !! shape (unknowns)
      real(dp) :: slopes(2)

      associate (of_integral => dot_product(equations%load_row, area_change)/lattice%area, &
                 of_unknown => area_change(now%basis%terms + 1))
         slopes = [of_integral, of_unknown]
         if (now%pool) slopes = [of_unknown, -lattice%troughs*of_integral]
      end associate
   end function slopes_of

   !> Writes the newest solution to the answer.
   subroutine set_answer(answer, lattice, history, now, residual, ratio, images_tolerance)
      type(fitted_answer), intent(inout) :: answer
      type(wave_lattice), intent(in) :: lattice
      type(degree_history), intent(in) :: history
      type(expansion), intent(in) :: now
      real(dp), intent(in) :: residual, ratio
      real(dp), intent(in) :: images_tolerance     !! relative error of the images

      real(dp) :: error(all_measures)

      answer%status = fitted_less_exact
      answer%solution = now
      answer%residual = residual
      answer%merging_ratio = ratio
      ! All degrees share the error of the images: it does not count in which of them is best.
      error = max(history%error, images_tolerance*history%scale)
      answer%pbar_over_pstar = history%measures(load_measure, 0)
      answer%load_error = error(load_measure)
      answer%value(measured) = history%measures(shown_measures, 0)
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

end module wavycon_fitted_solver
