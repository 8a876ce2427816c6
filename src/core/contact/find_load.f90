!> Finds the load at which the contact area, the mean gap or the approach has a given value.
!>
!> Equation (C18) of README.md in this directory: with t the area or 1 - G, the secant method solves logit t(P) =
!> logit t for logit P, where logit x = ln(x/(1 - x)). The two logits are nearly a straight line against each other.
!> Gaps are compared as gaps, and logit t = -logit G: 1 - G would lose the digits of a small G. Where neither P nor the
!> approach has a largest value, with free edges or a hardness, ln takes the place of logit.
module wavycon_find_load
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: interrupted, not_accurate, not_found
   use wavycon_contact_tuning, only: coarse_fraction, flattest, fraction_of_error, largest_fraction, least_fraction, &
      lightest_load, longest_step, most_solves, steepest, value_roundings
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, contact_area, is_known, mean_gap
   implicit none (type, external)
   private

   public :: solve_for

   !> What is searched for, and how far the search is. The slope lies between 1/2 (area of a line contact at light load)
   !> and 5/2 (gap near full contact in 2-D).
   type :: root_search
      real(dp) :: target = 0.5_dp          !! the contact area fraction, G or the approach [Delta]
      integer :: quantity = contact_area   !! which of them
      logical :: is_bounded = .true.       !! whether the target is below 1; only an approach may not be
      !> Whether it is the least load at which all of a map with free edges touches: the area is 1 at heavier loads too.
      logical :: closes = .false.
      !> The least load that certainly closes the gap or exceeds what H carries; huge if there is none.
      real(dp) :: most = 1.0_dp
      real(dp) :: logit_p = 0.0_dp         !! logit P/most, or ln P, of the next solution
      real(dp) :: slope = 1.0_dp           !! of logit t against logit P
   end type root_search

   !> Between these the slope lies (C18).
   real(dp), parameter :: least_slope = 0.5_dp, largest_slope = 2.5_dp

contains

   !> Solves for the load at which a quantity has a given value (C18): searches at each coarser level of the solver,
   !> each from the load of the one before, and then at full accuracy. The solution has the status not_accurate if the
   !> search did not find such a load, and not_found if the value is not reached even at the lightest loads: it is then
   !> that of P -> 0, and P is 0.
   subroutine solve_for(solver, quantity, target, solution)
      class(contact_solver), intent(inout) :: solver    !! started
      integer, intent(in) :: quantity                   !! contact_area, mean_gap or approach
      !> The area fraction or G, 0 .. 1, or the approach [Delta]: no load at an area or approach of 0 or less and at G of
      !> 1 or more, P = 1 at an area of 1 and at G = 0.
      real(dp), intent(in) :: target
      type(contact_solution), intent(out) :: solution   !! of the load found

      type(root_search) :: search
      type(solver_traits) :: traits
      integer :: level

      associate (surface => solver%surface)
         search = root_search(target=target, quantity=quantity)
         search%closes = quantity == contact_area .and. target >= 1.0_dp
         search%most = surface%hardness
         ! The approach goes on beyond full contact where a layer is compressed.
         if (.not. (surface%has_free_edges .or. (quantity == approach .and. surface%kernel%has_layer()))) &
            search%most = min(1.0_dp, surface%hardness)
         if (quantity == approach) search%is_bounded = &
            .not. (surface%has_free_edges .or. surface%has_hardness() .or. surface%kernel%has_layer())
         if (target <= 0.0_dp .or. (target >= 1.0_dp .and. search%is_bounded .and. .not. surface%has_free_edges)) then
            call solver%solve(max(merge(1.0_dp - target, target, quantity == mean_gap), 0.0_dp), solution)
            return
         end if
      end associate
      traits = solver%traits()
      call solver%set_search(.true.)
      do level = traits%coarser_levels, 0, -1
         ! At the first level as well.
         if (solution%status == not_found) search%logit_p = logit_t(search, search%target)
         if (search%closes) search%logit_p = min(search%logit_p, 0.0_dp)
         solver%level = level
         ! The secant of a jump on a coarser level has any slope.
         search%slope = min(max(search%slope, least_slope), largest_slope)
         call find_root(solver, search, solution)
         if (solution%status == interrupted) exit
      end do
      call solver%set_search(.false.)
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
      real(dp) :: allowed, error, high, last_miss, last_logit_p, lightest, low, met, miss, next, scale
      integer :: i
      logical :: found

      low = -huge(low)
      high = huge(high)
      lightest = logit(lightest_load)
      scale = merge(min(search%target, 1.0_dp - search%target), search%target, search%is_bounded)
      last_logit_p = search%logit_p
      last_miss = 0.0_dp
      do i = 1, most_solves
         if (search%most < huge(search%most)) then
            call solver%solve(search%most/(1.0_dp + exp(-search%logit_p)), solution)
         else
            call solver%solve(exp(search%logit_p), solution)
         end if
         if (solution%status == interrupted) return
         met = solution%value(search%quantity)
         error = solution%error(merge(contact_area, mean_gap, search%quantity == contact_area))
         allowed = max(min(max(fraction_of_error*error, least_fraction*scale), largest_fraction*scale), &
                       value_roundings*spacing(search%target))
         if (solver%level > 0) allowed = max(allowed, min(error, coarse_fraction*scale))
         miss = logit_t(search, met) - logit_t(search, search%target)
         found = abs(met - search%target) <= allowed .and. &
            .not. (search%closes .and. search%logit_p - low > largest_fraction)
         ! A lighter load may close the map too.
         if (search%closes .and. abs(met - search%target) <= allowed) miss = longest_step
         if (i > 1 .and. abs(search%logit_p - last_logit_p) > 0.0_dp) &
            search%slope = min(max((miss - last_miss)/(search%logit_p - last_logit_p), flattest), steepest)
         last_logit_p = search%logit_p
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, search%logit_p)
         if (miss < 0.0_dp) low = max(low, search%logit_p)
         next = search%logit_p - min(max(miss/search%slope, -longest_step), longest_step)
         if (found .or. (solver%level > 0 .and. high - low <= coarse_fraction)) then
            ! The next level begins with the last step.
            if (next > low .and. next < high .and. .not. search%closes) search%logit_p = next
            return
         end if
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
      if (abs(met - search%target) <= largest_fraction*scale) return
      if (solution%is_good()) solution%status = not_accurate
   end subroutine find_root

   !> logit t of a contact area, a mean gap or an approach, or ln t.
   pure real(dp) function logit_t(search, x)
      type(root_search), intent(in) :: search
      real(dp), intent(in) :: x   !! as search%quantity says

      logit_t = log(max(x, tiny(x)))
      if (search%is_bounded) logit_t = merge(-logit(x), logit(x), search%quantity == mean_gap)
   end function logit_t

   !> ln(x/(1 - x)). The values 0 and 1, which a solution on a coarse grid may have, are replaced by almost 0 and 1.
   pure real(dp) function logit(x)
      real(dp), intent(in) :: x

      real(dp), parameter :: least = tiny(1.0_dp)

      logit = log(max(x, least)) - log(max(1.0_dp - x, least))
   end function logit

end module wavycon_find_load
