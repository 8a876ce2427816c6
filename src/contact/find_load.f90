!> The load that leaves a given mean gap, or makes a given contact area.
module wavycon_find_load
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_state, only: contact_state, not_accurate
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solve_for_contact_area, solve_for_mean_gap

   !> The root is met to this part of the error estimate, and to these parts of the target and of what it lacks to
   !> one.
   real(dp), parameter :: part_of_error = 0.01_dp, least_part = 1e-12_dp, largest_part = 1e-4_dp
   integer, parameter :: most_solves = 60

   !> ln P/(1-P) against the same of the contact area, or of one less the gap: nearly straight, with slopes from 2/3
   !> to 5/2.
   type :: root_search
      real(dp) :: target = 0.5_dp          !! 0 < target < 1
      logical :: of_gap = .false.
      real(dp) :: place = 0.0_dp           !! ln P/(1-P)
      real(dp) :: slope = 1.0_dp
   end type root_search

contains

   !> Errors of the answer: its status is not_accurate if the area could not be met.
   subroutine solve_for_contact_area(solver, contact_area_fraction, state)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: contact_area_fraction   !! 0 .. 1
      type(contact_state), intent(out) :: state

      call solve_for(solver, root_search(target=contact_area_fraction, of_gap=.false.), state)
   end subroutine solve_for_contact_area

   !> Likewise of the gap.
   subroutine solve_for_mean_gap(solver, mean_gap_over_amplitude, state)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: mean_gap_over_amplitude   !! G, 0 .. 1
      type(contact_state), intent(out) :: state

      call solve_for(solver, root_search(target=1.0_dp - mean_gap_over_amplitude, of_gap=.true.), state)
   end subroutine solve_for_mean_gap

   subroutine solve_for(solver, search_for, state)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(in) :: search_for
      type(contact_state), intent(out) :: state

      type(root_search) :: search
      integer :: level

      search = search_for
      if (search%target <= 0.0_dp .or. search%target >= 1.0_dp) then
         call solver%solve(search%target, state)
         return
      end if
      search%place = logit(search%target)
      do level = solver%cheaper_levels(), 0, -1
         call solver%use_level(level)
         call find_root(solver, search, state)
      end do
   end subroutine solve_for

   !> The secant method, kept inside the bracket once there is one.
   subroutine find_root(solver, search, state)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(inout) :: search
      type(contact_state), intent(out) :: state

      !> Of ln P/(1-P): the largest step without a bracket, and the least that is one.
      real(dp), parameter :: longest_step = 3.0_dp, shortest_step = 1e-13_dp
      real(dp), parameter :: flattest = 0.2_dp, steepest = 20.0_dp
      real(dp) :: error, high, last_miss, last_place, low, met, miss, next
      integer :: i

      low = -huge(low)
      high = huge(high)
      last_place = search%place
      last_miss = 0.0_dp
      do i = 1, most_solves
         call solver%solve(1.0_dp/(1.0_dp + exp(-search%place)), state)
         met = state%measures%contact_area_fraction
         error = state%measures%contact_area_error
         if (search%of_gap) then
            met = 1.0_dp - state%measures%mean_gap_over_amplitude
            error = state%measures%mean_gap_error
         end if
         if (abs(met - search%target) <= allowed(error, search%target)) return
         miss = logit(met) - logit(search%target)
         if (i > 1 .and. abs(search%place - last_place) > 0.0_dp) &
            search%slope = min(max((miss - last_miss)/(search%place - last_place), flattest), steepest)
         last_place = search%place
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, search%place)
         if (miss < 0.0_dp) low = max(low, search%place)
         next = search%place - min(max(miss/search%slope, -longest_step), longest_step)
         if (next <= low .or. next >= high) next = 0.5_dp*(low + high)
         if (abs(next - search%place) <= shortest_step*max(1.0_dp, abs(next))) exit
         search%place = next
      end do
      ! The area of a grid may jump over the target as the points in contact change, by less than its own error. One
      ! that is as large as any error can be says nothing of that.
      if (abs(met - search%target) <= error .and. error < 1.0_dp) return
      if (state%is_good()) state%status = not_accurate
   end subroutine find_root

   pure real(dp) function allowed(error, target)
      real(dp), intent(in) :: error   !! of the value met; 0 if that is not known
      real(dp), intent(in) :: target

      associate (scale => min(target, 1.0_dp - target))
         allowed = min(max(part_of_error*error, least_part*scale), largest_part*scale)
      end associate
   end function allowed

   !> ln x/(1-x), of values that a solver may give also where it is far from any contact or any gap.
   pure real(dp) function logit(x)
      real(dp), intent(in) :: x

      real(dp), parameter :: least = 1e-15_dp

      logit = log(max(x, least)/max(1.0_dp - x, least))
   end function logit

end module wavycon_find_load
