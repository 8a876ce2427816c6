!> Solves what a scene asks of the interface beyond its loads: partial slip and adhesion.
module wavycon_find_interface
   use wavycon_adhesive_curve, only: add_load, adhesive_point, follow_curve, point_names
   use wavycon_kinds, only: dp
   use wavycon_partial_slip, only: solve_partial_slip
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   implicit none (type, external)
   private

   public :: find_interface

contains

   !> Solves partial slip of all loads and tangential loads, and the curve of the contact with adhesion.
   subroutine find_interface(results, log, table)
      type(results_type), intent(inout) :: results   !! with a group &interface and all loads solved with their fields
      type(run_log), intent(inout) :: log            !! shows the progress
      character(*), intent(in), optional :: table    !! the one table that it is for

      logical :: of_adhesion, of_slip

      of_slip = .true.
      of_adhesion = .true.
      if (present(table)) then
         of_slip = index(table, 'slip') > 0
         of_adhesion = table == 'adhesion'
      end if
      associate (setting => results%scene%interface_setting)
         if (of_slip .and. setting%friction > 0.0_dp) then
            call find_slip(results, log)
            call log%say_timed('partial slip solved')
         end if
         if (of_adhesion .and. setting%work > 0.0_dp) then
            call find_adhesion(results, log)
            call log%say_timed('adhesion solved')
         end if
      end associate
   end subroutine find_interface

   subroutine find_slip(results, log)
      type(results_type), intent(inout) :: results
      type(run_log), intent(inout) :: log

      integer :: i, load

      associate (setting => results%scene%interface_setting)
         if (abs(setting%beta) > 0.0_dp) call log%say('note: partial slip neglects the coupling of normal and '// &
            "tangential displacements of unlike bodies, Dundurs' beta = "//short_number(setting%beta))
         allocate (results%slip(size(setting%tangential), size(results%loads)))
         do load = 1, size(results%loads)
            associate (solution => results%loads(load))
               do i = 1, size(setting%tangential)
                  call log%say_progress('partial slip of '//integer_text(load)//' of '// &
                                        integer_text(size(results%loads))//' loads')
                  call solve_partial_slip(results%solver, setting, solution, setting%tangential(i)* &
                                          merge(solution%pbar_over_pstar, 1.0_dp, setting%over_mean_pressure), &
                                          results%scene%interface%logical('slip_loop'), results%slip(i, load))
                  if (results%slip(i, load)%stick%pbar_over_pstar < 0.0_dp) call log%say( &
                     'note: under load '//integer_text(load)//' tangential load '//integer_text(i)// &
                     ' is more than friction times the mean pressure: the bodies slide')
               end do
            end associate
         end do
      end associate
   end subroutine find_slip

   !> The loads are the mean pressures of the contact with adhesion.
   subroutine find_adhesion(results, log)
      type(results_type), intent(inout) :: results
      type(run_log), intent(inout) :: log

      integer :: i

      allocate (results%adhesion)
      associate (work => results%scene%interface_setting%work, curve => results%adhesion, &
                 loads => results%loads%pbar_over_pstar)
         call follow_curve(results%solver, work, maxval(loads), curve)
         do i = 1, size(loads)
            call add_load(curve, results%solver, work, loads(i), i)
         end do
         if (.not. all(curve%points%exists)) call log%say('note: '// &
            integer_text(count(.not. curve%points%exists))//' of '//integer_text(size(curve%points))// &
            ' points of the curve have no solution')
         do i = 1, size(curve%critical)
            call log%say('adhesion: '//trim(point_names(curve%critical(i)%kind))//words_of_point(curve%critical(i)))
         end do
      end associate
   contains

      !> The load, with free edges as a force, and the area.
      function words_of_point(point) result(words)
         type(adhesive_point), intent(in) :: point
         character(:), allocatable :: words

         associate (surface => results%solver%surface, mean_pressure => results%scene%p_star*point%load)
            if (surface%has_free_edges) then
               words = ', force = '//short_number(mean_pressure*surface%nominal_area())//', area = '// &
                       short_number(surface%nominal_area()*point%area)
            else
               words = ', pbar/p* = '//short_number(point%load)//', pbar = '//short_number(mean_pressure)// &
                       ' ['//results%scene%pressure_unit//'], area/A0 = '//short_number(point%area)
            end if
         end associate
      end function words_of_point

   end subroutine find_adhesion

end module wavycon_find_interface
