!> The lines of the log that show the largest stresses.
!>
!> Von Mises stress and shear stress, each followed by its error estimate, and the depth of the first over the side of
!> the cell along x; if the deck gives a yield stress the ratio to it; in the deck's units if it gives a modulus. No
!> line is longer than 120 characters.
module wavycon_stress_lines
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   use wavycon_log_columns, only: at_right, cell, error_cell, error_width, load_width, width, with_unit
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: heading_of_stresses, line_of_stress

   integer, parameter :: body_width = 5

contains

   !> The names of the columns.
   function heading_of_stresses(results) result(line)
      type(results_type), intent(in) :: results   !! with the largest stresses
      character(:), allocatable :: line

      line = at_right('pbar/p*', load_width)
      if (results%scene%gives_modulus) line = line//at_right(with_unit('pbar', results%scene%pressure_unit), width)
      line = line//at_right('body', body_width)//at_right('vMises/p*', width)//at_right('error', error_width)// &
             at_right('depth/cell', width)//at_right('shear/p*', width)//at_right('error', error_width)
      if (results%scene%gives_modulus) line = line//at_right(with_unit('vMises', results%scene%pressure_unit), width)
      if (has_yield_stress(results)) line = line//at_right('over yield', width)
   end function heading_of_stresses

   !> One load and body.
   function line_of_stress(results, load, body) result(line)
      type(results_type), intent(in) :: results   !! with the largest stresses
      integer, intent(in) :: load                 !! number in the deck's order
      integer, intent(in) :: body
      character(:), allocatable :: line

      associate (yielding => results%von_mises(body, load), shear => results%shear(body, load), scene => results%scene)
         line = cell(results%loads(load)%pbar_over_pstar, load_width)
         if (scene%gives_modulus) line = line//cell(results%mean_pressure(load), width)
         line = line//at_right(achar(iachar('0') + body), body_width)// &
                cell(yielding%value, width)//error_cell(yielding%error)// &
                cell(yielding%place(3)/(2*pi), width)// &
                cell(shear%value, width)//error_cell(shear%error)
         if (scene%gives_modulus) line = line//cell(scene%p_star*yielding%value, width)
         if (has_yield_stress(results)) &
            line = line//cell(scene%stress_setting%over_yield_stress(body, yielding%value, shear%value), width)
      end associate
   end function line_of_stress

   pure logical function has_yield_stress(results)
      type(results_type), intent(in) :: results

      has_yield_stress = allocated(results%scene%stress_setting%yield_stress)
   end function has_yield_stress

end module wavycon_stress_lines
