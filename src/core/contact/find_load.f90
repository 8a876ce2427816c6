!> Finds the load at which the contact area, the mean gap or the approach has a given value.
!>
!> The secant method solves equation (C18) of README.md in this directory, logit t(P) = logit t, for the unknown
!> logit P, where t is the area, 1 - G or the approach, and logit x = ln(x/(1 - x)). Plotted against each other the two
!> logits are nearly a straight line. Gaps are compared as gaps, with logit t = -logit G, because 1 - G would lose the
!> digits of a small G. With free edges or a hardness neither P nor the approach has a largest value; there ln takes the
!> place of logit. The approach on a layer grows beyond full contact by the layer's compression: (C18c).
module wavycon_find_load
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_tuning, only: coarse_fraction, flattest, fraction_of_error, largest_fraction, least_fraction, &
      lightest_load, longest_step, most_solves, steepest, value_roundings
   use wavycon_full_contact, only: mean_compliance
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, contact_area, is_known, mean_gap
   use wavycon_solution_record, only: interrupted, not_accurate, not_found
   implicit none (type, external)
   private

   public :: solve_for

   !> The target of a search, and the present state of the search.
   type :: root_search
      real(dp) :: target = 0.5_dp          !! the contact area fraction, G or the approach [Delta]
      integer :: quantity = contact_area   !! which of the three the target is: contact_area, mean_gap or approach
      logical :: is_bounded = .true.       !! whether the quantity is at most 1; only an approach may be larger
      real(dp) :: compliance = 0.0_dp      !! c of (C18c) [Delta/p*]; 0 if (C18) is solved
      !> Whether the search is for the least load at which all of a map with free edges touches. The area is 1 at all
      !> heavier loads too, so that the target alone does not determine the load.
      logical :: closes = .false.
      !> Upper limit of the load [p*]: the least load that certainly closes the gap, or the hardness if that is less;
      !> huge if there is none.
      real(dp) :: most = 1.0_dp
      real(dp) :: logit_p = 0.0_dp         !! logit(P/most) of the next solution; ln P if `most` is huge
      real(dp) :: slope = 1.0_dp           !! slope of logit t against logit P
   end type root_search

   !> Limits of the slope (C18): 1/2 is that of the area of a line contact at light load, 5/2 that of the gap near full
   !> contact in 2-D.
   real(dp), parameter :: least_slope = 0.5_dp, largest_slope = 2.5_dp

contains

   !> Solves for the load at which a quantity has a given value (C18). The search goes through the coarser levels of the
   !> solver and then to full accuracy; each level starts from the load that the level before has found. The solution
   !> has the status not_accurate if the search did not find such a load. The status is not_found if the target is not
   !> reached even at the lightest loads; the solution is then that for P -> 0, with P set to 0.
   subroutine solve_for(solver, quantity, target, solution)
      class(contact_solver), intent(inout) :: solver    !! a solver that has been started
      integer, intent(in) :: quantity                   !! contact_area, mean_gap or approach
      !> Area fraction or G, 0 .. 1, or approach [Delta]. The load is zero for an area or approach of 0 or less and for
      !> G of 1 or more. Without free edges P = 1 for an area of 1 and for G = 0; the status is not_accurate if a map is
      !> open between its points there.
      real(dp), intent(in) :: target
      type(contact_solution), intent(out) :: solution   !! solution at the load found

      type(root_search) :: search
      real(dp) :: compression   ! of a layer at P = 1 [Delta]; 0 without one
      logical :: ends
      real(dp) :: known_load    ! P of a target that needs no search

      compression = 0.0_dp
      associate (surface => solver%surface)
         search = root_search(target=target, quantity=quantity)
         search%closes = quantity == contact_area .and. target >= 1.0_dp
         search%most = surface%hardness
         if (quantity == approach) then
            compression = mean_compliance(surface)
            search%is_bounded = .not. (surface%has_free_edges .or. surface%has_hardness() .or. compression > 0.0_dp)
            if (.not. surface%has_hardness()) search%compliance = compression
         end if
         ! The approach goes on beyond full contact where a layer is compressed.
         if (.not. (surface%has_free_edges .or. (compression > 0.0_dp .and. &
                                                 (target >= 1.0_dp .or. surface%has_hardness())))) &
            search%most = min(1.0_dp, surface%hardness)
         if (target <= 0.0_dp .or. (target >= 1.0_dp .and. search%is_bounded .and. .not. surface%has_free_edges)) then
            known_load = target
            if (quantity == mean_gap) known_load = 1.0_dp - target
            call solver%solve(max(known_load, 0.0_dp), solution)
            ! A height map may be open between its points at P = 1.
            if (known_load > 0.0_dp .and. .not. solver%closes_at_pstar .and. solution%is_good() .and. &
                abs(solution%value(quantity) - target) > solution%error(quantity)) solution%status = not_accurate
            return
         end if
      end associate
      call solver%begin_search()
      do
         ! At the first level, whose initial status is not_found, and after a level that did not reach the target.
         if (solution%status == not_found) search%logit_p = first_estimate(search)
         if (search%closes) search%logit_p = min(search%logit_p, 0.0_dp)
         ! On a coarser grid the quantity jumps with the load, and the secant of a jump may have any slope.
         search%slope = min(max(search%slope, least_slope), largest_slope)
         call find_root(solver, search, solution)
         call solver%next_level(is_over=solution%status == interrupted, ends=ends)
         if (ends) exit
      end do
   end subroutine solve_for

   !> Searches at one level by the secant method. A step that would leave the bracket of the root is replaced by
   !> bisection. As P -> 0 the area on a grid tends to that of its highest points, not to zero, and the slope to zero.
   !> Where the slope is that small, a solution at the lightest load shows whether the target can be reached.
   subroutine find_root(solver, search, solution)
      class(contact_solver), intent(inout) :: solver
      !> On entry logit_p and slope are first estimates; on return they are the start of the next level.
      type(root_search), intent(inout) :: search
      type(contact_solution), intent(out) :: solution   !! the last solution of the search, or the closest one

      !> Steps of logit P that are relatively shorter than this are rounding.
      real(dp), parameter :: shortest_step = 1e-13_dp
      real(dp) :: allowed, error, high, last_miss, last_logit_p, lightest, low, miss, next, reached
      real(dp) :: closest, closest_logit_p   ! least distance from the target so far, and where
      real(dp) :: least_part   ! the lesser of t and 1 - t, in whose fractions tolerances are given
      integer :: i
      logical :: found

      low = -huge(low)
      high = huge(high)
      lightest = logit(lightest_load)
      least_part = search%target
      if (search%is_bounded) least_part = min(search%target, 1.0_dp - search%target)
      last_logit_p = search%logit_p
      last_miss = 0.0_dp
      closest = huge(closest)
      closest_logit_p = search%logit_p
      do i = 1, most_solves
         call solve_here()
         if (solution%status == interrupted) return
         if (abs(reached - search%target) < closest) closest_logit_p = search%logit_p
         closest = min(closest, abs(reached - search%target))
         allowed = max(min(max(fraction_of_error*error, least_fraction*least_part), largest_fraction*least_part), &
                       value_roundings*spacing(search%target))
         if (solver%level > 0) allowed = max(allowed, min(error, coarse_fraction*least_part))
         miss = logit_t(search, reached, solution%pbar_over_pstar) - &
                logit_t(search, search%target, solution%pbar_over_pstar)
         found = abs(reached - search%target) <= allowed .and. &
            .not. (search%closes .and. search%logit_p - low > largest_fraction)
         ! The map is closed, but a lighter load may close it too: the next step goes down.
         if (search%closes .and. abs(reached - search%target) <= allowed) miss = longest_step
         if (i > 1 .and. abs(search%logit_p - last_logit_p) > 0.0_dp) &
            search%slope = min(max((miss - last_miss)/(search%logit_p - last_logit_p), flattest), steepest)
         last_logit_p = search%logit_p
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, search%logit_p)
         if (miss < 0.0_dp) low = max(low, search%logit_p)
         next = search%logit_p - min(max(miss/search%slope, -longest_step), longest_step)
         if (found .or. (solver%level > 0 .and. high - low <= coarse_fraction)) then
            ! The next level begins at the load to which the last secant step leads.
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
      ! The search ends at either side of a jump.
      if (abs(reached - search%target) > closest + largest_fraction*least_part) then
         search%logit_p = closest_logit_p
         call solve_here()
         if (solution%status == interrupted) return
      end if
      ! The search found no closer load. The area on a grid jumps as points enter the contact, and the target may lie
      ! within a jump. The solution is good enough if its distance from the target is within a known error estimate. It
      ! is also good enough within the largest tolerance, because rounding of P limits the digits of t: 1 - t of the
      ! 1-D wave has half the digits of 1 - P.
      if (abs(reached - search%target) <= error .and. is_known(error)) return
      if (abs(reached - search%target) <= largest_fraction*least_part) return
      if (solution%is_good()) solution%status = not_accurate

   contains

      !> Solves the load of search%logit_p.
      subroutine solve_here()
         if (search%most < huge(search%most)) then
            call solver%solve(search%most/(1.0_dp + exp(-search%logit_p)), solution)
         else
            call solver%solve(exp(search%logit_p), solution)
         end if
         reached = solution%value(search%quantity)
         error = solution%error(search%quantity)
      end subroutine solve_here

   end subroutine find_root

   !> The first estimate: logit P = logit t; on a layer the load of full contact or, if it is more, the one in
   !> proportion to the approach.
   pure real(dp) function first_estimate(search)
      type(root_search), intent(in) :: search

      first_estimate = logit_t(search, search%target, 0.0_dp)
      associate (c => search%compliance, t => search%target)
         if (c > 0.0_dp) first_estimate = log(max((t - 1.0_dp)/c, t/(1.0_dp + c)))
         if (c > 0.0_dp .and. t < 1.0_dp) first_estimate = logit(t/(1.0_dp + c))
      end associate
   end function first_estimate

   !> logit t from a value of the quantity that is searched for; ln t if the quantity is not bounded, and the function
   !> of (C18c) on a layer.
   pure real(dp) function logit_t(search, x, load)
      type(root_search), intent(in) :: search
      real(dp), intent(in) :: x      !! contact area, mean gap or approach, as search%quantity says
      real(dp), intent(in) :: load   !! P at which the value is compared; it counts in (C18c) alone

      logit_t = log(max(x, tiny(x)))
      if (search%is_bounded) then
         logit_t = logit(x)
      else if (search%compliance > 0.0_dp .and. search%target < 1.0_dp) then
         logit_t = logit(x/(1.0_dp + search%compliance*load))
      else if (search%compliance > 0.0_dp) then
         logit_t = -log(max(search%target + search%compliance*load - x, tiny(x)))
      end if
      if (search%quantity == mean_gap) logit_t = -logit_t
   end function logit_t

   !> ln(x/(1 - x)). A solution on a coarse grid may have x = 0 or x = 1; the least positive number then takes the place
   !> of x or 1 - x.
   pure real(dp) function logit(x)
      real(dp), intent(in) :: x

      real(dp), parameter :: least = tiny(1.0_dp)

      logit = log(max(x, least)) - log(max(1.0_dp - x, least))
   end function logit

end module wavycon_find_load
