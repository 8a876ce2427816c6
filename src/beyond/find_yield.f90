!> Finds the least load at which a body reaches its yield stress, or a given part of the yield stress.
!>
!> Let r(P) be the largest equivalent stress over the yield stress. Equation (S8) of src/core/stress/README.md,
!> ln r(P) = ln(target), is solved for ln P by the secant method. The search begins at a light load, where r is a power
!> of P, and approaches the root from below, because r may fall again at loads above the least root.
module wavycon_find_yield
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_tuning, only: coarse_fraction, fraction_of_error, largest_fraction, largest_stress_error, &
      largest_stress_miss, least_fraction, longest_rise, most_solves, part_of_stress_error
   use wavycon_kinds, only: dp, ieee_is_finite
   use wavycon_largest_stress, only: largest_stress
   use wavycon_quantities, only: unknown
   use wavycon_solution_record, only: interrupted, no_solution, not_accurate, not_found
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_setting, only: stress_setting
   implicit none (type, external)
   private

   public :: solve_for_yield

   !> The load at which the search begins, and the largest load that is tried [p*].
   real(dp), parameter :: first_load = 0.01_dp, last_load = 1e6_dp

   !> The least ln(H/P) of the loads that are tried, H the hardness: P must be below H.
   real(dp), parameter :: below_hardness = 1e-3_dp

contains

   !> Solves for the load at which the largest equivalent stress is a given part of the yield stress. If no load is
   !> found, the solution has no numbers, the status not_found, and the load at which the largest stress was found.
   !>
   !> If the solver has coarser grids, the search is done on each of them first, from the coarsest on. Each search
   !> begins at the last load and slope of the one before.
   subroutine solve_for_yield(solver, setting, target, solution, stresses)
      class(contact_solver), intent(inout) :: solver    !! started with keep_fields
      type(stress_setting), intent(in) :: setting       !! with yield stresses
      real(dp), intent(in) :: target                    !! stress over yield stress, > 0; 1 is first yield
      type(contact_solution), intent(out) :: solution   !! the contact at the load found
      !> Its largest von Mises (1) and shear stress (2) in each body, shape (2, bodies), if the solver has coarser grids
      !> and a load is found; otherwise unchanged.
      type(largest_stress), intent(inout), optional :: stresses(:, :)

      logical :: ends
      real(dp) :: first_log_p, log_p, slope

      ! The first load must be below the hardness, which may be a small part of p*.
      first_log_p = log(min(first_load, 0.5_dp*solver%surface%hardness))
      log_p = first_log_p
      slope = light_slope(solver)
      call solver%begin_search()
      do
         call find_root(solver, setting, log(target), log_p, slope, solution, stresses)
         call solver%next_level(is_over=solution%status == interrupted, ends=ends)
         if (ends) exit
         if (solution%status == not_found) then
            log_p = first_log_p
            slope = light_slope(solver)
         end if
      end do
      if (present(stresses) .and. any(solution%status == [interrupted, not_found])) stresses = largest_stress()
   end subroutine solve_for_yield

   !> Solves ln r(P) = log_target on one grid by the secant method. A step that would leave the bracket of the root or
   !> reach the hardness is replaced by bisection.
   subroutine find_root(solver, setting, log_target, log_p, slope, solution, stresses)
      class(contact_solver), intent(inout) :: solver
      type(stress_setting), intent(in) :: setting
      real(dp), intent(in) :: log_target
      real(dp), intent(inout) :: log_p               !! ln P: of the first load on entry, to begin the next grid on exit
      real(dp), intent(inout) :: slope               !! d ln r/d ln P there
      type(contact_solution), intent(out) :: solution
      type(largest_stress), intent(inout), optional :: stresses(:, :)   !! as of solve_for_yield

      class(stress_fields), allocatable :: fields
      type(solver_traits) :: traits
      !> Values of ln P: the bracket of the root, the hardness, the last and the next load, that of the largest stress.
      real(dp) :: low, high, at_hardness, last_log_p, next, at_largest
      !> Values of ln r - log_target: now, at the last load, the largest one, and the allowed one; the error of ln r; r.
      real(dp) :: miss, last_miss, largest, tolerance, error, ratio
      integer :: i
      logical :: jumps           ! whether the bracket of a coarser grid is so narrow that r jumps over the target in it
      !> Rounding of the logarithm of a stress.
      real(dp), parameter :: rounding = 1e-10_dp
      !> A bracket narrower than this part of the tolerance contains a jump of r.
      real(dp), parameter :: part_of_tolerance = 0.1_dp

      traits = solver%traits()
      low = -huge(low)
      at_hardness = log(solver%surface%hardness)
      high = at_hardness
      ! On coarser grids no load of full contact is tried: there the stress is that of the finest grid, and its series
      ! has all waves of the surface.
      if (solver%level > 0 .and. .not. (solver%surface%has_hardness() .or. solver%surface%has_free_edges)) high = 0.0_dp
      last_log_p = log_p
      last_miss = 0.0_dp
      largest = -huge(largest)
      at_largest = log_p
      do i = 1, most_solves
         call solver%solve(exp(log_p), solution)
         if (solution%status == interrupted) return
         call solution%stresses(solver%surface, fields)
         if (solver%level == 0 .and. traits%coarser_levels > 0 .and. present(stresses)) then
            ! The load is likely to be the one found.
            call setting%find_over_yield_stress(fields, ratio, error, stresses)
         else
            call setting%find_over_yield_stress(fields, ratio, error)
         end if
         if (.not. ieee_is_finite(ratio)) exit   ! NaN if the load has no solution
         miss = log(ratio) - log_target
         error = error/ratio
         ! A solver without error estimates is taken as exact. An estimate that is not known meets no accuracy.
         if (.not. ieee_is_finite(error)) error = merge(unknown, 0.0_dp, traits%has_errors)
         if (miss > largest + rounding) then
            largest = miss
            at_largest = log_p
         end if
         if (traits%coarser_levels > 0) then
            ! A solution on a grid that has coarser ones is expensive.
            tolerance = min(max(part_of_stress_error*error, least_fraction), largest_stress_miss)
         else
            tolerance = min(max(fraction_of_error*error, least_fraction), largest_fraction)
         end if
         if (solver%level > 0) tolerance = max(tolerance, min(error, coarse_fraction))
         if (solution%is_good() .and. error > largest_stress_error) solution%status = not_accurate
         if (i > 1 .and. abs(log_p - last_log_p) > 0.0_dp) slope = (miss - last_miss)/(log_p - last_log_p)
         ! Where a hardness bounds the pressure, r hardly grows with the load. The slope of the secant is then nearly
         ! zero, and its step would lead to a much too light load.
         if (low <= -huge(low) .and. miss > max(0.0_dp, longest_rise*slope)) &
            slope = max(slope, 0.5_dp*light_slope(solver))
         last_log_p = log_p
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, log_p)
         if (miss < 0.0_dp) low = max(low, log_p)
         next = huge(next)
         if (slope > 0.0_dp) next = log_p - miss/slope
         next = min(next, log_p + longest_rise)
         if (next <= low .or. next >= high) next = min(0.5_dp*(low + high), log_p + longest_rise)
         jumps = solver%level > 0 .and. high < at_hardness .and. high - low <= coarse_fraction
         if (abs(miss) <= tolerance .or. jumps) then
            ! The next grid begins at the end of the last secant step. The secant of a jump may have any slope, and is
            ! replaced by half of the slope of a single crest: jumps occur on rough surfaces, whose slope is smaller.
            if (slope > 0.0_dp .and. next < at_hardness - below_hardness) log_p = max(next, log_p - longest_rise)
            if (jumps) slope = 0.5_dp*light_slope(solver)
            return
         end if
         if (next > min(log(last_load), at_hardness - below_hardness)) exit
         if (abs(next - log_p) <= epsilon(next)*max(1.0_dp, abs(next)) &
             .or. (high < at_hardness .and. high - low <= part_of_tolerance*tolerance)) then
            ! The slope of a jump says nothing for the next grid.
            slope = light_slope(solver)
            ! The stress of a solution on a grid jumps by rounding and by the tolerance of the solver, and the target
            ! may lie within a jump. The solution is accurate if its distance from the target is within the error
            ! estimate.
            if (solution%is_good() .and. abs(miss) > error) solution%status = not_accurate
            return
         end if
         log_p = next
      end do
      if (allocated(solution%source)) deallocate (solution%source)
      solution%solution_record = no_solution(exp(at_largest), traits%solver, not_found)
   end subroutine find_root

   !> d ln r/d ln P at light load: 1/2 for a line contact, 1/3 for point contacts.
   pure real(dp) function light_slope(solver)
      class(contact_solver), intent(in) :: solver

      light_slope = merge(0.5_dp, 1.0_dp/3, solver%surface%dimension == 1)
   end function light_slope

end module wavycon_find_yield
