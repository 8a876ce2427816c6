!> Finds the load at which the contact area or the mean gap has a given value.
!>
!> Equation (C18) of README.md in this directory: with t the area or 1 - G, the secant method solves logit t(P) =
!> logit t for logit P, where logit x = ln(x/(1 - x)). The two logits are nearly a straight line against each other.
!> Gaps are compared as gaps, and logit t = -logit G: 1 - G would lose the digits of a small G.
module wavycon_find_load
   use wavycon_contact_measures, only: is_known
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: interrupted, not_accurate, not_found
   use wavycon_contact_tuning, only: flattest, fraction_of_error, largest_fraction, least_fraction, lightest_load, &
      longest_step, most_solves, steepest, value_roundings
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solve_for_contact_area, solve_for_mean_gap

   !> What is searched for, and how far the search is. The slope lies between 1/2 (area of a line contact at light load)
   !> and 5/2 (gap near full contact in 2-D).
   type :: root_search
      real(dp) :: target = 0.5_dp          !! the contact area fraction or G
      logical :: of_gap = .false.          !! whether it is G
      real(dp) :: most = 1.0_dp            !! the least load that certainly closes the gap or exceeds what H carries
      real(dp) :: logit_p = 0.0_dp         !! logit P/most of the next solution
      real(dp) :: slope = 1.0_dp           !! of logit t against logit P
   end type root_search

contains

   !> Solves for the load at which the contact area has a given value: (C18). The solution has the status not_accurate
   !> if the search did not find such a load, and not_found if the area is larger even at the lightest loads: it is then
   !> that of P -> 0, and P is 0.
   subroutine solve_for_contact_area(solver, contact_area_fraction, solution)
      class(contact_solver), intent(inout) :: solver        !! started
      real(dp), intent(in) :: contact_area_fraction         !! 0 .. 1: no load at 0, P = 1 at 1
      type(contact_solution), intent(out) :: solution   !! of the load found

      call solve_for(solver, root_search(target=contact_area_fraction, of_gap=.false.), solution)
   end subroutine solve_for_contact_area

   !> Solves for the load at which the mean gap has a given value, with the statuses of solve_for_contact_area.
   subroutine solve_for_mean_gap(solver, mean_gap_over_amplitude, solution)
      class(contact_solver), intent(inout) :: solver        !! started
      real(dp), intent(in) :: mean_gap_over_amplitude       !! G, 0 .. 1: P = 1 at 0, no load at 1
      type(contact_solution), intent(out) :: solution   !! of the load found

      call solve_for(solver, root_search(target=mean_gap_over_amplitude, of_gap=.true.), solution)
   end subroutine solve_for_mean_gap

   !> Searches at each coarser level of the solver, each from the load of the one before, and then at full accuracy.
   subroutine solve_for(solver, search_for, solution)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(in) :: search_for
      type(contact_solution), intent(out) :: solution

      type(root_search) :: search
      type(solver_traits) :: traits
      integer :: level

      search = search_for
      search%most = min(1.0_dp, solver%surface%hardness)
      if (search%target <= 0.0_dp .or. search%target >= 1.0_dp) then
         call solver%solve(merge(1.0_dp - search%target, search%target, search%of_gap), solution)
         return
      end if
      search%logit_p = logit_t(search, search%target)
      traits = solver%traits()
      do level = traits%coarser_levels, 0, -1
         solver%level = level
         call find_root(solver, search, solution)
         if (solution%status == interrupted) exit
         if (solution%status == not_found) search%logit_p = logit_t(search, search%target)
      end do
      solver%level = 0
   end subroutine solve_for

   !> The secant method. A step that would leave the bracket of the root is replaced by bisection. Towards light loads
   !> the area on a grid falls to that of its highest points only: where t no longer follows the load, the lightest load
   !> shows whether the target can be reached.
   subroutine find_root(solver, search, solution)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(inout) :: search   !! on entry with a first estimate of logit P and slope
      type(contact_solution), intent(out) :: solution

      !> Relative steps of logit P below this are rounding.
      real(dp), parameter :: shortest_step = 1e-13_dp
      real(dp) :: error, high, last_miss, last_logit_p, lightest, low, met, miss, next
      integer :: i

      low = -huge(low)
      high = huge(high)
      lightest = logit(lightest_load)
      last_logit_p = search%logit_p
      last_miss = 0.0_dp
      do i = 1, most_solves
         call solver%solve(search%most/(1.0_dp + exp(-search%logit_p)), solution)
         if (solution%status == interrupted) return
         met = solution%measures%contact_area_fraction
         error = solution%measures%contact_area_error
         if (search%of_gap) then
            met = solution%measures%mean_gap_over_amplitude
            error = solution%measures%mean_gap_error
         end if
         if (abs(met - search%target) <= allowed(error, search%target)) return
         miss = logit_t(search, met) - logit_t(search, search%target)
         if (i > 1 .and. abs(search%logit_p - last_logit_p) > 0.0_dp) &
            search%slope = min(max((miss - last_miss)/(search%logit_p - last_logit_p), flattest), steepest)
         last_logit_p = search%logit_p
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, search%logit_p)
         if (miss < 0.0_dp) low = max(low, search%logit_p)
         next = search%logit_p - min(max(miss/search%slope, -longest_step), longest_step)
         if (search%slope <= flattest) then
            if (low > -huge(low) .and. high < huge(high)) then
               next = 0.5_dp*(low + high)
            else if (miss > 0.0_dp .and. search%logit_p <= lightest) then
               solution%pbar_over_pstar = 0.0_dp
               solution%status = not_found
               return
            else if (miss > 0.0_dp .and. search%logit_p < 0.0_dp) then
               next = min(next, lightest)
            end if
         end if
         if (next <= low .or. next >= high) next = 0.5_dp*(low + high)
         if (abs(next - search%logit_p) <= shortest_step*max(1.0_dp, abs(next))) exit
         search%logit_p = next
      end do
      ! The area on a grid jumps as points enter the contact: the target may lie within a jump. This is good enough if
      ! the distance is within the error estimate. An unknown error proves nothing. Rounding of P and of the value may
      ! keep this from a closer one: 1 - t of the 1-D wave has half the digits of 1 - P.
      if (abs(met - search%target) <= error .and. is_known(error)) return
      if (abs(met - search%target) <= largest_fraction*smaller_part(search%target)) return
      if (solution%is_good()) solution%status = not_accurate
   end subroutine find_root

   !> The largest difference from the target at which a value is accepted.
   pure real(dp) function allowed(error, target)
      real(dp), intent(in) :: error   !! error estimate of the value; 0 if there is none
      real(dp), intent(in) :: target

      associate (scale => smaller_part(target))
         allowed = max(min(max(fraction_of_error*error, least_fraction*scale), largest_fraction*scale), &
                       value_roundings*spacing(target))
      end associate
   end function allowed

   !> min(t, 1 - t)
   pure real(dp) function smaller_part(target)
      real(dp), intent(in) :: target

      smaller_part = min(target, 1.0_dp - target)
   end function smaller_part

   !> logit t of a contact area or a mean gap.
   pure real(dp) function logit_t(search, x)
      type(root_search), intent(in) :: search
      real(dp), intent(in) :: x   !! the contact area fraction or G, as search%of_gap says

      logit_t = merge(-logit(x), logit(x), search%of_gap)
   end function logit_t

   !> ln(x/(1 - x)). The values 0 and 1, which a solution on a coarse grid may have, are replaced by almost 0 and 1.
   pure real(dp) function logit(x)
      real(dp), intent(in) :: x

      real(dp), parameter :: least = tiny(1.0_dp)

      logit = log(max(x, least)) - log(max(1.0_dp - x, least))
   end function logit

end module wavycon_find_load
