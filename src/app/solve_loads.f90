!> All loads of a scene, those that a checkpoint knows and those that it does not.
module wavycon_solve_loads
   use, intrinsic :: iso_c_binding, only: c_size_t
   use wavycon_checkpoint, only: checkpoint_file
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_state, only: by_grid, contact_state
   use wavycon_find_load, only: solve_for_contact_area, solve_for_mean_gap
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fourier_contact, only: fourier_contact
   use wavycon_grid_contact, only: grid_contact
   use wavycon_gsl, only: gsl_sort_index
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: by_contact_area, by_mean_gap, by_pressure
   use wavycon_results, only: results_type
   use wavycon_run_log, only: log_progress, run_log
   implicit none (type, external)
   private

   public :: solve_loads

contains

   !> Solves and measures all loads, from the highest to the lowest so that each starts from the one before.
   subroutine solve_loads(results, known, checkpoint, log)
      type(results_type), intent(inout) :: results
      logical, intent(in) :: known(:)                    !! loads whose states `results` has, of an interrupted run
      type(checkpoint_file), intent(inout) :: checkpoint !! that the other loads are written to
      type(run_log), intent(inout), target :: log

      integer :: i, load, order(size(known))
      type(log_progress), target :: progress

      associate (target => results%scene%target, loads_by => results%scene%loads_by)
         order = descending(merge(-target, target, loads_by == by_mean_gap))
         progress%log => log
         progress%loads = size(order)
         select type (solver => results%contact)
         type is (grid_contact)
            solver%progress => progress
         type is (fitted_contact)
            if (allocated(solver%grids)) solver%grids%progress => progress
         end select
         do i = 1, size(order)
            load = order(i)
            progress%load = i
            if (known(load)) then
               call retrace(results%contact, loads_by, target(load), results%states(load))
            else
               call solve_one(results%contact, loads_by, target(load), results%states(load))
               call checkpoint%add(load, results%states(load))
            end if
            call log%show_progress(i, size(order))
         end do
         select type (solver => results%contact)
         type is (grid_contact)
            nullify (solver%progress)
         type is (fitted_contact)
            if (allocated(solver%grids)) nullify (solver%grids%progress)
         end select
      end associate
   end subroutine solve_loads

   subroutine solve_one(solver, loads_by, target, state)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: loads_by     !! a name of wavycon_load_group
      real(dp), intent(in) :: target      !! P, G or the contact area fraction
      type(contact_state), intent(out) :: state

      select case (loads_by)
      case (by_mean_gap)
         call solve_for_mean_gap(solver, target, state)
      case (by_contact_area)
         call solve_for_contact_area(solver, target, state)
      case default
         call solver%solve(target, state)
      end select
   end subroutine solve_one

   !> Brings a solver to where it was after a load. Only those that start each load from the one before have
   !> to go the way again: the series' and the expansions' last digits, and their pivots, depend on it. What
   !> takes long are grids, and these are left out, but where an expansion's loads were looked for with their
   !> help.
   subroutine retrace(solver, loads_by, target, state)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: loads_by
      real(dp), intent(in) :: target
      type(contact_state), intent(inout) :: state   !! as the checkpoint has it

      type(contact_state) :: again
      type(grid_contact), allocatable :: grids

      select type (solver)
      type is (fourier_contact)
         call solve_one(solver, loads_by, target, state)
      type is (fitted_contact)
         if (loads_by /= by_pressure) then
            call solve_one(solver, loads_by, target, state)
            return
         end if
         call move_alloc(solver%grids, grids)
         call solver%solve(target, again)
         call move_alloc(grids, solver%grids)
         if (state%solver /= by_grid) state = again
      end select
   end subroutine retrace

   !> The order of some numbers from the largest to the smallest.
   function descending(values) result(order)
      real(dp), intent(in) :: values(:)
      integer :: order(size(values))

      integer(c_size_t) :: places(size(values))

      call gsl_sort_index(places, -values, 1_c_size_t, size(values, kind=c_size_t))
      order = int(places) + 1
   end function descending

end module wavycon_solve_loads
