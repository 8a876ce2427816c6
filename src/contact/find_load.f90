!> The load that leaves a given mean gap, or makes a given contact area.
module wavycon_find_load
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: not_accurate
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solve_for_contact_area, solve_for_mean_gap

   !> Tolerance of the value found: this fraction of its error estimate, bounded by these fractions of min(t, 1 - t), where t
   !> is the target.
   real(dp), parameter :: fraction_of_error = 0.01_dp, least_fraction = 1e-12_dp, largest_fraction = 1e-4_dp
   integer, parameter :: most_solves = 60

   !> The search is for ln P/(1-P). Against it ln A/(1-A) of the contact area, or ln (1-G)/G of the mean gap, is nearly a
   !> straight line, with a slope from 2/3 to 5/2.
   type :: root_search
      real(dp) :: target = 0.5_dp          !! 0 < target < 1
      logical :: of_gap = .false.
      real(dp) :: logit_p = 0.0_dp         !! ln P/(1-P)
      real(dp) :: slope = 1.0_dp
   end type root_search

contains

   !> Solves for the load with a given contact area. The status is not_accurate if no load was found for it.
   subroutine solve_for_contact_area(solver, contact_area_fraction, solution)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: contact_area_fraction   !! 0 .. 1
      class(contact_solution), allocatable, intent(out) :: solution

      call solve_for(solver, root_search(target=contact_area_fraction, of_gap=.false.), solution)
   end subroutine solve_for_contact_area

   !> Solves for the load with a given mean gap, likewise.
   subroutine solve_for_mean_gap(solver, mean_gap_over_amplitude, solution)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: mean_gap_over_amplitude   !! G, 0 .. 1
      class(contact_solution), allocatable, intent(out) :: solution

      call solve_for(solver, root_search(target=1.0_dp - mean_gap_over_amplitude, of_gap=.true.), solution)
   end subroutine solve_for_mean_gap

   subroutine solve_for(solver, search_for, solution)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(in) :: search_for
      class(contact_solution), allocatable, intent(out) :: solution

      type(root_search) :: search
      integer :: level

      search = search_for
      if (search%target <= 0.0_dp .or. search%target >= 1.0_dp) then
         call solver%solve(search%target, solution)
         return
      end if
      search%logit_p = logit(search%target)
      do level = solver%coarser_levels(), 0, -1
         call solver%use_level(level)
         call find_root(solver, search, solution)
      end do
   end subroutine solve_for

   !> The secant method, kept inside the bracket once there is one.
   subroutine find_root(solver, search, solution)
      class(contact_solver), intent(inout) :: solver
      type(root_search), intent(inout) :: search
      class(contact_solution), allocatable, intent(out) :: solution

      !> Of ln P/(1-P): the longest step, and the smallest that is not rounding.
      real(dp), parameter :: longest_step = 3.0_dp, shortest_step = 1e-13_dp
      real(dp), parameter :: flattest = 0.2_dp, steepest = 20.0_dp
      real(dp) :: error, high, last_miss, last_logit_p, low, met, miss, next
      integer :: i

      low = -huge(low)
      high = huge(high)
      last_logit_p = search%logit_p
      last_miss = 0.0_dp
      do i = 1, most_solves
         call solver%solve(1.0_dp/(1.0_dp + exp(-search%logit_p)), solution)
         met = solution%measures%contact_area_fraction
         error = solution%measures%contact_area_error
         if (search%of_gap) then
            met = 1.0_dp - solution%measures%mean_gap_over_amplitude
            error = solution%measures%mean_gap_error
         end if
         if (abs(met - search%target) <= allowed(error, search%target)) return
         miss = logit(met) - logit(search%target)
         if (i > 1 .and. abs(search%logit_p - last_logit_p) > 0.0_dp) &
            search%slope = min(max((miss - last_miss)/(search%logit_p - last_logit_p), flattest), steepest)
         last_logit_p = search%logit_p
         last_miss = miss
         if (miss > 0.0_dp) high = min(high, search%logit_p)
         if (miss < 0.0_dp) low = max(low, search%logit_p)
         next = search%logit_p - min(max(miss/search%slope, -longest_step), longest_step)
         if (next <= low .or. next >= high) next = 0.5_dp*(low + high)
         if (abs(next - search%logit_p) <= shortest_step*max(1.0_dp, abs(next))) exit
         search%logit_p = next
      end do
      ! The area of a grid may jump across the target as points enter the contact, by less than its error estimate. An
      ! estimate of one is the largest possible error and does not confirm that.
      if (abs(met - search%target) <= error .and. error < 1.0_dp) return
      if (solution%is_good()) solution%status = not_accurate
   end subroutine find_root

   !> The tolerance of a value.
   pure real(dp) function allowed(error, target)
      real(dp), intent(in) :: error   !! error estimate of the value; 0 if there is none
      real(dp), intent(in) :: target

      associate (scale => min(target, 1.0_dp - target))
         allowed = min(max(fraction_of_error*error, least_fraction*scale), largest_fraction*scale)
      end associate
   end function allowed

   !> ln x/(1-x). Values of 0 and 1, which a coarse solution may have, count as almost 0 and 1.
   pure real(dp) function logit(x)
      real(dp), intent(in) :: x

      real(dp), parameter :: least = 1e-15_dp

      logit = log(max(x, least)/max(1.0_dp - x, least))
   end function logit

end module wavycon_find_load
