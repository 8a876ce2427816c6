!> The lines of the log that show the solved loads.
!>
!> Mean gap, area and peak pressure, each followed by its error estimate if the solver has them; mean and peak pressure
!> in the deck's unit if the deck gives a modulus. An error that is unknown shows as '-'. No line is longer than 120
!> characters.
module wavycon_load_lines
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_status, only: status_name
   use wavycon_kinds, only: dp
   use wavycon_log_columns, only: at_left, at_right, cell, error_cell, error_width, load_width, width, with_unit
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: solver_names
   implicit none (type, external)
   private

   public :: heading_of_loads, line_of_load

contains

   !> The names of the columns.
   function heading_of_loads(results) result(line)
      type(results_type), intent(in) :: results   !! with a solution for each load
      character(:), allocatable :: line

      line = at_right('pbar/p*', load_width)
      if (results%scene%gives_modulus) line = line//at_right(with_unit('pbar', results%scene%pressure_unit), width)
      line = line//at_right('gap/Delta', width)//error()//at_right('area/A0', width)//error()// &
             at_right('peak/p*', width)//error()
      if (results%scene%gives_modulus) line = line//at_right(with_unit('peak', results%scene%pressure_unit), width)
      line = line//' '//at_left('solver', solver_width(results))//'  status'

   contains

      !> The name above an error, where there are any.
      function error() result(text)
         character(:), allocatable :: text

         text = ''
         if (results%traits%has_errors) text = at_right('error', error_width)
      end function error

   end function heading_of_loads

   !> One load.
   function line_of_load(results, load) result(line)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load                 !! number in the deck's order
      character(:), allocatable :: line

      associate (solution => results%loads(load), measures => results%loads(load)%measures)
         line = cell(solution%pbar_over_pstar, load_width)
         if (results%scene%gives_modulus) line = line//cell(results%mean_pressure(load), width)
         line = line//cell(measures%mean_gap_over_amplitude, width)//error(measures%mean_gap_error)// &
                cell(measures%contact_area_fraction, width)//error(measures%contact_area_error)// &
                cell(measures%peak_pressure_over_pstar, width)//error(measures%peak_pressure_error)
         if (results%scene%gives_modulus) line = line//cell(results%peak_pressure(load), width)
         line = line//' '//at_left(trim(solver_names(solution%solver)), solver_width(results))//'  '// &
                trim(status_name(solution%status))
      end associate

   contains

      !> An error estimate, where there are any.
      function error(number) result(text)
         real(dp), intent(in) :: number
         character(:), allocatable :: text

         text = ''
         if (results%traits%has_errors) text = error_cell(or_nan(number))
      end function error

   end function line_of_load

   !> Characters of the longest name of a solver among the loads.
   pure integer function solver_width(results)
      type(results_type), intent(in) :: results

      integer :: i

      solver_width = len('solver')
      do i = 1, size(results%loads)
         solver_width = max(solver_width, len_trim(solver_names(results%loads(i)%solver)))
      end do
   end function solver_width

end module wavycon_load_lines
