!> The lines of the log that show the solved loads.
!>
!> Mean gap, area and peak pressure, each followed by its error estimate if the solver has them; mean and peak pressure
!> in the deck's unit if the deck gives a modulus. No line is longer than 120 characters.
module wavycon_load_lines
   use wavycon_kinds, only: dp
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: heading_of_loads, line_of_load

   !> Characters of the columns of P, of values, and of errors.
   integer, parameter :: load_width = 10, width = 12, error_width = 8

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
         if (results%solver%has_error_estimates()) text = at_right('error', error_width)
      end function error

   end function heading_of_loads

   !> One load.
   function line_of_load(results, load) result(line)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load                 !! number in the deck's order
      character(:), allocatable :: line

      associate (solution => results%loads(load)%solution, measures => results%loads(load)%solution%measures)
         line = cell(solution%pbar_over_pstar, load_width)
         if (results%scene%gives_modulus) line = line//cell(results%mean_pressure(load), width)
         line = line//cell(measures%mean_gap_over_amplitude, width)//error(measures%mean_gap_error)// &
                cell(measures%contact_area_fraction, width)//error(measures%contact_area_error)// &
                cell(measures%peak_pressure_over_pstar, width)//error(measures%peak_pressure_error)
         if (results%scene%gives_modulus) line = line//cell(results%peak_pressure(load), width)
         line = line//' '//at_left(trim(solution%solver), solver_width(results))//'  '//trim(solution%status)
      end associate

   contains

      !> An error estimate, where there are any.
      function error(number) result(text)
         real(dp), intent(in) :: number
         character(:), allocatable :: text

         text = ''
         if (results%solver%has_error_estimates()) text = at_right(with_exponent(number, 1), error_width)
      end function error

   end function line_of_load

   !> A number at the right of a column: with six decimals where they fit, otherwise with an exponent.
   pure function cell(number, width) result(text)
      real(dp), intent(in) :: number
      integer, intent(in) :: width      !! at least 10
      character(:), allocatable :: text

      real(dp), parameter :: least = 1.0e-3_dp
      character(20) :: buffer

      if ((abs(number) >= least .and. abs(number) < 10.0_dp**(width - 8)) .or. .not. abs(number) > 0) then
         write (buffer, '(f20.6)') number
         text = at_right(trim(adjustl(buffer)), width)
      else
         text = at_right(with_exponent(number, min(4, width - 7)), width)
      end if
   end function cell

   !> A number as 1.2345E+06, or as 1.2345E+249 if the exponent has three digits: there Fortran's `es` without an
   !> exponent width would omit the E.
   pure function with_exponent(number, decimals) result(text)
      real(dp), intent(in) :: number
      integer, intent(in) :: decimals
      character(:), allocatable :: text

      character(20) :: buffer, layout

      write (layout, '(a, i0, a)') '(es20.', decimals, ')'
      write (buffer, layout) number
      write (layout, '(a, i0, a)') '(es20.', decimals, 'e3)'
      if (index(buffer, 'E') == 0) write (buffer, layout) number
      text = trim(adjustl(buffer))
   end function with_exponent

   !> A name with a unit, such as 'pbar[MPa]', or the name alone if both do not fit into a column.
   pure function with_unit(name, unit) result(words)
      character(*), intent(in) :: name, unit
      character(:), allocatable :: words

      words = name//'['//unit//']'
      if (len(words) >= width) words = name
   end function with_unit

   !> Characters of the longest name of a solver among the loads.
   pure integer function solver_width(results)
      type(results_type), intent(in) :: results

      integer :: i

      solver_width = len('solver')
      do i = 1, size(results%loads)
         solver_width = max(solver_width, len_trim(results%loads(i)%solution%solver))
      end do
   end function solver_width

   pure function at_right(text, width) result(column)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: column

      column = repeat(' ', max(0, width - len(text)))//text
   end function at_right

   pure function at_left(text, width) result(column)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: column

      column = text//repeat(' ', max(0, width - len(text)))
   end function at_left

end module wavycon_load_lines
