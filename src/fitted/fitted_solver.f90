!> The contact of a wave on its lattice by boundary-fitted expansions, to an accuracy asked for.
module wavycon_fitted_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_constants, only: pi
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_error_estimate, only: error_estimate
   use wavycon_expansion, only: expansion
   use wavycon_fitted_answer, only: expansions_before, fitted_answer, fitted_bad_input, fitted_failed, &
      fitted_less_exact, fitted_merged, fitted_solved, fitted_status_text
   use wavycon_fitted_fields, only: fitted_fields, fitted_separations, start_fitted_fields
   use wavycon_gauss_newton, only: gauss_newton_step
   use wavycon_image_series, only: image_series, start_image_series
   use wavycon_island_pressure, only: crest_pressure
   use wavycon_kinds, only: dp
   use wavycon_fitted_tuning, only: change_per_root_accuracy, degree_per_shape_term, degree_per_shape_term_twofold, &
      degree_step, error_of_square, finest_change, finest_change_ratio, first_degree, full_shape_degree, &
      full_step_degree, full_step_degree_round, heavy_load_start, island_clustering, island_clustering_power, &
      largest_change, last_degree, least_clustering, least_clustering_change, light_load_start, load_step_ratio, &
      longest_clustering_step, loosest_change, loosest_series_accuracy, most_newton_steps, restart_degree_steps, &
      round_shape_ratio, series_error_of_accuracy, series_growth, spot_clustering, spot_clustering_power, &
      start_series_growth, start_shape_change
   use wavycon_start_expansion, only: crack_island, hertz_spot, scaled_to_load
   use wavycon_wave_lattice, only: hexagonal_lattice, rectangular_lattice, rhombic_lattice, square_lattice, &
      wave_lattice
   implicit none (type, external)
   private

   public :: solve_fitted
   public :: fitted_answer, fitted_status_text
   public :: fitted_fields, start_fitted_fields, fitted_separations
   public :: fitted_solved, fitted_less_exact, fitted_merged, fitted_bad_input, fitted_failed
   public :: wave_lattice, square_lattice, rectangular_lattice, rhombic_lattice, hexagonal_lattice

   !> The three numbers that the accuracy is of: mean gap, area fraction, peak pressure. An island's gap at its
   !> trough follows, which converges as fields do, later than integrals of them; then energy and perimeter,
   !> whose errors are estimated as well.
   integer, parameter :: measures = 3, all_measures = 6

contains

   !> Solves for one load.
   !>
   !> The accuracy is relative: to the mean gap, to the area fraction or, above merging, the open one, to the
   !> peak pressure. The degree of the expansion is raised until the differences of two degrees meet it.
   subroutine solve_fitted(lattice, pbar_over_pstar, accuracy, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: pbar_over_pstar        !! P, between 0 and the lattice's closing pressure
      real(dp), intent(in) :: accuracy               !! > 0; what rounding allows is 1e-14 or so
      type(fitted_answer), intent(out) :: answer
      type(fitted_answer), intent(in), optional :: start
         !! of another load of the same lattice, not the same variable as `answer`; of use where it is near
      logical, intent(in), optional :: fields
         !! whether an island's gap at its trough is to be as accurate, for the sake of fields; not if absent

      logical :: first_is_island

      answer%pbar_over_pstar = pbar_over_pstar
      answer%status = fitted_bad_input
      if (ieee_is_nan(pbar_over_pstar) .or. ieee_is_nan(accuracy)) return
      if (.not. (pbar_over_pstar > 0.0_dp .and. pbar_over_pstar < lattice%closing_pressure .and. accuracy > 0.0_dp)) return
      first_is_island = pbar_over_pstar > lattice%about_merging
      if (present(start)) then
         ! What is merged at a lighter load, or apart at a heavier one, is so at this one.
         if (start%status <= fitted_less_exact .and. &
             (start%island .eqv. pbar_over_pstar >= start%pbar_over_pstar)) first_is_island = start%island
      end if
      call solve_regime(lattice, accuracy, first_is_island, answer, start, fields)
      ! A sharp shape is no start for a rounder one that is not near.
      if (answer%status >= fitted_merged .and. present(start)) &
         call solve_regime(lattice, accuracy, first_is_island, answer, fields=fields)
      if (answer%status >= fitted_merged) &
         call solve_regime(lattice, accuracy, .not. first_is_island, answer, start, fields)
   end subroutine solve_fitted

   !> Solves as a spot or as an island.
   subroutine solve_regime(lattice, accuracy, island, answer, start, fields)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: accuracy
      logical, intent(in) :: island
      type(fitted_answer), intent(inout) :: answer   !! its load is set
      type(fitted_answer), intent(in), optional :: start
      logical, intent(in), optional :: fields

      type(contact_equations) :: equations
      type(expansion) :: now, past(expansions_before)
      type(image_series) :: images
      real(dp), dimension(all_measures) :: best, decay, error, last, last_difference, new
      real(dp) :: change, residual, tolerance
      integer :: asked, compared, degree, iterations
      logical :: better, merged, ok, trusted

      answer%island = island
      answer%status = fitted_failed
      iterations = 0
      asked = measures
      if (present(fields)) asked = merge(measures + 1, measures, fields .and. island)
      ! A step of this size leaves about its square; close to merging more.
      tolerance = min(max(change_per_root_accuracy*sqrt(accuracy), finest_change), loosest_change)
      call begin(lattice, answer, now, degree, iterations, ok, start)
      if (.not. ok) return
      merged = .false.
      ! A lower degree gives the estimates one more difference; it does not know sharper shapes.
      if (degree == first_degree .and. reach(lattice, now) < round_shape_ratio) &
         degree = first_degree - degree_step/2
      last = huge(last)
      last_difference = huge(last)
      decay = 1.0_dp
      trusted = .false.
      compared = 0
      do
         now = now%raised(degree, shape_terms(degree, now%basis%fold, reach(lattice, now)), crowding(lattice, now))
         call cover(images, lattice, now, series_growth, &
                    series_error_of_accuracy*min(accuracy, loosest_series_accuracy))
         call start_equations(equations, now, reach(lattice, now), images)
         if (reach(lattice, now) > finest_change_ratio) tolerance = finest_change
         call converge(equations, lattice, answer%pbar_over_pstar, now, tolerance, &
                       change, residual, iterations, ok)
         merged = reach(lattice, now) >= 1.0_dp
         if (.not. ok .or. merged) exit
         ! Without convergence the next degree may do better; there is nothing to compare.
         if (change <= largest_change) then
            call judge()
            if (.not. ok .or. answer%status == fitted_solved) exit
         end if
         if (degree >= last_degree) exit
         degree = next_degree(degree, now%basis%fold, reach(lattice, now))
      end do
      answer%iterations = iterations
      ! What a lower degree gave is of the square alone nearly right: there islands are as near.
      if (merged .and. (answer%status == fitted_failed .or. .not. lattice%square)) answer%status = fitted_merged

   contains

      !> Compares with the degree before.
      subroutine judge()
         new = [mean_gap(equations, lattice, now), now%shape%area(), &
                peak_pressure(equations, lattice, answer%pbar_over_pstar, now), now%at_centre(), &
                energy(equations, lattice, answer%pbar_over_pstar, now), now%shape%perimeter()]
         ok = all(new(:measures) > 0.0_dp)
         if (.not. ok) return
         if (last(1) < huge(last)) then
            associate (difference => abs(new - last), m => measures)
               call error_estimate(difference(:m), last_difference(:m), decay(:m), new(:m), error(:m))
               call error_estimate(difference(m + 1:m + 1), last_difference(m + 1:m + 1), decay(m + 1:m + 1), &
                                   new(m + 1:m + 1), error(m + 1:m + 1))
               call error_estimate(difference(m + 2:), last_difference(m + 2:), decay(m + 2:), new(m + 2:), &
                                   error(m + 2:))
            end associate
            error = max(error, error_of_square*change**2*new)
            ! Close to merging a higher degree may be worse.
            better = answer%status == fitted_failed .or. .not. trusted
            if (.not. better) better = sum(error(:measures)/new(:measures)) &
               < sum(best(:measures)/new(:measures))
            ! One difference may be small by chance.
            trusted = trusted .or. last_difference(1) < huge(last)
            if (better) call take_over()
            if (trusted .and. all(best(:asked) <= accuracy*new(:asked))) answer%status = fitted_solved
            decay = 1.0_dp
            if (reach(lattice, now) < round_shape_ratio) &
               decay = min(abs(new - last)/max(last_difference, tiny(new)), 1.0_dp)
            last_difference = abs(new - last)
         end if
         last = new
         past(3) = past(2)
         past(2) = past(1)
         past(1) = now
         compared = min(compared + 1, expansions_before)
      end subroutine judge

      subroutine take_over()
         answer%status = fitted_less_exact
         answer%solution = now
         answer%degree = degree
         answer%residual = residual
         answer%reach = reach(lattice, now)
         answer%mean_gap = new(1)
         answer%area_fraction = new(2)/lattice%area
         if (island) answer%area_fraction = 1.0_dp - lattice%troughs*answer%area_fraction
         answer%peak_pressure = new(3)
         best = error
         ! The series' own is the same at all degrees, none is better for it.
         error = max(error, images%tolerance*new)
         answer%mean_gap_error = error(1)
         answer%area_error = error(2)/lattice%area*merge(lattice%troughs, 1, island)
         answer%peak_error = error(3)
         answer%energy = new(5)
         answer%perimeter = new(6)
         answer%energy_error = error(5)
         answer%perimeter_error = error(6)
         answer%before = past(:compared)
      end subroutine take_over

   end subroutine solve_regime

   !> An expansion of low degree at the load asked for.
   subroutine begin(lattice, answer, now, degree, iterations, ok, start)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: answer      !! load and regime
      type(expansion), intent(out) :: now
      integer, intent(out) :: degree                 !! to go on with
      integer, intent(inout) :: iterations
      logical, intent(out) :: ok
      type(fitted_answer), intent(in), optional :: start

      type(contact_equations) :: equations
      type(image_series) :: images
      real(dp) :: change, load, next, residual, target

      target = answer%pbar_over_pstar
      degree = first_degree
      load = target
      if (present(start)) then
         if (start%status <= fitted_less_exact .and. (start%island .eqv. answer%island)) then
            load = start%pbar_over_pstar
            if (steps_between(lattice, load, target, answer%island) <= 1) then
               now = scaled_to_load(lattice, start%solution, load, target)
               degree = max(first_degree, start%degree - restart_degree_steps*degree_step)
               ok = .true.
               return
            end if
         end if
      end if
      if (answer%island) then
         load = max(target, heavy_load_start*lattice%closing_pressure)
         now = crack_island(lattice, load)
      else
         load = min(target, light_load_start)
         now = hertz_spot(lattice, load)
      end if
      do
         call cover(images, lattice, now, start_series_growth, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp, images)
         call converge(equations, lattice, load, now, start_shape_change, change, residual, iterations, ok)
         if (.not. ok .or. steps_between(lattice, load, target, answer%island) == 0) exit
         next = target
         if (steps_between(lattice, load, target, answer%island) > 1) then
            next = load_step_ratio*load
            if (answer%island) next = lattice%closing_pressure - load_step_ratio*(lattice%closing_pressure - load)
         end if
         now = scaled_to_load(lattice, now, load, next)
         load = next
      end do
   end subroutine begin

   !> Makes a series of the images, if it does not cover a shape.
   subroutine cover(images, lattice, now, growth, tolerance)
      type(image_series), intent(inout) :: images
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now
      real(dp), intent(in) :: growth        !! that the shape may still take, >= 1
      real(dp), intent(in) :: tolerance     !! of the series

      if (images%covers(now%shape)) return
      ! Two islands of a cell are too near to each other.
      if (now%island .and. lattice%troughs == 2) return
      call start_image_series(images, lattice%kernel, now%island, now%basis%fold, growth*now%shape%radius(), &
                              tolerance)
   end subroutine cover

   !> Number of steps that take one load to the other.
   pure integer function steps_between(lattice, one, other, island) result(steps)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: one, other
      logical, intent(in) :: island

      real(dp) :: ratio

      ratio = other/one
      if (island) ratio = (lattice%closing_pressure - other)/(lattice%closing_pressure - one)
      steps = ceiling(abs(log(ratio))/log(load_step_ratio))
   end function steps_between

   !> Gauss-Newton until the shape no longer changes.
   subroutine converge(equations, lattice, load, now, tolerance, change, residual, iterations, ok)
      type(contact_equations), intent(inout) :: equations
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load
      type(expansion), intent(inout) :: now
      real(dp), intent(in) :: tolerance     !! of the last step: the next one would be about its square
      real(dp), intent(out) :: change       !! of the last step
      real(dp), intent(out) :: residual
      integer, intent(inout) :: iterations
      logical, intent(out) :: ok

      integer :: i

      do i = 1, most_newton_steps
         call gauss_newton_step(equations, lattice, load, now, change, residual, ok)
         iterations = iterations + 1
         if (.not. ok) return
         if (change <= tolerance) return
      end do
   end subroutine converge

   !> Half a step at first, another where the shape is round: terms that turn with the angle matter less
   !> there. With other than four-fold symmetry at first only: shapes are nearly of a higher one, and half a step
   !> adds next to nothing.
   pure integer function next_degree(degree, fold, edge_reach)
      integer, intent(in) :: degree, fold
      real(dp), intent(in) :: edge_reach

      logical :: half

      half = degree < first_degree
      if (fold == 4) half = degree < full_step_degree .or. (degree < full_step_degree_round .and. &
                                                                   edge_reach < round_shape_ratio)
      next_degree = degree + merge(degree_step/2, degree_step, half)
   end function next_degree

   !> Terms of the shape that go with a degree.
   pure integer function shape_terms(degree, fold, edge_reach)
      integer, intent(in) :: degree, fold
      real(dp), intent(in) :: edge_reach

      ! With two-fold symmetry each is of the next odd power only. Each degree has its own number, or the next one
      ! would change the area by less than it is wrong.
      if (fold == 2) then
         shape_terms = degree/degree_per_shape_term_twofold
         return
      end if
      shape_terms = degree/degree_per_shape_term + 1
      ! Low degrees do not determine as many.
      if (degree < full_shape_degree) shape_terms = (degree + 1)/degree_per_shape_term
      ! With other than four-fold symmetry to about the same power: more would be rounding, but not of sharp tips.
      if (fold < 4 .or. edge_reach < round_shape_ratio) shape_terms = nint(4.0_dp*shape_terms/fold)
   end function shape_terms

   !> The crowding of the edge's points for the next degree.
   !>
   !> N.B. The constants are from trials: up to merging more makes the Jacobian vanish at the tips, and further
   !> away it only costs degrees.
   pure real(dp) function crowding(lattice, now)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      crowding = now%shape%crowding
      if (.not. lattice%square) return
      associate (near => min(reach(lattice, now), 1.0_dp))
         crowding = merge(island_clustering*near**island_clustering_power, &
                          spot_clustering*near**spot_clustering_power, now%island)
      end associate
      if (crowding < least_clustering) crowding = 0.0_dp
      if (abs(crowding - now%shape%crowding) < least_clustering_change*crowding) crowding = now%shape%crowding
      crowding = min(crowding, now%shape%crowding + longest_clustering_step)
   end function crowding

   !> How far the edge reaches, on the way to the nearest neighbours: 1 where it touches theirs, in the middle.
   pure real(dp) function reach(lattice, now)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      !> Of the sine of an angle.
      real(dp), parameter :: rounding = 1e-12_dp
      integer :: i

      reach = 0.0_dp
      if (now%island) then
         do i = 1, size(lattice%to_next_trough)
            reach = max(reach, reach_towards(lattice%to_next_trough(i)))
         end do
      else
         do i = 1, size(lattice%to_next_crest)
            reach = max(reach, reach_towards(lattice%to_next_crest(i)))
         end do
      end if

   contains

      pure real(dp) function reach_towards(middle)
         complex(dp), intent(in) :: middle   !! [s]

         complex(dp) :: direction

         direction = middle/abs(middle)
         associate (turn => direction**now%shape%fold)
            if (abs(turn%im) < rounding) then
               reach_towards = abs(now%shape%place(direction))/abs(middle)
            else
               ! Tips off the axes of symmetry bend: those of long spots come to the middle from the side.
               reach_towards = 1.0_dp - now%shape%distance(middle)/abs(middle)
            end if
         end associate
      end function reach_towards

   end function reach

   !> G: 1 - delta of a spot, the mean of an island's gap.
   real(dp) function mean_gap(equations, lattice, now)
      type(contact_equations), intent(in) :: equations
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      if (now%island) then
         mean_gap = lattice%troughs*equations%integral(now)/lattice%area
      else
         mean_gap = 1.0_dp - now%approach
      end if
   end function mean_gap

   !> Pressure at a crest.
   real(dp) function peak_pressure(equations, lattice, load, now)
      type(contact_equations), intent(in) :: equations
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load
      type(expansion), intent(in) :: now

      if (now%island) then
         peak_pressure = crest_pressure(lattice, equations%rule, load, now)
      else
         peak_pressure = now%at_centre()
      end if
   end function peak_pressure

   !> 1/2 the integral of p u over a cell.
   !>
   !> In contact u = delta - h, and above merging p u = p (delta - h + g), p g = 0; the mean of p h follows from
   !> the Fourier coefficients of p at the waves of h, |k| times those of u.
   real(dp) function energy(equations, lattice, load, now)
      type(contact_equations), intent(in) :: equations
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load
      type(expansion), intent(in) :: now

      complex(dp) :: z(size(equations%rule%point))

      z = now%shape%place(equations%rule%point)
      if (now%island) then
         associate (rise => lattice%pressure_rise(z) - lattice%closing_pressure, &
                    full => 0.5_dp*lattice%area*sum(lattice%amplitude*lattice%pressure))
            energy = 0.5_dp*(full + lattice%troughs*equations%integral(now, rise) &
                             - load*mean_gap(equations, lattice, now)*lattice%area)
         end associate
      else
         energy = 0.5_dp*(now%approach*load*lattice%area - equations%integral(now, lattice%undeformed_gap(z)))
      end if
   end function energy

end module wavycon_fitted_solver
