!> Finds the load at which the contact first percolates, or from which on the gap no longer percolates.
!>
!> Whether a region percolates jumps with the load, so that the bracket of the jump is halved in logit P: (C18a) of
!> README.md in this directory.
module wavycon_find_percolation
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_spots, only: contact_spots
   use wavycon_contact_tuning, only: change_safety, coarse_fraction, lightest_load, most_solves, part_of_area_error, &
      percolation_safety, value_roundings, widest_bracket
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: contact_area, last_before, percolation
   use wavycon_solution_record, only: not_accurate, not_found
   implicit none (type, external)
   private

   public :: solve_for_percolation

   !> What may percolate: the contact or the gap, along x or y, or along one axis. Loads are given by places in this
   !> list.
   character(*), parameter, public :: percolations(6) = [character(9) :: 'contact', 'contact_x', 'contact_y', 'gap', &
      'gap_x', 'gap_y']

   !> Least slope of logit A against logit P (C18), that of a line contact at light load.
   real(dp), parameter :: least_slope = 0.5_dp
   !> In place of `part_of_area_error` where the load past the jump misses the accuracy, so that the bracket adds at
   !> most half of the told error: more loads there take the most time, and none meets the accuracy. Of the square wave
   !> to 1e-6 and 1e-8 three loads are saved, a third of the time, and the told error is 7.5e-6, otherwise 5.3e-6.
   real(dp), parameter :: part_if_inaccurate = 2.0_dp
   !> Points of a given grid along each side, on a quarter of an even cell, from which on the search begins with half of
   !> them at least. With fewer there are not the three grids of an error estimate.
   integer, parameter :: least_halved = 32

contains

   !> Solves for the load at which the contact begins or the gap ends to percolate. The search goes through the coarser
   !> levels of the solver and then to full accuracy, and begins at each level with the load of the level before.
   !>
   !> The solution is that of the least load found at which the contact percolates, or the gap does not, and has two
   !> quantities more. `last_before` is the largest load below for which the contrary was found. `percolation` is the
   !> load of the solution, with the error (C18b). The status is not_found, and both quantities are unknown, if no load
   !> or every load is past the jump; the load is then the last one tried. A load without spots ends the search with its
   !> status, with not_accurate if the solver has found no solution.
   subroutine solve_for_percolation(solver, what, solution)
      class(contact_solver), intent(inout) :: solver    !! started with keep_fields, on a periodic surface in 2-D
      integer, intent(in) :: what                       !! place in `percolations`
      type(contact_solution), intent(out) :: solution

      logical :: ends
      real(dp) :: before, change, last, logit_p
      type(solver_traits) :: traits

      call solver%begin_search()
      ! The area does not tell the error of the last neck, (C18b): it shows on half the points.
      traits = solver%traits()
      associate (grid => traits%given_grid)
         if (all(grid >= least_halved .and. mod(grid, 2) == 0)) solver%level = max(solver%level, 1)
      end associate
      logit_p = 0.0_dp
      before = -1.0_dp
      change = 0.0_dp
      do
         last = solution%pbar_over_pstar   ! 0 before the first level
         call halve_bracket(solver, what, logit_p, before, solution)
         if (last > 0.0_dp) change = abs(solution%pbar_over_pstar - last)
         call solver%next_level(is_over=before < 0.0_dp, ends=ends)
         if (ends) exit
      end do
      if (before < 0.0_dp) return
      solution%value(last_before) = before
      solution%value(percolation) = solution%pbar_over_pstar
      associate (a => solution%value(contact_area), p => solution%pbar_over_pstar)
         ! An area that its error does not tell from 0 or 1 says nothing of the load; nor does an unknown error.
         if (.not. solution%error(contact_area) < min(a, 1.0_dp - a)) return
         solution%error(percolation) = p - before + max(change_safety*change, percolation_safety* &
                                                        p*abs(1.0_dp - p)*logit_error(solution))
      end associate
   end subroutine solve_for_percolation

   !> Searches at one level. Steps away from the first load double until a bracket is found, which is then halved until
   !> its width hardly adds to the error of the load, (C18a).
   subroutine halve_bracket(solver, what, logit_p, before, solution)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: what                       !! place in `percolations`
      real(dp), intent(inout) :: logit_p                !! logit P: of the first load, on return of the solution
      real(dp), intent(out) :: before                   !! P of the last load before the jump; -1: not found
      type(contact_solution), intent(out) :: solution   !! past the jump

      integer :: i
      real(dp) :: high, low, most, part, step, tolerance
      type(contact_solution) :: now
      type(contact_spots) :: regions

      most = min(1.0_dp, solver%surface%hardness)
      low = -huge(low)
      high = huge(high)
      tolerance = widest_bracket
      step = coarse_fraction
      before = -1.0_dp
      do i = 1, most_solves
         call solver%solve(most/(1.0_dp + exp(-logit_p)), now)
         call now%spots(solver%surface, regions)
         if (.not. allocated(regions%spots)) then
            ! The solver failed: that says nothing of the side on which the jump is.
            if (now%status == not_found) now%status = not_accurate
            exit
         end if
         if (is_past(regions, what)) then
            high = logit_p
            call now%move_to(solution)
            part = part_of_area_error
            if (solution%status == not_accurate) part = part_if_inaccurate
            tolerance = max(value_roundings*epsilon(high), min(part*logit_error(solution), widest_bracket))
         else
            low = logit_p
            before = now%pbar_over_pstar
         end if
         if (high - low <= tolerance) then
            logit_p = high
            return
         end if
         if (low > -huge(low) .and. high < huge(high)) then
            logit_p = 0.5_dp*(low + high)
         else
            logit_p = logit_p + merge(step, -step, low > -huge(low))
            step = 2*step
            if (abs(logit_p) > abs(log(lightest_load))) now%status = not_found
            if (now%status == not_found) exit
         end if
      end do
      before = -1.0_dp
      call now%move_to(solution)
   end subroutine halve_bracket

   !> The error of logit P that follows from that of the area of contact, (C18b).
   pure real(dp) function logit_error(solution)
      type(contact_solution), intent(in) :: solution

      associate (area => solution%value(contact_area))
         logit_error = solution%error(contact_area)/(least_slope*max(area*(1.0_dp - area), epsilon(area)))
      end associate
   end function logit_error

   !> Whether the regions are those of loads past the jump: the contact percolates, or the gap does not.
   pure logical function is_past(regions, what)
      type(contact_spots), intent(in) :: regions
      integer, intent(in) :: what   !! place in `percolations`

      integer :: axis, i
      logical :: along(2)

      along = [(any(regions%spots%percolates(i)), i=1, 2)]
      if (what > 3) along = [(.not. any(regions%pools%percolates(i)), i=1, 2)]
      axis = mod(what - 1, 3)
      if (axis > 0) along = along(axis)
      is_past = any(along)
      if (what > 3) is_past = all(along)
   end function is_past

end module wavycon_find_percolation
