!> Solves all loads of a scene.
module wavycon_solve_loads
   use, intrinsic :: iso_c_binding, only: c_size_t
   use wavycon_checkpoint, only: checkpoint_file
   use wavycon_gsl, only: gsl_sort_index
   use wavycon_kinds, only: dp
   use wavycon_results, only: results_type
   use wavycon_run_log, only: log_progress, run_log
   use wavycon_scene, only: by_mean_gap
   use wavycon_share_solutions, only: share_solutions
   use wavycon_solve_target, only: solve_target
   use wavycon_work_sharing, only: distributed_loads
   implicit none (type, external)
   private

   public :: order_loads, solve_loads

   !> Loads of a block where each starts from the last one and loads are distributed. The first of a block starts as the
   !> first load of a sweep does. The length does not depend on who solves the block, and so the digits do not.
   integer, parameter :: block_length = 8

contains

   !> Orders the loads from the highest to the lowest, so that each can start from the last one, and deals them to the
   !> ranks if these share them.
   subroutine order_loads(results)
      type(results_type), intent(inout) :: results   !! with the solver started

      associate (target => results%scene%target)
         results%order = descending(merge(-target, target, results%scene%loads_by == by_mean_gap))
      end associate
      call results%sharing%deal_loads(results%order, length_of_block(results))
   end subroutine order_loads

   pure integer function length_of_block(results) result(length)
      type(results_type), intent(in) :: results

      length = merge(block_length, 1, results%traits%continues_last_load)
   end function length_of_block

   !> Solves and measures all loads that are not known. Where the loads are distributed, solves the own ones and takes
   !> the measures of the others.
   subroutine solve_loads(results, known, checkpoint, log)
      type(results_type), intent(inout) :: results       !! after order_loads
      logical, intent(in) :: known(:)                    !! of each load: whether the results have its solution
      type(checkpoint_file), intent(inout) :: checkpoint !! the solutions computed here are added to it
      type(run_log), intent(inout), target :: log        !! shows the progress

      integer :: i, load
      logical :: are_distributed
      type(log_progress), target :: progress

      are_distributed = results%sharing%kind == distributed_loads
      associate (target => results%scene%target, loads_by => results%scene%loads_by, solver => results%solver, &
                 order => results%order)
         if (are_distributed) call results%sharing%work_alone(.true.)
         progress%log => log
         progress%loads = size(order)
         solver%progress => progress
         do i = 1, size(order)
            load = order(i)
            if (.not. results%sharing%is_own_load(load)) cycle
            if (are_distributed .and. mod(i - 1, length_of_block(results)) == 0) call solver%forget_last_load()
            progress%load = i
            if (known(load)) then
               call solver%skip_load(target(load))
            else
               call solve_target(solver, loads_by, target(load), results%loads(load), &
                                 results%scene%stress_setting)
               call checkpoint%add(load, results%loads(load))
               progress%solved = progress%solved + 1
               progress%last = log%elapsed()
            end if
         end do
         solver%progress => null()
      end associate
      if (.not. are_distributed) return
      call results%sharing%work_alone(.false.)
      call share_solutions(results)
   end subroutine solve_loads

   !> The indices of an array from its largest to its smallest value.
   function descending(values) result(order)
      real(dp), intent(in) :: values(:)
      integer :: order(size(values))

      integer(c_size_t) :: places(size(values))

      call gsl_sort_index(places, -values, 1_c_size_t, size(values, kind=c_size_t))
      order = int(places) + 1
   end function descending

end module wavycon_solve_loads
