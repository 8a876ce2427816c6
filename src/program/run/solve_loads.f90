!> Solves all loads of a scene and finds their largest stresses, partial slip and adhesion. Where the ranks share the
!> loads, each solves its own and finds their stresses, and all then have the results.
module wavycon_solve_loads
   use, intrinsic :: iso_c_binding, only: c_size_t
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_adhesive_contact, only: at_approach, at_load, point_names
   use wavycon_adhesive_curve, only: add_load, find_adhesive_solution, follow_curve
   use wavycon_checkpoint, only: checkpoint_file
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: is_good_status
   use wavycon_find_load, only: solve_for
   use wavycon_find_yield, only: solve_for_yield
   use wavycon_gsl, only: gsl_sort_index
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: find_largest_stresses
   use wavycon_partial_slip, only: solve_partial_slip
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_quantities, only: approach, contact_area, mean_gap
   use wavycon_results, only: results_type
   use wavycon_run_log, only: log_progress, run_log
   use wavycon_scene, only: by_approach, by_mean_gap, by_pressure, by_yield
   use wavycon_solution_record, only: record_words
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_setting, only: stress_setting
   use wavycon_work_sharing, only: distributed_loads
   implicit none (type, external)
   private

   public :: find_interface, find_stresses, order_loads, solve_loads, solve_target

   !> Loads of a block where each starts from the last one and loads are distributed. The first of a block starts as the
   !> first load of a sweep does. The length does not depend on who solves the block, and so the digits do not.
   integer, parameter :: block_length = 8

   !> The quantity of the record by which loads are given, in the order of the names of wavycon_scene; 0: there is none.
   integer, parameter :: quantity_of(*) = [0, mean_gap, contact_area, 0, approach]

contains

   !> Orders the loads from the highest to the lowest, so that each can start from the last one, and deals them to the
   !> ranks if these share them.
   subroutine order_loads(results)
      type(results_type), intent(inout) :: results   !! with the solver started

      integer(c_size_t) :: places(size(results%scene%target))

      associate (target => results%scene%target)
         call gsl_sort_index(places, merge(target, -target, results%scene%loads_by == by_mean_gap), 1_c_size_t, &
                             size(places, kind=c_size_t))
      end associate
      results%order = int(places) + 1
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
      integer(int64), allocatable :: words(:)   ! the measures of all loads
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
               call solve_target(solver, loads_by, target(load), results%loads(load), results%scene%stress_setting)
               call checkpoint%add(load, results%loads(load))
               progress%solved = progress%solved + 1
               progress%last = log%elapsed()
            end if
         end do
         solver%progress => null()
      end associate
      if (.not. are_distributed) return
      call results%sharing%work_alone(.false.)
      ! A rank keeps the solutions of its own loads as they are.
      allocate (words, source=[(transfer(results%loads(load)%solution_record, [0_int64]), load=1, size(results%loads))])
      call results%sharing%share_loads(words)
      do load = 1, size(results%loads)
         if (.not. results%sharing%is_own_load(load)) results%loads(load)%solution_record = &
            transfer(words((load - 1)*record_words + 1:load*record_words), results%loads(load)%solution_record)
      end do
   end subroutine solve_loads

   !> Solves one load, or finds the load of a given mean gap, approach, area or stress.
   subroutine solve_target(solver, loads_by, target, solution, setting)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: loads_by     !! a name of wavycon_scene
      real(dp), intent(in) :: target      !! as of scene_type
      type(contact_solution), intent(out) :: solution
      type(stress_setting), intent(in), optional :: setting   !! needed by_yield, with yield stresses

      if (loads_by == by_yield) then
         call solve_for_yield(solver, setting, target, solution)
      else if (quantity_of(loads_by) > 0) then
         call solve_for(solver, quantity_of(loads_by), target, solution)
      else
         call solver%solve(target, solution)
      end if
   end subroutine solve_target

   !> Finds the largest von Mises stress and the largest shear stress of each load and body, of the own loads, and
   !> takes those of the others.
   subroutine find_stresses(results, log)
      type(results_type), intent(inout) :: results   !! with a group &stress and all loads solved with their fields
      type(run_log), intent(inout) :: log            !! shows the progress

      class(stress_fields), allocatable :: fields
      integer :: body, load, number
      integer(int64), allocatable :: words(:)   ! the largest stresses of all loads
      logical :: are_distributed

      are_distributed = results%sharing%kind == distributed_loads
      if (are_distributed) call results%sharing%work_alone(.true.)
      associate (setting => results%scene%stress_setting)
         allocate (results%largest_stresses(2, size(setting%body), size(results%loads)))
         do load = 1, size(results%loads)
            if (.not. results%sharing%is_own_load(load)) cycle
            call results%loads(load)%stresses(results%solver%surface, fields)
            if (results%loads(load)%is_good() .and. .not. fields%exist) call log%note( &
               'there is not enough memory for the stresses of load '//integer_text(load))
            do body = 1, size(setting%body)
               call find_largest_stresses(fields, setting%body(body), results%largest_stresses(1, body, load), &
                                          results%largest_stresses(2, body, load))
            end do
            call log%say_progress('stresses of '//integer_text(load)//' of '//integer_text(size(results%loads))// &
                                  ' loads')
         end do
      end associate
      if (are_distributed) then
         call results%sharing%work_alone(.false.)
         associate (stresses => results%largest_stresses)
            words = transfer(stresses, [0_int64])
            call results%sharing%share_loads(words)
            stresses = reshape(transfer(words, stresses), shape(stresses))
         end associate
      end if
      number = count([(any([(results%stress_status(load, body), body=1, size(results%largest_stresses, 2))] /= &
                           results%loads(load)%status), load=1, size(results%loads))])
      if (number > 0) call log%note('the error of the largest stress is more than half of it at '// &
         integer_text(number)//' of '//integer_text(size(results%loads))//' loads: give a better accuracy, or more '// &
         'grid_points')
   end subroutine find_stresses

   !> Solves partial slip of all loads and tangential loads, and the curve of the contact with adhesion.
   subroutine find_interface(results, log, table)
      type(results_type), intent(inout) :: results   !! with a group &interface and all loads solved with their fields
      type(run_log), intent(inout) :: log            !! shows the progress
      character(*), intent(in) :: table              !! the one table that it is for; '': all

      associate (setting => results%scene%interface_setting)
         if (setting%friction > 0.0_dp .and. (table == '' .or. index(table, 'slip') > 0)) then
            call find_slip(results, log)
            call log%say_timed('partial slip solved')
         end if
         if (setting%work > 0.0_dp .and. (table == '' .or. index(table, 'adhesion') > 0)) then
            call find_adhesion(results, log)
            call log%say_timed('adhesion solved')
         end if
      end associate
   end subroutine find_interface

   subroutine find_slip(results, log)
      type(results_type), intent(inout) :: results
      type(run_log), intent(inout) :: log

      integer :: bad, i, load

      associate (setting => results%scene%interface_setting)
         if (abs(setting%beta) > 0.0_dp) call log%note('partial slip neglects the coupling of normal and '// &
            "tangential displacements of unlike bodies, Dundurs' beta = "//short_number(setting%beta))
         allocate (results%slip(size(setting%tangential), size(results%loads)))
         do load = 1, size(results%loads)
            associate (solution => results%loads(load))
               do i = 1, size(setting%tangential)
                  call log%say_progress('partial slip of '//integer_text(load)//' of '// &
                                        integer_text(size(results%loads))//' loads')
                  call solve_partial_slip(results%solver, setting%friction, solution, setting%tangential(i)* &
                                          merge(solution%pbar_over_pstar, 1.0_dp, setting%over_mean_pressure), &
                                          results%scene%interface%slip_loop%is_true, results%slip(i, load))
                  if (results%slip(i, load)%slides) call log%note( &
                     'under load '//integer_text(load)//' tangential load '//integer_text(i)// &
                     ' is more than friction times the mean pressure: the bodies slide')
               end do
            end associate
         end do
         bad = count(.not. (results%slip%slides .or. is_good_status(results%slip%status)))
         if (bad > 0) call log%note('partial slip is NOT solved as requested under '//integer_text(bad)//' of '// &
            integer_text(size(results%slip))//' tangential loads, see the status column')
      end associate
   end subroutine find_slip

   !> The loads are the mean pressures of the contact with adhesion.
   subroutine find_adhesion(results, log)
      type(results_type), intent(inout) :: results
      type(run_log), intent(inout) :: log

      character(:), allocatable :: words   ! the load, with free edges as a force, and the area
      integer :: bad, i, which
      real(dp) :: mean_pressure
      real(dp), allocatable :: loads(:)

      if (allocated(results%adhesive_loads)) deallocate (results%adhesive_loads)
      allocate (results%adhesion, results%adhesive_loads(size(results%loads)))
      associate (work => results%scene%interface_setting%work, curve => results%adhesion, &
                 surface => results%solver%surface, accuracy => results%scene%method%accuracy%number)
         loads = results%scene%target
         select case (results%scene%loads_by)
         case (by_pressure)
            which = at_load
         case (by_approach)
            which = at_approach
         case (by_mean_gap)
            which = at_approach
            loads = 1.0_dp - loads
         case default
            which = 0   ! the contact area fraction
         end select
         call follow_curve(surface, accuracy, work, maxval(results%loads%pbar_over_pstar), curve)
         do i = 1, size(loads)
            call add_load(curve, which, loads(i), i)
            call find_adhesive_solution(curve, which, i, results%adhesive_loads(i))
         end do
         call log%say('adhesion: the contacts of the loads are in the table of adhesion, those above are without it')
         bad = count(.not. is_good_status(curve%at_loads%status))
         if (bad > 0) call log%note('adhesion is NOT solved as requested at '//integer_text(bad)//' of '// &
            integer_text(size(curve%at_loads))//' contacts of the loads, see the status column')
         do i = 1, size(curve%critical)
            associate (point => curve%critical(i))
               mean_pressure = results%scene%p_star*point%value(at_load)
               words = ', pbar/p* = '//short_number(point%value(at_load))//', pbar = '//short_number(mean_pressure)// &
                       ' ['//results%scene%pressure_unit//'], area/A0 = '//short_number(point%area)
               if (surface%has_free_edges) words = ', force = '// &
                  short_number(mean_pressure*surface%nominal_area())//', area = '// &
                  short_number(surface%nominal_area()*point%area)
               call log%say('adhesion: '//trim(point_names(point%kind))//words)
            end associate
         end do
      end associate
   end subroutine find_adhesion

end module wavycon_solve_loads
