!> The table of the log: the solved loads.
module wavycon_result_lines
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_status, only: status_name
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_solution_record, only: solver_names
   implicit none (type, external)
   private

   public :: show_loads

contains

   !> A line for each load: mean gap, area and peak pressure, each followed by its error estimate if the solver has
   !> them; mean and peak pressure in the deck's unit if the deck gives a modulus; solver and status. With free edges
   !> force, approach, area and peak pressure in the deck's units.
   subroutine show_loads(results, log)
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(run_log), intent(inout) :: log

      character(9) :: names(3)
      character(:), allocatable :: head, line
      integer :: i, load, solver_width
      real(dp) :: approach(2), errors(3), unit(3), values(3)

      if (log%quiet) return
      ! The longest name of a solver among the loads.
      solver_width = max(len('solver'), maxval(len_trim(solver_names(results%loads%solver))))
      names = [character(9) :: 'gap/Delta', 'area/A0', 'peak/p*']
      unit = 1.0_dp
      associate (surface => results%solver%surface, scene => results%scene)
         if (surface%has_free_edges) then
            names = [character(9) :: 'approach', 'area', 'peak']
            unit = [surface%amplitude, surface%nominal_area(), scene%p_star]
         end if
         do load = 1, size(results%loads)
            associate (measures => results%loads(load)%measures)
               values = [measures%mean_gap_over_amplitude, measures%contact_area_fraction, &
                         measures%peak_pressure_over_pstar]
               errors = or_nan(measures%errors())
            end associate
            head = ''
            line = ''
            if (surface%has_free_edges) then
               approach = results%approach_over_amplitude(load)
               values(1) = approach(1)
               errors(1) = approach(2)
               call add('force', surface%nominal_area()*results%mean_pressure(load))
            else
               call add('pbar/p*', results%loads(load)%pbar_over_pstar)
               if (scene%gives_modulus) call add('pbar['//scene%pressure_unit//']', results%mean_pressure(load))
            end if
            do i = 1, size(names)
               call add(trim(names(i)), unit(i)*values(i))
               if (results%traits%has_errors) call add('error', unit(i)*errors(i))
            end do
            if (scene%gives_modulus .and. .not. surface%has_free_edges) &
               call add('peak['//scene%pressure_unit//']', results%peak_pressure(load))
            if (load == 1) call log%say(head//' solver'//repeat(' ', solver_width - len('solver') + 2)//'status')
            call log%say(line//' '//solver_names(results%loads(load)%solver)(:solver_width)//'  '// &
                         trim(status_name(results%loads(load)%status)))
         end do
      end associate

   contains

      !> Adds a number at the right of a column; of an error estimate two digits, and '-' if it is unknown.
      subroutine add(name, number)
         character(*), intent(in) :: name
         real(dp), intent(in) :: number

         character(12) :: buffer
         character(:), allocatable :: words
         integer :: width
         real(dp) :: rounded

         width = max(13, len(name) + 2)
         words = short_number(number)
         if (name == 'error') then
            width = 9
            write (buffer, '(es12.1e3)') number
            read (buffer, *) rounded
            words = short_number(rounded)
            if (ieee_is_nan(number)) words = '-'
         end if
         head = head//repeat(' ', max(0, width - len(name)))//name
         line = line//repeat(' ', max(0, width - len(words)))//words
      end subroutine add

   end subroutine show_loads

end module wavycon_result_lines
