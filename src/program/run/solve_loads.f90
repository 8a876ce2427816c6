!> Solves all loads of a scene and finds their largest stresses, partial slip and adhesion. If the ranks share the
!> loads, each rank solves its own loads and finds the stresses of these; afterwards all ranks have the numbers of all
!> loads.
module wavycon_solve_loads
   use wavycon_adhesive_contact, only: at_approach, at_load, closed, point_names, separated
   use wavycon_adhesive_curve, only: add_load, find_adhesive_solution, follow_curve
   use wavycon_checkpoint, only: checkpoint_file
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_find_load, only: solve_for
   use wavycon_find_percolation, only: solve_for_percolation
   use wavycon_find_yield, only: solve_for_yield
   use wavycon_gsl, only: ascending_order
   use wavycon_kinds, only: dp, int64
   use wavycon_largest_stress, only: find_largest_stresses
   use wavycon_partial_slip, only: solve_partial_slip
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_quantities, only: approach, contact_area, mean_gap
   use wavycon_results, only: results_type
   use wavycon_run_log, only: log_progress, run_log
   use wavycon_scene, only: by_mean_gap, by_percolation, by_yield
   use wavycon_solution_record, only: is_good_status, not_found, record_words
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_setting, only: stress_setting
   use wavycon_work_sharing, only: distributed_loads
   implicit none (type, external)
   private

   public :: find_interface, find_stresses, note_interface, order_loads, solve_loads, solve_target

   !> Number of loads of a block, if loads are distributed and each starts from the solution of the last one. The first
   !> load of a block starts without a solution. As the blocks do not depend on the number of ranks, the digits do not
   !> either.
   integer, parameter :: block_length = 8

   !> The quantity that is given for a load, for by_pressure, by_mean_gap, by_contact_area, by_yield, by_approach and
   !> by_percolation of wavycon_scene in this order; 0: not a quantity of the solution's record.
   integer, parameter :: quantity_of(*) = [0, mean_gap, contact_area, 0, approach, 0]
   !> The value of a point on the curve of adhesion that is given, in the same order; 0: the contact area fraction.
   integer, parameter :: coordinate_of(*) = [at_load, at_approach, 0, 0, at_approach, 0]

contains

   !> Sorts the loads from the highest to the lowest, so that each can start from the solution of the last one, and
   !> assigns them to the ranks if these share the loads.
   subroutine order_loads(results)
      type(results_type), intent(inout) :: results   !! with the started solver; gets `order`

      real(dp) :: sort_key(size(results%scene%target))   ! rises as the load falls

      sort_key = -results%scene%target
      if (results%scene%loads_by == by_mean_gap) sort_key = results%scene%target
      results%order = ascending_order(sort_key)
      call results%sharing%deal_loads(results%order, length_of_block(results))
   end subroutine order_loads

   !> The number of loads that one rank solves in a row: 1 if no load depends on the one before.
   pure integer function length_of_block(results) result(length)
      type(results_type), intent(in) :: results

      length = 1
      if (results%traits%continues_last_load) length = block_length
   end function length_of_block

   !> Solves all loads that are not known. If the loads are distributed, each rank solves its own loads and then gets
   !> the numbers of the others.
   subroutine solve_loads(results, known, checkpoint, logger)
      type(results_type), intent(inout) :: results       !! after order_loads
      logical, intent(in) :: known(:)                    !! whether the results already have the solution of each load
      type(checkpoint_file), intent(inout) :: checkpoint !! gets the solutions computed here
      type(run_log), intent(inout), target :: logger     !! shows the progress

      integer :: i, load
      integer(int64), allocatable :: words(:)   ! the records of all loads
      logical :: are_distributed
      type(log_progress), target :: progress

      are_distributed = results%sharing%kind == distributed_loads
      associate (target => results%scene%target, loads_by => results%scene%loads_by, solver => results%solver, &
                 order => results%order)
         if (are_distributed) call results%sharing%work_alone(.true.)
         if (loads_by == by_yield .and. results%scene%stress%largest%is_true) &
            allocate (results%largest_stresses(2, size(results%scene%stress_setting%body), size(order)))
         progress%log => logger
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
               if (allocated(results%largest_stresses)) then
                  call solve_for_yield(solver, results%scene%stress_setting, target(load), results%loads(load), &
                                       results%largest_stresses(:, :, load))
               else
                  call solve_target(solver, loads_by, target(load), results%loads(load), results%scene%stress_setting)
               end if
               call checkpoint%add(load, results%loads(load))
               progress%solved = progress%solved + 1
               progress%last = logger%elapsed()
            end if
         end do
         solver%progress => null()
      end associate
      if (.not. are_distributed) return
      call results%sharing%work_alone(.false.)
      ! Exchange the records: the numbers of a solution without its fields. A rank keeps the solutions of its own loads.
      allocate (words, source=[(transfer(results%loads(load)%solution_record, [0_int64]), load=1, size(results%loads))])
      call results%sharing%share_loads(words)
      do load = 1, size(results%loads)
         if (.not. results%sharing%is_own_load(load)) results%loads(load)%solution_record = &
            transfer(words((load - 1)*record_words + 1:load*record_words), results%loads(load)%solution_record)
      end do
   end subroutine solve_loads

   !> Solves one load, or finds and solves the load that has a given mean gap, approach, area or stress, or at
   !> which contact or gap begins or ends to percolate.
   subroutine solve_target(solver, loads_by, target, solution, setting)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: loads_by     !! by_pressure or another name of wavycon_scene
      real(dp), intent(in) :: target      !! the given value, as in the component of scene_type
      type(contact_solution), intent(out) :: solution
      type(stress_setting), intent(in), optional :: setting   !! with yield stresses; needed for by_yield

      if (loads_by == by_yield) then
         call solve_for_yield(solver, setting, target, solution)
      else if (loads_by == by_percolation) then
         call solve_for_percolation(solver, nint(target), solution)
      else if (quantity_of(loads_by) > 0) then
         call solve_for(solver, quantity_of(loads_by), target, solution)
      else
         call solver%solve(target, solution)
      end if
   end subroutine solve_target

   !> Finds the largest von Mises stress and the largest shear stress of each load and body, unless a search for yield
   !> has found them. If the loads are distributed, each rank does so for its own loads and then gets the stresses of
   !> the others.
   subroutine find_stresses(results, logger)
      type(results_type), intent(inout) :: results   !! with a group &stress and all loads solved with their fields
      type(run_log), intent(inout) :: logger         !! shows the progress

      class(stress_fields), allocatable :: fields
      integer :: body, load, number
      integer(int64), allocatable :: words(:)   ! the largest stresses of all loads
      logical :: are_distributed

      are_distributed = results%sharing%kind == distributed_loads
      if (are_distributed) call results%sharing%work_alone(.true.)
      associate (setting => results%scene%stress_setting)
         if (.not. allocated(results%largest_stresses)) &
            allocate (results%largest_stresses(2, size(setting%body), size(results%loads)))
         do load = 1, size(results%loads)
            if (.not. results%sharing%is_own_load(load)) cycle
            if (all(results%largest_stresses(:, :, load)%value > 0.0_dp)) cycle
            call results%loads(load)%stresses(results%solver%surface, fields)
            if (results%loads(load)%is_good() .and. .not. fields%exist) call logger%note( &
               'there is not enough memory for the stresses of load '//integer_text(load))
            do body = 1, size(setting%body)
               call find_largest_stresses(fields, setting%body(body), results%largest_stresses(1, body, load), &
                                          results%largest_stresses(2, body, load))
            end do
            call logger%say_progress('stresses of '//integer_text(load)//' of '//integer_text(size(results%loads))// &
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
                           results%loads(load)%status .and. .not. results%has_infinite_stress(load)), &
                      load=1, size(results%loads))])
      if (number > 0) call logger%note('the error of the largest stress is more than half of it'//of_loads(number)// &
                                       ': give a better accuracy, or more grid_points')
      number = count([(results%has_infinite_stress(load), load=1, size(results%loads))])
      if (number > 0) call logger%note('contact ends at a border or at a step'//of_loads(number)// &
                                       ', where stresses are infinite: the largest stress is that of the grid')

   contains

      !> At how many of the loads; empty for a single one, as the library asks load by load.
      function of_loads(number) result(words)
         integer, intent(in) :: number
         character(:), allocatable :: words

         words = ''
         if (size(results%loads) > 1) &
            words = ' at '//integer_text(number)//' of '//integer_text(size(results%loads))//' loads'
      end function of_loads

   end subroutine find_stresses

   !> Solves partial slip under all loads and tangential loads, or the contact with adhesion, if the deck asks for it.
   !>
   !> N.B. Other threads may be in the library meanwhile (c_lock.c): no function that returns a text is called unless
   !> the progress is shown.
   subroutine find_interface(results, logger, table)
      type(results_type), intent(inout) :: results   !! with a group &interface and all loads solved with their fields
      type(run_log), intent(inout) :: logger         !! shows the progress
      character(*), intent(in) :: table              !! name of a table that needs the results: with 'slip', 'adhesion'

      associate (setting => results%scene%interface_setting)
         if (setting%friction > 0.0_dp .and. index(table, 'slip') > 0) call find_slip(results, logger)
         if (setting%work > 0.0_dp .and. index(table, 'adhesion') > 0) call find_adhesion(results)
      end associate
   end subroutine find_interface

   !> Writes to the log what find_interface has found for a table.
   subroutine note_interface(results, logger, table)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: logger
      character(*), intent(in) :: table   !! as in find_interface

      associate (setting => results%scene%interface_setting)
         if (setting%friction > 0.0_dp .and. index(table, 'slip') > 0) then
            call note_slip(results, logger)
            call logger%say_timed('partial slip solved')
         end if
         if (setting%work > 0.0_dp .and. index(table, 'adhesion') > 0) then
            call note_adhesion(results, logger)
            call logger%say_timed('adhesion solved')
         end if
      end associate
   end subroutine note_interface

   !> Solves partial slip under all loads and tangential loads.
   subroutine find_slip(results, logger)
      type(results_type), intent(inout) :: results   !! gets `slip`
      type(run_log), intent(inout) :: logger

      integer :: i, load
      real(dp) :: tangential

      associate (setting => results%scene%interface_setting)
         allocate (results%slip(size(setting%tangential), size(results%loads)))
         do load = 1, size(results%loads)
            associate (solution => results%loads(load))
               do i = 1, size(setting%tangential)
                  if (logger%is_due()) call logger%say_progress('partial slip of '//integer_text(load)//' of '// &
                                                                integer_text(size(results%loads))//' loads')
                  tangential = setting%tangential(i)
                  if (setting%over_mean_pressure) tangential = tangential*solution%pbar_over_pstar
                  call solve_partial_slip(results%solver, setting%friction, solution, tangential, &
                                          results%scene%interface%slip_loop%is_true, results%slip(i, load))
               end do
            end associate
         end do
      end associate
   end subroutine find_slip

   !> Notes where the bodies slide, and what is doubtful of partial slip.
   subroutine note_slip(results, logger)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: logger

      integer :: bad, i, load

      associate (beta => results%scene%interface_setting%beta)
         if (abs(beta) > 0.0_dp) call logger%note('partial slip neglects the coupling of normal and '// &
            "tangential displacements of unlike bodies, Dundurs' beta = "//short_number(beta))
         do load = 1, size(results%slip, 2)
            do i = 1, size(results%slip, 1)
               if (results%slip(i, load)%slides) call logger%note( &
                  'under load '//integer_text(load)//' tangential load '//integer_text(i)// &
                  ' is more than friction times the mean pressure: the bodies slide')
            end do
         end do
         bad = count(.not. (results%slip%slides .or. is_good_status(results%slip%status)))
         if (bad > 0) call logger%note('partial slip is NOT solved as requested under '//integer_text(bad)//' of '// &
            integer_text(size(results%slip))//' tangential loads, see the status in partial_slip')
      end associate
   end subroutine note_slip

   !> Computes the curve of the contact with adhesion and its contacts at the deck's loads. Mean pressures, gaps,
   !> approaches or areas of the deck are those of the contact with adhesion. A session, which calls this for each of
   !> its tables, follows a curve that takes time only once.
   subroutine find_adhesion(results)
      type(results_type), intent(inout) :: results   !! gets `adhesion` and `adhesive_loads`

      integer :: given, i   ! given: which value of a point on the curve the loads give
      logical :: is_followed
      real(dp), allocatable :: loads(:)

      if (allocated(results%adhesive_loads)) deallocate (results%adhesive_loads)
      if (.not. allocated(results%adhesion)) allocate (results%adhesion)
      allocate (results%adhesive_loads(size(results%loads)))
      associate (work => results%scene%interface_setting%work, curve => results%adhesion, &
                 surface => results%solver%surface, accuracy => results%scene%method%accuracy%number)
         loads = results%scene%target
         given = coordinate_of(results%scene%loads_by)
         if (results%scene%loads_by == by_mean_gap) loads = 1.0_dp - loads
         ! A curve in closed form takes no time, but ends at the largest load.
         is_followed = allocated(curve%at_loads) .and. .not. curve%problem%has_closed_form
         if (is_followed) curve%at_loads = curve%at_loads(:0)
         if (.not. is_followed) &
            call follow_curve(surface, accuracy, work, maxval(results%loads%pbar_over_pstar), curve)
         do i = 1, size(loads)
            call add_load(curve, given, loads(i), i)
            call find_adhesive_solution(curve, given, i, results%adhesive_loads(i))
         end do
      end associate
   end subroutine find_adhesion

   !> Writes to the log how the contacts with adhesion are, and the critical points of their curve.
   subroutine note_adhesion(results, logger)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: logger

      integer, parameter :: without_edge(*) = [separated, closed]
      character(:), allocatable :: words   ! load and area of a critical point; with free edges the load is a force
      integer :: bad, i, number
      real(dp) :: mean_pressure

      associate (curve => results%adhesion, surface => results%solver%surface)
         call logger%say('adhesion: the contacts of the loads are in the table of adhesion, those above are without it')
         bad = count(.not. is_good_status(curve%at_loads%status))
         if (bad > 0) call logger%note('adhesion is NOT solved as requested at '//integer_text(bad)//' of '// &
            integer_text(size(curve%at_loads))//' contacts of the loads, see the status in adhesion')
         do i = 1, size(without_edge)
            number = count(curve%at_loads%kind == without_edge(i))
            if (number > 0) call logger%say('adhesion: '//trim(point_names(without_edge(i)))//' at '// &
               integer_text(number)//' of '//integer_text(size(results%loads))//' loads')
         end do
         if (any(curve%critical%status == not_found)) call logger%note('adhesion: NOT all jumps and pull-offs are '// &
            'found, see the status of the critical points in adhesion')
         do i = 1, size(curve%critical)
            associate (point => curve%critical(i))
               if (.not. point%exists) cycle
               mean_pressure = results%scene%p_star*point%value(at_load)
               words = ', pbar/p* = '//short_number(point%value(at_load))//', pbar = '//short_number(mean_pressure)// &
                       ' ['//results%scene%pressure_unit//'], area/A0 = '//short_number(point%area)
               if (surface%has_free_edges) words = ', force = '// &
                  short_number(mean_pressure*surface%nominal_area())//', area = '// &
                  short_number(surface%nominal_area()*point%area)
               call logger%say('adhesion: '//trim(point_names(point%kind))//words)
            end associate
         end do
      end associate
   end subroutine note_adhesion

end module wavycon_solve_loads
