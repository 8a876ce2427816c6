!> Finds the least load at which a body reaches its yield stress, or a given part of it.
!>
!> Equation (S8) of src/core/stress/README.md: the secant method for ln r(P) = ln r, r the largest equivalent stress
!> over the yield stress. It begins at a light load, where r is a power of P, and approaches the root from below: beyond
!> the first one r may fall again.
module wavycon_find_yield
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: interrupted, not_accurate, not_found
   use wavycon_contact_tuning, only: coarse_fraction, fraction_of_error, largest_fraction, largest_stress_error, &
      least_fraction, longest_rise, most_solves
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: unknown
   use wavycon_solution_record, only: no_solution
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_setting, only: stress_setting
   implicit none (type, external)
   private

   public :: solve_for_yield

   !> Loads at which the search begins, and above which no contact is looked for.
   real(dp), parameter :: first_load = 0.01_dp, last_load = 1e6_dp

   !> Loads closer than this to the hardness, as ln(H/P), are not looked at: P must be below H.
   real(dp), parameter :: below_hardness = 1e-3_dp

contains

   !> Solves for the load at which the largest equivalent stress is a given part of the yield stress. If no load
   !> reaches it there is no solution, with the status not_found and the load of the largest stress met.
   subroutine solve_for_yield(solver, setting, target, solution)
      class(contact_solver), intent(inout) :: solver        !! started with keep_fields
      type(stress_setting), intent(in) :: setting           !! with yield stresses
      real(dp), intent(in) :: target                        !! r > 0, stress over yield stress; 1: first yield
      type(contact_solution), intent(out) :: solution   !! of the load found

      real(dp) :: first_log_p, log_p, slope
      type(solver_traits) :: traits
      integer :: level

      ! Below the hardness, which may be a small part of p*.
      first_log_p = log(min(first_load, 0.5_dp*solver%surface%hardness))
      log_p = first_log_p
      slope = light_slope(solver)
      traits = solver%traits()
      call solver%set_search(.true.)
      do level = traits%coarser_levels, 0, -1
         solver%level = level
         call find_root(solver, setting, log(target), log_p, slope, solution)
         if (solution%status == interrupted) exit
         if (solution%status == not_found) then
            log_p = first_log_p
            slope = light_slope(solver)
         end if
      end do
      call solver%set_search(.false.)
      solver%level = 0
   end subroutine solve_for_yield

   !> The secant method. A step that would leave the bracket of the root or reach the hardness is replaced by bisection.
   subroutine find_root(solver, setting, log_target, log_p, slope, solution)
      class(contact_solver), intent(inout) :: solver
      type(stress_setting), intent(in) :: setting
      real(dp), intent(in) :: log_target
      real(dp), intent(inout) :: log_p               !! ln P of the first load; on return of the last one
      real(dp), intent(inout) :: slope               !! d ln r/d ln P there
      type(contact_solution), intent(out) :: solution

      class(stress_fields), allocatable :: fields
      type(solver_traits) :: traits
      real(dp) :: at_hardness, at_largest, enough, error, high, largest, last_log_p, last_miss, low, miss, next, ratio
      integer :: i
      logical :: jumps
      !> Rounding of the logarithm of a stress.
      real(dp), parameter :: rounding = 1e-10_dp
      !> A bracket narrower than this part of the tolerance has a jump.
      real(dp), parameter :: part_of_enough = 0.1_dp

      traits = solver%traits()
      low = -huge(low)
      at_hardness = log(solver%surface%hardness)
      high = at_hardness
      last_log_p = log_p
      last_miss = 0.0_dp
      largest = -huge(largest)
      at_largest = log_p
      do i = 1, most_solves
         call solver%solve(exp(log_p), solution)
         if (solution%status == interrupted) return
         call solution%stresses(solver%surface, fields)
         call setting%find_over_yield_stress(fields, ratio, error)
         if (.not. ieee_is_finite(ratio)) exit   ! NaN if the load has no solution
         miss = log(ratio) - log_target
         error = error/ratio
         ! Without estimates there is nothing to compare with; an estimate that is unknown meets no accuracy.
         if (.not. ieee_is_finite(error)) error = merge(unknown, 0.0_dp, traits%has_errors)
         if (miss > largest + rounding) then
            largest = miss
            at_largest = log_p
         end if
         enough = min(max(fraction_of_error*error, least_fraction), largest_fraction)
         if (solver%level > 0) enough = max(enough, min(error, coarse_fraction))
         if (solution%is_good() .and. error > largest_stress_error) solution%status = not_accurate
         if (i > 1 .and. abs(log_p - last_log_p) > 0.0_dp) slope = (miss - last_miss)/(log_p - last_log_p)
         ! Where a hardness bounds the stress r hardly grows: the secant would lead to loads far too light, or up.
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
         if (abs(miss) <= enough .or. jumps) then
            ! The next level begins with the last step. The secant of a jump may have any slope; jumps are those of
            ! rough surfaces, whose slope is less than that of one crest.
            if (slope > 0.0_dp .and. next < at_hardness - below_hardness) log_p = max(next, log_p - longest_rise)
            if (jumps) slope = 0.5_dp*light_slope(solver)
            return
         end if
         if (next > min(log(last_load), at_hardness - below_hardness)) exit
         if (abs(next - log_p) <= epsilon(next)*max(1.0_dp, abs(next)) &
             .or. (high < at_hardness .and. high - low <= part_of_enough*enough)) then
            ! The slope of a jump is none for the next level.
            slope = light_slope(solver)
            ! The stress of a solution on a grid jumps by rounding and the tolerance of the solver: the target may lie
            ! within a jump. This is good enough if the distance is within the error estimate.
            if (solution%is_good() .and. abs(miss) > error) solution%status = not_accurate
            return
         end if
         log_p = next
      end do
      if (allocated(solution%source)) deallocate (solution%source)
      solution%solution_record = no_solution(exp(at_largest), traits%solver, not_found)
   end subroutine find_root

   !> d ln r/d ln P of a line contact or of a point contact at light load.
   pure real(dp) function light_slope(solver)
      class(contact_solver), intent(in) :: solver

      light_slope = merge(0.5_dp, 1.0_dp/3, solver%surface%dimension == 1)
   end function light_slope

end module wavycon_find_yield
