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

   !> A line that grows column by column, together with that of the names.
   type :: log_line
      character(:), allocatable :: names, words
   contains
      procedure :: start
      procedure :: add
      procedure :: add_error
   end type log_line

contains

   !> A line for each load: mean gap, area and peak pressure, each followed by its error estimate if the solver has
   !> them; mean and peak pressure in the deck's unit if the deck gives a modulus; solver and status. With free edges
   !> approach, area and peak pressure in the deck's units.
   subroutine show_loads(results, log)
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(run_log), intent(inout) :: log

      character(9) :: names(3)
      type(log_line) :: line
      integer :: i, load, solver_width
      real(dp) :: errors(3), unit(3), values(3)

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
            if (surface%has_free_edges) then
               associate (approach => results%approach_over_amplitude(load))
                  values(1) = approach(1)
                  errors(1) = approach(2)
               end associate
            end if
            call line%start(results, load)
            do i = 1, size(names)
               call line%add(trim(names(i)), unit(i)*values(i))
               if (results%traits%has_errors) call line%add_error(unit(i)*errors(i))
            end do
            if (scene%gives_modulus .and. .not. surface%has_free_edges) &
               call line%add('peak', results%peak_pressure(load), scene%pressure_unit)
            line%names = line%names//' solver'//repeat(' ', solver_width - len('solver') + 2)//'status'
            line%words = line%words//' '//solver_names(results%loads(load)%solver)(:solver_width)//'  '// &
                         trim(status_name(results%loads(load)%status))
            if (load == 1) call log%say(line%names)
            call log%say(line%words)
         end do
      end associate
   end subroutine show_loads

   !> Starts a line with the mean pressure or, with free edges, the force.
   subroutine start(self, results, load)
      class(log_line), intent(out) :: self
      type(results_type), intent(in) :: results
      integer, intent(in) :: load

      self%names = ''
      self%words = ''
      if (results%solver%surface%has_free_edges) then
         call self%add('force', results%solver%surface%nominal_area()*results%mean_pressure(load))
      else
         call self%add('pbar/p*', results%loads(load)%pbar_over_pstar)
         if (results%scene%gives_modulus) &
            call self%add('pbar', results%mean_pressure(load), results%scene%pressure_unit)
      end if
   end subroutine start

   !> Adds a column with a number.
   subroutine add(self, name, number, unit)
      class(log_line), intent(inout) :: self
      character(*), intent(in) :: name
      real(dp), intent(in) :: number
      character(*), intent(in), optional :: unit   !! is shown, such as in 'pbar[MPa]'

      character(:), allocatable :: heading

      heading = name
      if (present(unit)) heading = name//'['//unit//']'
      call put(self, heading, short_number(number), max(13, len(heading) + 2))
   end subroutine add

   !> Adds a column with an error estimate, to two digits: '-' for NaN, an error that is unknown.
   subroutine add_error(self, error)
      class(log_line), intent(inout) :: self
      real(dp), intent(in) :: error

      character(12) :: buffer
      real(dp) :: rounded

      if (ieee_is_nan(error)) then
         call put(self, 'error', '-', 9)
         return
      end if
      write (buffer, '(es12.1e3)') error
      read (buffer, *) rounded
      call put(self, 'error', short_number(rounded), 9)
   end subroutine add_error

   !> Adds words at the right of a column.
   subroutine put(line, name, words, width)
      type(log_line), intent(inout) :: line
      character(*), intent(in) :: name, words
      integer, intent(in) :: width

      line%names = line%names//repeat(' ', max(0, width - len(name)))//name
      line%words = line%words//repeat(' ', max(0, width - len(words)))//words
   end subroutine put

end module wavycon_result_lines
